/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What must hold on every grid for every shape: areas add up to the closed formula, cells are
 * positive and simple, every boundary side is in a named group, boundaries are closed chains, and
 * the same plate gives the same bits. gmsh itself is at work.
 */
#include "planes.h"

#include "pieces.h"
#include "quality.h"

/** A plate of 6 by 6 mm: outline, holes, area and length of its edges. */
struct sample {
    const char *name;
    struct kr_case_outline outline;
    size_t n;
    struct kr_case_hole hole[2];
    double area, length; /* mm^2, mm; length 0: not known in closed form */
};

/** Area of a disc beyond a line at distance d from its centre. */
static double segment(double r, double d) {
    return r * r * acos(d / r) - d * sqrt(r * r - d * d);
}

enum { N_SAMPLES = 10 };

static void fill_samples(struct sample *s) {
    struct sample all[N_SAMPLES] = {
        {"circle", {0}, 1, {{{3.03, 2.91}, 1.13}}, 36 - M_PI * 1.13 * 1.13, 24 + 2.26 * M_PI},
        {"ellipse",
         {0},
         1,
         {{{3, 3}, .shape = KR_HOLE_ELLIPSE, .radii = {1.7, 0.9}, .angle = 0.6}},
         36 - M_PI * 1.7 * 0.9,
         0},
        {"rounded rectangle",
         {0},
         1,
         {{{3, 3},
           .shape = KR_HOLE_RECTANGLE,
           .size = {2.3, 1.7},
           .corner_radius = 0.45,
           .angle = 0.2}},
         36 - 2.3 * 1.7 + (4 - M_PI) * 0.45 * 0.45,
         24 + 8 - 8 * 0.45 + 2 * M_PI * 0.45},
        {"slot",
         {0},
         1,
         {{{3, 3}, .shape = KR_HOLE_SLOT, .length = 3.1, .width = 0.9, .angle = 1.1}},
         36 - 2.2 * 0.9 - M_PI * 0.45 * 0.45,
         24 + 4.4 + M_PI * 0.9},
        {"notch",
         {0},
         1,
         {{{5.7, 3.1}, 1}},
         36 - M_PI + segment(1, 0.3),
         24 - 2 * sqrt(1 - 0.09) + 2 * (M_PI - acos(0.3))},
        {"disc", {.shape = KR_OUTLINE_DISC, .radius = 3}, 0, {{{0}}}, 9 * M_PI, 6 * M_PI},
        {"ring",
         {.shape = KR_OUTLINE_RING, .radius = 3, .inner_radius = 1.1},
         0,
         {{{0}}},
         M_PI * (9 - 1.21),
         M_PI * 8.2},
        {"nearly touching",
         {0},
         2,
         {{{2.1, 3}, 0.85}, {{3.86, 3.1}, 0.87}},
         36 - M_PI * (0.85 * 0.85 + 0.87 * 0.87),
         24 + 2 * M_PI * (0.85 + 0.87)},
        {"corner", {0}, 1, {{{0, 6}, 1.33}}, 36 - M_PI * 1.33 * 1.33 / 4, 24 - 2.66 + 0.665 * M_PI},
        {"two in one",
         {0},
         2,
         {{{2.6, 3}, 1}, {{3.7, 3}, 1}},
         36 - 2 * M_PI + 2 * segment(1, 0.55),
         24 + 4 * (M_PI - acos(0.55))},
    };
    memcpy(s, all, sizeof all);
    for (size_t k = 0; k < N_SAMPLES; k++) {
        s[k].outline.radius *= MM;
        s[k].outline.inner_radius *= MM;
        for (size_t h = 0; h < s[k].n; h++)
            kr_test_in_mm(&s[k].hole[h]);
    }
}

static struct kr_mesh *mesh_of(const struct sample *s, enum kr_grid grid,
                               struct kr_plate_report *report) {
    return kr_test_plate(&s->outline, s->n, s->hole, grid, 0.15 * MM, report);
}

static void check_sample(const struct sample *s, enum kr_grid grid) {
    struct kr_plate_report report;
    struct kr_mesh *mesh = mesh_of(s, grid, &report);
    double area = kr_test_plane(mesh), length = kr_test_groups(mesh);
    struct kr_quality q = kr_quality_of(mesh, report.n_lattice, mesh->n_cells, 0.15 * MM);
    assert_null(kr_mesh_fault(mesh));
    kr_check_near(area / (report.polygonal_area / (MM * MM)), 1, 1e-12);
    kr_check_near(report.exact_area / (MM * MM) / s->area, 1, 1e-12);
    if (grid != KR_GRID_UNIFORM) {
        kr_check_near(area / s->area, 1, 1e-12);
        /* Chords of 0.15 mm on radii of 0.45 mm and more: short by (0.15/0.45)^2/24 at most. */
        if (s->length > 0)
            kr_check_near(length / s->length, 1, 0.005);
    }
    if (grid == KR_GRID_VORONOI) {
        kr_figure("%-17s voronoi: %4zu cells near the edges, area %.2f to %.2f, scatter %.3f",
                  s->name, q.n_cells, q.least, q.most, q.variation);
        assert_true(q.least > 0.4 && q.most < 2.1);
    }
    kr_mesh_free(mesh);
    kr_plate_report_free(&report);
}

static void check_all(enum kr_grid grid) {
    struct sample sample[N_SAMPLES];
    fill_samples(sample);
    for (size_t k = 0; k < N_SAMPLES; k++)
        check_sample(&sample[k], grid);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void every_shape_on_the_uniform_grid(void **unused) {
    (void)unused;
    check_all(KR_GRID_UNIFORM);
}

static void every_shape_on_the_near_boundary_grid(void **unused) {
    (void)unused;
    check_all(KR_GRID_NEAR_BOUNDARY);
}

static void every_shape_on_the_free_grid(void **unused) {
    (void)unused;
    check_all(KR_GRID_FREE);
}

static void every_shape_on_the_voronoi_grid(void **unused) {
    (void)unused;
    check_all(KR_GRID_VORONOI);
}

static void the_same_plate_gives_the_same_bits(void **unused) {
    (void)unused;
    struct sample sample[N_SAMPLES];
    fill_samples(sample);
    for (int grid = KR_GRID_NEAR_BOUNDARY; grid <= KR_GRID_VORONOI; grid++) {
        struct kr_plate_report report;
        struct kr_mesh *mesh[2];
        for (int k = 0; k < 2; k++) {
            mesh[k] = mesh_of(&sample[7], (enum kr_grid)grid, &report);
            kr_plate_report_free(&report);
        }
        assert_int_equal(mesh[0]->n_points, mesh[1]->n_points);
        assert_int_equal(mesh[0]->n_cells, mesh[1]->n_cells);
        assert_memory_equal(mesh[0]->point, mesh[1]->point,
                            3 * mesh[0]->n_points * sizeof(double));
        assert_memory_equal(mesh[0]->vertex, mesh[1]->vertex,
                            mesh[0]->first[mesh[0]->n_cells] * sizeof(size_t));
        assert_memory_equal(mesh[0]->edge, mesh[1]->edge, 2 * mesh[0]->n_edges * sizeof(size_t));
        for (int k = 0; k < 2; k++)
            kr_mesh_free(mesh[k]);
    }
}

/** Cells of many corners, cut for a file and joined again, are what they were. */
static void pieces_come_together_again(void **unused) {
    (void)unused;
    struct sample sample[N_SAMPLES];
    fill_samples(sample);
    for (size_t k = 0; k < N_SAMPLES; k++) {
        struct kr_plate_report report;
        struct kr_mesh *mesh = mesh_of(&sample[k], KR_GRID_VORONOI, &report);
        size_t cells = mesh->n_cells, corners = mesh->first[cells];
        double area = kr_test_plane(mesh);
        kr_pieces_cut(mesh);
        assert_true(mesh->n_cells > cells);
        for (size_t c = 0; c < mesh->n_cells; c++)
            assert_true(mesh->first[c + 1] - mesh->first[c] <= 4);
        kr_check_near(kr_test_plane(mesh), area, 1e-12);
        assert_null(kr_mesh_fault(mesh));
        kr_pieces_join(mesh, "a mesh");
        assert_int_equal(mesh->n_cells, cells);
        assert_int_equal(mesh->first[cells], corners);
        assert_null(kr_mesh_group(mesh, KR_PIECES_GROUP, 2));
        assert_int_equal(kr_mesh_group(mesh, "plate", 2)->count, cells);
        kr_check_near(kr_test_plane(mesh), area, 1e-12);
        assert_null(kr_mesh_fault(mesh));
        kr_mesh_free(mesh);
        kr_plate_report_free(&report);
    }
    assert_int_equal(kr_memory_outstanding(), 0);
}

/** Hole of 4 mm, spacing 0.05 mm: the numbers that docs/grids.md holds against gmsh's. */
static void voronoi_is_even_and_quick(void **unused) {
    (void)unused;
    struct kr_case_hole hole = {{10 * MM, 10 * MM}, 4 * MM};
    const char *build = getenv("BUILD");
    char *helper = kr_text("%s/kirsch-gmsh", build ? build : "build");
    double seconds[2], scatter[2];
    for (int k = 0; k < 2; k++) {
        struct kr_plate plate = {.width = 20 * MM,
                                 .height = 20 * MM,
                                 .spacing = 0.05 * MM,
                                 .padding = 0.2 * MM,
                                 .grid = k ? KR_GRID_VORONOI : KR_GRID_NEAR_BOUNDARY,
                                 .n_holes = 1,
                                 .hole = &hole,
                                 .gmsh = {helper, 0, 0},
                                 .lloyd_steps = 5};
        struct kr_plate_report report;
        struct kr_mesh *mesh = kr_plate_mesh(&plate, &report);
        scatter[k] = kr_quality_of(mesh, report.n_lattice, mesh->n_cells, 0.05 * MM).variation;
        seconds[k] = report.seconds;
        kr_plate_report_free(&report);
        kr_mesh_free(mesh);
    }
    kr_figure("hole of 4 mm: near-boundary %.2f s, scatter %.3f; voronoi %.2f s, scatter %.3f",
              seconds[0], scatter[0], seconds[1], scatter[1]);
    assert_true(scatter[1] < 0.055);
    assert_true(seconds[0] > 12 * seconds[1]);
    kr_free(helper);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_shape_on_the_uniform_grid),
        cmocka_unit_test(every_shape_on_the_near_boundary_grid),
        cmocka_unit_test(every_shape_on_the_free_grid),
        cmocka_unit_test(every_shape_on_the_voronoi_grid),
        cmocka_unit_test(the_same_plate_gives_the_same_bits),
        cmocka_unit_test(pieces_come_together_again),
        cmocka_unit_test(voronoi_is_even_and_quick),
    };
    kr_run_tests(tests);
}
