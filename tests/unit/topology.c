/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Cells in XDMF's words: numbers, corners, and closed polyhedra.
 */
#include "test.h"

#include "topology.h"

/* A unit cube as six tetrahedra around one of its diagonals, behind it a tetrahedron of second order,
 * a wedge and a hexahedron; the corners' places are those of the cube. */
static const int64_t vertex[] = {0, 1, 3, 7, 0, 3, 2, 7, 0, 2, 6, 7, 0, 6, 4, 7, 0, 4, 5, 7, 0, 5, 1, 7,
                                 0, 1, 2, 4, 8, 9, 10, 11, 12, 13,
                                 0, 1, 2, 4, 5, 6,
                                 0, 1, 3, 2, 4, 5, 7, 6};
static const int64_t first[] = {0, 24, 34, 40, 48};

static void place(int64_t corner, double x[3]) {
    for (int d = 0; d < 3; d++)
        x[d] = (double)(corner >> d & 1);
}

static struct kr_nodes *make_nodes(void) {
    struct kr_nodes *nodes = kr_nodes_create(3, 4);
    nodes->n_points = 14;
    nodes->point = KR_NEW(double, 3 * 14);
    for (int64_t p = 0; p < 14; p++)
        place(p % 8, nodes->point + 3 * p);
    nodes->first = KR_NEW(int64_t, 5);
    nodes->vertex = KR_NEW(int64_t, 48);
    memcpy(nodes->first, first, sizeof first);
    memcpy(nodes->vertex, vertex, sizeof vertex);
    return nodes;
}

/* Six times the volume between a triangle and the origin. */
static double volume_of(const int64_t *corner) {
    double a[3], b[3], c[3];
    place(corner[0], a);
    place(corner[1], b);
    place(corner[2], c);
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

static void solid_polyhedron_is_closed(void **state) {
    (void)state;
    struct kr_nodes *nodes = make_nodes();
    size_t count;
    int64_t *word = kr_topology_make(nodes, &count);
    int sides[8][8] = {{0}};
    double volume = 0;
    assert_int_equal(word[0], 16);
    assert_int_equal(word[1], 6); /* the halves of each side of the cube are one face */
    for (size_t f = 0; f < 6; f++) {
        const int64_t *face = word + 2 + 5 * f, half[3] = {face[1], face[3], face[4]};
        assert_int_equal(face[0], 4);
        volume += (volume_of(face + 1) + volume_of(half)) / 6;
        for (int k = 0; k < 4; k++)
            sides[face[1 + k]][face[1 + (k + 1) % 4]]++;
    }
    for (int a = 0; a < 8; a++)
        for (int b = 0; b < 8; b++) { /* once each way: closed, and all faces look outward */
            assert_int_equal(sides[a][b], sides[b][a]);
            assert_true(sides[a][b] <= 1);
        }
    kr_check_near(volume, 1, 1e-15);
    kr_free(word);
    kr_nodes_free(nodes);
}

static void solid_cells_have_their_numbers_and_corners(void **state) {
    (void)state;
    struct kr_nodes *nodes = make_nodes();
    size_t count;
    int64_t *word = kr_topology_make(nodes, &count);
    static const int64_t wanted[] = {6, 0, 1, 2, 4, 8, 0, 2, 1, 4, 6, 5, 9, 0, 1, 3, 2, 4, 5, 7, 6};
    assert_int_equal(count, 32 + sizeof wanted / sizeof *wanted);
    assert_memory_equal(word + 32, wanted, sizeof wanted);
    kr_free(word);
    kr_nodes_free(nodes);
    assert_int_equal(kr_memory_outstanding(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solid_polyhedron_is_closed),
        cmocka_unit_test(solid_cells_have_their_numbers_and_corners),
    };
    kr_run_tests(tests);
}
