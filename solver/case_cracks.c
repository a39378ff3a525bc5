/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Checks of pre-cracks: each is of one kind, which fits the model, and whole.
 */
#include "case_check.h"

#include <math.h>
#include <string.h>

/* A polygon is plane if no corner is farther off than this share of its extent: what six written
 * digits leave. */
static const double PLANE = 1e-5;

enum { KINDS = 5 };

/* A kind of crack: the keys that it needs, the last first, for the first shares its address with the
 * item as a whole; and what they look like. */
struct kind {
    const char *name;
    int dim;
    const void *field[3]; /* NULL behind the last */
    const char *example[3];
};

static void kinds_of(const struct kr_case_crack *crack, struct kind kind[KINDS]) {
    kind[0] = (struct kind){"from and to", 2, {crack->to, crack->from},
                            {"to: [2 mm, 5 mm]", "from: [0 mm, 5 mm]"}};
    kind[1] = (struct kind){"points", 2, {&crack->points}, {"points"}};
    kind[2] = (struct kind){"polygon", 3, {&crack->polygon}, {"polygon"}};
    kind[3] = (struct kind){"disc", 3, {crack->centre, crack->normal, &crack->radius},
                            {"centre: [1 mm, 1 mm, 1 mm]", "normal: [0, 0, 1]", "radius: 0.5 mm"}};
    kind[4] = (struct kind){"file", 3, {&crack->file, &crack->unit},
                            {"file: crack.stl", "unit: 1 mm, what 1 in the file stands for"}};
}

static int is_of(const struct kr_deck *deck, const struct kind *kind) {
    for (int k = 0; k < 3 && kind->field[k]; k++)
        if (kr_deck_given(deck, kind->field[k]))
            return 1;
    return 0;
}

/* Whether all keys of a kind are given; a fault where one is missing. */
static int is_whole(struct kr_deck *deck, const struct kind *kind) {
    int whole = 1;
    for (int k = 0; k < 3 && kind->field[k]; k++)
        if (!kr_deck_given(deck, kind->field[k])) {
            kr_deck_fault(deck, kind->field[k], "missing; expected %s", kind->example[k]);
            whole = 0;
        }
    return whole;
}

/* ---- in a plate ---- */

static void check_line(struct kr_deck *deck, const struct kr_case *c, size_t n, const double *point,
                       const void *field) {
    double lower[2] = {INFINITY, INFINITY}, upper[2] = {-INFINITY, -INFINITY};
    for (size_t k = 0; k < 2 * n; k++) {
        lower[k % 2] = fmin(lower[k % 2], point[k]);
        upper[k % 2] = fmax(upper[k % 2], point[k]);
    }
    if (c->width > 0 && c->height > 0 &&
        (upper[0] <= 0 || lower[0] >= c->width || upper[1] <= 0 || lower[1] >= c->height))
        kr_deck_fault(deck, field, "the crack lies outside the plate of %g m x %g m", c->width,
                      c->height);
}

static void check_straight(struct kr_deck *deck, const struct kr_case *c,
                           const struct kr_case_crack *crack) {
    const double point[4] = {crack->from[0], crack->from[1], crack->to[0], crack->to[1]};
    if (crack->from[0] == crack->to[0] && crack->from[1] == crack->to[1])
        kr_deck_fault(deck, crack->to, "the crack ends where it begins, (%g, %g) m", crack->to[0],
                      crack->to[1]);
    else
        check_line(deck, c, 2, point, crack->from);
}

static void check_points(struct kr_deck *deck, const struct kr_case *c,
                         const struct kr_case_crack *crack) {
    if (crack->points.count < 4)
        kr_deck_fault(deck, &crack->points, "found %zu corners, expected two or more",
                      crack->points.count / 2);
    else
        check_line(deck, c, crack->points.count / 2, crack->points.item, &crack->points);
}

/* ---- in a solid ---- */

void kr_case_normal(size_t n, const double *corner, double normal[3]) {
    memset(normal, 0, 3 * sizeof *normal);
    for (size_t k = 1; k + 1 < n; k++)
        for (size_t d = 0; d < 3; d++) {
            size_t e = (d + 1) % 3, f = (d + 2) % 3;
            const double *a = corner + 3 * k, *b = a + 3;
            normal[d] += (a[e] - corner[e]) * (b[f] - corner[f]) -
                         (a[f] - corner[f]) * (b[e] - corner[e]);
        }
}

static double length_of(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void check_polygon(struct kr_deck *deck, const struct kr_deck_list *polygon) {
    const double *corner = polygon->item;
    double normal[3], size = 0;
    size_t n = polygon->count / 3;
    if (n < 3) {
        kr_deck_fault(deck, polygon, "found %zu corners, expected three or more", n);
        return;
    }
    kr_case_normal(n, corner, normal);
    for (size_t k = 3; k < 3 * n; k++)
        size = fmax(size, fabs(corner[k] - corner[k % 3]));
    double area = length_of(normal);
    if (isnan(area))
        return; /* a fault of the reader */
    if (area <= PLANE * size * size) {
        kr_deck_fault(deck, polygon, "the polygon has no area");
        return;
    }
    for (size_t k = 1; k < n; k++) {
        double height = 0;
        for (size_t d = 0; d < 3; d++)
            height += normal[d] / area * (corner[3 * k + d] - corner[d]);
        if (fabs(height) > PLANE * size) {
            kr_deck_fault(deck, corner + 3 * k,
                          "this corner lies %g m off the plane of the polygon; a bent surface comes "
                          "from a file",
                          fabs(height));
            return;
        }
    }
}

static void check_disc(struct kr_deck *deck, const struct kr_case_crack *crack) {
    if (length_of(crack->normal) == 0)
        kr_deck_fault(deck, crack->normal, "the normal has no length; expected one such as "
                                           "[0, 0, 1]");
}

/* ---- all of them ---- */

static void check_crack(struct kr_deck *deck, const struct kr_case *c,
                        const struct kr_case_crack *crack) {
    struct kind kind[KINDS];
    int found = -1;
    kinds_of(crack, kind);
    for (int k = 0; k < KINDS; k++) {
        if (!is_of(deck, &kind[k]))
            continue;
        if (found >= 0) {
            kr_deck_fault(deck, kind[k].field[0], "%s beside %s; make it a crack of its own",
                          kind[k].name, kind[found].name);
            return;
        }
        found = k;
    }
    if (found < 0) {
        if (!kr_deck_faults(deck))
            kr_deck_fault(deck, crack, "empty; expected from and to, points, polygon, disc or file");
        return;
    }
    if (!is_whole(deck, &kind[found]))
        return;
    if (kind[found].dim != kr_case_dim(c))
        kr_deck_fault(deck, kind[found].field[0],
                      kind[found].dim == 2
                          ? "a line cuts a plate, and the model is solid; take polygon, disc or file"
                          : "a surface cuts a solid, and the model is a plate; take from and to, or "
                            "points");
    else if (found == 0)
        check_straight(deck, c, crack);
    else if (found == 1)
        check_points(deck, c, crack);
    else if (found == 2)
        check_polygon(deck, &crack->polygon);
    else if (found == 3)
        check_disc(deck, crack);
}

void kr_case_check_cracks(struct kr_deck *deck, const struct kr_case *c) {
    const struct kr_case_crack *cracks = c->cracks.item;
    for (size_t k = 0; k < c->cracks.count; k++)
        check_crack(deck, c, &cracks[k]);
}
