/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Solid cells: the number of vertices tells the shape.
 *
 *    4 or 10 tetrahedron, 5 or 13 pyramid, 6 or 15 wedge, 8 or 20 hexahedron; corners first, then the
 *    middles of the edges, both in the order of VTK; 24 or more, a multiple of 4: a polyhedron, cut
 *    into so many tetrahedra, one after the other (where fewer would do, one is cut in four about
 *    its middle)
 *
 * The faces of solids need a rule, for four corners seldom lie in one plane. A triangle is flat. Any
 * other face is the fan of triangles between its sides and a point in its middle: where the shape
 * functions of the finite element put it,
 *
 *    4 corners                            mean of the corners
 *    3 corners, 3 middles of edges        4/9 sum of the middles - 1/9 sum of the corners
 *    4 corners, 4 middles of edges        1/2 sum of the middles - 1/4 sum of the corners
 *
 * The middle does not depend on which of two neighbours looks at the face, so conforming cells fill
 * a body without gaps and their volumes add up. For four corners the volume is also the mean of
 * both splits along a diagonal, and that of the trilinear hexahedron.
 */
#ifndef KR_SOLID_H
#define KR_SOLID_H

#include <stddef.h>
#include <stdint.h>

enum { KR_MOST_SOLID = 20, KR_MOST_FACE = 8 };

/** The shape of a solid cell. */
struct kr_solid {
    const char *name;
    size_t corners, n_edges, n_faces;
    unsigned char edge[12][2];       /* corners at the ends of each edge */
    unsigned char face_corners[6];   /* 3 or 4 */
    unsigned char face[6][4];        /* corners of each face, seen counter-clockwise from outside */
};

/** The shape of a solid with so many vertices; NULL if there is none. */
const struct kr_solid *kr_solid(size_t vertices);

/** Whether a cell of so many vertices is a polyhedron given as its tetrahedra. */
static inline int kr_solid_is_pieces(size_t vertices) {
    return vertices >= 24 && vertices % 4 == 0;
}

/** Number of faces of a solid with so many vertices, 0 if there is no such solid. A polyhedron has
 *  those of its tetrahedra: the ones inside it twice, in opposite senses. */
size_t kr_solid_n_faces(size_t vertices);

/** Vertices of a face of a solid cell, seen counter-clockwise from outside, with the middles of its
 *  edges between the corners. A corner that repeats the one before is left out.
 *
 *  in   n, cell   the cell's vertices
 *  in   face      below kr_solid_n_faces
 *  out  vertex    up to KR_MOST_FACE
 *  returns their number; less than 3: the face has collapsed
 */
size_t kr_solid_face(size_t n, const size_t *cell, size_t face, size_t *vertex);

/** The triangles on the outside of a polyhedron: sides of just one of its tetrahedra. Sides of two lie
 *  within it, where what they add to any sum over faces cancels.
 *
 *  in   n, cell   the vertices of its n/4 tetrahedra, as numbers that tell equal points
 *  out  triangle  (up to n x 3) places in `cell`, 0 to n - 1, counter-clockwise seen from outside
 *  returns their number
 */
size_t kr_solid_outside(size_t n, const int64_t *cell, unsigned short *triangle);

/** The point in the middle of a face, by the rule above.
 *
 *  in   n, point  3, 4, 6 or 8 vertices in their order (n x 3) m; any other number: the mean
 *  out  middle    (3) m
 */
void kr_solid_middle(size_t n, const double *point, double middle[3]);

/** Distance [m] from the origin of what of a cell is farthest: its vertices, or the middle of a bent
 *  face.
 *
 *  in  n, point  its vertices (n x 3) m
 *  in  vertices  m: the distance of the farthest vertex
 */
double kr_solid_radius(size_t n, const double *point, double vertices);

#endif
