/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Solid cells: exact volumes and centroids, faces that are found, and the check of a mesh of solids.
 */
#include "test.h"

#include "cell.h"
#include "convert.h"
#include "element.h"
#include "face.h"
#include "mesh.h"

/* Corners of the unit shapes, whose volumes and centroids are known. */
static const double tetrahedron[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
static const double pyramid[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.3, 0.4, 1};
static const double wedge[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1};
static const double hexahedron[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,
                                    0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};

/** An affine map of determinant 2.52, far from the origin. */
static void map(size_t n, const double *from, double *to) {
    for (size_t k = 0; k < n; k++) {
        const double *p = from + 3 * k;
        to[3 * k] = 103 + 1.2 * p[0] + 0.3 * p[1] + 0.1 * p[2];
        to[3 * k + 1] = -57 + 1.5 * p[1] - 0.4 * p[2];
        to[3 * k + 2] = 31 + 1.4 * p[2];
    }
}

static void check_shape(size_t n, const double *corner, double volume, const double centroid[3]) {
    double mapped[60], wanted[3], got[3];
    map(n, corner, mapped);
    map(1, centroid, wanted);
    kr_check_near(kr_cell_solid(n, mapped, got), 2.52 * volume, 1e-13);
    for (int d = 0; d < 3; d++)
        kr_check_near(got[d], wanted[d], 3e-14);
}

static void volumes_are_exact(void **unused) {
    (void)unused;
    check_shape(4, tetrahedron, 1.0 / 6, (double[]){0.25, 0.25, 0.25});
    check_shape(5, pyramid, 1.0 / 3, (double[]){0.45, 0.475, 0.25});
    check_shape(6, wedge, 0.5, (double[]){1.0 / 3, 1.0 / 3, 0.5});
    check_shape(8, hexahedron, 1, (double[]){0.5, 0.5, 0.5});
}

/** Corners and the middles of straight edges: the shape is the same. */
static void check_second_order(size_t corners, const double *corner, double volume) {
    const struct kr_solid *solid = kr_solid(corners);
    double point[60], centroid[3], first[3];
    memcpy(point, corner, 3 * corners * sizeof *point);
    for (size_t e = 0; e < solid->n_edges; e++)
        for (size_t d = 0; d < 3; d++)
            point[3 * (corners + e) + d] =
                (corner[3 * solid->edge[e][0] + d] + corner[3 * solid->edge[e][1] + d]) / 2;
    kr_check_near(kr_cell_solid(corners + solid->n_edges, point, centroid), volume, 1e-15);
    kr_cell_solid(corners, corner, first);
    for (int d = 0; d < 3; d++)
        kr_check_near(centroid[d], first[d], 1e-15);
}

static void straight_edges_change_nothing(void **unused) {
    (void)unused;
    check_second_order(4, tetrahedron, 1.0 / 6);
    check_second_order(5, pyramid, 1.0 / 3);
    check_second_order(6, wedge, 0.5);
    check_second_order(8, hexahedron, 1);
}

/** A cube with one corner moved, whose volume is found here from both splits of each face. */
static void warped_faces_are_the_mean_of_both_diagonals(void **unused) {
    (void)unused;
    double point[24], centroid[3], sum = 0;
    memcpy(point, hexahedron, sizeof hexahedron);
    point[18] = 1.31;
    point[19] = 1.17;
    point[20] = 0.83;
    size_t number[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    for (size_t f = 0; f < 6; f++) {
        size_t v[KR_MOST_FACE];
        assert_int_equal(kr_solid_face(8, number, f, v), 4);
        for (size_t split = 0; split < 2; split++)
            for (size_t t = 0; t < 2; t++) {
                const double *a = point + 3 * v[split + 2 * t], *b = point + 3 * v[(split + 2 * t + 1) % 4],
                             *c = point + 3 * v[(split + 2 * t + 2) % 4];
                sum += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                        a[2] * (b[0] * c[1] - b[1] * c[0])) / 12;
            }
    }
    kr_check_near(kr_cell_solid(8, point, centroid), sum, 1e-15);
}

/** Two hexahedra with a warped face between them: their volumes add up to that of both together,
 *  whose outside is flat. */
static void neighbours_agree_on_a_warped_face(void **unused) {
    (void)unused;
    double a[24], b[24], centroid[3];
    memcpy(a, hexahedron, sizeof a);
    memcpy(b, hexahedron, sizeof b);
    static const double shift[4] = {0.21, -0.17, 0.05, 0.33};
    for (size_t k = 0; k < 4; k++) {
        a[3 * (4 + k) + 2] += shift[k];
        b[3 * k + 2] += shift[k] + 1;
        b[3 * (4 + k) + 2] += 1;
        /* Straight up, so that the side faces stay flat. */
        b[3 * k] = a[3 * (4 + k)];
        b[3 * k + 1] = a[3 * (4 + k) + 1];
    }
    for (size_t k = 0; k < 4; k++)
        b[3 * k + 2] = a[3 * (4 + k) + 2];
    kr_check_near(kr_cell_solid(8, a, centroid) + kr_cell_solid(8, b, centroid), 2, 1e-15);
}

static void faces_have_areas(void **unused) {
    (void)unused;
    double middle[3];
    static const double square[] = {0, 0, 2, 2, 0, 2, 2, 2, 2, 0, 2, 2};
    static const double triangle[] = {0, 0, 0, 3, 0, 0, 0, 0, 4};
    kr_check_near(kr_cell_face(4, square, middle), 4, 1e-15);
    kr_check_near(middle[0], 1, 1e-15);
    kr_check_near(kr_cell_face(3, triangle, middle), 6, 1e-14);
}

static double paraboloid(double x, double y) {
    return 0.3 + 0.2 * x - 0.1 * y + 0.5 * x * x + 0.7 * x * y - 0.4 * y * y;
}

/** Shape functions of second order follow a paraboloid exactly, so the middle lies on it. */
static void middles_lie_on_a_paraboloid(void **unused) {
    static const double around[8][2] = {{-1, -1}, {0, -1}, {1, -1}, {1, 0},
                                        {1, 1},   {0, 1},  {-1, 1}, {-1, 0}};
    static const double triangle[6][2] = {{0, 0}, {0.5, 0}, {1, 0}, {0.5, 0.5}, {0, 1}, {0, 0.5}};
    double point[24], middle[3];
    (void)unused;
    for (size_t n = 6; n <= 8; n += 2) {
        for (size_t k = 0; k < n; k++) {
            const double *p = n == 8 ? around[k] : triangle[k];
            point[3 * k] = p[0];
            point[3 * k + 1] = p[1];
            point[3 * k + 2] = paraboloid(p[0], p[1]);
        }
        kr_cell_face(n, point, middle);
        double at = n == 8 ? 0 : 1.0 / 3;
        kr_check_near(middle[0], at, 1e-15);
        kr_check_near(middle[1], at, 1e-15);
        kr_check_near(middle[2], paraboloid(at, at), 1e-15);
    }
}

/* ---- the mesh ---- */

/** Two cubes side by side along x, with the face x = 0 in a group. */
static struct kr_mesh *two_cubes(void) {
    struct kr_mesh *mesh = kr_mesh_create();
    static const size_t vertex[] = {0, 1, 4, 3, 6, 7, 10, 9, 1, 2, 5, 4, 7, 8, 11, 10};
    static const size_t face[] = {0, 3, 9, 6};
    mesh->dim = 3;
    mesh->n_points = 12;
    mesh->point = KR_NEW(double, 36);
    for (size_t p = 0; p < 12; p++) {
        mesh->point[3 * p] = (double)(p % 3);
        mesh->point[3 * p + 1] = (double)(p / 3 % 2);
        mesh->point[3 * p + 2] = (double)(p / 6);
    }
    mesh->n_cells = 2;
    mesh->first = kr_realloc(mesh->first, 3, sizeof *mesh->first);
    mesh->first[1] = 8;
    mesh->first[2] = 16;
    mesh->vertex = KR_NEW(size_t, 16);
    memcpy(mesh->vertex, vertex, sizeof vertex);
    mesh->cell_tag = KR_NEW(int64_t, 2);
    mesh->cell_tag[0] = 17;
    mesh->cell_tag[1] = 4;
    mesh->n_faces = 1;
    mesh->face_first = KR_NEW(size_t, 2);
    mesh->face_first[1] = 4;
    mesh->face = KR_NEW(size_t, 4);
    memcpy(mesh->face, face, sizeof face);
    mesh->n_groups = 1;
    mesh->group = KR_NEW(struct kr_mesh_group, 1);
    mesh->group[0] = (struct kr_mesh_group){kr_text_copy("left"), 2, 1, 1, KR_NEW(size_t, 1)};
    return mesh;
}

static void expect_fault(struct kr_mesh *mesh, const char *text) {
    char *fault = kr_mesh_fault(mesh);
    if (!fault || !strstr(fault, text))
        fail_msg("wanted a fault with '%s', got '%s'", text, fault ? fault : "none");
    kr_free(fault);
    kr_mesh_free(mesh);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void faults_of_solids_are_found(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = two_cubes();
    assert_null(kr_mesh_fault(mesh));
    mesh->vertex[3] = 12;
    expect_fault(mesh, "cell 17 has a vertex 12, but there are 12 points");
    mesh = two_cubes();
    mesh->first[1] = 7;
    expect_fault(mesh, "cell 17 has 7 vertices, and no solid has so many");
    mesh = two_cubes();
    for (size_t k = 0; k < 4; k++) { /* upside down */
        size_t v = mesh->vertex[8 + k];
        mesh->vertex[8 + k] = mesh->vertex[12 + k];
        mesh->vertex[12 + k] = v;
    }
    expect_fault(mesh, "cell 4 at (1.5, 0.5, 0.5) m is inside out");
    mesh = two_cubes();
    for (size_t k = 0; k < 4; k++)
        mesh->vertex[12 + k] = mesh->vertex[8 + k];
    expect_fault(mesh, "cell 4 at (1.5, 0.5, 0) m has no volume");
    mesh = two_cubes();
    memcpy(mesh->vertex + 8, mesh->vertex, 8 * sizeof *mesh->vertex);
    expect_fault(mesh, "cells 17 and 4 overlap: they lie on the same side");
    mesh = two_cubes();
    mesh->face[0] = 1;
    mesh->face[1] = 4;
    mesh->face[2] = 10;
    mesh->face[3] = 7;
    expect_fault(mesh, "is one of 2 cells");
    mesh = two_cubes();
    mesh->face[3] = 7;
    expect_fault(mesh, "is one of 0 cells");
    mesh = two_cubes();
    mesh->group[0].dim = 1;
    expect_fault(mesh, "is neither of faces nor of cells");
}

/** ANSYS writes a wedge as a hexahedron with two pairs of equal corners. */
static void collapsed_hexahedra_are_wedges(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = two_cubes();
    double centroid[3];
    mesh->vertex[10] = mesh->vertex[9];
    mesh->vertex[14] = mesh->vertex[13];
    kr_check_near(kr_mesh_cell_volume(mesh, 1, centroid), 0.5, 1e-15);
    kr_check_near(centroid[0], 1 + 1.0 / 3, 1e-15);
    assert_null(kr_mesh_fault(mesh));
    kr_mesh_free(mesh);
}

static void solids_become_nodes(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = two_cubes();
    struct kr_nodes *nodes = kr_convert(mesh);
    assert_int_equal(nodes->dim, 3);
    assert_int_equal(nodes->tag[0], 17);
    kr_check_near(nodes->position[3], 1.5, 1e-15);
    kr_check_near(nodes->volume[1], 1, 1e-15);
    kr_check_near(nodes->spacing, 1, 1e-15);
    const struct kr_set *left = kr_nodes_set(nodes, "left");
    assert_int_equal(left->count, 1);
    assert_int_equal(left->node[0], 0);
    kr_check_near(left->measure, 1, 1e-15);
    assert_null(kr_nodes_fault(nodes));
    kr_nodes_free(nodes);
    kr_mesh_free(mesh);
    assert_int_equal(kr_memory_outstanding(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(volumes_are_exact),
        cmocka_unit_test(straight_edges_change_nothing),
        cmocka_unit_test(warped_faces_are_the_mean_of_both_diagonals),
        cmocka_unit_test(neighbours_agree_on_a_warped_face),
        cmocka_unit_test(faces_have_areas),
        cmocka_unit_test(middles_lie_on_a_paraboloid),
        cmocka_unit_test(faults_of_solids_are_found),
        cmocka_unit_test(collapsed_hexahedra_are_wedges),
        cmocka_unit_test(solids_become_nodes),
    };
    kr_run_tests(tests);
}
