/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Random pores. Random sequential adsorption: a throw that fits stays, one that does not is
 * forgotten.
 */
#include "pores.h"

#include "base/memory.h"
#include "pore_room.h"
#include "pore_size.h"
#include "random.h"

#include <math.h>

/* A quotient by a whole number is rounded just once, unlike a product with 1e-9. */
static const double NANOMETRES_A_METRE = 1e9;

/* Squares of nanometres outgrow 64 bits in plates of three metres. */
__extension__ typedef __int128 wide;

/* A pore, or a hole of the deck as the circle around it; nanometres. */
struct pore {
    int64_t x, y, z;
    struct kr_pore_size size;
    int goes_through; /* along z: a hole of the deck, or any pore of a plate */
};

/* What a throw needs. */
struct throwing {
    const struct kr_case *c;
    struct kr_room room;
    int64_t width, height, depth, gap;
    uint64_t state;
    size_t n, space; /* the deck's holes first */
    struct pore *pore;
};

static int64_t nanometres(double metres) {
    return llround(metres * NANOMETRES_A_METRE);
}

/* Whether two pores keep the gap: centres apart by both radii and the gap, squared as integers. */
static int are_apart(const struct pore *a, const struct pore *b, int64_t gap) {
    wide dx = a->x - b->x, dy = a->y - b->y, least = a->size.radius + b->size.radius + gap;
    wide dz = a->goes_through || b->goes_through ? 0 : a->z - b->z;
    return dx * dx + dy * dy + dz * dz >= least * least;
}

/* Draw the place of a pore; 0 if it does not fit there. */
static int place(struct throwing *t, struct pore *pore) {
    int64_t edge =
        llround(ceil(2 * t->c->pores.edge_diameters * (double)pore->size.radius));
    int64_t apart = pore->size.radius + (t->gap > 0 ? t->gap : 1);
    if (edge < apart)
        edge = apart;
    int is_sphere = t->c->pores.shape == KR_PORE_SPHERE;
    if (2 * edge > t->width || 2 * edge > t->height || (is_sphere && 2 * edge > t->depth))
        return 0;
    pore->x = kr_random_between(&t->state, edge, t->width - edge);
    pore->y = kr_random_between(&t->state, edge, t->height - edge);
    if (is_sphere)
        pore->z = kr_random_between(&t->state, edge, t->depth - edge);
    pore->goes_through = !is_sphere;
    for (size_t k = 0; k < t->n; k++)
        if (!are_apart(pore, &t->pore[k], t->gap))
            return 0;
    return kr_room_has(&t->room, pore->x, pore->y, edge);
}

static void keep(struct throwing *t, const struct pore *pore) {
    KR_GROW(t->pore, t->n, t->space);
    t->pore[t->n++] = *pore;
}

/* The deck's holes stand first among the pores; their radius is rounded up, so that the gap is
 * kept. */
static void take_holes(struct throwing *t) {
    const struct kr_case_hole *hole = t->c->holes.item;
    for (size_t k = 0; k < t->c->holes.count; k++) {
        double centre[2], radius = kr_case_hole_reach(&hole[k], centre);
        struct pore pore = {nanometres(centre[0]), nanometres(centre[1]), 0, {0}, 1};
        pore.size.radius = nanometres(radius) + 1;
        keep(t, &pore);
    }
}

static double area_of(const struct kr_pore_size *size) {
    return M_PI * ((double)size->radius / NANOMETRES_A_METRE) *
           ((double)size->shorter / NANOMETRES_A_METRE);
}

/* Every throw draws a size of its own. */
static void throw_count(struct throwing *t, struct kr_pores *out) {
    const size_t holes = t->n;
    out->wanted = (size_t)t->c->pores.count;
    while (out->throws < t->c->pores.attempts && t->n < holes + out->wanted) {
        struct pore pore = {.size = kr_pore_size_draw(&t->c->pores, &t->state)};
        out->throws++;
        if (place(t, &pore))
            keep(t, &pore);
    }
}

/* All sizes first, then a place for one after the other. */
static void throw_porosity(struct throwing *t, struct kr_pores *out) {
    struct kr_pore_size *size =
        kr_pore_sizes_draw(&t->c->pores, t->room.area, &t->state, &out->wanted);
    for (size_t k = 0; k < out->wanted; k++)
        out->wanted_area += area_of(&size[k]);
    for (size_t k = 0; k < out->wanted && out->throws < t->c->pores.attempts; out->throws++) {
        struct pore pore = {.size = size[k]};
        if (!place(t, &pore))
            continue;
        keep(t, &pore);
        k++;
    }
    kr_free(size);
}

static struct kr_case_hole hole_of(const struct kr_case *c, const struct pore *pore) {
    struct kr_case_hole hole = {
        {(double)pore->x / NANOMETRES_A_METRE, (double)pore->y / NANOMETRES_A_METRE},
        (double)pore->size.radius / NANOMETRES_A_METRE};
    if (c->pores.shape != KR_PORE_ELLIPSE)
        return hole;
    hole.shape = KR_HOLE_ELLIPSE;
    hole.radii[0] = hole.radius;
    hole.radii[1] = (double)pore->size.shorter / NANOMETRES_A_METRE;
    hole.angle = (double)pore->size.angle / 1000 * M_PI / 180;
    hole.radius = 0;
    return hole;
}

struct kr_pores kr_pores_throw(const struct kr_case *c) {
    struct throwing t = {.c = c,
                         .room = kr_room_of(c),
                         .width = nanometres(c->width),
                         .height = nanometres(c->height),
                         .depth = nanometres(c->depth),
                         .gap = nanometres(c->pores.gap),
                         .state = (uint64_t)c->pores.seed};
    struct kr_pores out = {.outline = t.room.area};
    take_holes(&t);
    if (c->pores.count)
        throw_count(&t, &out);
    else
        throw_porosity(&t, &out);
    out.placed = t.n - c->holes.count;
    out.hole = KR_NEW(struct kr_case_hole, out.placed);
    out.z = KR_NEW(double, out.placed);
    for (size_t k = 0; k < out.placed; k++) {
        out.z[k] = (double)t.pore[c->holes.count + k].z / NANOMETRES_A_METRE;
        out.hole[k] = hole_of(c, &t.pore[c->holes.count + k]);
        out.area += area_of(&t.pore[c->holes.count + k].size);
    }
    kr_room_free(&t.room);
    kr_free(t.pore);
    return out;
}

void kr_pores_free(struct kr_pores *pores) {
    kr_free(pores->hole);
    kr_free(pores->z);
    *pores = (struct kr_pores){0};
}
