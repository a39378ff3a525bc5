/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Results: run.h5, the files it links to, and the sidecar run.xdmf for ParaView; layout in
 * docs/formats.md.
 *
 * No file is ever changed in place. run.h5 is written at the start and holds what stays: mesh, nodes,
 * attributes, and links. Each output is a file of its own, run/KKKKKK.h5; the crack record, run/crack.h5,
 * is written anew beside the old one and takes its place. A run that is killed at any moment thus
 * leaves all it had written, and a resumed run leaves the same bytes as one that was not.
 */
#ifndef KR_OUTPUT_H
#define KR_OUTPUT_H

#include "body.h"
#include "case.h"
#include "crack.h"
#include "ledger.h"
#include "nodes.h"

struct kr_output; /* Opaque. Implemented in output.c. */

/** What is known of a run's outputs when it begins. */
struct kr_output_plan {
    double dt;   /* s */
    long steps;  /* of the whole run; with dt and the case's output times they tell the outputs ... */
    int open;    /* ... but not with stages: then run.h5 links to run/steps.h5, written anew each time */
    int resumed; /* outputs of the earlier part of the run are kept; else all old ones are removed */
    long done;   /* steps done before it was resumed */
};

/** Write run.h5 into the case's folder. Stops (exit 3) where it cannot be written. */
struct kr_output *kr_output_create(const struct kr_case *c, const struct kr_nodes *nodes,
                                   const struct kr_bonds *bonds, struct kr_output_plan plan,
                                   const char *deck_text);
void kr_output_free(struct kr_output *output);

/** Whether an output is due at this step, in a run without stages. The first and the last step always
 *  are. */
int kr_output_due(const struct kr_output *output, long step);

/** Write the fields at time t (velocities from ledger->v, energies as of kr_ledger_update), the
 *  crack record so far, and run.xdmf. last: the run is finished. */
void kr_output_write(struct kr_output *output, const struct kr_body *body,
                     const struct kr_ledger *ledger, const struct kr_crack *crack, long step,
                     double t, int last);

#endif
