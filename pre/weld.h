/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From rings that fit each other to rounding to cells that share their corners: points that are the
 * same become one, and a corner of one cell on the side of another becomes a corner of both.
 */
#ifndef KR_WELD_H
#define KR_WELD_H

#include "clip.h"
#include "tile.h"

struct kr_weld {
    const struct kr_polygon *polygon;
    struct kr_lattice lattice;
    size_t n_points, x_room; /* lattice points and corners of the polygon, then others */
    double (*other)[2];      /* spacings */
    long *first, *next;      /* chains of points other than the lattice's, by lattice cell */
    size_t next_room;
    size_t n_tiles, tiles_room;
    struct kr_tile *tile;
};

struct kr_weld kr_weld_begin(const struct kr_polygon *polygon, const struct kr_lattice *lattice);

/** Add a ring; rings that shrink to nothing are left out. */
void kr_weld_add(struct kr_weld *weld, const struct kr_ring *ring, int is_scrap);

/** Insert corners where sides of neighbours end, and join the scraps. */
void kr_weld_close(struct kr_weld *weld);

/** Place of a point [spacings]. */
void kr_weld_place(const struct kr_weld *weld, size_t point, double place[2]);

void kr_weld_end(struct kr_weld *weld);

#endif
