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

/** Write run.h5 into the case's folder.
 *
 *  in  steps    of the whole run; with dt and the case's output times they tell the outputs
 *  in  resumed  outputs of the earlier part of the run are kept; else all old ones are removed
 *  Stops (exit 3) where it cannot be written.
 */
struct kr_output *kr_output_create(const struct kr_case *c, const struct kr_nodes *nodes,
                                   const struct kr_bonds *bonds, double dt, long steps, int resumed,
                                   const char *deck_text);
void kr_output_free(struct kr_output *output);

/** Whether an output is due at this step. The first and the last step always are. */
int kr_output_due(const struct kr_output *output, long step);

/** Write the fields at time t (velocities from ledger->v, energies as of kr_ledger_update), the
 *  crack record so far, and run.xdmf. The last step marks the run as finished. */
void kr_output_write(struct kr_output *output, const struct kr_body *body,
                     const struct kr_ledger *ledger, const struct kr_crack *crack, long step,
                     double t);

#endif
