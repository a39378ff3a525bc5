/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Boxes around the holes, snapped outward to the lattice and united where they touch: the regions
 * that gmsh fills. All else stays lattice.
 */
#ifndef KR_BOXES_H
#define KR_BOXES_H

#include "case.h"
#include "lattice.h"

#include <stdint.h>

/** A corner of a region's perimeter, at lattice point (i, j), and the number of lattice steps of
 *  the straight run that begins there. */
struct kr_region_corner {
    size_t i, j, run;
};

/** A closed piece of a region's perimeter, the region on its left. */
struct kr_region_loop {
    size_t n_corners;
    struct kr_region_corner *corner;
};

/** A connected set of lattice cells with all the holes in it. */
struct kr_region {
    size_t n_cells;
    size_t n_loops; /* the outer perimeter first; others go round lattice that the boxes enclose */
    struct kr_region_loop *loop;
    size_t n_holes;
    size_t *hole;
};

struct kr_regions {
    size_t count;
    struct kr_region *region; /* by their lowest, then leftmost cell */
    int32_t *of_cell;         /* (columns * rows) region of a lattice cell; -1: none */
};

/** Regions around the holes of a plate.
 *
 *  in  hole     (n_holes) inside the plate
 *  in  padding  [m] from the rim of a hole to its box, a spacing or more
 *
 *  Boxes are cut off at the plate. Cells that met only at a corner are joined by a third, so every
 *  perimeter is a simple closed line.
 */
struct kr_regions *kr_regions_create(const struct kr_lattice *lattice, size_t n_holes,
                                     const struct kr_case_hole *hole, double padding);

void kr_regions_free(struct kr_regions *regions);

#endif
