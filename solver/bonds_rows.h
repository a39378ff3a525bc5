/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The rows of a pair of slices, merged from the sorted families of its nodes; bonds.h has what a row is.
 */
#ifndef KR_BONDS_ROWS_H
#define KR_BONDS_ROWS_H

#include "bonds_make.h"

enum { KR_ROWS_NEAR = 4096, KR_ROWS_MOST = KR_ROWS_NEAR * KR_LANES };

struct kr_row {
    int offset, kind;
    uint8_t mask;
    double inverse[KR_LANES], weight[KR_LANES];
};

/** Room of one thread, for the two slices of a pair. */
struct kr_rows {
    int near[2][KR_LANES][KR_ROWS_NEAR];
    size_t n_near[2][KR_LANES];
    struct kr_row row[2][KR_ROWS_MOST]; /* in the order of offsets, then of kinds */
    size_t n_rows[2];
    int lattice; /* both slices are lattice slices: they have the same rows */
};

/** Find the rows of a pair of slices. Stops (exit 2) where a node has no neighbour, or too many. */
void kr_rows_make(const struct kr_builder *builder, size_t pair, struct kr_rows *rows);

#endif
