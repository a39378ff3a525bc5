/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What the tests of grids and outlines leave of the list of shapes, each on all four grids and
 * extruded on all four: area, volume, boundaries, and how near the edges keep to the curves. Plates
 * of 6 by 6 mm at 0.15 mm.
 */
#include "planes.h"

#include "block.h"
#include "solids3d.h"

enum { MOST_HOLES = 3 };

struct sample {
    const char *name;
    struct kr_case_outline outline;
    size_t n;
    struct kr_case_hole hole[MOST_HOLES];
    double area;      /* mm^2 */
    double curvature; /* 1/mm: the largest; 0: straight edges only */
};

/* Corners [m]. A triangle of 3 by 3.2 mm about its own middle; an L; a kite on the frame. */
static double triangle[] = {-1.2e-3, -1.1e-3, 1.8e-3, -1.1e-3, -0.6e-3, 2.1e-3};
static double ell[] = {0.4e-3, 0.4e-3, 5.5e-3, 0.7e-3, 5.2e-3, 2.6e-3,
                       2.7e-3, 2.5e-3, 2.4e-3, 5.6e-3, 0.3e-3, 5.3e-3};
static double cross[] = {-1e-3, -0.4e-3, 1e-3, -0.4e-3, 1e-3, 0.4e-3, -1e-3, 0.4e-3};

#define CORNERS(list) {sizeof(list) / sizeof *(list), list, 1}

/** Area of a polygon [mm^2]. */
static double shoelace(size_t n, const double *p) {
    double twice = 0;
    for (size_t k = 0; k < n; k++) {
        size_t l = (k + 1) % n;
        twice += p[2 * k] * p[2 * l + 1] - p[2 * l] * p[2 * k + 1];
    }
    return fabs(twice) / 2e-6;
}

/** What rounding with a radius takes from a convex polygon [mm^2]: a corner that turns by t loses
 *  R^2 (tan(t/2) - t/2), and all turn by 2 pi. */
static double rounding(size_t n, const double *p, double radius) {
    double sum = -M_PI;
    for (size_t k = 0; k < n; k++) {
        const double *a = p + 2 * ((k + n - 1) % n), *b = p + 2 * k, *c = p + 2 * ((k + 1) % n);
        double u[2] = {b[0] - a[0], b[1] - a[1]}, v[2] = {c[0] - b[0], c[1] - b[1]};
        sum += tan(fabs(atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])) / 2);
    }
    return radius * radius * sum;
}

static const struct sample samples[] = {
    {"polygon", {0}, 1,
     {{{2.9, 2.8}, .shape = KR_HOLE_POLYGON, .points = CORNERS(triangle), .angle = 0.3}}, 0, 0},
    {"rounded polygon", {0}, 1,
     {{{2.9, 2.8}, .shape = KR_HOLE_POLYGON, .points = CORNERS(triangle), .corner_radius = 0.3}},
     0, 1 / 0.3},
    {"rectangle", {0}, 1, {{{3, 3}, .shape = KR_HOLE_RECTANGLE, .size = {2.3, 1.7}, .angle = 0.4}},
     36 - 2.3 * 1.7, 0},
    {"box cut by the outline", {0}, 1, {{{1.3, 4.8}, 1}}, 36 - M_PI, 1},
    {"slot from the edge", {0}, 1,
     {{{0.5, 3.1}, .shape = KR_HOLE_SLOT, .length = 3, .width = 0.8}},
     36 - 1.6 * 0.8 - M_PI * 0.16 / 2, 1 / 0.4}, /* from x = 0 to 2 */
    {"polygon cut by the outline", {0}, 1,
     {{{5.9, 2}, .shape = KR_HOLE_POLYGON, .points = CORNERS(cross)}}, 36 - 1.1 * 0.8, 0},
    {"three sizes side by side", {0}, 3,
     {{{2.3, 2.4}, 1.9}, {{4.75, 2.4}, 0.4}, {{4.3, 4.4}, 0.85}},
     36 - M_PI * (1.9 * 1.9 + 0.4 * 0.4 + 0.85 * 0.85), 1 / 0.4},
    {"polygon outline", {.shape = KR_OUTLINE_POLYGON, .points = CORNERS(ell)}, 1, {{{1.5, 1.7}, 0.6}},
     0, 1 / 0.6},
    {"turned rectangle", {.shape = KR_OUTLINE_RECTANGLE, .centre = {3e-3, 3e-3}, .has_centre = 1,
                          .size = {4.4e-3, 2.7e-3}, .angle = 0.5},
     1, {{{3, 3}, 0.7}}, 4.4 * 2.7 - M_PI * 0.49, 1 / 0.7},
    {"ring with a hole", {.shape = KR_OUTLINE_RING, .radius = 3e-3, .inner_radius = 0.9e-3}, 1,
     {{{3, 4.9}, 0.5}}, M_PI * (9 - 0.81 - 0.25), 2},
};
enum { SAMPLES = sizeof samples / sizeof *samples };

static double area_of(size_t k) {
    if (k == 0)
        return 36 - shoelace(3, triangle);
    if (k == 1)
        return 36 - shoelace(3, triangle) + rounding(3, triangle, 0.3);
    if (samples[k].outline.shape == KR_OUTLINE_POLYGON)
        return shoelace(6, ell) - M_PI * 0.36;
    return samples[k].area;
}

/** A chord of at most 1.5 spacings, moved out along its normal by a third of its height at least. */
static double most_off(const struct sample *s, enum kr_grid grid) {
    if (grid == KR_GRID_UNIFORM)
        return 0.75; /* half a square's diagonal and a little */
    return 1e-9 + 1.5 * 1.5 * 0.15 * s->curvature / 8;
}

static void check(size_t k, enum kr_grid grid) {
    struct sample s = samples[k];
    struct kr_plate_report report;
    char word[32];
    for (size_t h = 0; h < s.n; h++)
        kr_test_in_mm(&s.hole[h]);
    kr_case_word(KR_GRID_WORDS, (int)grid, word);
    struct kr_mesh *mesh = kr_test_plate(&s.outline, s.n, s.hole, grid, 0.15 * MM, &report);
    kr_test_groups(mesh);
    assert_null(kr_mesh_fault(mesh));
    kr_figure("%-26s %-13s area off by %+.1e, edges by %.3f spacings", s.name, word,
              kr_test_plane(mesh) / area_of(k) - 1, report.conformity / (0.15 * MM));
    kr_check_near(report.exact_area / (MM * MM) / area_of(k), 1, 1e-12);
    if (grid != KR_GRID_UNIFORM)
        kr_check_near(kr_test_plane(mesh) / area_of(k), 1, 1e-12);
    assert_true(report.conformity / (0.15 * MM) < most_off(&s, grid));
    kr_mesh_free(mesh);
    kr_plate_report_free(&report);
}

/** The same, of a depth of four layers. */
static void check_extruded(size_t k, enum kr_grid grid) {
    struct sample s = samples[k];
    struct kr_block block = {.plate = {.width = 6 * MM, .height = 6 * MM, .spacing = 0.15 * MM,
                                       .padding = 0.45 * MM, .grid = grid, .gmsh = kr_test_gmsh(),
                                       .lloyd_steps = 5, .outline = s.outline, .n_holes = s.n,
                                       .hole = s.hole},
                             .depth = 0.6 * MM};
    struct kr_block_report report;
    for (size_t h = 0; h < s.n; h++)
        kr_test_in_mm(&s.hole[h]);
    struct kr_mesh *mesh = kr_block_mesh(&block, &report);
    kr_test_solid(mesh);
    if (grid != KR_GRID_UNIFORM)
        kr_check_near(kr_test_volume(mesh) / (0.6 * area_of(k)), 1, 1e-12);
    kr_block_report_free(&report);
    kr_mesh_free(mesh);
}

static void check_all(enum kr_grid grid) {
    for (size_t k = 0; k < SAMPLES; k++) {
        check(k, grid);
        check_extruded(k, grid);
    }
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void geometry_on_the_uniform_grid(void **unused) {
    (void)unused;
    check_all(KR_GRID_UNIFORM);
}

static void geometry_on_the_near_boundary_grid(void **unused) {
    (void)unused;
    check_all(KR_GRID_NEAR_BOUNDARY);
}

static void geometry_on_the_free_grid(void **unused) {
    (void)unused;
    check_all(KR_GRID_FREE);
}

static void geometry_on_the_voronoi_grid(void **unused) {
    (void)unused;
    check_all(KR_GRID_VORONOI);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(geometry_on_the_uniform_grid),
        cmocka_unit_test(geometry_on_the_near_boundary_grid),
        cmocka_unit_test(geometry_on_the_free_grid),
        cmocka_unit_test(geometry_on_the_voronoi_grid),
    };
    kr_run_tests(tests);
}
