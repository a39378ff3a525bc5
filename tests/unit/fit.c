/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The polynomials of the fast loop against the laws they stand in for.
 */
#include "test.h"

#include "fit.h"

static double value(const struct kr_polynomial *p, double t) {
    double sum = 0;
    for (int k = p->terms - 1; k >= 0; k--)
        sum = sum * t + p->coefficient[k];
    return sum;
}

/* s = sqrt(1 + e) - 1 in extended precision, so that the wanted values are good to the last bit;
 * near rest, where laws are linear, by the series. */
static double stretch(double e) {
    return (double)(sqrtl(1 + (long double)e) - 1);
}

static void check_fit(const struct kr_law *law, double s0) {
    struct kr_material m = {.law = law, .critical_stretch = s0};
    struct kr_fit fit = kr_fit_make(&m, KR_FIT_DOUBLE, 1e-12);
    double pull = 0, store = 0, tangent = 0;
    assert_true(fit.below <= -0.02 && fit.below >= -0.5 && fit.above <= 0.5);
    if (isfinite(s0) && s0 * (2 + s0) < 0.49) /* no bond past s0 goes unseen */
        assert_true(fit.above < s0 * (2 + s0) && fit.above > 0.999999 * s0 * (2 + s0));
    kr_check_near(fit.scale * fit.above - fit.shift, 2, 1e-14);
    kr_check_near(fit.scale * fit.below - fit.shift, -2, 1e-14);
    for (int k = -1000; k <= 1000; k++) {
        double t = 2 * (k + 0.113) / 1000.2, e = (t + fit.shift) / fit.scale, s = stretch(e);
        pull = fmax(pull, fabs(value(&fit.pull, t) * (1 + s) * e / law->force(s) - 1));
        store = fmax(store, fabs(value(&fit.store, t) * e * e / law->energy(s) - 1));
        double slope = (law->stiffness(s) - law->force(s) / (1 + s)) / ((1 + s) * (1 + s));
        tangent = fmax(tangent, fabs(value(&fit.tangent, t) - slope));
    }
    kr_figure("%s s0 %-6.4g: range %.3f to %.3f, %d and %d terms, pull off by %.1e, energy by %.1e, "
              "tangent by %.1e",
              law->name, s0, fit.below, fit.above, fit.pull.terms, fit.store.terms, pull, store, tangent);
    /* What fit.h promises, found there at 41 places and here at 2001. */
    kr_check_near(pull, 0, 1.1e-12);
    kr_check_near(store, 0, 1.1e-12);
    /* Of as many terms as pull, but a derivative's series ends later: a digit or two. */
    kr_check_near(tangent, 0, 1e-10);
}

static void test_fit_is_the_law(void **state) {
    static const double s0[] = {0.0013, 0.0074, 0.0232, 0.061, 0.13, 0.31, INFINITY};
    (void)state;
    for (size_t law = 0; law < kr_laws_count; law++)
        for (size_t k = 0; k < sizeof s0 / sizeof *s0; k++)
            check_fit(kr_laws[law], s0[k]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fit_is_the_law),
    };
    kr_run_tests(tests);
}
