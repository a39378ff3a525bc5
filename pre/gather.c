/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Gathering the parts of a mesh as they stand in the file. See gather.h; what becomes of them is in gather_mesh.c.
 */
#include "gather.h"

#include "base/memory.h"

#include <string.h>

/** The first room is not cleared: all of it is written, one item after the other. */
static void *make_room(void *array, size_t count, size_t size) {
    return array ? kr_realloc(array, count, size) : kr_alloc_raw(count, size);
}

void kr_gather_expect_nodes(struct kr_gather *gather, size_t count) {
    size_t room = gather->n_nodes + count;
    if (room <= gather->nodes_room || room <= gather->points_room)
        return;
    gather->nodes_room = gather->points_room = room;
    gather->node = make_room(gather->node, room, sizeof *gather->node);
    gather->point = make_room(gather->point, 3 * room, sizeof *gather->point);
}

static void set_pile_room(struct kr_pile *pile, size_t room) {
    pile->room = room;
    pile->tag = make_room(pile->tag, pile->room, sizeof *pile->tag);
    pile->type = make_room(pile->type, pile->room, sizeof *pile->type);
    pile->first = make_room(pile->first, pile->room, sizeof *pile->first);
}

void kr_gather_expect_elements(struct kr_gather *gather, int type, size_t count) {
    const struct kr_element *kind = kr_element(type);
    struct kr_pile *pile = &gather->pile[kind->dim];
    if (pile->count + count > pile->room)
        set_pile_room(pile, pile->count + count);
    if (pile->n_nodes + kind->nodes * count > pile->nodes_room) {
        pile->nodes_room = pile->n_nodes + kind->nodes * count;
        pile->node = make_room(pile->node, pile->nodes_room, sizeof *pile->node);
    }
}

void kr_gather_node(struct kr_gather *gather, size_t tag, const double point[3]) {
    if (gather->n_nodes == gather->points_room) {
        gather->points_room = gather->points_room ? 2 * gather->points_room : 64;
        gather->point = kr_realloc(gather->point, 3 * gather->points_room, sizeof(double));
    }
    KR_GROW(gather->node, gather->n_nodes, gather->nodes_room);
    gather->node[gather->n_nodes] = (struct kr_gather_node){tag, gather->n_nodes};
    memcpy(gather->point + 3 * gather->n_nodes, point, 3 * sizeof *point);
    gather->n_nodes++;
}

size_t kr_gather_element(struct kr_gather *gather, int type, size_t tag, const size_t *node) {
    const struct kr_element *kind = kr_element(type);
    struct kr_pile *pile = &gather->pile[kind->dim];
    if (pile->count == pile->room)
        set_pile_room(pile, pile->room ? 2 * pile->room : 64);
    if (pile->n_nodes + kind->nodes > pile->nodes_room) {
        pile->nodes_room = 2 * pile->nodes_room + 256;
        pile->node = kr_realloc(pile->node, pile->nodes_room, sizeof *pile->node);
    }
    pile->tag[pile->count] = tag;
    pile->type[pile->count] = (unsigned char)type;
    pile->first[pile->count] = pile->n_nodes;
    memcpy(pile->node + pile->n_nodes, node, kind->nodes * sizeof *node);
    pile->n_nodes += kind->nodes;
    return pile->count++;
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

void kr_gather_member(struct kr_gather *gather, size_t group, size_t element) {
    struct kr_mesh_group *g = &gather->group[group];
    KR_GROW(g->member, g->count, gather->group_room[group]);
    g->member[g->count++] = element;
}
