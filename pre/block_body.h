/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The solid that a grid is made for: the lattice of cubes, the surfaces that cut it, the boundaries'
 * names, and the function of each surface at the lattice's points.
 */
#ifndef KR_BLOCK_BODY_H
#define KR_BLOCK_BODY_H

#include "block.h"
#include "cutter.h"

struct kr_block_body {
    size_t n[3];    /* cells along x, y, z */
    double spacing; /* m */
    size_t n_groups;
    char **group;   /* names: the plate's, front, back, void_1, ... */
    int side[6];    /* groups of the block's sides: x low and high, y, z */
    int first_void;
    size_t n_cutters;
    struct kr_cutter *cutter;
    struct kr_plate_body flat;
};

/** Stops (exit 2) where the lattice does not fit, a shape makes no surface, or a body does not lie
 *  within the frame. */
struct kr_block_body *kr_block_body_of(const struct kr_block *block);
void kr_block_body_free(struct kr_block_body *body);

/** Volume [m^3] in closed form: of the plate or body less its voids where all of these lie inside and
 *  apart; else 0. */
double kr_block_body_volume(const struct kr_block_body *body);

static inline size_t kr_block_cell(const struct kr_block_body *body, size_t i, size_t j, size_t k) {
    return (k * body->n[1] + j) * body->n[0] + i;
}

/** Side of the block that a triangle lies in (0, 1: low, high along x; ...); -1: none. A surface that
 *  runs along a side leaves it to the side. */
int kr_block_side(const struct kr_block_body *body, const double *p, const double *q, const double *r);

/** A function at the points  first + whole numbers  from `low` to `high`; positive beyond. */
struct kr_field {
    long low[3], high[3];
    double first; /* 0: points of the lattice; 0.5: centres of its cells */
    double *value;
};

/** The field of a surface.
 *
 *  in  sharpen  lower the values by what linear interpolation in the tetrahedra of a cube is too large
 *               in the mean,  f - (D_x + D_y + D_z + D_111) f/24  with second differences D along the
 *               edges and the diagonal: then the volume is exact to a higher order (grids.md)
 *
 *  Values farther from the surface than a few spacings have the right sign and no more.
 */
struct kr_field kr_field_of(const struct kr_block_body *body, const struct kr_cutter *cutter,
                            double first, int sharpen);

/** Value at a point; a large positive one outside. */
double kr_field_at(const struct kr_field *field, long i, long j, long k);

#endif
