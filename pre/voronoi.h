/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The Voronoi grid: the lattice everywhere, and where an edge does not fit it Voronoi cells that the
 * edge cuts exactly. Nodes near such an edge make some of Lloyd's steps, each to the centroid of
 * its cell, so that their areas become even. Used by plate.c only.
 */
#ifndef KR_VORONOI_H
#define KR_VORONOI_H

#include "plate_body.h"

/** Mesh a plate. Stops (exit 2) where the padding is below a spacing, (exit 5) where the cells do
 *  not fill the body. */
struct kr_mesh *kr_voronoi_mesh(const struct kr_plate *plate, const struct kr_plate_body *body,
                                struct kr_plate_report *report);

#endif
