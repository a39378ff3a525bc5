/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What is wrong with a mesh from elsewhere, cell by cell, and what can be done about it.
 *
 *    repeated    a polygon names a vertex twice           mended: the repetition is dropped
 *    flat        no area or volume is left                mended: the cell is dropped
 *    inverted    a polygon that crosses itself, a solid   mended: its corners are put in order, if
 *                that is inside out                       that helps
 *    duplicate   a second cell with the same vertices     mended: the second one is dropped
 *    overlap     two cells share more than their rims     never mended: which of them is right?
 *    inner       a boundary facet that is not one of      mended: the facet is dropped
 *                just one cell
 *    orphan      a point that no cell has                 harmless; mended: dropped
 */
#ifndef KR_REPAIR_H
#define KR_REPAIR_H

#include "mesh.h"

/** Say what is wrong, the first few of each kind by tag and place, and mend it where `mend`. Stops
 *  (exit 2) if faults are left. Orphans alone are only a warning.
 *
 *  in   path   of the mesh, for messages
 */
void kr_mesh_repair(struct kr_mesh *mesh, const char *path, int mend);

/** In 2D, two cells whose common area is more than 1e-6 of the smaller one. Returns whether there are
 *  such; cell[0] < cell[1], `area` [m^2] is what they share. The lowest pair, if there are several. */
int kr_mesh_overlap(const struct kr_mesh *mesh, size_t cell[2], double *area);

/** The same for solids, by their volume [m^3]. Bent faces are the fans of solid.h. */
int kr_mesh_solids_overlap(const struct kr_mesh *mesh, size_t cell[2], double *volume);

/** Area [m^2] that two simple polygons, counter-clockwise and convex or not, have in common. */
double kr_polygons_common(size_t n, const double *a, size_t m, const double *b);

#endif
