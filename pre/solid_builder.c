/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Growing a mesh of solids.
 */
#include "solid_builder.h"

#include "base/error.h"
#include "base/memory.h"

#include <stdint.h>
#include <string.h>

struct kr_solid_builder kr_solid_builder_begin(const struct kr_block_body *body) {
    struct kr_solid_builder builder = {.body = body, .mesh = kr_mesh_create(), .cells_room = 1};
    builder.mesh->dim = 3;
    builder.number = KR_NEW(size_t, (body->n[0] + 1) * (body->n[1] + 1) * (body->n[2] + 1));
    builder.table_size = 1024;
    builder.table = KR_NEW(size_t, builder.table_size);
    builder.mesh->face_first = KR_NEW(size_t, 1);
    builder.faces_room = 1;
    return builder;
}

static size_t add_point(struct kr_solid_builder *builder, const double place[3]) {
    struct kr_mesh *mesh = builder->mesh;
    if (mesh->n_points == builder->points_room) {
        builder->points_room = builder->points_room ? 2 * builder->points_room : 64;
        mesh->point = kr_realloc(mesh->point, 3 * builder->points_room, sizeof *mesh->point);
    }
    memcpy(mesh->point + 3 * mesh->n_points, place, 3 * sizeof *place);
    return mesh->n_points++;
}

size_t kr_solid_builder_lattice_point(struct kr_solid_builder *builder, size_t i, size_t j, size_t k) {
    const size_t *n = builder->body->n;
    size_t *number = &builder->number[(k * (n[1] + 1) + j) * (n[0] + 1) + i];
    if (!*number)
        *number = 1 + add_point(builder, (const double[3]){(double)i, (double)j, (double)k});
    return *number - 1;
}

/* ---- other points, by their bits ---- */

static size_t slot_of(const struct kr_solid_builder *builder, const double place[3]) {
    uint64_t bits[3], h = 0;
    memcpy(bits, place, sizeof bits);
    for (int d = 0; d < 3; d++) /* splitmix64 (Vigna) */
        h = (h ^ bits[d] ^ (h >> 31)) * UINT64_C(0xBF58476D1CE4E5B9);
    size_t slot = (size_t)(h ^ (h >> 29)) & (builder->table_size - 1);
    while (builder->table[slot] && memcmp(builder->mesh->point + 3 * (builder->table[slot] - 1), place,
                                          3 * sizeof *place))
        slot = (slot + 1) & (builder->table_size - 1);
    return slot;
}

static void grow_table(struct kr_solid_builder *builder) {
    size_t *old = builder->table, size = builder->table_size;
    builder->table_size *= 4;
    builder->table = KR_NEW(size_t, builder->table_size);
    for (size_t s = 0; s < size; s++)
        if (old[s])
            builder->table[slot_of(builder, builder->mesh->point + 3 * (old[s] - 1))] = old[s];
    kr_free(old);
}

size_t kr_solid_builder_point(struct kr_solid_builder *builder, const double place[3]) {
    if (2 * builder->n_other >= builder->table_size)
        grow_table(builder);
    size_t *number = &builder->table[slot_of(builder, place)];
    if (!*number) {
        *number = 1 + add_point(builder, place);
        builder->n_other++;
    }
    return *number - 1;
}

/* ---- cells and faces ---- */

void kr_solid_builder_cell(struct kr_solid_builder *builder, size_t n, const size_t *point) {
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

/* Corners of a cube in the order of VTK. */
static const unsigned char corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                           {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

static size_t corner_of(struct kr_solid_builder *builder, size_t i, size_t j, size_t k, size_t c) {
    return kr_solid_builder_lattice_point(builder, i + corner[c][0], j + corner[c][1],
                                          k + corner[c][2]);
}

void kr_solid_builder_cube(struct kr_solid_builder *builder, size_t i, size_t j, size_t k) {
    size_t point[8];
    for (size_t c = 0; c < 8; c++)
        point[c] = corner_of(builder, i, j, k, c);
    kr_solid_builder_cell(builder, 8, point);
}

void kr_solid_builder_face(struct kr_solid_builder *builder, size_t n, const size_t *point, int group) {
    struct kr_mesh *mesh = builder->mesh;
    for (size_t k = 0; k < n; k++) {
        KR_GROW(mesh->face, builder->n_face_vertices, builder->face_room);
        mesh->face[builder->n_face_vertices++] = point[k];
    }
    KR_GROW(builder->face_group, mesh->n_faces, builder->groups_room);
    builder->face_group[mesh->n_faces++] = group;
    KR_GROW(mesh->face_first, mesh->n_faces, builder->faces_room);
    mesh->face_first[mesh->n_faces] = builder->n_face_vertices;
}

void kr_solid_builder_side(struct kr_solid_builder *builder, size_t i, size_t j, size_t k, int side,
                           int group) {
    static const unsigned char of[6][4] = {{3, 0, 4, 7}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                           {2, 3, 7, 6}, {0, 3, 2, 1}, {4, 5, 6, 7}};
    size_t point[4];
    for (size_t c = 0; c < 4; c++)
        point[c] = corner_of(builder, i, j, k, of[side][c]);
    kr_solid_builder_face(builder, 4, point, group);
}

/* ---- the end ---- */

static void add_group(struct kr_mesh *mesh, const char *name, int dim, size_t from, size_t to) {
    struct kr_mesh_group *group = &mesh->group[mesh->n_groups++];
    *group = (struct kr_mesh_group){kr_text_copy(name), dim, (int)mesh->n_groups, to - from,
                                    KR_NEW(size_t, to - from)};
    for (size_t k = from; k < to; k++)
        group->member[k - from] = k;
}

/** Put the faces in the order of their groups, and name these. */
static void sort_faces(struct kr_solid_builder *builder) {
    const struct kr_block_body *body = builder->body;
    struct kr_mesh *mesh = builder->mesh;
    size_t *first = KR_NEW(size_t, mesh->n_faces + 1), *face = KR_NEW(size_t, builder->n_face_vertices);
    size_t at = 0;
    for (int g = 0; g < (int)body->n_groups; g++) {
        size_t from = at;
        for (size_t f = 0; f < mesh->n_faces; f++) {
            size_t n = mesh->face_first[f + 1] - mesh->face_first[f];
            if (builder->face_group[f] != g)
                continue;
            memcpy(face + first[at], mesh->face + mesh->face_first[f], n * sizeof *face);
            first[at + 1] = first[at] + n;
            at++;
        }
        if (at > from)
            add_group(mesh, body->group[g], 2, from, at);
        else if (!strncmp(body->group[g], "void_", 5) || !strncmp(body->group[g], "hole_", 5))
            kr_stop(KR_EXIT_INPUT, "%s lies outside the body or wholly within other voids: remove it",
                    body->group[g]);
    }
    kr_assert(at == mesh->n_faces);
    kr_free(mesh->face_first);
    kr_free(mesh->face);
    mesh->face_first = first;
    mesh->face = face;
}

struct kr_mesh *kr_solid_builder_end(struct kr_solid_builder *builder) {
    struct kr_mesh *mesh = builder->mesh;
    if (!mesh->n_cells)
        kr_stop(KR_EXIT_INPUT, "the voids leave nothing of the body");
    kr_free(builder->number);
    kr_free(builder->table);
    mesh->group = KR_NEW(struct kr_mesh_group, builder->body->n_groups + 1);
    sort_faces(builder);
    kr_free(builder->face_group);
    add_group(mesh, "body", 3, 0, mesh->n_cells);
    for (size_t k = 0; k < 3 * mesh->n_points; k++)
        mesh->point[k] *= builder->body->spacing;
    return mesh;
}
