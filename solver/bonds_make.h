/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What the files that build the families share: bonds_make.c (all of it), bonds_rows.c (rows),
 * bonds_lattice.c (the lattice), bonds_share.c (lists that stand in memory once).
 */
#ifndef KR_BONDS_MAKE_H
#define KR_BONDS_MAKE_H

#include "bonds.h"
#include "search.h"
#include "weight.h"

/** What building needs to know; one for all threads, read only. */
struct kr_builder {
    const struct kr_nodes *nodes;
    struct kr_bonds *bonds;
    struct kr_search *search;
    struct kr_weights *weights;
    double size_of_lattice, origin[3], cell_volume;
    int reach_in_cells;
    unsigned char *on_lattice; /* (n) */
    int32_t *place; /* (n x dim) column, row, layer of those on the lattice */
};

/** Fill on_lattice and place, and the kinds of bonds between lattice nodes. */
void kr_builder_find_lattice(struct kr_builder *builder);
void kr_builder_make_kinds(struct kr_builder *builder);

/** Place in the table of kinds of the bond from lattice node i to lattice node j. */
int kr_builder_kind(const struct kr_builder *builder, size_t i, size_t j);

/** Let slices whose lists (offset, kind) are equal share one. */
void kr_bonds_share_lists(struct kr_bonds *bonds);

#endif
