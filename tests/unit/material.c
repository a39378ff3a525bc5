/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Constants of materials against the closed formulas of docs and papers, worked out by hand.
 */
#include "test.h"

#include "material/material.h"

/* PMMA of the plates paper, horizon 0.16 mm: s0 = sqrt(4 pi 200/(9 3.24e9 0.16e-3)) = 0.0232. */
static void test_material_of_the_paper(void **state) {
    struct kr_material m =
        kr_material_make(kr_law_named("pmb"), KR_PLANE_STRESS, 3.24e9, 1190, 200, 0.16e-3);
    (void)state;
    kr_figure("PMMA, horizon 0.16 mm: s0 %.6f, c %.6g N/m^5", m.critical_stretch, m.micromodulus);
    kr_check_near(m.critical_stretch, 0.0232, 0.00005); /* the paper's digits */
    kr_check_near(m.critical_stretch, sqrt(2513.2741228718346 / 4665.6), 1e-2); /* see below */
    kr_check_near(m.micromodulus / (9 * 3.24e9 / (M_PI * 4.096e-12)), 1, 1e-14);
    kr_check_near(m.poissons_ratio, 1 / 3.0, 1e-16);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_material_of_the_paper),
    };
    kr_run_tests(tests);
}
