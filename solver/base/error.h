/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Two kinds of trouble, two words.
 *   kr_stop    what the user can cure: one sentence (what, where, found, expected, cure), then the
 *              exit code of its kind. It never returns, so no error codes travel through kernels.
 *   kr_assert  our own mistake: names the broken condition and aborts. Never used on input.
 */
#ifndef KR_ERROR_H
#define KR_ERROR_H

/** Exit codes by kind; documented in docs/formats.md. */
enum kr_exit {
    KR_EXIT_OK = 0,
    KR_EXIT_INPUT = 2,    /* deck, mesh, node file or arguments */
    KR_EXIT_STORAGE = 3,  /* a file cannot be written or read back */
    KR_EXIT_NUMBERS = 4,  /* NaN, an energy explosion, no convergence */
    KR_EXIT_LIBRARY = 5,  /* gmsh, ffmpeg, ... failed or is missing */
    KR_EXIT_MEMORY = 6,   /* not enough memory */
    KR_EXIT_SIGNAL = 7,   /* stopped by a signal or a time limit; can be resumed */
};

/** Name that begins every message; the program's own, "kirsch" until set. Kept, not copied. */
void kr_error_program(const char *name);

/** Print "program: sentence" on stderr and exit with the code. */
_Noreturn void kr_stop(enum kr_exit code, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/** Print "program: warning: sentence" on stderr and go on. */
void kr_warn(const char *format, ...) __attribute__((format(printf, 1, 2)));

/** Print a line of ordinary report on stdout, flushed at once. */
void kr_say(const char *format, ...) __attribute__((format(printf, 1, 2)));

_Noreturn void kr_assert_failed(const char *condition, const char *file, int line);

#define kr_assert(condition)                                                                       \
    ((condition) ? (void)0 : kr_assert_failed(#condition, __FILE__, __LINE__))

#endif
