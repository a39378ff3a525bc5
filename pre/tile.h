/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A tile: a cell in the making as a ring of numbered points. It knows neither where the points lie nor what the
 * numbers mean.
 */
#ifndef KR_TILE_H
#define KR_TILE_H

#include <stddef.h>

struct kr_tile {
    size_t n, point_room, side_room;
    size_t *point; /* numbers as in region.h where below its count; further points follow */
    long *side;    /* as in struct kr_ring */
    int is_scrap;  /* a piece without a seed: to be joined to a neighbour */
};

/** Add a point and the side that leaves it. */
void kr_tile_add(struct kr_tile *tile, size_t point, long side);

/** Join a scrap to a tile that shares sides with it, if that makes one simple ring: returns whether it does. */
int kr_tile_join(struct kr_tile *into, const struct kr_tile *scrap);

/** Free the arrays of a tile, which is empty then. */
void kr_tile_free(struct kr_tile *tile);

#endif
