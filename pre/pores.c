/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Random pores. Random sequential adsorption: a throw that fits stays, one that does not is
 * forgotten.
 *
 * The generator is splitmix64 (G. L. Steele, D. Lea, C. H. Flood, Fast splittable pseudorandom
 * number generators, OOPSLA 2014): a counter and a mix, whole in its 64 bits of state.
 */
#include "pores.h"

#include "base/memory.h"

#include <math.h>

/* A quotient by a whole number is rounded just once, unlike a product with 1e-9. */
static const double NANOMETRES_A_METRE = 1e9;

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
    return llround(metres * NANOMETRES_A_METRE);
}

/* Whether two pores keep the gap: centres apart by both radii and the gap, squared as integers. */
static int are_apart(const struct pore *a, const struct pore *b, int64_t gap) {
    wide dx = a->x - b->x, dy = a->y - b->y, least = a->radius + b->radius + gap;
    return dx * dx + dy * dy >= least * least;
}

/* One throw; 0 if a pore of that size has no place between the edges. */
static int throw_one(const struct kr_case *c, uint64_t *state, struct pore *pore) {
    const int64_t width = nanometres(c->width), height = nanometres(c->height);
    const int64_t gap = nanometres(c->pores.gap);
    int64_t least = nanometres(c->pores.radius[0]), most = nanometres(c->pores.radius[1]);
    pore->radius = between(state, least > 0 ? least : 1, most > 0 ? most : 1);
    int64_t edge = llround(ceil(2 * c->pores.edge_diameters * (double)pore->radius));
    int64_t apart = pore->radius + (gap > 0 ? gap : 1);
    if (edge < apart)
        edge = apart;
    if (2 * edge > width || 2 * edge > height)
        return 0;
    pore->x = between(state, edge, width - edge);
    pore->y = between(state, edge, height - edge);
    return 1;
}

/* The deck's holes stand first among the pores; their radius is rounded up, so that the gap is
 * kept. */
static size_t take_holes(const struct kr_case *c, struct pore *pore) {
    const struct kr_case_hole *hole = c->holes.item;
    for (size_t k = 0; k < c->holes.count; k++) {
        double centre[2], radius = kr_case_hole_reach(&hole[k], centre);
        pore[k] =
            (struct pore){nanometres(centre[0]), nanometres(centre[1]), nanometres(radius) + 1};
    }
    return c->holes.count;
}

size_t kr_pores_throw(const struct kr_case *c, struct kr_case_hole *hole, int64_t *throws) {
    uint64_t state = (uint64_t)c->pores.seed;
    const int64_t gap = nanometres(c->pores.gap);
    struct pore *pore = KR_NEW(struct pore, c->holes.count + (size_t)c->pores.count);
    const size_t holes = take_holes(c, pore);
    size_t placed = holes;
    for (*throws = 0; *throws < c->pores.attempts && placed < holes + (size_t)c->pores.count;
         ++*throws) {
        int fits = throw_one(c, &state, &pore[placed]);
        for (size_t k = 0; k < placed && fits; k++)
            fits = are_apart(&pore[placed], &pore[k], gap);
        placed += (size_t)fits;
    }
    for (size_t k = holes; k < placed; k++)
        hole[k - holes] = (struct kr_case_hole){
            {(double)pore[k].x / NANOMETRES_A_METRE, (double)pore[k].y / NANOMETRES_A_METRE},
            (double)pore[k].radius / NANOMETRES_A_METRE};
    kr_free(pore);
    return placed - holes;
}
