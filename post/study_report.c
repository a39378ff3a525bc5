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
#include <sys/stat.h>
#include <unistd.h>

#include "base/child.h"
#include "base/error.h"
#include "base/memory.h"
#include "study_run.h"
#include "table.h"

/* ---- results of a run ---------------------------------------------------------------------- */

/* Columns that are lines of summary.csv: the column's name, then the line's. */
static const struct result {
    const char *column, *name;
} results[] = {
    {"first_growth [s]", "first_growth"},     {"first_branch [s]", "first_branch"},
    {"branches", "branches"},                 {"mean_speed [m/s]", "mean_speed"},
    {"top_speed [m/s]", "top_speed"},         {"rayleigh_speed [m/s]", "rayleigh_speed"},
    {"fracture_work [J/m]", "fracture_work"}, {"energy_balance", "energy_balance"},
    {"first_pore_distance [m]", "first_pore_distance"},
};
enum { RESULTS = sizeof results / sizeof results[0] };

static struct kr_table *table_of(const struct kr_study_run *run, const char *name) {
    char *path = kr_text("%s/%s", run->folder, name);
    struct kr_table *table = access(path, R_OK) ? NULL : kr_table_read(path);
    kr_free(path);
    return table;
}

/* A value of summary.csv as it stands there; "" if there is none. */
static const char *value_of(const struct kr_table *summary, const char *name) {
    size_t names = kr_table_column(summary, "name"), values = kr_table_column(summary, "value");
    for (size_t r = 0; r < summary->n_rows && names != KR_TABLE_NONE && values != KR_TABLE_NONE;
         r++)
        if (!strcmp(kr_table_cell(summary, r, names), name))
            return kr_table_cell(summary, r, values);
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
    struct kr_table *summary = run->state == KR_STUDY_DONE ? table_of(run, "summary.csv") : NULL;
    if (summary)
        fprintf(file, ",%zu", count_pores(run));
    else
        fputc(',', file);
    for (size_t k = 0; k < RESULTS; k++) {
        fputc(',', file);
        if (summary)
            put(file, value_of(summary, results[k].name));
    }
    double wall = kr_study_wall_time(run);
    fputc(',', file);
    if (wall > 0)
        fprintf(file, "%.1f", wall);
    kr_table_free(summary);
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
    fputs(",wall_time [s],fault\n", file);
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
    char *path = kr_text("%s/study.csv", study->folder), *beside = kr_text("%s.tmp", path);
    FILE *file = fopen(beside, "w");
    if (!file)
        kr_stop(KR_EXIT_STORAGE, "%s cannot be written: %s", beside, strerror(errno));
    put_header(file, study);
    for (size_t r = 0; r < study->n_runs; r++)
        put_run(file, study, &study->run[r]);
    int failed = fflush(file) || ferror(file) || fsync(fileno(file));
    if (fclose(file) || failed || rename(beside, path))
        kr_stop(KR_EXIT_STORAGE, "%s cannot be written: %s", path, strerror(errno));
    kr_free(beside);
    kr_free(path);
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
