/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Checks of outline and holes. What only the exact curves can tell (a rounding that does not fit)
 * kirsch-mesh finds out.
 */
#include "base/memory.h"
#include "case_check.h"

#include <math.h>
#include <string.h>

double kr_case_hole_reach(const struct kr_case_hole *hole, double centre[2]) {
    const double *point = hole->points.item;
    double reach = 0;
    memcpy(centre, hole->centre, sizeof hole->centre);
    switch ((enum kr_hole_shape)hole->shape) {
    case KR_HOLE_CIRCLE:
        return hole->radius;
    case KR_HOLE_ELLIPSE:
        return fmax(hole->radii[0], hole->radii[1]);
    case KR_HOLE_RECTANGLE:
        return hypot(hole->size[0], hole->size[1]) / 2;
    case KR_HOLE_SLOT:
        return hole->length / 2;
    case KR_HOLE_POLYGON:
        for (size_t k = 0; k + 1 < hole->points.count; k += 2)
            reach = fmax(reach, hypot(point[k], point[k + 1]));
    }
    return reach;
}

/* A path of the deck as seen from where the program runs; owned by the deck. */
static const char *beside_deck(struct kr_deck *deck, const char *path) {
    if (!path || !*path || *path == '/')
        return path;
    return kr_deck_keep(deck, kr_text("%s/%s", kr_deck_folder(deck), path));
}

/* ---- what each shape needs ---- */

/* A key of a shape, and what it looks like where it is missing. */
struct part {
    const char *name, *example;
    size_t offset;
};

#define PART(type, field, example_) {#field, example_, offsetof(struct type, field)}
enum { HOLE_PARTS = 9, OUTLINE_PARTS = 8 };
static const struct part hole_part[HOLE_PARTS] = {
    PART(kr_case_hole, centre, "[10 mm, 5 mm]"), PART(kr_case_hole, radius, "2 mm"),
    PART(kr_case_hole, radii, "[2 mm, 1 mm]"),   PART(kr_case_hole, size, "[2 mm, 1 mm]"),
    PART(kr_case_hole, length, "4 mm"),          PART(kr_case_hole, width, "1 mm"),
    PART(kr_case_hole, points, "[[0 mm, 0 mm], [2 mm, 0 mm], [1 mm, 2 mm]]"),
    PART(kr_case_hole, corner_radius, "0.5 mm"), PART(kr_case_hole, angle, "30 deg"),
};
static const struct part outline_part[OUTLINE_PARTS] = {
    PART(kr_case_outline, centre, "[10 mm, 10 mm]"),
    PART(kr_case_outline, radius, "10 mm"),
    PART(kr_case_outline, inner_radius, "4 mm"),
    PART(kr_case_outline, points, "[[0 mm, 0 mm], [20 mm, 0 mm], [10 mm, 20 mm]]"),
    PART(kr_case_outline, corner_radius, "1 mm"),
    PART(kr_case_outline, size, "[20 mm, 10 mm]"),
    PART(kr_case_outline, angle, "30 deg"),
    PART(kr_case_outline, file, "plate.step"),
};

/* A letter a part: n needed, o optional, - not of this shape. In the order of the words. */
static const char *const hole_rules[] = {"nn-------", "n-n-----o", "n--n---oo", "o-----noo",
                                         "n---nn--o"};
static const char *const outline_rules[] = {"o---ooo-", "o--no-o-", "on------", "onn-----",
                                            "o-----on"};

/* Hold the keys given against a rule; returns whether they keep it. */
static int check_parts(struct kr_deck *deck, const void *from, size_t n, const struct part *part,
                       const char *rule, const char *word) {
    int sound = 1;
    for (size_t k = 0; k < n; k++) {
        const void *at = (const char *)from + part[k].offset;
        int given = kr_deck_given(deck, at);
        if (rule[k] == 'n' && !given)
            kr_deck_fault(deck, at, "missing; expected %s: %s for shape %s", part[k].name,
                          part[k].example, word);
        else if (rule[k] == '-' && given)
            kr_deck_fault(deck, at, "shape %s has no %s", word, part[k].name);
        else
            continue;
        sound = 0;
    }
    return sound;
}

/* Whether the deck gives any part but the centre, which has the address of the item as a whole. An
   item that is no map has none, and its fault is reported. */
static int has_parts(const struct kr_deck *deck, const struct kr_case_hole *hole) {
    for (size_t k = 1; k < HOLE_PARTS; k++)
        if (kr_deck_given(deck, (const char *)hole + hole_part[k].offset))
            return 1;
    return kr_deck_given(deck, &hole->shape) || !kr_deck_faults(deck);
}

/* ---- the checks ---- */

/* Distance from the plate's frame; 0 within it. */
static double beyond_plate(const struct kr_case *c, const double *p) {
    double x = fmax(fmax(-p[0], p[0] - c->width), 0), y = fmax(fmax(-p[1], p[1] - c->height), 0);
    return hypot(x, y);
}

static void check_place(struct kr_deck *deck, const struct kr_case *c,
                        const struct kr_case_hole *hole) {
    double centre[2], reach = kr_case_hole_reach(hole, centre);
    if (!(reach > 0))
        return; /* a fault of the reader */
    if (hole->shape == KR_HOLE_CIRCLE && 2 * reach > fmax(c->width, c->height))
        kr_deck_fault(deck, &hole->radius,
                      "the hole's diameter of %g m is more than the plate's longer side",
                      2 * reach);
    else if (hole->shape == KR_HOLE_SLOT && hole->width >= hole->length)
        kr_deck_fault(deck, &hole->width, "%g m is not below the slot's length of %g m",
                      hole->width, hole->length);
    else if (beyond_plate(c, centre) >= reach)
        kr_deck_fault(deck, hole->centre,
                      "the hole lies outside the plate of %g m x %g m, %g m from it", c->width,
                      c->height, beyond_plate(c, centre) - reach);
}

static void check_holes(struct kr_deck *deck, const struct kr_case *c) {
    const struct kr_case_hole *holes = c->holes.item;
    for (size_t i = 0; i < c->holes.count && c->width > 0 && c->height > 0; i++) {
        char word[32];
        kr_case_word(KR_HOLE_WORDS, holes[i].shape, word);
        if (holes[i].shape >= 0 && has_parts(deck, &holes[i]) &&
            check_parts(deck, &holes[i], HOLE_PARTS, hole_part, hole_rules[holes[i].shape], word) &&
            kr_case_check_corners(deck, &holes[i].points))
            check_place(deck, c, &holes[i]);
    }
}

/* Where a corner of a rectangle or polygon of the outline comes to lie. */
static void place_corner(const struct kr_case_outline *o, const double *corner, double place[2]) {
    double cosine = cos(o->angle), sine = sin(o->angle);
    place[0] = o->centre[0] + cosine * corner[0] - sine * corner[1];
    place[1] = o->centre[1] + sine * corner[0] + cosine * corner[1];
}

static void check_corners(struct kr_deck *deck, const struct kr_case *c,
                          const struct kr_case_outline *o) {
    const double x = o->size[0] / 2, y = o->size[1] / 2;
    const double corner[] = {-x, -y, x, -y, x, y, -x, y}, *point = o->points.item;
    double place[2];
    for (size_t k = 0; k < o->points.count; k += 2) {
        place_corner(o, point + k, place);
        if (beyond_plate(c, place) > 1e-9 * (c->width + c->height))
            kr_deck_fault(deck, point + k, "the corner lies outside width by height, %g m x %g m",
                          c->width, c->height);
    }
    if (!kr_deck_given(deck, o->size) || o->corner_radius > 0)
        return; /* rounded corners may stay within */
    for (size_t k = 0; k < 8; k += 2) {
        place_corner(o, corner + k, place);
        if (beyond_plate(c, place) > 1e-9 * (c->width + c->height)) {
            kr_deck_fault(deck, o->size,
                          "the corner at (%g, %g) m lies outside width by height, %g m x %g m",
                          place[0], place[1], c->width, c->height);
            return;
        }
    }
}

static void check_round(struct kr_deck *deck, const struct kr_case *c,
                        const struct kr_case_outline *o) {
    double x = o->centre[0], y = o->centre[1];
    double room = fmin(fmin(x, c->width - x), fmin(y, c->height - y));
    if (o->shape == KR_OUTLINE_RING && o->inner_radius >= o->radius)
        kr_deck_fault(deck, &o->inner_radius, "%g m is not below the outer radius of %g m",
                      o->inner_radius, o->radius);
    if (o->operation == KR_UNION && o->radius > room * (1 + 1e-9))
        kr_deck_fault(deck, &o->radius,
                      "%g m does not fit into width by height: %g m are there around the "
                      "centre",
                      o->radius, room);
}

/* One shape: the outline itself, or a part of it. */
static void check_shape(struct kr_deck *deck, const struct kr_case *c,
                        const struct kr_case_outline *o) {
    char word[32];
    kr_case_word(KR_OUTLINE_WORDS, o->shape, word);
    if (o->shape < 0 ||
        !check_parts(deck, o, OUTLINE_PARTS, outline_part, outline_rules[o->shape], word) ||
        !kr_case_check_corners(deck, &o->points) || !(c->width > 0) || !(c->height > 0))
        return;
    if (o->shape == KR_OUTLINE_RECTANGLE && !kr_deck_given(deck, o->size) &&
        (kr_deck_given(deck, o->centre) || o->angle != 0))
        kr_deck_fault(deck, o, "a rectangle of all of width by height has no centre and no angle; "
                               "give its size, too");
    if (o->operation == KR_UNION)
        check_corners(deck, c, o);
    if (o->radius > 0)
        check_round(deck, c, o);
}

static void check_part_name(struct kr_deck *deck, const struct kr_case_outline *part) {
    static const char *const taken[] = {"left", "right", "bottom", "top", "plate"};
    int is_taken = part->name && !strncmp(part->name, "hole_", 5);
    for (size_t k = 0; part->name && k < sizeof taken / sizeof *taken; k++)
        is_taken |= !strcmp(part->name, taken[k]);
    if (is_taken)
        kr_deck_fault(deck, &part->name,
                      "'%s' is the name of another boundary; take one of its own", part->name);
}

static void check_outline(struct kr_deck *deck, const struct kr_case *c) {
    const struct kr_case_outline *o = &c->outline, *part = o->parts.item;
    if (!o->parts.given) {
        check_shape(deck, c, o);
        return;
    }
    for (size_t k = 0; k < OUTLINE_PARTS; k++)
        if (kr_deck_given(deck, (const char *)o + outline_part[k].offset) ||
            kr_deck_given(deck, &o->shape)) {
            kr_deck_fault(deck, &o->parts, "an outline of parts has no shape of its own; make it "
                                           "the first part");
            break;
        }
    if (!o->parts.count)
        kr_deck_fault(deck, &o->parts, "found no part, expected one or more");
    for (size_t k = 0; k < o->parts.count; k++) {
        check_shape(deck, c, &part[k]);
        check_part_name(deck, &part[k]);
    }
    if (o->parts.count && part[0].operation == KR_DIFFERENCE)
        kr_deck_fault(deck, &part[0].operation,
                      "before the first part there is nothing to take it from; begin with a union");
}

/* ---- what the deck leaves open ---- */

static void complete_shape(struct kr_deck *deck, const struct kr_case *c,
                           struct kr_case_outline *o) {
    int about_middle = o->shape != KR_OUTLINE_POLYGON && o->shape != KR_OUTLINE_CAD;
    o->has_centre = kr_deck_given(deck, o->centre);
    if (!o->has_centre && about_middle) {
        o->centre[0] = c->width / 2;
        o->centre[1] = c->height / 2;
    }
    o->file = beside_deck(deck, o->file);
}

void kr_case_complete_geometry(struct kr_deck *deck, struct kr_case *c) {
    struct kr_case_outline *part = c->outline.parts.item;
    complete_shape(deck, c, &c->outline);
    for (size_t k = 0; k < c->outline.parts.count; k++)
        complete_shape(deck, c, &part[k]);
    c->pores.file = beside_deck(deck, c->pores.file);
}

int kr_case_is_rectangle(const struct kr_case_outline *o) {
    return !o->parts.count && o->shape == KR_OUTLINE_RECTANGLE && !(o->size[0] > 0) &&
           !(o->corner_radius > 0);
}

void kr_case_check_geometry(struct kr_deck *deck, const struct kr_case *c) {
    check_outline(deck, c);
    check_holes(deck, c);
}
