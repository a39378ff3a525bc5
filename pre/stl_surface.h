/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Closed surfaces from STL files, ASCII or binary
 * (https://www.loc.gov/preservation/digital/formats/fdd/fdd000505.shtml). The format has neither units
 * nor neighbours: which triangles meet is told by their corners' places alone, and normals are not used.
 */
#ifndef KR_STL_SURFACE_H
#define KR_STL_SURFACE_H

#include "cgal_surface.h"

/** The surface in a file, with corners  origin + scale x. Stops (exit 2) with file and line or byte
 *  where it is no STL, and where its triangles make no closed surface. */
struct kr_surface_mesh *kr_stl_surface(const char *path, double scale, const double origin[3]);

#endif
