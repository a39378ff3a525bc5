/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A surface that bounds a solid, as the zero of a function: positive in the body, near the surface the
 * distance from it to first order. All lengths are in spacings of the lattice.
 *
 *    sphere     |p - c| - R
 *    ellipsoid  k0 (k0 - 1)/k1 ,  k0 = |q/a|, k1 = |q/a^2|, q = p - c, a its half axes
 *    cylinder   distance from the cylinder with flat ends
 *    plate      distance from the curves of a plate, at every z
 *    stl        distance from a closed surface of triangles (cgal_surface.h)
 */
#ifndef KR_CUTTER_H
#define KR_CUTTER_H

#include "plate_body.h"

enum kr_cutter_kind {
    KR_CUTTER_SPHERE,
    KR_CUTTER_ELLIPSOID,
    KR_CUTTER_CYLINDER,
    KR_CUTTER_STL,
    KR_CUTTER_PLATE,
};

struct kr_surface_mesh; /* Opaque. In cgal_surface.cpp. */

struct kr_cutter {
    enum kr_cutter_kind kind;
    int group; /* boundary that its faces belong to; of a plate the nearest curve's */
    double centre[3], radius, radii[3], half, axis[3]; /* axis: of length 1 */
    const struct kr_plate_body *plate;
    struct kr_surface_mesh *surface; /* owned */
    int is_body;                     /* the inside of the STL surface is the body, not a void */
};

/** The function at a place.
 *
 *  out  least  no point of the surface is nearer than this; NULL: not wanted
 */
double kr_cutter_at(const struct kr_cutter *cutter, const double p[3], double *least);

/** Boundary that the surface belongs to near a place. */
int kr_cutter_group(const struct kr_cutter *cutter, const double p[3]);

/** Lower and upper corner of a box outside of which the function is positive; infinite for bodies. */
void kr_cutter_box(const struct kr_cutter *cutter, double box[6]);

/** Volume that a void takes out where nothing cuts it off; 0 for a plate. */
double kr_cutter_volume(const struct kr_cutter *cutter);

#endif
