/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From what was gathered to cells, facets and groups of a mesh. See gather.h.
 */
#include "base/error.h"
#include "base/memory.h"
#include "cell.h"
#include "gather_order.h"

#include <stdlib.h>
#include <string.h>

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
    double corner[2 * KR_MOST_FACE];
    for (size_t v = 0; v < kind->kept; v++)
        vertex[v] = node[kind->keep[v]];
    if (kind->dim == 3)
        return kind->kept;
    for (size_t v = 0; v < kind->kept; v++)
        memcpy(corner + 2 * v, mesh->point + 3 * vertex[v], 2 * sizeof *corner);
    if (kr_cell_area(kind->kept, corner) < 0)
        for (size_t v = 0; v < kind->kept; v++)
            vertex[v] = node[kind->keep[kind->kept - 1 - v]];
    return kind->kept;
}

static struct laid lay_cells(const struct kr_gather *gather, struct kr_mesh *mesh) {
    const struct kr_pile *pile = &gather->pile[mesh->dim];
    size_t *order = kr_gather_order(gather, pile), *stands = kr_gather_merge(gather, mesh->dim);
    struct laid laid = {KR_NEW(size_t, pile->count), KR_NEW(size_t, pile->count)};
    mesh->first = kr_realloc(mesh->first, pile->count + 1, sizeof *mesh->first);
    mesh->vertex = KR_NEW_RAW(size_t, pile->n_nodes);
    mesh->cell_tag = KR_NEW_RAW(int64_t, pile->count);
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
    size_t *order = kr_gather_order(gather, pile), *stands = kr_gather_merge(gather, dim);
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
    size_t *member = KR_NEW_RAW(size_t, total);
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

static int has_inner_points(const struct kr_pile *pile) {
    for (size_t k = 0; k < pile->count; k++)
        if (kr_element(pile->type[k])->kept < kr_element(pile->type[k])->nodes)
            return 1;
    return 0;
}

/** Take out points that are no vertex of anything but stood inside an element of the file, such as
 *  the ninth node of a quadrilateral: they have done their duty. */
static void drop_inner_points(const struct kr_gather *gather, struct kr_mesh *mesh) {
    const struct kr_pile *pile = &gather->pile[mesh->dim];
    size_t inner = 0;
    if (!has_inner_points(pile))
        return;
    unsigned char *is_inner = KR_NEW(unsigned char, mesh->n_points);
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

struct kr_mesh *kr_gather_finish(struct kr_gather *gather) {
    struct kr_mesh *mesh = kr_mesh_create();
    mesh->dim = gather->pile[3].count ? 3 : 2;
    if (!gather->pile[mesh->dim].count)
        kr_stop(KR_EXIT_INPUT,
                "%s holds no triangles, no quadrilaterals and no solids; if the mesh has "
                "physical groups, its surface or volume must be in one",
                gather->path);
    kr_gather_resolve(gather);
    mesh->n_points = gather->n_nodes;
    mesh->point = gather->point;
    mesh->point_tag = KR_NEW_RAW(int64_t, mesh->n_points);
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
