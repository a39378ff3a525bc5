/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The cells of the nodes in XDMF's mixed topology.
 */
#ifndef KR_TOPOLOGY_H
#define KR_TOPOLOGY_H

#include "nodes.h"

/** Words of all cells one after the other, owned by the caller; `count` of them:
 *
 *    4 triangle, 5 quadrilateral, 6 tetrahedron, 7 pyramid, 8 wedge, 9 hexahedron: number, corners
 *    3 polygon: 3, how many, corners
 *    16 polyhedron: 16, how many faces, for each: how many, corners
 *
 *  A wedge has VTK's order: the normal of its first triangle points outwards (see topology.c).
 *  Nodes in the middle of edges are left out: solids are shown by their corners. A polyhedron, which
 *  is kept as tetrahedra, is shown by the faces that only one of them has. */
int64_t *kr_topology_make(const struct kr_nodes *nodes, size_t *count);

#endif
