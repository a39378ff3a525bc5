/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Welding. See weld.h.
 */
#include "weld.h"

#include "base/memory.h"
#include "region.h"
#include "side.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Points nearer than this [spacings] are one: far above rounding; shorter sides mean nothing. */
static const double SAME = 1e-7;

static size_t lattice_points(const struct kr_weld *weld) {
    return (weld->lattice.columns + 1) * (weld->lattice.rows + 1);
}

void kr_weld_place(const struct kr_weld *weld, size_t point, double place[2]) {
    size_t n = lattice_points(weld) + weld->polygon->n;
    if (point < n)
        kr_region_place(&weld->lattice, weld->polygon, point, place);
    else
        memcpy(place, weld->other[point - n], sizeof weld->other[0]);
}

static size_t clamp(double x, size_t most) {
    return x <= 0 ? 0 : x >= (double)most ? most - 1 : (size_t)x;
}

static size_t cell_at(const struct kr_weld *weld, double x, double y) {
    return kr_lattice_cell(&weld->lattice, clamp(x, weld->lattice.columns),
                           clamp(y, weld->lattice.rows));
}

/** Put a point (not of the lattice) into the chain of its cell. */
static void enter(struct kr_weld *weld, size_t point) {
    size_t k = point - lattice_points(weld);
    double p[2];
    kr_weld_place(weld, point, p);
    if (k >= weld->next_room) {
        weld->next_room = 2 * k + 64;
        weld->next = kr_realloc(weld->next, weld->next_room, sizeof *weld->next);
    }
    long *first = &weld->first[cell_at(weld, p[0], p[1])];
    weld->next[k] = *first;
    *first = (long)point;
}

struct kr_weld kr_weld_begin(const struct kr_polygon *polygon, const struct kr_lattice *lattice) {
    struct kr_weld weld = {.polygon = polygon, .lattice = *lattice};
    size_t cells = lattice->columns * lattice->rows, n = lattice_points(&weld);
    weld.n_points = n + polygon->n;
    weld.first = KR_NEW(long, cells);
    for (size_t c = 0; c < cells; c++)
        weld.first[c] = -1;
    for (size_t k = 0; k < polygon->n; k++)
        if (kr_region_corner(lattice, polygon, k) >= n)
            enter(&weld, n + k);
    return weld;
}

/** The point at a place: one that is there, or a new one. */
static size_t point_at(struct kr_weld *weld, const double p[2]) {
    double i = nearbyint(p[0]), j = nearbyint(p[1]);
    size_t n = lattice_points(weld), seen[4], tried = 0;
    if (fabs(p[0] - i) < SAME && fabs(p[1] - j) < SAME)
        return kr_lattice_point(&weld->lattice, (size_t)i, (size_t)j);
    for (int k = 0; k < 4; k++) {
        size_t c = cell_at(weld, p[0] + (k % 2 ? SAME : -SAME), p[1] + (k / 2 ? SAME : -SAME));
        int again = 0;
        for (size_t s = 0; s < tried; s++)
            again |= seen[s] == c;
        if (again)
            continue;
        seen[tried++] = c;
        for (long q = weld->first[c]; q >= 0; q = weld->next[(size_t)q - n]) {
            double at[2];
            kr_weld_place(weld, (size_t)q, at);
            if (fabs(at[0] - p[0]) < SAME && fabs(at[1] - p[1]) < SAME)
                return (size_t)q;
        }
    }
    size_t others = weld->n_points - n - weld->polygon->n;
    KR_GROW(weld->other, others, weld->x_room);
    memcpy(weld->other[others], p, sizeof weld->other[0]);
    enter(weld, weld->n_points);
    return weld->n_points++;
}

void kr_weld_add(struct kr_weld *weld, const struct kr_ring *ring, int is_scrap) {
    struct kr_tile tile = {.is_scrap = is_scrap};
    for (size_t k = 0; k < ring->n; k++) {
        size_t point = point_at(weld, ring->point[k]);
        if (tile.n && tile.point[tile.n - 1] == point)
            tile.side[tile.n - 1] = ring->side[k]; /* the side between them has no length */
        else
            kr_tile_add(&tile, point, ring->side[k]);
    }
    while (tile.n > 1 && tile.point[0] == tile.point[tile.n - 1])
        tile.n--;
    if (tile.n < 3) {
        kr_tile_free(&tile);
        return;
    }
    KR_GROW(weld->tile, weld->n_tiles, weld->tiles_room);
    weld->tile[weld->n_tiles++] = tile;
}

/* ---- sides of tiles ---- */

/** The tiles as the arrays that side.h sorts. */
static struct kr_sides *sort_sides(const struct kr_weld *weld) {
    size_t total = 0, *first = KR_NEW(size_t, weld->n_tiles + 1), *vertex;
    for (size_t t = 0; t < weld->n_tiles; t++)
        first[t + 1] = total += weld->tile[t].n;
    vertex = KR_NEW(size_t, total);
    for (size_t t = 0; t < weld->n_tiles; t++)
        memcpy(vertex + first[t], weld->tile[t].point, weld->tile[t].n * sizeof *vertex);
    struct kr_sides *sides = kr_sides_create(weld->n_points, weld->n_tiles, first, vertex);
    kr_free(vertex);
    kr_free(first);
    return sides;
}

/** A point that lies on the way from a to b, and where. */
struct between {
    double share;
    size_t point;
};

static int by_share(const void *a, const void *b) {
    double x = ((const struct between *)a)->share, y = ((const struct between *)b)->share;
    return (x > y) - (x < y);
}

static size_t note_between(const struct kr_weld *weld, const double a[2], const double b[2],
                           size_t point, struct between *found, size_t n, size_t most) {
    double p[2], x = b[0] - a[0], y = b[1] - a[1], squared = x * x + y * y;
    kr_weld_place(weld, point, p);
    double share = ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / squared;
    double off = fabs((p[0] - a[0]) * y - (p[1] - a[1]) * x) / sqrt(squared);
    double edge = SAME / sqrt(squared);
    if (n == most || off > 2 * SAME || !(share > edge && share < 1 - edge))
        return n;
    found[n] = (struct between){share, point};
    return n + 1;
}

/** Points on the way from a to b, in order; at most 16. */
static size_t points_between(const struct kr_weld *weld, size_t from, size_t to,
                             struct between found[16]) {
    double a[2], b[2];
    size_t n = 0;
    kr_weld_place(weld, from, a);
    kr_weld_place(weld, to, b);
    double left = floor(fmin(a[0], b[0]) - SAME), right = fmax(a[0], b[0]) + SAME;
    double low = floor(fmin(a[1], b[1]) - SAME), high = fmax(a[1], b[1]) + SAME;
    for (double j = fmax(low, 0); j <= high && j <= (double)weld->lattice.rows; j++)
        for (double i = fmax(left, 0); i <= right && i <= (double)weld->lattice.columns; i++) {
            n = note_between(weld, a, b, kr_lattice_point(&weld->lattice, (size_t)i, (size_t)j),
                             found, n, 16);
            if (i >= (double)weld->lattice.columns || j >= (double)weld->lattice.rows)
                continue;
            size_t c = kr_lattice_cell(&weld->lattice, (size_t)i, (size_t)j);
            for (long q = weld->first[c]; q >= 0; q = weld->next[(size_t)q - lattice_points(weld)])
                n = note_between(weld, a, b, (size_t)q, found, n, 16);
        }
    qsort(found, n, sizeof *found, by_share);
    return n;
}

/** Where a side has no counterpart, corners of others may lie on it. Lattice points that no cell
 *  uses do no harm there: the squares beyond have them. */
static void insert_corners(struct kr_weld *weld, const struct kr_sides *sides, size_t t) {
    struct kr_tile *tile = &weld->tile[t], more = {.is_scrap = tile->is_scrap};
    for (size_t k = 0; k < tile->n; k++) {
        size_t from = tile->point[k], to = tile->point[k + 1 < tile->n ? k + 1 : 0], n = 0;
        struct between found[16];
        if (tile->side[k] == KR_SIDE_INNER && !kr_sides_find(sides, to, from, NULL))
            n = points_between(weld, from, to, found);
        kr_tile_add(&more, from, tile->side[k]);
        for (size_t m = 0; m < n; m++)
            kr_tile_add(&more, found[m].point, tile->side[k]);
    }
    kr_tile_free(tile);
    *tile = more;
}

/* ---- scraps ---- */

static double side_length(const struct kr_weld *weld, size_t from, size_t to) {
    double a[2], b[2];
    kr_weld_place(weld, from, a);
    kr_weld_place(weld, to, b);
    return hypot(b[0] - a[0], b[1] - a[1]);
}

/** Join a scrap to the neighbour over its longest side; if that makes no simple ring, to the next.
 *  One that fits nowhere stays a cell of its own. */
static void join_scrap(struct kr_weld *weld, const struct kr_sides *sides, size_t t) {
    struct kr_tile *scrap = &weld->tile[t];
    double limit = INFINITY;
    for (;;) {
        double longest = 0;
        size_t best = t;
        for (size_t k = 0; k < scrap->n; k++) {
            size_t from = scrap->point[k], to = scrap->point[k + 1 < scrap->n ? k + 1 : 0], other;
            double length = side_length(weld, from, to);
            if (length < limit && length > longest && kr_sides_find(sides, to, from, &other) &&
                weld->tile[other].n && !weld->tile[other].is_scrap) {
                longest = length;
                best = other;
            }
        }
        if (best == t)
            return;
        if (kr_tile_join(&weld->tile[best], scrap)) {
            kr_tile_free(scrap);
            return;
        }
        limit = longest;
    }
}

void kr_weld_close(struct kr_weld *weld) {
    struct kr_sides *sides = sort_sides(weld);
    for (size_t t = 0; t < weld->n_tiles; t++)
        insert_corners(weld, sides, t);
    kr_sides_free(sides);
    sides = sort_sides(weld);
    for (size_t t = 0; t < weld->n_tiles; t++)
        if (weld->tile[t].is_scrap)
            join_scrap(weld, sides, t);
    kr_sides_free(sides);
}

void kr_weld_end(struct kr_weld *weld) {
    for (size_t t = 0; t < weld->n_tiles; t++)
        kr_tile_free(&weld->tile[t]);
    kr_free(weld->tile);
    kr_free(weld->other);
    kr_free(weld->first);
    kr_free(weld->next);
    *weld = (struct kr_weld){0};
}
