/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Clipping. Each side of the body's polygon that passes the cell leaves a fragment in it;
 * fragments that follow each other are chained. A chain enters the cell on one of its sides and
 * leaves it on another, the body on its left; the cell's own boundary goes on counter-clockwise
 * from there to the next entry. So the parts close.
 *
 * A corner of the polygon is in the cell if it lies on no side's right: the same test decides for
 * both fragments that meet there, so chains never break, whatever the rounding.
 */
#include "clip.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/* A chain shorter than this only touches the cell. */
static const double TOUCH = 1e-9;

struct kr_clip_fragment {
    size_t side;
    int in, out; /* sides of the cell by which it enters and leaves; -1: it does not */
    double from[2], to[2];
    double from_at, to_at; /* places on the cell's boundary: number of the side and share of it */
    size_t last;           /* of a chain, at its first fragment: its last one */
    int used;
};

void kr_ring_add(struct kr_ring *ring, double x, double y, long side) {
    KR_GROW(ring->side, ring->n, ring->side_room);
    KR_GROW(ring->point, ring->n, ring->point_room);
    ring->point[ring->n][0] = x;
    ring->point[ring->n][1] = y;
    ring->side[ring->n++] = side;
}

void kr_ring_free(struct kr_ring *ring) {
    kr_free(ring->point);
    kr_free(ring->side);
    *ring = (struct kr_ring){0};
}

void kr_ring_halve(struct kr_ring *ring, struct kr_ring *spare, const double p[2],
                   const double q[2], long side) {
    double x = q[0] - p[0], y = q[1] - p[1];
    double middle = (x * (p[0] + q[0]) + y * (p[1] + q[1])) / 2;
    spare->n = 0;
    for (size_t k = 0; k < ring->n; k++) {
        const double *a = ring->point[k], *b = ring->point[k + 1 < ring->n ? k + 1 : 0];
        double da = x * a[0] + y * a[1] - middle, db = x * b[0] + y * b[1] - middle;
        double t = da / (da - db);
        if (da <= 0)
            kr_ring_add(spare, a[0], a[1], ring->side[k]);
        if (da < 0 && db > 0)
            kr_ring_add(spare, a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), side);
        else if (da > 0 && db < 0)
            kr_ring_add(spare, a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), ring->side[k]);
        else if (da == 0 && db > 0)
            spare->side[spare->n - 1] = side;
    }
    struct kr_ring swap = *ring;
    *ring = *spare;
    *spare = swap;
}

/** Place on the cell's boundary of a point on its side k. */
static double place_on(const struct kr_ring *cell, int k, const double p[2]) {
    const double *a = cell->point[k], *b = cell->point[(size_t)k + 1 < cell->n ? k + 1 : 0];
    double x = b[0] - a[0], y = b[1] - a[1], squared = x * x + y * y;
    double share = squared > 0 ? ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / squared : 0;
    return k + fmin(fmax(share, 0), 1 - 1e-15);
}

/** The fragment of a side in the cell; 0 if there is none. */
static int cut_side(const struct kr_polygon *polygon, const struct kr_ring *cell, size_t side,
                    struct kr_clip_fragment *out) {
    const double *p = polygon->point + 2 * side, *q = polygon->point + 2 * polygon->next[side];
    double t_in = 0, t_out = 1;
    *out = (struct kr_clip_fragment){.side = side, .in = -1, .out = -1};
    for (size_t k = 0; k < cell->n; k++) {
        const double *a = cell->point[k], *b = cell->point[k + 1 < cell->n ? k + 1 : 0];
        double x = b[0] - a[0], y = b[1] - a[1];
        double dp = x * (p[1] - a[1]) - y * (p[0] - a[0]);
        double dq = x * (q[1] - a[1]) - y * (q[0] - a[0]);
        if (dp < 0 && dq < 0)
            return 0;
        if (dp < 0 && (out->in < 0 || dp / (dp - dq) > t_in)) {
            t_in = dp / (dp - dq);
            out->in = (int)k;
        }
        if (dq < 0 && (out->out < 0 || dp / (dp - dq) < t_out)) {
            t_out = dp / (dp - dq);
            out->out = (int)k;
        }
    }
    if (t_in > t_out)
        return 0;
    for (int d = 0; d < 2; d++) {
        out->from[d] = out->in < 0 ? p[d] : p[d] + t_in * (q[d] - p[d]);
        out->to[d] = out->out < 0 ? q[d] : p[d] + t_out * (q[d] - p[d]);
    }
    out->from_at = out->in < 0 ? 0 : place_on(cell, out->in, out->from);
    out->to_at = out->out < 0 ? 0 : place_on(cell, out->out, out->to);
    return 1;
}

static size_t clamp(double x, size_t most) {
    return x <= 0 ? 0 : x >= (double)most ? most - 1 : (size_t)x;
}

/** Fragments of all sides near the cell. */
static void gather(struct kr_clip *clip, const struct kr_ring *cell) {
    double box[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (size_t k = 0; k < cell->n; k++)
        for (int d = 0; d < 2; d++) {
            box[d] = fmin(box[d], cell->point[k][d]);
            box[2 + d] = fmax(box[2 + d], cell->point[k][d]);
        }
    size_t right = clamp(box[2], clip->near.columns), top = clamp(box[3], clip->near.rows);
    clip->n_fragments = 0;
    clip->turn++;
    for (size_t j = clamp(box[1], clip->near.rows); j <= top; j++)
        for (size_t i = clamp(box[0], clip->near.columns); i <= right; i++) {
            size_t c = kr_lattice_cell(&clip->lattice, i, j);
            for (size_t m = clip->near.first[c]; m < clip->near.first[c + 1]; m++) {
                size_t side = clip->near.side[m];
                if (clip->stamp[side] == clip->turn)
                    continue;
                clip->stamp[side] = clip->turn;
                KR_GROW(clip->fragment, clip->n_fragments, clip->fragments_room);
                clip->n_fragments += (size_t)cut_side(clip->polygon, cell, side,
                                                      &clip->fragment[clip->n_fragments]);
            }
        }
}

static size_t follower(const struct kr_clip *clip, size_t f) {
    size_t side = clip->polygon->next[clip->fragment[f].side];
    for (size_t k = 0; k < clip->n_fragments; k++)
        if (clip->fragment[k].side == side && clip->fragment[k].in < 0)
            return k;
    kr_assert(!"a fragment that ends inside goes on");
    return f;
}

/** Find the chains: their first fragments stay unused, all others are used. Returns a place inside
 *  a hole that lies wholly in the cell, if there is one. */
static int chain_up(struct kr_clip *clip, double hole[2]) {
    int holes = 0;
    for (size_t f = 0; f < clip->n_fragments; f++) {
        struct kr_clip_fragment *first = &clip->fragment[f];
        double length = 0;
        if (first->in < 0)
            continue;
        for (size_t at = f;; at = follower(clip, at)) {
            struct kr_clip_fragment *here = &clip->fragment[at];
            here->used = at != f;
            first->last = at;
            length += hypot(here->to[0] - here->from[0], here->to[1] - here->from[1]);
            if (here->out >= 0)
                break;
        }
        first->used = length < TOUCH;
    }
    for (size_t f = 0; f < clip->n_fragments && !holes; f++) {
        double n = 0;
        if (clip->fragment[f].in >= 0 || clip->fragment[f].used)
            continue;
        hole[0] = hole[1] = 0;
        for (size_t at = f; !clip->fragment[at].used; at = follower(clip, at)) {
            clip->fragment[at].used = 1;
            hole[0] += clip->fragment[at].from[0];
            hole[1] += clip->fragment[at].from[1];
            n++;
        }
        hole[0] /= n;
        hole[1] /= n;
        holes = 1;
    }
    return holes;
}

static struct kr_ring *new_part(struct kr_clip *clip) {
    KR_GROW(clip->part, clip->n_parts, clip->parts_room);
    struct kr_ring *part = &clip->part[clip->n_parts++];
    part->n = 0;
    return part;
}

/** First fragment of the chain whose entry comes next along the cell's boundary. */
static size_t next_entry(const struct kr_clip *clip, double at, double around) {
    double least = INFINITY;
    size_t best = clip->n_fragments;
    for (size_t f = 0; f < clip->n_fragments; f++) {
        const struct kr_clip_fragment *first = &clip->fragment[f];
        if (first->in < 0 || first->used == 1)
            continue;
        double way = first->from_at - at;
        way += way < 0 ? around : 0;
        if (way < least) {
            least = way;
            best = f;
        }
    }
    return best;
}

/** Close a part: chain, cell's boundary, chain, ... until the first chain comes again. */
static void close_part(struct kr_clip *clip, const struct kr_ring *cell, size_t start) {
    struct kr_ring *part = new_part(clip);
    size_t f = start, chains = 0;
    do {
        struct kr_clip_fragment *first = &clip->fragment[f];
        const struct kr_clip_fragment *last = &clip->fragment[first->last];
        for (size_t at = f;; at = follower(clip, at)) {
            kr_ring_add(part, clip->fragment[at].from[0], clip->fragment[at].from[1],
                        (long)clip->fragment[at].side);
            if (at == first->last)
                break;
        }
        kr_ring_add(part, last->to[0], last->to[1], cell->side[last->out]);
        size_t next = next_entry(clip, last->to_at, (double)cell->n);
        const struct kr_clip_fragment *entry = &clip->fragment[next];
        int k = last->out, wraps = entry->in == k && entry->from_at < last->to_at;
        while (k != entry->in || wraps) {
            k = (size_t)k + 1 < cell->n ? k + 1 : 0;
            wraps = 0;
            kr_ring_add(part, cell->point[k][0], cell->point[k][1], cell->side[k]);
        }
        first->used = 2; /* done, but still to be met as the end of its own part */
        f = next;
    } while (f != start && ++chains < clip->n_fragments);
}

static void clip_whole(struct kr_clip *clip, const struct kr_ring *cell, int depth);

/** Cut the cell in two by the upright line through a place and clip both halves. */
static void clip_halves(struct kr_clip *clip, const struct kr_ring *cell, const double at[2],
                        int depth) {
    struct kr_ring half = {0}, spare = {0};
    for (int k = 0; k < 2; k++) {
        double p[2] = {at[0] + (k ? 1 : -1), at[1]}, q[2] = {at[0] - (k ? 1 : -1), at[1]};
        half.n = 0;
        for (size_t c = 0; c < cell->n; c++)
            kr_ring_add(&half, cell->point[c][0], cell->point[c][1], cell->side[c]);
        kr_ring_halve(&half, &spare, p, q, KR_SIDE_INNER);
        if (half.n > 2)
            clip_whole(clip, &half, depth + 1);
    }
    kr_ring_free(&half);
    kr_ring_free(&spare);
}

static void clip_whole(struct kr_clip *clip, const struct kr_ring *cell, int depth) {
    enum { DEEPEST = 12 };
    double hole[2];
    int chains = 0;
    gather(clip, cell);
    if (chain_up(clip, hole) && depth < DEEPEST) {
        clip_halves(clip, cell, hole, depth);
        return;
    }
    for (size_t f = 0; f < clip->n_fragments; f++)
        if (clip->fragment[f].in >= 0 && !clip->fragment[f].used) {
            close_part(clip, cell, f);
            chains++;
        }
    if (chains)
        return;
    struct kr_ring *part = new_part(clip);
    for (size_t k = 0; k < cell->n; k++)
        kr_ring_add(part, cell->point[k][0], cell->point[k][1], cell->side[k]);
}

void kr_clip_cell(struct kr_clip *clip, const struct kr_ring *cell) {
    clip->n_parts = 0;
    clip_whole(clip, cell, 0);
}

struct kr_clip kr_clip_begin(const struct kr_polygon *polygon, const struct kr_lattice *lattice) {
    return (struct kr_clip){.polygon = polygon,
                            .lattice = *lattice,
                            .near = kr_near_sides_of(polygon, lattice),
                            .stamp = KR_NEW(size_t, polygon->n)};
}

void kr_clip_end(struct kr_clip *clip) {
    for (size_t k = 0; k < clip->parts_room; k++)
        kr_ring_free(&clip->part[k]);
    kr_free(clip->part);
    kr_free(clip->fragment);
    kr_free(clip->stamp);
    kr_near_sides_free(&clip->near);
}
