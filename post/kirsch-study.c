/* SPDX-License-Identifier: BSD-3-Clause
 *
 * kirsch-study: one deck many times, with other pores, loads or whatever else a table says; ends
 * with one table of results and pictures of all.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/child.h"
#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "study.h"
#include "study_report.h"
#include "study_run.h"

static const char usage[] =
    "kirsch-study table.csv case.yaml   run the deck once for each line of the table, whose header "
    "names\n"
    "                                   keys of the deck: geometry.pores.seed, loads.0.ramp, ...\n"
    "kirsch-study study.yaml            the same for all combinations of values; docs/studies.md\n"
    "\n"
    "The same command goes on after an interruption; what is done is not run again.\n"
    "\n"
    "  --at-once N        runs at once (default: one a processor)\n"
    "  --row N            run only this one, and write no table\n"
    "  --gather           run nothing: write the table and the pictures of what is there\n"
    "  --slurm            print a Slurm array script, a task a run; do nothing else";

struct job {
    struct kr_case_arguments arguments;
    const char *table; /* NULL: arguments.deck is a study in YAML */
    struct kr_study_plan plan;
    int gather, slurm;
};

/* A whole number above 0 behind an option. */
static size_t number_behind(const struct job *job, size_t *k) {
    const char *name = job->arguments.left[*k];
    const char *text = *k + 1 < job->arguments.n_left ? job->arguments.left[++*k] : "";
    char *end;
    long number = strtol(text, &end, 10);
    if (*end || number < 1 || number > 1000000)
        kr_stop(KR_EXIT_INPUT, "%s: found '%s', expected a whole number from 1", name, text);
    return (size_t)number;
}

static void take_own_arguments(struct job *job) {
    for (size_t k = 0; k < job->arguments.n_left; k++) {
        const char *word = job->arguments.left[k];
        if (!strcmp(word, "--at-once"))
            job->plan.at_once = number_behind(job, &k);
        else if (!strcmp(word, "--row"))
            job->plan.only = number_behind(job, &k);
        else if (!strcmp(word, "--gather"))
            job->gather = 1;
        else if (!strcmp(word, "--slurm"))
            job->slurm = 1;
        else if (*word != '-' && !job->table)
            job->table = word;
        else
            kr_stop(KR_EXIT_INPUT, "unknown argument '%s'; see kirsch-study --help", word);
    }
    const char *dot = strrchr(job->arguments.deck, '.');
    if (!job->table && dot && !strcmp(dot, ".csv"))
        kr_stop(KR_EXIT_INPUT, "the deck is missing: kirsch-study %s case.yaml",
                job->arguments.deck);
    job->plan.check = job->arguments.check;
}

/* What each run would be, as commands. */
static void explain(const struct kr_study *study) {
    for (size_t r = 0; r < study->n_runs; r++) {
        char **word = kr_study_command(study, &study->run[r]);
        for (size_t k = 0; word[k]; k++)
            printf("%s%s%s%s", k ? " " : "", strpbrk(word[k], " []{},*") ? "'" : "", word[k],
                   strpbrk(word[k], " []{},*") ? "'" : "");
        printf("\n");
        kr_study_command_free(word);
    }
}

/* study.py draws from the table; without Python the table is there all the same. */
static void draw(const struct kr_study *study) {
    char *word[] = {"/usr/bin/python3", "-B", kr_child_script("plot.py"), "study", study->folder,
                    NULL};
    extern char **environ;
    struct kr_child child;
    int status, letter;
    kr_child_prepare(&child);
    kr_child_start_in(&child, word, environ, 0);
    kr_child_wait(&status);
    rewind(child.out);
    rewind(child.said);
    while ((letter = getc(child.out)) != EOF)
        putchar(letter);
    while ((letter = getc(child.said)) != EOF)
        putc(letter, stderr);
    char *trouble = kr_child_trouble(status, 0);
    if (trouble)
        kr_warn("the pictures of %s could not all be drawn: %s", study->folder, trouble);
    kr_free(trouble);
    kr_free(word[2]);
    kr_child_close(&child);
}

/* The failed ones by name, unless only these are wanted all counts, and the exit code. */
static int tell(const struct kr_study *study, int failed_only) {
    size_t count[4] = {0};
    int code = KR_EXIT_OK;
    for (size_t r = 0; r < study->n_runs; r++) {
        const struct kr_study_run *run = &study->run[r];
        count[run->state]++;
        if (run->state != KR_STUDY_FAILED)
            continue;
        fprintf(stderr, "kirsch-study: run %zu, %s, failed: %s\n", r + 1, run->name, run->fault);
        code = code ? code : run->code;
    }
    if (failed_only)
        return code;
    kr_say("%zu runs: %zu done, %zu failed, %zu interrupted, %zu open", study->n_runs,
           count[KR_STUDY_DONE], count[KR_STUDY_FAILED], count[KR_STUDY_INTERRUPTED],
           count[KR_STUDY_OPEN]);
    if (count[KR_STUDY_INTERRUPTED]) {
        kr_say("the same command goes on where it was interrupted");
        code = KR_EXIT_SIGNAL;
    }
    return code;
}

static int run_study(const struct job *job, struct kr_study *study) {
    if (job->plan.only > study->n_runs)
        kr_stop(KR_EXIT_INPUT, "--row: found %zu, expected 1 to %zu", job->plan.only,
                study->n_runs);
    kr_folder_make(study->folder);
    if (!job->gather)
        kr_study_run_all(study, &job->plan);
    if (job->plan.only || job->plan.check)
        return tell(study, 1);
    kr_study_look(study);
    kr_study_report(study);
    int code = tell(study, 0);
    kr_say("%s/study.csv", study->folder);
    draw(study);
    return code;
}

int main(int argc, char **argv) {
    struct job job = {0};
    int code = KR_EXIT_OK;
    kr_case_arguments(argc, argv, usage, &job.arguments);
    take_own_arguments(&job);
    struct kr_study *study = kr_study_open(&job.arguments, job.table);
    if (job.slurm)
        kr_study_slurm(study, &job.arguments);
    else if (job.arguments.explain)
        explain(study);
    else
        code = run_study(&job, study);
    kr_study_free(study);
    kr_free(job.arguments.set);
    kr_free(job.arguments.left);
    return code;
}
