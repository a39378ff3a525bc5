/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Running a case: from the nodes to the results.
 */
#ifndef KR_RUN_H
#define KR_RUN_H

#include "body.h"
#include "boundary.h"
#include "case.h"
#include "nodes.h"

/** A case ready to run; owns all of it. */
struct kr_run {
    const struct kr_case *c; /* not owned */
    struct kr_nodes *nodes;
    struct kr_bonds *bonds;
    struct kr_body *body;
    struct kr_boundary *boundary;
    size_t precrack; /* pairs cut by the pre-cracks */
    double dt;       /* s */
    long steps;
};

/** Read the node file, find families, cut pre-cracks, set loads and find the time step. Faults of
 *  the deck (an unknown set, a node file made for another horizon) are added to it and stop. */
struct kr_run *kr_run_create(struct kr_deck *deck, const struct kr_case *c);
void kr_run_free(struct kr_run *run);

/** Derived quantities, as lines of text on stdout: constants, wave speeds, bonds, time step, memory,
 *  and an estimate of the time, from a short measurement. */
void kr_run_explain(const struct kr_run *run);

/** Solve, and write run.h5, run.xdmf and history.csv into the case's folder. Checkpoints are written
 *  every solver.checkpoint_every of wall time and on SIGUSR1, SIGTERM and SIGINT; the last two stop the
 *  run (exit 7). resume: go on from the last checkpoint; the results are then those of a run that never
 *  stopped, to the last bit. */
void kr_run_solve(struct kr_run *run, const char *deck_text, int resume);

#endif
