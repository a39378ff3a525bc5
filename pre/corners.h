/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Putting the corners of an inverted cell in order.
 */
#ifndef KR_CORNERS_H
#define KR_CORNERS_H

#include <stddef.h>

/** Put the corners of a quadrilateral that crosses itself in an order that does not, its first one staying the first;
 *  returns 0 if there is none. point (x 3), vertex (4). */
int kr_corners_untwist(const double *point, size_t *vertex);

/** Turn a solid of n vertices, as in element.h, inside out: its mirror image in the order of corners. */
void kr_corners_turn(size_t n, size_t *vertex);

#endif
