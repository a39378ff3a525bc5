/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From the deck's words to curves. A curve is made about the origin in metres, turned, moved, and
 * only then measured in spacings.
 */
#include "base/error.h"
#include "base/memory.h"
#include "shape.h"

#include <math.h>
#include <string.h>

static void add_line(struct kr_curve *curve, const double from[2], const double to[2]) {
    struct kr_piece piece = {.from = {from[0], from[1]}, .to = {to[0], to[1]}};
    curve->piece = kr_realloc(curve->piece, curve->n + 1, sizeof *curve->piece);
    curve->piece[curve->n++] = piece;
}

static void add_arc(struct kr_curve *curve, const double centre[2], const double a[2],
                    const double b[2], double angle) {
    struct kr_piece piece = {.is_arc = 1, .t1 = angle};
    for (int d = 0; d < 2; d++) {
        piece.centre[d] = centre[d];
        piece.a[d] = a[d];
        piece.b[d] = b[d];
        piece.from[d] = centre[d] + a[d];
        piece.to[d] = angle == 2 * M_PI ? piece.from[d]
                                        : centre[d] + a[d] * cos(angle) + b[d] * sin(angle);
    }
    curve->piece = kr_realloc(curve->piece, curve->n + 1, sizeof *curve->piece);
    curve->piece[curve->n++] = piece;
}

static void add_ellipse(struct kr_curve *curve, double rx, double ry) {
    add_arc(curve, (double[]){0, 0}, (double[]){rx, 0}, (double[]){0, ry}, 2 * M_PI);
}

static void add_slot(struct kr_curve *curve, double length, double width) {
    double x = (length - width) / 2, r = width / 2;
    add_line(curve, (double[]){-x, -r}, (double[]){x, -r});
    add_arc(curve, (double[]){x, 0}, (double[]){0, -r}, (double[]){r, 0}, M_PI);
    add_line(curve, (double[]){x, r}, (double[]){-x, r});
    add_arc(curve, (double[]){-x, 0}, (double[]){0, r}, (double[]){-r, 0}, M_PI);
}

/** One corner of a polygon: its place, and what a rounding of radius r takes from its sides. */
struct corner {
    const double *at;
    double in[2], out[2]; /* directions of the sides that end and begin here */
    double turn, taken;   /* angle, to the left if positive; length */
};

static double unit_along(const double from[2], const double to[2], double direction[2]) {
    double length = hypot(to[0] - from[0], to[1] - from[1]);
    for (int d = 0; d < 2; d++)
        direction[d] = length > 0 ? (to[d] - from[d]) / length : 0;
    return length;
}

static struct corner corner_of(size_t n, const double *point, size_t k, double radius) {
    struct corner c = {.at = point + 2 * k};
    unit_along(point + 2 * ((k + n - 1) % n), c.at, c.in);
    unit_along(c.at, point + 2 * ((k + 1) % n), c.out);
    c.turn = atan2(c.in[0] * c.out[1] - c.in[1] * c.out[0], c.in[0] * c.out[0] + c.in[1] * c.out[1]);
    c.taken = radius * tan(fabs(c.turn) / 2);
    return c;
}

static void add_rounding(struct kr_curve *curve, const struct corner *c, double radius) {
    double side = c->turn > 0 ? radius : -radius, a[2], b[2], centre[2];
    const double left[2] = {-c->in[1], c->in[0]};
    for (int d = 0; d < 2; d++) {
        a[d] = -side * left[d];
        b[d] = radius * c->in[d];
        centre[d] = c->at[d] - c->taken * c->in[d] + side * left[d];
    }
    add_arc(curve, centre, a, b, fabs(c->turn));
}

static void add_polygon(struct kr_curve *curve, size_t n, const double *point, double radius,
                        const char *name) {
    for (size_t k = 0; k < n; k++) {
        struct corner here = corner_of(n, point, k, radius);
        struct corner next = corner_of(n, point, (k + 1) % n, radius);
        double side[2], length = unit_along(here.at, next.at, side);
        if (!(length > 0))
            kr_stop(KR_EXIT_INPUT, "%s: two corners in a row stand at (%g, %g) m", name,
                    here.at[0], here.at[1]);
        double straight = length - here.taken - next.taken;
        if (!(straight >= -1e-9 * length))
            kr_stop(KR_EXIT_INPUT,
                    "%s: a corner radius of %g m does not fit the side of %g m that begins at "
                    "(%g, %g) m",
                    name, radius, length, here.at[0], here.at[1]);
        if (radius > 0 && here.turn != 0)
            add_rounding(curve, &here, radius);
        if (straight > 1e-9 * length)
            add_line(curve,
                     (double[]){here.at[0] + here.taken * side[0], here.at[1] + here.taken * side[1]},
                     (double[]){next.at[0] - next.taken * side[0],
                                next.at[1] - next.taken * side[1]});
    }
}

static void add_corners(struct kr_curve *curve, const struct kr_case_hole *hole, const char *name) {
    const double x = hole->size[0] / 2, y = hole->size[1] / 2;
    const double corner[] = {-x, -y, x, -y, x, y, -x, y};
    if (hole->shape == KR_HOLE_RECTANGLE)
        add_polygon(curve, 4, corner, hole->corner_radius, name);
    else
        add_polygon(curve, hole->points.count / 2, hole->points.item, hole->corner_radius, name);
}

/** Turned, moved, in spacings; what misses a whole number by rounding alone becomes whole. */
static void place(const struct kr_case_hole *hole, double spacing, double v[2], int is_point) {
    double c = cos(hole->angle), s = sin(hole->angle);
    double x = hole->angle == 0 ? v[0] : c * v[0] - s * v[1];
    double y = hole->angle == 0 ? v[1] : s * v[0] + c * v[1];
    v[0] = (x + (is_point ? hole->centre[0] : 0)) / spacing;
    v[1] = (y + (is_point ? hole->centre[1] : 0)) / spacing;
    for (int d = 0; d < 2 && is_point; d++)
        if (fabs(v[d] - nearbyint(v[d])) < KR_SHAPE_SAME)
            v[d] = nearbyint(v[d]);
}

/** Ends of neighbours become one, to the last bit. */
static void close_up(struct kr_curve *curve) {
    for (size_t k = 0; k < curve->n; k++)
        memcpy(curve->piece[k].to, curve->piece[(k + 1) % curve->n].from,
               sizeof curve->piece[k].to);
}

/* Behind the deck's own check of corners: neighbouring sides that fold back, rounded and curved edges. */
static void check_simple(const struct kr_curve *curve, double spacing, const char *name) {
    for (size_t k = 0; k < curve->n; k++)
        for (size_t l = 0; l < k; l++) {
            struct kr_meeting at[16];
            int n = kr_pieces_meet(&curve->piece[k], &curve->piece[l], at);
            for (int m = 0; m < n; m++)
                if ((at[m].u > 0 && at[m].u < 1) || (at[m].v > 0 && at[m].v < 1) ||
                    ((l + 1 != k) && !(l == 0 && k + 1 == curve->n)))
                    kr_stop(KR_EXIT_INPUT,
                            "%s: its edge meets itself at (%g, %g) mm; give its corners in turn, so "
                            "that no two sides meet",
                            name, 1e3 * spacing * at[m].point[0], 1e3 * spacing * at[m].point[1]);
        }
}

struct kr_curve kr_curve_of_hole(const struct kr_case_hole *hole, double spacing, int group,
                                 const char *name) {
    struct kr_curve curve = {0, NULL};
    switch ((enum kr_hole_shape)hole->shape) {
    case KR_HOLE_CIRCLE:
        add_ellipse(&curve, hole->radius, hole->radius);
        break;
    case KR_HOLE_ELLIPSE:
        add_ellipse(&curve, hole->radii[0], hole->radii[1]);
        break;
    case KR_HOLE_SLOT:
        add_slot(&curve, hole->length, hole->width);
        break;
    case KR_HOLE_RECTANGLE:
    case KR_HOLE_POLYGON:
        add_corners(&curve, hole, name);
        break;
    }
    for (size_t k = 0; k < curve.n; k++) {
        struct kr_piece *piece = &curve.piece[k];
        place(hole, spacing, piece->from, 1);
        place(hole, spacing, piece->centre, 1);
        place(hole, spacing, piece->a, 0);
        place(hole, spacing, piece->b, 0);
        piece->group = group;
    }
    close_up(&curve);
    if (kr_curve_area(&curve) < 0)
        kr_curve_reverse(&curve);
    if (!(kr_curve_area(&curve) > 0) || !isfinite(kr_curve_area(&curve)))
        kr_stop(KR_EXIT_INPUT, "%s bounds no area; its sizes must be positive", name);
    check_simple(&curve, spacing, name);
    return curve;
}

struct kr_curve kr_curve_frame(double width, double height) {
    const double corner[] = {0, 0, width, 0, width, height, 0, height};
    const int group[] = {2, 1, 3, 0}; /* bottom, right, top, left */
    struct kr_curve curve = {0, NULL};
    for (size_t k = 0; k < 4; k++) {
        add_line(&curve, corner + 2 * k, corner + 2 * ((k + 1) % 4));
        curve.piece[k].group = group[k];
    }
    return curve;
}
