/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From the triangles of an STL file to a closed surface.
 */
#include "stl_surface.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/stl.h"

#include <stdio.h>

struct kr_surface_mesh *kr_stl_surface(const char *path, double scale, const double origin[3]) {
    char what[200];
    size_t n;
    double *corner = kr_stl_read(path, scale, &n);
    for (size_t k = 0; k < 9 * n; k++)
        corner[k] += origin[k % 3];
    struct kr_surface_mesh *surface =
        n < 4 ? NULL : kr_surface_mesh_create(n, corner, what, sizeof what);
    if (n < 4)
        snprintf(what, sizeof what, "it holds %zu triangles, and a closed surface has 4 or more", n);
    if (!surface)
        kr_stop(KR_EXIT_INPUT, "%s: %s; expected one closed surface, or several apart from each other",
                path, what);
    kr_free(corner);
    return surface;
}
