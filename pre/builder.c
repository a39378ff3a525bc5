/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Growing the arrays of a mesh.
 */
#include "builder.h"

#include "base/error.h"
#include "base/memory.h"

struct kr_builder kr_builder_begin(const struct kr_lattice *lattice) {
    struct kr_builder builder = {.mesh = kr_mesh_create(), .lattice = *lattice, .cells_room = 1};
    builder.number = KR_NEW(size_t, (lattice->columns + 1) * (lattice->rows + 1));
    return builder;
}

size_t kr_builder_point(struct kr_builder *builder, double x, double y) {
    struct kr_mesh *mesh = builder->mesh;
    if (mesh->n_points == builder->points_room) {
        builder->points_room = builder->points_room ? 2 * builder->points_room : 64;
        mesh->point = kr_realloc(mesh->point, 3 * builder->points_room, sizeof *mesh->point);
    }
    mesh->point[3 * mesh->n_points] = x;
    mesh->point[3 * mesh->n_points + 1] = y;
    mesh->point[3 * mesh->n_points + 2] = 0;
    return mesh->n_points++;
}

size_t kr_builder_lattice_point(struct kr_builder *builder, size_t i, size_t j) {
    size_t *number = &builder->number[kr_lattice_point(&builder->lattice, i, j)];
    if (!*number)
        *number = 1 + kr_builder_point(builder, (double)i * builder->lattice.spacing,
                                       (double)j * builder->lattice.spacing);
    return *number - 1;
}

void kr_builder_cell(struct kr_builder *builder, size_t n, const size_t *point) {
    struct kr_mesh *mesh = builder->mesh;
    for (size_t k = 0; k < n; k++) {
        KR_GROW(mesh->vertex, builder->n_vertices, builder->vertices_room);
        mesh->vertex[builder->n_vertices++] = point[k];
    }
    KR_GROW(mesh->cell_tag, mesh->n_cells, builder->tags_room);
    mesh->cell_tag[mesh->n_cells] = (int64_t)mesh->n_cells + 1;
    mesh->n_cells++;
    KR_GROW(mesh->first, mesh->n_cells, builder->cells_room);
    mesh->first[mesh->n_cells] = builder->n_vertices;
}

void kr_builder_square(struct kr_builder *builder, size_t i, size_t j) {
    size_t point[4] = {kr_builder_lattice_point(builder, i, j),
                       kr_builder_lattice_point(builder, i + 1, j),
                       kr_builder_lattice_point(builder, i + 1, j + 1),
                       kr_builder_lattice_point(builder, i, j + 1)};
    kr_builder_cell(builder, 4, point);
}

void kr_builder_edge(struct kr_builder *builder, size_t from, size_t to) {
    struct kr_mesh *mesh = builder->mesh;
    if (mesh->n_edges == builder->edges_room) {
        builder->edges_room = builder->edges_room ? 2 * builder->edges_room : 64;
        mesh->edge = kr_realloc(mesh->edge, 2 * builder->edges_room, sizeof *mesh->edge);
    }
    mesh->edge[2 * mesh->n_edges] = from;
    mesh->edge[2 * mesh->n_edges + 1] = to;
    mesh->n_edges++;
}

static void add_group(struct kr_builder *builder, const char *name, int dim, size_t from,
                      size_t to) {
    struct kr_mesh *mesh = builder->mesh;
    KR_GROW(mesh->group, mesh->n_groups, builder->groups_room);
    struct kr_mesh_group *group = &mesh->group[mesh->n_groups++];
    *group = (struct kr_mesh_group){kr_text_copy(name), dim, (int)mesh->n_groups, to - from,
                                    KR_NEW(size_t, to - from)};
    for (size_t k = from; k < to; k++)
        group->member[k - from] = k;
}

void kr_builder_group_edges(struct kr_builder *builder, const char *name) {
    if (builder->grouped_edges == builder->mesh->n_edges)
        return;
    add_group(builder, name, 1, builder->grouped_edges, builder->mesh->n_edges);
    builder->grouped_edges = builder->mesh->n_edges;
}

struct kr_mesh *kr_builder_end(struct kr_builder *builder) {
    struct kr_mesh *mesh = builder->mesh;
    add_group(builder, "plate", 2, 0, mesh->n_cells);
    kr_free(builder->number);
    kr_assert(builder->grouped_edges == mesh->n_edges);
    char *fault = kr_mesh_fault(mesh);
    if (fault)
        kr_stop(KR_EXIT_LIBRARY, "the mesh that was made is faulty: %s", fault);
    return mesh;
}
