/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Path and moves of a tip; the equations stand in path.h.
 */
#include "path.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"

/* Corners of the centre line in a horizon. */
enum { CORNERS = 4, WINDOW = 3, LEAST_MOVES = 5 };

double kr_path_window(const struct kr_record *record) {
    return WINDOW * record->horizon;
}

/* ---- centre line ------------------------------------------------------------------------- */

struct sums {
    double w, l, ll, x[2], lx[2];
};

static void add_to_sums(struct sums *sums, double weight, double l, const double *x) {
    sums->w += weight;
    sums->l += weight * l;
    sums->ll += weight * l * l;
    for (int a = 0; a < 2; a++) {
        sums->x[a] += weight * x[a];
        sums->lx[a] += weight * l * x[a];
    }
}

/** Value at l = 0 of the straight line through what was summed; the mean where all l are equal. */
static void value_at(const struct sums *sums, double x[2]) {
    double mean = sums->l / sums->w, spread = sums->ll / sums->w - mean * mean;
    for (int a = 0; a < 2; a++) {
        double middle = sums->x[a] / sums->w;
        double slope = (sums->lx[a] / sums->w - mean * middle) / spread;
        x[a] = spread > 1e-6 * sums->ll / sums->w ? middle - slope * mean : middle;
    }
}

/** Fit at the length l; nodes[from] is the first that may be near, moved on as l grows. */
static void fit_corner(const struct kr_front *front, size_t count, const size_t *node, double l,
                       double width, size_t *from, double x[2]) {
    struct sums sums = {0};
    while (*from < count && front->length[node[*from]] < l - 2 * width)
        ++*from;
    for (double half = width; !(sums.w > 0); half *= 2) {
        sums = (struct sums){0};
        for (size_t k = half > width ? 0 : *from; k < count; k++) {
            double d = (front->length[node[k]] - l) / half, weight = 1 - fabs(d * d * d);
            if (d >= 1)
                break;
            if (weight > 0)
                add_to_sums(&sums, weight * weight * weight, d, front->x + 3 * node[k]);
        }
    }
    value_at(&sums, x);
}

static void add_corner(struct kr_path *path, double l, const double x[2]) {
    size_t k = path->n++;
    memcpy(path->x + 2 * k, x, 2 * sizeof(double));
    path->length[k] = l;
    path->s[k] =
        k ? path->s[k - 1] + hypot(x[0] - path->x[2 * k - 2], x[1] - path->x[2 * k - 1]) : 0;
}

void kr_path_lay(const struct kr_front *front, size_t count, const size_t *node,
                 const double *anchor, struct kr_path *path) {
    const double width = front->record->horizon;
    double low = front->length[node[0]], high = front->length[node[count - 1]], x[2];
    size_t pieces = (size_t)fmax(1, ceil((high - low) / width * CORNERS)), from = 0;
    *path = (struct kr_path){.x = KR_NEW(double, 2 * pieces + 4), .s = KR_NEW(double, pieces + 2),
                             .length = KR_NEW(double, pieces + 2)};
    fit_corner(front, count, node, low, width, &from, x);
    if (anchor)
        add_corner(path, low - hypot(x[0] - anchor[0], x[1] - anchor[1]), anchor);
    for (size_t k = 0; k <= pieces; k++) {
        double l = low + (high - low) * (double)k / (double)pieces;
        fit_corner(front, count, node, l, width, &from, x);
        add_corner(path, l, x);
    }
}

/* ---- places on it ------------------------------------------------------------------------ */

/** Part of piece k at which a point is nearest; free beyond the last corner. */
static double part_of(const struct kr_path *path, size_t k, const double *x) {
    const double *a = path->x + 2 * k, *b = a + 2;
    double e[2] = {b[0] - a[0], b[1] - a[1]}, square = e[0] * e[0] + e[1] * e[1];
    double part = square > 0 ? ((x[0] - a[0]) * e[0] + (x[1] - a[1]) * e[1]) / square : 0;
    if (k + 2 < path->n)
        part = fmin(part, 1);
    return fmax(part, 0);
}

/** First corner with a length of at least l. */
static size_t corner_at(const struct kr_path *path, double l) {
    size_t lower = 0, upper = path->n;
    while (lower < upper) {
        size_t middle = (lower + upper) / 2;
        if (path->length[middle] < l)
            lower = middle + 1;
        else
            upper = middle;
    }
    return lower;
}

double kr_path_place(const struct kr_front *front, const struct kr_path *path, size_t node,
                     double *away) {
    const double *x = front->x + 3 * node, near = 3 * front->record->horizon;
    size_t from = corner_at(path, front->length[node] - near);
    size_t to = corner_at(path, front->length[node] + near);
    double least = INFINITY, s = 0;
    if (from + 1 >= path->n)
        from = path->n - 2;
    if (to >= path->n)
        to = path->n - 1;
    for (size_t k = from; k < to || k == from; k++) {
        const double *a = path->x + 2 * k, *b = a + 2;
        double part = part_of(path, k, x);
        double off = hypot(a[0] + part * (b[0] - a[0]) - x[0], a[1] + part * (b[1] - a[1]) - x[1]);
        if (off < least) {
            least = off;
            s = path->s[k] + part * (path->s[k + 1] - path->s[k]);
        }
    }
    if (away)
        *away = least;
    return s;
}

void kr_path_point(const struct kr_path *path, double s, double x[2]) {
    size_t k = 0, upper = path->n - 1;
    double part;
    while (upper - k > 1) {
        size_t middle = (k + upper) / 2;
        if (path->s[middle] <= s)
            k = middle;
        else
            upper = middle;
    }
    part = path->s[k + 1] > path->s[k] ? (s - path->s[k]) / (path->s[k + 1] - path->s[k]) : 0;
    for (size_t a = 0; a < 2; a++)
        x[a] = path->x[2 * k + a] + part * (path->x[2 * k + 2 + a] - path->x[2 * k + a]);
}

/* ---- moves ------------------------------------------------------------------------------- */

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

void kr_path_clear(struct kr_path *path) {
    kr_free(path->x);
    kr_free(path->s);
    kr_free(path->length);
    kr_free(path->move);
    *path = (struct kr_path){0};
}
