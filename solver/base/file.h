/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Files and folders of results: files that are whole or not there, files that grow, folders. Nothing here
 * is written through a symbolic link, which might lead anywhere; the folder that a user names himself may be one.
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

/** Open a file that grows, behind its first so many bytes; 0: empty. Stops (exit 3) where that cannot be, the
 *  path is a link, or the file is shorter than that. */
FILE *kr_file_grow(const char *path, long bytes);

/** How long it is, all of it brought to the disk: a checkpoint counts on that. Stops (exit 3). */
long kr_file_settle(FILE *file, const char *path);

/** Make a folder and those above it, as far as they are not there. Stops (exit 3). */
void kr_folder_make(const char *path);

/** Make a folder within one of results; a link in its place stops (exit 3). */
void kr_folder_make_within(const char *path);

#endif
