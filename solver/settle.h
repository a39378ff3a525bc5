/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Equilibrium also behind a snap, where there is none near by; theory.md (24), (28).
 */
#ifndef KR_SETTLE_H
#define KR_SETTLE_H

#include "equilibrium.h"

/** As kr_equilibrium_find; but where that finds none, the body is let go in damped motion with time steps
 *  of KR_REST_STEP `safe_step` [s], supports at rest, until it is nearly over, and Newton ends what that
 *  began; where Newton does not, from motion that goes on ten times closer, and so on. Velocities are 0 in the end. A snap is told in a line, unless q->quiet. */
enum kr_equilibrium_end kr_settle(struct kr_equilibrium *q, double safe_step);

#endif
