/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A plane mesh with a thickness: every cell becomes a prism in each of some equal layers, from z = 0
 * to the depth. The volumes are the areas times the layers', exactly.
 */
#ifndef KR_EXTRUDE_H
#define KR_EXTRUDE_H

#include "mesh.h"

/** The solid over a plane mesh, owned by the caller.
 *
 *    triangle       wedge
 *    quadrilateral  hexahedron; two wedges would do where it is not convex, but volume and
 *                   centroid are exact as it is
 *    polygon        polyhedron: the tetrahedra of the prisms over its triangles (element.h)
 *
 *  Cells stand layer by layer in the order of the plane mesh. A group of edges becomes one of
 *  faces; `front` (z = 0) and `back` (z = depth) are added, and `body` (all cells) for `plate`.
 *
 *  in  depth    m
 *  in  n_layers 1 or more
 */
struct kr_mesh *kr_mesh_extrude(const struct kr_mesh *plane, double depth, size_t n_layers);

#endif
