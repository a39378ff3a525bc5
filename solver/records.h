/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What a run records while it goes, whatever the stage: history, outputs, cracks, checkpoints.
 */
#ifndef KR_RECORDS_H
#define KR_RECORDS_H

#include "checkpoint.h"
#include "crack.h"
#include "history.h"
#include "ledger.h"
#include "output.h"
#include "run.h"
#include "schedule.h"
#include "sites.h"

struct kr_records {
    struct kr_run *run; /* not owned */
    struct kr_crack *crack;
    struct kr_ledger *ledger;
    struct kr_history *history;
    struct kr_output *output;
    int open; /* outputs are not known beforehand */
    struct kr_sites *sites; /* NULL in a run without stages */
    struct kr_checkpoint at; /* where the run stands: stage, step in it, steps and time before it */
    double saved; /* clock of the last checkpoint */
    int lock;     /* open folder, locked for this run */
};

/** Begin all records of a run, or go on from its last checkpoint: then r->at tells where, and the body
 *  is as it was there. Stops (exit 3) where another run is at work in the case's folder. */
void kr_records_open(struct kr_records *r, struct kr_run *run, const char *deck_text, int resume);
void kr_records_close(struct kr_records *r);

/** Add what broke in the last kr_body_force, at time t [s] of the stage and its step. */
void kr_records_crack(struct kr_records *r, long step, double t);

/** A line of history.csv at a step and time t [s] of the present stage, and with `output` the fields;
 *  the ledger must be up to date. last: the run ends here. */
void kr_records_write(struct kr_records *r, int output, int last, long step, double t);

/** A checkpoint before step `next` of the present stage, where steps, time or a signal ask for one; stops
 *  (exit 7) where the latter asks for that. */
void kr_records_save(struct kr_records *r, long next);

/** The present stage ended after so many steps and at this time of its clock. */
void kr_records_next_stage(struct kr_records *r, long steps, double t);

#endif
