/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Voids in a block on the four grids: volumes against closed formulas, groups that tile the boundary,
 * no overlap, and the same bits again.
 */
#include "solids3d.h"

/** A block of 6 by 5 by 4 mm, and what its voids take out [mm^3]. */
struct sample {
    const char *name;
    size_t n;
    struct kr_case_void hollow[2];
    double taken;
};

/** Volume of a cap of height h of a sphere. */
static double cap(double r, double h) {
    return M_PI * h * h * (3 * r - h) / 3;
}

static const double ball = 4.0 / 3 * M_PI;

static void fill_samples(struct sample s[5]) {
    const struct sample all[5] = {
        {"sphere", 1, {{{3.03, 2.46, 1.97}, .radius = 1.2}}, ball * 1.728},
        {"sphere through two sides", 1, {{{0.3, 2.5, 0}, .radius = 1.2}}, 0},
        {"two merged spheres", 2, {{{2.5, 2.5, 2}, .radius = 1}, {{3.6, 2.5, 2}, .radius = 1}},
         2 * ball - 2 * cap(1, 0.45)},
        {"ellipsoid", 1, {{{3, 2.5, 2}, .shape = KR_VOID_ELLIPSOID, .radii = {1.8, 1.1, 0.8}}},
         ball * 1.8 * 1.1 * 0.8},
        {"cylinder", 1,
         {{{3, 2.5, 2}, .shape = KR_VOID_CYLINDER, .radius = 0.9, .length = 2.1, .axis = {1, 2, 0.5}}},
         M_PI * 0.81 * 2.1},
    };
    memcpy(s, all, sizeof all);
    /* The sphere at the edge: half of it, less the half of a cap 0.3 from the centre. */
    s[1].taken = ball * 1.728 / 2 - cap(1.2, 0.9) / 2;
    for (int k = 0; k < 5; k++)
        for (size_t v = 0; v < s[k].n; v++) {
            struct kr_case_void *hollow = &s[k].hollow[v];
            hollow->radius *= MM;
            hollow->length *= MM;
            for (int d = 0; d < 3; d++) {
                hollow->centre[d] *= MM;
                hollow->radii[d] *= MM;
            }
        }
}

static struct kr_mesh *mesh_of(const struct sample *s, enum kr_grid grid, double spacing,
                               struct kr_block_report *report) {
    struct kr_block block = {.plate = {.width = 6 * MM,
                                       .height = 5 * MM,
                                       .spacing = spacing * MM,
                                       .padding = 3 * spacing * MM,
                                       .grid = grid,
                                       .gmsh = kr_test_gmsh()},
                             .depth = 4 * MM,
                             .n_voids = s->n,
                             .hollow = s->hollow};
    return kr_block_mesh(&block, report);
}

/* The free grid is slow where it is fine. */
static const double spacing_of[4] = {0.125, 0.125, 0.2, 0.125};

/* How far the volume taken out may be off, as a share of it: staircases by the chance of
 * where centres fall, facets by what is left beyond second order, and where edges are sharp by
 * second order, (0.125/1)^2 and a little. Boxes have facets over twice the spacing. */
static const double off[4] = {[KR_GRID_NEAR_BOUNDARY] = 0.012, [KR_GRID_UNIFORM] = 0.02,
                              [KR_GRID_FREE] = 0.03, [KR_GRID_VORONOI] = 0.002};

static void check(const struct sample *s, enum kr_grid grid) {
    struct kr_block_report report;
    struct kr_mesh *mesh = mesh_of(s, grid, spacing_of[grid], &report);
    double flux = 0, volume = kr_test_volume(mesh), taken = 120 - volume;
    char word[32];
    kr_case_word(KR_GRID_WORDS, (int)grid, word);
    kr_figure("%-24s %-13s %6zu cells, void off by %+.1e", s->name, word, mesh->n_cells,
              taken / s->taken - 1);
    kr_test_solid(mesh);
    kr_check_near(taken / s->taken, 1, off[grid]);
    for (size_t v = 0; v < s->n; v++)
        assert_true(kr_test_area(mesh, v ? "void_2" : "void_1", &flux) > 0);
    kr_check_near(kr_test_area(mesh, "back", &flux), 30, 1e-11);
    kr_check_near(kr_test_area(mesh, "right", &flux), 20, 1e-11);
    if (grid != KR_GRID_UNIFORM && s->hollow[0].centre[2] == 0) /* a disc less a part is cut out */
        kr_check_near(30 - kr_test_area(mesh, "front", &flux),
                      M_PI * 1.44 - (1.44 * acos(0.25) - 0.3 * sqrt(1.35)), 0.03);
    for (size_t r = 0; r < report.n_regions; r++)
        assert_string_equal(report.region[r].method, "Delaunay");
    kr_block_report_free(&report);
    kr_mesh_free(mesh);
}

static void check_all(enum kr_grid grid) {
    struct sample sample[5];
    fill_samples(sample);
    for (int k = 0; k < 5; k++)
        check(&sample[k], grid);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void voids_on_the_uniform_grid(void **unused) {
    (void)unused;
    check_all(KR_GRID_UNIFORM);
}

static void voids_on_the_voronoi_grid(void **unused) {
    (void)unused;
    check_all(KR_GRID_VORONOI);
}

static void voids_on_the_near_boundary_grid(void **unused) {
    (void)unused;
    check_all(KR_GRID_NEAR_BOUNDARY);
}

static void voids_on_the_free_grid(void **unused) {
    (void)unused;
    check_all(KR_GRID_FREE);
}

/** A sphere's volume converges: halving the spacing gains four times or more, over several places of
 *  its centre; and cut cells are neither slivers nor large. */
static void a_sphere_converges(void **unused) {
    (void)unused;
    double error[2] = {0};
    for (int fine = 0; fine < 2; fine++)
        for (int k = 0; k < 6; k++) {
            struct sample s = {.n = 1, .hollow = {{.radius = 1.1 * MM}}, .taken = ball * 1.331};
            struct kr_block_report report;
            for (int d = 0; d < 3; d++)
                s.hollow[0].centre[d] = (2 + 0.037 * (double)(k + d) * (double)(d + 1)) * MM;
            struct kr_mesh *mesh = mesh_of(&s, KR_GRID_VORONOI, fine ? 0.125 : 0.25, &report);
            error[fine] = fmax(error[fine], fabs((120 - kr_test_volume(mesh)) / s.taken - 1));
            for (size_t c = 0; c < mesh->n_cells; c++) {
                double place[3], share = kr_mesh_cell_volume(mesh, c, place) /
                                         pow(fine ? 0.125 * MM : 0.25 * MM, 3);
                assert_true(share > 0.4999 && share < 2.5);
            }
            kr_mesh_free(mesh);
        }
    kr_figure("sphere of 1.1 mm, cut cells: volume off by %.1e at 0.25 mm, %.1e at 0.125 mm", error[0],
              error[1]);
    assert_true(error[1] < error[0] / 4);
    assert_true(error[1] < 2e-4);
}

static void the_same_block_gives_the_same_bits(void **unused) {
    (void)unused;
    struct sample sample[5];
    fill_samples(sample);
    for (int grid = KR_GRID_NEAR_BOUNDARY; grid <= KR_GRID_VORONOI; grid++) {
        struct kr_block_report report;
        struct kr_mesh *mesh[2];
        for (int k = 0; k < 2; k++) {
            mesh[k] = mesh_of(&sample[2], (enum kr_grid)grid, 0.25, &report);
            kr_block_report_free(&report);
        }
        kr_test_same(mesh[0], mesh[1]);
        kr_mesh_free(mesh[0]);
        kr_mesh_free(mesh[1]);
    }
}

/* Of faces from the sphere and from the hole's wall, in spacings: stairs half a cube's diagonal and a
 * little, chamfers of facets of two spacings 2/sqrt(8) at a right angle and a little; cut cells have none. */
static const double most_off[4] = {[KR_GRID_NEAR_BOUNDARY] = 0.8, [KR_GRID_UNIFORM] = 1,
                                   [KR_GRID_FREE] = 0.8, [KR_GRID_VORONOI] = 0.25};

/** A hole goes through the plate, and a sphere through the hole's wall. */
static void a_sphere_meets_a_hole(void **unused) {
    (void)unused;
    const struct kr_case_hole hole = {{3 * MM, 2.5 * MM}, 0.8 * MM};
    const struct kr_case_void hollow = {{3.9 * MM, 2.5 * MM, 2 * MM}, .radius = 0.9 * MM};
    for (int grid = KR_GRID_NEAR_BOUNDARY; grid <= KR_GRID_VORONOI; grid++) {
        struct kr_block block = {.plate = {.width = 6 * MM,
                                           .height = 5 * MM,
                                           .spacing = spacing_of[grid] * MM,
                                           .padding = 3 * spacing_of[grid] * MM,
                                           .grid = (enum kr_grid)grid,
                                           .n_holes = 1,
                                           .hole = &hole,
                                           .gmsh = kr_test_gmsh()},
                                 .depth = 4 * MM,
                                 .n_voids = 1,
                                 .hollow = &hollow};
        struct kr_block_report report;
        struct kr_mesh *mesh = kr_block_mesh(&block, &report);
        double taken = 0, flux = 0;
        /* Slices of the sphere across x, less what the hole's cylinder holds of them: midpoint rule. */
        for (int k = 0; k < 4000; k++) {
            double x = 3.0 + 1.8 * (k + 0.5) / 4000, r2 = 0.81 - (x - 3.9) * (x - 3.9);
            double half = 0.64 - (x - 3) * (x - 3) > 0 ? sqrt(0.64 - (x - 3) * (x - 3)) : 0;
            double r = sqrt(r2), h = fmin(half, r); /* of the disc, |y| < h lies in the hole */
            taken += 1.8 / 4000 * (M_PI * r2 - 2 * (h * sqrt(fmax(r2 - h * h, 0)) + r2 * asin(h / r)));
        }
        kr_test_solid(mesh);
        /* The staircase of a hole is the same in every layer: its error does not average out. */
        kr_check_near((120 - kr_test_volume(mesh)) / (taken + M_PI * 0.64 * 4), 1,
                      grid == KR_GRID_UNIFORM ? 0.03 : off[grid]);
        kr_figure("sphere through a hole's wall, grid %d: faces off by %.3f spacings", grid,
                  report.conformity / (spacing_of[grid] * MM));
        assert_true(report.conformity > 0 && report.conformity < most_off[grid] * spacing_of[grid] * MM);
        assert_true(kr_test_area(mesh, "hole_1", &flux) > 10 && kr_test_area(mesh, "void_1", &flux) > 3);
        kr_block_report_free(&report);
        kr_mesh_free(mesh);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(voids_on_the_uniform_grid),
        cmocka_unit_test(voids_on_the_voronoi_grid),
        cmocka_unit_test(voids_on_the_near_boundary_grid),
        cmocka_unit_test(voids_on_the_free_grid),
        cmocka_unit_test(a_sphere_converges),
        cmocka_unit_test(the_same_block_gives_the_same_bits),
        cmocka_unit_test(a_sphere_meets_a_hole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
