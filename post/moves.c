/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The moves of a tip along its path, and their speeds; the equations stand in path.h.
 */
#include "path.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "least.h"

enum { LEAST_MOVES = 5 };

static int sooner(const void *left, const void *right) {
    const struct kr_move *a = left, *b = right;
    if (a->time != b->time)
        return a->time < b->time ? -1 : 1;
    return a->s > b->s ? -1 : a->s < b->s; /* the farthest of a time first */
}

static void find_moves(const struct kr_front *front, size_t count, const size_t *node,
                       const char *alone, struct kr_path *path) {
    struct kr_move *all = KR_NEW(struct kr_move, count);
    for (size_t k = 0; k < count; k++)
        all[k] = (struct kr_move){front->arrival[node[k]],
                                  kr_path_place(front, path, node[k], NULL),
                                  {0, 0}, NAN, NAN, NAN, NAN, alone[node[k]]};
    qsort(all, count, sizeof *all, sooner);
    for (size_t k = 0; k < count; k++)
        if (k == 0 || all[k].s > all[path->count - 1].s)
            all[path->count++] = all[k];
    path->move = all;
}

static void find_direction(const struct kr_record *record, const struct kr_path *path,
                           struct kr_move *move) {
    double end = path->s[path->n - 1], half = record->horizon / 2, a[2], b[2];
    kr_path_point(path, move->s, move->x);
    kr_path_point(path, fmax(fmin(move->s - half, end - 2 * half), 0), a);
    kr_path_point(path, fmin(fmax(move->s + half, 2 * half), end), b);
    move->angle = atan2(b[1] - a[1], b[0] - a[0]);
}

/** Slope dT/ds at moves[at] from a fit over moves from..to-1, and its standard error; 0: none. Of the
 *  residuals those farther apart than `apart` are independent. */
static int fit_slope(const struct kr_move *move, size_t from, size_t to, size_t at, int terms,
                     double apart, double width, double *slope, double *error) {
    struct kr_least fit = {.terms = terms};
    double x[KR_LEAST_MOST], inverse[KR_LEAST_MOST][KR_LEAST_MOST], residual, independent;
    for (size_t k = from; k < to; k++) {
        double u = (move[k].s - move[at].s) / width, power[3] = {1, u, u * u};
        if (move[k].is_alone)
            kr_least_add(&fit, power, move[k].time - move[at].time);
    }
    if (!kr_least_solve(&fit, x, inverse, &residual))
        return 0;
    independent = fmin(fit.count, 1 + (move[to - 1].s - move[from].s) / apart);
    *slope = x[1] / width;
    *error = sqrt(inverse[1][1] * residual / fmax(independent - terms, 1)) / width;
    return 1;
}

static void find_speed(const struct kr_record *record, struct kr_path *path, size_t at) {
    const double window = kr_path_window(record), apart = record->horizon;
    struct kr_move *move = path->move;
    size_t from = at, to = at + 1;
    double slope, error, chord;
    if (!move[at].is_alone)
        return;
    for (size_t k = at; k && move[at].s - move[k - 1].s <= window; k--)
        from = move[k - 1].is_alone ? k - 1 : from;
    for (size_t k = at + 1; k < path->count && move[k].s - move[at].s <= window; k++)
        to = move[k].is_alone ? k + 1 : to;
    chord = (move[to - 1].time - move[from].time) / (move[to - 1].s - move[from].s);
    if (to - from < LEAST_MOVES || move[to - 1].s - move[from].s < record->horizon ||
        !(chord > 0))
        return;
    if ((!fit_slope(move, from, to, at, 3, apart, window, &slope, &error) || slope < chord / 3) &&
        (!fit_slope(move, from, to, at, 2, apart, window, &slope, &error) || !(slope > 0)))
        return;
    move[at].speed = 1 / slope;
    move[at].error = error / (slope * slope);
}

void kr_path_follow(const struct kr_front *front, size_t count, const size_t *node,
                    const char *alone, struct kr_path *path) {
    find_moves(front, count, node, alone, path);
    for (size_t k = 0; k < path->count; k++) {
        find_direction(front->record, path, path->move + k);
        find_speed(front->record, path, k);
    }
}
