/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A mesh becomes nodes: one node a cell, at its centroid, with its area or volume.
 */
#ifndef KR_CONVERT_H
#define KR_CONVERT_H

#include "case.h"
#include "mesh.h"
#include "nodes.h"

/** Nodes, cells and sets of a mesh, in rows (the order in which the solver is fast). A group of cells
 *  becomes the set of its nodes; a group of boundary edges or faces the set of the nodes whose cells
 *  have one in it, with their length or area as the set's measure. `spacing` is the root of the
 *  median area, in 3D the cube root of the median volume. Stops (exit 2) if the mesh has no cells. */
struct kr_nodes *kr_convert(const struct kr_mesh *mesh);

/** Add the sets that the deck defines by place; one named like a boundary takes its place. An unknown
 *  boundary or an empty set is a fault of the deck. `mesh` NULL: the nodes came without one. */
void kr_convert_sets(struct kr_deck *deck, const struct kr_case *c, const struct kr_mesh *mesh,
                     struct kr_nodes *nodes);

/** Put nodes into rows: in 3D by z in steps of the spacing, then by y likewise, then by x. */
void kr_convert_order(struct kr_nodes *nodes);

/** Set `spacing` to the side of a square or cube of the median volume. */
void kr_convert_spacing(struct kr_nodes *nodes);

#endif
