/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A folder of a test program's own: made before its tests or before each, removed behind them. Readers may put
 * there what they convert on the way.
 */
#ifndef KR_TEST_FOLDER_H
#define KR_TEST_FOLDER_H

#include "base/memory.h"
#include "test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static char folder[sizeof "/tmp/kirsch-test-XXXXXX"];

static inline int make_folder(void **unused) {
    (void)unused;
    strcpy(folder, "/tmp/kirsch-test-XXXXXX");
    return !mkdtemp(folder);
}

/** A shell script in the folder, to stand in for a program; its path is owned by the caller. */
static inline char *make_program(const char *name, const char *body) {
    char *path = kr_text("%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "#!/bin/sh\n%s\n", body);
    fclose(file);
    assert_int_equal(chmod(path, 0755), 0);
    return path;
}

static inline int remove_folder(void **unused) {
    char *command = kr_text("rm -rf %s", folder);
    (void)unused;
    int failed = system(command);
    kr_free(command);
    return failed;
}

#endif
