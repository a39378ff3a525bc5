/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A region's tetrahedra and the shells around them.
 */
#include "coarse.h"

#include "base/memory.h"
#include "poly.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { INNER = -1, SURFACE = KR_COARSE_SURFACE, FIRST_SIDE = -2 }; /* labels as in cut_cells.c */

/** A region in the making. Points are found by the ends of the edge that they cut. */
struct making {
    const struct kr_coarse *coarse;
    struct kr_solid_region r;
    size_t points_room, cells_room, triangles_room, groups_room;
    int *label; /* (triangles) SURFACE or the side of the block; INNER: perimeter */
    size_t table_size, *table; /* places plus 1 */
    size_t (*ends)[2], ends_room; /* (points) */
};

static size_t slot_of(const struct making *m, size_t p, size_t q) {
    uint64_t h = ((uint64_t)p * UINT64_C(0x9E3779B97F4A7C15)) ^ q;
    h = (h ^ (h >> 31)) * UINT64_C(0xBF58476D1CE4E5B9);
    size_t slot = (size_t)(h ^ (h >> 29)) & (m->table_size - 1);
    while (m->table[slot] &&
           (m->ends[m->table[slot] - 1][0] != p || m->ends[m->table[slot] - 1][1] != q))
        slot = (slot + 1) & (m->table_size - 1);
    return slot;
}

static void grow_table(struct making *m) {
    kr_free(m->table);
    m->table_size = m->table_size ? 4 * m->table_size : 1024;
    m->table = KR_NEW(size_t, m->table_size);
    for (size_t k = 0; k < m->r.n_points; k++)
        m->table[slot_of(m, m->ends[k][0], m->ends[k][1])] = k + 1;
}

/** The point where the edge from p to q is cut; p itself where both are p. */
static size_t point_on(struct making *m, size_t p, size_t q) {
    if (2 * m->r.n_points >= m->table_size)
        grow_table(m);
    size_t *number = &m->table[slot_of(m, p, q)];
    if (*number)
        return *number - 1;
    KR_GROW(m->r.point, m->r.n_points, m->points_room);
    KR_GROW(m->ends, m->r.n_points, m->ends_room);
    m->ends[m->r.n_points][0] = p;
    m->ends[m->r.n_points][1] = q;
    if (p == q)
        memcpy(m->r.point[m->r.n_points], m->coarse->place[p], sizeof *m->r.point);
    else
        kr_coarse_root(m->coarse->body, m->coarse->place[p], m->coarse->place[q],
                       m->r.point[m->r.n_points]);
    *number = ++m->r.n_points;
    return *number - 1;
}

static size_t point_of_vertex(struct making *m, const double weight[4], const size_t corner[4]) {
    size_t end[4], n = 0;
    for (size_t k = 0; k < 4; k++)
        if (weight[k] != 0)
            end[n++] = corner[k];
    if (n == 1)
        return point_on(m, end[0], end[0]);
    return m->coarse->value[end[0]] > 0 ? point_on(m, end[0], end[1]) : point_on(m, end[1], end[0]);
}

/** Region of the cell behind a side, 0 where it is not marked, -1 beyond the block. */
static long region_behind(const struct kr_coarse *coarse, size_t cell, int side) {
    const size_t step[3] = {1, coarse->n[0], coarse->n[0] * coarse->n[1]};
    size_t along = cell / step[side / 2] % coarse->n[side / 2];
    if (side % 2 ? along + 1 == coarse->n[side / 2] : along == 0)
        return -1;
    return (long)coarse->region[side % 2 ? cell + step[side / 2] : cell - step[side / 2]];
}

static void add_triangle(struct making *m, const size_t p[3], int label) {
    KR_GROW(m->r.triangle, m->r.n_triangles, m->triangles_room);
    KR_GROW(m->label, m->r.n_triangles, m->groups_room);
    memcpy(m->r.triangle[m->r.n_triangles], p, 3 * sizeof *p);
    m->label[m->r.n_triangles++] = label;
}

static void add_tetrahedron(struct making *m, size_t cell, size_t t) {
    const struct kr_kuhn *kuhn = &kr_kuhn[t];
    const int label[4] = {FIRST_SIDE - kuhn->side_of_first, INNER, INNER, FIRST_SIDE - kuhn->side_of_last};
    struct kr_poly poly;
    struct kr_poly_pieces pieces;
    size_t corner[4], point[KR_POLY_VERTICES];
    double value[4];
    kr_coarse_corners(m->coarse, cell, t, corner);
    for (size_t k = 0; k < 4; k++)
        value[k] = m->coarse->value[corner[k]];
    kr_poly_begin(&poly, kuhn->is_mirrored, label);
    kr_poly_clip(&poly, value, SURFACE);
    for (size_t v = 0; v < poly.n; v++)
        point[v] = point_of_vertex(m, poly.weight[v], corner);
    kr_poly_cut(&poly, point, &pieces);
    for (size_t k = 0; k < pieces.n_tetrahedra; k++) {
        KR_GROW(m->r.cell, m->r.n_cells, m->cells_room);
        for (size_t c = 0; c < 4; c++)
            m->r.cell[m->r.n_cells][c] = point[pieces.tetrahedron[k][c]];
        m->r.n_cells++;
    }
    for (size_t k = 0; k < pieces.n_triangles; k++) {
        const unsigned char *v = pieces.triangle[k];
        const size_t p[3] = {point[v[0]], point[v[1]], point[v[2]]};
        int side = pieces.label[k] <= FIRST_SIDE ? FIRST_SIDE - pieces.label[k] : -1;
        long other = side < 0 ? 0 : region_behind(m->coarse, cell, side);
        if (pieces.label[k] == SURFACE || other < 0)
            add_triangle(m, p, pieces.label[k]);
        else if (side >= 0 && other == 0)
            add_triangle(m, p, INNER);
    }
}

/* ---- triangles with a cell on both sides ---- */

struct sorted {
    size_t key[3], at;
};

static int by_key(const void *a, const void *b) {
    const struct sorted *p = a, *q = b;
    for (int k = 0; k < 3; k++)
        if (p->key[k] != q->key[k])
            return p->key[k] < q->key[k] ? -1 : 1;
    return (p->at > q->at) - (p->at < q->at);
}

/** Where the surface touches itself in a triangle, there is none: take both of them out. */
static void drop_doubled(struct making *m) {
    size_t n = m->r.n_triangles, kept = 0;
    struct sorted *item = KR_NEW(struct sorted, n);
    unsigned char *is_gone = KR_NEW(unsigned char, n);
    for (size_t t = 0; t < n; t++) {
        size_t *key = item[t].key;
        memcpy(key, m->r.triangle[t], sizeof item[t].key);
        item[t].at = t;
        for (int a = 0; a < 2; a++)
            for (int b = 0; b < 2 - a; b++)
                if (key[b] > key[b + 1]) {
                    size_t kept_key = key[b];
                    key[b] = key[b + 1];
                    key[b + 1] = kept_key;
                }
    }
    qsort(item, n, sizeof *item, by_key);
    for (size_t k = 1; k < n; k++)
        if (!memcmp(item[k].key, item[k - 1].key, sizeof item[k].key))
            is_gone[item[k].at] = is_gone[item[k - 1].at] = 1;
    for (size_t t = 0; t < n; t++) {
        if (is_gone[t])
            continue;
        memmove(m->r.triangle[kept], m->r.triangle[t], sizeof *m->r.triangle);
        m->label[kept++] = m->label[t];
    }
    m->r.n_triangles = kept;
    kr_free(item);
    kr_free(is_gone);
}

static int *groups_of(const struct making *m) {
    const struct kr_block_body *body = m->coarse->body;
    int *group = KR_NEW(int, m->r.n_triangles);
    for (size_t t = 0; t < m->r.n_triangles; t++) {
        const double *p = m->r.point[m->r.triangle[t][0]], *q = m->r.point[m->r.triangle[t][1]];
        const double *r = m->r.point[m->r.triangle[t][2]];
        double middle[3];
        size_t cutter;
        int side = m->label[t] == INNER ? -1 : kr_block_side(body, p, q, r);
        for (int d = 0; d < 3; d++)
            middle[d] = (p[d] + q[d] + r[d]) / 3;
        group[t] = -1;
        if (side >= 0)
            group[t] = body->side[side];
        else if (m->label[t] == SURFACE) {
            kr_coarse_value(body, middle, &cutter);
            group[t] = kr_cutter_group(&body->cutter[cutter], middle);
        }
    }
    return group;
}

/** Put the points of the shells first. */
static void sort_points(struct kr_solid_region *r) {
    size_t *place = KR_NEW(size_t, r->n_points), n = 0;
    double(*point)[3] = kr_alloc(r->n_points, sizeof *point);
    for (size_t k = 0; k < 3 * r->n_triangles; k++) {
        size_t *at = &r->triangle[k / 3][k % 3];
        if (!place[*at])
            place[*at] = ++n;
    }
    r->n_shell_points = n;
    for (size_t p = 0; p < r->n_points; p++) {
        if (!place[p])
            place[p] = ++n;
        memcpy(point[place[p] - 1], r->point[p], sizeof *point);
    }
    for (size_t k = 0; k < 3 * r->n_triangles; k++)
        r->triangle[k / 3][k % 3] = place[r->triangle[k / 3][k % 3]] - 1;
    for (size_t k = 0; k < 4 * r->n_cells; k++)
        r->cell[k / 4][k % 4] = place[r->cell[k / 4][k % 4]] - 1;
    kr_free(r->point);
    kr_free(place);
    r->point = point;
}

struct kr_solid_region kr_coarse_region(const struct kr_coarse *coarse, size_t region, int **group) {
    struct making m = {.coarse = coarse};
    for (size_t c = 0; c < coarse->n[0] * coarse->n[1] * coarse->n[2]; c++)
        for (size_t t = 0; t < 6 && coarse->region[c] == region; t++)
            add_tetrahedron(&m, c, t);
    drop_doubled(&m);
    kr_coarse_even(coarse, &m.r, m.label);
    *group = groups_of(&m);
    sort_points(&m.r);
    kr_free(m.label);
    kr_free(m.table);
    kr_free(m.ends);
    return m.r;
}
