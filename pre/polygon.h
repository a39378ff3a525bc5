/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A body's outline as closed polygons with sides of about one spacing: what all grids but the
 * uniform one fill. It has just the area of the exact shape.
 *
 * A straight piece on a line of the lattice has its corners at the lattice's points, so that
 * squares fit it. Every loop has an even number of sides, so that quadrilaterals can fill it.
 */
#ifndef KR_POLYGON_H
#define KR_POLYGON_H

#include "lattice.h"
#include "shape.h"

struct kr_polygon {
    size_t n;       /* corners, and sides */
    double *point;  /* (n x 2) spacings */
    size_t *next;   /* (n) the corner after this one on its loop, the body on the left between */
    int *group;     /* (n) of the side from corner k to next[k] */
    int *on_line;   /* (n) whether that side lies on a line of the lattice */
    double area;    /* of the polygons */
};

/** Polygons of a shape.
 *
 *  Corners where the edge bends or the group changes stay where they are; a smooth run is cut into
 *  equal sides. Circles have their sides in fours. Bent runs are moved outward along their normals
 *  by what their chords lose, the same share of it everywhere, until the area is exact.
 *
 *  Stops (exit 2) where two polygons cross because their curves come too near each other.
 */
struct kr_polygon kr_polygon_of(const struct kr_shape *shape, const struct kr_lattice *lattice);

/** Halve a side; returns the number of the new corner, the last one. */
size_t kr_polygon_split(struct kr_polygon *polygon, size_t side);

void kr_polygon_free(struct kr_polygon *polygon);

/** The sides near each cell of a lattice: those whose box meets the cell's. */
struct kr_near_sides {
    size_t columns, rows;
    size_t *first; /* (columns * rows + 1) */
    size_t *side;
};

struct kr_near_sides kr_near_sides_of(const struct kr_polygon *polygon,
                                      const struct kr_lattice *lattice);
void kr_near_sides_free(struct kr_near_sides *near);

#endif
