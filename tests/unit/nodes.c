/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Nodes: file and back, a new order, and each way in which they can be wrong.
 */
#include "test.h"
#include "folder.h"

#include "base/error.h"
#include "nodes.h"
#include "plates.h"

enum { COLUMNS = 7, ROWS = 5 };
static char path[64];

static int set_up(void **state) {
    if (make_folder(state))
        return -1;
    snprintf(path, sizeof path, "%s/plate.nodes.h5", folder);
    return 0;
}

static void add_set(struct kr_nodes *nodes, const char *name, size_t from, size_t step,
                    double measure) {
    int64_t *node = KR_NEW(int64_t, nodes->n);
    size_t count = 0;
    for (size_t i = from; i < nodes->n; i += step)
        node[count++] = (int64_t)i;
    kr_nodes_add_set(nodes, name, count, node, measure);
}

/* A lattice with square cells, odd numbers everywhere, and sets, one of them empty. */
static struct kr_nodes *make_nodes(void) {
    const double h = 0.137e-3;
    struct kr_nodes *nodes = kr_plate_lattice(COLUMNS, ROWS, h);
    nodes->n_points = (COLUMNS + 1) * (ROWS + 1);
    nodes->point = KR_NEW(double, 2 * nodes->n_points);
    nodes->first = KR_NEW(int64_t, nodes->n + 1);
    nodes->vertex = KR_NEW(int64_t, 4 * nodes->n);
    for (size_t p = 0; p < nodes->n_points; p++) {
        nodes->point[2 * p] = (double)(p % (COLUMNS + 1)) * h;
        nodes->point[2 * p + 1] = (double)(p / (COLUMNS + 1)) * h;
    }
    for (size_t i = 0; i < nodes->n; i++) {
        int64_t corner = (int64_t)(i / COLUMNS * (COLUMNS + 1) + i % COLUMNS);
        const int64_t of_cell[] = {corner, corner + 1, corner + COLUMNS + 2, corner + COLUMNS + 1};
        memcpy(nodes->vertex + 4 * i, of_cell, sizeof of_cell);
        nodes->first[i + 1] = 4 * (int64_t)(i + 1);
        nodes->factor[i] = 1 + 0.013 * (double)i;
        nodes->tag[i] = 1000 + 3 * (int64_t)i;
    }
    add_set(nodes, "third", 1, 3, 0.959e-3);
    add_set(nodes, "nobody", nodes->n, 1, 0);
    nodes->made_for =
        (struct kr_nodes_made_for){0.41e-3, "plane-strain", "hhb", "energy", "isotropic", "conical"};
    return nodes;
}

static void check_same(const struct kr_nodes *a, const struct kr_nodes *b) {
    assert_int_equal(a->n, b->n);
    assert_int_equal(a->n_points, b->n_points);
    assert_int_equal(a->n_sets, b->n_sets);
    assert_true(a->spacing == b->spacing && a->made_for.horizon == b->made_for.horizon);
    assert_memory_equal(a->position, b->position, 2 * a->n * sizeof(double));
    assert_memory_equal(a->volume, b->volume, a->n * sizeof(double));
    assert_memory_equal(a->factor, b->factor, a->n * sizeof(double));
    assert_memory_equal(a->tag, b->tag, a->n * sizeof(int64_t));
    assert_memory_equal(a->point, b->point, 2 * a->n_points * sizeof(double));
    assert_memory_equal(a->first, b->first, (a->n + 1) * sizeof(int64_t));
    assert_memory_equal(a->vertex, b->vertex, (size_t)a->first[a->n] * sizeof(int64_t));
    assert_string_equal(a->made_for.model, b->made_for.model);
    assert_string_equal(a->made_for.micromodulus, b->made_for.micromodulus);
    assert_string_equal(a->made_for.deformation, b->made_for.deformation);
    for (size_t s = 0; s < a->n_sets; s++) {
        const struct kr_set *set = kr_nodes_set(b, a->set[s].name);
        assert_non_null(set);
        assert_int_equal(set->count, a->set[s].count);
        assert_true(set->measure == a->set[s].measure);
        assert_memory_equal(set->node, a->set[s].node, set->count * sizeof(int64_t));
    }
}

static void test_nodes_file_and_back(void **state) {
    struct kr_nodes *nodes = make_nodes();
    (void)state;
    kr_nodes_write(nodes, path, "a deck");
    struct kr_nodes *back = kr_nodes_read(path);
    check_same(nodes, back);
    assert_null(kr_nodes_set(back, "fourth"));
    kr_nodes_free(back);
    kr_nodes_free(nodes);
}

/* A new order moves all that belongs to a node with it; the old one brings everything back. */
static void test_nodes_reordered(void **state) {
    struct kr_nodes *nodes = make_nodes(), *whole = make_nodes();
    size_t order[COLUMNS * ROWS], back[COLUMNS * ROWS];
    (void)state;
    for (size_t k = 0; k < nodes->n; k++) {
        order[k] = (11 * k + 4) % nodes->n; /* 11 and 35 have no common divisor */
        back[order[k]] = k;
    }
    kr_nodes_reorder(nodes, order);
    for (size_t k = 0; k < nodes->n; k++) {
        size_t old = order[k];
        assert_true(nodes->position[2 * k + 1] == whole->position[2 * old + 1]);
        assert_true(nodes->factor[k] == whole->factor[old]);
        assert_int_equal(nodes->tag[k], whole->tag[old]);
        assert_int_equal(nodes->vertex[nodes->first[k] + 2], whole->vertex[whole->first[old] + 2]);
    }
    const struct kr_set *set = kr_nodes_set(nodes, "third");
    for (size_t k = 0; k < set->count; k++) {
        assert_int_equal(order[set->node[k]] % 3, 1);
        assert_true(k == 0 || set->node[k] > set->node[k - 1]);
    }
    kr_nodes_reorder(nodes, back);
    check_same(whole, nodes);
    kr_nodes_free(whole);
    kr_nodes_free(nodes);
}

static void spoil(struct kr_nodes *nodes, int how) {
    switch (how) {
    case 0:
        nodes->position[9] = NAN;
        break;
    case 1:
        nodes->volume[4] = -nodes->volume[4];
        break;
    case 2:
        nodes->factor[4] = INFINITY;
        break;
    case 3:
        nodes->set[0].node[2] = nodes->set[0].node[1];
        break;
    case 4:
        nodes->set[0].node[nodes->set[0].count - 1] = (int64_t)nodes->n;
        break;
    case 5:
        nodes->vertex[6] = (int64_t)nodes->n_points;
        break;
    case 6:
        memcpy(nodes->position + 20, nodes->position + 32, 2 * sizeof(double));
        break;
    case 7:
        nodes->spacing = 0;
        break;
    default:
        nodes->n = 0;
    }
}

static void test_nodes_faults_are_named(void **state) {
    static const char *const words[] = {"node 4 (tag 1012)", "node 4 (tag 1012) has the volume",
                                        "surface factor",    "ascending",
                                        "holds the node 35", "corner 48",
                                        "nodes 10 and 16",   "spacing",
                                        "no nodes"};
    (void)state;
    for (int how = 0; how < (int)(sizeof words / sizeof *words); how++) {
        struct kr_nodes *nodes = make_nodes();
        assert_null(kr_nodes_fault(nodes));
        spoil(nodes, how);
        char *fault = kr_nodes_fault(nodes);
        if (!fault || !strstr(fault, words[how]))
            fail_msg("said '%s', wanted to find '%s'", fault ? fault : "nothing", words[how]);
        kr_free(fault);
        kr_nodes_free(nodes);
    }
}

static void read_file(void *argument) {
    kr_nodes_read(argument);
}

/* Cut anywhere, the file is refused with its name; never read in part. */
static void test_nodes_file_cut(void **state) {
    struct kr_nodes *nodes = make_nodes();
    (void)state;
    kr_nodes_write(nodes, path, "a deck");
    FILE *file = fopen(path, "r");
    fseek(file, 0, SEEK_END);
    long size = ftell(file);
    fclose(file);
    for (int part = 9; part >= 0; part--) {
        assert_int_equal(truncate(path, size * part / 10), 0);
        kr_check_stops(read_file, path, KR_EXIT_INPUT, path);
    }
    unlink(path);
    kr_check_stops(read_file, path, KR_EXIT_INPUT, path);
    kr_nodes_free(nodes);
}

static void test_nodes_file_with_a_fault(void **state) {
    struct kr_nodes *nodes = make_nodes();
    (void)state;
    spoil(nodes, 6);
    kr_nodes_write(nodes, path, "a deck");
    kr_check_stops(read_file, path, KR_EXIT_INPUT, "make it anew with kirsch-nodes");
    kr_nodes_free(nodes);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_nodes_file_and_back, set_up, remove_folder),
        cmocka_unit_test(test_nodes_reordered),
        cmocka_unit_test(test_nodes_faults_are_named),
        cmocka_unit_test_setup_teardown(test_nodes_file_cut, set_up, remove_folder),
        cmocka_unit_test_setup_teardown(test_nodes_file_with_a_fault, set_up, remove_folder),
    };
    kr_run_tests(tests);
}
