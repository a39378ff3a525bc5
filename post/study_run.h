/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Run a study: some runs at once, each `kirsch` as a child with its share of the processors.
 *
 * Whether a run is done, must go on from a checkpoint or is to be begun, `kirsch` tells by its
 * stamps, so nothing is kept here but the wall time. A run that fails is noted, the others go on.
 * Children end with this program, whatever ends it; what they had reached stays.
 */
#ifndef KR_STUDY_RUN_H
#define KR_STUDY_RUN_H

#include "study.h"

struct kr_study_plan {
    size_t at_once; /* 0: as many as there are processors */
    size_t only;    /* number of the one run to be done, from 1; 0: all */
    int check;      /* only check the decks */
};

/** Run what is not done yet and tell of each; fills in state, code and fault of the runs. After
 *  Ctrl-C no more are started, and those that run leave a checkpoint. */
void kr_study_run_all(struct kr_study *study, const struct kr_study_plan *plan);

/** Fill in the states from what is there, without running anything. */
void kr_study_look(struct kr_study *study);

/** Wall time [s] that a run took, over all its attempts that came to an end; 0 if none did. */
double kr_study_wall_time(const struct kr_study_run *run);

/** Processors this program may use: OMP_NUM_THREADS where it is set. */
size_t kr_study_processors(void);

#endif
