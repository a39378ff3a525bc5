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

/** Where the elements of a pile went: the first item of the mesh, and how many. NULL where each is one item, and
 *  all are in their places. */
struct laid {
    size_t *first, *count; /* (pile) */
};

/** The vertices of a cell of this kind; polygons counter-clockwise. `vertex` may be `node`. */
static void lay_cell(const double *point, const struct kr_element *kind, const size_t *node, size_t *vertex) {
    size_t kept[KR_MOST_NODES];
    double corner[2 * KR_MOST_NODES];
    for (size_t v = 0; v < kind->kept; v++)
        kept[v] = node[kind->keep[v]];
    for (size_t v = 0; v < kind->kept; v++) {
        vertex[v] = kept[v];
        corner[2 * v] = point[3 * kept[v]];
        corner[2 * v + 1] = point[3 * kept[v] + 1];
    }
    if (kind->dim == 2 && kr_cell_area(kind->kept, corner) < 0)
        for (size_t v = 0; v < kind->kept; v++)
            vertex[v] = kept[kind->kept - 1 - v];
}

/** Cells in the order of the file: their vertices take the place of their nodes. */
static void lay_in_place(struct kr_pile *pile, struct kr_mesh *mesh) {
    size_t n = 0;
    for (size_t r = 0; r < pile->n_runs; r++) {
        const struct kr_run *run = &pile->run[r];
        const struct kr_element *kind = run->kind;
        const size_t *node = pile->node + run->node;
        const size_t end = r + 1 < pile->n_runs ? run[1].element : pile->count;
        for (size_t k = run->element; k < end; k++, n += kind->kept, node += kind->nodes) {
            lay_cell(mesh->point, kind, node, pile->node + n);
            mesh->first[k + 1] = n + kind->kept;
        }
    }
    mesh->n_cells = pile->count;
    mesh->vertex = pile->node;
    mesh->cell_tag = (int64_t *)pile->tag; /* none is negative */
    pile->node = pile->tag = NULL;
}

/** Cells by their numbers, each once. */
static struct laid lay_in_order(const struct kr_pile *pile, struct kr_mesh *mesh, const size_t *order,
                                const size_t *stands) {
    struct laid laid = {KR_NEW_RAW(size_t, pile->count), NULL};
    mesh->vertex = KR_NEW_RAW(size_t, pile->n_nodes);
    mesh->cell_tag = KR_NEW_RAW(int64_t, pile->count);
    for (size_t k = 0; k < pile->count; k++) {
        size_t e = order ? order[k] : k, c = mesh->n_cells;
        const size_t *node;
        if (stands && stands[e] != e)
            continue;
        const struct kr_element *kind = kr_pile_element(pile, e, &node);
        lay_cell(mesh->point, kind, node, mesh->vertex + mesh->first[c]);
        laid.first[e] = c;
        mesh->cell_tag[c] = (int64_t)pile->tag[e];
        mesh->first[c + 1] = mesh->first[c] + kind->kept;
        mesh->n_cells++;
    }
    for (size_t k = 0; stands && k < pile->count; k++)
        laid.first[k] = laid.first[stands[k]];
    return laid;
}

static struct laid lay_cells(struct kr_gather *gather, struct kr_mesh *mesh) {
    struct kr_pile *pile = &gather->pile[mesh->dim];
    size_t *order = kr_gather_order(gather, pile), *stands = kr_gather_merge(gather, mesh->dim);
    struct laid laid = {NULL, NULL};
    kr_free(mesh->first);
    mesh->first = KR_NEW_RAW(size_t, pile->count + 1);
    mesh->first[0] = 0;
    if (order || stands)
        laid = lay_in_order(pile, mesh, order, stands);
    else
        lay_in_place(pile, mesh);
    kr_free(order);
    kr_free(stands);
    return laid;
}

/** Lay one facet; returns how many it made: a line with a node in its middle is two edges. */
static size_t lay_facet(struct kr_mesh *mesh, const struct kr_pile *pile, size_t k) {
    const size_t *node;
    const struct kr_element *kind = kr_pile_element(pile, k, &node);
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

/** Which facets are in a group, by those that stand for them. Owned by the caller. */
static unsigned char *find_used(const struct kr_gather *gather, int dim, const size_t *stands) {
    unsigned char *is_used = KR_NEW(unsigned char, gather->pile[dim].count);
    for (size_t g = 0; g < gather->n_groups; g++)
        for (size_t k = 0; gather->group[g].dim == dim && k < gather->group[g].count; k++) {
            size_t e = gather->group[g].member[k];
            is_used[stands ? stands[e] : e] = 1;
        }
    return is_used;
}

static struct laid lay_facets(const struct kr_gather *gather, struct kr_mesh *mesh) {
    int dim = mesh->dim - 1;
    const struct kr_pile *pile = &gather->pile[dim];
    size_t *order = kr_gather_order(gather, pile), *stands = kr_gather_merge(gather, dim);
    struct laid laid = {KR_NEW(size_t, pile->count), KR_NEW(size_t, pile->count)};
    unsigned char *is_used = find_used(gather, dim, stands);
    if (dim == 1) {
        mesh->edge = KR_NEW(size_t, 2 * pile->n_nodes);
    } else {
        mesh->face_first = KR_NEW(size_t, pile->count + 1);
        mesh->face = KR_NEW(size_t, pile->n_nodes);
    }
    for (size_t k = 0; k < pile->count; k++) {
        size_t e = order ? order[k] : k;
        if (!is_used[e]) /* and so are those for which another stands */
            continue;
        laid.first[e] = dim == 1 ? mesh->n_edges : mesh->n_faces;
        laid.count[e] = lay_facet(mesh, pile, e);
    }
    for (size_t k = 0; stands && k < pile->count; k++) {
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
    if (!laid->first)
        return;
    for (size_t k = 0; k < group->count; k++)
        total += laid->count ? laid->count[group->member[k]] : 1;
    size_t *member = KR_NEW_RAW(size_t, total);
    for (size_t k = 0; k < group->count; k++) {
        size_t e = group->member[k], count = laid->count ? laid->count[e] : 1;
        for (size_t i = 0; i < count; i++)
            member[n++] = laid->first[e] + i;
    }
    kr_free(group->member);
    group->member = member;
    group->count = total;
}

/** Members of a group of lower dimension: the points of its elements. */
static void lay_points(const struct kr_pile *pile, struct kr_mesh_group *group) {
    size_t total = 0, n = 0;
    const size_t *node;
    for (size_t k = 0; k < group->count; k++)
        total += kr_pile_element(pile, group->member[k], &node)->nodes;
    size_t *member = KR_NEW(size_t, total);
    for (size_t k = 0; k < group->count; k++) {
        size_t count = kr_pile_element(pile, group->member[k], &node)->nodes;
        for (size_t v = 0; v < count; v++)
            member[n++] = node[v];
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

/** The points (1) of cells that have nodes inside of faces or of themselves, such as the ninth node of a
 *  quadrilateral; NULL where there are no such cells. Owned by the caller. */
static unsigned char *find_inner_points(const struct kr_gather *gather, int dim) {
    const struct kr_pile *pile = &gather->pile[dim];
    unsigned char *is_inner = NULL;
    for (size_t r = 0; r < pile->n_runs; r++) {
        const struct kr_run *run = &pile->run[r];
        const size_t end = r + 1 < pile->n_runs ? run[1].node : pile->n_nodes;
        if (run->kind->kept == run->kind->nodes)
            continue;
        if (!is_inner)
            is_inner = KR_NEW(unsigned char, gather->n_nodes);
        for (size_t k = run->node; k < end; k++)
            is_inner[pile->node[k]] = 1;
    }
    return is_inner;
}

/** Take out those of them that are no vertex of anything: they have done their duty. */
static void drop_inner_points(unsigned char *is_inner, struct kr_mesh *mesh) {
    size_t inner = 0;
    if (!is_inner)
        return;
    for (size_t k = 0; k < mesh->first[mesh->n_cells]; k++)
        is_inner[mesh->vertex[k]] = 0;
    for (size_t p = 0; p < mesh->n_points; p++)
        inner += is_inner[p];
    if (inner)
        kr_mesh_drop_points(mesh, is_inner);
    kr_free(is_inner);
}

static void free_gather(struct kr_gather *gather) {
    for (int dim = 0; dim < 4; dim++) {
        kr_free(gather->pile[dim].tag);
        kr_free(gather->pile[dim].node);
        kr_free(gather->pile[dim].run);
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
    mesh->point_tag = (int64_t *)gather->node_tag; /* none is negative */
    unsigned char *is_inner = find_inner_points(gather, mesh->dim);
    struct laid cells = lay_cells(gather, mesh), facets = lay_facets(gather, mesh);
    lay_groups(gather, mesh, &cells, &facets);
    kr_free(cells.first);
    kr_free(facets.first);
    kr_free(facets.count);
    drop_inner_points(is_inner, mesh);
    free_gather(gather);
    kr_mesh_resolve_points(mesh);
    return mesh;
}
