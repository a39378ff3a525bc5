/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What every C test needs: cmocka, the filter ONLY, and checks that print got, wanted, tolerance.
 */
#ifndef KR_TEST_H
#define KR_TEST_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>
#include <omp.h>

#include "base/memory.h"

/** |got - wanted| <= tolerance, else fail with all three. */
#define kr_check_near(got, wanted, tolerance)                                                      \
    kr_check_near_at((got), (wanted), (tolerance), #got, __FILE__, __LINE__)

static inline void kr_check_near_at(double got, double wanted, double tolerance, const char *what,
                                    const char *file, int line) {
    if (!(fabs(got - wanted) <= tolerance)) {
        print_error("%s: got %.17g, wanted %.17g, off by %.3g, tolerance %.3g\n", what, got, wanted,
                    fabs(got - wanted), tolerance);
        _fail(file, line);
    }
}

/** A figure worth seeing in the test's output even when it passes. */
#define kr_figure(...) (printf("# figure "), printf(__VA_ARGS__), printf("\n"))

/** Run `body` in a child; check that it ends with `code` and that its messages contain `text`. */
static inline void kr_check_stops(void (*body)(void *), void *argument, int code,
                                  const char *text) {
    int pipe_ends[2];
    char said[16384];
    size_t got = 0;
    ssize_t more;
    int status;
    fflush(NULL);
    assert_int_equal(pipe(pipe_ends), 0);
    pid_t child = fork();
    if (child == 0) {
        dup2(pipe_ends[1], 2);
        dup2(pipe_ends[1], 1);
        close(pipe_ends[0]);
        omp_set_num_threads(
            1); /* a fork leaves the pool's threads behind: waiting for them hangs */
        body(argument);
        _exit(0);
    }
    close(pipe_ends[1]);
    while (got < sizeof said - 1 &&
           (more = read(pipe_ends[0], said + got, sizeof said - 1 - got)) > 0)
        got += (size_t)more;
    said[got] = 0;
    close(pipe_ends[0]);
    waitpid(child, &status, 0);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != code || !strstr(said, text))
        fail_msg("ended with %s %d, wanted exit %d; said:\n%s\nwanted to find:\n%s",
                 WIFEXITED(status) ? "exit" : "signal",
                 WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status), code, said, text);
}

/** Run a group of tests, those whose name contains $ONLY; at the end no array may be left. */
#define kr_run_tests(tests)                                                                        \
    do {                                                                                           \
        char filter[256];                                                                          \
        const char *only = getenv("ONLY");                                                         \
        snprintf(filter, sizeof filter, "*%s*", only ? only : "");                                 \
        cmocka_set_test_filter(filter);                                                            \
        int failed = cmocka_run_group_tests(tests, NULL, NULL);                                    \
        if (!failed && kr_memory_outstanding())                                                    \
            print_error("%zu arrays are left\n", kr_memory_outstanding());                         \
        return failed ? failed : kr_memory_outstanding() > 0;                                      \
    } while (0)

#endif
