/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Faults of meshes from elsewhere: each is named by tag and place, each that can be mended is mended.
 */
#include "test.h"

#include "convert.h"
#include "mesh.h"
#include "repair.h"
#include "solid.h"

/** Squares of side 1 in a row from x = 0, and a boundary edge at their left. */
static struct kr_mesh *row(size_t n) {
    struct kr_mesh *mesh = kr_mesh_create();
    mesh->n_points = 2 * n + 2;
    mesh->point = KR_NEW(double, 3 * mesh->n_points);
    for (size_t p = 0; p < mesh->n_points; p++) {
        mesh->point[3 * p] = (double)(p / 2);
        mesh->point[3 * p + 1] = (double)(p % 2);
    }
    mesh->n_cells = n;
    mesh->first = kr_realloc(mesh->first, n + 1, sizeof *mesh->first);
    mesh->vertex = KR_NEW(size_t, 4 * n);
    mesh->cell_tag = KR_NEW(int64_t, n);
    for (size_t c = 0; c < n; c++) {
        const size_t corner[4] = {2 * c, 2 * c + 2, 2 * c + 3, 2 * c + 1};
        memcpy(mesh->vertex + 4 * c, corner, sizeof corner);
        mesh->first[c + 1] = 4 * (c + 1);
        mesh->cell_tag[c] = (int64_t)(10 * c + 7);
    }
    mesh->n_edges = 1;
    mesh->edge = KR_NEW(size_t, 2);
    mesh->edge[0] = 1;
    mesh->n_groups = 2;
    mesh->group = KR_NEW(struct kr_mesh_group, 2);
    mesh->group[0] = (struct kr_mesh_group){kr_text_copy("left"), 1, 1, 1, KR_NEW(size_t, 1)};
    mesh->group[1] = (struct kr_mesh_group){kr_text_copy("last"), 2, 2, 1, KR_NEW(size_t, 1)};
    mesh->group[1].member[0] = n - 1;
    return mesh;
}

static void repair_without(void *mesh) {
    kr_mesh_repair(mesh, "in.msh", 0);
}

static void repair_with(void *mesh) {
    kr_mesh_repair(mesh, "in.msh", 1);
    _exit(42);
}

static double area_of(struct kr_mesh *mesh) {
    struct kr_nodes *nodes = kr_convert(mesh);
    double sum = 0;
    for (size_t i = 0; i < nodes->n; i++)
        sum += nodes->volume[i];
    kr_nodes_free(nodes);
    return sum;
}

/** Without mending it stops and says `is`, with it it says `mended` and leaves cells and area. */
static void check(struct kr_mesh *mesh, const char *is, const char *mended, size_t cells, double area) {
    kr_check_stops(repair_without, mesh, 2, is);
    kr_check_stops(repair_with, mesh, 42, mended);
    kr_mesh_repair(mesh, "in.msh", 1);
    assert_int_equal(mesh->n_cells, cells);
    kr_check_near(area_of(mesh), area, 1e-15);
    const struct kr_mesh_group *last = kr_mesh_group(mesh, "last", 2);
    for (size_t k = 0; k < last->count; k++)
        assert_int_equal(mesh->cell_tag[last->member[k]], 27);
    kr_mesh_free(mesh);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void repeated_vertices(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = row(3);
    mesh->vertex[6] = mesh->vertex[5]; /* a triangle written as a quadrilateral */
    check(mesh, "1 cells with a vertex twice: cell 17 at (1, 0) m", "the repetition was dropped", 3,
          2.5);
}

static void flat_cells(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = row(3);
    mesh->vertex[6] = 4;
    mesh->vertex[5] = 0;
    mesh->vertex[7] = 6; /* 2, 0, 4, 6 are all on y = 0 */
    check(mesh, "1 cells with no area or volume: cell 17 at (1, 0) m", "dropped", 2, 2);
}

static void inverted_cells(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = row(3);
    size_t kept = mesh->vertex[5];
    mesh->vertex[5] = mesh->vertex[6]; /* crosses itself */
    mesh->vertex[6] = kept;
    check(mesh, "1 cells with corners in a wrong order (inverted): cell 17", "put in order", 3, 3);
    mesh = row(3);
    kept = mesh->vertex[5];
    mesh->vertex[5] = mesh->vertex[7]; /* clockwise */
    mesh->vertex[7] = kept;
    check(mesh, "1 cells with corners in a wrong order (inverted): cell 17", "put in order", 3, 3);
}

/** A mesh of `cells` solid cells of n vertices, whose corners and bent edges are those of a regular one. */
static struct kr_mesh *solids(size_t cells, size_t corners, int order) {
    static const double place[9][8][3] = {
        [4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        [5] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.4, 0.5, 1}},
        [6] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1.2}, {0, 1, 1}},
        [8] = {{0, 0, 0}, {1, 0, 0}, {1.1, 1, 0}, {0, 1, 0},
               {0, 0, 1}, {1, 0, 1}, {1, 1, 1.3}, {0, 1, 1}}};
    const struct kr_solid *solid = kr_solid(corners);
    size_t n = corners + (order == 2 ? solid->n_edges : 0);
    struct kr_mesh *mesh = kr_mesh_create();
    mesh->dim = 3;
    mesh->n_points = n;
    mesh->point = KR_NEW(double, 3 * n);
    memcpy(mesh->point, place[corners], 3 * corners * sizeof *mesh->point);
    for (size_t e = 0; e < n - corners; e++)
        for (size_t d = 0; d < 3; d++) /* bent, each its own way */
            mesh->point[3 * (corners + e) + d] =
                (place[corners][solid->edge[e][0]][d] + place[corners][solid->edge[e][1]][d]) / 2 +
                0.01 * (double)((7 * e + 3 * d) % 5);
    mesh->n_cells = cells;
    mesh->first = kr_realloc(mesh->first, cells + 1, sizeof *mesh->first);
    mesh->vertex = KR_NEW(size_t, cells * n);
    mesh->cell_tag = KR_NEW(int64_t, cells);
    for (size_t c = 0; c < cells; c++) {
        mesh->first[c + 1] = n * (c + 1);
        mesh->cell_tag[c] = (int64_t)(10 * c + 7);
        for (size_t k = 0; k < n; k++)
            mesh->vertex[n * c + k] = k;
    }
    return mesh;
}

static void inverted_solids_are_turned(void **unused) {
    static const size_t corners[] = {4, 5, 6, 8};
    (void)unused;
    for (size_t k = 0; k < 4; k++)
        for (int order = 1; order <= 2; order++) {
            struct kr_mesh *mesh = solids(1, corners[k], order);
            double centroid[2][3], volume = kr_mesh_cell_volume(mesh, 0, centroid[0]);
            assert_true(volume > 0.1);
            for (size_t p = 0; p < mesh->n_points; p++)
                mesh->point[3 * p] = -mesh->point[3 * p]; /* a mirror turns it inside out */
            kr_check_stops(repair_without, mesh, 2, "1 cells with corners in a wrong order (inverted): cell 7");
            kr_check_stops(repair_with, mesh, 42, "their corners were put in order");
            kr_mesh_repair(mesh, "in.msh", 1);
            kr_check_near(kr_mesh_cell_volume(mesh, 0, centroid[1]), volume, 1e-15);
            kr_check_near(centroid[1][0], -centroid[0][0], 1e-15);
            kr_mesh_free(mesh);
        }
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void solids_twice_or_flat_are_dropped(void **unused) {
    static const size_t other_order[] = {1, 2, 0, 3};
    (void)unused;
    struct kr_mesh *mesh = solids(2, 4, 1);
    memcpy(mesh->vertex + 4, other_order, sizeof other_order);
    kr_check_stops(repair_without, mesh, 2, "the same vertices as another cell: cell 17 at (1, 0, 0) m");
    kr_mesh_repair(mesh, "in.msh", 1);
    assert_int_equal(mesh->n_cells, 1);
    kr_mesh_free(mesh);
    mesh = solids(2, 8, 1);
    for (size_t k = 0; k < 4; k++)
        mesh->vertex[12 + k] = k; /* the second one has its floor for a ceiling */
    kr_check_stops(repair_without, mesh, 2, "1 cells with no area or volume: cell 17");
    kr_mesh_repair(mesh, "in.msh", 1);
    assert_int_equal(mesh->n_cells, 1);
    assert_int_equal(mesh->cell_tag[0], 7);
    kr_mesh_free(mesh);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void duplicate_cells(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = row(3);
    for (size_t k = 0; k < 4; k++)
        mesh->vertex[4 + k] = mesh->vertex[(k + 1) % 4]; /* begins elsewhere */
    check(mesh, "1 cells with the same vertices as another cell: cell 17", "the later one was dropped",
          2, 2);
}

static void inner_facets(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = row(3);
    mesh->edge[0] = 2;
    mesh->edge[1] = 3;
    check(mesh, "1 boundary facets with a place that is not on the boundary", "dropped", 3, 3);
}

static void orphans_are_named(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = row(3);
    mesh->n_cells = 2;
    mesh->group[1].member[0] = 1;
    kr_check_stops(repair_with, mesh, 42,
                   "2 points belong to no cell, the first is point 7 at (3, 0, 0) m; dropped");
    kr_mesh_repair(mesh, "in.msh", 1);
    assert_int_equal(mesh->n_points, 6);
    kr_mesh_free(mesh);
}

static void move_overlapping(struct kr_mesh *mesh) {
    for (size_t p = 6; p < 8; p++)
        mesh->point[3 * p] = 1.7; /* cell 27 reaches back over cell 17 */
}

static void overlaps_are_found(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = row(3);
    double area;
    size_t cell[2];
    assert_false(kr_mesh_overlap(mesh, cell, &area));
    move_overlapping(mesh);
    kr_check_stops(repair_with, mesh, 2, "cells 17 and 27 overlap");
    kr_mesh_free(mesh);
    /* Two squares that share no corner. */
    mesh = row(3);
    for (size_t k = 0; k < 2; k++)
        mesh->vertex[4 + (k ? 3 : 0)] = mesh->vertex[4 + (k ? 2 : 1)];
    mesh->vertex[4] = 0;
    mesh->vertex[5] = 2;
    mesh->vertex[6] = 3;
    mesh->vertex[7] = 1;
    for (size_t k = 0; k < 4; k++) { /* cell 7 moves to points of its own, 0.25 to the right */
        size_t p = mesh->n_points++;
        mesh->point = kr_realloc(mesh->point, 3 * mesh->n_points, sizeof *mesh->point);
        memcpy(mesh->point + 3 * p, mesh->point + 3 * mesh->vertex[k], 3 * sizeof *mesh->point);
        mesh->point[3 * p] += 0.25;
        mesh->point[3 * p + 1] += 0.25;
        mesh->vertex[k] = p;
    }
    assert_true(kr_mesh_overlap(mesh, cell, &area));
    assert_int_equal(cell[0], 0);
    assert_int_equal(cell[1], 1);
    kr_check_near(area, 0.75 * 0.75, 1e-15);
    kr_mesh_free(mesh);
}

static void common_areas_are_exact(void **unused) {
    (void)unused;
    static const double square[] = {0, 0, 2, 0, 2, 2, 0, 2};
    static const double dart[] = {1, 1, 3, 0, 2.2, 1.1, 3, 3}; /* not convex */
    static const double beside[] = {2, 0, 4, 0, 4, 2, 2, 2};
    static const double hollow[] = {0, 0, 3, 0, 3, 3, 2.9, 0.1, 0.1, 0.1, 0, 3}; /* like a U */
    static const double inside[] = {0.5, 0.5, 1.5, 0.5, 1.5, 1.5, 0.5, 1.5};
    kr_check_near(kr_polygons_common(4, square, 4, beside), 0, 0);
    kr_check_near(kr_polygons_common(4, square, 4, square), 4, 1e-15);
    kr_check_near(kr_polygons_common(4, square, 4, inside), 1, 1e-15);
    /* Left of x = 2 the dart is the triangle (1, 1), (2, 0.5), (2, 2): its notch begins at 2.2. */
    kr_check_near(kr_polygons_common(4, square, 4, dart), 0.75, 1e-15);
    kr_check_near(kr_polygons_common(6, hollow, 4, inside), 0, 1e-15);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inverted_solids_are_turned),
        cmocka_unit_test(solids_twice_or_flat_are_dropped),
        cmocka_unit_test(repeated_vertices),   cmocka_unit_test(flat_cells),
        cmocka_unit_test(inverted_cells),      cmocka_unit_test(duplicate_cells),
        cmocka_unit_test(inner_facets),        cmocka_unit_test(orphans_are_named),
        cmocka_unit_test(overlaps_are_found),  cmocka_unit_test(common_areas_are_exact),
    };
    kr_run_tests(tests);
}
