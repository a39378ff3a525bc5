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
 * All are smooth for |e| <= range, where Chebyshev interpolation converges to rounding.
 */
#ifndef KR_FIT_H
#define KR_FIT_H

#include "material/material.h"

enum { KR_FIT_TERMS = 32 };

/** A polynomial in e, lowest power first. */
struct kr_polynomial {
    int terms;
    double coefficient[KR_FIT_TERMS];
};

/** The polynomials of a material and where they hold: -range <= e <= range. */
struct kr_fit {
    double range;
    struct kr_polynomial pull, store, tangent; /* tangent has as many terms as pull */
};

/** What a fit's relative error may be. Bond lengths are rounded to 6e-8 (bonds.h); float32 rounds each
 *  step of the arithmetic by as much. Each two terms more cost an eighth of the time. */
static const double KR_FIT_DOUBLE = 1e-12, KR_FIT_MIXED = 5e-7;

/** Fit a material's law to a relative error below `enough` where KR_FIT_TERMS terms allow it. `range`
 *  reaches just past the critical stretch, but at least to 0.02 (bonds may be pressed harder than
 *  they may be pulled) and at most to 0.5: outside, the loop takes the law itself. */
struct kr_fit kr_fit_make(const struct kr_material *material, double enough);

#endif
