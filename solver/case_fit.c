/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Whether squares of the spacing fill the rectangle of width by height, and what would fit where they
 * do not.
 */
#include "base/memory.h"
#include "case_check.h"

#include <math.h>

/* A ratio of two lengths written in decimals is whole to a few roundings; 1e-9 is far above those
 * and far below any misfit that somebody means. */
static const double FITS = 1e-9;

static int is_multiple(double length, double spacing) {
    double ratio = length / spacing, whole = nearbyint(ratio);
    return whole >= 1 && fabs(ratio - whole) <= FITS * whole;
}

/* The spacing nearest to the wanted one, finer (step 1) or coarser (step -1), that fits both
   sides; 0 if there is none within a factor of two. */
static double nearest_fit(double width, double height, double spacing, int step) {
    double from = width / spacing, n = step > 0 ? ceil(from) : floor(from);
    for (; n >= 1 && n <= 2 * from + 1 && n >= from / 2 - 1; n += step)
        if (is_multiple(height, width / n))
            return width / n;
    return 0;
}

/* "geometry.width: 50.009 mm" where the side does not fit, "" where it does; owned by the caller. */
static char *side(const char *name, double length, double spacing) {
    double fitting = spacing * fmax(1, nearbyint(length / spacing));
    return is_multiple(length, spacing) ? kr_text_copy("")
                                        : kr_text("geometry.%s: %.12g mm", name, 1e3 * fitting);
}

/* Twelve digits: what is named must pass as a multiple when it is written into a deck. */
char *kr_case_misfit(double width, double height, double spacing) {
    if (is_multiple(width, spacing) && is_multiple(height, spacing))
        return NULL;
    double finer = nearest_fit(width, height, spacing, 1);
    double coarser = nearest_fit(width, height, spacing, -1);
    char *across = side("width", width, spacing), *up = side("height", height, spacing);
    const char *and = *across && *up ? " and " : "";
    char *fits = finer > 0 && coarser > 0
                     ? kr_text("the nearest that fit are %.12g mm and %.12g mm; or", 1e3 * finer,
                               1e3 * coarser)
                 : finer > 0 || coarser > 0
                     ? kr_text("the nearest that fits is %.12g mm; or",
                               1e3 * (finer > 0 ? finer : coarser))
                     : kr_text_copy("no spacing near it fits both sides;");
    char *cure = kr_text("%s keep it with %s%s%s", fits, across, and, up);
    kr_free(across);
    kr_free(up);
    kr_free(fits);
    return cure;
}

void kr_case_check_fit(struct kr_deck *deck, const struct kr_case *c) {
    if (!(c->spacing > 0) || !(c->width > 0) || !(c->height > 0))
        return; /* a fault of the reader */
    char *cure = kr_case_misfit(c->width, c->height, c->spacing);
    if (cure)
        kr_deck_fault(deck, &c->spacing,
                      "found %.9g mm, expected a length that cuts the plate of %.9g mm by %.9g mm into "
                      "whole squares, and this makes %.6g by %.6g: %s",
                      1e3 * c->spacing, 1e3 * c->width, 1e3 * c->height, c->width / c->spacing,
                      c->height / c->spacing, cure);
    kr_free(cure);
}
