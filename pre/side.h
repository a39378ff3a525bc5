/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The sides of cells, found by their ends. With cells counter-clockwise, a side inside the body
 * is walked once in each sense, a side on its boundary once in one sense, and a side walked twice
 * in the same sense betrays cells that overlap.
 */
#ifndef KR_SIDE_H
#define KR_SIDE_H

#include <stddef.h>

struct kr_side {
    size_t from, to; /* points, in the sense in which the cell walks */
    size_t cell;
};

struct kr_sides {
    size_t n_points, count;
    size_t *first;        /* (n_points + 1) where the sides with this lower end begin */
    struct kr_side *side; /* (count) by their lower end, then in the order of cells */
};

/** All sides of cells.
 *
 *  in   first    (n_cells + 1) where the vertices of a cell begin
 *  in   vertex   indices below n_points
 */
struct kr_sides *kr_sides_create(size_t n_points, size_t n_cells, const size_t *first,
                                 const size_t *vertex);

/** How many cells walk from `from` to `to`; `cell` (or NULL) gets the last of them. */
size_t kr_sides_find(const struct kr_sides *sides, size_t from, size_t to, size_t *cell);

void kr_sides_free(struct kr_sides *sides);

#endif
