/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From curves to polygons: runs and their corners. The exact area is loop.c's, the sides near a cell are in
 * near_sides.c.
 */
#include "polygon.h"

#include "base/error.h"
#include "base/memory.h"
#include "loop.h"

#include <math.h>
#include <string.h>

/* Smooth pieces below this length share a run with their neighbours: a corner of its own would
 * make sides much shorter than a spacing. */
static const double SHORT = 0.75;
/* A bend below this (radians) is no corner: a curve given by many short pieces is cut as one. Passing
 * such a bend by half a spacing misses it by 0.0025 spacings. */
static const double SMOOTH = 0.01;

/** Pieces `first` to `first + count` (round the curve) that are cut as one. */
struct run {
    size_t first, count;
    double length;
    size_t sides;
    int on_line; /* straight, on a line of the lattice */
};

static int is_whole(double x) {
    return x == nearbyint(x);
}

static int is_on_line(const struct kr_piece *p) {
    return !p->is_arc && ((p->from[0] == p->to[0] && is_whole(p->from[0])) ||
                          (p->from[1] == p->to[1] && is_whole(p->from[1])));
}

static int is_smooth(const struct kr_piece *p, const struct kr_piece *q) {
    double point[2], a[2], b[2];
    kr_piece_at(p, 1, point, a);
    kr_piece_at(q, 0, point, b);
    double sine = a[0] * b[1] - a[1] * b[0], cosine = a[0] * b[0] + a[1] * b[1];
    return cosine > 0 && fabs(sine) < SMOOTH * cosine;
}

/** Whether the place where piece k of a curve begins must stay a corner where it is. */
static int is_corner(const struct kr_curve *curve, size_t k) {
    const struct kr_piece *before = &curve->piece[(k + curve->n - 1) % curve->n];
    const struct kr_piece *here = &curve->piece[k];
    return before->group != here->group || !is_smooth(before, here) || is_on_line(before) ||
           is_on_line(here);
}

/** Whether piece k of a curve begins a run. */
static int begins_run(const struct kr_curve *curve, size_t k) {
    return is_corner(curve, k) ||
           (kr_piece_length(&curve->piece[k]) >= SHORT &&
            kr_piece_length(&curve->piece[(k + curve->n - 1) % curve->n]) >= SHORT);
}

/** Whether the first corner of a run may not move: also where an arc goes on straight. */
static int is_fixed(const struct kr_curve *curve, const struct run *run) {
    size_t before = (run->first + curve->n - 1) % curve->n;
    return is_corner(curve, run->first) ||
           curve->piece[before].is_arc != curve->piece[run->first].is_arc;
}

/** The runs of a curve; owned by the caller. Where nothing begins one, the curve is one run. */
static struct run *runs_of(const struct kr_curve *curve, size_t *n) {
    struct run *run = KR_NEW(struct run, curve->n);
    size_t start = 0;
    while (start < curve->n && !begins_run(curve, start))
        start++;
    start %= curve->n;
    *n = 0;
    for (size_t k = 0; k < curve->n; k++) {
        size_t at = (start + k) % curve->n;
        if (k == 0 || begins_run(curve, at))
            run[(*n)++] = (struct run){.first = at, .on_line = is_on_line(&curve->piece[at])};
        run[*n - 1].count++;
        run[*n - 1].length += kr_piece_length(&curve->piece[at]);
    }
    for (size_t r = 0; r < *n; r++)
        run[r].sides = run[r].length > 1.5 ? (size_t)nearbyint(run[r].length) : 1;
    return run;
}

/** A whole circle or ellipse: sides in fours, 8 at least, for its symmetry. */
static int is_round(const struct kr_curve *curve, size_t n_runs) {
    return n_runs == 1 && curve->n == 1 && curve->piece[0].is_arc;
}

static size_t sides_on_line(const struct kr_piece *piece, int n_corners, double *corner) {
    int d = piece->from[0] == piece->to[0];
    double from = piece->from[d], to = piece->to[d], step = to > from ? 1 : -1;
    size_t sides = 1;
    /* A lattice point nearer than half a spacing to an end off the lattice is left out. */
    for (double x = step > 0 ? floor(from) + 1 : ceil(from) - 1; (to - x) * step > 0; x += step) {
        if ((!is_whole(from) && fabs(x - from) < 0.5) || (!is_whole(to) && fabs(to - x) < 0.5))
            continue;
        if (n_corners)
            corner[sides - 1] = x;
        sides++;
    }
    return sides;
}

/** Share out the sides, an even number over the loop. */
static void count_sides(const struct kr_curve *curve, size_t n_runs, struct run *run) {
    size_t total = 0, longest = n_runs;
    double most = 0;
    if (is_round(curve, n_runs)) {
        double fours = nearbyint(run[0].length / 4);
        run[0].sides = 4 * (fours > 2 ? (size_t)fours : 2);
        return;
    }
    for (size_t r = 0; r < n_runs; r++) {
        if (run[r].on_line)
            run[r].sides = sides_on_line(&curve->piece[run[r].first], 0, NULL);
        else if (run[r].length / (double)run[r].sides > most) {
            most = run[r].length / (double)run[r].sides;
            longest = r;
        }
        total += run[r].sides;
    }
    if (total % 2 && longest < n_runs)
        run[longest].sides++;
}

/** What moves a point on an arc outward: its normal by curvature times the square of the side. */
static void bulge_at(const struct kr_piece *piece, double u, double side, double bulge[2]) {
    double p[2], along[2];
    bulge[0] = bulge[1] = 0;
    if (!piece->is_arc)
        return;
    /* P' x P'' = a x b on every ellipse, t its parameter. */
    kr_piece_at(piece, u, p, along);
    double span = piece->t1 - piece->t0, speed = hypot(along[0], along[1]);
    double ab = piece->a[0] * piece->b[1] - piece->a[1] * piece->b[0];
    double curvature = ab * span * span * span / (speed * speed * speed);
    bulge[0] = curvature * side * side * along[1] / speed;
    bulge[1] = -curvature * side * side * along[0] / speed;
}

/** Share of a piece's parameter at a length along it. */
static double share_at_length(const struct kr_piece *piece, double length) {
    double low = 0, high = 1, whole = kr_piece_length(piece);
    int is_circle = piece->is_arc && fabs(hypot(piece->a[0], piece->a[1]) -
                                          hypot(piece->b[0], piece->b[1])) < KR_SHAPE_SAME;
    if (!piece->is_arc || is_circle)
        return fmin(length / whole, 1);
    for (int k = 0; k < 40; k++) {
        double middle = (low + high) / 2, point[2];
        kr_piece_at(piece, middle, point, NULL);
        struct kr_piece part = kr_piece_part(piece, 0, middle, piece->from, point);
        *(kr_piece_length(&part) < length ? &low : &high) = middle;
    }
    return (low + high) / 2;
}

static void cut_run(const struct kr_curve *curve, const struct run *run, struct kr_loop *loop) {
    double side = run->length / (double)run->sides, passed = 0, bulge[2];
    size_t at = 0;
    for (size_t k = 0; k < run->sides; k++) {
        const struct kr_piece *piece = &curve->piece[(run->first + at) % curve->n];
        double length = kr_piece_length(piece), point[2];
        while (at + 1 < run->count && (double)k * side > passed + length) {
            passed += length;
            piece = &curve->piece[(run->first + ++at) % curve->n];
            length = kr_piece_length(piece);
        }
        double u = k ? share_at_length(piece, (double)k * side - passed) : 0;
        kr_piece_at(piece, u, point, NULL);
        bulge_at(piece, u, side, bulge);
        if (k == 0 && is_fixed(curve, run))
            bulge[0] = bulge[1] = 0;
        kr_loop_add(loop, point, bulge, piece->group, 0);
    }
}

static void cut_run_on_line(const struct kr_piece *piece, const struct run *run,
                            struct kr_loop *loop) {
    double *corner = KR_NEW(double, run->sides), point[2];
    const double none[2] = {0, 0};
    int d = piece->from[0] == piece->to[0];
    sides_on_line(piece, 1, corner);
    kr_loop_add(loop, piece->from, none, piece->group, 1);
    for (size_t k = 0; k + 1 < run->sides; k++) {
        memcpy(point, piece->from, sizeof point);
        point[d] = corner[k];
        kr_loop_add(loop, point, none, piece->group, 1);
    }
    kr_free(corner);
}

static struct kr_loop cut_curve(const struct kr_curve *curve) {
    struct kr_loop loop = {0};
    size_t n;
    struct run *run = runs_of(curve, &n);
    count_sides(curve, n, run);
    for (size_t r = 0; r < n; r++)
        if (run[r].on_line)
            cut_run_on_line(&curve->piece[run[r].first], &run[r], &loop);
        else
            cut_run(curve, &run[r], &loop);
    kr_free(run);
    if (loop.n > 2)
        kr_loop_mend(&loop, kr_curve_area(curve));
    return loop;
}

static void append(struct kr_polygon *polygon, const struct kr_loop *loop) {
    size_t n = polygon->n, total = n + loop->n;
    polygon->point = kr_realloc(polygon->point, 2 * total, sizeof *polygon->point);
    polygon->next = kr_realloc(polygon->next, total, sizeof *polygon->next);
    polygon->group = kr_realloc(polygon->group, total, sizeof *polygon->group);
    polygon->on_line = kr_realloc(polygon->on_line, total, sizeof *polygon->on_line);
    for (size_t k = 0; k < loop->n; k++) {
        memcpy(polygon->point + 2 * (n + k), loop->point[k], sizeof *loop->point);
        polygon->next[n + k] = n + (k + 1 < loop->n ? k + 1 : 0);
        polygon->group[n + k] = loop->group[k];
        polygon->on_line[n + k] = loop->on_line[k];
    }
    polygon->area += kr_loop_area(loop);
    polygon->n = total;
}

/** Whether sides k and l cross or touch, common corners aside. */
static int sides_cross(const struct kr_polygon *polygon, size_t k, size_t l) {
    const double *a = polygon->point + 2 * k, *b = polygon->point + 2 * polygon->next[k];
    const double *c = polygon->point + 2 * l, *d = polygon->point + 2 * polygon->next[l];
    double x = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    double y = (b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]);
    double z = (d[0] - c[0]) * (a[1] - c[1]) - (d[1] - c[1]) * (a[0] - c[0]);
    double w = (d[0] - c[0]) * (b[1] - c[1]) - (d[1] - c[1]) * (b[0] - c[0]);
    return polygon->next[k] != l && polygon->next[l] != k && (x > 0) != (y > 0) &&
           (z > 0) != (w > 0);
}

static void check_apart(const struct kr_polygon *polygon, const struct kr_lattice *lattice) {
    struct kr_near_sides near = kr_near_sides_of(polygon, lattice);
    for (size_t c = 0; c < lattice->columns * lattice->rows; c++)
        for (size_t m = near.first[c]; m < near.first[c + 1]; m++)
            for (size_t n = near.first[c]; n < m; n++)
                if (sides_cross(polygon, near.side[m], near.side[n])) {
                    const double *p = polygon->point + 2 * near.side[m];
                    kr_stop(KR_EXIT_INPUT,
                            "near (%.9g, %.9g) mm two edges come so near each other that sides of "
                            "%.9g mm cross: move them apart, let them overlap, or take a finer "
                            "spacing",
                            1e3 * p[0] * lattice->spacing, 1e3 * p[1] * lattice->spacing,
                            1e3 * lattice->spacing);
                }
    kr_near_sides_free(&near);
}

struct kr_polygon kr_polygon_of(const struct kr_shape *shape, const struct kr_lattice *lattice) {
    struct kr_polygon polygon = {0};
    for (size_t k = 0; k < shape->n_curves; k++) {
        struct kr_loop loop = cut_curve(&shape->curve[k]);
        if (loop.n > 2)
            append(&polygon, &loop);
        kr_loop_free(&loop);
    }
    if (polygon.n == 0)
        kr_stop(KR_EXIT_INPUT, "the holes leave nothing of the plate");
    check_apart(&polygon, lattice);
    return polygon;
}

size_t kr_polygon_split(struct kr_polygon *polygon, size_t side) {
    size_t n = polygon->n++, next = polygon->next[side];
    polygon->point = kr_realloc(polygon->point, 2 * polygon->n, sizeof *polygon->point);
    polygon->next = kr_realloc(polygon->next, polygon->n, sizeof *polygon->next);
    polygon->group = kr_realloc(polygon->group, polygon->n, sizeof *polygon->group);
    polygon->on_line = kr_realloc(polygon->on_line, polygon->n, sizeof *polygon->on_line);
    for (int d = 0; d < 2; d++)
        polygon->point[2 * n + (size_t)d] =
            (polygon->point[2 * side + (size_t)d] + polygon->point[2 * next + (size_t)d]) / 2;
    polygon->next[side] = n;
    polygon->next[n] = next;
    polygon->group[n] = polygon->group[side];
    polygon->on_line[n] = polygon->on_line[side];
    return n;
}

void kr_polygon_free(struct kr_polygon *polygon) {
    kr_free(polygon->point);
    kr_free(polygon->next);
    kr_free(polygon->group);
    kr_free(polygon->on_line);
    *polygon = (struct kr_polygon){0};
}
