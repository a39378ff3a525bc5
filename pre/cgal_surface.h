/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A closed surface of triangles, and distances from it: the only place where CGAL is used
 * (https://doc.cgal.org: Polygon Mesh Processing, AABB tree). C++ behind a C interface.
 */
#ifndef KR_CGAL_SURFACE_H
#define KR_CGAL_SURFACE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

struct kr_surface_mesh;

/** Make a surface of triangles that may be given in any order and sense; corners at one place are one.
 *
 *  in   triangle  (n x 9) corners
 *  out  what      (room) where there is no surface: what is wrong, a part of a sentence
 *  returns NULL where the triangles have a gap, meet more than two to an edge or pass through each
 *  other
 */
struct kr_surface_mesh *kr_surface_mesh_create(size_t n, const double *triangle, char *what,
                                               size_t room);

/** Distance of a place from the surface, negative inside. Several threads may ask at once. */
double kr_surface_mesh_distance(const struct kr_surface_mesh *surface, const double p[3]);

/** Volume inside. */
double kr_surface_mesh_volume(const struct kr_surface_mesh *surface);

/** Lower and upper corner of the box around it. */
void kr_surface_mesh_box(const struct kr_surface_mesh *surface, double box[6]);

void kr_surface_mesh_free(struct kr_surface_mesh *surface);

#ifdef __cplusplus
}
#endif

#endif
