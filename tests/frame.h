/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Edges along the frame of a small mesh of squares.
 */
#ifndef KR_FRAME_H
#define KR_FRAME_H

#include "builder.h"

/** n edges from lattice point (i, j), each a step of (di, dj), as a group. */
static inline void kr_frame_side(struct kr_builder *builder, const char *name, size_t n, size_t i,
                                 size_t j, size_t di, size_t dj) {
    for (size_t k = 0; k < n; k++)
        kr_builder_edge(builder, kr_builder_lattice_point(builder, i + k * di, j + k * dj),
                        kr_builder_lattice_point(builder, i + (k + 1) * di, j + (k + 1) * dj));
    kr_builder_group_edges(builder, name);
}

/** All four sides of the lattice, in groups left, right, bottom and top. */
static inline void kr_frame_edges(struct kr_builder *builder) {
    size_t columns = builder->lattice.columns, rows = builder->lattice.rows;
    kr_frame_side(builder, "left", rows, 0, 0, 0, 1);
    kr_frame_side(builder, "right", rows, columns, 0, 0, 1);
    kr_frame_side(builder, "bottom", columns, 0, 0, 1, 0);
    kr_frame_side(builder, "top", columns, 0, rows, 1, 0);
}

#endif
