/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Corners in another order. See corners.h.
 */
#include "corners.h"

#include "cell.h"
#include "solid.h"

#include <string.h>

int kr_corners_untwist(const double *point, size_t *vertex) {
    static const int order[5][3] = {{1, 3, 2}, {2, 1, 3}, {2, 3, 1}, {3, 1, 2}, {3, 2, 1}};
    double corner[8];
    for (size_t k = 0; k < 5; k++) {
        size_t tried[4] = {vertex[0], vertex[order[k][0]], vertex[order[k][1]], vertex[order[k][2]]};
        for (size_t v = 0; v < 4; v++)
            memcpy(corner + 2 * v, point + 3 * tried[v], 2 * sizeof *corner);
        if (kr_cell_is_sound(4, corner)) {
            memcpy(vertex, tried, sizeof tried);
            return 1;
        }
    }
    return 0;
}

void kr_corners_turn(size_t n, size_t *vertex) {
    if (kr_solid_is_pieces(n)) {
        for (size_t k = 0; k < n; k += 4)
            kr_corners_turn(4, vertex + k);
        return;
    }
    static const unsigned char order[][8] = {
        [4] = {0, 2, 1, 3}, [5] = {0, 3, 2, 1, 4}, [6] = {3, 4, 5, 0, 1, 2}, [8] = {4, 5, 6, 7, 0, 1, 2, 3}};
    const struct kr_solid *solid = kr_solid(n);
    const unsigned char *to = order[solid->corners];
    size_t old[20];
    memcpy(old, vertex, n * sizeof *old);
    for (size_t k = 0; k < solid->corners; k++)
        vertex[k] = old[to[k]];
    for (size_t e = 0; n > solid->corners && e < solid->n_edges; e++) {
        unsigned char a = to[solid->edge[e][0]], b = to[solid->edge[e][1]];
        size_t k = 0;
        while (!(solid->edge[k][0] == a && solid->edge[k][1] == b) &&
               !(solid->edge[k][0] == b && solid->edge[k][1] == a))
            k++;
        vertex[solid->corners + e] = old[solid->corners + k];
    }
}
