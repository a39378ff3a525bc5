/* SPDX-License-Identifier: BSD-3-Clause
 *
 * nodes.dat. See nodes_dat.h.
 */
#include "nodes_dat.h"

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "convert.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct line {
    long long id;
    double value[3]; /* area, x, y */
};

static int is_blank(const char *text) {
    while (isspace((unsigned char)*text))
        text++;
    return !*text || *text == '#';
}

/* One number of a line; moves on. Returns 0 if there is none. */
static int read_number(const char **text, double *value) {
    char *end;
    *value = strtod(*text, &end);
    int found = end != *text && isfinite(*value);
    *text = end;
    return found;
}

static struct line read_line(const char *path, size_t number, const char *text) {
    static const char *const what[] = {"an area in m^2", "x in m", "y in m"};
    struct line line;
    char *end;
    const char *at;
    line.id = strtoll(text, &end, 10);
    if (end == text || !isspace((unsigned char)*end))
        kr_stop(KR_EXIT_INPUT, "%s:%zu: found '%.40s', expected a node number, then area, x and y",
                path, number, text);
    at = end;
    for (int k = 0; k < 3; k++)
        if (!read_number(&at, &line.value[k]))
            kr_stop(KR_EXIT_INPUT, "%s:%zu: expected %s (`id area x y`), found '%.40s'", path, number,
                    what[k], at);
    if (!is_blank(at))
        kr_stop(KR_EXIT_INPUT, "%s:%zu: found '%.40s' behind y; expected `id area x y` alone", path,
                number, at);
    if (!(line.value[0] > 0))
        kr_stop(KR_EXIT_INPUT, "%s:%zu: node %lld has the area %g; expected a positive one", path,
                number, line.id, line.value[0]);
    return line;
}

static struct line *read_lines(const char *path, size_t *count) {
    char text[512];
    size_t number = 0, room = 0;
    struct line *lines = NULL;
    FILE *file = fopen(path, "r");
    if (!file)
        kr_stop(KR_EXIT_INPUT, "%s: cannot be read: %s", path, strerror(errno));
    *count = 0;
    while (fgets(text, sizeof text, file)) {
        number++;
        text[strcspn(text, "\r\n")] = 0;
        if (is_blank(text))
            continue;
        KR_GROW(lines, *count, room);
        lines[(*count)++] = read_line(path, number, text);
    }
    fclose(file);
    if (!*count)
        kr_stop(KR_EXIT_INPUT, "%s: no nodes found; expected lines of `id area x y`", path);
    return lines;
}

struct kr_nodes *kr_nodes_dat_read(const char *path) {
    size_t count;
    struct line *lines = read_lines(path, &count);
    struct kr_nodes *nodes = kr_nodes_create(2, count);
    int64_t *all = KR_NEW(int64_t, count);
    for (size_t i = 0; i < count; i++) {
        nodes->tag[i] = lines[i].id;
        nodes->volume[i] = lines[i].value[0];
        nodes->position[2 * i] = lines[i].value[1];
        nodes->position[2 * i + 1] = lines[i].value[2];
        all[i] = (int64_t)i;
    }
    kr_free(lines);
    kr_nodes_add_set(nodes, "plate", count, all, 0);
    kr_convert_spacing(nodes);
    kr_convert_order(nodes);
    char *fault = kr_nodes_fault(nodes);
    if (fault)
        kr_stop(KR_EXIT_INPUT, "%s: %s", path, fault);
    return nodes;
}

void kr_nodes_dat_write(const struct kr_nodes *nodes, const char *path) {
    struct kr_file file = kr_file_begin(kr_text_copy(path));
    for (size_t i = 0; i < nodes->n; i++)
        fprintf(file.to, "%lld %.17g %.17g %.17g\n", (long long)nodes->tag[i], nodes->volume[i],
                nodes->position[2 * i], nodes->position[2 * i + 1]);
    kr_file_end(&file);
}
