/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Input for CalculiX: a triangle, a quadrilateral and a pentagon beside each other.
 */
#include "test.h"

#include "inp.h"

#include <string.h>

static char path[] = "/tmp/kirsch-inp-XXXXXX.inp", text[4096];

static int begin(void **unused) {
    (void)unused;
    int file = mkstemps(path, 4);
    return file < 0 || close(file);
}

static int end(void **unused) {
    (void)unused;
    return unlink(path);
}

/*   3--4--5--7     a triangle 0 1 3, a square 1 2 4 3 of side 0.5, a pentagon 2 6 7 5 4
 *    \ |  |  |     (5 lies on its upper side)
 *  0--\1--2--6  */
static struct kr_nodes *three_cells(void) {
    static const double point[] = {0, 0, 0.5, 0, 1, 0, 0.5, 0.5, 1, 0.5, 1.25, 0.5, 1.5, 0, 1.5, 0.5};
    static const int64_t first[] = {0, 3, 7, 12}, vertex[] = {0, 1, 3, 1, 2, 4, 3, 2, 6, 7, 5, 4};
    static const double place[] = {1 / 3.0, 1 / 6.0, 0.75, 0.25, 1.25, 0.25};
    struct kr_nodes *nodes = kr_nodes_create(2, 3);
    memcpy(nodes->position, place, sizeof place);
    nodes->n_points = 8;
    nodes->point = KR_NEW(double, 16);
    nodes->first = KR_NEW(int64_t, 4);
    nodes->vertex = KR_NEW(int64_t, 12);
    memcpy(nodes->point, point, sizeof point);
    memcpy(nodes->first, first, sizeof first);
    memcpy(nodes->vertex, vertex, sizeof vertex);
    return nodes;
}

static void add_set(struct kr_nodes *nodes, const char *name, int64_t node) {
    int64_t *member = KR_NEW(int64_t, 1);
    *member = node;
    kr_nodes_add_set(nodes, name, 1, member, 0);
}

static const char *written(const struct kr_nodes *nodes) {
    kr_inp_write(nodes, path);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
    return text;
}

static void inp_has_corners_elements_and_sets(void **unused) {
    (void)unused;
    struct kr_nodes *nodes = three_cells();
    add_set(nodes, "wedge", 0);
    add_set(nodes, "right", 2);
    const char *said = written(nodes);
    assert_non_null(strstr(said, "\n3, 1, 0, 0\n"));
    assert_non_null(strstr(said, "\n8, 1.5, 0.5, 0\n9, 1.25, 0.25, 0\n*ELEMENT"));
    assert_non_null(strstr(said, "*ELEMENT, TYPE=CPS3, ELSET=cells\n1, 1, 2, 4\n*ELEMENT, TYPE=CPS4, "
                                 "ELSET=cells\n2, 2, 3, 5, 4\n*ELEMENT, TYPE=CPS3, ELSET=cells\n"
                                 "4, 9, 3, 7\n5, 9, 7, 8\n6, 9, 8, 6\n7, 9, 6, 5\n8, 9, 5, 3\n"));
    assert_non_null(strstr(said, "*ELSET, ELSET=wedge\n1,\n*NSET, NSET=wedge\n1,\n2,\n4,\n"));
    assert_non_null(strstr(said, "*ELSET, ELSET=right\n4,\n5,\n6,\n7,\n8,\n"
                                 "*NSET, NSET=right\n3,\n5,\n6,\n7,\n8,\n9,\n"));
    kr_nodes_free(nodes);
    assert_int_equal(kr_memory_outstanding(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inp_has_corners_elements_and_sets),
    };
    return cmocka_run_group_tests_name("inp", tests, begin, end);
}
