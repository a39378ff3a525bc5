/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The whole-structure check: a sound small mesh passes, and each way to spoil it is found.
 */
#include "test.h"

#include "builder.h"
#include "frame.h"
#include "lattice.h"
#include "mesh.h"
#include "side.h"

/** Three squares by two of 0.5 m, with edges and groups. */
static struct kr_mesh *small(void) {
    struct kr_lattice lattice = {3, 2, 0.5};
    struct kr_builder builder = kr_builder_begin(&lattice);
    for (size_t j = 0; j < 2; j++)
        for (size_t i = 0; i < 3; i++)
            kr_builder_square(&builder, i, j);
    kr_frame_edges(&builder);
    return kr_builder_end(&builder);
}

/** Check that a mesh has a fault whose sentence holds `text`, and free both. */
static void expect_fault(struct kr_mesh *mesh, const char *text) {
    char *fault = kr_mesh_fault(mesh);
    if (!fault || !strstr(fault, text))
        fail_msg("wanted a fault with '%s', got '%s'", text, fault ? fault : "none");
    kr_free(fault);
    kr_mesh_free(mesh);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void a_sound_mesh_has_no_fault(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = small();
    assert_null(kr_mesh_fault(mesh));
    assert_int_equal(mesh->n_points, 12);
    assert_int_equal(mesh->n_edges, 10);
    assert_int_equal(kr_mesh_group(mesh, "plate", 2)->count, 6);
    assert_int_equal(kr_mesh_group(mesh, "top", 1)->count, 3);
    assert_null(kr_mesh_group(mesh, "top", 2));
    kr_mesh_free(mesh);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void bad_indices_are_found(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = small();
    mesh->vertex[9] = 12;
    expect_fault(mesh, "cell 3 has a vertex 12, but there are 12 points");
    mesh = small();
    mesh->first[3] = mesh->first[2] + 2;
    expect_fault(mesh, "cell 3 has fewer than three vertices");
    mesh = small();
    mesh->edge[7] = 99;
    expect_fault(mesh, "boundary edge 3 has an end 99");
    mesh = small();
    mesh->vertex[5] = mesh->vertex[4];
    expect_fault(mesh, "cell 2 at (0.5, 0) m has one vertex twice");
    expect_fault(kr_mesh_create(), "no cells");
}

static void bad_places_are_found(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = small();
    mesh->point[13] = NAN;
    expect_fault(mesh, "point 4 has no finite place");
    mesh = small();
    mesh->point[3 * mesh->vertex[0] + 2] = 1e-3;
    expect_fault(mesh, "out of the plane");
}

static void cells_without_area_are_found(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = small();
    size_t swap = mesh->vertex[4];
    mesh->vertex[4] = mesh->vertex[6];
    mesh->vertex[6] = swap; /* the other way round */
    expect_fault(mesh, "cell 2 at (1, 0.5) m has no positive area");
    mesh = small();
    swap = mesh->vertex[4];
    mesh->vertex[4] = mesh->vertex[5];
    mesh->vertex[5] = swap; /* crosses itself */
    expect_fault(mesh, "has no positive area");
}

static void cells_that_overlap_are_found(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = small();
    memcpy(mesh->vertex + 16, mesh->vertex + 4, 4 * sizeof(size_t)); /* given twice */
    expect_fault(mesh, "cells 2 and 5 overlap");
    mesh = small();
    /* Cell 3 becomes a triangle over the side that cells 1 and 2 share, on the side of cell 2. */
    mesh->vertex[8] = mesh->vertex[4];
    mesh->vertex[9] = mesh->vertex[6];
    mesh->vertex[10] = mesh->vertex[7];
    memmove(mesh->vertex + 11, mesh->vertex + 12, 12 * sizeof(size_t));
    for (size_t c = 3; c <= 6; c++)
        mesh->first[c]--;
    expect_fault(mesh, "overlap: they lie on the same side of their common side");
}

static void edges_inside_the_body_are_found(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = small();
    mesh->edge[0] = mesh->vertex[1];
    mesh->edge[1] = mesh->vertex[2]; /* between cells 1 and 2 */
    expect_fault(mesh, "is a side of 2 cells");
    mesh = small();
    mesh->edge[0] = mesh->vertex[0];
    mesh->edge[1] = mesh->vertex[2]; /* a diagonal */
    expect_fault(mesh, "is a side of 0 cells");
}

static void bad_groups_are_found(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = small();
    mesh->group[1].member[1] = mesh->group[1].member[0];
    expect_fault(mesh, "the members of group 'right' do not ascend");
    mesh = small();
    mesh->group[2].member[2] = 10;
    expect_fault(mesh, "group 'bottom' has a member 10, but there are only 10");
    mesh = small();
    kr_free(mesh->group[3].name);
    mesh->group[3].name = kr_text_copy("left");
    expect_fault(mesh, "two groups have the name 'left'");
    mesh = small();
    mesh->group[3].dim = 0;
    expect_fault(mesh, "group 3 has no name or is neither");
}

static void sides_are_found_by_their_ends(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = small();
    struct kr_sides *sides =
        kr_sides_create(mesh->n_points, mesh->n_cells, mesh->first, mesh->vertex);
    size_t cell = 77, a = mesh->vertex[1], b = mesh->vertex[2];
    assert_int_equal(sides->count, 24);
    assert_int_equal(kr_sides_find(sides, a, b, &cell), 1);
    assert_int_equal(cell, 0);
    assert_int_equal(kr_sides_find(sides, b, a, &cell), 1);
    assert_int_equal(cell, 1);
    assert_int_equal(kr_sides_find(sides, mesh->vertex[0], b, &cell), 0);
    kr_sides_free(sides);
    kr_mesh_free(mesh);
    assert_int_equal(kr_memory_outstanding(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sound_mesh_has_no_fault),
        cmocka_unit_test(bad_indices_are_found),
        cmocka_unit_test(bad_places_are_found),
        cmocka_unit_test(cells_without_area_are_found),
        cmocka_unit_test(cells_that_overlap_are_found),
        cmocka_unit_test(edges_inside_the_body_are_found),
        cmocka_unit_test(bad_groups_are_found),
        cmocka_unit_test(sides_are_found_by_their_ends),
    };
    kr_run_tests(tests);
}
