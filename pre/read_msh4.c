/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The sections of MSH 4.1: elements lie on entities, and the entities belong to groups.
 */
#include "msh.h"

#include "base/memory.h"

#include <string.h>

enum { MOST_ROWS = 16 }; /* elements of the most nodes that are read at once */

static void read_entity(struct kr_msh *msh, int dim) {
    struct kr_scan *scan = &msh->scan;
    struct kr_msh_entity entity = {dim, kr_scan_int(scan, "the number of an entity"), 0, NULL};
    for (int k = 0; k < (dim == 0 ? 3 : 6); k++)
        kr_scan_double(scan, "the box around an entity");
    entity.n_groups = kr_scan_count(scan, 1, "the number of an entity's physical groups");
    entity.group = KR_NEW(size_t, entity.n_groups);
    for (size_t k = 0; k < entity.n_groups; k++)
        entity.group[k] = kr_msh_group(msh, dim, kr_scan_int(scan, "a physical group"));
    if (dim > 0) {
        size_t n = kr_scan_count(scan, 1, "the number of entities that bound one");
        for (size_t k = 0; k < n; k++)
            kr_scan_int(scan, "an entity that bounds one");
    }
    msh->entity[msh->n_entities++] = entity;
}

void kr_msh4_entities(struct kr_msh *msh) {
    size_t n[4], total = 0;
    for (int dim = 0; dim < 4; dim++)
        total += n[dim] = kr_scan_count(&msh->scan, 5, "the number of entities");
    msh->entity = KR_NEW(struct kr_msh_entity, total);
    for (int dim = 0; dim < 4; dim++)
        for (size_t k = 0; k < n[dim]; k++)
            read_entity(msh, dim);
}

static void read_nodes_of_block(struct kr_msh *msh, size_t *left) {
    struct kr_scan *scan = &msh->scan;
    int dim = kr_scan_int(scan, "the dimension of a block");
    kr_scan_int(scan, "the entity of a block");
    size_t row = 3;
    if (kr_scan_int(scan, "whether nodes are parametric") && dim > 0 && dim <= 3)
        row += (size_t)dim; /* parameters of the node on its entity, which are passed over */
    size_t count = kr_scan_count(scan, 4, "the number of nodes of a block");
    if (count > *left)
        kr_scan_bad(scan, "there are more nodes than the section announced");
    *left -= count;
    size_t first = kr_gather_nodes(&msh->gather, count);
    double *point = msh->gather.point + 3 * first;
    kr_scan_sizes(scan, count, msh->gather.node_tag + first, "the number of a node");
    if (row == 3) {
        kr_scan_doubles(scan, 3 * count, point, "a coordinate of a node");
        return;
    }
    for (size_t k = 0; k < count; k++) {
        double found[6];
        kr_scan_doubles(scan, row, found, "a coordinate of a node");
        memcpy(point + 3 * k, found, 3 * sizeof *point);
    }
}

void kr_msh4_nodes(struct kr_msh *msh) {
    struct kr_scan *scan = &msh->scan;
    size_t blocks = kr_scan_count(scan, 4, "the number of blocks of nodes");
    size_t n = kr_scan_count(scan, 4, "the number of nodes"), left = n;
    kr_scan_size(scan, "the least number of a node");
    kr_scan_size(scan, "the greatest number of a node");
    kr_gather_expect_nodes(&msh->gather, n);
    for (size_t b = 0; b < blocks; b++)
        read_nodes_of_block(msh, &left);
    if (left)
        kr_scan_bad(scan, "expected %zu nodes, found %zu", n, n - left);
}

static const struct kr_msh_entity *find_entity(const struct kr_msh *msh, int dim, int tag) {
    static const char *const word[] = {"point", "curve", "surface", "volume"};
    static const struct kr_msh_entity none = {0};
    for (size_t k = 0; k < msh->n_entities; k++)
        if (msh->entity[k].dim == dim && msh->entity[k].tag == tag)
            return &msh->entity[k];
    if (msh->has_entities)
        kr_scan_bad(&msh->scan, "elements lie on %s %d, which $Entities does not name", word[dim],
                    tag);
    return &none;
}

static void read_block(struct kr_msh *msh, size_t *left) {
    struct kr_scan *scan = &msh->scan;
    int dim = kr_scan_int(scan, "the dimension of a block");
    int tag = kr_scan_int(scan, "the entity of a block");
    int type = kr_scan_int(scan, "the type of elements");
    const struct kr_element *kind = kr_msh_element(scan, type);
    size_t count = kr_scan_count(scan, kind->nodes + 1, "the number of elements of a block");
    if (count > *left)
        kr_scan_bad(scan, "there are more elements than the section announced");
    *left -= count;
    if (dim != kind->dim)
        kr_scan_bad(scan, "elements of type %d cannot lie on an entity of dimension %d", type, dim);
    const struct kr_msh_entity *entity = find_entity(msh, dim, tag);
    kr_gather_expect_elements(&msh->gather, type, count);
    size_t row[MOST_ROWS * (1 + KR_MOST_NODES)], rows = sizeof row / sizeof *row / (1 + kind->nodes), first = 0;
    for (size_t k = 0; k < count; k += rows) {
        size_t n = count - k < rows ? count - k : rows;
        kr_scan_sizes(scan, n * (1 + kind->nodes), row, "the number of an element or of a node of it");
        size_t place = kr_gather_elements(&msh->gather, type, n, row);
        first = k ? first : place;
    }
    for (size_t g = 0; g < entity->n_groups; g++)
        kr_gather_members(&msh->gather, entity->group[g], first, count);
}

void kr_msh4_elements(struct kr_msh *msh) {
    struct kr_scan *scan = &msh->scan;
    size_t blocks = kr_scan_count(scan, 4, "the number of blocks of elements");
    size_t left = kr_scan_count(scan, 2, "the number of elements");
    kr_scan_size(scan, "the least number of an element");
    kr_scan_size(scan, "the greatest number of an element");
    for (size_t b = 0; b < blocks; b++)
        read_block(msh, &left);
    if (left)
        kr_scan_bad(scan, "%zu elements fewer than the section announced", left);
}
