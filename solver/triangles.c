/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Segment against triangles, in a binary tree of boxes split at the median.
 *
 * A segment meets a triangle where its ends are not on one side of the triangle's plane and its line
 * passes all three edges on one side. Sides are signs of volumes; a volume that may owe its sign to
 * rounding counts as zero, which is touching. So no segment slips through between two triangles.
 * (The bound: J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic, 1997, orient3d.)
 */
#include "triangles.h"

#include "base/memory.h"
#include "flat.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { IN_A_LEAF = 4, DEEPEST = 64 };

/* A box of the tree: a leaf holds triangles first to first + count - 1 of the order; the others have
 * their left half right behind them and their right half at `right`. */
struct box {
    double lower[3], upper[3];
    size_t first, count, right;
};

struct kr_triangles {
    size_t n, n_boxes, room;
    double *corner; /* (n x 9) */
    size_t *order;  /* (n) */
    struct box *box;
};

/* ---- the tree ---- */

static struct box box_of(const struct kr_triangles *t, size_t first, size_t count) {
    struct box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, first, count};
    double most = 0;
    for (size_t k = 0; k < count; k++)
        for (size_t c = 0; c < 9; c++) {
            double x = t->corner[9 * t->order[first + k] + c];
            box.lower[c % 3] = fmin(box.lower[c % 3], x);
            box.upper[c % 3] = fmax(box.upper[c % 3], x);
            most = fmax(most, fabs(x));
        }
    for (size_t d = 0; d < 3; d++) { /* what touches but for rounding must not be kept out */
        box.lower[d] -= 1e-15 * most;
        box.upper[d] += 1e-15 * most;
    }
    return box;
}

struct sorting {
    const double *corner;
    size_t axis;
};

static double place_of(const struct sorting *s, size_t triangle) {
    const double *c = s->corner + 9 * triangle + s->axis;
    return c[0] + c[3] + c[6];
}

static int by_place(const void *a, const void *b, void *context) {
    size_t i = *(const size_t *)a, j = *(const size_t *)b;
    double p = place_of(context, i), q = place_of(context, j);
    return p < q ? -1 : p > q ? 1 : (i > j) - (i < j);
}

static void build(struct kr_triangles *t, size_t first, size_t count) {
    size_t at = t->n_boxes, half = count / 2;
    struct box box = box_of(t, first, count);
    struct sorting sorting = {t->corner, 0};
    for (size_t d = 1; d < 3; d++)
        if (box.upper[d] - box.lower[d] >
            box.upper[sorting.axis] - box.lower[sorting.axis])
            sorting.axis = d;
    KR_GROW(t->box, t->n_boxes, t->room);
    t->box[t->n_boxes++] = box;
    if (count <= IN_A_LEAF)
        return;
    qsort_r(t->order + first, count, sizeof *t->order, by_place, &sorting);
    build(t, first, half);
    t->box[at].right = t->n_boxes;
    build(t, first + half, count - half);
}

struct kr_triangles *kr_triangles_create(size_t n, double *corner) {
    struct kr_triangles *t = KR_NEW(struct kr_triangles, 1);
    *t = (struct kr_triangles){.n = n, .corner = corner, .order = KR_NEW(size_t, n)};
    for (size_t k = 0; k < n; k++)
        t->order[k] = k;
    build(t, 0, n);
    return t;
}

void kr_triangles_free(struct kr_triangles *t) {
    kr_free(t->corner);
    kr_free(t->order);
    kr_free(t->box);
    kr_free(t);
}

void kr_triangles_box(const struct kr_triangles *t, double lower[3], double upper[3]) {
    memcpy(lower, t->box[0].lower, sizeof t->box[0].lower);
    memcpy(upper, t->box[0].upper, sizeof t->box[0].upper);
}

/* ---- one triangle ---- */

/* Six times the volume of the tetrahedron a b c d, 0 where rounding may have changed its sign: that of the
 * sum is below 1e-15 of the sum of the products' sizes, and corners written with twelve digits leave
 * 1e-12. */
static double volume(const double a[3], const double b[3], const double c[3], const double d[3]) {
    double m[3][3];
    for (int k = 0; k < 3; k++) {
        m[0][k] = b[k] - a[k];
        m[1][k] = c[k] - a[k];
        m[2][k] = d[k] - a[k];
    }
    double sum = 0, size = 0;
    for (int k = 0; k < 3; k++) {
        int e = (k + 1) % 3, f = (k + 2) % 3;
        sum += m[0][k] * (m[1][e] * m[2][f] - m[1][f] * m[2][e]);
        size += fabs(m[0][k]) * (fabs(m[1][e] * m[2][f]) + fabs(m[1][f] * m[2][e]));
    }
    return fabs(sum) <= 1e-12 * size ? 0 : sum;
}

/* A segment in the plane of a triangle: both are looked at along the axis nearest to the normal. */
static int meets_within(const double *corner, const double p[3], const double q[3]) {
    double normal[3], flat[6], from[2], to[2];
    size_t drop = 0;
    for (size_t d = 0; d < 3; d++) {
        size_t e = (d + 1) % 3, f = (d + 2) % 3;
        normal[d] = fabs((corner[3 + e] - corner[e]) * (corner[6 + f] - corner[f]) -
                         (corner[3 + f] - corner[f]) * (corner[6 + e] - corner[e]));
        drop = normal[d] > normal[drop] ? d : drop;
    }
    for (size_t d = 0; d < 2; d++) {
        size_t axis = (drop + 1 + d) % 3;
        for (size_t k = 0; k < 3; k++)
            flat[2 * k + d] = corner[3 * k + axis];
        from[d] = p[axis];
        to[d] = q[axis];
    }
    return kr_flat_meets(3, flat, from, to);
}

static int meets_triangle(const double *corner, const double p[3], const double q[3]) {
    const double *a = corner, *b = corner + 3, *c = corner + 6;
    double before = volume(a, b, c, p), behind = volume(a, b, c, q);
    if (before * behind > 0)
        return 0;
    if (before == 0 && behind == 0)
        return meets_within(corner, p, q);
    double ab = volume(p, q, a, b), bc = volume(p, q, b, c), ca = volume(p, q, c, a);
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

/* ---- all of them ---- */

static int is_apart(const struct box *box, const double p[3], const double q[3]) {
    for (int d = 0; d < 3; d++)
        if (fmin(p[d], q[d]) > box->upper[d] || fmax(p[d], q[d]) < box->lower[d])
            return 1;
    return 0;
}

int kr_triangles_meet(const struct kr_triangles *t, const double p[3], const double q[3]) {
    size_t waiting[DEEPEST], n = 0;
    waiting[n++] = 0;
    while (n) {
        size_t at = waiting[--n];
        const struct box *box = &t->box[at];
        if (is_apart(box, p, q))
            continue;
        for (size_t k = 0; !box->right && k < box->count; k++)
            if (meets_triangle(t->corner + 9 * t->order[box->first + k], p, q))
                return 1;
        if (box->right) {
            waiting[n++] = box->right;
            waiting[n++] = at + 1;
        }
    }
    return 0;
}
