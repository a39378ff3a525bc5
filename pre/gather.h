/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From a mesh file to a mesh: readers hand over nodes, elements and groups as they stand in the
 * file; this sorts them, resolves their numbers, and makes cells, facets and groups.
 *
 *    dimension   3 if there is a solid, else 2
 *    cells       elements of that dimension, by ascending number
 *    facets      elements one dimension lower that are in a group; the others say nothing
 *    groups      of these two; lower ones become sets of points, see kr_mesh_resolve_points
 */
#ifndef KR_GATHER_H
#define KR_GATHER_H

#include "element.h"
#include "mesh.h"

struct kr_gather_node {
    size_t tag, place;
};

/** The elements of one dimension. */
struct kr_pile {
    size_t count, room, n_nodes, nodes_room;
    size_t *tag;
    unsigned char *type; /* gmsh's number */
    size_t *first;       /* (count) where its nodes begin */
    size_t *node;        /* numbers in the file, later places */
};

struct kr_gather {
    const char *path; /* not owned */
    size_t n_nodes, nodes_room, points_room;
    struct kr_gather_node *node;
    double *point;
    struct kr_pile pile[4];
    size_t n_groups, groups_room;
    struct kr_mesh_group *group; /* members: places in the pile of their dimension */
    size_t *group_room;
    int merges; /* an element in two groups stands twice in the file, as in MSH 2.2 */
};

/** Make room for so many more nodes, or elements of a type: growing step by step costs more. */
void kr_gather_expect_nodes(struct kr_gather *gather, size_t count);
void kr_gather_expect_elements(struct kr_gather *gather, int type, size_t count);

void kr_gather_node(struct kr_gather *gather, size_t tag, const double point[3]);

/** Add an element with its nodes' numbers; returns its place in the pile of its dimension. */
size_t kr_gather_element(struct kr_gather *gather, int type, size_t tag, const size_t *node);

/** The group of this dimension and number, made without a name where there is none yet. */
size_t kr_gather_group(struct kr_gather *gather, int dim, int tag);

/** Name a group that has no name yet. */
void kr_gather_name(struct kr_gather *gather, size_t group, const char *name);

void kr_gather_member(struct kr_gather *gather, size_t group, size_t element);

/** The mesh, and nothing left of what was gathered. Stops (exit 2) where numbers stand twice or are
 *  missing, or where there are no cells. */
struct kr_mesh *kr_gather_finish(struct kr_gather *gather);

#endif
