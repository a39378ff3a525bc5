/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Areas and centroids of polygons against Green's theorem in extended precision.
 */
#include "test.h"

#include "cell.h"

/** A number in [0, 1), the same on every machine. */
static double draw(uint64_t *state) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 11) / 9007199254740992.0;
}

/** Area and centroid by Green's theorem about the origin: other sums than those of cell.c, and
 *  2^11 times finer. */
static long double integrate(size_t n, const double *p, long double centroid[2]) {
    long double area = 0, x = 0, y = 0;
    for (size_t k = 0; k < n; k++) {
        const double *a = p + 2 * k, *b = p + 2 * ((k + 1) % n);
        long double dx = (long double)b[0] - a[0], dy = (long double)b[1] - a[1];
        long double sx = (long double)a[0] + b[0], sy = (long double)a[1] + b[1];
        area += (sx * dy - sy * dx) / 4;
        /* integral of x^2/2 dy and of -y^2/2 dx along the side */
        x += dy * ((long double)a[0] * a[0] + (long double)a[0] * b[0] + (long double)b[0] * b[0]) /
             6;
        y -= dx * ((long double)a[1] * a[1] + (long double)a[1] * b[1] + (long double)b[1] * b[1]) /
             6;
    }
    centroid[0] = x / area;
    centroid[1] = y / area;
    return area;
}

/** A polygon that is a star about its middle: convex where `roughness` is 0 (corners on an
 *  ellipse), with deep notches where it is near 1. */
static void make_polygon(uint64_t *state, size_t n, double roughness, double *p) {
    double x = 2 * draw(state) - 1, y = 2 * draw(state) - 1, size = 0.01 + draw(state);
    for (size_t k = 0; k < n; k++) {
        double angle = 6.283185307179586 * ((double)k + 0.9 * draw(state)) / (double)n;
        double r = size * (1 - roughness * draw(state));
        p[2 * k] = x + r * cos(angle);
        p[2 * k + 1] = y + 0.7 * r * sin(angle);
    }
}

static void compare(double roughness) {
    uint64_t state = 20231;
    for (int trial = 0; trial < 3000; trial++) {
        double p[24], got[2];
        size_t n = 3 + (size_t)(draw(&state) * 10);
        make_polygon(&state, n, roughness, p);
        long double wanted[2], area = integrate(n, p, wanted);
        if (area < 1e-6L)
            continue;
        /* Cells of a plate are near the origin compared with their place's rounding: the centroid
         * is good to 1e-14 of the distance, the area to what the corners' rounding allows. */
        kr_check_near(kr_cell_polygon(n, p, got) / (double)area, 1, 1e-14 / (double)area);
        kr_check_near(got[0], (double)wanted[0], 1e-14 * (1 + 1e-2 / (double)area));
        kr_check_near(got[1], (double)wanted[1], 1e-14 * (1 + 1e-2 / (double)area));
    }
}

static void convex_polygons(void **unused) {
    (void)unused;
    compare(0);
}

static void polygons_with_notches(void **unused) {
    (void)unused;
    compare(0.85);
}

static void a_square_of_the_lattice_is_exact(void **unused) {
    (void)unused;
    double dx = 0.04e-3, got[2];
    for (int i = 0; i < 1250; i += 7) {
        double x0 = i * dx, x1 = (i + 1) * dx, y0 = (i / 2) * dx, y1 = (i / 2 + 1) * dx;
        double p[] = {x0, y0, x1, y0, x1, y1, x0, y1};
        kr_check_near(kr_cell_polygon(4, p, got), (x1 - x0) * (y1 - y0), 1e-15 * dx * dx);
        kr_check_near(got[0], x0 + (x1 - x0) / 2, 1e-17);
    }
}

static void nothing_is_lost_far_from_the_origin(void **unused) {
    (void)unused;
    double p[] = {1e6, 3e6, 1e6 + 0.5, 3e6, 1e6 + 0.5, 3e6 + 0.25, 1e6, 3e6 + 0.25}, got[2];
    kr_check_near(kr_cell_polygon(4, p, got), 0.125, 1e-16);
    kr_check_near(got[0], 1e6 + 0.25, 0);
    kr_check_near(got[1], 3e6 + 0.125, 0);
}

static void the_sign_of_the_area_tells_the_sense(void **unused) {
    (void)unused;
    double p[] = {0.3, 0.1, 0.4, 1.7, 1.9, 0.2}, got[2];
    kr_check_near(kr_cell_polygon(3, p, got), -1.275, 1e-15);
    kr_check_near(got[0], 2.6 / 3, 1e-15);
    kr_check_near(got[1], 2.0 / 3, 1e-15);
}

static void a_flat_polygon_has_the_mean_of_its_vertices(void **unused) {
    (void)unused;
    double p[] = {1, 1, 2, 2, 6, 6}, got[2];
    kr_check_near(kr_cell_polygon(3, p, got), 0, 0);
    kr_check_near(got[0], 3, 1e-15);
}

static void folded_cells_are_unsound(void **unused) {
    (void)unused;
    double square[] = {0, 0, 1, 0, 1, 1, 0, 1}, clockwise[] = {0, 0, 0, 1, 1, 1, 1, 0};
    double dart[] = {0, 0, 2, 0, 0.5, 0.5, 0, 2}; /* not convex, but a good polygon */
    double bow[] = {0, 0, 3, 0, 0.5, 2, 1, -0.5}; /* crosses itself, its area is positive */
    double flat[] = {0, 0, 1, 1, 2, 2}, got[2];
    assert_true(kr_cell_is_sound(4, square));
    assert_true(kr_cell_is_sound(4, dart));
    assert_true(kr_cell_polygon(4, bow, got) > 0);
    assert_false(kr_cell_is_sound(4, bow));
    assert_false(kr_cell_is_sound(4, clockwise));
    assert_false(kr_cell_is_sound(3, flat));
}

/** A box of 2 x 3 x 6 far from the origin: its diagonals' triangle, and the corner cut off by them. */
static void triangles_and_tetrahedra_in_space(void **unused) {
    (void)unused;
    const double o[] = {1e6, -2e6, 3e6}, x[] = {1e6 + 2, -2e6, 3e6}, y[] = {1e6, -2e6 + 3, 3e6};
    const double z[] = {1e6, -2e6, 3e6 + 6};
    kr_check_near(kr_cell_triangle(x, y, z), sqrt(3. * 3 * 6 * 6 + 2. * 2 * 6 * 6 + 2. * 2 * 3 * 3) / 2, 1e-14);
    kr_check_near(kr_cell_triangle(x, z, y), kr_cell_triangle(x, y, z), 0);
    kr_check_near(kr_cell_triangle(x, x, y), 0, 0);
    kr_check_near(kr_cell_tetrahedron(o, x, y, z), 6, 0);
    kr_check_near(kr_cell_tetrahedron(x, o, y, z), -6, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(convex_polygons),
        cmocka_unit_test(polygons_with_notches),
        cmocka_unit_test(a_square_of_the_lattice_is_exact),
        cmocka_unit_test(nothing_is_lost_far_from_the_origin),
        cmocka_unit_test(the_sign_of_the_area_tells_the_sense),
        cmocka_unit_test(a_flat_polygon_has_the_mean_of_its_vertices),
        cmocka_unit_test(folded_cells_are_unsound),
        cmocka_unit_test(triangles_and_tetrahedra_in_space),
    };
    kr_run_tests(tests);
}
