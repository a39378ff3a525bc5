/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Wave speeds against values from the literature and closed forms.
 */
#include "test.h"

#include "wave.h"

/* PMMA of the plates paper in plane stress: 929 m/s at nu = 1/3 (bond-based) and 925 m/s at 0.35;
 * the references are rounded to 1 m/s. */
static void test_pmma(void **state) {
    (void)state;
    kr_check_near(kr_wave_speeds(3.24e9, 1 / 3.0, 1190, KR_PLANE_STRESS).rayleigh, 929, 0.5);
    kr_check_near(kr_wave_speeds(3.24e9, 0.35, 1190, KR_PLANE_STRESS).rayleigh, 925, 0.5);
}

/* nu = 1/4 in plane strain: x = 2 - 2/sqrt(3), a root of Rayleigh's cubic in closed form, and
 * c_l = sqrt(3) c_s. The same ratio c_l^2 = 3 c_s^2 belongs to nu = 1/3 in plane stress. */
static void test_closed_forms(void **state) {
    const double share = sqrt(2 - 2 / sqrt(3));
    struct kr_wave strain = kr_wave_speeds(72.3e9, 0.25, 2440, KR_PLANE_STRAIN);
    struct kr_wave stress = kr_wave_speeds(72.3e9, 1 / 3.0, 2440, KR_PLANE_STRESS);
    (void)state;
    kr_check_near(strain.rayleigh / strain.shear, share, 1e-14);
    kr_check_near(stress.rayleigh / stress.shear, share, 1e-14);
    kr_check_near(strain.longitudinal / strain.shear, sqrt(3), 1e-14);
    kr_check_near(strain.shear, sqrt(72.3e9 / (2 * 1.25 * 2440)), 1e-9);
}

/* The cubic that Rayleigh's equation becomes when squared: x^3 - 8 x^2 + (24 - 16 k) x - 16 (1 -
 * k), k = (c_s / c_l)^2, holds for every Poisson's ratio, and the wave is slower than the shear
 * wave. */
static void test_cubic_for_every_ratio(void **state) {
    (void)state;
    for (int model = KR_PLANE_STRESS; model <= KR_SOLID; model++)
        for (double nu = -0.97; nu < 0.49; nu += 0.0731) {
            struct kr_wave w = kr_wave_speeds(3.1e9, nu, 1130, (enum kr_model)model);
            double x = pow(w.rayleigh / w.shear, 2), k = pow(w.shear / w.longitudinal, 2);
            kr_check_near(x * x * x - 8 * x * x + (24 - 16 * k) * x - 16 * (1 - k), 0, 1e-13);
            assert_true(x > 0 && x < 1);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pmma),
        cmocka_unit_test(test_closed_forms),
        cmocka_unit_test(test_cubic_for_every_ratio),
    };
    kr_run_tests(tests);
}
