/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Lines of words in text files of nodes and node sets, without comments and empty lines.
 */
#ifndef KR_POINT_LINES_H
#define KR_POINT_LINES_H

#include <stdio.h>

/** What stands between two words. */
#define KR_POINT_BETWEEN " \t,;\r\n"

struct kr_point_lines {
    const char *path; /* not owned */
    size_t number;    /* of the line, from 1 */
    FILE *file;
    char *line;
    size_t room;
};

/** Stops (exit 2) where the file cannot be read. */
struct kr_point_lines kr_point_lines_open(const char *path);

/** The next line that holds something, without its comment, to be changed at will until the next call; NULL at the
 *  end. Stops (exit 2) where the file is no text. */
char *kr_point_lines_next(struct kr_point_lines *lines);

void kr_point_lines_close(struct kr_point_lines *lines);

/** Whether a line begins with a name, not a number. */
int kr_point_lines_is_names(const char *line);

#endif
