/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Pre-cracks. See precrack.h.
 *
 * A node that stands on a line of a plate belongs to its left side, seen from its first corner to the next: it is moved
 * there by two billionths of the crack's length. By the numbers alone rounding would decide whether it keeps half of its
 * bonds or loses all of them.
 *
 * A polygon or disc lies in a plane: a bond meets it where its ends lie on two sides and the point
 * between them lies inside. Ends closer to the plane than a billionth of the crack's size lie in it, and
 * points as close to its rim are inside: bonds that touch by the numbers of the deck do so whatever the
 * rounding.
 */
#include "precrack.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/stl.h"
#include "flat.h"
#include "triangles.h"

#include <math.h>
#include <string.h>

static const double BARELY = 1e-9;

enum shape { LINE, POLYGON, DISC, SURFACE };

struct kr_precrack {
    enum shape shape;
    int dim;
    double lower[3], upper[3]; /* the box around it */
    size_t n;                  /* of corners */
    double *corner;            /* (n x 2): LINE, POLYGON */
    double origin[3], normal[3], radius, size;
    size_t across[2];          /* the two axes in which a polygon is looked at */
    struct kr_triangles *triangles;
};

/* ---- making one ---- */

static void make_box(struct kr_precrack *crack, size_t n, const double *point) {
    size_t dim = (size_t)crack->dim;
    for (size_t d = 0; d < dim; d++) {
        crack->lower[d] = INFINITY;
        crack->upper[d] = -INFINITY;
    }
    for (size_t k = 0; k < n * dim; k++) {
        crack->lower[k % dim] = fmin(crack->lower[k % dim], point[k]);
        crack->upper[k % dim] = fmax(crack->upper[k % dim], point[k]);
    }
}

static void make_line(struct kr_precrack *crack, size_t n, const double *point) {
    crack->n = n;
    crack->corner = KR_NEW(double, 2 * n);
    memcpy(crack->corner, point, 2 * n * sizeof *point);
    make_box(crack, n, point);
}

static void set_normal(struct kr_precrack *crack, const double normal[3]) {
    double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    size_t drop = 0;
    for (size_t d = 0; d < 3; d++) {
        crack->normal[d] = normal[d] / length;
        drop = fabs(normal[d]) > fabs(normal[drop]) ? d : drop;
    }
    crack->across[0] = (drop + 1) % 3;
    crack->across[1] = (drop + 2) % 3;
}

static void make_polygon(struct kr_precrack *crack, size_t n, const double *point) {
    double normal[3];
    kr_case_normal(n, point, normal);
    set_normal(crack, normal);
    make_box(crack, n, point);
    crack->n = n;
    crack->corner = KR_NEW(double, 2 * n);
    for (size_t k = 0; k < n; k++)
        for (size_t d = 0; d < 2; d++)
            crack->corner[2 * k + d] = point[3 * k + crack->across[d]];
    memcpy(crack->origin, point, sizeof crack->origin);
    for (size_t d = 0; d < 3; d++)
        crack->size = fmax(crack->size, crack->upper[d] - crack->lower[d]);
}

static void make_disc(struct kr_precrack *crack, const struct kr_case_crack *from) {
    set_normal(crack, from->normal);
    crack->radius = crack->size = from->radius;
    for (size_t d = 0; d < 3; d++) {
        double reach = from->radius * sqrt(fmax(0, 1 - crack->normal[d] * crack->normal[d]));
        crack->origin[d] = from->centre[d];
        crack->lower[d] = from->centre[d] - reach;
        crack->upper[d] = from->centre[d] + reach;
    }
}

static void make_surface(struct kr_precrack *crack, const char *path, double unit) {
    size_t count;
    double *corner = kr_stl_read(path, unit, &count);
    crack->triangles = kr_triangles_create(count, corner);
    kr_triangles_box(crack->triangles, crack->lower, crack->upper);
}

struct kr_precrack *kr_precrack_create(const struct kr_case_crack *from, const char *path) {
    struct kr_precrack *crack = KR_NEW(struct kr_precrack, 1);
    const double straight[] = {from->from[0], from->from[1], from->to[0], from->to[1]};
    *crack = (struct kr_precrack){.dim = 3};
    if (path) {
        crack->shape = SURFACE;
        make_surface(crack, path, from->unit);
    } else if (from->polygon.count) {
        crack->shape = POLYGON;
        make_polygon(crack, from->polygon.count / 3, from->polygon.item);
    } else if (from->radius > 0) {
        crack->shape = DISC;
        make_disc(crack, from);
    } else {
        crack->dim = 2;
        if (from->points.count)
            make_line(crack, from->points.count / 2, from->points.item);
        else
            make_line(crack, 2, straight);
    }
    return crack;
}

void kr_precrack_free(struct kr_precrack *crack) {
    if (crack->triangles)
        kr_triangles_free(crack->triangles);
    kr_free(crack->corner);
    kr_free(crack);
}

/* ---- asking one ---- */

/* The place of a node, left of the line from a to b where it stands on it. */
static void step_off(const double *p, const double *a, const double *b, double to[2]) {
    const double way[2] = {b[0] - a[0], b[1] - a[1]}, length = hypot(way[0], way[1]);
    double left = (way[0] * (p[1] - a[1]) - way[1] * (p[0] - a[0])) / length;
    double step = fabs(left) < BARELY * length ? 2 * BARELY : 0;
    to[0] = p[0] - step * way[1];
    to[1] = p[1] + step * way[0];
}

static int meets_line(const struct kr_precrack *crack, const double *p, const double *q) {
    double from[2], to[2];
    for (size_t k = 0; k + 1 < crack->n; k++) {
        const double *a = crack->corner + 2 * k, *b = a + 2;
        step_off(p, a, b, from);
        step_off(q, a, b, to);
        if (kr_flat_segments_meet(from, to, a, b))
            return 1;
    }
    return 0;
}

/* Height of a place over the crack's plane [m]. */
static double height_of(const struct kr_precrack *crack, const double p[3]) {
    double height = 0;
    for (int d = 0; d < 3; d++)
        height += crack->normal[d] * (p[d] - crack->origin[d]);
    return fabs(height) < BARELY * crack->size ? 0 : height;
}

/* A segment in the plane of the crack. */
static int meets_within(const struct kr_precrack *crack, const double p[3], const double q[3]) {
    if (crack->shape == POLYGON) {
        const size_t *axis = crack->across;
        const double from[2] = {p[axis[0]], p[axis[1]]}, to[2] = {q[axis[0]], q[axis[1]]};
        return kr_flat_meets(crack->n, crack->corner, from, to);
    }
    double along = 0, length = 0, square = 0;
    for (int d = 0; d < 3; d++) {
        along += (crack->origin[d] - p[d]) * (q[d] - p[d]);
        length += (q[d] - p[d]) * (q[d] - p[d]);
    }
    double share = fmin(fmax(along / length, 0), 1);
    for (int d = 0; d < 3; d++)
        square += pow(p[d] + share * (q[d] - p[d]) - crack->origin[d], 2);
    return square <= crack->radius * crack->radius;
}

/* A place in the plane of the crack. */
static int is_in(const struct kr_precrack *crack, const double x[3]) {
    double square = 0, near = BARELY * crack->size;
    if (crack->shape == POLYGON) {
        const double place[2] = {x[crack->across[0]], x[crack->across[1]]};
        return kr_flat_is_in(crack->n, crack->corner, place, near);
    }
    for (int d = 0; d < 3; d++)
        square += pow(x[d] - crack->origin[d], 2);
    return sqrt(square) <= crack->radius + near;
}

static int meets_plane(const struct kr_precrack *crack, const double p[3], const double q[3]) {
    double from = height_of(crack, p), to = height_of(crack, q), between[3];
    if (from * to > 0)
        return 0;
    if (from == 0 && to == 0)
        return meets_within(crack, p, q);
    for (int d = 0; d < 3; d++)
        between[d] = p[d] + from / (from - to) * (q[d] - p[d]);
    return is_in(crack, between);
}

int kr_precrack_meets(const struct kr_precrack *crack, const double *p, const double *q) {
    if (crack->shape == LINE)
        return meets_line(crack, p, q);
    return crack->shape == SURFACE ? kr_triangles_meet(crack->triangles, p, q)
                                   : meets_plane(crack, p, q);
}

/* ---- cutting ---- */

/* Whether some node of the slice is so near the crack that a bond may meet it. */
static int may_meet(const struct kr_precrack *crack, const struct kr_bonds *b, size_t slice) {
    /* Bonds are a little longer than the horizon; twice it is surely enough. */
    double reach = 2 * b->material.horizon;
    size_t end = slice * KR_LANES + KR_LANES < b->n ? slice * KR_LANES + KR_LANES : b->n;
    for (size_t i = slice * KR_LANES; i < end; i++) {
        int near = 1;
        for (int d = 0; d < b->dim; d++)
            near &= b->x[d][i] >= crack->lower[d] - reach && b->x[d][i] <= crack->upper[d] + reach;
        if (near)
            return 1;
    }
    return 0;
}

/* Whether a bond meets the crack, seen from the lower to the higher index: both ends must decide
 * alike. */
static int meets_bond(const struct kr_precrack *crack, const struct kr_bonds *b,
                      const struct kr_bond *bond) {
    size_t low = bond->i < bond->j ? bond->i : bond->j, high = bond->i + bond->j - low;
    double p[3], q[3];
    for (int d = 0; d < b->dim; d++) {
        p[d] = b->x[d][low];
        q[d] = b->x[d][high];
    }
    return kr_precrack_meets(crack, p, q);
}

size_t kr_precrack_cut(const struct kr_precrack *crack, struct kr_bonds *b, int count) {
    size_t ends = 0;
    kr_assert(b->dim == crack->dim);
#pragma omp parallel for schedule(dynamic, 64) reduction(+ : ends)
    for (size_t slice = 0; slice < b->n_slices; slice++) {
        if (!may_meet(crack, b, slice))
            continue;
        struct kr_bond_walk walk = kr_bonds_walk(b, slice);
        struct kr_bond bond;
        while (kr_bonds_next(b, &walk, &bond)) {
            if (!meets_bond(crack, b, &bond))
                continue;
            double volume = bond.weight * b->volume[bond.j];
            b->living[bond.row] &= (uint8_t)~(1u << bond.lane);
            if (count)
                b->lost_volume[bond.i] += volume;
            else
                b->family_volume[bond.i] -= volume;
            ends++;
        }
    }
    b->count -= ends;
    kr_bonds_find_twins(b);
    return ends / 2;
}

size_t kr_precrack_cut_line(struct kr_bonds *bonds, const double a[2], const double b[2],
                            int count) {
    struct kr_case_crack straight = {.from = {a[0], a[1]}, .to = {b[0], b[1]}};
    struct kr_precrack *crack = kr_precrack_create(&straight, NULL);
    size_t cut = kr_precrack_cut(crack, bonds, count);
    kr_precrack_free(crack);
    return cut;
}
