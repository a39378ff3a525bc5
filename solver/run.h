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
#include "probe.h"

/** A part of the run, ready. */
struct kr_stage {
    int kind;       /* enum kr_stage_kind */
    double dt;      /* s; 0 in a static stage */
    long steps;     /* static: as the deck has them */
    double end;     /* s: of the stage's clock */
    double damping; /* 1/s */
    double least_step, end_below, tolerance;
    int breaks;
    const struct kr_deck_list *load_steps; /* struct kr_case_steps; static */
};

/** A case ready to run; owns all of it. */
struct kr_run {
    const struct kr_case *c; /* not owned */
    struct kr_nodes *nodes;
    struct kr_bonds *bonds;
    struct kr_body *body;
    size_t precrack; /* pairs cut by the pre-cracks */
    int staged;      /* the deck has stages */
    size_t n_stages;
    struct kr_stage *stage;        /* (n_stages) */
    struct kr_boundary **boundary; /* (n_stages): the loads of each */
    struct kr_probes *probes;
    double safe_step;              /* s: longest step in time that is safe */
    double dt;                     /* s, of the last stage that has steps in time */
    long steps;                    /* of all stages together */
};

/** Read the node file, find families, cut pre-cracks, set the loads of each stage and find the time step. Faults of
 *  the deck (an unknown set, a node file made for another horizon) are added to it and stop. */
struct kr_run *kr_run_create(struct kr_deck *deck, const struct kr_case *c);
void kr_run_free(struct kr_run *run);

/** Derived quantities, as lines of text on stdout: constants, wave speeds, the memory that the run will need
 *  (all of it is held for a moment), and an estimate of the time, from a short measurement. Moves the body. */
void kr_run_explain(struct kr_run *run);

/** One static stage: load step by load step to equilibrium, breaking bonds past s0 until there is none;
 *  theory.md (24) to (26). Returns 1 where the body came apart, which ends the run. Stops (exit 2)
 *  where the loads leave the body free to move, naming how; (exit 4) where there is no equilibrium. */
struct kr_records;
int kr_run_static(struct kr_run *run, struct kr_records *records);

/** Solve, and write run.h5, run.xdmf and history.csv into the case's folder. Checkpoints are written
 *  every solver.checkpoint_every of wall time or solver.checkpoint_steps and on SIGUSR1, SIGTERM and SIGINT; the last two stop the
 *  run (exit 7). resume: go on from the last checkpoint; the results are then those of a run that never
 *  stopped, to the last bit. */
void kr_run_solve(struct kr_run *run, const char *deck_text, int resume);

#endif
