/* SPDX-License-Identifier: BSD-3-Clause
 *
 * How a run begins: displacements and velocities given by expressions in x, y, z.
 */
#ifndef KR_INITIAL_H
#define KR_INITIAL_H

#include "body.h"
#include "nodes.h"

/** Put the deck's `initial` fields into the body, which is at rest: u [m] and v [m/s] at time 0. Loads
 *  that prescribe a motion come after it and win. Stops (exit 4) where a value is not finite. */
void kr_initial_set(const struct kr_case *c, const struct kr_nodes *nodes, struct kr_body *body);

#endif
