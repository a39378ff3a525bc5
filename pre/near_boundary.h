/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The grids with cells by gmsh: the near-boundary grid of the plates paper, squares of the lattice
 * and regions around the edges that do not fit it; and the free grid, which is one region. Used by
 * plate.c only.
 */
#ifndef KR_NEAR_BOUNDARY_H
#define KR_NEAR_BOUNDARY_H

#include "plate_body.h"
#include "plate.h"

/** Mesh a plate on the grid it names; fills `report` but for times and exact area. Stops (exit 2)
 *  where the padding is below a spacing, (exit 5) where gmsh fails. */
struct kr_mesh *kr_near_boundary_mesh(const struct kr_plate *plate,
                                      const struct kr_plate_body *body,
                                      struct kr_plate_report *report);

#endif
