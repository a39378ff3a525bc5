/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What lies within a distance of a named boundary of the mesh: its edges in 2D, its faces in 3D.
 */
#ifndef KR_VICINITY_H
#define KR_VICINITY_H

#include "mesh.h"
#include "nodes.h"

/** Mark the nodes within a distance [m] of a boundary.
 *
 *  in   group  of the mesh, of edges (2D) or faces (3D)
 *  out  mark   (n) set to 1 where a node is near, else left
 *  returns     the boundary's length [m], in 3D its area [m^2]
 */
double kr_vicinity_mark(const struct kr_mesh *mesh, const struct kr_mesh_group *group,
                        const struct kr_nodes *nodes, double within, unsigned char *mark);

/** Distance [m] of a place from a triangle in space; a, b, c may lie in line or together. */
double kr_vicinity_distance(const double x[3], const double a[3], const double b[3],
                            const double c[3]);

#endif
