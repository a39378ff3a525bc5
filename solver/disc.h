/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The part of a polygon that lies inside a circle: area and first moments, by closed formulas.
 */
#ifndef KR_DISC_H
#define KR_DISC_H

#include <stddef.h>

/** A figure in the plane, its moments taken about the circle's centre. */
struct kr_disc_part {
    double area;      /* m^2, positive for a counter-clockwise polygon */
    double moment[2]; /* m^3: integral of x and of y; over the area: the centroid */
};

/** The part of a simple polygon, convex or not, inside the circle about the origin.
 *
 *  in  n       number of vertices, 3 or more
 *  in  point   (n x 2) m, relative to the circle's centre
 *  in  radius  m
 *
 *  Error: some 1e-15 of radius times the polygon's size.
 */
struct kr_disc_part kr_disc_polygon(size_t n, const double *point, double radius);

/** The part of a square with sides along the axes. */
struct kr_disc_part kr_disc_square(const double centre[2], double side, double radius);

#endif
