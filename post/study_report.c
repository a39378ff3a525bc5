/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The table of a study: settings and state of each run, then its results from summary.csv, empty
 * where there is none. And the Slurm script: the same runs by their numbers.
 */
#include "study_report.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/child.h"
#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "study_run.h"
#include "csv.h"

/* ---- results of a run ---------------------------------------------------------------------- */

/* Columns that are lines of summary.csv: the column's name, then the line's. */
static const struct result {
    const char *column, *name;
} results[] = {
    {"first_growth [s]", "first_growth"},     {"branches", "branches"},
    {"mean_speed [m/s]", "mean_speed"},       {"top_speed [m/s]", "top_speed"},
    {"rayleigh_speed [m/s]", "rayleigh_speed"}, {"fracture_work [J/m]", "fracture_work"},
    {"energy_balance", "energy_balance"},
};
enum { RESULTS = sizeof results / sizeof results[0] };

static struct kr_csv *table_of(const struct kr_study_run *run, const char *name) {
    char *path = kr_text("%s/%s", run->folder, name);
    struct kr_csv *table = access(path, R_OK) ? NULL : kr_csv_read(path);
    kr_free(path);
    return table;
}

/* A value of summary.csv as it stands there; "" if there is none. */
static const char *value_of(const struct kr_csv *summary, const char *name) {
    size_t names = kr_csv_column(summary, "name"), values = kr_csv_column(summary, "value");
    for (size_t r = 0; r < summary->n_rows && names != KR_CSV_NONE && values != KR_CSV_NONE;
         r++)
        if (!strcmp(kr_csv_cell(summary, r, names), name))
            return kr_csv_cell(summary, r, values);
    return "";
}

/* Pores of a run: lines of pores.txt that are no comments; 0 where there are none. */
static size_t count_pores(const struct kr_study_run *run) {
    char *path = kr_text("%s/pores.txt", run->folder), *line = NULL;
    size_t count = 0, room = 0;
    FILE *file = fopen(path, "r");
    while (file && getline(&line, &room, file) >= 0)
        count += line[strspn(line, " \t\r\n")] != 0 && line[strspn(line, " \t")] != '#';
    if (file)
        fclose(file);
    free(line);
    kr_free(path);
    return count;
}

/* Row of the first event of a kind; events.csv is in the order of time. KR_CSV_NONE if none. */
static size_t first_event(const struct kr_csv *events, const char *kind) {
    size_t kinds = kr_csv_column(events, "kind");
    for (size_t r = 0; r < events->n_rows && kinds != KR_CSV_NONE; r++)
        if (!strcmp(kr_csv_cell(events, r, kinds), kind))
            return r;
    return KR_CSV_NONE;
}

static double number_at(const struct kr_csv *events, size_t row, const char *name) {
    size_t column = kr_csv_column(events, name);
    return row == KR_CSV_NONE || column == KR_CSV_NONE
               ? NAN
               : strtod(kr_csv_cell(events, row, column), NULL);
}

static void put_number(FILE *file, double value) {
    if (isfinite(value))
        fprintf(file, ",%.9g", value);
    else
        fputc(',', file);
}

/* Time of the first fork, and how far from its birth the crack first entered a hole. */
static void put_events(FILE *file, const struct kr_csv *events) {
    size_t birth = first_event(events, "birth"), hole = first_event(events, "enter hole");
    put_number(file, number_at(events, first_event(events, "branch"), "time"));
    put_number(file, hypot(number_at(events, hole, "x") - number_at(events, birth, "x"),
                           number_at(events, hole, "y") - number_at(events, birth, "y")));
}

/* ---- the table ----------------------------------------------------------------------------- */

/* A field, in quotes where it needs them. */
static void put(FILE *file, const char *text) {
    if (!strpbrk(text, ",\"\n#")) {
        fputs(text, file);
        return;
    }
    fputc('"', file);
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', file);
        fputc(*text == '\n' ? ' ' : *text, file);
    }
    fputc('"', file);
}

static void put_results(FILE *file, const struct kr_study_run *run) {
    struct kr_csv *summary = run->state == KR_STUDY_DONE ? table_of(run, "summary.csv") : NULL;
    if (summary)
        fprintf(file, ",%zu", count_pores(run));
    else
        fputc(',', file);
    for (size_t k = 0; k < RESULTS; k++) {
        fputc(',', file);
        if (summary)
            put(file, value_of(summary, results[k].name));
    }
    struct kr_csv *events = summary ? table_of(run, "events.csv") : NULL;
    if (events)
        put_events(file, events);
    else
        fputs(",,", file);
    kr_csv_free(events);
    double wall = kr_study_wall_time(run);
    fputc(',', file);
    if (wall > 0)
        fprintf(file, "%.1f", wall);
    kr_csv_free(summary);
}

static void put_header(FILE *file, const struct kr_study *study) {
    fputs("run", file);
    for (size_t k = 0; k < study->n_keys; k++) {
        fputc(',', file);
        put(file, study->key[k]);
    }
    fputs(",state,pores", file);
    for (size_t k = 0; k < RESULTS; k++)
        fprintf(file, ",%s", results[k].column);
    fputs(",first_branch [s],first_pore_distance [m],wall_time [s],fault\n", file);
}

static void put_run(FILE *file, const struct kr_study *study, const struct kr_study_run *run) {
    static const char *const states[] = {"open", "done", "failed", "interrupted"};
    put(file, run->name);
    for (size_t k = 0; k < study->n_keys; k++) {
        fputc(',', file);
        put(file, run->value[k]);
    }
    fprintf(file, ",%s", states[run->state]);
    put_results(file, run);
    fputc(',', file);
    put(file, run->fault ? run->fault : "");
    fputc('\n', file);
}

void kr_study_report(const struct kr_study *study) {
    struct kr_file file = kr_file_begin(kr_text("%s/study.csv", study->folder));
    put_header(file.to, study);
    for (size_t r = 0; r < study->n_runs; r++)
        put_run(file.to, study, &study->run[r]);
    kr_file_end(&file);
}

/* ---- Slurm --------------------------------------------------------------------------------- */

/* A word for sh: in single quotes, those within as '\''. */
static void put_word(const char *word) {
    putchar('\'');
    for (; *word; word++) {
        if (*word == '\'')
            fputs("'\\'", stdout);
        putchar(*word);
    }
    putchar('\'');
}

static void put_option(const char *name, const char *value) {
    printf(" %s ", name);
    put_word(value);
}

static void put_command(const struct kr_study *study, const struct kr_case_arguments *arguments) {
    char *program = kr_child_beside("kirsch-study");
    put_word(program);
    putchar(' ');
    put_word(study->path);
    if (strcmp(study->path, arguments->deck)) {
        putchar(' ');
        put_word(arguments->deck);
    }
    if (arguments->variant)
        put_option("--variant", arguments->variant);
    for (size_t k = 0; k < arguments->n_set; k++)
        put_option("--set", arguments->set[k]);
    put_option("--output", study->folder);
    kr_free(program);
}

void kr_study_slurm(const struct kr_study *study, const struct kr_case_arguments *arguments) {
    char *here = getcwd(NULL, 0);
    if (!here)
        kr_stop(KR_EXIT_STORAGE, "the present folder cannot be told: %s", strerror(errno));
    printf("#!/bin/sh\n"
           "#SBATCH --job-name=kirsch-study\n"
           "#SBATCH --array=1-%zu\n"
           "#SBATCH --cpus-per-task=8\n"
           "#SBATCH --requeue\n"
           "# A task a run; a task that was cut off goes on from its checkpoint when sent again.\n",
           study->n_runs);
    for (size_t r = 0; r < study->n_runs; r++)
        printf("#   %zu  %s\n", r + 1, study->run[r].name);
    printf("# Behind the last: the same command with --gather in place of --row writes the table.\n"
           "export OMP_NUM_THREADS=\"${SLURM_CPUS_PER_TASK:-1}\"\n"
           "cd ");
    put_word(here);
    printf(" || exit 3\nexec ");
    put_command(study, arguments);
    printf(" --at-once 1 --row \"$SLURM_ARRAY_TASK_ID\"\n");
    free(here);
}
