/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Regions in space filled by child processes. Helpers that crash, hang, warn or lie stand in for gmsh:
 * what they do wrong is found, the second method is tried, and at last there is a clear stop.
 */
#include "test.h"

#include "folder.h"

#include "base/error.h"
#include "gmsh_solid.h"

#include <time.h>

/** A double pyramid of five points, as three tetrahedra around its axis: six triangles. */
static struct kr_solid_region pyramid(void) {
    static const double point[5][3] = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.9, 0}};
    static const size_t triangle[6][3] = {{0, 2, 3}, {0, 3, 4}, {0, 4, 2}, {1, 3, 2}, {1, 4, 3}, {1, 2, 4}};
    static const size_t cell[3][4] = {{0, 1, 3, 2}, {0, 1, 4, 3}, {0, 1, 2, 4}};
    struct kr_solid_region r = {.n_shell_points = 5, .n_points = 5, .n_triangles = 6, .n_cells = 3,
                                .name = kr_text_copy("around void_3")};
    r.point = kr_alloc(5, sizeof *r.point);
    r.triangle = kr_alloc(6, sizeof *r.triangle);
    r.cell = kr_alloc(3, sizeof *r.cell);
    memcpy(r.point, point, sizeof point);
    memcpy(r.triangle, triangle, sizeof triangle);
    memcpy(r.cell, cell, sizeof cell);
    return r;
}

/* The same as two, above and below. */
static const char good[] = "points 0\\ncells 2\\n0 2 3 4\\n1 2 3 4\\nend\\n";

/** Write a shell script that stands in for kirsch-gmsh-solid; returns the name as kirsch-gmsh's. */
static char *helper(const char *name, const char *body) {
    char *program = kr_text("%s-solid", name), *base = kr_text("%s/%s", folder, name);
    kr_free(make_program(program, body));
    kr_free(program);
    return base;
}

static void fill(void *path) {
    struct kr_solid_region r = pyramid();
    kr_solid_fill(1, &r, &(struct kr_gmsh_options){.helper = path, .children = 1, .seconds = 2});
    printf("%zu cells by %s\n", r.n_cells, r.method);
    fflush(stdout);
    kr_solid_region_free(&r);
}

/** With this helper both methods must fail for this reason, and nothing be made. */
static void expect_stop(const char *body, const char *text) {
    char *path = helper("bad", body), *first = kr_text("gmsh's Delaunay failed: %s", text);
    char *second = kr_text("gmsh cannot fill the region around void_3 by any of 2 methods; the last, Delaunay, "
                           "not optimized, failed: %s", text);
    kr_check_stops(fill, path, KR_EXIT_LIBRARY, first);
    kr_check_stops(fill, path, KR_EXIT_LIBRARY, second);
    kr_free(first);
    kr_free(second);
    kr_free(path);
}

static void expect_refused(const char *reply, const char *text) {
    char *body = kr_text("printf '%%b' '%s'", reply);
    expect_stop(body, text);
    kr_free(body);
}

static void solid_good_reply_is_taken(void **unused) {
    (void)unused;
    char *body = kr_text("cat > %s/request; printf '%%b' '%s'", folder, good), line[256];
    char *path = helper("good", body), *request = kr_text("%s/request", folder);
    struct kr_solid_region r = pyramid();
    kr_solid_fill(1, &r, &(struct kr_gmsh_options){.helper = path});
    assert_int_equal(r.n_cells, 2);
    assert_string_equal(r.method, "Delaunay");
    FILE *file = fopen(request, "r");
    assert_non_null(fgets(line, sizeof line, file));
    assert_string_equal(line, "solid algorithm 1 optimize 1 size 1.6 shells 1\n");
    fclose(file);
    kr_solid_region_free(&r);
    kr_free(body);
    kr_free(path);
    kr_free(request);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void solid_crashes_warnings_and_hangs_are_told(void **unused) {
    (void)unused;
    expect_stop("kill -SEGV $$", "it crashed (Segmentation fault)");
    expect_stop("echo 'Error   : no room' >&2; exit 1", "it ended with exit code 1; it said: Error   : no room");
    char *body = kr_text("echo 'Warning : odd' >&2; printf '%%b' '%s'", good);
    expect_stop(body, "it said: Warning : odd");
    kr_free(body);
    body = kr_text("echo 'Warning : 1 ill-shaped tets are still in the mesh' >&2; printf '%%b' '%s'", good);
    char *slivers = helper("slivers", body);
    kr_check_stops(fill, slivers, 0, "2 cells by Delaunay\n");
    kr_free(slivers);
    kr_free(body);
    char *path = helper("hangs", "while :; do :; done");
    time_t began = time(NULL);
    kr_check_stops(fill, path, KR_EXIT_LIBRARY, "not optimized, failed: it was not done after 2 s of work");
    assert_true(time(NULL) - began < 2 * 2 * 20); /* the limit by the clock */
    kr_free(path);
}

static void solid_second_method_is_tried(void **unused) {
    (void)unused;
    char *body = kr_text("read a b c d e rest; [ $e = 1 ] && kill -SEGV $$; printf '%%b' '%s'", good);
    char *path = helper("second", body);
    kr_check_stops(fill, path, 0, "trying Delaunay, not optimized");
    kr_check_stops(fill, path, 0, "2 cells by Delaunay, not optimized");
    kr_free(body);
    kr_free(path);
}

static void solid_wrong_replies_are_refused(void **unused) {
    (void)unused;
    expect_refused("", "its reply ends early");
    expect_refused("points 0\\ncells 99999999999\\n0 2 3 4\\n", "its reply ends early");
    expect_refused("points 0\\ncells 2\\n0 2 3 4\\n1 2 3 5\\nend\\n", "its reply ends early");
    expect_refused("points 1\\nnan 0 0\\ncells 2\\n0 2 3 5\\n1 2 3 5\\nend\\n", "a cell at (0, 0, 1) is flat");
    /* half of it; the upper half twice, which fills no more than all; and both, but through each other */
    expect_refused("points 0\\ncells 1\\n0 2 3 4\\nend\\n", "the cells' volumes sum to 0.45 instead of 0.9");
    expect_refused("points 0\\ncells 2\\n0 2 3 4\\n0 2 3 4\\nend\\n", "cells overlap at");
    expect_refused("points 1\\n0 0 -1\\ncells 2\\n0 2 3 4\\n5 2 3 4\\nend\\n", 
                   "a triangle of the boundary at (0, 0, -1) is no face of one cell");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solid_good_reply_is_taken),
        cmocka_unit_test(solid_crashes_warnings_and_hangs_are_told),
        cmocka_unit_test(solid_second_method_is_tried),
        cmocka_unit_test(solid_wrong_replies_are_refused),
    };
    char filter[256];
    const char *only = getenv("ONLY");
    snprintf(filter, sizeof filter, "*%s*", only ? only : "");
    cmocka_set_test_filter(filter);
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
