/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A study: one deck run many times, each run with some keys of its own.
 *
 *   table.csv    the header names keys of the deck, each line is a run
 *   study.yaml   `vary: [{key: geometry.pores.seed, values: [1, 2, 3]}, ...]`: all combinations
 *
 * A run's folder is named after its settings ("count-10_seed-3"), or by the column `name`: so rows
 * may be added, taken out or put in another order, and what was run stays.
 */
#ifndef KR_STUDY_H
#define KR_STUDY_H

#include <stddef.h>

#include "case.h"

enum kr_study_state {
    KR_STUDY_OPEN,        /* not begun, or begun and not done */
    KR_STUDY_DONE,
    KR_STUDY_FAILED,
    KR_STUDY_INTERRUPTED, /* by a signal; it goes on from its checkpoint */
};

struct kr_study_run {
    char *name;   /* of its folder */
    char *folder;
    char **value; /* (n_keys) "" leaves the deck's */
    enum kr_study_state state;
    int code;     /* exit code, where it failed */
    char *fault;  /* the sentence, where it failed */
};

struct kr_study {
    char *path;   /* of the table or YAML file */
    char *deck;
    char *folder; /* of all runs, the table and the pictures */
    const char *variant;
    size_t n_set;
    const char **set; /* for all runs, before their own */
    size_t n_keys, n_runs;
    char **key; /* (n_keys) */
    struct kr_study_run *run;
};

/** Read a study. `table` is a CSV file, or NULL where arguments->deck is a study in YAML. Stops
 *  (exit 2) on faults: no runs, a key twice, two runs of one name. What the deck says of the
 *  settings shows when they are run. `arguments` must live as long as the study. */
struct kr_study *kr_study_open(const struct kr_case_arguments *arguments, const char *table);
void kr_study_free(struct kr_study *study);

/** The words that run one of them: kirsch DECK --set ... --output FOLDER; NULL at the end. Words
 *  that begin with `--set` values are owned by the list: free with kr_study_command_free. */
char **kr_study_command(const struct kr_study *study, const struct kr_study_run *run);
void kr_study_command_free(char **command);

#endif
