/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The near-boundary and the free grid of a solid: cubes of the lattice, and tetrahedra by gmsh in
 * boxes around the voids, or everywhere. The boxes have their sides on every other line of the
 * lattice, and are cut there into triangles over two spacings. Used by block.c only.
 */
#ifndef KR_BOXES_SOLID_H
#define KR_BOXES_SOLID_H

#include "block_body.h"

/** Mesh a solid. Stops where the padding is below two spacings (exit 2), and where gmsh cannot fill a
 *  region (exit 5). */
struct kr_mesh *kr_boxes_solid_mesh(const struct kr_block *block, const struct kr_block_body *body,
                                    struct kr_block_report *report);

#endif
