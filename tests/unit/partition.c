/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Parts of the bond graph: what the report says is counted anew over all pairs; the same parts each
 * time; the node file keeps them, and the factors along the axes.
 */
#include "test.h"

#include "partition.h"
#include "plates.h"

enum { COLUMNS = 47, ROWS = 29 };
static const double SPACING = 0.1e-3, HORIZON = 0.37e-3;

static struct kr_nodes *plate(void) {
    return kr_plate_cells(COLUMNS, ROWS, SPACING, 6.1 * SPACING, 0.2, 8);
}

/* Bonds in all and between parts by brute force, by the definition of `none`: all within the
 * horizon. */
static void count(const struct kr_nodes *nodes, size_t *bonds, size_t *cut) {
    *bonds = *cut = 0;
    for (size_t i = 0; i < nodes->n; i++)
        for (size_t j = i + 1; j < nodes->n; j++) {
            const double *p = nodes->position + 2 * i, *q = nodes->position + 2 * j;
            int bonded = hypot(q[0] - p[0], q[1] - p[1]) <= HORIZON * (1 + 1e-9);
            *bonds += (size_t)bonded;
            *cut += (size_t)(bonded && nodes->partition[i] != nodes->partition[j]);
        }
}

static void check_parts(int parts) {
    struct kr_nodes *nodes = plate(), *again = plate();
    size_t bonds, cut, least = nodes->n, most = 0, *size = KR_NEW(size_t, (size_t)parts);
    struct kr_partition_report r = kr_partition_make(nodes, HORIZON, KR_PARTIAL_VOLUME_NONE, parts);
    kr_partition_make(again, HORIZON, KR_PARTIAL_VOLUME_NONE, parts);
    assert_memory_equal(nodes->partition, again->partition, nodes->n * sizeof *nodes->partition);
    for (size_t i = 0; i < nodes->n; i++) {
        assert_true(nodes->partition[i] >= 0 && nodes->partition[i] < parts);
        size[nodes->partition[i]]++;
    }
    for (int k = 0; k < parts; k++) {
        least = size[k] < least ? size[k] : least;
        most = size[k] > most ? size[k] : most;
    }
    count(nodes, &bonds, &cut);
    kr_figure("%d parts of %zu to %zu nodes, %zu of %zu bonds cut, balance %.3f", parts, least,
              most, cut, bonds, r.balance);
    assert_int_equal(r.bonds, bonds);
    assert_int_equal(r.cut, cut);
    assert_int_equal(r.least, least);
    assert_int_equal(r.most, most);
    /* METIS allows 3 %; a strip one horizon wide a part, of 47 x 29 nodes, is what a cut costs. */
    assert_true(r.balance >= 1 && r.balance < 1.04);
    assert_true(parts == 1 ? cut == 0 : cut > 0 && cut < bonds / 3);
    kr_free(size);
    kr_nodes_free(nodes);
    kr_nodes_free(again);
}

static void test_parts_are_what_the_report_says(void **state) {
    (void)state;
    check_parts(1);
    check_parts(2);
    check_parts(7);
}

static void test_one_sided_families_can_be_divided(void **state) {
    struct kr_nodes *nodes = plate();
    (void)state;
    kr_partition_make(nodes, HORIZON, KR_PARTIAL_VOLUME_HHB_ONE_SIDED, 3);
    assert_non_null(nodes->partition);
    kr_nodes_free(nodes);
}

static void test_node_file_keeps_parts_and_axes(void **state) {
    char path[] = "/tmp/kirsch-partition-XXXXXX";
    struct kr_nodes *nodes = plate();
    struct kr_material material = kr_pmma(KR_PLANE_STRESS, HORIZON);
    (void)state;
    close(mkstemp(path));
    kr_surface_make(nodes, &material, KR_SURFACE_FORCE_DENSITY, KR_PARTIAL_VOLUME_EXACT, 0);
    kr_partition_make(nodes, HORIZON, KR_PARTIAL_VOLUME_EXACT, 5);
    nodes->made_for = (struct kr_nodes_made_for){.horizon = HORIZON,
                                                 .model = "plane-stress",
                                                 .partial_volume = "exact",
                                                 .surface_correction = "force-density"};
    kr_nodes_write(nodes, path, "");
    struct kr_nodes *back = kr_nodes_read(path);
    assert_int_equal(back->pairing, KR_PAIRING_ELLIPSE);
    assert_memory_equal(back->partition, nodes->partition, nodes->n * sizeof *nodes->partition);
    assert_memory_equal(back->axis_factor, nodes->axis_factor,
                        2 * nodes->n * sizeof *nodes->axis_factor);
    kr_nodes_free(nodes);
    kr_nodes_free(back);
    unlink(path);
}

static void test_nothing_is_left(void **state) {
    (void)state;
    assert_int_equal(kr_memory_outstanding(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_parts_are_what_the_report_says),
        cmocka_unit_test(test_one_sided_families_can_be_divided),
        cmocka_unit_test(test_node_file_keeps_parts_and_axes),
        cmocka_unit_test(test_nothing_is_left),
    };
    kr_run_tests(tests);
}
