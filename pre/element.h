/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The kinds of elements that mesh files hold, by the numbers that gmsh gives them, and the order in
 * which a mesh keeps their nodes.
 *
 * A mesh needs no kind: in 2D a cell is the polygon of its vertices, in 3D the number of vertices
 * tells what it is.
 *
 *    2D  polygon, counter-clockwise; nodes in the middle of sides are corners like all others
 *    3D  4 or 10 tetrahedron, 5 or 13 pyramid, 6 or 15 wedge, 8 or 20 hexahedron; corners first,
 *        then the middles of the edges, both in the order of VTK;
 *        24 or more, a multiple of 4: a polyhedron, cut into so many tetrahedra, one after the
 *        other (where fewer would do, one is cut in four about its middle)
 *
 * Nodes inside faces or cells (quadrilaterals of 9 nodes, hexahedra of 27, ...) are left out.
 */
#ifndef KR_ELEMENT_H
#define KR_ELEMENT_H

#include <stddef.h>

enum { KR_MOST_NODES = 27, KR_MOST_FACE = 8 };

struct kr_element {
    const char *name;
    int dim;
    size_t nodes;               /* in the file */
    size_t kept;                /* in the mesh */
    unsigned char keep[20];     /* (kept) which of the file's, in the order of the mesh */
};

/** The kind of this number of gmsh's; NULL for one that is not read. */
const struct kr_element *kr_element(int type);

/** Number of gmsh's for a cell or face of the mesh with so many vertices; 0 if it has none. */
int kr_element_type(int dim, size_t vertices);

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

#endif
