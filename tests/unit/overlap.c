/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Solids that overlap are found, whether they share a face or not; those that only touch are not accused,
 * however bent their faces are.
 */
#include "test.h"

#include "common_solid.h"
#include "mesh.h"
#include "repair.h"

static double uniform(uint64_t *state) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 33) / 2147483648.0;
}

/** A mesh of solids with so many cells of so many vertices each, to be filled in. */
static struct kr_mesh *solids(size_t n_points, size_t cells, size_t vertices) {
    struct kr_mesh *mesh = kr_mesh_create();
    mesh->dim = 3;
    mesh->n_points = n_points;
    mesh->point = KR_NEW(double, 3 * n_points);
    mesh->n_cells = cells;
    mesh->first = kr_realloc(mesh->first, cells + 1, sizeof *mesh->first);
    mesh->vertex = KR_NEW(size_t, cells * vertices);
    mesh->cell_tag = KR_NEW(int64_t, cells);
    for (size_t c = 0; c < cells; c++) {
        mesh->first[c + 1] = vertices * (c + 1);
        mesh->cell_tag[c] = (int64_t)(10 * c + 7);
    }
    return mesh;
}

/** n x n x n cubes of side 1 from `at` on, their points from `point`, their cells from `cell` on. */
static void put_cubes(struct kr_mesh *mesh, size_t n, const double at[3], size_t point, size_t cell) {
    static const size_t corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                        {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    const size_t m = n + 1;
    for (size_t p = 0; p < m * m * m; p++) {
        const size_t place[3] = {p % m, p / m % m, p / m / m};
        for (int d = 0; d < 3; d++)
            mesh->point[3 * (point + p) + (size_t)d] = at[d] + (double)place[d];
    }
    for (size_t c = 0; c < n * n * n; c++)
        for (size_t k = 0; k < 8; k++)
            mesh->vertex[8 * (cell + c) + k] = point + c % n + corner[k][0] +
                                               m * (c / n % n + corner[k][1]) +
                                               m * m * (c / n / n + corner[k][2]);
}

static double common(const struct kr_mesh *mesh, size_t a, size_t b) {
    struct kr_cut_cell cut[2] = {{0}, {0}};
    kr_cut_cell(mesh, a, &cut[0]);
    kr_cut_cell(mesh, b, &cut[1]);
    double volume = kr_cut_cells_common(&cut[0], &cut[1]);
    kr_check_near(kr_cut_cells_common(&cut[1], &cut[0]), volume, 1e-13);
    kr_cut_cell_free(&cut[0]);
    kr_cut_cell_free(&cut[1]);
    return volume;
}

/** Two tetrahedra of the unit corner, the second one moved or made small. */
static void tetrahedra(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = solids(8, 2, 4);
    double *p = mesh->point;
    for (size_t k = 0; k < 8; k++)
        mesh->vertex[k] = k;
    for (int d = 0; d < 3; d++)
        p[3 * (d + 1) + d] = p[3 * (d + 5) + d] = 1;
    kr_check_near(common(mesh, 0, 1), 1.0 / 6, 1e-15); /* the same place, other points */
    for (size_t k = 4; k < 8; k++)
        p[3 * k] += 0.5; /* left is the corner cut at x = 1/2: half as large */
    kr_check_near(common(mesh, 0, 1), 1.0 / 48, 1e-15);
    for (size_t k = 4; k < 8; k++)
        p[3 * k] += 0.5; /* they touch at one corner */
    kr_check_near(common(mesh, 0, 1), 0, 0);
    for (size_t k = 4; k < 8; k++) { /* a small one within the first */
        p[3 * k] = 0.1 + 0.2 * (k == 5);
        p[3 * k + 1] = 0.1 + 0.2 * (k == 6);
        p[3 * k + 2] = 0.1 + 0.2 * (k == 7);
    }
    kr_check_near(common(mesh, 0, 1), 0.008 / 6, 1e-17);
    kr_mesh_free(mesh);
}

/** Random tetrahedra against a count of random places in both. */
static void random_tetrahedra(void **unused) {
    enum { PLACES = 200000 };
    uint64_t state = 5;
    (void)unused;
    for (int pass = 0; pass < 5; pass++) {
        struct kr_mesh *mesh = solids(8, 2, 4);
        size_t in_both = 0;
        double inverse[2][9];
        for (size_t k = 0; k < 24; k++)
            mesh->point[k] = uniform(&state);
        for (size_t k = 0; k < 8; k++)
            mesh->vertex[k] = k;
        for (size_t t = 0; t < 2; t++) { /* barycentric coordinates by Cramer's rule */
            const double *o = mesh->point + 12 * t;
            double e[3][3];
            for (size_t k = 0; k < 3; k++)
                for (size_t d = 0; d < 3; d++)
                    e[k][d] = o[3 * (k + 1) + d] - o[d];
            double det = 0;
            for (int k = 0; k < 3; k++)
                for (int d = 0; d < 3; d++) {
                    const double *f = e[(k + 1) % 3], *g = e[(k + 2) % 3];
                    inverse[t][3 * k + d] =
                        f[(d + 1) % 3] * g[(d + 2) % 3] - f[(d + 2) % 3] * g[(d + 1) % 3];
                    det += k == 0 ? inverse[t][d] * e[0][d] : 0;
                }
            for (int k = 0; k < 9; k++)
                inverse[t][k] /= det;
        }
        for (size_t n = 0; n < PLACES; n++) {
            double x[3] = {uniform(&state), uniform(&state), uniform(&state)};
            int is_in = 1;
            for (size_t t = 0; t < 2; t++) {
                double rest = 1;
                for (int k = 0; k < 3; k++) {
                    double share = 0;
                    for (int d = 0; d < 3; d++)
                        share += inverse[t][3 * k + d] * (x[d] - mesh->point[12 * t + (size_t)d]);
                    is_in &= share > 0;
                    rest -= share;
                }
                is_in &= rest > 0;
            }
            in_both += (size_t)is_in;
        }
        /* Five standard errors of a count, and some places for the smallest. */
        double counted = (double)in_both / PLACES;
        kr_check_near(common(mesh, 0, 1), counted, (5 * sqrt((double)in_both) + 3) / PLACES);
        kr_mesh_free(mesh);
    }
}

/** A prism over a boomerang, whose mean of corners is outside of it, against cubes and a square's area. */
static void a_solid_that_is_not_convex(void **unused) {
    static const double boomerang[] = {0, 0, 4, 0, 0.5, 0.5, 0, 4};
    static const double low[][2] = {{0, 0}, {1, 1}, {0.2, 0.3}, {-0.5, 2}};
    (void)unused;
    for (size_t pass = 0; pass < 4; pass++) {
        struct kr_mesh *mesh = solids(16, 2, 8);
        const double *at = low[pass], x = at[0] + 1, y = at[1] + 1;
        const double square[] = {at[0], at[1], x, at[1], x, y, at[0], y};
        put_cubes(mesh, 1, (const double[3]){at[0], at[1], 0.25}, 8, 1);
        for (size_t k = 0; k < 8; k++) {
            mesh->vertex[k] = k;
            memcpy(mesh->point + 3 * k, boomerang + 2 * (k % 4), 2 * sizeof *boomerang);
            mesh->point[3 * k + 2] = k < 4 ? 0 : 1;
        }
        kr_check_near(common(mesh, 0, 1), 0.75 * kr_polygons_common(4, boomerang, 4, square), 1e-14);
        kr_mesh_free(mesh);
    }
}

static void expect_overlap(const struct kr_mesh *mesh, size_t a, size_t b, double volume) {
    size_t cell[2];
    double got;
    assert_true(kr_mesh_solids_overlap(mesh, cell, &got));
    assert_int_equal(cell[0], a);
    assert_int_equal(cell[1], b);
    kr_check_near(got, volume, 1e-13);
}

/** Two cubes that share no corner; then a small block inside a large one, far from its surface. */
static void blocks_that_share_no_corner(void **unused) {
    (void)unused;
    const double origin[3] = {0}, aside[3] = {0.25, 0.5, -0.25}, within[3] = {1.5, 2, 1.25};
    struct kr_mesh *mesh = solids(16, 2, 8);
    put_cubes(mesh, 1, origin, 0, 0);
    put_cubes(mesh, 1, aside, 8, 1);
    expect_overlap(mesh, 0, 1, 0.75 * 0.5 * 0.75);
    kr_mesh_free(mesh);
    mesh = solids(125 + 8, 64 + 1, 8);
    put_cubes(mesh, 4, origin, 0, 0);
    put_cubes(mesh, 1, within, 125, 64);
    expect_overlap(mesh, 1 + 4 * (2 + 4 * 1), 64, 0.5 * 0.75);
    kr_mesh_free(mesh);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void repair_it(void *mesh) {
    kr_mesh_repair(mesh, "in.msh", 1);
}

static void overlaps_are_named(void **unused) {
    (void)unused;
    const double origin[3] = {0}, aside[3] = {0.25, 0.5, -0.25};
    struct kr_mesh *mesh = solids(16, 2, 8);
    put_cubes(mesh, 1, origin, 0, 0);
    put_cubes(mesh, 1, aside, 8, 1);
    kr_check_stops(repair_it, mesh, 2, "cells 7 and 17 overlap by 0.28125 m^3 at (0, 0, 0) m");
    kr_mesh_free(mesh);
}

/** Cubes with all their points moved about: no face is flat, no cell convex, and none overlap. */
static void warped_neighbours_are_not_accused(void **unused) {
    enum { N = 9 };
    (void)unused;
    const double origin[3] = {0};
    struct kr_mesh *mesh = solids((N + 1) * (N + 1) * (N + 1), N * N * N, 8);
    uint64_t state = 3;
    size_t cell[2];
    double volume;
    put_cubes(mesh, N, origin, 0, 0);
    /* By up to 0.15: edges are then off by less than 0.3 in each component, and no corner folds. */
    for (size_t k = 0; k < 3 * mesh->n_points; k++)
        mesh->point[k] += 0.3 * (uniform(&state) - 0.5);
    assert_null(kr_mesh_fault(mesh));
    for (size_t c = 0; c < 40; c++) /* neighbours along x share a warped face, exactly */
        kr_check_near(common(mesh, c, c + 1), 0, 1e-14);
    assert_false(kr_mesh_solids_overlap(mesh, cell, &volume));
    kr_mesh_free(mesh);
    assert_int_equal(kr_memory_outstanding(), 0);
}

/** A warped block and a straight one that reaches half a cell into it. */
static void warped_blocks_that_reach_into_each_other(void **unused) {
    enum { N = 5, POINTS = (N + 1) * (N + 1) * (N + 1), CELLS = N * N * N };
    (void)unused;
    const double origin[3] = {0}, aside[3] = {N - 0.5, 0.2, 0.3};
    struct kr_mesh *mesh = solids(2 * POINTS, 2 * CELLS, 8);
    uint64_t state = 3;
    size_t cell[2];
    double volume;
    put_cubes(mesh, N, origin, 0, 0);
    put_cubes(mesh, N, aside, POINTS, CELLS);
    for (size_t k = 0; k < 3 * POINTS; k++)
        mesh->point[k] += 0.3 * (uniform(&state) - 0.5);
    assert_null(kr_mesh_fault(mesh));
    assert_true(kr_mesh_solids_overlap(mesh, cell, &volume));
    assert_int_equal(cell[0], N - 1);
    assert_int_equal(cell[1], CELLS);
    kr_check_near(volume, common(mesh, cell[0], cell[1]), 0);
    kr_check_near(volume, 0.5 * 0.8 * 0.7, 0.25);
    kr_mesh_free(mesh);
    assert_int_equal(kr_memory_outstanding(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tetrahedra),
        cmocka_unit_test(random_tetrahedra),
        cmocka_unit_test(a_solid_that_is_not_convex),
        cmocka_unit_test(blocks_that_share_no_corner),
        cmocka_unit_test(overlaps_are_named),
        cmocka_unit_test(warped_neighbours_are_not_accused),
        cmocka_unit_test(warped_blocks_that_reach_into_each_other),
    };
    kr_run_tests(tests);
}
