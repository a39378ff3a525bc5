/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Messages and stops. See error.h for which word to use when.
 */
#include "base/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

static const char *program = "kirsch";

void kr_error_program(const char *name) {
    program = name;
}

void kr_stop(enum kr_exit code, const char *format, ...) {
    va_list arguments;
    fflush(stdout);
    fprintf(stderr, "%s: ", program);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
    exit(code);
}

void kr_warn(const char *format, ...) {
    va_list arguments;
    fflush(stdout);
    fprintf(stderr, "%s: warning: ", program);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
}

void kr_say(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vprintf(format, arguments);
    va_end(arguments);
    putchar('\n');
    fflush(stdout);
}

void kr_assert_failed(const char *condition, const char *file, int line) {
    fflush(stdout);
    fprintf(stderr, "%s: a fault of Kirsch itself at %s:%d: expected %s. Please report it.\n",
            program, file, line, condition);
    abort();
}
