/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The mesh of a solid: a plate with a depth, or the body of an STL file; with or without voids, on
 * one of the four grids (docs/grids.md).
 *
 * Without voids a plate's own mesh is extruded: exact to the last bits, on every grid. With them the
 * lattice of cubes is cut by the surfaces:
 *
 *    uniform        cubes whose centres lie in the body
 *    voronoi        cubes less all that lies in a void, what is left of less than half a cube joined
 *                   to a neighbour (cut_cells.h)
 *    near-boundary  cubes, and tetrahedra by gmsh in boxes around the voids (boxes_solid.h)
 *    free           tetrahedra by gmsh everywhere
 *
 * Groups: `left`, `right`, `bottom`, `top`, `front` (z = 0), `back` (z = depth), or `outline` where
 * the body is no block; `hole_1`, ...; `void_1`, ... (faces); `body` (all cells).
 */
#ifndef KR_BLOCK_H
#define KR_BLOCK_H

#include "plate.h"

struct kr_block {
    struct kr_plate plate;
    double depth; /* m: a multiple of the spacing */
    size_t n_voids;
    const struct kr_case_void *hollow; /* files as paths that can be opened */
    const struct kr_case_stl *body;    /* NULL: the plate with its holes */
};

struct kr_block_report {
    double exact_volume;  /* m^3: of the true surfaces; 0: not known in closed form */
    double filled_volume; /* m^3: of the facets that the cells fill; 0: not known apart */
    double conformity;    /* m: largest distance of the middle or a corner of a boundary face from
                             its true surface */
    double seconds;
    size_t n_regions;
    struct kr_plate_region *region;
};

/** Mesh a solid. Stops as kr_plate_mesh does; (exit 2) where a void is smaller than the grid can
 *  show, a file is no closed surface or does not lie within the frame. */
struct kr_mesh *kr_block_mesh(const struct kr_block *block, struct kr_block_report *report);

void kr_block_report_free(struct kr_block_report *report);

#endif
