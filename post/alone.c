/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Which damage tells of one tip alone: kr_legs_tell_alone of legs.h.
 */
#include "legs.h"

#include "rims.h"

#define NONE KR_FRONT_NONE

/** A leg and those that it forks from or with: their damage lies together at the fork. */
static int are_kin(const struct kr_chains *chains, size_t a, size_t b) {
    const struct kr_chain *one = chains->item + a, *two = chains->item + b;
    if (a == b || one->parent == b || two->parent == a)
        return 1;
    return one->parent == two->parent && (one->parent != NONE || one->source == two->source);
}

static int is_of_another(const struct kr_front *front, const struct kr_chains *chains,
                         const size_t *of, size_t i, size_t j) {
    if (front->time[j] < 0)
        return front->source_of[j] != front->source_of[i];
    return of[j] != NONE && !are_kin(chains, of[i], of[j]);
}

void kr_legs_tell_alone(const struct kr_front *front, const struct kr_rims *rims,
                        const struct kr_chains *chains, const size_t *of, char *alone) {
    for (size_t i = 0; i < front->n; i++) {
        const int *near;
        size_t count = of[i] == NONE ? NONE : kr_rims_damage(rims, i, &near);
        alone[i] = count != NONE;
        for (size_t k = 0; alone[i] && k < count; k++)
            alone[i] = !is_of_another(front, chains, of, i, (size_t)near[k]);
    }
}
