/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Regions filled by child processes. Helpers that crash, hang, lie or say nothing stand in for
 * gmsh: what they do wrong is found, the next method is tried, and at last it stops.
 */
#include "test.h"

#include "folder.h"

#include "fill.h"
#include "gmsh.h"

#include <time.h>

/** A region of 2 by 1 squares of the lattice. */
static struct kr_gmsh_region region_of_two(void) {
    static const double corner[] = {0, 0, 2, 0, 2, 1, 0, 1};
    static const size_t segments[] = {2, 1, 2, 1};
    struct kr_gmsh_region region = {.n_loops = 1, .name = "around hole_7"};
    region.first = KR_NEW(size_t, 2);
    region.first[1] = 4;
    region.corner = KR_NEW(double, 8);
    region.segments = KR_NEW(size_t, 4);
    memcpy(region.corner, corner, sizeof corner);
    memcpy(region.segments, segments, sizeof segments);
    return region;
}

static const char good[] = "nodes 6\n0 0\n1 0\n2 0\n2 1\n1 1\n0 1\ncells 0\n"
                           "cells 2\n4 0 1 4 5\n4 1 2 3 4\nend\n";

static void fill(void *path) {
    struct kr_gmsh_region region = region_of_two();
    struct kr_gmsh_options options = {path, 1, 2};
    kr_gmsh_fill(1, &region, &options);
    printf("filled by %s with %zu cells\n", region.method, region.n_cells);
    fflush(stdout);
    kr_gmsh_region_free(&region);
}

/** With this helper the filling must stop with exit 5, saying `text`. */
static void expect_stop(const char *body, const char *text) {
    char *path = make_program("bad", body);
    kr_check_stops(fill, path, 5, text);
    kr_check_stops(fill, path, 5, "gmsh cannot fill the region around hole_7 by any of 4 methods");
    kr_free(path);
}

/** With this reply instead of the good one it must stop, saying `text`. */
static void expect_refused(const char *reply, const char *text) {
    char *body = kr_text("printf '%%b' '%s'", reply);
    expect_stop(body, text);
    kr_free(body);
}

static void a_good_reply_is_taken(void **unused) {
    (void)unused;
    char *body = kr_text("cat > %s/request; printf '%%b' '%s'", folder, good), line[256];
    char *path = make_program("good", body), *request = kr_text("%s/request", folder);
    struct kr_gmsh_region region = region_of_two();
    kr_gmsh_fill(1, &region, &(struct kr_gmsh_options){path, 0, 0});
    assert_int_equal(region.n_cells, 2);
    assert_int_equal(region.n_points, 6);
    assert_int_equal(region.n_on_loops, 6);
    assert_true(region.seconds > 0 && region.seconds < 10);
    kr_check_near(kr_gmsh_twice_area(&region), 4, 0);
    kr_gmsh_region_free(&region);
    FILE *file = fopen(request, "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    assert_string_equal(line,
                        "region algorithm 9 recombination 1 size 0.97999999999999998 loops 1\n");
    fclose(file);
    kr_free(body);
    kr_free(path);
    kr_free(request);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void crashes_are_told(void **unused) {
    (void)unused;
    expect_stop("kill -SEGV $$", "it crashed (Segmentation fault)");
    expect_stop("kill -ABRT $$", "it crashed (Aborted)");
    expect_stop("exit 3", "it ended with exit code 3");
    expect_stop("echo 'Error   : no room' >&2; exit 1", "exit code 1; it said: Error   : no room");
    char *missing = kr_text("%s/missing", folder);
    kr_check_stops(fill, missing, 5, "it could not be started");
    kr_free(missing);
}

static void fill_from_the_third(void *path) {
    struct kr_gmsh_region region = region_of_two();
    struct kr_gmsh_options options = {path, 1, 2, KR_FILL_LINEAR};
    kr_gmsh_fill(1, &region, &options);
}

/** Large regions begin with the third method: all four are tried, the first two last. */
static void all_methods_are_tried_whichever_is_first(void **unused) {
    (void)unused;
    char *tried = kr_text("%s/tried", folder), *body = kr_text("read line; echo $line >> %s; exit 3", tried);
    char *path = make_program("each", body), line[256];
    kr_check_stops(fill_from_the_third, path, 5, "the last, frontal-Delaunay (6), blossom, failed");
    static const char *const algorithm[] = {"9 recombination 0", "6 recombination 0", "9 recombination 1",
                                            "6 recombination 1"};
    FILE *file = fopen(tried, "r");
    assert_non_null(file);
    for (int k = 0; k < 4; k++) {
        assert_non_null(fgets(line, sizeof line, file));
        assert_non_null(strstr(line, algorithm[k]));
    }
    assert_null(fgets(line, sizeof line, file));
    fclose(file);
    kr_free(tried);
    kr_free(body);
    kr_free(path);
}

static void a_hanging_child_is_ended(void **unused) {
    (void)unused;
    /* The first method hangs for its two seconds, the next ones end at once. */
    char *body = kr_text("read a b c rest; [ $c = 9 ] && case $rest in *' 1 size'*) while :; do :; "
                         "done;; esac; printf '%%b' '%s'",
                         good);
    char *path = make_program("hangs", body);
    time_t began = time(NULL);
    kr_check_stops(fill, path, 0,
                   "packing of parallelograms (9), blossom failed: it was not done after 2 s of work");
    assert_true(time(NULL) - began < 2 * 20); /* the limit by the clock */
    kr_free(body);
    kr_free(path);
}

/* A busy machine may keep a child waiting: that is not hanging. */
static void a_waiting_child_is_left_alone(void **unused) {
    (void)unused;
    char *body = kr_text("sleep 3; printf '%%b' '%s'", good), *path = make_program("waits", body);
    kr_check_stops(fill, path, 0, "filled by packing of parallelograms (9), blossom with 2 cells");
    kr_free(body);
    kr_free(path);
}

static void a_warning_is_a_failure_though_the_reply_is_good(void **unused) {
    (void)unused;
    char *body = kr_text("echo 'Warning : odd number' >&2; printf '%%b' '%s'", good);
    expect_stop(body, "it said: Warning : odd number");
    kr_free(body);
}

static void the_next_method_is_tried(void **unused) {
    (void)unused;
    char *body = kr_text("read a b c rest; [ $c = 9 ] && kill -SEGV $$; printf '%%b' '%s'", good);
    char *path = make_program("second", body);
    kr_check_stops(fill, path, 0, "trying frontal-Delaunay (6), blossom");
    kr_check_stops(fill, path, 0, "filled by frontal-Delaunay (6), blossom with 2 cells");
    kr_free(body);
    kr_free(path);
}

static void wrong_replies_are_refused(void **unused) {
    (void)unused;
    expect_refused("", "its reply ends early");
    expect_refused("nodes 6\\n0 0\\n1 0\\n", "its reply ends early");
    expect_refused("nodes 99999999999999\\n0 0\\n", "its reply ends early");
    /* no end; a vertex that does not exist; too few points */
    expect_refused("nodes 6\\n0 0\\n1 0\\n2 0\\n2 1\\n1 1\\n0 1\\ncells 0\\n"
                   "cells 2\\n4 0 1 4 5\\n4 1 2 3 4\\n",
                   "its reply ends early");
    expect_refused("nodes 6\\n0 0\\n1 0\\n2 0\\n2 1\\n1 1\\n0 1\\ncells 0\\n"
                   "cells 2\\n4 0 1 4 5\\n4 1 2 3 4\\nand\\n",
                   "its reply ends early");
    expect_refused("nodes 6\\n0 0\\n1 0\\n2 0\\n2 1\\n1 1\\n0 1\\ncells 0\\n"
                   "cells 2\\n4 0 1 4 6\\n4 1 2 3 4\\nend\\n",
                   "its reply ends early");
    expect_refused("nodes 4\\n0 0\\n2 0\\n2 1\\n0 1\\ncells 0\\ncells 1\\n4 0 1 2 3\\nend\\n",
                   "its reply ends early");
    /* a point of the boundary moved */
    expect_refused("nodes 6\\n0 0\\n1.1 0\\n2 0\\n2 1\\n1 1\\n0 1\\ncells 0\\n"
                   "cells 2\\n4 0 1 4 5\\n4 1 2 3 4\\nend\\n",
                   "it moved a point of the boundary from (1, 0) to (1.1, 0)");
    /* one cell only; one of them twice; one with its corners crossed */
    expect_refused("nodes 6\\n0 0\\n1 0\\n2 0\\n2 1\\n1 1\\n0 1\\ncells 0\\n"
                   "cells 1\\n4 0 1 4 5\\nend\\n",
                   "the cells leave a gap");
    expect_refused("nodes 6\\n0 0\\n1 0\\n2 0\\n2 1\\n1 1\\n0 1\\ncells 0\\n"
                   "cells 3\\n4 0 1 4 5\\n4 1 2 3 4\\n4 1 2 3 4\\nend\\n",
                   "cells overlap");
    /* a point inside, so far out that the cells fold over each other: their sum is right */
    expect_refused("nodes 7\\n0 0\\n1 0\\n2 0\\n2 1\\n1 1\\n0 1\\n3 0.5\\ncells 6\\n3 0 1 6\\n"
                   "3 1 2 6\\n3 2 3 6\\n3 3 4 6\\n3 4 5 6\\n3 5 0 6\\ncells 0\\nend\\n",
                   "is folded or has no area");
    /* an extra point on the perimeter */
    expect_refused("nodes 7\\n0 0\\n1 0\\n2 0\\n2 1\\n1 1\\n0 1\\n0.5 0\\ncells 1\\n3 0 6 5\\n"
                   "cells 2\\n4 6 1 4 5\\n4 1 2 3 4\\nend\\n",
                   "the cells leave a gap");
}

static void a_nan_is_refused(void **unused) {
    (void)unused;
    expect_refused("nodes 6\\n0 0\\nnan 0\\n2 0\\n2 1\\n1 1\\n0 1\\ncells 0\\n"
                   "cells 2\\n4 0 1 4 5\\n4 1 2 3 4\\nend\\n",
                   "its reply ends early");
}

/** Twenty regions by three children at once: each gets its own reply, whoever ends first. */
static void many_regions_get_their_own(void **unused) {
    (void)unused;
    /* The helper fills a region of width w by w squares; the wider end sooner. */
    char *path = make_program(
        "wide",
        "read a; read b; read c; read w rest; w=$(cat | sed -n 's/^\\([0-9]*\\) 1 .*/\\1/p' | "
        "head -n 1)\n"
        "sleep 0.$((30 - w))\n"
        "awk -v w=$w 'BEGIN { print \"nodes\", 2 * w + 2\n"
        "for (i = 0; i <= w; i++) print i, 0; for (i = w; i >= 0; i--) print i, 1\n"
        "print \"cells 0\"; print \"cells\", w\n"
        "for (i = 0; i < w; i++) print 4, i, i + 1, 2 * w - i, 2 * w + 1 - i\n"
        "print \"end\" }'");
    struct kr_gmsh_region region[20];
    for (size_t r = 0; r < 20; r++) {
        region[r] = region_of_two();
        region[r].corner[2] = region[r].corner[4] = (double)r + 1;
        region[r].segments[0] = region[r].segments[2] = r + 1;
    }
    kr_gmsh_fill(20, region, &(struct kr_gmsh_options){path, 3, 60});
    for (size_t r = 0; r < 20; r++) {
        assert_int_equal(region[r].n_cells, r + 1);
        kr_gmsh_region_free(&region[r]);
    }
    kr_free(path);
    assert_int_equal(kr_memory_outstanding(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_good_reply_is_taken),
        cmocka_unit_test(crashes_are_told),
        cmocka_unit_test(all_methods_are_tried_whichever_is_first),
        cmocka_unit_test(a_hanging_child_is_ended),
        cmocka_unit_test(a_waiting_child_is_left_alone),
        cmocka_unit_test(a_warning_is_a_failure_though_the_reply_is_good),
        cmocka_unit_test(the_next_method_is_tried),
        cmocka_unit_test(wrong_replies_are_refused),
        cmocka_unit_test(a_nan_is_refused),
        cmocka_unit_test(many_regions_get_their_own),
    };
    char filter[256];
    const char *only = getenv("ONLY");
    snprintf(filter, sizeof filter, "*%s*", only ? only : "");
    cmocka_set_test_filter(filter);
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
