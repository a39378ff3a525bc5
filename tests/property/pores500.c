/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Random fields of pores as in the plates paper, section 6. `make pores-500` meshes them by gmsh.
 */
#include "planes.h"

#include "pores.h"
#include "quality.h"

/** 500 fields of 30 pores, coarse: none fails, and all keep the rules. */
static void pores_500(void **unused) {
    (void)unused;
    double least = INFINITY, most = 0, seconds = 0;
    for (int64_t seed = 1; seed <= 500; seed++) {
        struct kr_case c = {.width = 50 * MM,
                            .height = 25 * MM,
                            .pores = {.count = 30,
                                      .seed = seed,
                                      .attempts = 1000000,
                                      .radius = {0.75 * MM, 1.5 * MM},
                                      .edge_diameters = 1,
                                      .gap = 0.3 * MM}};
        struct kr_plate_report report;
        double exact = 50 * 25;
        struct kr_pores thrown = kr_pores_throw(&c);
        const struct kr_case_hole *pore = thrown.hole;
        assert_int_equal(thrown.placed, 30);
        struct kr_plate plate = {.width = 50 * MM,
                                 .height = 25 * MM,
                                 .spacing = 0.25 * MM,
                                 .padding = 0.75 * MM,
                                 .grid = KR_GRID_VORONOI,
                                 .n_holes = 30,
                                 .hole = pore,
                                 .lloyd_steps = 5};
        for (size_t k = 0; k < 30; k++) {
            exact -= M_PI * pore[k].radius * pore[k].radius / (MM * MM);
            for (size_t l = 0; l < k; l++)
                assert_true(hypot(pore[k].centre[0] - pore[l].centre[0],
                                  pore[k].centre[1] - pore[l].centre[1]) >=
                            pore[k].radius + pore[l].radius + (0.3 - 1e-9) * MM);
        }
        struct kr_mesh *mesh = kr_plate_mesh(&plate, &report);
        struct kr_quality q = kr_quality_of(mesh, 0, mesh->n_cells, 0.25 * MM);
        kr_check_near(kr_test_plane(mesh) / exact, 1, 1e-12);
        least = fmin(least, q.least);
        most = fmax(most, q.most);
        seconds += report.seconds;
        kr_mesh_free(mesh);
        kr_plate_report_free(&report);
        kr_pores_free(&thrown);
    }
    kr_figure("500 fields of 30 pores: cells of %.2f to %.2f spacings squared, %.1f s", least, most,
              seconds);
    assert_true(least > 0.3 && most < 2.5);
    assert_int_equal(kr_memory_outstanding(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {{"pores-500", pores_500, NULL, NULL, NULL}};
    kr_run_tests(tests);
}
