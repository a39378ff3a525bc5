/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Checks of what makes a case a solid: depth, voids, a body from an STL file.
 */
#include "case_check.h"

#include <math.h>
#include <stddef.h>

/* Quotients of decimals miss by a few bits. */
static const double rounding = 1e-9;

struct part {
    const char *name, *example;
    size_t offset;
};

#define PART(field, example_) {#field, example_, offsetof(struct kr_case_void, field)}
enum { PARTS = 7 };
static const struct part parts[PARTS] = {
    PART(centre, "[10 mm, 5 mm, 5 mm]"), PART(radius, "2 mm"), PART(radii, "[2 mm, 1 mm, 1 mm]"),
    PART(length, "4 mm"), PART(axis, "[1, 0, 0]"), PART(file, "pore.stl"), PART(unit, "1 mm"),
};

/* A letter a part: n needed, o optional, - not of this shape. In the order of the words. */
static const char *const rules[] = {"nn-----", "n-n----", "nn-no--", "o----nn"};

static int keeps_rule(struct kr_deck *deck, const struct kr_case_void *hollow) {
    int sound = 1;
    char word[32];
    kr_case_word(KR_VOID_WORDS, hollow->shape, word);
    for (size_t k = 0; k < PARTS; k++) {
        const void *at = (const char *)hollow + parts[k].offset;
        int given = kr_deck_given(deck, at);
        char letter = rules[hollow->shape][k];
        if (letter == 'n' && !given)
            kr_deck_fault(deck, at, "missing; expected %s: %s for shape %s", parts[k].name,
                          parts[k].example, word);
        else if (letter == '-' && given)
            kr_deck_fault(deck, at, "shape %s has no %s", word, parts[k].name);
        else
            continue;
        sound = 0;
    }
    return sound;
}

/* Radius of a sphere around a void; 0 where only its file tells. */
static double reach_of(const struct kr_case_void *hollow) {
    switch ((enum kr_void_shape)hollow->shape) {
    case KR_VOID_SPHERE:
        return hollow->radius;
    case KR_VOID_ELLIPSOID:
        return fmax(fmax(hollow->radii[0], hollow->radii[1]), hollow->radii[2]);
    case KR_VOID_CYLINDER:
        return hypot(hollow->radius, hollow->length / 2);
    case KR_VOID_STL:
        break;
    }
    return 0;
}

static void check_void(struct kr_deck *deck, const struct kr_case *c,
                       const struct kr_case_void *hollow) {
    const double size[3] = {c->width, c->height, c->depth};
    double away = 0, reach;
    if (hollow->shape < 0 || !keeps_rule(deck, hollow) || !(reach = reach_of(hollow)))
        return;
    for (int d = 0; d < 3; d++)
        away = hypot(away, fmax(fmax(-hollow->centre[d], hollow->centre[d] - size[d]), 0));
    if (away >= reach)
        kr_deck_fault(deck, hollow->centre,
                      "the void lies outside the body of %g m x %g m x %g m, %g m from it", size[0],
                      size[1], size[2], away - reach);
    if (kr_deck_given(deck, hollow->axis) && !hollow->axis[0] && !hollow->axis[1] && !hollow->axis[2])
        kr_deck_fault(deck, hollow->axis, "found no direction, expected one such as [1, 0, 0]");
}

static void check_depth(struct kr_deck *deck, const struct kr_case *c) {
    double layers = c->depth / c->spacing, whole = nearbyint(layers);
    if (!(c->spacing > 0))
        return; /* a fault of the reader */
    if (whole < 1 || fabs(layers - whole) > rounding * whole)
        kr_deck_fault(deck, &c->depth,
                      "%g m is no whole number of spacings of %g m; the nearest that is: %g m",
                      c->depth, c->spacing, fmax(1, whole) * c->spacing);
    else if (c->width / c->spacing * (c->height / c->spacing) * layers > 2e9)
        kr_deck_fault(deck, &c->depth, "%.2g cells, more than 2e9; take a coarser spacing",
                      c->width / c->spacing * (c->height / c->spacing) * layers);
}

void kr_case_check_solid(struct kr_deck *deck, const struct kr_case *c) {
    const struct kr_case_void *hollow = c->voids.item;
    int has_body = kr_deck_given(deck, &c->body.file);
    if (c->depth > 0)
        check_depth(deck, c);
    else if (c->voids.count)
        kr_deck_fault(deck, &c->voids, "voids need a solid; expected geometry.depth: 10 mm");
    else if (has_body)
        kr_deck_fault(deck, &c->body.file, "a body needs geometry.depth: 10 mm");
    if (c->depth > 0 && kr_case_dim(c) == 2)
        kr_deck_fault(deck, &c->depth, "makes a solid, and material.model is for plates; take solid, or leave the depth out");
    for (size_t k = 0; k < c->voids.count && c->depth > 0; k++)
        check_void(deck, c, &hollow[k]);
    if (has_body && !kr_deck_given(deck, &c->body.unit))
        kr_deck_fault(deck, &c->body.unit, "missing; expected unit: 1 mm, for lengths in the file");
    if (has_body && (c->holes.count || !kr_case_is_rectangle(&c->outline)))
        kr_deck_fault(deck, &c->body.file,
                      "a body from a file has neither outline nor holes; make them voids of it");
}
