/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Putting a mesh of solids together: points of the lattice by their whole numbers, other points by
 * their bits, cells, boundary faces and groups. The order of calls is the order in the mesh; all
 * lengths are in spacings until the end.
 */
#ifndef KR_SOLID_BUILDER_H
#define KR_SOLID_BUILDER_H

#include "block_body.h"

struct kr_solid_builder {
    const struct kr_block_body *body;
    struct kr_mesh *mesh;
    size_t *number;             /* (lattice points) their place in the mesh plus 1; 0: not in it */
    size_t table_size, *table;  /* places plus 1 of the other points, by their bits */
    size_t n_other;
    int *face_group;            /* (faces) */
    size_t n_vertices, n_face_vertices;
    size_t points_room, cells_room, tags_room, vertices_room, faces_room, face_room, groups_room;
};

struct kr_solid_builder kr_solid_builder_begin(const struct kr_block_body *body);

/** The lattice's point (i, j, k): added when first asked for. Returns its place in the mesh. */
size_t kr_solid_builder_lattice_point(struct kr_solid_builder *builder, size_t i, size_t j, size_t k);

/** The point at a place: one that has been asked for before is the same if all bits are. */
size_t kr_solid_builder_point(struct kr_solid_builder *builder, const double place[3]);

void kr_solid_builder_cell(struct kr_solid_builder *builder, size_t n, const size_t *point);

/** The cube of a lattice cell. */
void kr_solid_builder_cube(struct kr_solid_builder *builder, size_t i, size_t j, size_t k);

/** A boundary face, counter-clockwise seen from outside, and the group it belongs to. */
void kr_solid_builder_face(struct kr_solid_builder *builder, size_t n, const size_t *point, int group);

/** A side (0 and 1: low and high along x; 2, 3: y; 4, 5: z) of a lattice cell as such a face. */
void kr_solid_builder_side(struct kr_solid_builder *builder, size_t i, size_t j, size_t k, int side,
                           int group);

/** Scale, number the cells, sort the faces into the body's groups, add `body` and hand over the mesh.
 *  Stops (exit 2) where nothing is left of the body or a void or hole has no face. */
struct kr_mesh *kr_solid_builder_end(struct kr_solid_builder *builder);

#endif
