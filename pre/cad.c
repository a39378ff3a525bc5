/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From what kirsch-gmsh says of a CAD file to closed curves. See cad.h.
 *
 * An arc of an ellipse between two tangents that meet in Q:  c + a cos t + b sin t,  -h <= t <= h,
 *    a = (Q - M)/(1/cos h - cos h),  b = (P1 - P0)/(2 sin h),  c = M - a cos h,
 * M the middle of the chord. It passes the median M Q at the share s = cos h/(1 + cos h) of it; so
 * cos h = s/(1 - s) takes it through a third point. (A conic in the form of Liming, by weights
 * R. A. Liming, Practical Analytic Geometry, 1944.)
 */
#include "cad.h"

#include "base/child.h"
#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <stdint.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

enum { SECONDS = 300, MOST_POINTS = 4097 };

/** A curve as it was told: points and derivatives, in spacings and in place. */
struct told {
    char kind[16];
    size_t n;
    double span;
    double (*at)[4];
};

static void add_piece(struct kr_curve *curve, struct kr_piece piece) {
    curve->piece = kr_realloc(curve->piece, curve->n + 1, sizeof *curve->piece);
    curve->piece[curve->n++] = piece;
}

static struct kr_piece line_between(const double *from, const double *to) {
    return (struct kr_piece){.from = {from[0], from[1]}, .to = {to[0], to[1]}};
}

/** The arc through begin, middle and end. From P(h) - P(0) = a (cos h - 1) + b sin h, b = P'(0). */
static struct kr_piece round_of(const struct told *t) {
    const double *p = t->at[0], *middle = t->at[1], *end = t->at[2], half = t->span / 2;
    double lost = 2 * sin(half / 2) * sin(half / 2); /* 1 - cos h, all digits kept */
    struct kr_piece piece = {.is_arc = 1, .t1 = t->span};
    for (int d = 0; d < 2; d++) {
        piece.from[d] = p[d];
        piece.b[d] = p[2 + d];
        piece.a[d] = (p[d] - middle[d] + piece.b[d] * sin(half)) / lost;
        piece.centre[d] = p[d] - piece.a[d];
        piece.to[d] = end[d];
    }
    return piece;
}

/** Where the tangents of two points meet; 0 where they do not, before the one and behind the
 *  other, turning by less than half a right angle. */
static int tangents_meet(const double *p, const double *q, double meet[2]) {
    double cross = p[2] * q[3] - p[3] * q[2], dot = p[2] * q[2] + p[3] * q[3];
    double x = q[0] - p[0], y = q[1] - p[1];
    if (!(fabs(cross) > 1e-9 * dot) || fabs(cross) > dot)
        return 0;
    double u = (x * q[3] - y * q[2]) / cross, v = (x * p[3] - y * p[2]) / cross;
    meet[0] = p[0] + u * p[2];
    meet[1] = p[1] + u * p[3];
    return u > 0 && v < 0;
}

/** The arc from point i to point j; 0 where there is none. */
static int arc_between(const struct told *t, size_t i, size_t j, struct kr_piece *piece) {
    const double *p = t->at[i], *q = t->at[j], *s = t->at[(i + j) / 2];
    double meet[2], m[2] = {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2};
    if (!tangents_meet(p, q, meet))
        return 0;
    /* How high the curve stands over its chord, as a share of how high the tangents meet. */
    double chord[2] = {q[0] - p[0], q[1] - p[1]};
    double high = chord[0] * (meet[1] - m[1]) - chord[1] * (meet[0] - m[0]);
    double share = (chord[0] * (s[1] - m[1]) - chord[1] * (s[0] - m[0])) / high;
    double cosine = fmin(fmax(share / (1 - share), 0.5), 0.9999), sine = sqrt(1 - cosine * cosine);
    double half = acos(cosine);
    *piece = (struct kr_piece){.is_arc = 1, .t0 = -half, .t1 = half};
    for (int d = 0; d < 2; d++) {
        piece->a[d] = (meet[d] - m[d]) / (1 / cosine - cosine);
        piece->b[d] = chord[d] / (2 * sine);
        piece->centre[d] = m[d] - piece->a[d] * cosine;
        piece->from[d] = p[d];
        piece->to[d] = q[d];
    }
    return 1;
}

static int is_near(const struct told *t, size_t i, size_t j, const struct kr_piece *piece) {
    for (size_t k = i + 1; k < j; k++)
        if (!(kr_piece_distance(piece, t->at[k]) <= KR_CAD_OFF))
            return 0;
    return 1;
}

/** Pieces for the points i to j of a free curve: an arc if it is near enough, else those of both
 *  halves; between neighbours, where it changes the side to which it bends, a line. */
static void fit(const struct told *t, size_t i, size_t j, struct kr_curve *curve) {
    struct kr_piece piece;
    if (j == i + 1)
        add_piece(curve, line_between(t->at[i], t->at[j]));
    else if (arc_between(t, i, j, &piece) && is_near(t, i, j, &piece))
        add_piece(curve, piece);
    else {
        fit(t, i, (i + j) / 2, curve);
        fit(t, (i + j) / 2, j, curve);
    }
}

/** Whether all points of a free curve stand on the line between its ends. */
static int is_straight(const struct told *t) {
    struct kr_piece line = line_between(t->at[0], t->at[t->n - 1]);
    for (size_t k = 1; k + 1 < t->n; k++)
        if (!(kr_piece_distance(&line, t->at[k]) < KR_SHAPE_SAME))
            return 0;
    return 1;
}

_Noreturn static void bad_reply(const char *path) {
    kr_stop(KR_EXIT_LIBRARY, "%s: kirsch-gmsh told its curves in a way that is not understood",
            path);
}

/** From the file's metres to spacings, in place. */
static void lay(const struct kr_cad_place *place, double at[4]) {
    double c = cos(place->angle), s = sin(place->angle);
    for (int k = 0; k < 2; k++) {
        double x = at[2 * k], y = at[2 * k + 1];
        at[2 * k] = (c * x - s * y + (k ? 0 : place->origin[0])) / place->spacing;
        at[2 * k + 1] = (s * x + c * y + (k ? 0 : place->origin[1])) / place->spacing;
    }
    /* Readers of CAD round in the tenth decimal of a millimetre: what misses a line of the lattice
       by no more stands on it. */
    for (int d = 0; d < 2; d++)
        if (fabs(at[d] - nearbyint(at[d])) < 10 * KR_SHAPE_SAME)
            at[d] = nearbyint(at[d]);
}

static struct told read_curve(FILE *file, const char *path, const struct kr_cad_place *place) {
    struct told t = {.at = NULL};
    if (fscanf(file, " curve %15s %zu %lf", t.kind, &t.n, &t.span) != 3 || t.n < 2 ||
        t.n > MOST_POINTS)
        bad_reply(path);
    t.at = kr_alloc(t.n, sizeof *t.at);
    for (size_t k = 0; k < t.n; k++) {
        double *at = t.at[k];
        if (fscanf(file, "%lf %lf %lf %lf", &at[0], &at[1], &at[2], &at[3]) != 4 ||
            !isfinite(at[0] + at[1] + at[2] + at[3]))
            bad_reply(path);
        lay(place, at);
    }
    return t;
}

static struct kr_curve pieces_of(const struct told *t, const char *path) {
    struct kr_curve curve = {0, NULL};
    int is_free = !strcmp(t->kind, "other") && t->n > 4;
    if ((!strcmp(t->kind, "line") && t->n == 2) || (is_free && is_straight(t)))
        add_piece(&curve, line_between(t->at[0], t->at[t->n - 1]));
    else if (!strcmp(t->kind, "round") && t->n == 3 && t->span > 0 && t->span < 6.2832)
        add_piece(&curve, round_of(t));
    else if (is_free)
        fit(t, 0, t->n - 1, &curve);
    else
        bad_reply(path);
    return curve;
}

static int is_same(const double p[2], const double q[2]) {
    return hypot(p[0] - q[0], p[1] - q[1]) < 100 * KR_SHAPE_SAME;
}

/** Append a curve that begins (or, reversed, ends) where another ends. */
static int append(struct kr_curve *to, struct kr_curve *from) {
    const double *end = to->piece[to->n - 1].to;
    if (!from->n)
        return 0;
    if (!is_same(end, from->piece[0].from)) {
        if (!is_same(end, from->piece[from->n - 1].to))
            return 0;
        kr_curve_reverse(from);
    }
    for (size_t k = 0; k < from->n; k++)
        add_piece(to, from->piece[k]);
    kr_curve_free(from);
    *from = (struct kr_curve){0, NULL};
    return 1;
}

/** Chain open curves to closed ones; each is emptied. */
static void close_loop(struct kr_curve *loop, size_t n, struct kr_curve *curve, const char *path) {
    while (!is_same(loop->piece[loop->n - 1].to, loop->piece[0].from)) {
        size_t k = 0;
        while (k < n && !append(loop, &curve[k]))
            k++;
        if (k == n)
            kr_stop(KR_EXIT_INPUT,
                    "%s: the edge of a face is open at (%.9g, %.9g) spacings; mend the file", path,
                    loop->piece[loop->n - 1].to[0], loop->piece[loop->n - 1].to[1]);
    }
    for (size_t k = 0; k < loop->n; k++)
        memcpy(loop->piece[k].to, loop->piece[(k + 1) % loop->n].from, sizeof loop->piece[k].to);
    if (kr_curve_area(loop) < 0)
        kr_curve_reverse(loop);
}

static struct kr_shape face_of(size_t n, struct kr_curve *curve, const char *path) {
    struct kr_shape shape = {0, KR_NEW(struct kr_curve, n)};
    size_t outer = 0;
    for (size_t k = 0; k < n; k++) {
        if (!curve[k].n)
            continue;
        struct kr_curve loop = curve[k];
        curve[k] = (struct kr_curve){0, NULL};
        close_loop(&loop, n, curve, path);
        shape.curve[shape.n_curves++] = loop;
        if (kr_curve_area(&loop) > kr_curve_area(&shape.curve[outer]))
            outer = shape.n_curves - 1;
    }
    struct kr_curve first = shape.curve[outer];
    shape.curve[outer] = shape.curve[0];
    shape.curve[0] = first;
    return shape;
}

size_t kr_cad_parse(FILE *file, const char *path, const struct kr_cad_place *place,
                    struct kr_shape **face) {
    size_t n, count;
    char end[4] = "";
    if (fscanf(file, " faces %zu", &n) != 1 || n < 1 || n > 100000)
        bad_reply(path);
    *face = KR_NEW(struct kr_shape, n);
    for (size_t f = 0; f < n; f++) {
        if (fscanf(file, " face %zu", &count) != 1 || count < 1 || count > 1000000)
            bad_reply(path);
        struct kr_curve *curve = KR_NEW(struct kr_curve, count);
        for (size_t k = 0; k < count; k++) {
            struct told t = read_curve(file, path, place);
            curve[k] = pieces_of(&t, path);
            kr_free(t.at);
        }
        (*face)[f] = face_of(count, curve, path);
        kr_free(curve);
    }
    if (fscanf(file, " %3s", end) != 1 || strcmp(end, "end"))
        bad_reply(path);
    return n;
}

const char *kr_cad_format(const char *path) {
    static const char *const known[][2] = {{"step", "step"}, {"stp", "step"}, {"iges", "iges"},
                                           {"igs", "iges"},  {"brep", "brep"}};
    const char *dot = strrchr(path, '.');
    for (size_t k = 0; dot && k < sizeof known / sizeof *known; k++)
        if (!strcasecmp(dot + 1, known[k][0]))
            return known[k][1];
    return NULL;
}

size_t kr_cad_read(const char *path, const char *helper, const struct kr_cad_place *place,
                   struct kr_shape **face) {
    char *program = helper ? kr_text_copy(helper) : kr_child_beside("kirsch-gmsh");
    char *argument[] = {"kirsch", "--curves", (char *)(uintptr_t)kr_cad_format(path), NULL};
    struct kr_child child;
    int status;
    if (!argument[2])
        kr_stop(KR_EXIT_INPUT, "%s: expected a file named .step, .stp, .iges, .igs or .brep", path);
    if (access(path, R_OK))
        kr_stop(KR_EXIT_INPUT, "%s cannot be read; geometry.outline names it", path);
    kr_child_prepare(&child);
    kr_child_start_on(&child, program, argument, path, NULL, SECONDS);
    kr_child_wait(&status);
    char *error = kr_child_line(&child, "Error"), *trouble = kr_child_trouble(status, SECONDS);
    if (error)
        kr_stop(KR_EXIT_INPUT, "%s: %s", path,
                strstr(error, ": ") ? strstr(error, ": ") + 2 : error);
    if (trouble)
        kr_stop(KR_EXIT_LIBRARY, "%s: kirsch-gmsh was to read it, and %s", path, trouble);
    rewind(child.out);
    size_t n = kr_cad_parse(child.out, path, place, face);
    kr_child_close(&child);
    kr_free(program);
    return n;
}
