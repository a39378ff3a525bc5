/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Layers joined and cut. Every piece is cut where it meets another curve; a part then lies wholly
 * inside, outside or along each other curve, and its middle tells which. Kept are the parts with
 * body on their left and none on their right; they are chained by their ends.
 */
#include "base/error.h"
#include "base/memory.h"
#include "shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/** All curves, layer after layer. */
struct cutting {
    size_t n;
    struct kr_curve *curve; /* (n) owned: ends may be moved onto each other */
    double (*box)[4];
    size_t *layer; /* (n) that a curve belongs to */
    const struct kr_layer *of;
};

/** The parts that are kept, in the sense with the body on their left. */
struct parts {
    size_t n, room;
    struct kr_piece *piece;
};

static struct kr_curve copy_of(const struct kr_curve *curve) {
    struct kr_curve copy = {curve->n, KR_NEW(struct kr_piece, curve->n)};
    memcpy(copy.piece, curve->piece, curve->n * sizeof *copy.piece);
    return copy;
}

static int boxes_meet(const double *a, const double *b) {
    return a[0] <= b[2] + KR_SHAPE_SAME && b[0] <= a[2] + KR_SHAPE_SAME &&
           a[1] <= b[3] + KR_SHAPE_SAME && b[1] <= a[3] + KR_SHAPE_SAME;
}

/** Ends of one curve that stand on ends of another become those, to the last bit. */
static void unite_ends(struct kr_curve *moved, const struct kr_curve *kept) {
    for (size_t k = 0; k < moved->n; k++)
        for (size_t l = 0; l < kept->n; l++) {
            double *end = moved->piece[k].from;
            const double *other = kept->piece[l].from;
            if (hypot(end[0] - other[0], end[1] - other[1]) >= KR_SHAPE_SAME)
                continue;
            memcpy(end, other, sizeof moved->piece[k].from);
            memcpy(moved->piece[(k + moved->n - 1) % moved->n].to, other,
                   sizeof moved->piece[k].to);
        }
}

static int by_share(const void *a, const void *b) {
    double u = ((const struct kr_meeting *)a)->u, v = ((const struct kr_meeting *)b)->u;
    return (u > v) - (u < v);
}

/** Where curve c's piece k must be cut, ascending; owned by the caller. */
static struct kr_meeting *cuts_of(const struct cutting *all, size_t c, size_t k, size_t *n) {
    struct kr_meeting *cut = NULL;
    size_t room = 0;
    *n = 0;
    for (size_t other = 0; other < all->n; other++) {
        if (other == c || !boxes_meet(all->box[c], all->box[other]))
            continue;
        for (size_t l = 0; l < all->curve[other].n; l++) {
            struct kr_meeting at[16];
            /* The lower numbered piece goes first, so that both sides see the same bits. */
            const struct kr_piece *p = &all->curve[c].piece[k], *q = &all->curve[other].piece[l];
            int found = c < other ? kr_pieces_meet(p, q, at) : kr_pieces_meet(q, p, at);
            for (int m = 0; m < found; m++) {
                if (c > other)
                    at[m].u = at[m].v;
                if (!(at[m].u > 0 && at[m].u < 1))
                    continue;
                KR_GROW(cut, *n, room);
                cut[(*n)++] = at[m];
            }
        }
    }
    if (*n)
        qsort(cut, *n, sizeof *cut, by_share);
    return cut;
}

/** Where a part lies with respect to a curve: is the curve's inside on its left, on its right? */
static void sides_in(const struct kr_curve *curve, const struct kr_piece *part, int *left,
                     int *right) {
    double middle[2], along[2];
    kr_piece_at(part, 0.5, middle, along);
    for (size_t k = 0; k < curve->n; k++) {
        double at[2], other[2];
        if (kr_piece_distance(&curve->piece[k], middle) > KR_SHAPE_SAME)
            continue;
        /* They run along each other here: the nearest end of the direction tells the sense. */
        double best = INFINITY, sense = 0;
        for (int s = 0; s <= 64; s++) {
            kr_piece_at(&curve->piece[k], s / 64.0, at, other);
            double far = hypot(at[0] - middle[0], at[1] - middle[1]);
            if (far < best) {
                best = far;
                sense = along[0] * other[0] + along[1] * other[1];
            }
        }
        *left = sense > 0;
        *right = sense < 0;
        return;
    }
    *left = *right = kr_curve_holds(curve, middle);
}

/** Whether a part of curve c bounds the body: 1 as it is, -1 reversed, 0 not. */
static int bounds_body(const struct cutting *all, size_t c, const struct kr_piece *part) {
    int body[2] = {0, 0}, within[2] = {0, 0}; /* left, right: all layers so far, this layer */
    double box[4];
    kr_piece_box(part, box);
    for (size_t other = 0; other < all->n; other++) {
        int inside[2] = {0, 0};
        if (other == c)
            inside[0] = 1;
        else if (boxes_meet(box, all->box[other]))
            sides_in(&all->curve[other], part, &inside[0], &inside[1]);
        /* Of two curves that run along each other the first one's part is kept. */
        if (other < c && inside[0] != inside[1])
            return 0;
        int is_last = other + 1 == all->n || all->layer[other + 1] != all->layer[other];
        for (int side = 0; side < 2; side++) {
            within[side] ^= inside[side];
            if (!is_last)
                continue;
            int is_cut = all->of[all->layer[other]].is_cut;
            body[side] = is_cut ? body[side] && !within[side] : body[side] || within[side];
            within[side] = 0;
        }
    }
    return body[0] - body[1];
}

static void keep(struct parts *parts, struct kr_piece part) {
    KR_GROW(parts->piece, parts->n, parts->room);
    parts->piece[parts->n++] = part;
}

static void cut_piece(const struct cutting *all, size_t c, size_t k, struct parts *parts) {
    const struct kr_piece *piece = &all->curve[c].piece[k];
    size_t n;
    struct kr_meeting *cut = cuts_of(all, c, k, &n);
    double u = 0;
    const double *from = piece->from;
    for (size_t m = 0; m <= n; m++) {
        double v = m < n ? cut[m].u : 1;
        const double *to = m < n ? cut[m].point : piece->to;
        int is_spot = m < n && hypot(to[0] - from[0], to[1] - from[1]) < KR_SHAPE_SAME && v - u < 0.5;
        if (is_spot)
            continue;
        struct kr_piece part = kr_piece_part(piece, u, v, from, to);
        int sense = bounds_body(all, c, &part);
        if (sense)
            keep(parts, sense > 0 ? part : kr_piece_reversed(&part));
        u = v;
        from = to;
    }
    kr_free(cut);
}

/** Turn from leaving `out` back along the end of `in`, clockwise, 0 to 2 pi. */
static double clockwise(const struct kr_piece *in, const struct kr_piece *out) {
    double point[2], a[2], b[2];
    kr_piece_at(in, 1 - 1e-6, point, a);
    kr_piece_at(out, 1e-6, point, b);
    double turn = atan2(-a[1], -a[0]) - atan2(b[1], b[0]);
    return turn <= 0 ? turn + 2 * M_PI : turn;
}

static int starts_at(const struct kr_piece *piece, const double point[2]) {
    return hypot(piece->from[0] - point[0], piece->from[1] - point[1]) < KR_SHAPE_SAME;
}

/** The unused part that goes on where one ends: where several begin, the first clockwise from the
 *  way back, so that what lies on the left stays one piece of body. */
static size_t next_part(const struct parts *parts, const unsigned char *used, size_t at) {
    size_t best = parts->n;
    double least = INFINITY;
    for (size_t k = 0; k < parts->n; k++) {
        if (used[k] || !starts_at(&parts->piece[k], parts->piece[at].to))
            continue;
        double turn = clockwise(&parts->piece[at], &parts->piece[k]);
        if (turn < least) {
            least = turn;
            best = k;
        }
    }
    return best;
}

static struct kr_curve chain(struct parts *parts, unsigned char *used, size_t first) {
    struct kr_curve curve = {0, NULL};
    size_t room = 0, at = first;
    used[first] = 1;
    for (;;) {
        KR_GROW(curve.piece, curve.n, room);
        curve.piece[curve.n++] = parts->piece[at];
        if (starts_at(&parts->piece[first], parts->piece[at].to))
            break;
        size_t next = next_part(parts, used, at);
        if (next == parts->n)
            kr_stop(KR_EXIT_INPUT,
                    "the outline cannot be followed at (%.9g, %.9g) spacings: holes or edges touch "
                    "there without crossing; move one by a little",
                    parts->piece[at].to[0], parts->piece[at].to[1]);
        used[next] = 1;
        at = next;
    }
    for (size_t k = 0; k < curve.n; k++)
        memcpy(curve.piece[k].to, curve.piece[(k + 1) % curve.n].from, sizeof curve.piece[k].to);
    return curve;
}

/** Copies of all curves, ends that stand on each other made one. */
static struct cutting gather(size_t n, const struct kr_layer *layer) {
    struct cutting all = {.of = layer};
    for (size_t l = 0; l < n; l++)
        all.n += layer[l].shape.n_curves;
    all.curve = KR_NEW(struct kr_curve, all.n);
    all.layer = KR_NEW(size_t, all.n);
    all.box = kr_alloc(all.n, sizeof *all.box);
    for (size_t l = 0, c = 0; l < n; l++)
        for (size_t k = 0; k < layer[l].shape.n_curves; k++, c++) {
            all.layer[c] = l;
            all.curve[c] = copy_of(&layer[l].shape.curve[k]);
            kr_curve_box(&all.curve[c], all.box[c]);
            for (size_t other = 0; other < c; other++)
                if (boxes_meet(all.box[c], all.box[other]))
                    unite_ends(&all.curve[c], &all.curve[other]);
        }
    return all;
}

struct kr_shape kr_shape_cut(size_t n, const struct kr_layer *layer) {
    struct cutting all = gather(n, layer);
    struct parts parts = {0, 0, NULL};
    struct kr_shape body = {0, NULL};
    size_t room = 0;
    for (size_t c = 0; c < all.n; c++)
        for (size_t k = 0; k < all.curve[c].n; k++)
            cut_piece(&all, c, k, &parts);
    unsigned char *used = KR_NEW(unsigned char, parts.n);
    for (size_t k = 0; k < parts.n; k++)
        if (!used[k]) {
            KR_GROW(body.curve, body.n_curves, room);
            body.curve[body.n_curves++] = chain(&parts, used, k);
        }
    for (size_t c = 0; c < all.n; c++)
        kr_curve_free(&all.curve[c]);
    kr_free(all.curve);
    kr_free(all.layer);
    kr_free(all.box);
    kr_free(parts.piece);
    kr_free(used);
    return body;
}
