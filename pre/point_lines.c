/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Lines of words. See point_lines.h.
 */
#include "point_lines.h"

#include "base/error.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/** Cut a comment off; whether anything is left. */
static int has_content(char *line) {
    line[strcspn(line, "#\r\n")] = 0;
    return line[strspn(line, KR_POINT_BETWEEN)] != 0;
}

int kr_point_lines_is_names(const char *line) {
    line += strspn(line, KR_POINT_BETWEEN);
    return isalpha((unsigned char)*line) && strncasecmp(line, "nan", 3) && strncasecmp(line, "inf", 3);
}

char *kr_point_lines_next(struct kr_point_lines *lines) {
    ssize_t length;
    while ((length = getline(&lines->line, &lines->room, lines->file)) >= 0) {
        lines->number++;
        if (strlen(lines->line) != (size_t)length) /* a zero byte is no text */
            kr_stop(KR_EXIT_INPUT, "%s:%zu: this is no text", lines->path, lines->number);
        if (has_content(lines->line))
            return lines->line;
    }
    return NULL;
}

struct kr_point_lines kr_point_lines_open(const char *path) {
    struct kr_point_lines lines = {.path = path, .file = fopen(path, "r")};
    if (!lines.file)
        kr_stop(KR_EXIT_INPUT, "%s: cannot be read: %s", path, strerror(errno));
    return lines;
}

void kr_point_lines_close(struct kr_point_lines *lines) {
    free(lines->line);
    fclose(lines->file);
    lines->line = NULL;
    lines->file = NULL;
}
