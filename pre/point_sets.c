/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Groups of points, as Abaqus, Exodus and others have them, become groups of boundary facets or of
 * cells. See kr_mesh_resolve_points in mesh.h for the rule.
 */
#include "mesh.h"

#include "base/error.h"
#include "base/memory.h"
#include "face.h"
#include "side.h"

#include <string.h>

/** The boundary of a body: rings of vertices, two to an edge. */
struct rim {
    size_t count, room, n_vertices, vertices_room;
    size_t *first, *vertex;
    unsigned char *is_on; /* (n_points) */
};

static void add_to_rim(struct rim *rim, size_t n, const size_t *vertex) {
    KR_GROW(rim->first, rim->count, rim->room);
    rim->first[rim->count++] = rim->n_vertices;
    for (size_t k = 0; k < n; k++) {
        KR_GROW(rim->vertex, rim->n_vertices, rim->vertices_room);
        rim->vertex[rim->n_vertices++] = vertex[k];
        rim->is_on[vertex[k]] = 1;
    }
}

static void add_sides(const struct kr_mesh *mesh, struct rim *rim) {
    struct kr_sides *sides =
        kr_sides_create(mesh->n_points, mesh->n_cells, mesh->first, mesh->vertex);
    for (size_t s = 0; s < sides->count; s++) {
        size_t end[2] = {sides->side[s].from, sides->side[s].to};
        if (end[0] != end[1] && kr_sides_find(sides, end[1], end[0], NULL) == 0)
            add_to_rim(rim, 2, end);
    }
    kr_sides_free(sides);
}

static void add_faces(const struct kr_mesh *mesh, struct rim *rim) {
    struct kr_faces *faces = kr_faces_create(mesh);
    size_t vertex[KR_MOST_FACE];
    for (size_t k = 0; k < faces->count; k++) {
        size_t n = kr_faces_vertices(faces, faces->face[k], vertex);
        if (kr_faces_match(faces, n, vertex).count == 1)
            add_to_rim(rim, n, vertex);
    }
    kr_faces_free(faces);
}

static struct rim rim_of(const struct kr_mesh *mesh) {
    struct rim rim = {.is_on = KR_NEW(unsigned char, mesh->n_points)};
    if (mesh->dim == 2)
        add_sides(mesh, &rim);
    else
        add_faces(mesh, &rim);
    KR_GROW(rim.first, rim.count, rim.room);
    rim.first[rim.count] = rim.n_vertices;
    return rim;
}

static size_t how_many(size_t n, const size_t *vertex, const unsigned char *is_in) {
    size_t count = 0;
    for (size_t k = 0; k < n; k++)
        count += is_in[vertex[k]];
    return count;
}

/** Make room in the mesh for all facets of the rim. */
static void make_room(struct kr_mesh *mesh, const struct rim *rim) {
    if (mesh->dim == 2) {
        mesh->edge = kr_realloc(mesh->edge, 2 * (mesh->n_edges + rim->count), sizeof *mesh->edge);
        return;
    }
    size_t used = mesh->n_faces ? mesh->face_first[mesh->n_faces] : 0;
    size_t faces = mesh->n_faces + rim->count + 1;
    mesh->face_first = kr_realloc(mesh->face_first, faces, sizeof *mesh->face_first);
    mesh->face = kr_realloc(mesh->face, used + rim->n_vertices, sizeof *mesh->face);
}

/** Add a facet, for which there is room; returns its place in the mesh. */
static size_t add_facet(struct kr_mesh *mesh, size_t n, const size_t *vertex) {
    if (mesh->dim == 2) {
        memcpy(mesh->edge + 2 * mesh->n_edges, vertex, 2 * sizeof *vertex);
        return mesh->n_edges++;
    }
    size_t from = mesh->face_first[mesh->n_faces];
    memcpy(mesh->face + from, vertex, n * sizeof *vertex);
    mesh->face_first[mesh->n_faces + 1] = from + n;
    return mesh->n_faces++;
}

/** What a group of points has become. `covered` marks the points that count. */
struct found {
    size_t count, *member;
    unsigned char *covered;
};

static void cover(struct found *found, size_t member, size_t n, const size_t *vertex) {
    found->member[found->count++] = member;
    for (size_t k = 0; k < n; k++)
        found->covered[vertex[k]] = 1;
}

static void take_facets(struct kr_mesh *mesh, const struct rim *rim, const unsigned char *is_in,
                        struct found *found) {
    found->member = kr_realloc(found->member, rim->count, sizeof *found->member);
    make_room(mesh, rim);
    for (size_t f = 0; f < rim->count; f++) {
        const size_t *vertex = rim->vertex + rim->first[f];
        size_t n = rim->first[f + 1] - rim->first[f];
        if (how_many(n, vertex, is_in) == n)
            cover(found, add_facet(mesh, n, vertex), n, vertex);
    }
}

/** Cells with all (`all` 1) or any (0) of their vertices in the group. */
static void take_cells(const struct kr_mesh *mesh, const unsigned char *is_in, int all,
                       struct found *found) {
    found->member = kr_realloc(found->member, mesh->n_cells, sizeof *found->member);
    for (size_t c = 0; c < mesh->n_cells; c++) {
        const size_t *vertex = mesh->vertex + mesh->first[c];
        size_t n = mesh->first[c + 1] - mesh->first[c], in = how_many(n, vertex, is_in);
        if (all ? in == n : in > 0)
            cover(found, c, n, vertex);
    }
}

/** Resolve one group; its new dimension is returned. */
static int resolve(struct kr_mesh *mesh, const struct rim *rim, const struct kr_mesh_group *group,
                   struct found *found) {
    unsigned char *is_in = KR_NEW(unsigned char, mesh->n_points);
    int all_on_rim = 1, dim = mesh->dim - 1;
    for (size_t k = 0; k < group->count; k++) {
        is_in[group->member[k]] = 1;
        all_on_rim &= rim->is_on[group->member[k]];
    }
    if (all_on_rim)
        take_facets(mesh, rim, is_in, found);
    if (!found->count) {
        dim = mesh->dim;
        take_cells(mesh, is_in, 1, found);
    }
    if (!found->count)
        take_cells(mesh, is_in, 0, found);
    kr_free(is_in);
    return dim;
}

static void report_lost(const struct kr_mesh *mesh, const struct kr_mesh_group *group, int dim,
                        const struct found *found) {
    size_t lost = 0, which = 0;
    for (size_t k = 0; k < group->count; k++)
        if (!found->covered[group->member[k]]) {
            which = lost++ ? which : group->member[k];
        }
    if (lost)
        kr_warn("set of points '%s': %zu of its %zu points, such as %lld at (%g, %g, %g) m, lie on "
                "none of the %zu %s between the others, and count for nothing",
                group->name, lost, group->count, (long long)kr_mesh_point_tag(mesh, which),
                mesh->point[3 * which], mesh->point[3 * which + 1], mesh->point[3 * which + 2],
                found->count, dim == mesh->dim ? "cells" : dim == 1 ? "edges" : "faces");
}


/** Abaqus likes one name for a set of elements and a set of nodes: the latter gives way. */
static void make_unique(struct kr_mesh *mesh, struct kr_mesh_group *group) {
    for (size_t g = 0; g < mesh->n_groups; g++) {
        const struct kr_mesh_group *other = &mesh->group[g];
        if (other == group || other->dim != group->dim || strcmp(other->name, group->name))
            continue;
        char *name = kr_text("%s_points", group->name);
        kr_warn("there are two sets named '%s'; the one of points is now '%s'", group->name, name);
        kr_free(group->name);
        group->name = name;
        g = (size_t)-1; /* begin again with the new name */
    }
}

void kr_mesh_resolve_points(struct kr_mesh *mesh) {
    struct rim rim = {0};
    for (size_t g = 0; g < mesh->n_groups; g++) {
        struct kr_mesh_group *group = &mesh->group[g];
        if (group->dim > 0)
            continue;
        if (!rim.is_on)
            rim = rim_of(mesh);
        struct found found = {.covered = KR_NEW(unsigned char, mesh->n_points)};
        int dim = resolve(mesh, &rim, group, &found);
        report_lost(mesh, group, dim, &found);
        kr_free(group->member);
        kr_free(found.covered);
        group->dim = dim;
        group->count = found.count;
        group->member = kr_realloc(found.member, found.count, sizeof *found.member);
        make_unique(mesh, group);
    }
    kr_free(rim.is_on);
    kr_free(rim.first);
    kr_free(rim.vertex);
}
