/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Pieces and curves: points, lengths, areas, boxes, inside or outside, distances.
 *
 * Area by Green's theorem, 1/2 of the sum of the integrals of x dy - y dx. On an arc
 * x dy - y dx = centre x dP + (a x b) dt, so that the integral is
 * centre x (to - from) + (a x b)(t1 - t0): exact, whatever part of whatever ellipse it is.
 */
#include "shape.h"

#include "base/memory.h"

#include <math.h>

static double cross(const double *p, const double *q) {
    return p[0] * q[1] - p[1] * q[0];
}

void kr_piece_at(const struct kr_piece *piece, double u, double point[2], double direction[2]) {
    double t = piece->t0 + u * (piece->t1 - piece->t0), c = cos(t), s = sin(t);
    for (int d = 0; d < 2; d++) {
        double along = piece->to[d] - piece->from[d];
        if (piece->is_arc)
            along = (piece->b[d] * c - piece->a[d] * s) * (piece->t1 - piece->t0);
        if (direction)
            direction[d] = along;
        point[d] = u <= 0            ? piece->from[d]
                   : u >= 1          ? piece->to[d]
                   : !piece->is_arc ? piece->from[d] + u * along
                                     : piece->centre[d] + piece->a[d] * c + piece->b[d] * s;
    }
}

double kr_piece_length(const struct kr_piece *piece) {
    /* Simpson's rule: the speed along an ellipse is smooth, and lengths only share out points. */
    enum { HALVES = 64 };
    double sum = 0;
    if (!piece->is_arc)
        return hypot(piece->to[0] - piece->from[0], piece->to[1] - piece->from[1]);
    for (int k = 0; k <= HALVES; k++) {
        double point[2], speed[2];
        kr_piece_at(piece, (double)k / HALVES, point, speed);
        sum += hypot(speed[0], speed[1]) * (k == 0 || k == HALVES ? 1 : k % 2 ? 4 : 2);
    }
    return sum / (3 * HALVES);
}

struct kr_piece kr_piece_reversed(const struct kr_piece *piece) {
    struct kr_piece back = *piece;
    for (int d = 0; d < 2; d++) {
        back.from[d] = piece->to[d];
        back.to[d] = piece->from[d];
    }
    back.t0 = piece->t1;
    back.t1 = piece->t0;
    return back;
}

struct kr_piece kr_piece_part(const struct kr_piece *piece, double u0, double u1,
                              const double from[2], const double to[2]) {
    struct kr_piece part = *piece;
    for (int d = 0; d < 2; d++) {
        part.from[d] = from[d];
        part.to[d] = to[d];
    }
    part.t0 = piece->t0 + u0 * (piece->t1 - piece->t0);
    part.t1 = piece->t0 + u1 * (piece->t1 - piece->t0);
    return part;
}

/** Shares at which an arc turns back in direction d (0: x, 1: y): at most 4, ascending. */
static int turns(const struct kr_piece *piece, int d, double u[4]) {
    double extreme = atan2(piece->b[d], piece->a[d]), span = piece->t1 - piece->t0;
    double least = fmin(piece->t0, piece->t1), most = fmax(piece->t0, piece->t1);
    int n = 0;
    if (!piece->is_arc || span == 0)
        return 0;
    for (double k = ceil((least - extreme) / M_PI); n < 4 && extreme + k * M_PI < most; k++)
        if (extreme + k * M_PI > least)
            u[n++] = (extreme + k * M_PI - piece->t0) / span;
    if (span < 0)
        for (int k = 0; k < n / 2; k++) {
            double swap = u[k];
            u[k] = u[n - 1 - k];
            u[n - 1 - k] = swap;
        }
    return n;
}

void kr_piece_box(const struct kr_piece *piece, double box[4]) {
    for (int d = 0; d < 2; d++) {
        double u[4], point[2];
        box[d] = fmin(piece->from[d], piece->to[d]);
        box[2 + d] = fmax(piece->from[d], piece->to[d]);
        for (int n = turns(piece, d, u), k = 0; k < n; k++) {
            kr_piece_at(piece, u[k], point, NULL);
            box[d] = fmin(box[d], point[d]);
            box[2 + d] = fmax(box[2 + d], point[d]);
        }
    }
}

void kr_curve_box(const struct kr_curve *curve, double box[4]) {
    for (size_t k = 0; k < curve->n; k++) {
        double of[4];
        kr_piece_box(&curve->piece[k], of);
        for (int d = 0; d < 2; d++) {
            box[d] = k ? fmin(box[d], of[d]) : of[d];
            box[2 + d] = k ? fmax(box[2 + d], of[2 + d]) : of[2 + d];
        }
    }
}

double kr_curve_area(const struct kr_curve *curve) {
    const double *o = curve->piece[0].from; /* nothing is lost for a small curve far away */
    double twice = 0;
    for (size_t k = 0; k < curve->n; k++) {
        const struct kr_piece *p = &curve->piece[k];
        double from[2] = {p->from[0] - o[0], p->from[1] - o[1]};
        double along[2] = {p->to[0] - p->from[0], p->to[1] - p->from[1]};
        double centre[2] = {p->centre[0] - o[0], p->centre[1] - o[1]};
        twice += p->is_arc ? cross(centre, along) + cross(p->a, p->b) * (p->t1 - p->t0)
                           : cross(from, along);
    }
    return twice / 2;
}

double kr_shape_area(const struct kr_shape *shape) {
    double area = 0;
    for (size_t k = 0; k < shape->n_curves; k++)
        area += kr_curve_area(&shape->curve[k]);
    return area;
}

/** Share between two ends of a stretch that only rises or only falls, where it has height y. */
static double share_at(const struct kr_piece *piece, double low, double high, double y) {
    double point[2];
    kr_piece_at(piece, high, point, NULL);
    int rises = point[1] > y;
    for (int k = 0; k < 60 && high - low > 1e-16; k++) {
        double middle = (low + high) / 2;
        kr_piece_at(piece, middle, point, NULL);
        if ((point[1] > y) == rises)
            high = middle;
        else
            low = middle;
    }
    return (low + high) / 2;
}

int kr_piece_crossings(const struct kr_piece *piece, double y, double x[2]) {
    double u[6] = {0}, from[2], to[2], at[2];
    int n = turns(piece, 1, u + 1), found = 0;
    u[n + 1] = 1;
    kr_piece_at(piece, 0, from, NULL);
    for (int k = 0; k <= n; k++) {
        kr_piece_at(piece, u[k + 1], to, NULL);
        if ((from[1] > y) != (to[1] > y) && found < 2) {
            at[0] = from[0] + (to[0] - from[0]) * (y - from[1]) / (to[1] - from[1]);
            if (piece->is_arc)
                kr_piece_at(piece, share_at(piece, u[k], u[k + 1], y), at, NULL);
            x[found++] = at[0];
        }
        from[0] = to[0];
        from[1] = to[1];
    }
    return found;
}

int kr_curve_holds(const struct kr_curve *curve, const double point[2]) {
    int inside = 0;
    for (size_t k = 0; k < curve->n; k++) {
        double x[2];
        for (int n = kr_piece_crossings(&curve->piece[k], point[1], x); n > 0; n--)
            inside ^= x[n - 1] > point[0];
    }
    return inside;
}

static int is_whole(const struct kr_piece *piece) {
    return piece->is_arc && fabs(piece->t1 - piece->t0) == 2 * M_PI;
}

static double distance_at(const struct kr_piece *piece, double u, const double point[2]) {
    double at[2];
    if (is_whole(piece)) /* the way goes on past its end */
        u -= floor(u);
    kr_piece_at(piece, u, at, NULL);
    return hypot(at[0] - point[0], at[1] - point[1]);
}

double kr_piece_distance(const struct kr_piece *piece, const double point[2]) {
    enum { SAMPLES = 48 };
    const double golden = 0.3819660112501051;
    double along[2] = {piece->to[0] - piece->from[0], piece->to[1] - piece->from[1]};
    double off[2] = {point[0] - piece->from[0], point[1] - piece->from[1]};
    double squared = along[0] * along[0] + along[1] * along[1], best = INFINITY;
    int nearest = 0;
    if (!piece->is_arc) {
        double u = squared > 0 ? (along[0] * off[0] + along[1] * off[1]) / squared : 0;
        return hypot(off[0] - fmin(fmax(u, 0), 1) * along[0],
                     off[1] - fmin(fmax(u, 0), 1) * along[1]);
    }
    for (int k = 0; k <= SAMPLES; k++) {
        double distance = distance_at(piece, (double)k / SAMPLES, point);
        if (distance < best) {
            best = distance;
            nearest = k;
        }
    }
    double low = (nearest - 1.0) / SAMPLES, high = (nearest + 1.0) / SAMPLES;
    if (!is_whole(piece)) {
        low = fmax(low, 0);
        high = fmin(high, 1);
    }
    for (int k = 0; k < 60; k++) {
        double u = low + golden * (high - low), v = high - golden * (high - low);
        if (distance_at(piece, u, point) < distance_at(piece, v, point))
            high = v;
        else
            low = u;
    }
    return fmin(best, distance_at(piece, (low + high) / 2, point));
}

void kr_curve_reverse(struct kr_curve *curve) {
    for (size_t k = 0, l = curve->n; k < l--; k++) {
        struct kr_piece first = kr_piece_reversed(&curve->piece[k]);
        curve->piece[k] = kr_piece_reversed(&curve->piece[l]);
        curve->piece[l] = first;
    }
}

void kr_curve_free(struct kr_curve *curve) {
    curve->piece = kr_free(curve->piece);
    curve->n = 0;
}

void kr_shape_free(struct kr_shape *shape) {
    for (size_t k = 0; k < shape->n_curves; k++)
        kr_curve_free(&shape->curve[k]);
    shape->curve = kr_free(shape->curve);
    shape->n_curves = 0;
}
