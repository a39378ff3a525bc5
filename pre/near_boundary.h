/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The near-boundary grid of the plates paper: squares of the lattice, and regions around the holes
 * that gmsh fills. Used by plate.c only.
 */
#ifndef KR_NEAR_BOUNDARY_H
#define KR_NEAR_BOUNDARY_H

#include "lattice.h"
#include "plate.h"

/** Mesh a plate whose holes have been checked; fills `report` but for times and exact area. Stops
 *  (exit 2) where the padding is below a spacing, (exit 5) where gmsh fails. */
struct kr_mesh *kr_near_boundary_mesh(const struct kr_plate *plate,
                                      const struct kr_lattice *lattice,
                                      struct kr_plate_report *report);

#endif
