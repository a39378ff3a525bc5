/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What a user wants to know of a mesh: how many cells, how even, and whether their area is right.
 */
#ifndef KR_QUALITY_H
#define KR_QUALITY_H

#include "mesh.h"
#include "plate.h"

struct kr_quality {
    size_t n_cells, n_triangles;
    double area;              /* m^2: sum over the cells */
    double least, mean, most; /* area of a cell over the spacing squared */
    double shift;             /* largest distance of a centroid from its lattice place, spacings */
    double variation;         /* standard deviation of the areas over their mean */
};

/** Quality of the cells from place `from` up to, not with, `to`; all zero if there are none. */
struct kr_quality kr_quality_of(const struct kr_mesh *mesh, size_t from, size_t to, double spacing);

/** Print the report of a plate's mesh on stdout. */
void kr_quality_print(const struct kr_mesh *mesh, const struct kr_plate *plate,
                      const struct kr_plate_report *report);

#endif
