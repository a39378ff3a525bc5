/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Checkpoints: all that a run needs to go on from a step as if it had never stopped, to the last bit,
 * with any number of threads.
 */
#ifndef KR_CHECKPOINT_H
#define KR_CHECKPOINT_H

#include "body.h"
#include "case.h"
#include "crack.h"
#include "ledger.h"

/** Where a run stands, between two steps: `step` is the next one of its stage; in a dynamic one body->v
 *  is half a step behind it, but for step 0. */
struct kr_checkpoint {
    size_t stage;
    long step, steps;      /* of the stage, of the whole run */
    long before;           /* steps of the stages before */
    double began;          /* s: time of the run when the stage began */
    double clock;          /* s: of the stage; static */
    double rest_clock, *rest[3]; /* s, m: clock and displacements of the equilibrium before the last; static;
                                    NULL in a run without static stages */
    double most_pull;      /* N/m, in 3D N: greatest that held the body in static stages */
    long round;            /* of breaking within the load step; static */
    int event;             /* an output is due for what broke in this load step */
    double dt;             /* s */
    long history, sites;   /* bytes of history.csv and sites.csv that are valid */
    const char *deck_text; /* resolved deck; a checkpoint of another deck is refused */
    struct kr_body *body;
    struct kr_ledger *ledger;
    struct kr_crack *crack;
};

/** Write checkpoint.h5 into the case's folder, whole or not at all; the one before is kept as
 *  checkpoint-before.h5. Stops (exit 3) where it cannot be written. */
void kr_checkpoint_write(const struct kr_case *c, const struct kr_checkpoint *at);

/** Read the newest checkpoint that is whole into body, ledger, crack, step and history; a damaged one
 *  is told and passed over. Stops (exit 3) if there are only damaged ones, (exit 2) if there is none, or if it was made by another deck (naming the first key that differs),
 *  other nodes or another time step. */
void kr_checkpoint_read(const struct kr_case *c, struct kr_checkpoint *at);

/** Remove the case's checkpoints: the run is done. */
void kr_checkpoint_remove(const struct kr_case *c);

#endif
