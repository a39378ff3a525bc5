/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The part of a polyhedron that lies inside a sphere: volume and first moments, by closed formulas.
 */
#ifndef KR_BALL_H
#define KR_BALL_H

#include <stddef.h>

/** A figure in space, its moments taken about the sphere's centre. */
struct kr_ball_part {
    double volume;    /* m^3, positive where the faces look outwards */
    double moment[3]; /* m^4: integrals of x, y and z; over the volume: the centroid */
};

/** Add what one face of a closed polyhedron contributes to the part inside the sphere about the
 *  origin. The sum over all faces is the part; a single face's share means nothing by itself.
 *
 *  in  n       number of corners, 3 or more; they lie in one plane
 *  in  point   (n x 3) m, relative to the sphere's centre, counter-clockwise from outside
 *  in  radius  m
 *
 *  The polyhedron need not be convex. Error of the sum: some 1e-15 of radius times the surface.
 */
void kr_ball_add_face(size_t n, const double *point, double radius, struct kr_ball_part *sum);

/** The part of a solid cell with the faces of solid.h: flat ones as they are, others as the fan of
 *  triangles about their middle.
 *
 *  in  n, point  the cell's vertices (n x 3) m
 */
struct kr_ball_part kr_ball_solid(size_t n, const double *point, double radius);

/** The part of a cube with edges along the axes. */
struct kr_ball_part kr_ball_cube(const double centre[3], double side, double radius);

#endif
