/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The sides of a polygon sorted into the cells of a lattice, by counting.
 */
#include "base/memory.h"
#include "polygon.h"

#include <math.h>

static size_t clamp(double x, size_t most) {
    return x <= 0 ? 0 : x >= (double)most ? most - 1 : (size_t)x;
}

/** Cells that a side's box meets: left, bottom, right, top. A side on a line is near both cells. */
static void cells_of(const struct kr_polygon *polygon, size_t side,
                     const struct kr_lattice *lattice, size_t cell[4]) {
    const double *p = polygon->point + 2 * side, *q = polygon->point + 2 * polygon->next[side];
    for (int d = 0; d < 2; d++) {
        size_t most = d ? lattice->rows : lattice->columns;
        cell[d] = clamp(fmin(p[d], q[d]) - 1e-6, most);
        cell[2 + d] = clamp(fmax(p[d], q[d]) + 1e-6, most);
    }
}

struct kr_near_sides kr_near_sides_of(const struct kr_polygon *polygon,
                                      const struct kr_lattice *lattice) {
    size_t cells = lattice->columns * lattice->rows, box[4];
    struct kr_near_sides near = {lattice->columns, lattice->rows, KR_NEW(size_t, cells + 1), NULL};
    size_t *filled = KR_NEW(size_t, cells);
    for (size_t s = 0; s < polygon->n; s++) {
        cells_of(polygon, s, lattice, box);
        for (size_t j = box[1]; j <= box[3]; j++)
            for (size_t i = box[0]; i <= box[2]; i++)
                near.first[kr_lattice_cell(lattice, i, j) + 1]++;
    }
    for (size_t c = 0; c < cells; c++)
        near.first[c + 1] += near.first[c];
    near.side = KR_NEW(size_t, near.first[cells]);
    for (size_t s = 0; s < polygon->n; s++) {
        cells_of(polygon, s, lattice, box);
        for (size_t j = box[1]; j <= box[3]; j++)
            for (size_t i = box[0]; i <= box[2]; i++) {
                size_t c = kr_lattice_cell(lattice, i, j);
                near.side[near.first[c] + filled[c]++] = s;
            }
    }
    kr_free(filled);
    return near;
}

void kr_near_sides_free(struct kr_near_sides *near) {
    kr_free(near->first);
    kr_free(near->side);
    *near = (struct kr_near_sides){0};
}
