/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Gathering the parts of a mesh. See gather.h.
 */
#include "gather.h"

#include "base/error.h"
#include "base/memory.h"
#include "cell.h"

#include <stdlib.h>
#include <string.h>

/* ---- what readers add ---- */

void kr_gather_expect_nodes(struct kr_gather *gather, size_t count) {
    size_t room = gather->n_nodes + count;
    if (room <= gather->nodes_room || room <= gather->points_room)
        return;
    gather->nodes_room = gather->points_room = room;
    gather->node = kr_realloc(gather->node, room, sizeof *gather->node);
    gather->point = kr_realloc(gather->point, 3 * room, sizeof *gather->point);
}

static void set_pile_room(struct kr_pile *pile, size_t room) {
    pile->room = room;
    pile->tag = kr_realloc(pile->tag, pile->room, sizeof *pile->tag);
    pile->type = kr_realloc(pile->type, pile->room, sizeof *pile->type);
    pile->first = kr_realloc(pile->first, pile->room, sizeof *pile->first);
}

void kr_gather_expect_elements(struct kr_gather *gather, int type, size_t count) {
    const struct kr_element *kind = kr_element(type);
    struct kr_pile *pile = &gather->pile[kind->dim];
    if (pile->count + count > pile->room)
        set_pile_room(pile, pile->count + count);
    if (pile->n_nodes + kind->nodes * count > pile->nodes_room) {
        pile->nodes_room = pile->n_nodes + kind->nodes * count;
        pile->node = kr_realloc(pile->node, pile->nodes_room, sizeof *pile->node);
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

/* ---- nodes: from numbers to places ---- */

static int by_tag(const void *a, const void *b) {
    size_t p = ((const struct kr_gather_node *)a)->tag, q = ((const struct kr_gather_node *)b)->tag;
    return (p > q) - (p < q);
}

static void sort_nodes(struct kr_gather *gather) {
    struct kr_gather_node *node = gather->node;
    size_t k = 1;
    while (k < gather->n_nodes && node[k].tag > node[k - 1].tag)
        k++;
    if (k < gather->n_nodes)
        qsort(node, gather->n_nodes, sizeof *node, by_tag);
    for (k = 1; k < gather->n_nodes; k++)
        if (node[k].tag == node[k - 1].tag)
            kr_stop(KR_EXIT_INPUT, "%s: node %zu stands twice in the file", gather->path,
                    node[k].tag);
}

/** Place of a node: at once where the numbers have no gaps, else by halving. */
static size_t place_of(const struct kr_gather *gather, size_t tag) {
    const struct kr_gather_node *node = gather->node;
    size_t low = 0, high = gather->n_nodes;
    if (high && tag >= node[0].tag && tag - node[0].tag < high && node[tag - node[0].tag].tag == tag)
        return node[tag - node[0].tag].place;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (node[middle].tag == tag)
            return node[middle].place;
        if (node[middle].tag < tag)
            low = middle + 1;
        else
            high = middle;
    }
    kr_stop(KR_EXIT_INPUT, "%s: an element has node %zu, which %s does not hold", gather->path, tag,
            "$Nodes");
}

/* ---- elements: order, and those that stand twice ---- */

struct numbered {
    size_t tag, at;
};

static int by_number(const void *a, const void *b) {
    const struct numbered *p = a, *q = b;
    if (p->tag != q->tag)
        return p->tag < q->tag ? -1 : 1;
    return (p->at > q->at) - (p->at < q->at);
}

/** The order of a pile by ascending numbers; stops where one stands twice. */
static size_t *order_of(const struct kr_gather *gather, const struct kr_pile *pile) {
    size_t *order = KR_NEW(size_t, pile->count), k = 1;
    for (size_t i = 0; i < pile->count; i++)
        order[i] = i;
    while (k < pile->count && pile->tag[k] > pile->tag[k - 1])
        k++;
    if (k >= pile->count)
        return order;
    struct numbered *item = KR_NEW(struct numbered, pile->count);
    for (size_t i = 0; i < pile->count; i++)
        item[i] = (struct numbered){pile->tag[i], i};
    qsort(item, pile->count, sizeof *item, by_number);
    for (k = 0; k < pile->count; k++) {
        if (k && item[k].tag == item[k - 1].tag)
            kr_stop(KR_EXIT_INPUT, "%s: element %zu stands twice in the file", gather->path,
                    item[k].tag);
        order[k] = item[k].at;
    }
    kr_free(item);
    return order;
}

static int is_same(const struct kr_pile *pile, size_t a, size_t b) {
    return pile->type[a] == pile->type[b] &&
           !memcmp(pile->node + pile->first[a], pile->node + pile->first[b],
                   kr_element(pile->type[a])->nodes * sizeof *pile->node);
}

/** Whether two elements are in a group together: then they are no copies but a fault. */
static int share_group(const size_t *group_of, size_t a, size_t b) {
    return group_of[a] == group_of[b];
}

/** For each element the first one with the same nodes, which stands for it: itself as a rule. An
 *  element in two groups is written once a group by MSH 2.2. */
static size_t *merge(const struct kr_gather *gather, int dim) {
    const struct kr_pile *pile = &gather->pile[dim];
    size_t *stands = KR_NEW(size_t, pile->count);
    for (size_t k = 0; k < pile->count; k++)
        stands[k] = k;
    if (!gather->merges)
        return stands;
    size_t *group_of = KR_NEW(size_t, pile->count);
    size_t *next = KR_NEW(size_t, pile->count), *head = KR_NEW(size_t, gather->n_nodes);
    for (size_t g = 0; g < gather->n_groups; g++)
        for (size_t k = 0; gather->group[g].dim == dim && k < gather->group[g].count; k++)
            group_of[gather->group[g].member[k]] = g + 1;
    for (size_t k = 0; k < pile->count; k++) {
        size_t *at = &head[pile->node[pile->first[k]]], other = *at;
        while (other && (!is_same(pile, other - 1, k) || share_group(group_of, other - 1, k)))
            other = next[other - 1];
        if (other)
            stands[k] = stands[other - 1];
        next[k] = *at;
        *at = k + 1;
    }
    kr_free(head);
    kr_free(next);
    kr_free(group_of);
    return stands;
}

/* ---- the mesh ---- */

/** Where the elements of a pile went: the first item of the mesh, and how many. */
struct laid {
    size_t *first, *count; /* (pile) */
};

static void drop_laid(struct laid *laid) {
    kr_free(laid->first);
    kr_free(laid->count);
}

/** Vertices of a cell into the mesh; polygons counter-clockwise. */
static size_t lay_cell(const struct kr_mesh *mesh, const struct kr_pile *pile, size_t k,
                       size_t *vertex) {
    const struct kr_element *kind = kr_element(pile->type[k]);
    const size_t *node = pile->node + pile->first[k];
    double corner[2 * KR_MOST_FACE], centroid[2];
    for (size_t v = 0; v < kind->kept; v++)
        vertex[v] = node[kind->keep[v]];
    if (kind->dim == 3)
        return kind->kept;
    for (size_t v = 0; v < kind->kept; v++)
        memcpy(corner + 2 * v, mesh->point + 3 * vertex[v], 2 * sizeof *corner);
    if (kr_cell_polygon(kind->kept, corner, centroid) < 0)
        for (size_t v = 0; v < kind->kept; v++)
            vertex[v] = node[kind->keep[kind->kept - 1 - v]];
    return kind->kept;
}

static struct laid lay_cells(const struct kr_gather *gather, struct kr_mesh *mesh) {
    const struct kr_pile *pile = &gather->pile[mesh->dim];
    size_t *order = order_of(gather, pile), *stands = merge(gather, mesh->dim);
    struct laid laid = {KR_NEW(size_t, pile->count), KR_NEW(size_t, pile->count)};
    mesh->first = kr_realloc(mesh->first, pile->count + 1, sizeof *mesh->first);
    mesh->vertex = KR_NEW(size_t, pile->n_nodes);
    mesh->cell_tag = KR_NEW(int64_t, pile->count);
    for (size_t k = 0; k < pile->count; k++) {
        size_t e = order[k], c = mesh->n_cells;
        if (stands[e] != e)
            continue;
        laid.first[e] = c;
        mesh->cell_tag[c] = (int64_t)pile->tag[e];
        mesh->first[c + 1] =
            mesh->first[c] + lay_cell(mesh, pile, e, mesh->vertex + mesh->first[c]);
        mesh->n_cells++;
    }
    for (size_t k = 0; k < pile->count; k++) {
        laid.first[k] = laid.first[stands[k]];
        laid.count[k] = 1;
    }
    kr_free(order);
    kr_free(stands);
    return laid;
}

/** Lay one facet; returns how many it made: a line with a node in its middle is two edges. */
static size_t lay_facet(struct kr_mesh *mesh, const struct kr_pile *pile, size_t k) {
    const struct kr_element *kind = kr_element(pile->type[k]);
    const size_t *node = pile->node + pile->first[k];
    if (kind->dim == 1) {
        for (size_t v = 0; v + 1 < kind->kept; v++) {
            mesh->edge[2 * mesh->n_edges] = node[kind->keep[v]];
            mesh->edge[2 * mesh->n_edges + 1] = node[kind->keep[v + 1]];
            mesh->n_edges++;
        }
        return kind->kept - 1;
    }
    size_t *face = mesh->face + mesh->face_first[mesh->n_faces];
    for (size_t v = 0; v < kind->kept; v++)
        face[v] = node[kind->keep[v]];
    mesh->n_faces++;
    mesh->face_first[mesh->n_faces] = mesh->face_first[mesh->n_faces - 1] + kind->kept;
    return 1;
}

static struct laid lay_facets(const struct kr_gather *gather, struct kr_mesh *mesh) {
    int dim = mesh->dim - 1;
    const struct kr_pile *pile = &gather->pile[dim];
    size_t *order = order_of(gather, pile), *stands = merge(gather, dim);
    struct laid laid = {KR_NEW(size_t, pile->count), KR_NEW(size_t, pile->count)};
    unsigned char *is_used = KR_NEW(unsigned char, pile->count);
    for (size_t g = 0; g < gather->n_groups; g++)
        for (size_t k = 0; gather->group[g].dim == dim && k < gather->group[g].count; k++)
            is_used[stands[gather->group[g].member[k]]] = 1;
    if (dim == 1) {
        mesh->edge = KR_NEW(size_t, 2 * pile->n_nodes);
    } else {
        mesh->face_first = KR_NEW(size_t, pile->count + 1);
        mesh->face = KR_NEW(size_t, pile->n_nodes);
    }
    for (size_t k = 0; k < pile->count; k++) {
        size_t e = order[k];
        if (stands[e] != e || !is_used[e])
            continue;
        laid.first[e] = dim == 1 ? mesh->n_edges : mesh->n_faces;
        laid.count[e] = lay_facet(mesh, pile, e);
    }
    for (size_t k = 0; k < pile->count; k++) {
        laid.first[k] = laid.first[stands[k]];
        laid.count[k] = laid.count[stands[k]];
    }
    kr_free(order);
    kr_free(stands);
    kr_free(is_used);
    return laid;
}

static int ascending(const void *a, const void *b) {
    size_t p = *(const size_t *)a, q = *(const size_t *)b;
    return (p > q) - (p < q);
}

/** Sort and drop what stands twice: an element may be named twice, a point by many elements. */
static void tidy(struct kr_mesh_group *group) {
    size_t kept = 0, k = 1;
    while (k < group->count && group->member[k] > group->member[k - 1])
        k++;
    if (k >= group->count)
        return;
    qsort(group->member, group->count, sizeof *group->member, ascending);
    for (k = 0; k < group->count; k++)
        if (!kept || group->member[k] != group->member[kept - 1])
            group->member[kept++] = group->member[k];
    group->count = kept;
}

/** Members of a group of cells or facets: from places in the pile to those in the mesh. */
static void lay_members(struct kr_mesh_group *group, const struct laid *laid) {
    size_t total = 0, n = 0;
    for (size_t k = 0; k < group->count; k++)
        total += laid->count[group->member[k]];
    size_t *member = KR_NEW(size_t, total);
    for (size_t k = 0; k < group->count; k++)
        for (size_t i = 0; i < laid->count[group->member[k]]; i++)
            member[n++] = laid->first[group->member[k]] + i;
    kr_free(group->member);
    group->member = member;
    group->count = total;
}

/** Members of a group of lower dimension: the points of its elements. */
static void lay_points(const struct kr_pile *pile, struct kr_mesh_group *group) {
    size_t total = 0, n = 0;
    for (size_t k = 0; k < group->count; k++)
        total += kr_element(pile->type[group->member[k]])->nodes;
    size_t *member = KR_NEW(size_t, total);
    for (size_t k = 0; k < group->count; k++) {
        size_t e = group->member[k];
        for (size_t v = 0; v < kr_element(pile->type[e])->nodes; v++)
            member[n++] = pile->node[pile->first[e] + v];
    }
    kr_free(group->member);
    group->member = member;
    group->count = total;
    group->dim = 0;
}

/** Groups without a name are called after their number, and stand behind the others. */
static void lay_groups(struct kr_gather *gather, struct kr_mesh *mesh, const struct laid *cells,
                       const struct laid *facets) {
    mesh->group = KR_NEW(struct kr_mesh_group, gather->n_groups);
    for (int pass = 0; pass < 2; pass++)
        for (size_t g = 0; g < gather->n_groups; g++) {
            struct kr_mesh_group group = gather->group[g];
            if ((group.name == NULL) != pass)
                continue;
            if (group.dim > mesh->dim) { /* a name for what the file does not hold */
                kr_free(group.name);
                continue;
            }
            if (!group.name)
                group.name = kr_text("group_%d", group.tag);
            if (group.dim >= mesh->dim - 1)
                lay_members(&group, group.dim == mesh->dim ? cells : facets);
            else
                lay_points(&gather->pile[group.dim], &group);
            tidy(&group);
            mesh->group[mesh->n_groups++] = group;
        }
}

static void free_gather(struct kr_gather *gather) {
    kr_free(gather->node);
    kr_free(gather->point);
    for (int dim = 0; dim < 4; dim++) {
        kr_free(gather->pile[dim].tag);
        kr_free(gather->pile[dim].type);
        kr_free(gather->pile[dim].first);
        kr_free(gather->pile[dim].node);
    }
    kr_free(gather->group);
    kr_free(gather->group_room);
    *gather = (struct kr_gather){0};
}

/** Take out points that are no vertex of anything but stood inside an element of the file, such as
 *  the ninth node of a quadrilateral: they have done their duty. */
static void drop_inner_points(const struct kr_gather *gather, struct kr_mesh *mesh) {
    const struct kr_pile *pile = &gather->pile[mesh->dim];
    unsigned char *is_inner = KR_NEW(unsigned char, mesh->n_points);
    size_t inner = 0;
    for (size_t k = 0; k < pile->count; k++) {
        const struct kr_element *kind = kr_element(pile->type[k]);
        for (size_t v = 0; v < kind->nodes; v++)
            is_inner[pile->node[pile->first[k] + v]] = kind->kept < kind->nodes;
    }
    for (size_t k = 0; k < mesh->first[mesh->n_cells]; k++)
        is_inner[mesh->vertex[k]] = 0;
    for (size_t p = 0; p < mesh->n_points; p++)
        inner += is_inner[p];
    if (inner)
        kr_mesh_drop_points(mesh, is_inner);
    kr_free(is_inner);
}

struct kr_mesh *kr_gather_finish(struct kr_gather *gather) {
    struct kr_mesh *mesh = kr_mesh_create();
    mesh->dim = gather->pile[3].count ? 3 : 2;
    if (!gather->pile[mesh->dim].count)
        kr_stop(KR_EXIT_INPUT,
                "%s holds no triangles, no quadrilaterals and no solids; if the mesh has "
                "physical groups, its surface or volume must be in one",
                gather->path);
    sort_nodes(gather);
    for (int dim = 0; dim < 4; dim++)
        for (size_t k = 0; k < gather->pile[dim].n_nodes; k++)
            gather->pile[dim].node[k] = place_of(gather, gather->pile[dim].node[k]);
    mesh->n_points = gather->n_nodes;
    mesh->point = gather->point;
    mesh->point_tag = KR_NEW(int64_t, mesh->n_points);
    for (size_t k = 0; k < gather->n_nodes; k++)
        mesh->point_tag[gather->node[k].place] = (int64_t)gather->node[k].tag;
    gather->point = NULL;
    struct laid cells = lay_cells(gather, mesh), facets = lay_facets(gather, mesh);
    lay_groups(gather, mesh, &cells, &facets);
    drop_laid(&cells);
    drop_laid(&facets);
    drop_inner_points(gather, mesh);
    free_gather(gather);
    kr_mesh_resolve_points(mesh);
    return mesh;
}
