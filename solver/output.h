/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The results file run.h5 and its sidecar run.xdmf for ParaView; layout in docs/formats.md.
 */
#ifndef KR_OUTPUT_H
#define KR_OUTPUT_H

#include "body.h"
#include "case.h"
#include "crack.h"
#include "ledger.h"
#include "nodes.h"

struct kr_output; /* Opaque. Implemented in output.c. */

/** Begin run.h5 in the case's folder; an older one is lost. Stops (exit 3) where it cannot. */
struct kr_output *kr_output_create(const struct kr_case *c, const struct kr_nodes *nodes,
                                   const struct kr_bonds *bonds, double dt, const char *deck_text);

/** Write the fields at time t (velocities from ledger->v, energies as of kr_ledger_update), the
 *  crack record so far, and bring all to the disk; then run.xdmf anew. */
void kr_output_write(struct kr_output *output, const struct kr_body *body,
                     const struct kr_ledger *ledger, const struct kr_crack *crack, long step,
                     double t);

/** Mark the run as finished and close. */
void kr_output_close(struct kr_output *output, long steps);

#endif
