/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What lies within a horizon of a damaged node: other damage, rims of holes, the boundary.
 */
#ifndef KR_RIMS_H
#define KR_RIMS_H

#include "front.h"

struct kr_rims; /* Opaque. Implemented in rims.c. */

/** The front must outlive it. */
struct kr_rims *kr_rims_create(const struct kr_front *front);
void kr_rims_free(struct kr_rims *rims);

/** The rim nearest to any of some nodes of the front, within a horizon; holes before boundaries:
 *  a value of kr_record.rim. */
int kr_rims_nearest(const struct kr_rims *rims, const size_t *node, size_t count);

/** Damaged nodes within a horizon of one of them, `*found` to be used before the next call. Returns
 *  their number, or KR_FRONT_NONE where a rim is as near: the node's family is cut by it. */
size_t kr_rims_damage(const struct kr_rims *rims, size_t node, const int **found);

#endif
