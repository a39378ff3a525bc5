/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The centre line of a path and places on it; see path.h. Its moves are in moves.c.
 */
#include "path.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

/* Corners of the centre line in a horizon. */
enum { CORNERS = 4, WINDOW = 3 };

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

double kr_path_nearest(const struct kr_path *path, double from, const double x[2], double *away) {
    double s = path->s[path->n - 1];
    *away = INFINITY;
    for (size_t k = 0; k + 1 < path->n; k++) {
        const double *a = path->x + 2 * k;
        double long_s = path->s[k + 1] - path->s[k], part = fmin(part_of(path, k, x), 1), off;
        if (path->s[k + 1] < from)
            continue;
        if (path->s[k] + part * long_s < from)
            part = (from - path->s[k]) / long_s;
        off = hypot(a[0] + part * (a[2] - a[0]) - x[0], a[1] + part * (a[3] - a[1]) - x[1]);
        if (off < *away) {
            *away = off;
            s = path->s[k] + part * long_s;
        }
    }
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

void kr_path_clear(struct kr_path *path) {
    kr_free(path->x);
    kr_free(path->s);
    kr_free(path->length);
    kr_free(path->move);
    *path = (struct kr_path){0};
}
