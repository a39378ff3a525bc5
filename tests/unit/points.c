/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Nodes from text: Peridigm, PeriLab, CSV, node sets; faults are named with their line.
 */
#include "test.h"

#include "points.h"

static char path[] = "/tmp/kirsch-points-XXXXXX.txt", set_path[] = "/tmp/kirsch-left-XXXXXX.txt";

static void put(const char *to, const char *text) {
    FILE *file = fopen(to, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static int begin(void **unused) {
    (void)unused;
    int a = mkstemps(path, 4), b = mkstemps(set_path, 4);
    return a < 0 || b < 0 || close(a) || close(b);
}

static int end(void **unused) {
    (void)unused;
    return unlink(path) || unlink(set_path);
}

static void peridigms_text_is_read(void **unused) {
    (void)unused;
    put(path, "# x y z volume block\n1 0 0 0.5 2\n 0 0 0 0.25 1 # first in its row\n\n0 1e0 0.5 1 2\r\n");
    struct kr_nodes *nodes = kr_points_read(path, 1, 0);
    assert_int_equal(nodes->dim, 3);
    assert_int_equal(nodes->n, 3);
    assert_int_equal(nodes->tag[0], 2); /* in rows, with the number of its line */
    kr_check_near(nodes->volume[0], 0.25, 0);
    assert_int_equal(kr_nodes_set(nodes, "block_2")->count, 2);
    assert_int_equal(kr_nodes_set(nodes, "block_1")->node[0], 0);
    assert_int_equal(kr_nodes_set(nodes, "body")->count, 3);
    put(set_path, "2 1\n2\n");
    kr_points_read_set(set_path, nodes);
    assert_int_equal(nodes->set[nodes->n_sets - 1].count, 2);
    assert_int_equal(nodes->set[nodes->n_sets - 1].node[1], 1);
    kr_nodes_free(nodes);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void columns_are_found_by_name(void **unused) {
    (void)unused;
    put(path, "header: y x block_id volume\n0 2 7 3\n0 5 7 3\n");
    struct kr_nodes *nodes = kr_points_read(path, 1e-3, 0);
    assert_int_equal(nodes->dim, 2);
    kr_check_near(nodes->position[0], 2e-3, 1e-18);
    kr_check_near(nodes->volume[0], 3e-6, 1e-21); /* areas */
    assert_int_equal(kr_nodes_set(nodes, "block_7")->count, 2);
    kr_nodes_free(nodes);
    put(path, "ID [1];X [m];Y [m];Z [m];VOLUME [m^3]\n90;1;2;4;0.5\n30;0;2;4;0.5\n");
    nodes = kr_points_read(path, 1, 0.25);
    assert_int_equal(nodes->dim, 2);
    assert_int_equal(nodes->tag[1], 90);
    kr_check_near(nodes->volume[1], 2, 0); /* of thickness 0.25 */
    put(set_path, "header: global_id\n90\n");
    kr_points_read_set(set_path, nodes);
    assert_int_equal(nodes->set[nodes->n_sets - 1].node[0], 1);
    kr_nodes_free(nodes);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void what_is_written_is_read(void **unused) {
    (void)unused;
    put(path, "x,y,z,volume,block_id,tip,note\n0,0,0,0.1,1,0,5\n0.3,0.1,0,0.7,4,1,5\n"
              "0.1,0.9,0.8,0.3,4,1,5\n");
    struct kr_nodes *nodes = kr_points_read(path, 1, 0);
    char *stem = kr_text("%.*s-out", (int)strlen(path) - 4, path);
    char *text = kr_text("%s.txt", stem), *csv = kr_text("%s.csv", stem),
         *body = kr_text("%s_ns_body.txt", stem), *tip = kr_text("%s_ns_tip.txt", stem);
    kr_points_write_peridigm(nodes, stem, 0);
    kr_points_write_csv(nodes, stem, 0);
    struct kr_nodes *again = kr_points_read(text, 1, 0);
    assert_memory_equal(nodes->position, again->position, 9 * sizeof(double));
    assert_memory_equal(nodes->volume, again->volume, 3 * sizeof(double));
    assert_int_equal(kr_nodes_set(again, "block_4")->count, 2);
    kr_nodes_free(again);
    again = kr_points_read(csv, 1, 0);
    assert_memory_equal(nodes->position, again->position, 9 * sizeof(double));
    assert_int_equal(again->n_sets, nodes->n_sets);
    assert_memory_equal(kr_nodes_set(again, "tip")->node, kr_nodes_set(nodes, "tip")->node, 16);
    kr_nodes_free(again);
    kr_nodes_free(nodes);
    assert_int_equal(unlink(text) | unlink(csv) | unlink(body) | unlink(tip), 0);
    kr_free(text);
    kr_free(csv);
    kr_free(body);
    kr_free(tip);
    kr_free(stem);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void read_it(void *unused) {
    (void)unused;
    kr_points_read(path, 1, 0);
}

static void read_set(void *nodes) {
    kr_points_read_set(set_path, nodes);
}

static void spoil(const char *text, const char *wanted) {
    put(path, text);
    kr_check_stops(read_it, NULL, 2, wanted);
}

static void faults_are_named_with_their_line(void **unused) {
    (void)unused;
    spoil("", "no nodes found");
    spoil("0 0 0 1 1\n1 0 0 x 1\n", ".txt:2: expected a volume, found 'x'");
    spoil("0 0 0 1\n", ".txt:1: expected a block number, found ''");
    spoil("0 0 0 1 1 9\n", "found '9' behind the last of 5 columns");
    spoil("0 0 0 -1 1\n", "the volume is -1; expected a positive one");
    spoil("0 nan 0 1 1\n", "expected y, found 'nan'");
    spoil("0 0 0 1 1.5\n", "row 1 has 1.5 for a block number");
    spoil("x,y\n0,0\n", "expected columns named x, y and volume");
    spoil("x,x,volume\n0,0,1\n", "two columns have the same meaning");
    spoil("0 0 0 1 1\n0 0 0 1 1\n", "stand at one place");
    put(path, "0 0 0 1 1\n");
    struct kr_nodes *nodes = kr_points_read(path, 1, 0);
    put(set_path, "1\n2\n");
    kr_check_stops(read_set, nodes, 2, ".txt:2: expected the number of a node, found '2'");
    put(set_path, "\n");
    kr_check_stops(read_set, nodes, 2, "no node numbers found");
    kr_nodes_free(nodes);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(peridigms_text_is_read),
        cmocka_unit_test(columns_are_found_by_name),
        cmocka_unit_test(what_is_written_is_read),
        cmocka_unit_test(faults_are_named_with_their_line),
    };
    char filter[256];
    const char *only = getenv("ONLY");
    snprintf(filter, sizeof filter, "*%s*", only ? only : "");
    cmocka_set_test_filter(filter);
    return cmocka_run_group_tests(tests, begin, end);
}
