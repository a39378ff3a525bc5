/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Exact area and centroid of a simple polygon, convex or not; volume and centroid of solid cells, whose
 * faces follow the rule of solid.h.
 */
#ifndef KR_CELL_H
#define KR_CELL_H

#include <stddef.h>

/** Area [m^2] (positive if counter-clockwise) and area centroid of a polygon.
 *
 *    A = 1/2 sum (x_k y_k+1 - x_k+1 y_k),  C = 1/(6A) sum (p_k + p_k+1)(x_k y_k+1 - x_k+1 y_k)
 *
 *  taken about the first vertex, so that nothing is lost far from the origin.
 *
 *  in   n         number of vertices, 3 or more
 *  in   point     (n x 2) m
 *  out  centroid  (2) m; the mean of the vertices where the area is 0
 */
double kr_cell_polygon(size_t n, const double *point, double centroid[2]);

/** The same area alone: what tells which way round a polygon runs. */
double kr_cell_area(size_t n, const double *point);

/** Whether a polygon bounds a positive area. A quadrilateral that is not convex passes, one that
 *  crosses itself does not: then no diagonal cuts it into two positive triangles. */
int kr_cell_is_sound(size_t n, const double *point);

/** Volume [m^3] (positive if the faces look outwards) and centroid of a solid cell.
 *
 *  in   n         number of vertices, of which there is a shape (element.h)
 *  in   point     (n x 3) m
 *  out  centroid  (3) m; the mean of the vertices where the volume is 0
 */
double kr_cell_solid(size_t n, const double *point, double centroid[3]);

/** Area [m^2] of a triangle in space. */
double kr_cell_triangle(const double *a, const double *b, const double *c);

/** Volume [m^3] of a tetrahedron, positive if a, b, c run counter-clockwise seen from d. */
double kr_cell_tetrahedron(const double *a, const double *b, const double *c, const double *d);

/** Area [m^2] of a face by the rule above, and the point in its middle.
 *
 *  in   n, point  3, 4, 6 or 8 vertices in their order (n x 3) m; any other number: the mean
 *  out  middle    (3) m
 */
double kr_cell_face(size_t n, const double *point, double middle[3]);

#endif
