/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From a mesh file to a mesh: readers hand over nodes, elements and groups as they stand in the
 * file; this sorts them, resolves their numbers, and makes cells, facets and groups.
 *
 *    dimension   3 if there is a solid, else 2
 *    cells       elements of that dimension, by ascending number
 *    facets      elements one dimension lower that are in a group; the others say nothing
 *    groups      of these two; lower ones become sets of points, see kr_mesh_resolve_points
 *
 * What stands in the file as the mesh wants it, as nearly all does, is not moved again: the arrays that are
 * gathered become those of the mesh.
 */
#ifndef KR_GATHER_H
#define KR_GATHER_H

#include "element.h"
#include "mesh.h"

/** Elements of one kind, one after the other, up to where the next run begins. */
struct kr_run {
    const struct kr_element *kind;
    size_t element, node; /* the first element, and where its nodes begin */
};

/** The elements of one dimension. */
struct kr_pile {
    size_t count, room, n_nodes, nodes_room, n_runs, runs_room;
    size_t *tag;
    size_t *node; /* numbers in the file, later places */
    struct kr_run *run;
};

struct kr_gather {
    const char *path; /* not owned */
    size_t n_nodes, nodes_room;
    size_t *node_tag;
    double *point;
    struct kr_pile pile[4];
    size_t n_groups, groups_room;
    struct kr_mesh_group *group; /* members: places in the pile of their dimension */
    size_t *group_room;
    int merges; /* an element in two groups stands twice in the file, as in MSH 2.2 */
};

/** Make room for so many more nodes, or elements of a type in all: growing step by step costs more. */
void kr_gather_expect_nodes(struct kr_gather *gather, size_t count);
void kr_gather_expect_elements(struct kr_gather *gather, int type, size_t count);

/** Add `count` nodes, whose numbers, node_tag, and places, point, the caller fills in from the place that is
 *  returned on. */
size_t kr_gather_nodes(struct kr_gather *gather, size_t count);

/** Add `count` elements of a type with their numbers and nodes' numbers, row by row: (count x (1 + nodes)). Returns
 *  the place of the first in the pile of their dimension. */
size_t kr_gather_elements(struct kr_gather *gather, int type, size_t count, const size_t *row);

/** The kind of element k of a pile and its nodes. */
const struct kr_element *kr_pile_element(const struct kr_pile *pile, size_t k, const size_t **node);

/** The group of this dimension and number, made without a name where there is none yet. */
size_t kr_gather_group(struct kr_gather *gather, int dim, int tag);

/** Name a group that has no name yet. */
void kr_gather_name(struct kr_gather *gather, size_t group, const char *name);

/** Put `count` elements from a place in their pile on into a group. */
void kr_gather_members(struct kr_gather *gather, size_t group, size_t first, size_t count);

/** The mesh, and nothing left of what was gathered. Stops (exit 2) where numbers stand twice or are
 *  missing, or where there are no cells. */
struct kr_mesh *kr_gather_finish(struct kr_gather *gather);

#endif
