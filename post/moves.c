/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The moves of a tip along its path, and their speeds; the equations stand in path.h.
 */
#include "path.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

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

/** Solve the normal equations of a polynomial of `terms` <= 3 terms by Cholesky's factors; returns
 *  the slope at 0 and the square of its standard error for a unit of residual variance. 0: singular.
 */
static int solve(int terms, double matrix[3][3], double right[3], double *slope, double *variance) {
    double unit[3] = {0, 1, 0};
    for (int i = 0; i < terms; i++)
        for (int j = 0; j <= i; j++) {
            double sum = matrix[i][j];
            for (int k = 0; k < j; k++)
                sum -= matrix[i][k] * matrix[j][k];
            if (i == j && !(sum > 1e-9 * matrix[i][i]))
                return 0;
            matrix[i][j] = i == j ? sqrt(sum) : sum / matrix[j][j];
        }
    for (int i = 0; i < terms; i++) {
        for (int k = 0; k < i; k++) {
            right[i] -= matrix[i][k] * right[k];
            unit[i] -= matrix[i][k] * unit[k];
        }
        right[i] /= matrix[i][i];
        unit[i] /= matrix[i][i];
    }
    *slope = *variance = 0; /* unit . (L^-1 right) and unit . unit, both of the row of the slope */
    for (int i = 0; i < terms; i++) {
        *slope += unit[i] * right[i];
        *variance += unit[i] * unit[i];
    }
    return 1;
}

/** Slope dT/ds at moves[at] from a fit over moves from..to-1, and its standard error; 0: none. Of the
 *  residuals those farther apart than `apart` are independent. */
static int fit_slope(const struct kr_move *move, size_t from, size_t to, size_t at, int terms,
                     double apart, double width, double *slope, double *error) {
    double matrix[3][3] = {{0}}, right[3] = {0}, copy[3], sum = 0, variance, rest, fitted = 0;
    double independent;
    size_t used = 0;
    for (size_t k = from; k < to; k++) {
        double u = (move[k].s - move[at].s) / width, t = move[k].time - move[at].time;
        double power[3] = {1, u, u * u};
        if (!move[k].is_alone)
            continue;
        used++;
        for (int i = 0; i < terms; i++) {
            right[i] += power[i] * t;
            for (int j = 0; j <= i; j++)
                matrix[i][j] += power[i] * power[j];
        }
        sum += t * t;
    }
    memcpy(copy, right, sizeof copy);
    if (used < (size_t)terms + 2 || !solve(terms, matrix, copy, slope, &variance))
        return 0;
    for (int i = 0; i < terms; i++)
        fitted += copy[i] * copy[i];
    independent = fmin((double)used, 1 + (move[to - 1].s - move[from].s) / apart);
    rest = fmax(sum - fitted, 0) / fmax(independent - terms, 1);
    *slope /= width;
    *error = sqrt(variance * rest) / width;
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
