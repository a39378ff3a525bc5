/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Partial volumes: which share of a node's volume lies inside the horizon of another.
 */
#ifndef KR_WEIGHT_H
#define KR_WEIGHT_H

#include "case.h"

#include <math.h>

/** Share phi of a cell of size r_j = V_j^(1/dim) inside the horizon of a node at distance L:
 *  a ramp from 1 to 0 as L grows from horizon - r_j/2 to horizon + r_j/2; plates paper eq. 13. */
static inline double kr_weight_hhb_one_sided(double distance, double horizon, double size) {
    double phi = (horizon + 0.5 * size - distance) / size;
    return phi < 0 ? 0 : phi > 1 ? 1 : phi;
}

/** The bond's weight phi_ij = phi_ji, theory.md (10): the mean of both ends' shares (hhb), or 1 up to
 *  the horizon (none). 0: there is no bond. The same bits from both ends.
 *
 *  in  partial_volume  enum kr_partial_volume
 *  in  distance, horizon, size_i, size_j  [m]
 */
static inline double kr_weight(int partial_volume, double distance, double horizon, double size_i,
                               double size_j) {
    /* Distances on a lattice are often just the horizon: rounding must not decide. */
    const double tie = 1 + 1e-9;
    if (partial_volume == KR_PARTIAL_VOLUME_NONE)
        return distance <= horizon * tie ? 1 : 0;
    double phi = 0.5 * (kr_weight_hhb_one_sided(distance, horizon, size_i) +
                        kr_weight_hhb_one_sided(distance, horizon, size_j));
    return phi > 1e-9 ? phi : 0;
}

/** Farthest distance at which two nodes of these sizes can be bonded [m]. */
static inline double kr_weight_reach(int partial_volume, double horizon, double largest_size) {
    if (partial_volume == KR_PARTIAL_VOLUME_NONE)
        return horizon * (1 + 1e-9);
    return horizon + 0.5 * largest_size;
}

#endif
