/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Radii of random pores, in whole nanometres.
 */
#ifndef KR_PORE_SIZE_H
#define KR_PORE_SIZE_H

#include "case.h"

/** A pore's sizes: half axes, equal for a circle, and the angle of the longer one. */
struct kr_pore_size {
    int64_t radius, shorter; /* nm */
    int64_t angle;           /* thousandths of a degree */
};

/** Draw one from the distribution of the deck. */
struct kr_pore_size kr_pore_size_draw(const struct kr_case_pores *pores, uint64_t *state);

/** Draw as many as have together `porosity` times `area` [m^2], largest first; owned by the caller.
 *  The last one drawn is fitted to what is missing where the range of radii allows it; else it is
 *  left out if that is nearer. */
struct kr_pore_size *kr_pore_sizes_draw(const struct kr_case_pores *pores, double area,
                                        uint64_t *state, size_t *n);

#endif
