/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A text or binary file that appears under its name when it is whole, or not at all.
 */
#ifndef KR_FILE_H
#define KR_FILE_H

#include <stdio.h>

struct kr_file {
    char *path, *beside;
    FILE *to;
};

/** Begin PATH as PATH.tmp; takes over `path`. Stops (exit 3) where it cannot be written. */
struct kr_file kr_file_begin(char *path);

/** End it: it takes its name. Stops (exit 3) where anything of it could not be written. */
void kr_file_end(struct kr_file *file);

#endif
