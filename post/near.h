/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Points near a place, by square buckets as wide as the reach.
 */
#ifndef KR_NEAR_H
#define KR_NEAR_H

#include <stddef.h>

struct kr_near; /* Opaque. Implemented in near.c. */

/** Sort n points (n x 2, kept by the caller, finite) into buckets of width `reach` > 0. */
struct kr_near *kr_near_create(size_t n, const double *position, double reach);
void kr_near_free(struct kr_near *near);

/** Indices of the points within the reach of a place, in a fixed order. The list is owned by `near`
 *  and lives until the next call. */
const size_t *kr_near_find(struct kr_near *near, const double place[2], size_t *count);

/** Whether there is a point within the reach of a place. */
int kr_near_any(struct kr_near *near, const double place[2]);

#endif
