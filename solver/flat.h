/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Segments and polygons in a plane. Touching counts as meeting.
 */
#ifndef KR_FLAT_H
#define KR_FLAT_H

#include <stddef.h>

/** Twice the signed area of the triangle p q r. */
double kr_flat_turn(const double p[2], const double q[2], const double r[2]);

/** Whether the segments from p to q and from a to c meet. */
int kr_flat_segments_meet(const double p[2], const double q[2], const double a[2],
                          const double c[2]);

/** Whether a place lies in a polygon of n corners (n x 2), of either sense, or within `near` of its
 *  rim. */
int kr_flat_is_in(size_t n, const double *corner, const double place[2], double near);

/** Whether the segment from p to q meets the polygon or lies in it. */
int kr_flat_meets(size_t n, const double *corner, const double p[2], const double q[2]);

#endif
