/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The steps of a case, each a program of its own: what it reads, what it leaves, and whether it is out of
 * date.
 *
 * A step is up to date if its outputs are there and its stamp (in the folder .steps of the case) is
 * the hash of what it depends on: the deck's sections that it reads, its input files by size and
 * time, and the version of Kirsch. Files edited by hand are thus inputs of the steps behind them.
 */
#ifndef KR_STEP_H
#define KR_STEP_H

#include "case.h"

struct kr_step {
    const char *program;
    const char *sections;   /* of the deck, that it reads */
    const char *inputs[4];  /* in the case's folder */
    const char *outputs[4];
};

enum { KR_STEP_PORES, KR_STEP_MESH, KR_STEP_NODES, KR_STEP_SOLVE, KR_STEP_TRACK, KR_STEP_PLOT, KR_STEPS };
extern const struct kr_step kr_steps[KR_STEPS];

/** What the steps work on. */
struct kr_job {
    struct kr_case_arguments arguments;
    struct kr_case c;
    struct kr_deck *deck;
    char *mesh; /* path of a mesh from elsewhere, or NULL */
    int force;
    int n_steps; /* to be run, from the first */
};

int kr_step_is_up_to_date(const struct kr_job *job, const struct kr_step *step);

/** Whether the step was begun last time with just what it would begin with now. */
int kr_step_was_begun(const struct kr_job *job, const struct kr_step *step);

/** Leave a stamp: the step is about to begin, or it has ended well. */
void kr_step_note_begun(const struct kr_job *job, const struct kr_step *step);
void kr_step_note_done(const struct kr_job *job, const struct kr_step *step);

#endif
