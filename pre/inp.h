/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Input of Abaqus and CalculiX, for a finite element solution on the cells of a body.
 */
#ifndef KR_INP_H
#define KR_INP_H

#include "nodes.h"

/** Write corners, elements and sets; material, section, supports and loads are the reader's own
 *  (`*INCLUDE, INPUT=plate.inp`). Lengths in m, 13 digits; whole or not at all.
 *
 *  The corners are nodes 1, 2, ... in their order in the node file, the cell of node k is element
 *  k + 1: CPS3, CPS4 (plane stress) or C3D4, C3D6, C3D8, C3D10, C3D15, C3D20. A polygon of more
 *  corners is cut into CPS3 about a node in its centroid; they have numbers behind all cells'.
 *  All elements are in the ELSET `cells`; each set of nodes gives an ELSET of its cells and an NSET
 *  of their corners, under its own name. Stops (exit 2) where the nodes have no cells, or for a
 *  solid that CalculiX has no element for (pyramids, polyhedra). */
void kr_inp_write(const struct kr_nodes *nodes, const char *path);

#endif
