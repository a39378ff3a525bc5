/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Putting a mesh together piece by piece: points of the lattice by their whole numbers, other
 * points, cells, boundary edges and groups. The order of calls is the order in the mesh.
 */
#ifndef KR_BUILDER_H
#define KR_BUILDER_H

#include "lattice.h"
#include "mesh.h"

struct kr_builder {
    struct kr_mesh *mesh;
    struct kr_lattice lattice;
    size_t *number;       /* (lattice points) their place in the mesh plus 1; 0: not in it */
    size_t n_vertices;    /* of all cells so far */
    size_t grouped_edges; /* edges that groups already hold */
    size_t points_room, cells_room, tags_room, vertices_room, edges_room, groups_room;
};

/** Begin an empty mesh on a lattice. */
struct kr_builder kr_builder_begin(const struct kr_lattice *lattice);

/** The lattice's point (i, j): added when first asked for. Returns its place in the mesh. */
size_t kr_builder_lattice_point(struct kr_builder *builder, size_t i, size_t j);

/** A new point (x, y) [m]. Returns its place in the mesh. */
size_t kr_builder_point(struct kr_builder *builder, double x, double y);

/** A cell of n points, counter-clockwise. */
void kr_builder_cell(struct kr_builder *builder, size_t n, const size_t *point);

/** The square with its lower left corner at the lattice's point (i, j). */
void kr_builder_square(struct kr_builder *builder, size_t i, size_t j);

/** A boundary edge, the body on its left. */
void kr_builder_edge(struct kr_builder *builder, size_t from, size_t to);

/** Name the edges added since the last call; without any there is no such group. The name is
 *  copied. */
void kr_builder_group_edges(struct kr_builder *builder, const char *name);

/** Number the cells, group them all as `plate`, check the whole structure and hand over the mesh.
 */
struct kr_mesh *kr_builder_end(struct kr_builder *builder);

#endif
