/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The numbers that a file gives its nodes and elements: in any order, with gaps, and an element perhaps twice.
 */
#ifndef KR_GATHER_ORDER_H
#define KR_GATHER_ORDER_H

#include "gather.h"

/** Put places instead of numbers of nodes into the piles. Stops (exit 2) where a number stands twice or is missing. */
void kr_gather_resolve(struct kr_gather *gather);

/** The order of a pile by ascending numbers, owned by the caller; NULL where it stands in it. Stops (exit 2) where
 *  one stands twice. */
size_t *kr_gather_order(const struct kr_gather *gather, const struct kr_pile *pile);

/** For each element of a dimension the first one with the same nodes, which stands for it: itself as a rule. An
 *  element in two groups is written once a group by MSH 2.2. Owned by the caller; NULL where each stands for
 *  itself. */
size_t *kr_gather_merge(const struct kr_gather *gather, int dim);

#endif
