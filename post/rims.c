/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Search among the damaged nodes and those on rims; see rims.h.
 */
#include "rims.h"

#include <math.h>

#include "base/memory.h"
#include "search.h"

struct kr_rims {
    const struct kr_front *front;
    size_t n;
    double *x; /* (n x 3) m: the nodes of the front, which are asked for, then those of the rims */
    int *rim;  /* (n) */
    int *found;
    struct kr_search *search;
};

struct kr_rims *kr_rims_create(const struct kr_front *front) {
    const struct kr_record *record = front->record;
    struct kr_rims *rims = KR_NEW(struct kr_rims, 1);
    *rims = (struct kr_rims){.front = front, .n = front->n};
    for (size_t i = 0; record->rim && i < record->n; i++)
        rims->n += record->rim[i] != KR_RIM_NONE;
    rims->x = KR_NEW(double, 3 * rims->n);
    rims->rim = KR_NEW(int, rims->n);
    rims->found = KR_NEW(int, rims->n);
    for (size_t k = 0; k < 3 * front->n; k++)
        rims->x[k] = front->x[k];
    for (size_t i = 0, k = front->n; record->rim && i < record->n; i++)
        if (record->rim[i] != KR_RIM_NONE) {
            rims->rim[k] = record->rim[i];
            for (size_t a = 0; a < 2; a++)
                rims->x[3 * k + a] = record->position[2 * i + a];
            k++;
        }
    rims->search = kr_search_create(3, rims->n, rims->x,
                                    record->horizon * (1 + KR_FRONT_SLACK));
    return rims;
}

void kr_rims_free(struct kr_rims *rims) {
    kr_search_free(rims->search);
    kr_free(rims->x);
    kr_free(rims->rim);
    kr_free(rims->found);
    kr_free(rims);
}

int kr_rims_nearest(const struct kr_rims *rims, const size_t *node, size_t count) {
    double least = INFINITY;
    int rim = KR_RIM_NONE;
    for (size_t k = 0; k < count; k++) {
        size_t more = kr_search_near(rims->search, node[k], rims->found, rims->n);
        for (size_t f = 0; f < more; f++) {
            size_t j = (size_t)rims->found[f];
            double away = hypot(rims->x[3 * j] - rims->x[3 * node[k]],
                                rims->x[3 * j + 1] - rims->x[3 * node[k] + 1]);
            int is_hole = rims->rim[j] > 0;
            if (rims->rim[j] == KR_RIM_NONE || is_hole < (rim > 0))
                continue;
            if (away < least || is_hole > (rim > 0)) {
                least = away;
                rim = rims->rim[j];
            }
        }
    }
    return rim;
}

size_t kr_rims_damage(const struct kr_rims *rims, size_t node, const int **found) {
    size_t count = kr_search_near(rims->search, node, rims->found, rims->n);
    for (size_t f = 0; f < count; f++)
        if (rims->rim[rims->found[f]] != KR_RIM_NONE)
            return KR_FRONT_NONE;
    *found = rims->found;
    return count;
}
