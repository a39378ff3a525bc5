/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Boxes around holes and around edges that do not fit the lattice, snapped outward to it: the cells
 * that gmsh fills. All else stays lattice.
 */
#ifndef KR_BOXES_H
#define KR_BOXES_H

#include "lattice.h"

/** Mark the cells of boxes.
 *
 *  in      box      (n x 4) left, bottom, right, top, in spacings; cut off at the lattice
 *  in      padding  spacings added on every side
 *  in out  marked   (lattice cells) 1 for a cell in a box
 */
void kr_boxes_mark(const struct kr_lattice *lattice, size_t n, const double (*box)[4],
                   double padding, unsigned char *marked);

/** Mark a third cell wherever two marked ones meet only at a corner, so that every perimeter is a
 *  simple closed line. */
void kr_boxes_join_corners(const struct kr_lattice *lattice, unsigned char *marked);

#endif
