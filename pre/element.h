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

#include "solid.h"

enum { KR_MOST_NODES = 27 };

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

#endif
