/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Which bonds broke beside which leg: a bond belongs to the leg of a damaged node at its end, or
 * else of the nearest damaged node that one of its ends lost a bond to. A bond that has neither is
 * scattered damage.
 */
#include "legs.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

#define NONE KR_FRONT_NONE

/** Of each node of the record: the damaged node (of the front) that stands for it. */
struct stand_in {
    size_t *front; /* NONE: none */
    double *away;  /* m */
};

static void offer(const struct kr_record *record, struct stand_in *stand, size_t node,
                  size_t other, size_t other_front) {
    const double *a = record->position + 2 * node, *b = record->position + 2 * other;
    double away = hypot(a[0] - b[0], a[1] - b[1]);
    if (away < stand->away[node]) {
        stand->away[node] = away;
        stand->front[node] = other_front;
    }
}

static struct stand_in find_stand_ins(const struct kr_front *front, const struct kr_legs *legs) {
    const struct kr_record *record = front->record;
    struct stand_in stand = {KR_NEW(size_t, record->n), KR_NEW(double, record->n)};
    size_t *damaged = KR_NEW(size_t, record->n);
    for (size_t i = 0; i < record->n; i++) {
        damaged[i] = stand.front[i] = NONE;
        stand.away[i] = INFINITY;
    }
    for (size_t k = 0; k < front->n; k++)
        if (legs->of[k] != NONE) {
            damaged[front->node[k]] = stand.front[front->node[k]] = k;
            stand.away[front->node[k]] = 0;
        }
    for (size_t k = 0; k < record->broken; k++) {
        size_t i = (size_t)record->bond[2 * k], j = (size_t)record->bond[2 * k + 1];
        if (damaged[j] != NONE)
            offer(record, &stand, i, j, damaged[j]);
        if (damaged[i] != NONE)
            offer(record, &stand, j, i, damaged[i]);
    }
    kr_free(damaged);
    return stand;
}

/** Energy along a leg, first as pairs, then summed up from the begin. */
struct share {
    double s, energy;
};

static int by_place(const void *left, const void *right) {
    const struct share *a = left, *b = right;
    return a->s < b->s ? -1 : a->s > b->s;
}

/** Sum of the energy at places below s. */
static double sum_below(const struct share *share, size_t count, double s) {
    size_t lower = 0, upper = count;
    while (lower < upper) {
        size_t middle = (lower + upper) / 2;
        if (share[middle].s < s)
            lower = middle + 1;
        else
            upper = middle;
    }
    return lower ? share[lower - 1].energy : 0;
}

static void share_leg(const struct kr_front *front, struct kr_leg *leg, struct share *share,
                      size_t count) {
    const double window = kr_path_window(front->record);
    if (!count)
        return;
    qsort(share, count, sizeof *share, by_place);
    for (size_t k = 1; k < count; k++)
        share[k].energy += share[k - 1].energy;
    leg->energy = share[count - 1].energy;
    for (size_t k = 0; k < leg->path.count; k++) {
        struct kr_move *move = leg->path.move + k;
        double from = fmax(move->s - window, leg->begin_s), to = fmin(move->s + window, leg->end_s);
        /* a piece of less than a horizon says more about where bonds stand than about energy */
        if (to - from >= front->record->horizon)
            move->front_energy =
                (sum_below(share, count, to) - sum_below(share, count, from)) / (to - from);
    }
}

void kr_legs_share_energy(const struct kr_front *front, struct kr_legs *legs) {
    const struct kr_record *record = front->record;
    struct stand_in stand = find_stand_ins(front, legs);
    size_t *bond_leg = KR_NEW(size_t, record->broken), *begin, n = legs->count;
    struct share *share = KR_NEW(struct share, record->broken);
    double *place = KR_NEW(double, front->n);
    begin = KR_NEW(size_t, n + 2);
    for (size_t k = 0; k < front->n; k++)
        if (legs->of[k] != NONE)
            place[k] = kr_path_place(front, &legs->item[legs->of[k]].path, k, NULL);
    for (size_t k = 0; k < record->broken; k++) {
        size_t i = (size_t)record->bond[2 * k], j = (size_t)record->bond[2 * k + 1];
        size_t by = stand.away[i] <= stand.away[j] ? stand.front[i] : stand.front[j];
        bond_leg[k] = by;
        if (by == NONE)
            legs->scattered += record->bond_energy[k];
        else
            begin[legs->of[by] + 2]++;
    }
    for (size_t c = 2; c < n + 2; c++)
        begin[c] += begin[c - 1];
    for (size_t k = 0; k < record->broken; k++)
        if (bond_leg[k] != NONE)
            share[begin[legs->of[bond_leg[k]] + 1]++] =
                (struct share){place[bond_leg[k]], record->bond_energy[k]};
    for (size_t c = 0; c < n; c++)
        share_leg(front, legs->item + c, share + begin[c], begin[c + 1] - begin[c]);
    kr_free(bond_leg);
    kr_free(share);
    kr_free(place);
    kr_free(begin);
    kr_free(stand.front);
    kr_free(stand.away);
}
