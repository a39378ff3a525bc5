/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Plates and tubes with a depth, on the four grids: exact volumes, groups that tile the boundary,
 * and files that bring back what was written.
 */
#include "folder.h"
#include "solids3d.h"

static struct kr_block block_of(enum kr_grid grid, size_t n, const struct kr_case_hole *hole) {
    return (struct kr_block){.plate = {.width = 6 * MM,
                                       .height = 5 * MM,
                                       .spacing = 0.25 * MM,
                                       .padding = 0.75 * MM,
                                       .grid = grid,
                                       .n_holes = n,
                                       .hole = hole,
                                       .gmsh = kr_test_gmsh(),
                                       .lloyd_steps = 5},
                             .depth = 1.5 * MM};
}

/** Two holes, one of them a notch in the edge. */
static void a_plate_with_holes(void **unused) {
    (void)unused;
    const struct kr_case_hole hole[] = {{{2.6 * MM, 2.4 * MM}, 1.1 * MM}, {{6 * MM, 2.5 * MM}, 1 * MM}};
    double exact = 1.5 * (30 - M_PI * 1.21 - M_PI / 2);
    for (int grid = KR_GRID_NEAR_BOUNDARY; grid <= KR_GRID_VORONOI; grid++) {
        struct kr_block block = block_of((enum kr_grid)grid, 2, hole);
        struct kr_block_report report;
        double flux = 0;
        struct kr_mesh *mesh = kr_block_mesh(&block, &report);
        kr_test_solid(mesh);
        kr_check_near(report.exact_volume * 1e9 / exact, 1, 1e-12);
        kr_check_near(kr_test_volume(mesh) / (report.filled_volume * 1e9), 1, 1e-12);
        if (grid != KR_GRID_UNIFORM)
            kr_check_near(kr_test_volume(mesh) / exact, 1, 1e-12);
        kr_check_near(kr_test_area(mesh, "left", &flux), 5 * 1.5, 1e-12);
        kr_check_near(kr_test_area(mesh, "front", &flux) / kr_test_area(mesh, "back", &flux), 1, 1e-12);
        if (grid != KR_GRID_UNIFORM) /* chords of 0.25 on radii of 1: short by 1/384 */
            kr_check_near(kr_test_area(mesh, "hole_1", &flux) / (1.5 * 2.2 * M_PI), 1, 0.003);
        kr_block_report_free(&report);
        kr_mesh_free(mesh);
    }
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void a_tube(void **unused) {
    (void)unused;
    for (int grid = KR_GRID_NEAR_BOUNDARY; grid <= KR_GRID_VORONOI; grid++) {
        struct kr_block block = block_of((enum kr_grid)grid, 0, NULL);
        struct kr_block_report report;
        block.plate.outline = (struct kr_case_outline){
            .shape = KR_OUTLINE_RING, .radius = 2.4 * MM, .inner_radius = 1.3 * MM};
        struct kr_mesh *mesh = kr_block_mesh(&block, &report);
        double exact = 1.5 * M_PI * (2.4 * 2.4 - 1.3 * 1.3), flux = 0;
        kr_test_solid(mesh);
        if (grid != KR_GRID_UNIFORM) {
            kr_check_near(kr_test_volume(mesh) / exact, 1, 1e-12);
            kr_check_near(kr_test_area(mesh, "outline", &flux) / (1.5 * 2 * M_PI * 3.7), 1, 0.003);
            kr_check_near(kr_test_area(mesh, "front", &flux) / (exact / 1.5), 1, 1e-12);
        }
        kr_block_report_free(&report);
        kr_mesh_free(mesh);
    }
}

/** Written as MSH and read again, pieces and all. */
static void a_file_brings_it_back(void **unused) {
    (void)unused;
    const struct kr_case_hole hole[] = {{{2.6 * MM, 2.4 * MM}, 1.1 * MM}};
    char *path = kr_text("%s/plate.msh", folder);
    struct kr_block block = block_of(KR_GRID_VORONOI, 1, hole);
    struct kr_block_report report;
    struct kr_mesh *mesh = kr_block_mesh(&block, &report), *again = kr_block_mesh(&block, &report);
    kr_test_same(mesh, again);
    kr_pieces_cut(again);
    kr_mesh_write_msh(again, path);
    kr_mesh_free(again);
    again = kr_mesh_read_msh(path);
    kr_pieces_join(again, path);
    kr_test_same(mesh, again);
    assert_int_equal(mesh->n_groups, again->n_groups);
    for (size_t g = 0; g < mesh->n_groups; g++) {
        const struct kr_mesh_group *group = &mesh->group[g];
        assert_int_equal(kr_mesh_group(again, group->name, group->dim)->count, group->count);
    }
    kr_mesh_free(mesh);
    kr_mesh_free(again);
    kr_free(path);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plate_with_holes),
        cmocka_unit_test(a_tube),
        cmocka_unit_test_setup_teardown(a_file_brings_it_back, make_folder, remove_folder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
