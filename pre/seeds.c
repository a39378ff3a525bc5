/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Seeds and their cells. Neighbours come ring by ring; when a ring is farther than twice the
 * cell's farthest corner, no seed beyond can cut it.
 */
#include "seeds.h"

#include "base/memory.h"

#include <math.h>

struct kr_seeds kr_seeds_begin(const struct kr_lattice *lattice) {
    struct kr_seeds seeds = {.lattice = *lattice};
    seeds.first = KR_NEW(long, lattice->columns * lattice->rows);
    return seeds;
}

void kr_seeds_add(struct kr_seeds *seeds, double x, double y, enum kr_seed kind, size_t home) {
    KR_GROW(seeds->kind, seeds->n, seeds->kind_room);
    KR_GROW(seeds->home, seeds->n, seeds->home_room);
    KR_GROW(seeds->place, seeds->n, seeds->place_room);
    seeds->place[seeds->n][0] = x;
    seeds->place[seeds->n][1] = y;
    seeds->home[seeds->n] = home;
    seeds->kind[seeds->n++] = (unsigned char)kind;
}

static size_t clamp(double x, size_t most) {
    return x <= 0 ? 0 : x >= (double)most ? most - 1 : (size_t)x;
}

void kr_seeds_sort(struct kr_seeds *seeds) {
    size_t cells = seeds->lattice.columns * seeds->lattice.rows;
    if (seeds->next_room < seeds->n) {
        seeds->next_room = 2 * seeds->n;
        seeds->next = kr_realloc(seeds->next, seeds->next_room, sizeof *seeds->next);
    }
    for (size_t c = 0; c < cells; c++)
        seeds->first[c] = -1;
    for (size_t s = seeds->n; s-- > 0;) {
        size_t i = clamp(seeds->place[s][0], seeds->lattice.columns);
        size_t j = clamp(seeds->place[s][1], seeds->lattice.rows);
        long *first = &seeds->first[kr_lattice_cell(&seeds->lattice, i, j)];
        seeds->next[s] = *first;
        *first = (long)s;
    }
}

static double farthest(const struct kr_ring *cell, const double p[2]) {
    double most = 0;
    for (size_t k = 0; k < cell->n; k++) {
        double x = cell->point[k][0] - p[0], y = cell->point[k][1] - p[1];
        most = fmax(most, x * x + y * y);
    }
    return sqrt(most);
}

/** Halve a cell by all seeds that stand in a lattice cell; keeps `reach` up to date. */
static void halve_by(const struct kr_seeds *seeds, size_t c, size_t seed, struct kr_ring *cell,
                     struct kr_ring *spare, double *reach) {
    const double *p = seeds->place[seed];
    for (long s = seeds->first[c]; s >= 0; s = seeds->next[s]) {
        const double *q = seeds->place[s];
        if ((size_t)s == seed || hypot(q[0] - p[0], q[1] - p[1]) >= 2 * *reach)
            continue;
        kr_ring_halve(cell, spare, p, q, KR_SIDE_INNER);
        *reach = farthest(cell, p);
    }
}

void kr_seeds_cell(const struct kr_seeds *seeds, size_t seed, struct kr_ring *cell,
                   struct kr_ring *spare) {
    const struct kr_lattice *lattice = &seeds->lattice;
    const double *p = seeds->place[seed], far = KR_SEEDS_REACH;
    long i = (long)clamp(p[0], lattice->columns), j = (long)clamp(p[1], lattice->rows);
    double reach = sqrt(2) * far;
    cell->n = 0;
    kr_ring_add(cell, p[0] - far, p[1] - far, KR_SIDE_FAR);
    kr_ring_add(cell, p[0] + far, p[1] - far, KR_SIDE_FAR);
    kr_ring_add(cell, p[0] + far, p[1] + far, KR_SIDE_FAR);
    kr_ring_add(cell, p[0] - far, p[1] + far, KR_SIDE_FAR);
    for (long ring = 0; (double)ring - 1 < 2 * reach; ring++)
        for (long l = j - ring; l <= j + ring; l++)
            for (long k = i - ring; k <= i + ring; k += l == j - ring || l == j + ring ? 1 : 2 * ring) {
                if (k >= 0 && l >= 0 && k < (long)lattice->columns && l < (long)lattice->rows)
                    halve_by(seeds, kr_lattice_cell(lattice, (size_t)k, (size_t)l), seed, cell,
                             spare, &reach);
                if (ring == 0)
                    break;
            }
}

void kr_seeds_end(struct kr_seeds *seeds) {
    kr_free(seeds->place);
    kr_free(seeds->kind);
    kr_free(seeds->home);
    kr_free(seeds->first);
    kr_free(seeds->next);
    *seeds = (struct kr_seeds){.n = 0};
}
