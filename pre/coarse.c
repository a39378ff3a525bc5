/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The coarse lattice: what is marked, and where its corners go.
 */
#include "coarse.h"

#include "base/memory.h"
#include "poly.h"

#include <math.h>
#include <string.h>

/* Corners nearer to the surface than this share of an edge are moved onto it. Half the way at which
 * moved corners of a tetrahedron could meet; larger shares turn tetrahedra inside out more often. */
static const double NEAR_END = 0.22;

double kr_coarse_value(const struct kr_block_body *body, const double p[3], size_t *cutter) {
    double least = 1e9;
    *cutter = 0;
    for (size_t c = 0; c < body->n_cutters; c++) {
        double value = kr_cutter_at(&body->cutter[c], p, NULL);
        if (value < least) {
            least = value;
            *cutter = c;
        }
    }
    return least;
}

static size_t cell_of(const struct kr_coarse *coarse, size_t i, size_t j, size_t k) {
    return (k * coarse->n[1] + j) * coarse->n[0] + i;
}

static size_t point_of(const struct kr_coarse *coarse, size_t i, size_t j, size_t k) {
    return (k * (coarse->n[1] + 1) + j) * (coarse->n[0] + 1) + i;
}

/* ---- marks ---- */

/** A box around a void, snapped outward. */
static void mark_box(struct kr_coarse *coarse, const double box[6], double padding) {
    size_t low[3], high[3];
    for (int d = 0; d < 3; d++) {
        double from = floor((box[d] - padding) / 2 + 1e-6), to = ceil((box[3 + d] + padding) / 2 - 1e-6);
        low[d] = from > 0 ? (size_t)from : 0;
        high[d] = to < 0 ? 0 : to < (double)coarse->n[d] ? (size_t)to : coarse->n[d];
    }
    for (size_t k = low[2]; k < high[2]; k++)
        for (size_t j = low[1]; j < high[1]; j++)
            for (size_t i = low[0]; i < high[0]; i++)
                coarse->marked[cell_of(coarse, i, j, k)] = 1;
}

/** All cells that a surface comes near to. */
static void mark_near(struct kr_coarse *coarse, const struct kr_cutter *cutter, double padding) {
    for (size_t c = 0; c < coarse->n[0] * coarse->n[1] * coarse->n[2]; c++) {
        const double centre[3] = {2 * (double)(c % coarse->n[0]) + 1,
                                  2 * (double)(c / coarse->n[0] % coarse->n[1]) + 1,
                                  2 * (double)(c / coarse->n[0] / coarse->n[1]) + 1};
        if (!coarse->marked[c] && kr_cutter_at(cutter, centre, NULL) < padding + sqrt(3))
            coarse->marked[c] = 1;
    }
}

/** Whether the cells of one kind among eight around a point hang together by faces. */
static int hang_together(unsigned eight) {
    unsigned reached = eight & -eight, before = 0;
    while (reached != before) {
        before = reached;
        for (unsigned c = 0; c < 8; c++)
            for (unsigned d = 0; d < 3 && reached >> c & 1; d++)
                reached |= eight & 1u << (c ^ 1u << d);
    }
    return reached == eight;
}

/** Mark all cells around a point where marked ones, or the others, meet only at it or at an edge: then
 *  every perimeter is a simple closed surface. Returns how many points it was. */
static size_t repair_contacts(struct kr_coarse *coarse) {
    size_t repaired = 0, p[3];
    for (p[2] = 0; p[2] <= coarse->n[2]; p[2]++)
        for (p[1] = 0; p[1] <= coarse->n[1]; p[1]++)
            for (p[0] = 0; p[0] <= coarse->n[0]; p[0]++) {
                unsigned char *cell[8] = {NULL};
                unsigned eight = 0;
                for (size_t c = 0; c < 8; c++) {
                    size_t i = p[0] + (c & 1) - 1, j = p[1] + (c >> 1 & 1) - 1, k = p[2] + (c >> 2) - 1;
                    if (i >= coarse->n[0] || j >= coarse->n[1] || k >= coarse->n[2])
                        continue; /* 0 less one is large */
                    cell[c] = &coarse->marked[cell_of(coarse, i, j, k)];
                    eight |= (unsigned)*cell[c] << c;
                }
                if (hang_together(eight) && hang_together(~eight & 255u))
                    continue;
                for (size_t c = 0; c < 8; c++)
                    if (cell[c])
                        *cell[c] = 1;
                repaired++;
            }
    return repaired;
}

static void number_regions(struct kr_coarse *coarse) {
    size_t cells = coarse->n[0] * coarse->n[1] * coarse->n[2], *stack = KR_NEW(size_t, cells);
    const size_t step[3] = {1, coarse->n[0], coarse->n[0] * coarse->n[1]};
    for (size_t c = 0; c < cells; c++) {
        size_t deep = 0;
        if (!coarse->marked[c] || coarse->region[c])
            continue;
        coarse->region[c] = ++coarse->n_regions;
        for (stack[deep++] = c; deep;) {
            size_t at = stack[--deep];
            for (int s = 0; s < 6; s++) {
                size_t along = at / step[s / 2] % coarse->n[s / 2], to = at;
                if (s % 2 ? along + 1 == coarse->n[s / 2] : along == 0)
                    continue;
                to = s % 2 ? at + step[s / 2] : at - step[s / 2];
                if (coarse->marked[to] && !coarse->region[to]) {
                    coarse->region[to] = coarse->n_regions;
                    stack[deep++] = to;
                }
            }
        }
    }
    kr_free(stack);
}

static void evaluate(struct kr_coarse *coarse) {
    const size_t *n = coarse->n;
#pragma omp parallel for schedule(dynamic)
    for (size_t k = 0; k <= n[2]; k++)
        for (size_t j = 0; j <= n[1]; j++)
            for (size_t i = 0; i <= n[0]; i++) {
                size_t p = point_of(coarse, i, j, k), cutter;
                const size_t line[3] = {kr_coarse_line(coarse, 0, i), kr_coarse_line(coarse, 1, j),
                                        kr_coarse_line(coarse, 2, k)};
                for (int d = 0; d < 3; d++)
                    coarse->place[p][d] = (double)line[d];
                coarse->value[p] = kr_coarse_value(coarse->body, coarse->place[p], &cutter);
                if (fabs(coarse->value[p]) < 1e-9)
                    coarse->value[p] = 0;
            }
}

struct kr_coarse kr_coarse_of(const struct kr_block_body *body, double padding) {
    struct kr_coarse coarse = {.body = body};
    size_t cells = 1, points = 1;
    for (int d = 0; d < 3; d++) {
        coarse.n[d] = (body->n[d] + 1) / 2;
        cells *= coarse.n[d];
        points *= coarse.n[d] + 1;
    }
    coarse.marked = KR_NEW(unsigned char, cells);
    coarse.region = KR_NEW(size_t, cells);
    coarse.place = kr_alloc(points, sizeof *coarse.place);
    coarse.value = KR_NEW(double, points);
    if (padding < 0)
        memset(coarse.marked, 1, cells);
    for (size_t c = 0; c < body->n_cutters && padding >= 0; c++) {
        double box[6];
        kr_cutter_box(&body->cutter[c], box);
        if (isfinite(box[0]) && body->cutter[c].kind != KR_CUTTER_PLATE && !body->cutter[c].is_body)
            mark_box(&coarse, box, padding);
        else
            mark_near(&coarse, &body->cutter[c], padding);
    }
    while (repair_contacts(&coarse)) /* a new cell may make a new contact */
        ;
    number_regions(&coarse);
    evaluate(&coarse);
    return coarse;
}

void kr_coarse_free(struct kr_coarse *coarse) {
    kr_free(coarse->marked);
    kr_free(coarse->region);
    kr_free(coarse->place);
    kr_free(coarse->value);
}

/* ---- moving corners ---- */

/** Whether a step keeps a point on the sides of the block that it lies on. */
static int stays(const struct kr_coarse *coarse, const size_t at[3], const int step[3]) {
    for (int d = 0; d < 3; d++)
        if (step[d] && (at[d] == 0 || at[d] == coarse->n[d]))
            return 0;
    return 1;
}

static void place_of(const struct kr_coarse *coarse, const size_t at[3], double place[3]) {
    for (int d = 0; d < 3; d++)
        place[d] = (double)kr_coarse_line(coarse, d, at[d]);
}

/** The nearest cut among the edges of a point, if it is near this end: share of the edge, and the
 *  point at its other end. */
static double nearest_cut(const struct kr_coarse *coarse, const double *value, const size_t at[3],
                          size_t other[3]) {
    static const int edge[7][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0},
                                   {0, 1, 1}, {1, 0, 1}, {1, 1, 1}};
    double least = NEAR_END, here = value[point_of(coarse, at[0], at[1], at[2])];
    for (int e = 0; e < 14; e++) {
        int step[3], inside = 1;
        size_t to[3];
        for (int d = 0; d < 3; d++) {
            step[d] = e < 7 ? edge[e][d] : -edge[e - 7][d];
            to[d] = at[d] + (size_t)step[d];
            inside &= to[d] <= coarse->n[d]; /* 0 less one is large */
        }
        if (!inside || !stays(coarse, at, step))
            continue;
        double there = value[point_of(coarse, to[0], to[1], to[2])];
        if (here * there < 0 && here / (here - there) < least) {
            least = here / (here - there);
            memcpy(other, to, sizeof to);
        }
    }
    return least;
}

void kr_coarse_root(const struct kr_block_body *body, const double p[3], const double q[3],
                    double place[3]) {
    double low = 0, high = 1; /* positive at low */
    size_t cutter;
    for (int step = 0; step < 40; step++) {
        double t = (low + high) / 2;
        for (int d = 0; d < 3; d++)
            place[d] = p[d] + t * (q[d] - p[d]);
        *(kr_coarse_value(body, place, &cutter) > 0 ? &low : &high) = t;
    }
}

static double volume_at(const struct kr_coarse *coarse, const size_t p[4]) {
    double u[3][3];
    for (int k = 0; k < 3; k++)
        for (int d = 0; d < 3; d++)
            u[k][d] = coarse->place[p[k + 1]][d] - coarse->place[p[0]][d];
    return (u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1]) +
            u[0][1] * (u[1][2] * u[2][0] - u[1][0] * u[2][2]) +
            u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0])) / 6;
}

void kr_coarse_corners(const struct kr_coarse *coarse, size_t cell, size_t tetrahedron, size_t p[4]) {
    size_t i = cell % coarse->n[0], j = cell / coarse->n[0] % coarse->n[1];
    size_t k = cell / coarse->n[0] / coarse->n[1];
    for (size_t c = 0; c < 4; c++) {
        unsigned bits = kr_kuhn[tetrahedron].corner[c];
        p[c] = point_of(coarse, i + (bits & 1u), j + (bits >> 1 & 1u), k + (bits >> 2 & 1u));
    }
}

/** Put back the corners of tetrahedra that the moves have made flat; returns how many. */
static size_t put_back(struct kr_coarse *coarse, const double *value) {
    size_t flat = 0, corners[4];
    for (size_t c = 0; c < coarse->n[0] * coarse->n[1] * coarse->n[2]; c++)
        for (size_t t = 0; t < 6 && coarse->marked[c]; t++) {
            kr_coarse_corners(coarse, c, t, corners);
            double volume = volume_at(coarse, corners) * (kr_kuhn[t].is_mirrored ? -1 : 1);
            if (volume > 0.05)
                continue;
            for (size_t k = 0; k < 4; k++) {
                size_t p = corners[k];
                if (coarse->value[p] != 0 || value[p] == 0)
                    continue;
                const size_t at[3] = {p % (coarse->n[0] + 1), p / (coarse->n[0] + 1) % (coarse->n[1] + 1),
                                      p / (coarse->n[0] + 1) / (coarse->n[1] + 1)};
                place_of(coarse, at, coarse->place[p]);
                coarse->value[p] = value[p];
                flat++;
            }
        }
    return flat;
}

void kr_coarse_warp(struct kr_coarse *coarse) {
    size_t points = (coarse->n[0] + 1) * (coarse->n[1] + 1) * (coarse->n[2] + 1), at[3], to[3];
    double *value = KR_NEW(double, points), *old = KR_NEW(double, points), from[3], other[3];
    memcpy(value, coarse->value, points * sizeof *value);
    memcpy(old, coarse->value, points * sizeof *value);
    for (at[2] = 0; at[2] <= coarse->n[2]; at[2]++)
        for (at[1] = 0; at[1] <= coarse->n[1]; at[1]++)
            for (at[0] = 0; at[0] <= coarse->n[0]; at[0]++) {
                size_t p = point_of(coarse, at[0], at[1], at[2]);
                if (value[p] == 0 || !(nearest_cut(coarse, value, at, to) < NEAR_END))
                    continue;
                place_of(coarse, at, from);
                place_of(coarse, to, other);
                kr_coarse_root(coarse->body, value[p] > 0 ? from : other, value[p] > 0 ? other : from,
                               coarse->place[p]);
                coarse->value[p] = value[p] = 0; /* its edges are no longer cut */
            }
    while (put_back(coarse, old))
        ;
    kr_free(value);
    kr_free(old);
}
