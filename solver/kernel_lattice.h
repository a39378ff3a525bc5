/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Part of the loop over bonds (kernel.c): slices of the lattice. They go by pairs, for the two of a pair have the
 * same rows; what a row's bonds have in common stands in a table of kinds.
 *
 * What comes next is fetched into the caches by hand: the processor does not guess it from so many
 * streams (docs/performance.md).
 */
#ifndef KR_KERNEL_LATTICE_H
#define KR_KERNEL_LATTICE_H

#include "kernel_row.h"

/* Nodes to fetch ahead. */
enum { NODES_AHEAD = 2 * KR_PAIR };

INLINE struct place moved(struct place p, ptrdiff_t by) {
    return (struct place){p.at + (size_t)by, p.upper + (size_t)by};
}

/* What the vectors of a row have in common; of a kind of lattice bonds. */
INLINE struct row lattice_row(const struct kr_bonds *b, struct shape shape, size_t r) {
    struct row row;
#ifdef KR_FLOAT
    const struct kr_bond_geometry32 *g = &b->geometry32[b->kind[r]];
#else
    const struct kr_bond_geometry *g = &b->geometry[b->kind[r]];
#endif
    for (int d = 0; d < shape.dim; d++)
        row.xi[d] = same(g->xi[d]);
    row.to_t = same(g->to_t);
    row.pull = same(g->pull);
    return row;
}

/* The nodes that later slices will see first, and where they write. */
INLINE void fetch_nodes(const struct kr_kernel_work *work, struct shape shape, size_t node,
                        ptrdiff_t farthest) {
    enum { LINE = 64 };
    const size_t ahead = node + NODES_AHEAD, far = ahead + (size_t)farthest;
    double *const *to = results_of(work, shape);
    for (int d = 0; d < shape.dim; d++) {
#ifdef KR_FLOAT
        __builtin_prefetch(work->rounded->high[d] + far);
        __builtin_prefetch(work->rounded->low[d] + far);
#else
        for (size_t k = 0; k < KR_PAIR; k += LINE / sizeof(double))
            __builtin_prefetch(work->u[d] + far + k);
#endif
    }
#ifdef KR_FLOAT
    __builtin_prefetch(work->rounded->factor + far);
#else
    for (size_t k = 0; k < KR_PAIR; k += LINE / sizeof(double))
        __builtin_prefetch(work->bonds->factor + far + k);
#endif
    for (int d = 0; d < results(shape); d++)
        for (size_t k = 0; k < KR_PAIR; k += LINE / sizeof(double))
            __builtin_prefetch(to[d] + ahead + k, 1);
}

/* The pair of lattice slices from `slice` on: one list of rows serves both. */
INLINE void do_pair(const struct kr_kernel_work *work, struct shape shape, size_t slice) {
    const struct kr_bonds *b = work->bonds;
    const size_t list = b->list[slice], count = b->first[slice + 1] - b->first[slice];
    const uint8_t *low = b->living + b->first[slice], *high = b->living + b->first[slice + 1];
    double *const *to = results_of(work, shape);
    integer left[KR_PAIR / KR_LANES] = {0};
    fetch_nodes(work, shape, slice * KR_LANES, b->offset[list + count - 1]);
    for (size_t part = 0; part < KR_PAIR; part += BATCH) {
        struct lanes l[COUNT];
        for (size_t p = 0; p < COUNT; p++)
            l[p] = begin_lanes(work, shape, (struct place){slice * KR_LANES + part + p * WIDTH, 0});
        for (size_t r = 0; r < count; r++) {
            struct row row[COUNT];
            row[0] = lattice_row(b, shape, list + r);
            row[COUNT - 1] = row[0];
            for (size_t p = 0; p < COUNT; p++) {
                row[p].j = moved(l[p].node, b->offset[list + r]);
                row[p].keep = mask_of((low[r] | (unsigned)high[r] << KR_LANES) >> (part + p * WIDTH));
            }
            add_rows(l, work, shape, row);
        }
        for (int p = 0; p < COUNT; p++) {
            for (int d = 0; d < results(shape); d++)
                store(to[d] + l[p].node.at, l[p].sum[d], unit_of(work, shape));
            for (int k = 0; k < WIDTH; k++)
                left[(part + (size_t)(p * WIDTH + k)) / KR_LANES] |= l[p].left[k];
        }
    }
    for (int k = 0; k < KR_PAIR / KR_LANES; k++)
        work->flag[slice + (size_t)k] = has_left(left[k]);
}

#endif
