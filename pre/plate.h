/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The mesh of a rectangular plate with circular holes, on either of two grids.
 *
 * near-boundary  squares of the lattice, and quadrilaterals by gmsh in boxes around the holes. A
 *                hole of radius R is a polygon of n sides whose corners stand at
 *                R' = R sqrt(theta / sin theta), theta = 2 pi/n: it has the area of the circle.
 * uniform        squares of the lattice whose centres lie outside every hole: a staircase.
 *
 * Cells of the lattice come first, row by row, then each region's. Groups: `left`, `right`,
 * `bottom`, `top`, `hole_1`, ... (edges) and `plate` (all cells).
 */
#ifndef KR_PLATE_H
#define KR_PLATE_H

#include "case.h"
#include "gmsh.h"
#include "mesh.h"

struct kr_plate {
    double width, height; /* m: lower left corner at (0, 0) */
    double spacing;       /* m: both sides are multiples of it */
    double padding;       /* m: from a hole to the rim of its box; near-boundary only */
    enum kr_grid grid;
    size_t n_holes;
    const struct kr_case_hole *hole; /* apart from each other and from the outline */
    struct kr_gmsh_options gmsh;
};

/** How a region was filled. */
struct kr_plate_region {
    char *name; /* "around hole_3" */
    const char *method;
    size_t n_cells, n_triangles;
    double seconds;
};

struct kr_plate_report {
    size_t n_lattice; /* the first cells of the mesh: exact squares */
    size_t n_regions;
    struct kr_plate_region *region;
    double exact_area;     /* m^2: rectangle less circles */
    double polygonal_area; /* m^2: rectangle less the holes' polygons (or squares) */
    double seconds;
};

/** Mesh a plate. Stops (exit 2) where the lattice does not fit, a hole cuts or touches the outline
 *  or another hole or is too small, or the padding is below a spacing; (exit 5) where gmsh fails.
 */
struct kr_mesh *kr_plate_mesh(const struct kr_plate *plate, struct kr_plate_report *report);

/** Number of sides of a hole's polygon: the multiple of 4, 8 at least, that brings them nearest to
 *  the spacing. Even, so that quadrilaterals can fill the region; in fours, so that the polygon
 *  has the circle's symmetry about both axes. */
size_t kr_plate_sides(double radius, double spacing);

/** Distance of the polygon's corners from its centre [m] with which it has the circle's area. */
double kr_plate_corner_radius(double radius, size_t sides);

void kr_plate_report_free(struct kr_plate_report *report);

#endif
