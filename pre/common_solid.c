/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What two solid cells have in common. See common_solid.h.
 *
 * A tetrahedron is cut by the four sides of the other one in turn. What is left behind a side is
 * a tetrahedron or a wedge, and a wedge is three tetrahedra.
 */
#include "common_solid.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

/* ---- two tetrahedra, each of four corners one after the other ---- */

static void between(const double *a, const double *b, double out[3]) {
    for (int d = 0; d < 3; d++)
        out[d] = b[d] - a[d];
}

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int d = 0; d < 3; d++)
        out[d] = a[(d + 1) % 3] * b[(d + 2) % 3] - a[(d + 2) % 3] * b[(d + 1) % 3];
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double signed_volume(const double *t) {
    double a[3], b[3], c[3], normal[3];
    between(t, t + 3, a);
    between(t, t + 6, b);
    between(t, t + 9, c);
    cross(a, b, normal);
    return dot(normal, c) / 6;
}

/* Normal of the side of a tetrahedron that does not have the corner `side`, towards that corner;
 * returns a corner of the side. */
static const double *inward(const double *t, size_t side, double normal[3]) {
    const double *foot = t + 3 * ((side + 1) % 4);
    double a[3], b[3];
    between(foot, t + 3 * ((side + 2) % 4), a);
    between(foot, t + 3 * ((side + 3) % 4), b);
    cross(a, b, normal);
    between(foot, t + 3 * side, a);
    if (dot(normal, a) < 0)
        for (int d = 0; d < 3; d++)
            normal[d] = -normal[d];
    return foot;
}

static double keep(const double *t, size_t side, const double *by);

/* The three tetrahedra of a wedge: of two triangles, one after the other. */
static double keep_wedge(const double *corner, size_t side, const double *by) {
    return keep(corner, side, by) + keep(corner + 3, side, by) + keep(corner + 6, side, by);
}

/* Where the edge from p to q crosses the plane from which they are so far away. */
static void cross_at(const double *p, const double *q, double p_away, double q_away, double *out) {
    double share = p_away / (p_away - q_away);
    for (int d = 0; d < 3; d++)
        out[d] = p[d] + share * (q[d] - p[d]);
}

/* Volume of what of `t` lies within the sides `side` to 3 of `by`: cut at that side, then go on. */
static double keep(const double *t, size_t side, const double *by) {
    double normal[3], off[3], away[4], part[18];
    size_t order[4], in = 0, out = 4;
    if (side == 4)
        return fabs(signed_volume(t));
    const double *foot = inward(by, side, normal);
    for (size_t k = 0; k < 4; k++) {
        between(foot, t + 3 * k, off);
        away[k] = dot(normal, off);
        order[away[k] > 0 ? in++ : --out] = k;
    }
    if (in == 0)
        return 0;
    if (in == 4)
        return keep(t, side + 1, by);
    /* One corner within: it and the cuts of its edges. Two: each with the cuts of its two edges. Three:
     * they, and the cuts of their edges to the fourth. */
    size_t at = 0;
    if (in != 2)
        for (size_t k = 0; k < in; k++)
            memcpy(part + 3 * at++, t + 3 * order[k], 3 * sizeof *part);
    for (size_t k = 0; k < in; k++) {
        if (in == 2)
            memcpy(part + 3 * at++, t + 3 * order[k], 3 * sizeof *part);
        for (size_t l = in; l < 4; l++)
            cross_at(t + 3 * order[k], t + 3 * order[l], away[order[k]], away[order[l]],
                     part + 3 * at++);
    }
    return in == 1 ? keep(part, side + 1, by) : keep_wedge(part, side + 1, by);
}

/* ---- a cell as signed tetrahedra ---- */

static struct kr_box box_of_tet(const double *t) {
    struct kr_box box;
    memcpy(box.lower, t, sizeof box.lower);
    memcpy(box.upper, t, sizeof box.upper);
    for (int k = 1; k < 4; k++)
        for (int d = 0; d < 3; d++) {
            box.lower[d] = fmin(box.lower[d], t[3 * k + d]);
            box.upper[d] = fmax(box.upper[d], t[3 * k + d]);
        }
    return box;
}

static const double *at(const struct kr_mesh *mesh, size_t point) {
    return mesh->point + 3 * point;
}

static void add_point(struct kr_cut_cell *cell, const double *point) {
    KR_GROW(cell->point, cell->n_points, cell->points_room);
    memcpy(cell->point[cell->n_points++], point, sizeof *cell->point);
}

static void add(struct kr_cut_cell *cell, const double *a, const double *b, const double *c,
                const double *d) {
    KR_GROW(cell->part, cell->count, cell->room);
    struct kr_cut_part *part = &cell->part[cell->count++];
    const double *corner[4] = {a, b, c, d};
    for (int k = 0; k < 4; k++)
        memcpy(part->corner + 3 * k, corner[k], 3 * sizeof *part->corner);
    part->volume = signed_volume(part->corner);
    part->box = box_of_tet(part->corner);
    cell->volume += part->volume;
}

/* The tetrahedra between the middle of a cell and the triangles of one of its faces. */
static void add_face(struct kr_cut_cell *cell, const struct kr_mesh *mesh, const double *middle,
                     size_t n, const size_t *vertex) {
    double corner[3 * KR_MOST_FACE], top[3];
    if (n == 3)
        add(cell, at(mesh, vertex[0]), at(mesh, vertex[1]), at(mesh, vertex[2]), middle);
    if (n <= 3)
        return;
    for (size_t k = 0; k < n; k++)
        memcpy(corner + 3 * k, at(mesh, vertex[k]), 3 * sizeof *corner);
    kr_solid_middle(n, corner, top);
    for (size_t k = 0; k < n; k++)
        add(cell, corner + 3 * k, corner + 3 * (k + 1 < n ? k + 1 : 0), top, middle);
    add_point(cell, top);
}

void kr_cut_cell(const struct kr_mesh *mesh, size_t which, struct kr_cut_cell *cell) {
    size_t n = mesh->first[which + 1] - mesh->first[which], face[KR_MOST_FACE];
    const size_t *v = mesh->vertex + mesh->first[which];
    double middle[3] = {0};
    cell->count = cell->n_points = 0;
    cell->volume = 0;
    cell->sides = n == 4 || kr_solid_is_pieces(n) ? 4 : 1;
    for (size_t k = 0; k < n; k++)
        add_point(cell, at(mesh, v[k]));
    if (cell->sides == 4) {
        for (size_t k = 0; k < n; k += 4)
            add(cell, at(mesh, v[k]), at(mesh, v[k + 1]), at(mesh, v[k + 2]), at(mesh, v[k + 3]));
        return;
    }
    for (size_t k = 0; k < n; k++)
        for (int d = 0; d < 3; d++)
            middle[d] += at(mesh, v[k])[d] / (double)n;
    for (size_t f = 0; f < kr_solid_n_faces(n); f++)
        add_face(cell, mesh, middle, kr_solid_face(n, v, f, face), face);
    cell->volume = fabs(cell->volume); /* faces look outwards, away from the middle */
}

void kr_cut_cell_free(struct kr_cut_cell *cell) {
    kr_free(cell->part);
    kr_free(cell->point);
}

/* ---- two cells ---- */

int kr_boxes_meet(const struct kr_box *a, const struct kr_box *b) {
    for (int d = 0; d < 3; d++)
        if (a->lower[d] >= b->upper[d] || b->lower[d] >= a->upper[d])
            return 0;
    return 1;
}

/* Whether no point is farther along the normal from the foot than `most`. */
static int is_behind(const struct kr_cut_cell *cell, const double *normal, const double *foot,
                     double sense, double most) {
    double off[3];
    for (size_t k = 0; k < cell->n_points; k++) {
        between(foot, cell->point[k], off);
        if (sense * dot(normal, off) > most)
            return 0;
    }
    return 1;
}

/* Whether the plane of some outer triangle of a has all of a on one side and all of b on the other. */
static int is_apart(const struct kr_cut_cell *a, const struct kr_cut_cell *b) {
    for (size_t k = 0; k < a->count; k++)
        for (size_t side = 4 - a->sides; side < 4; side++) {
            double normal[3];
            const double *foot = inward(a->part[k].corner, side, normal);
            double length = sqrt(dot(normal, normal)), rounding = 1e-9 * length * sqrt(length);
            if (is_behind(b, normal, foot, 1, rounding) &&
                is_behind(a, normal, foot, -1, rounding))
                return 1;
        }
    return 0;
}

double kr_cut_cells_common(const struct kr_cut_cell *a, const struct kr_cut_cell *b) {
    double sum = 0;
    if (is_apart(a, b) || is_apart(b, a))
        return 0;
    for (size_t k = 0; k < a->count; k++)
        for (size_t l = 0; l < b->count; l++) {
            const struct kr_cut_part *p = &a->part[k], *q = &b->part[l];
            if (p->volume == 0 || q->volume == 0 || !kr_boxes_meet(&p->box, &q->box))
                continue;
            double common = keep(p->corner, 0, q->corner);
            sum += (p->volume > 0) == (q->volume > 0) ? common : -common;
        }
    return sum;
}
