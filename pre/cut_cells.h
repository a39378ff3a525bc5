/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The cut grid: the lattice of cubes less all that lies behind the body's surfaces.
 *
 * A cube that a surface may cut is divided into the six tetrahedra around its diagonal (Kuhn), in
 * which each surface is the plane through the zeros of its function's linear interpolation. The
 * same points and planes are found from both sides of a face of the lattice, so the cells fill what
 * the facets bound without gap or overlap. What is left of a cube with less than half its volume is
 * joined to the neighbour with which it shares the largest face. Used by block.c only.
 */
#ifndef KR_CUT_CELLS_H
#define KR_CUT_CELLS_H

#include "block_body.h"

struct kr_mesh *kr_cut_cells_mesh(const struct kr_block_body *body);

/** The uniform grid: the cubes whose centres lie in the body. */
struct kr_mesh *kr_cubes_mesh(const struct kr_block_body *body);

#endif
