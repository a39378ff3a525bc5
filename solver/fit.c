/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Chebyshev interpolation at the roots of T_n, turned into powers of e. The functions are analytic
 * but for s = -1 (e = -1), so n terms leave an error of about rho^-n, rho = 1/R + sqrt(1/R^2 - 1)
 * for a range R: 10 terms at R = 0.05. Powers lose nothing here, for R is small against 1.
 */
#include "fit.h"

#include <math.h>
#include <string.h>

/* Near e = 0 the quotients are 0/0; the series' first term serves there: force(s) -> s = e/2. */
static const double SMALL = 1e-5;

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

/* Value of the interpolated function at a Chebyshev root; roots near 0 are shifted by symmetry: the
 * mean of two close points has an error of order SMALL^2. */
static double sample(double (*at)(const struct kr_law *, double), const struct kr_law *law,
                     double e) {
    if (fabs(e) < SMALL)
        return 0.5 * (at(law, e + SMALL) + at(law, e - SMALL));
    return at(law, e);
}

/* Interpolate at n roots (n even, so that no root is 0) and convert to powers of e. */
static struct kr_polynomial interpolate(double (*at)(const struct kr_law *, double),
                                        const struct kr_law *law, double range, int n) {
    double value[KR_FIT_TERMS], power[KR_FIT_TERMS] = {0};
    double previous[KR_FIT_TERMS] = {0}, current[KR_FIT_TERMS] = {0}, next[KR_FIT_TERMS];
    for (int k = 0; k < n; k++)
        value[k] = sample(at, law, range * cos(M_PI * (k + 0.5) / n));
    current[0] = 1; /* T_0; T_-1 is taken as T_1 = t */
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
    struct kr_polynomial fit = {.terms = n};
    for (int p = 0; p < n; p++)
        fit.coefficient[p] = power[p] / pow(range, p);
    return fit;
}

static double value_of(const struct kr_polynomial *p, double e) {
    double sum = 0;
    for (int k = p->terms - 1; k >= 0; k--)
        sum = sum * e + p->coefficient[k];
    return sum;
}

static double error_of(const struct kr_polynomial *p, double (*at)(const struct kr_law *, double),
                       const struct kr_law *law, double range) {
    double worst = 0;
    for (int k = -20; k <= 20; k++) {
        double e = range * (k + 0.37) / 20.37, exact = at(law, e);
        worst = fmax(worst, fabs(value_of(p, e) / exact - 1));
    }
    return worst;
}

static struct kr_polynomial fit_one(double (*at)(const struct kr_law *, double),
                                    const struct kr_law *law, double range, double enough) {
    int n = 4;
    struct kr_polynomial fit = interpolate(at, law, range, n);
    while (n + 2 <= KR_FIT_TERMS && error_of(&fit, at, law, range) > enough) {
        n += 2;
        struct kr_polynomial better = interpolate(at, law, range, n);
        if (error_of(&better, at, law, range) >= error_of(&fit, at, law, range))
            break; /* rounding is reached */
        fit = better;
    }
    return fit;
}

struct kr_fit kr_fit_make(const struct kr_material *material, double enough) {
    double s0 = material->critical_stretch;
    double critical = isfinite(s0) ? s0 * (2 + s0) : 0.1;
    struct kr_fit fit = {.range = fmin(fmax(1.001 * critical, 0.02), 0.5)};
    fit.pull = fit_one(pull_at, material->law, fit.range, enough);
    fit.store = fit_one(store_at, material->law, fit.range, enough);
    fit.tangent = interpolate(tangent_at, material->law, fit.range, fit.pull.terms);
    return fit;
}
