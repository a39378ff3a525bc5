/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Where two pieces meet. A meeting is an end of one that lies on the other, or a true crossing. The
 * crossings of an arc are the zeros of (distance from its centre in its own measure)^2 - 1 along
 * the other piece: found between samples, then halved. Pieces that only touch between their ends
 * do not cross, and need not be cut.
 */
#include "shape.h"

#include <math.h>
#include <string.h>

enum { MOST = 16 };

/** Share of the parameter of the point of a piece nearest to a point that lies on it. */
static double share_of(const struct kr_piece *piece, const double point[2]) {
    if (!piece->is_arc) {
        double x = piece->to[0] - piece->from[0], y = piece->to[1] - piece->from[1];
        return ((point[0] - piece->from[0]) * x + (point[1] - piece->from[1]) * y) /
               (x * x + y * y);
    }
    double x = point[0] - piece->centre[0], y = point[1] - piece->centre[1];
    double det = piece->a[0] * piece->b[1] - piece->a[1] * piece->b[0];
    double t = atan2((piece->a[0] * y - piece->a[1] * x) / det,
                     (x * piece->b[1] - y * piece->b[0]) / det);
    double span = piece->t1 - piece->t0, u = (t - piece->t0) / span;
    double round = fabs(2 * M_PI / span); /* a full turn, as a share */
    return u - round * floor(u / round + 1e-9);
}

static int is_same(const double p[2], const double q[2]) {
    return hypot(p[0] - q[0], p[1] - q[1]) < KR_SHAPE_SAME;
}

/** Note a meeting once; ends near it are it. */
static int note(const struct kr_piece *p, const struct kr_piece *q, const double point[2],
                struct kr_meeting *at, int n) {
    struct kr_meeting new = {share_of(p, point), share_of(q, point), {point[0], point[1]}};
    for (int k = 0; k < n; k++)
        if (is_same(at[k].point, point))
            return n;
    if (is_same(q->from, point) || is_same(q->to, point))
        new.v = is_same(q->from, point) ? 0 : 1;
    if (is_same(p->from, point) || is_same(p->to, point))
        new.u = is_same(p->from, point) ? 0 : 1;
    /* A crossing that misses a line of the lattice by rounding alone stands on it. */
    for (int d = 0; d < 2; d++)
        if (fabs(point[d] - nearbyint(point[d])) < KR_SHAPE_SAME)
            new.point[d] = nearbyint(point[d]);
    if (n == MOST || !(new.u >= 0 && new.u <= 1 && new.v >= 0 && new.v <= 1))
        return n;
    if (new.v == 0 || new.v == 1)
        memcpy(new.point, new.v == 0 ? q->from : q->to, sizeof new.point);
    if (new.u == 0 || new.u == 1)
        memcpy(new.point, new.u == 0 ? p->from : p->to, sizeof new.point);
    at[n] = new;
    return n + 1;
}

static int note_ends(const struct kr_piece *p, const struct kr_piece *q, struct kr_meeting *at) {
    int n = 0;
    for (int k = 0; k < 2; k++)
        if (kr_piece_distance(q, k ? p->to : p->from) < KR_SHAPE_SAME)
            n = note(p, q, k ? p->to : p->from, at, n);
    for (int k = 0; k < 2; k++)
        if (kr_piece_distance(p, k ? q->to : q->from) < KR_SHAPE_SAME)
            n = note(p, q, k ? q->to : q->from, at, n);
    return n;
}

/** Zero on the ellipse, or on the endless line, of a piece. */
static double off(const struct kr_piece *piece, const double point[2]) {
    if (!piece->is_arc)
        return (piece->to[0] - piece->from[0]) * (point[1] - piece->from[1]) -
               (piece->to[1] - piece->from[1]) * (point[0] - piece->from[0]);
    double x = point[0] - piece->centre[0], y = point[1] - piece->centre[1];
    double det = piece->a[0] * piece->b[1] - piece->a[1] * piece->b[0];
    double c = (x * piece->b[1] - y * piece->b[0]) / det;
    double s = (piece->a[0] * y - piece->a[1] * x) / det;
    return c * c + s * s - 1;
}

static double off_at(const struct kr_piece *along, double u, const struct kr_piece *of,
                     double point[2]) {
    kr_piece_at(along, u, point, NULL);
    return off(of, point);
}

/** Whether a crossing at share u of p is only a noted meeting where the pieces touch: they are one
 *  all the way to it, and the sign that changed was that of rounding. */
static int is_touch(const struct kr_piece *p, const struct kr_piece *q, double u,
                    const struct kr_meeting *at, int n) {
    double point[2];
    for (int k = 0; k < n; k++) {
        kr_piece_at(p, (u + at[k].u) / 2, point, NULL);
        if (hypot(point[0] - at[k].point[0], point[1] - at[k].point[1]) < 0.05 &&
            kr_piece_distance(q, point) < KR_SHAPE_SAME)
            return 1;
    }
    return 0;
}

static int note_crossing(const struct kr_piece *p, const struct kr_piece *q, double low,
                         double high, struct kr_meeting *at, int n) {
    double point[2], off_low = off_at(p, low, q, point);
    for (int k = 0; k < 60; k++) {
        double middle = (low + high) / 2, off_middle = off_at(p, middle, q, point);
        if ((off_middle > 0) == (off_low > 0))
            low = middle;
        else
            high = middle;
    }
    kr_piece_at(p, (low + high) / 2, point, NULL);
    return is_touch(p, q, (low + high) / 2, at, n) ? n : note(p, q, point, at, n);
}

static int boxes_part(const struct kr_piece *p, const struct kr_piece *q) {
    double a[4], b[4];
    kr_piece_box(p, a);
    kr_piece_box(q, b);
    for (int d = 0; d < 2; d++)
        if (a[d] > b[2 + d] + KR_SHAPE_SAME || b[d] > a[2 + d] + KR_SHAPE_SAME)
            return 1;
    return 0;
}

int kr_pieces_meet(const struct kr_piece *p, const struct kr_piece *q, struct kr_meeting at[16]) {
    if (boxes_part(p, q))
        return 0;
    int n = note_ends(p, q, at), samples = p->is_arc || q->is_arc ? 512 : 1;
    double before, point[2];
    before = off_at(p, 0, q, point);
    for (int k = 1; k <= samples; k++) {
        double now = off_at(p, (double)k / samples, q, point);
        /* Along a common stretch the signs are those of rounding. */
        if ((before > 0) != (now > 0) && fabs(before - now) > 1e-10)
            n = note_crossing(p, q, (k - 1.0) / samples, (double)k / samples, at, n);
        before = now;
    }
    return n;
}
