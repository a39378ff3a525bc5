/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Regions: what the marked cells hold of the body, as closed loops. Each is bounded by steps of the
 * lattice, where squares go on, and by sides of the body's polygon.
 */
#ifndef KR_REGION_H
#define KR_REGION_H

#include "lattice.h"
#include "polygon.h"

#include <stdint.h>

/** A closed piece of a region's perimeter, the region on its left, point by point. A point below
 *  the number of lattice points is a lattice point; others are corners of the polygon. */
struct kr_region_loop {
    size_t n;
    size_t *point;
    double area; /* spacings squared: positive for an outer loop */
};

struct kr_region {
    size_t n_loops; /* the outer one first */
    struct kr_region_loop *loop;
};

struct kr_regions {
    size_t count;
    struct kr_region *region; /* by the lowest, then leftmost cell at their perimeter */
};

/** Regions of a body.
 *
 *  in  holder   (lattice cells) 0 where the cell's centre is in the body
 *  in  marked   (lattice cells) not 0 where the cell is not to stay a square
 *
 *  Every cell that a polygon's side passes must be marked, unless the side lies on its edge.
 */
struct kr_regions kr_regions_of(const struct kr_lattice *lattice, const struct kr_polygon *polygon,
                                const int32_t *holder, const unsigned char *marked);

/** Number of a polygon's corner among the points: a lattice point where it stands on one. */
size_t kr_region_corner(const struct kr_lattice *lattice, const struct kr_polygon *polygon,
                        size_t corner);

/** Place of a point [spacings]. */
void kr_region_place(const struct kr_lattice *lattice, const struct kr_polygon *polygon,
                     size_t point, double place[2]);

/** Give each region an even number of sides, which quadrilaterals alone need to fill it: where it is odd, halve the
 *  longest of the polygon's sides at it. No other region has that side. */
void kr_regions_even(struct kr_regions *regions, const struct kr_lattice *lattice, struct kr_polygon *polygon);

void kr_regions_free(struct kr_regions *regions);

#endif
