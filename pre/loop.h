/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A closed polygon in the making, whose corners move until its area is that of the curve it stands for. It knows
 * no curves; lengths are in spacings.
 */
#ifndef KR_LOOP_H
#define KR_LOOP_H

#include <stddef.h>

/** A loop in the making: its corners and how far each may be moved. */
struct kr_loop {
    size_t n, point_room, bulge_room, group_room, line_room;
    double (*point)[2];
    double (*bulge)[2]; /* outward along the normal, in proportion to what its sides lose */
    int *group, *on_line;
};

/** Add a corner and the side behind it. */
void kr_loop_add(struct kr_loop *loop, const double point[2], const double bulge[2], int group, int on_line);

/** Area, positive where the loop runs counter-clockwise. */
double kr_loop_area(const struct kr_loop *loop);

/** Move the corners along their bulges until the area is `exact`. */
void kr_loop_mend(struct kr_loop *loop, double exact);

void kr_loop_free(struct kr_loop *loop);

#endif
