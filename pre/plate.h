/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The mesh of a plate with holes, on one of several grids (docs/grids.md).
 *
 * near-boundary  squares of the lattice, and quadrilaterals by gmsh in boxes around the holes and
 *                wherever else an edge does not fit the lattice
 * uniform        squares of the lattice whose centres lie in the body: a staircase
 * free           quadrilaterals by gmsh everywhere
 * voronoi        squares of the lattice, near edges that do not fit it Voronoi cells cut by them
 *
 * But on the uniform grid, edges are polygons with sides of about a spacing and the exact area of
 * what they bound. A circle of radius R and n sides has its corners at R sqrt(theta / sin theta),
 * theta = 2 pi/n.
 *
 * Cells of the lattice come first, row by row, then each region's. Groups: `left`, `right`,
 * `bottom`, `top` (edges on the sides of width by height), `outline` or the names of its parts (all
 * other edges of the outline), `hole_1`, ... and `plate` (all cells). What has no edge has no group.
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
    const struct kr_case_hole *hole; /* they may overlap and cut the outline */
    struct kr_gmsh_options gmsh;
    int64_t lloyd_steps;            /* voronoi only */
    struct kr_case_outline outline; /* zeros: the rectangle of width by height */
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
    double exact_area;     /* m^2: of the curves */
    double polygonal_area; /* m^2: of the polygons, or squares, that the cells fill */
    double conformity; /* m: largest distance of an edge's middle or end from its true curve */
    double seconds;
};

/** Mesh a plate. Stops (exit 2) where the lattice does not fit, a shape makes no curve, a hole lies
 *  outside or is too small, two edges come too near each other or the padding is below a spacing;
 *  (exit 5) where gmsh fails. */
struct kr_mesh *kr_plate_mesh(const struct kr_plate *plate, struct kr_plate_report *report);

void kr_plate_report_free(struct kr_plate_report *report);

#endif
