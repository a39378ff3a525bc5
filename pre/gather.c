/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Gathering the parts of a mesh as they stand in the file. See gather.h; what becomes of them is in gather_mesh.c.
 */
#include "gather.h"

#include "base/memory.h"

#include <string.h>

/** Give an array of `*room` items room for `needed`: just that at first, which need not be cleared because all of
 *  it is written, later twice of what there was at least. */
static void *make_room(void *array, size_t *room, size_t needed, size_t size) {
    if (needed <= *room)
        return array;
    *room = needed > 2 * *room ? needed : 2 * *room;
    return array ? kr_realloc(array, *room, size) : kr_alloc_raw(*room, size);
}

void kr_gather_expect_nodes(struct kr_gather *gather, size_t count) {
    size_t room = gather->nodes_room, needed = gather->n_nodes + count;
    gather->node_tag = make_room(gather->node_tag, &room, needed, sizeof *gather->node_tag);
    gather->point = make_room(gather->point, &gather->nodes_room, needed, 3 * sizeof *gather->point);
}

size_t kr_gather_nodes(struct kr_gather *gather, size_t count) {
    kr_gather_expect_nodes(gather, count);
    gather->n_nodes += count;
    return gather->n_nodes - count;
}

static void expect(struct kr_pile *pile, const struct kr_element *kind, size_t count) {
    pile->tag = make_room(pile->tag, &pile->room, pile->count + count, sizeof *pile->tag);
    pile->node = make_room(pile->node, &pile->nodes_room, pile->n_nodes + kind->nodes * count, sizeof *pile->node);
}

void kr_gather_expect_elements(struct kr_gather *gather, int type, size_t count) {
    const struct kr_element *kind = kr_element(type);
    expect(&gather->pile[kind->dim], kind, count);
}

size_t kr_gather_elements(struct kr_gather *gather, int type, size_t count, const size_t *row) {
    const struct kr_element *kind = kr_element(type);
    struct kr_pile *pile = &gather->pile[kind->dim];
    const size_t nodes = kind->nodes;
    if (!pile->n_runs || pile->run[pile->n_runs - 1].kind != kind) {
        KR_GROW(pile->run, pile->n_runs, pile->runs_room);
        pile->run[pile->n_runs++] = (struct kr_run){kind, pile->count, pile->n_nodes};
    }
    expect(pile, kind, count);
    size_t *tag = pile->tag + pile->count, *node = pile->node + pile->n_nodes;
    for (size_t k = 0; k < count; k++, row += nodes + 1, node += nodes) {
        tag[k] = row[0];
        for (size_t v = 0; v < nodes; v++)
            node[v] = row[1 + v];
    }
    pile->count += count;
    pile->n_nodes += nodes * count;
    return pile->count - count;
}

const struct kr_element *kr_pile_element(const struct kr_pile *pile, size_t k, const size_t **node) {
    size_t low = 0, high = pile->n_runs;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (pile->run[middle].element <= k)
            low = middle;
        else
            high = middle;
    }
    const struct kr_run *run = &pile->run[low];
    *node = pile->node + run->node + (k - run->element) * run->kind->nodes;
    return run->kind;
}

size_t kr_gather_group(struct kr_gather *gather, int dim, int tag) {
    for (size_t g = 0; g < gather->n_groups; g++)
        if (gather->group[g].dim == dim && gather->group[g].tag == tag)
            return g;
    if (gather->n_groups == gather->groups_room) {
        gather->groups_room = gather->groups_room ? 2 * gather->groups_room : 16;
        gather->group = kr_realloc(gather->group, gather->groups_room, sizeof *gather->group);
        gather->group_room = kr_realloc(gather->group_room, gather->groups_room, sizeof(size_t));
    }
    gather->group[gather->n_groups] = (struct kr_mesh_group){NULL, dim, tag, 0, NULL};
    gather->group_room[gather->n_groups] = 0;
    return gather->n_groups++;
}

void kr_gather_name(struct kr_gather *gather, size_t group, const char *name) {
    if (!gather->group[group].name)
        gather->group[group].name = kr_text_copy(name);
}

void kr_gather_members(struct kr_gather *gather, size_t group, size_t first, size_t count) {
    struct kr_mesh_group *g = &gather->group[group];
    g->member = make_room(g->member, &gather->group_room[group], g->count + count, sizeof *g->member);
    for (size_t k = 0; k < count; k++)
        g->member[g->count + k] = first + k;
    g->count += count;
}
