/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What the readers of the two versions of MSH share (https://gmsh.info/doc/texinfo/gmsh.html, "MSH
 * file format"). No other file includes this but read_msh*.c.
 */
#ifndef KR_MSH_H
#define KR_MSH_H

#include "gather.h"
#include "base/scan.h"

/** A point, curve, surface or volume of MSH 4.1 and the groups it belongs to (of the gathering). */
struct kr_msh_entity {
    int dim, tag;
    size_t n_groups;
    size_t *group;
};

struct kr_msh {
    struct kr_scan scan;
    struct kr_gather gather;
    int has_names, has_entities, has_nodes, has_elements;
    size_t n_entities;
    struct kr_msh_entity *entity;
};

/** The kind of elements of a type; stops for one that is not read. */
const struct kr_element *kr_msh_element(const struct kr_scan *scan, int type);

/** The group of a number in the file, whose sign tells only the sense of an entity. */
size_t kr_msh_group(struct kr_msh *msh, int dim, int tag);

/** The sections of the two versions; `scan` stands behind the section's first line. */
void kr_msh4_entities(struct kr_msh *msh);
void kr_msh4_nodes(struct kr_msh *msh);
void kr_msh4_elements(struct kr_msh *msh);
void kr_msh2_nodes(struct kr_msh *msh);
void kr_msh2_elements(struct kr_msh *msh);

#endif
