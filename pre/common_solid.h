/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The volume that two solid cells have in common.
 *
 * As with polygons (overlap.c): a solid is the sum of the signed tetrahedra between a point and the
 * triangles of its faces, so what two solids have in common is the sum of what their tetrahedra have
 * in common, with the product of their signs, also where they are not convex. Bent faces are the
 * fans of solid.h, on which neighbours agree: cells on either side of a warped face have nothing in
 * common, up to rounding.
 */
#ifndef KR_COMMON_SOLID_H
#define KR_COMMON_SOLID_H

#include "mesh.h"
#include "solid.h"

struct kr_box {
    double lower[3], upper[3]; /* m */
};

/** Whether two boxes have more than a rim in common. */
int kr_boxes_meet(const struct kr_box *a, const struct kr_box *b);

struct kr_cut_part {
    double corner[12], volume; /* m, m^3 with its sign */
    struct kr_box box;
};

/** A cell as its signed tetrahedra. Begin with zeros; used again, it keeps its memory. */
struct kr_cut_cell {
    size_t count, room;
    struct kr_cut_part *part; /* (count) */
    size_t sides;             /* 1: only the side of its first three corners is outside; 4: any */
    size_t n_points, points_room;
    double (*point)[3]; /* (n_points) within whose hull the cell is: vertices, middles of faces */
    double volume;      /* m^3 */
};

/** Cut up a cell of a mesh of solids. */
void kr_cut_cell(const struct kr_mesh *mesh, size_t which, struct kr_cut_cell *cell);
void kr_cut_cell_free(struct kr_cut_cell *cell);

/** What two cells have in common [m^3]; 0 at once where the plane of a face has them on either side. */
double kr_cut_cells_common(const struct kr_cut_cell *a, const struct kr_cut_cell *b);

#endif
