/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Constants of materials against the closed formulas of docs and papers, worked out by hand.
 */
#include "test.h"

#include "material/material.h"

/* PMMA of the plates paper, horizon 0.16 mm, with which it gives s0 = 0.0232. */
static void test_material_of_the_paper(void **state) {
    struct kr_material m =
        kr_material_make(kr_law_named("pmb"), KR_PLANE_STRESS, 3.24e9, 1190, 200, 0.16e-3);
    (void)state;
    kr_figure("PMMA, horizon 0.16 mm: s0 %.6f, c %.6g N/m^5", m.critical_stretch, m.micromodulus);
    kr_check_near(m.critical_stretch, 0.0232, 0.00005);
    kr_check_near(m.critical_stretch, 0.023209521061398154, 1e-15);
    kr_check_near(m.micromodulus / (9 * 3.24e9 / (M_PI * 4.096e-12)), 1, 1e-14);
    kr_check_near(m.poissons_ratio, 1 / 3.0, 1e-16);
}

static void test_material_in_plane_strain(void **state) {
    struct kr_material m =
        kr_material_make(kr_law_named("pmb"), KR_PLANE_STRAIN, 72.3e9, 2440, 135, 1.27e-3);
    (void)state;
    kr_check_near(m.critical_stretch / sqrt(5 * M_PI * 135 / (12 * 72.3e9 * 1.27e-3)), 1, 1e-14);
    kr_check_near(m.micromodulus / (48 * 72.3e9 / (5 * M_PI * pow(1.27e-3, 3))), 1, 1e-14);
    kr_check_near(m.poissons_ratio, 0.25, 0);
}

static void test_material_of_a_solid(void **state) {
    struct kr_material m = kr_material_make(kr_law_named("pmb"), KR_SOLID, 72.3e9, 2440, 135, 1.27e-3);
    (void)state;
    kr_check_near(m.critical_stretch / sqrt(5 * 135 / (6 * 72.3e9 * 1.27e-3)), 1, 1e-14);
    kr_check_near(m.micromodulus / (12 * 72.3e9 / (M_PI * pow(1.27e-3, 4))), 1, 1e-14);
    kr_check_near(m.poissons_ratio, 0.25, 0);
}

/* Four and five times the constant one, and s0 by the roots that the hand gives. */
static void test_material_solid_and_plate_with_a_cone(void **state) {
    static const struct {
        int model;
        double times, stretch; /* s0^2 E delta/G0 */
    } rows[] = {{KR_PLANE_STRESS, 4, 5 * M_PI / 9},
                {KR_PLANE_STRAIN, 4, 25 * M_PI / 48},
                {KR_SOLID, 5, 1}};
    (void)state;
    for (size_t k = 0; k < 3; k++) {
        struct kr_material m =
            kr_material_make(kr_law_named("pmb"), rows[k].model, 72.3e9, 2440, 135, 1.27e-3);
        double constant = m.micromodulus;
        kr_check_near(kr_material_micromodulus(&m, 1.2e-3), constant, 0);
        kr_material_profile(&m, KR_CONICAL);
        kr_check_near(m.micromodulus / constant, rows[k].times, 1e-14);
        kr_check_near(m.critical_stretch * m.critical_stretch * 72.3e9 * 1.27e-3 / 135,
                      rows[k].stretch, 1e-14);
        kr_check_near(kr_material_micromodulus(&m, 0.25 * 1.27e-3) / m.micromodulus, 0.75, 1e-15);
        kr_check_near(kr_material_micromodulus(&m, 1.3e-3), 0, 0);
    }
}

static void test_material_without_fracture_energy_holds(void **state) {
    struct kr_material m = kr_material_make(kr_laws[0], KR_PLANE_STRESS, 3.1e9, 1130, 0, 0.3e-3);
    (void)state;
    assert_true(isinf(m.critical_stretch));
}

/* What the loops and the constants rely on, for every law: see struct kr_law. */
static void test_every_law_is_one(void **state) {
    (void)state;
    for (size_t k = 0; k < kr_laws_count; k++) {
        const struct kr_law *law = kr_laws[k];
        const double h = 1e-5; /* central differences: error of order h^2 and 1e-16/h, below 1e-9 */
        assert_ptr_equal(kr_law_named(law->name), law);
        assert_true(law->text && *law->text);
        kr_check_near(law->force(0), 0, 0);
        kr_check_near(law->energy(0), 0, 0);
        kr_check_near(law->force(1e-8) / 1e-8, 1, 1e-6);
        for (double s = -0.0203; s < 0.03; s += 0.0037) {
            kr_check_near((law->energy(s + h) - law->energy(s - h)) / (2 * h), law->force(s), 1e-9);
            kr_check_near((law->force(s + h) - law->force(s - h)) / (2 * h), law->stiffness(s), 1e-9);
        }
    }
    assert_null(kr_law_named("steel"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_material_of_the_paper),
        cmocka_unit_test(test_material_in_plane_strain),
        cmocka_unit_test(test_material_of_a_solid),
        cmocka_unit_test(test_material_solid_and_plate_with_a_cone),
        cmocka_unit_test(test_material_without_fracture_energy_holds),
        cmocka_unit_test(test_every_law_is_one),
    };
    kr_run_tests(tests);
}
