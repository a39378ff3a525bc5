/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Polynomials that stand in for a law in the fast loop.
 *
 * With e = (|xi+eta|^2 - |xi|^2)/|xi|^2, which needs no square root, the stretch is
 * s = sqrt(1+e) - 1, and the loop needs
 *
 *    pull(e)    = force(s) / ((1 + s) e)   so that  f = c w V pull e (xi + eta)/|xi|
 *    store(e)   = energy(s) / e^2          so that  w = c |xi| store e^2
 *    tangent(e) = 2 d(pull e)/de = (force'(s) - force(s)/(1 + s)) / (1 + s)^2
 *
 * All are smooth for below <= e <= above, where Chebyshev interpolation converges to rounding. They are
 * polynomials in t = scale e - shift, which is between -2 and 2 there: a number of 2 or more shows in
 * one bit of its exponent, so that the fast loop sees with one operation that e left the range.
 */
#ifndef KR_FIT_H
#define KR_FIT_H

#include "material/material.h"

enum { KR_FIT_TERMS = 32 };

/** A polynomial in t, lowest power first. */
struct kr_polynomial {
    int terms;
    double coefficient[KR_FIT_TERMS];
};

/** The polynomials of a material and where they hold: below < e < above. */
struct kr_fit {
    double below, above, scale, shift;         /* t = scale e - shift */
    struct kr_polynomial pull, store, tangent; /* tangent has as many terms as pull */
};

/** What a fit's relative error may be. Bond lengths are rounded to 6e-8 (bonds.h); float32 rounds each
 *  step of the arithmetic by as much. Each term more costs a sixteenth of the time. */
static const double KR_FIT_DOUBLE = 1e-12, KR_FIT_MIXED = 5e-7;

/** Fit a material's law to a relative error below `enough` where KR_FIT_TERMS terms allow it. It ends at
 *  (1 - early) times the critical stretch's e, or at 0.5 or 0.1 (no critical stretch). Brittle bodies
 *  are pressed less than they are pulled: to that side it reaches 0.6 as far, but at least 0.02.
 *  Outside, the loop takes the law itself. */
struct kr_fit kr_fit_make(const struct kr_material *material, double enough, double early);

#endif
