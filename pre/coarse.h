/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The lattice of doubled spacing under a solid, as far as tetrahedra will fill it: a tetrahedron with
 * edges of two spacings has about the volume of one cube. Its lines are 0, 2, 4, ... and the last.
 *
 * Its cells near the surfaces are marked (boxes around voids); each is divided into six tetrahedra, of
 * which what lies in the body is kept. Corners that an edge cuts near an end are moved there first
 * (isosurface stuffing, Labelle and Shewchuk 2007), so that no triangle of the surface is a sliver.
 * The triangles around what is kept are the shells that gmsh fills.
 */
#ifndef KR_COARSE_H
#define KR_COARSE_H

#include "block_body.h"
#include "gmsh_solid.h"

struct kr_coarse {
    const struct kr_block_body *body;
    size_t n[3];           /* cells along x, y, z */
    unsigned char *marked; /* (cells) */
    size_t *region;        /* (cells) number of the region of marked cells, from 1; 0: not marked */
    size_t n_regions;
    double (*place)[3];    /* (points) where they are now; spacings */
    double *value;         /* (points) of the body: the least of its surfaces' functions */
};

/** Mark cells and number the regions that touch.
 *
 *  in  padding  spacings around voids; negative: everything
 */
struct kr_coarse kr_coarse_of(const struct kr_block_body *body, double padding);
void kr_coarse_free(struct kr_coarse *coarse);

/** The lattice's number of a line. */
static inline size_t kr_coarse_line(const struct kr_coarse *coarse, int axis, size_t i) {
    return 2 * i < coarse->body->n[axis] ? 2 * i : coarse->body->n[axis];
}

/** The least of the surfaces' functions at a place, and the surface that gives it. */
double kr_coarse_value(const struct kr_block_body *body, const double p[3], size_t *cutter);

/** Where the edge from p, in the body, to q, outside, leaves it. */
void kr_coarse_root(const struct kr_block_body *body, const double p[3], const double q[3],
                    double place[3]);

/** Points at the corners of a tetrahedron of a cell. */
void kr_coarse_corners(const struct kr_coarse *coarse, size_t cell, size_t tetrahedron, size_t p[4]);

/** Move corners onto the surface. */
void kr_coarse_warp(struct kr_coarse *coarse);

/** A region: its shells, and the lattice's tetrahedra within.
 *
 *  out  group  (triangles) boundary that each belongs to, -1 on the perimeter; owned by the caller
 */
struct kr_solid_region kr_coarse_region(const struct kr_coarse *coarse, size_t region, int **group);

/** Label of a triangle on a surface of the body. */
enum { KR_COARSE_SURFACE = 0 };

/** Move the corners of a region's triangles on the surface (label: one a triangle) so that the volume behind them is right
 *  to a higher order. */
void kr_coarse_even(const struct kr_coarse *coarse, struct kr_solid_region *region, const int *label);

#endif
