/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Random pores. Random sequential adsorption: a throw that fits stays, one that does not is forgotten.
 *
 * The generator is splitmix64 (G. L. Steele, D. Lea, C. H. Flood, Fast splittable pseudorandom number
 * generators, OOPSLA 2014): a counter and a mix, whole in its 64 bits of state.
 */
#include "pores.h"

#include <math.h>

static const double NANOMETRE = 1e-9;

/* Squares of nanometres outgrow 64 bits in plates of three metres. */
__extension__ typedef __int128 wide;

/* A pore in nanometres. */
struct pore {
    int64_t x, y, radius;
};

static uint64_t next(uint64_t *state) {
    uint64_t z = *state += UINT64_C(0x9E3779B97F4A7C15);
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return z ^ (z >> 31);
}

/* A whole number from least to most, both included. */
static int64_t between(uint64_t *state, int64_t least, int64_t most) {
    uint64_t span = (uint64_t)(most - least) + 1, highest = UINT64_MAX - UINT64_MAX % span, drawn;
    do /* the last, incomplete span would favour small numbers */
        drawn = next(state);
    while (drawn >= highest);
    return least + (int64_t)(drawn % span);
}

static int64_t nanometres(double metres) {
    return llround(metres / NANOMETRE);
}

/* Whether two pores keep the gap: centres apart by both radii and the gap, squared as integers. */
static int are_apart(const struct pore *a, const struct pore *b, int64_t gap) {
    wide dx = a->x - b->x, dy = a->y - b->y, least = a->radius + b->radius + gap;
    return dx * dx + dy * dy >= least * least;
}

static struct pore pore_of(const struct kr_case_hole *hole) {
    return (struct pore){nanometres(hole->centre[0]), nanometres(hole->centre[1]),
                         nanometres(hole->radius)};
}

/* One throw; 0 if a pore of that size has no place between the edges. */
static int throw_one(const struct kr_case_pores *pores, uint64_t *state, int64_t width,
                     int64_t height, struct pore *pore) {
    pore->radius = between(state, nanometres(pores->radius[0]), nanometres(pores->radius[1]));
    int64_t edge = llround(ceil(2 * pores->edge_diameters * (double)pore->radius));
    if (edge < pore->radius)
        edge = pore->radius;
    if (2 * edge > width || 2 * edge > height)
        return 0;
    pore->x = between(state, edge, width - edge);
    pore->y = between(state, edge, height - edge);
    return 1;
}

size_t kr_pores_throw(const struct kr_case_pores *pores, double width, double height,
                      struct kr_case_hole *hole, int64_t *throws) {
    uint64_t state = (uint64_t)pores->seed;
    const int64_t gap = nanometres(pores->gap);
    size_t placed = 0;
    for (*throws = 0; *throws < pores->attempts && placed < (size_t)pores->count; ++*throws) {
        struct pore pore;
        int fits = throw_one(pores, &state, nanometres(width), nanometres(height), &pore);
        for (size_t k = 0; k < placed && fits; k++) {
            struct pore other = pore_of(&hole[k]);
            fits = are_apart(&pore, &other, gap);
        }
        if (fits)
            hole[placed++] =
                (struct kr_case_hole){{(double)pore.x * NANOMETRE, (double)pore.y * NANOMETRE},
                                      (double)pore.radius * NANOMETRE};
    }
    return placed;
}
