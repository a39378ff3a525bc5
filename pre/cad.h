/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Curves of a CAD file. The child kirsch-gmsh reads the file and tells, for each plane face, the
 * curves around it; this chains them to closed ones.
 *
 *    faces N
 *    face K                            N times: curves around it, in any order and sense
 *    curve line 2 0                    two ends
 *    curve round 3 SPAN                begin, middle, end of  c + a cos t + b sin t,  t to SPAN
 *    curve other M 0                   M points, evenly in the curve's parameter
 *    x y dx dy                         points [m], and derivatives by the parameter
 *    end
 *
 * Lines, circles and ellipses stay what they are. Any other curve becomes arcs of ellipses, each
 * tangent to it at both ends and through it in the middle; KR_CAD_OFF bounds what they are off.
 */
#ifndef KR_CAD_H
#define KR_CAD_H

#include "shape.h"

#include <stdio.h>

/* Largest distance between a free curve of the file and its arcs, in spacings. */
#define KR_CAD_OFF 1e-4

/** How a file's plane is laid into ours: turned about its origin, which comes to `origin`. */
struct kr_cad_place {
    double origin[2]; /* m */
    double angle;     /* rad */
    double spacing;   /* m: of the lattice, for lengths in spacings */
};

/** The faces of a CAD file, each a shape of closed curves (counter-clockwise, the outer one first,
 *  all of group 0). `helper` is the path of kirsch-gmsh, NULL: beside this program. Stops (exit 2)
 *  where the file holds no face in a plane of constant z, (exit 5) where gmsh fails. */
size_t kr_cad_read(const char *path, const char *helper, const struct kr_cad_place *place,
                   struct kr_shape **face);

/** "step", "iges" or "brep" by the ending of a name; NULL for others. */
const char *kr_cad_format(const char *path);

/** The second half of it, on what kirsch-gmsh said; `path` is for messages. */
size_t kr_cad_parse(FILE *file, const char *path, const struct kr_cad_place *place,
                    struct kr_shape **face);

#endif
