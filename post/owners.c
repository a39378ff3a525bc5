/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Branches have their nodes from their legs; what is left falls into connected heaps. See owners.h.
 */
#include "owners.h"

#include "base/memory.h"

#define NONE KR_FRONT_NONE

static int is_free(const struct kr_front *front, const struct kr_owners *owners, size_t i) {
    return front->time[i] >= 0 && !owners->branch[i] && !owners->speck[i];
}

/** Number the heap around a node; queue has room for all nodes. */
static void flood(const struct kr_front *front, size_t birth, size_t *queue,
                  struct kr_owners *owners) {
    size_t end = 1;
    KR_GROW(owners->item, owners->n_specks, owners->room);
    owners->n_specks++;
    queue[0] = birth;
    owners->speck[birth] = owners->n_specks;
    for (size_t k = 0; k < end; k++)
        for (size_t f = front->first[queue[k]]; f < front->first[queue[k] + 1]; f++) {
            size_t j = (size_t)front->near[f];
            if (!is_free(front, owners, j))
                continue;
            owners->speck[j] = owners->n_specks;
            queue[end++] = j;
        }
    owners->item[owners->n_specks - 1] = (struct kr_speck){birth, end};
}

void kr_owners_find(const struct kr_front *front, const struct kr_legs *legs,
                    const size_t *branch_of_leg, struct kr_owners *owners) {
    size_t *queue = KR_NEW(size_t, front->n), *order = KR_NEW(size_t, front->n);
    *owners = (struct kr_owners){KR_NEW(size_t, front->n), KR_NEW(size_t, front->n)};
    for (size_t i = 0; i < front->n; i++) {
        order[front->rank[i]] = i;
        owners->branch[i] = legs->of[i] == NONE ? 0 : branch_of_leg[legs->of[i]];
    }
    for (size_t k = 0; k < front->n;
         k++) /* by time, so that a speck is met first at its first node */
        if (is_free(front, owners, order[k]))
            flood(front, order[k], queue, owners);
    kr_free(order);
    kr_free(queue);
}

void kr_owners_clear(struct kr_owners *owners) {
    kr_free(owners->branch);
    kr_free(owners->speck);
    kr_free(owners->item);
    *owners = (struct kr_owners){0};
}
