/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Chebyshev interpolation at the roots of T_n, turned into powers of t. The functions are analytic
 * but for s = -1 (e = -1), so n terms leave an error of about rho^-n, rho = 1/R + sqrt(1/R^2 - 1)
 * for a range of width 2 R: 7 terms at R = 0.04. Powers lose nothing here, for R is small against 1.
 */
#include "fit.h"

#include <math.h>
#include <string.h>

/* Near e = 0 the quotients are 0/0; the series' first term serves there: force(s) -> s = e/2. */
static const double SMALL = 1e-4;

static double pull_at(const struct kr_law *law, double e) {
    double s = e / (1 + sqrt(1 + e));
    return law->force(s) / ((1 + s) * e);
}

static double store_at(const struct kr_law *law, double e) {
    double s = e / (1 + sqrt(1 + e));
    return law->energy(s) / (e * e);
}

static double tangent_at(const struct kr_law *law, double e) {
    double s = e / (1 + sqrt(1 + e));
    return (law->stiffness(s) - law->force(s) / (1 + s)) / ((1 + s) * (1 + s));
}

/* Value of the function; near 0 from four places around, which leaves an error of order SMALL^4. */
static double sample(double (*at)(const struct kr_law *, double), const struct kr_law *law,
                     double e) {
    if (fabs(e) >= SMALL)
        return at(law, e);
    const double h = 2 * SMALL;
    return (4 * (at(law, e + h) + at(law, e - h)) - at(law, e + 2 * h) - at(law, e - 2 * h)) / 6;
}

typedef double (*function)(const struct kr_law *, double);

static double e_of(const struct kr_fit *fit, double t) {
    return (t + fit->shift) / fit->scale;
}

/* Interpolate at n roots and convert to powers of t = 2 x, x being T_n's argument. */
static struct kr_polynomial interpolate(const struct kr_fit *fit, function at,
                                        const struct kr_law *law, int n) {
    double value[KR_FIT_TERMS], power[KR_FIT_TERMS] = {0};
    double previous[KR_FIT_TERMS] = {0}, current[KR_FIT_TERMS] = {0}, next[KR_FIT_TERMS];
    for (int k = 0; k < n; k++)
        value[k] = sample(at, law, e_of(fit, 2 * cos(M_PI * (k + 0.5) / n)));
    current[0] = 1; /* T_0; T_-1 is taken as T_1 = x */
    previous[1] = 1;
    for (int m = 0; m < n; m++) {
        double weight = 0;
        for (int k = 0; k < n; k++)
            weight += value[k] * cos(M_PI * m * (k + 0.5) / n);
        weight *= (m ? 2.0 : 1.0) / n;
        for (int p = 0; p < n; p++)
            power[p] += weight * current[p];
        next[0] = -previous[0];
        for (int p = 1; p < n; p++)
            next[p] = 2 * current[p - 1] - previous[p];
        memcpy(previous, current, sizeof previous);
        memcpy(current, next, sizeof current);
    }
    struct kr_polynomial polynomial = {.terms = n};
    for (int p = 0; p < n; p++)
        polynomial.coefficient[p] = ldexp(power[p], -p);
    return polynomial;
}

static double value_of(const struct kr_polynomial *p, double t) {
    double sum = 0;
    for (int k = p->terms - 1; k >= 0; k--)
        sum = sum * t + p->coefficient[k];
    return sum;
}

static double error_of(const struct kr_fit *fit, const struct kr_polynomial *p, function at,
                       const struct kr_law *law) {
    double worst = 0;
    for (int k = -20; k <= 20; k++) {
        double t = 2 * (k + 0.37) / 20.37, exact = sample(at, law, e_of(fit, t));
        worst = fmax(worst, fabs(value_of(p, t) / exact - 1));
    }
    return worst;
}

static struct kr_polynomial fit_one(const struct kr_fit *fit, function at, const struct kr_law *law,
                                    double enough) {
    int n = 4;
    struct kr_polynomial best = interpolate(fit, at, law, n);
    while (n < KR_FIT_TERMS && error_of(fit, &best, at, law) > enough) {
        struct kr_polynomial better = interpolate(fit, at, law, ++n);
        if (error_of(fit, &better, at, law) >= error_of(fit, &best, at, law))
            break; /* rounding is reached */
        best = better;
    }
    return best;
}

struct kr_fit kr_fit_make(const struct kr_material *material, double enough, double early) {
    const double s0 = material->critical_stretch;
    struct kr_fit fit = {.above = 0.1, .below = -0.1};
    if (isfinite(s0)) {
        fit.above = fmin(s0 * (2 + s0), 0.5) * (1 - early);
        fit.below = -fmin(fmax(0.6 * fit.above, 0.02), 0.5);
    }
    fit.scale = 4 / (fit.above - fit.below);
    fit.shift = 2 * (fit.above + fit.below) / (fit.above - fit.below);
    fit.pull = fit_one(&fit, pull_at, material->law, enough);
    fit.store = fit_one(&fit, store_at, material->law, enough);
    fit.tangent = interpolate(&fit, tangent_at, material->law, fit.pull.terms);
    return fit;
}
