/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Outlines of parts, joined and taken away: on every grid the area is that of the closed formula, and
 * every boundary has the length that it should have. A plate of 6 by 6 mm.
 */
#include "test.h"

#include "base/error.h"
#include "cad.h"
#include "mesh.h"
#include "plate.h"
#include "quality.h"

#include <stdio.h>

#define MM 1e-3
enum { MOST_PARTS = 4, MOST_NAMES = 8 };

struct sample {
    const char *name;
    size_t n;
    struct kr_case_outline part[MOST_PARTS];
    double area; /* mm^2 */
    struct {
        const char *name;
        double length; /* mm */
    } edge[MOST_NAMES];
    size_t n_holes;
    struct kr_case_hole hole[1];
};

#define RECTANGLE(x, y, w, h)                                                                      \
    .shape = KR_OUTLINE_RECTANGLE, .centre = {(x)*MM, (y)*MM}, .size = {(w)*MM, (h)*MM}
#define DISC(x, y, r)                                                                              \
    .shape = KR_OUTLINE_DISC, .centre = {(x)*MM, (y)*MM}, .radius = (r)*MM, .has_centre = 1

static const struct sample samples[] = {
    {"an L of two rectangles",
     2,
     {{RECTANGLE(3, 1, 6, 2)}, {RECTANGLE(1, 3, 2, 6)}},
     12 + 8,
     {{"left", 6}, {"bottom", 6}, {"right", 2}, {"top", 2}, {"outline", 8}}},
    {"a plate with bites of its corners",
     3,
     {{.shape = KR_OUTLINE_RECTANGLE},
      {DISC(0, 0, 2), .operation = KR_DIFFERENCE, .name = "bite"},
      {DISC(6, 6, 2), .operation = KR_DIFFERENCE, .name = "bite"}},
     36 - 2 * M_PI,
     {{"left", 4}, {"top", 4}, {"bite", 2 * M_PI}}},
    {"a disc on a bar, with a hole through both",
     2,
     {{RECTANGLE(3, 1, 6, 2)}, {DISC(3, 3, 2.2), .name = "disc"}},
     0, /* area_of */
     {{"bottom", 6}, {"disc", 0}},
     1,
     {{{3 * MM, 2.5 * MM}, 0.9 * MM}}},
    {"a ring with a spoke, then its end cut off",
     3,
     {{.shape = KR_OUTLINE_RING, .radius = 3 * MM, .inner_radius = 1.7 * MM, .name = "ring"},
      {RECTANGLE(3, 3, 3.8, 0.6)},
      {RECTANGLE(5.5, 3, 1, 6), .operation = KR_DIFFERENCE, .name = "cut"}},
     0, /* area_of */
     {{"ring", 0}, {"cut", 0}, {"outline", 0}}},
    {"a rounded plate on the frame",
     1,
     {{RECTANGLE(3, 3, 6, 6), .corner_radius = 1.3 * MM}},
     36 - (4 - M_PI) * 1.69,
     {{"left", 3.4}, {"right", 3.4}, {"outline", 2.6 * M_PI}}},
};
enum { SAMPLES = sizeof samples / sizeof *samples };

/** Area of a disc beyond a line at distance d from its centre. */
static double segment(double r, double d) {
    return r * r * acos(d / r) - d * sqrt(r * r - d * d);
}

static double area_of(size_t k) {
    if (k == 2) /* what the disc adds lies beyond y = 2 */
        return 12 + M_PI * 2.2 * 2.2 - segment(2.2, 1) - M_PI * 0.81;
    if (k == 3) /* spoke: within the inner circle, of half width 0.3 */
        return M_PI * (9 - 1.7 * 1.7) - segment(3, 2) +
               2 * (0.3 * sqrt(1.7 * 1.7 - 0.09) + 1.7 * 1.7 * asin(0.3 / 1.7));
    return samples[k].area;
}

static struct kr_plate plate_of(const struct sample *s, char *helper) {
    struct kr_plate plate = {.width = 6 * MM,
                             .height = 6 * MM,
                             .spacing = 0.2 * MM,
                             .padding = 0.6 * MM,
                             .n_holes = s->n_holes,
                             .hole = s->hole,
                             .gmsh = {helper, 0, 0},
                             .lloyd_steps = 5};
    plate.outline.parts = (struct kr_deck_list){s->n, (void *)(uintptr_t)s->part, 1};
    return plate;
}

static double length_of(const struct kr_mesh *mesh, const char *name) {
    const struct kr_mesh_group *group = kr_mesh_group(mesh, name, 1);
    double sum = 0;
    for (size_t k = 0; group && k < group->count; k++) {
        const double *p = mesh->point + 3 * mesh->edge[2 * group->member[k]];
        const double *q = mesh->point + 3 * mesh->edge[2 * group->member[k] + 1];
        sum += hypot(q[0] - p[0], q[1] - p[1]) / MM;
    }
    return sum;
}

static void check(size_t k, enum kr_grid grid) {
    const char *build = getenv("BUILD");
    char *helper = kr_text("%s/kirsch-gmsh", build ? build : "build");
    struct kr_plate plate = plate_of(&samples[k], helper);
    struct kr_plate_report report;
    plate.grid = grid;
    struct kr_mesh *mesh = kr_plate_mesh(&plate, &report);
    struct kr_quality q = kr_quality_of(mesh, 0, mesh->n_cells, plate.spacing);
    assert_null(kr_mesh_fault(mesh));
    kr_check_near(report.exact_area / (MM * MM) / area_of(k), 1, 1e-12);
    if (grid != KR_GRID_UNIFORM) {
        kr_check_near(q.area / report.exact_area, 1, 1e-12);
        /* Chords of 0.2 mm on radii of 1.3 mm and more. */
        for (size_t e = 0; e < MOST_NAMES && samples[k].edge[e].name; e++)
            if (samples[k].edge[e].length > 0)
                kr_check_near(length_of(mesh, samples[k].edge[e].name) / samples[k].edge[e].length,
                              1, 0.005);
    }
    for (size_t e = 0; e < MOST_NAMES && samples[k].edge[e].name; e++)
        assert_true(length_of(mesh, samples[k].edge[e].name) > 0);
    assert_null(kr_mesh_group(mesh, "nothing", 1));
    kr_mesh_free(mesh);
    kr_plate_report_free(&report);
    kr_free(helper);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void outlines_on_the_uniform_grid(void **unused) {
    (void)unused;
    for (size_t k = 0; k < SAMPLES; k++)
        check(k, KR_GRID_UNIFORM);
}

static void outlines_on_the_near_boundary_grid(void **unused) {
    (void)unused;
    for (size_t k = 0; k < SAMPLES; k++)
        check(k, KR_GRID_NEAR_BOUNDARY);
}

static void outlines_on_the_free_grid(void **unused) {
    (void)unused;
    for (size_t k = 0; k < SAMPLES; k++)
        check(k, KR_GRID_FREE);
}

static void outlines_on_the_voronoi_grid(void **unused) {
    (void)unused;
    for (size_t k = 0; k < SAMPLES; k++)
        check(k, KR_GRID_VORONOI);
}

static void mesh_it(void *argument) {
    struct kr_plate_report report;
    kr_plate_mesh(argument, &report);
}

static void outlines_beyond_the_frame_stop(void **state) {
    static const struct sample beyond = {
        "", 2, {{RECTANGLE(3, 3, 4, 4)}, {RECTANGLE(5, 3, 4, 0.5), .angle = 0.1}}, 0, {{0}}, 0, {{{0}}}};
    (void)state;
    struct kr_plate plate = plate_of(&beyond, NULL);
    plate.grid = KR_GRID_VORONOI;
    kr_check_stops(mesh_it, &plate, KR_EXIT_INPUT, "beyond the frame of 0 to 30: raise geometry.width");
}

/** What kirsch-gmsh tells of a face with a bent edge: half a circle told as points. */
static void free_curves_become_arcs(void **unused) {
    (void)unused;
    FILE *file = tmpfile();
    struct kr_shape *face;
    const struct kr_cad_place place = {{0, 0}, 0, 0.1 * MM};
    fprintf(file, "faces 1\nface 2\ncurve line 2 1\n-0.002 0 1 0\n0.002 0 1 0\ncurve other 257 0\n");
    for (int k = 0; k <= 256; k++) /* from the other end: senses are not told */
        fprintf(file, "%.17g %.17g %.17g %.17g\n", -2 * MM * cos(M_PI * k / 256),
                2 * MM * sin(M_PI * k / 256), sin(M_PI * k / 256), cos(M_PI * k / 256));
    fprintf(file, "end\n");
    rewind(file);
    assert_int_equal(kr_cad_parse(file, "a file", &place, &face), 1);
    assert_int_equal(face->n_curves, 1);
    assert_true(face->curve->n <= 9);
    kr_check_near(kr_shape_area(face) / (200 * M_PI), 1, 1e-4 / 20);
    kr_shape_free(face);
    kr_free(face);
    fclose(file);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void parse(void *argument) {
    struct kr_shape *face;
    const struct kr_cad_place place = {{0, 0}, 0, 1e-4};
    FILE *file = tmpfile();
    fputs(argument, file);
    rewind(file);
    kr_cad_parse(file, "plate.step", &place, &face);
}

static void open_faces_stop(void **unused) {
    (void)unused;
    kr_check_stops(parse, "faces 1\nface 1\ncurve line 2 0\n0 0 1 0\n1 0 1 0\nend\n", KR_EXIT_INPUT,
                   "plate.step: the edge of a face is open at");
    kr_check_stops(parse, "faces 1\nface 1\ncurve line 2 0\n0 0 1 0\n1 0 1\nend\n", KR_EXIT_LIBRARY,
                   "plate.step: kirsch-gmsh told its curves in a way that is not understood");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(outlines_on_the_uniform_grid),
        cmocka_unit_test(outlines_on_the_near_boundary_grid),
        cmocka_unit_test(outlines_on_the_free_grid),
        cmocka_unit_test(outlines_on_the_voronoi_grid),
        cmocka_unit_test(outlines_beyond_the_frame_stop),
        cmocka_unit_test(free_curves_become_arcs),
        cmocka_unit_test(open_faces_stop),
    };
    kr_run_tests(tests);
}
