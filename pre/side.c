/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The sides of cells, sorted by counting into one short list a point: linear in their number.
 */
#include "side.h"

#include "base/memory.h"

static size_t lower(size_t a, size_t b) {
    return a < b ? a : b;
}

/** The k-th side of a cell. */
static struct kr_side side_of(const size_t *first, const size_t *vertex, size_t cell, size_t k) {
    size_t n = first[cell + 1] - first[cell];
    const size_t *v = vertex + first[cell];
    return (struct kr_side){v[k], v[k + 1 < n ? k + 1 : 0], cell};
}

struct kr_sides *kr_sides_create(size_t n_points, size_t n_cells, const size_t *first,
                                 const size_t *vertex) {
    struct kr_sides *sides = KR_NEW(struct kr_sides, 1);
    sides->n_points = n_points;
    sides->count = first[n_cells];
    sides->first = KR_NEW(size_t, n_points + 1);
    sides->side = KR_NEW(struct kr_side, sides->count);
    size_t *filled = KR_NEW(size_t, n_points);
    for (size_t c = 0; c < n_cells; c++)
        for (size_t k = 0; k < first[c + 1] - first[c]; k++) {
            struct kr_side s = side_of(first, vertex, c, k);
            sides->first[lower(s.from, s.to) + 1]++;
        }
    for (size_t p = 0; p < n_points; p++)
        sides->first[p + 1] += sides->first[p];
    for (size_t c = 0; c < n_cells; c++)
        for (size_t k = 0; k < first[c + 1] - first[c]; k++) {
            struct kr_side s = side_of(first, vertex, c, k);
            size_t end = lower(s.from, s.to);
            sides->side[sides->first[end] + filled[end]++] = s;
        }
    kr_free(filled);
    return sides;
}

size_t kr_sides_find(const struct kr_sides *sides, size_t from, size_t to, size_t *cell) {
    size_t end = lower(from, to), found = 0;
    for (size_t s = sides->first[end]; s < sides->first[end + 1]; s++)
        if (sides->side[s].from == from && sides->side[s].to == to) {
            found++;
            if (cell)
                *cell = sides->side[s].cell;
        }
    return found;
}

void kr_sides_free(struct kr_sides *sides) {
    if (!sides)
        return;
    kr_free(sides->first);
    kr_free(sides->side);
    kr_free(sides);
}
