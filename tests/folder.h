/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A folder of a test program's own: made before its tests, removed behind them. Readers may put there what they
 * convert on the way.
 */
#ifndef KR_TEST_FOLDER_H
#define KR_TEST_FOLDER_H

#include "base/memory.h"

#include <stdlib.h>

static char folder[] = "/tmp/kirsch-test-XXXXXX";

static inline int make_folder(void **unused) {
    (void)unused;
    return !mkdtemp(folder);
}

static inline int remove_folder(void **unused) {
    char *command = kr_text("rm -rf %s", folder);
    (void)unused;
    int failed = system(command);
    kr_free(command);
    return failed;
}

#endif
