/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Whose each damaged node is: of exactly one branch, or of exactly one speck, a connected heap of
 * damage that is no branch, for it is shorter than three horizons: away from all cracks, or around
 * the tip of a pre-crack that did not grow. The pre-crack's own nodes are nobody's.
 */
#ifndef KR_OWNERS_H
#define KR_OWNERS_H

#include "legs.h"

struct kr_speck {
    size_t birth, count; /* its first node, of the front; its number of nodes */
};

struct kr_owners {
    size_t *branch, *speck; /* (front's n) numbers from 1; 0: not of one */
    size_t n_specks, room;
    struct kr_speck *item; /* number k is item[k - 1], in the order of their first nodes' times */
};

/** Tell the owners; branch_of_leg holds the number of the branch of each leg. */
void kr_owners_find(const struct kr_front *front, const struct kr_legs *legs,
                    const size_t *branch_of_leg, struct kr_owners *owners);
void kr_owners_clear(struct kr_owners *owners);

#endif
