/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The watch over a run: stops it when numbers turn into nonsense.
 */
#ifndef KR_WATCH_H
#define KR_WATCH_H

#include "ledger.h"

/** Check the ledger just updated. Stops (exit 4) with node, time and likely cause if a number is NaN
 *  or infinite, or if there is far more energy than went in: the time step is too large then. */
void kr_watch_check(const struct kr_body *body, const struct kr_ledger *ledger, long step,
                    double t, double dt);

#endif
