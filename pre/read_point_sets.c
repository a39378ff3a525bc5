/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Reading node sets, lists of numbers in files of their own. See points.h.
 */
#include "points.h"

#include "base/error.h"
#include "base/memory.h"
#include "point_lines.h"

#include <stdlib.h>
#include <string.h>

struct numbered {
    int64_t tag, node;
};

static int by_tag(const void *p, const void *q) {
    const struct numbered *a = p, *b = q;
    return (a->tag > b->tag) - (a->tag < b->tag);
}

static int ascending(const void *p, const void *q) {
    int64_t a = *(const int64_t *)p, b = *(const int64_t *)q;
    return (a > b) - (a < b);
}

static struct numbered *nodes_by_tag(const struct kr_nodes *nodes) {
    struct numbered *item = KR_NEW(struct numbered, nodes->n);
    for (size_t i = 0; i < nodes->n; i++)
        item[i] = (struct numbered){nodes->tag[i], (int64_t)i};
    qsort(item, nodes->n, sizeof *item, by_tag);
    return item;
}

/** "left" of PATH/grid_ns_left.txt, nodelist_left.txt and left.txt; owned by the caller. */
static char *name_of_set(const char *path) {
    static const char *const before[] = {"_ns_", "ns_", "nodelist_", "nodeset_", "node_set_"};
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const char *inside = strstr(name, before[0]);
    if (inside)
        name = inside + strlen(before[0]);
    for (size_t k = 1; k < sizeof before / sizeof *before && !inside; k++)
        if (!strncmp(name, before[k], strlen(before[k])) && name[strlen(before[k])] != '.')
            inside = name += strlen(before[k]);
    return kr_text("%.*s", (int)strcspn(name, "."), name);
}

void kr_points_read_set(const char *path, struct kr_nodes *nodes) {
    struct kr_point_lines lines = kr_point_lines_open(path);
    struct numbered *known = nodes_by_tag(nodes), *hit;
    char *line, *word, *rest, *end;
    size_t count = 0, node_room = 0, kept = 0;
    int64_t *node = NULL;
    while ((line = kr_point_lines_next(&lines))) {
        if (kr_point_lines_is_names(line))
            continue; /* PeriLab's `header: global_id` */
        rest = NULL;
        for (word = strtok_r(line, KR_POINT_BETWEEN, &rest); word; word = strtok_r(NULL, KR_POINT_BETWEEN, &rest)) {
            struct numbered key = {strtoll(word, &end, 10), 0};
            hit = bsearch(&key, known, nodes->n, sizeof *known, by_tag);
            if (*end || !hit)
                kr_stop(KR_EXIT_INPUT, "%s:%zu: expected the number of a node, found '%.40s'", path,
                        lines.number, word);
            KR_GROW(node, count, node_room);
            node[count++] = hit->node;
        }
    }
    kr_point_lines_close(&lines);
    kr_free(known);
    if (!count)
        kr_stop(KR_EXIT_INPUT, "%s: no node numbers found", path);
    qsort(node, count, sizeof *node, ascending);
    for (size_t k = 0; k < count; k++)
        if (!kept || node[k] != node[kept - 1])
            node[kept++] = node[k];
    char *name = name_of_set(path);
    if (kr_nodes_set(nodes, name))
        kr_stop(KR_EXIT_INPUT, "%s: there is a set '%s' already; give the file another name", path,
                name);
    kr_nodes_add_set(nodes, name, kept, node, 0);
    kr_free(name);
}
