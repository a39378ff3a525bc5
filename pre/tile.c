/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tiles. See tile.h.
 */
#include "tile.h"

#include "base/memory.h"

void kr_tile_add(struct kr_tile *tile, size_t point, long side) {
    KR_GROW(tile->side, tile->n, tile->side_room);
    KR_GROW(tile->point, tile->n, tile->point_room);
    tile->point[tile->n] = point;
    tile->side[tile->n++] = side;
}

void kr_tile_free(struct kr_tile *tile) {
    kr_free(tile->point);
    kr_free(tile->side);
    *tile = (struct kr_tile){0};
}

int kr_tile_join(struct kr_tile *into, const struct kr_tile *scrap) {
    size_t n = into->n + scrap->n, start = n, left = 0;
    size_t *from = KR_NEW(size_t, n), *to = KR_NEW(size_t, n);
    long *side = KR_NEW(long, n);
    unsigned char *gone = KR_NEW(unsigned char, n);
    for (size_t k = 0; k < n; k++) {
        const struct kr_tile *tile = k < into->n ? into : scrap;
        size_t at = k < into->n ? k : k - into->n;
        from[k] = tile->point[at];
        to[k] = tile->point[at + 1 < tile->n ? at + 1 : 0];
        side[k] = tile->side[at];
    }
    for (size_t k = 0; k < into->n; k++)
        for (size_t l = into->n; l < n; l++)
            if (from[k] == to[l] && to[k] == from[l])
                gone[k] = gone[l] = 1;
    for (size_t k = n; k-- > 0;)
        if (!gone[k]) {
            start = k;
            left++;
        }
    struct kr_tile ring = {.is_scrap = 0};
    size_t at = start;
    while (start < n && left < n && ring.n < left) {
        size_t next = n, choices = 0;
        kr_tile_add(&ring, from[at], side[at]);
        for (size_t k = 0; k < n; k++)
            if (!gone[k] && from[k] == to[at]) {
                next = k;
                choices++;
            }
        if (choices != 1 || next == start)
            break;
        at = next;
    }
    int is_one = left < n && ring.n == left && left > 2 && to[at] == from[start];
    if (is_one) {
        kr_tile_free(into);
        *into = ring;
    } else {
        kr_tile_free(&ring);
    }
    kr_free(from);
    kr_free(to);
    kr_free(side);
    kr_free(gone);
    return is_one;
}
