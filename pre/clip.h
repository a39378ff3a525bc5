/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A convex cell less all that lies outside the body's polygon: exact, whatever number of edges and
 * holes pass through the cell.
 */
#ifndef KR_CLIP_H
#define KR_CLIP_H

#include "polygon.h"

/* Labels of a ring's sides that are no sides of the body's polygon. */
enum { KR_SIDE_INNER = -1, KR_SIDE_FAR = -2 };

/** A simple polygon, counter-clockwise; side k goes from corner k to the next. */
struct kr_ring {
    size_t n, point_room, side_room;
    double (*point)[2];
    long *side; /* side of the body's polygon that it lies on, or a label above */
};

/** Everything that clipping needs and gives; arrays are kept from cell to cell. */
struct kr_clip {
    const struct kr_polygon *polygon;
    struct kr_lattice lattice;
    struct kr_near_sides near;
    size_t *stamp, turn; /* (polygon sides) the last cell that met a side */
    size_t n_fragments, fragments_room;
    struct kr_clip_fragment *fragment; /* Opaque. In clip.c. */
    size_t n_parts, parts_room;
    struct kr_ring *part; /* what is left of the cell, one ring a piece */
};

struct kr_clip kr_clip_begin(const struct kr_polygon *polygon, const struct kr_lattice *lattice);

/** Clip a convex cell that holds a point of the body: fills clip->part. Where a hole lies wholly
 *  inside, the cell is cut in two through it, so that every part is simple. */
void kr_clip_cell(struct kr_clip *clip, const struct kr_ring *cell);

void kr_clip_end(struct kr_clip *clip);

/** Growing, emptying and freeing rings. */
void kr_ring_add(struct kr_ring *ring, double x, double y, long side);
void kr_ring_free(struct kr_ring *ring);

/** Keep of a convex ring what is nearer to p than to q; new sides get the label. */
void kr_ring_halve(struct kr_ring *ring, struct kr_ring *spare, const double p[2],
                   const double q[2], long side);

#endif
