/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Part of the loop over bonds (kernel.c): slices off the lattice. Each bond has a vector and a length of its own,
 * and at the horizon's rim a weight; two rows go at a time where a vector spans a slice.
 */
#ifndef KR_KERNEL_GENERAL_H
#define KR_KERNEL_GENERAL_H

#include "kernel_row.h"

/* Lengths to fetch ahead: see kernel_lattice.h. */
enum { LENGTHS_AHEAD = 512 };

/* Shares of the conical micromodulus, theory.md (6e). */
INLINE vector cone(vector inverse, double horizon) {
    vector share = 1 - 1 / (inverse * (number)horizon);
    return only(share, share > 0);
}

INLINE vector load_xi(const struct kr_kernel_work *work, int d, struct place j, struct place i,
                      int apart) {
#ifdef KR_FLOAT
    return load_steps(work->rounded->place[d], j, i, apart) * (number)work->rounded->unit;
#else
    return load_difference(work->bonds->x[d], j, i, apart);
#endif
}

INLINE vector load_volume(const struct kr_kernel_work *work, struct place j, int apart) {
#ifdef KR_FLOAT
    return load_floats(work->rounded->volume, j, apart);
#else
    (void)apart;
    return load(work->bonds->volume, j);
#endif
}

/* A row; row->j is set. inverse: where its 1/|xi| are; weight: where its weights are, if `rim`. */
INLINE void general_row(const struct kr_kernel_work *work, struct shape shape, const struct lanes *l,
                        struct place inverse, struct place weight, int rim, struct row *row) {
    const struct kr_bonds *b = work->bonds;
    vector root = load_floats(b->inverse, inverse, shape.apart), square = root * root;
    for (int d = 0; d < shape.dim; d++)
        row->xi[d] = load_xi(work, d, row->j, l->node, shape.apart);
    row->to_t = square * (number)fit_of(b)->scale;
    row->pull = load_volume(work, row->j, shape.apart) * (root * square);
    if (b->material.profile == KR_CONICAL)
        row->pull *= cone(root, b->material.horizon);
    if (rim)
        row->pull *= load_floats(b->weight, weight, shape.apart);
}

/* Rows begin to end - 1. rim: they store weights; a constant. */
INLINE void do_rows(struct lanes l[COUNT], const struct kr_kernel_work *work, struct shape shape,
                    size_t slice, size_t part, int rim, size_t begin, size_t end) {
    const struct kr_bonds *b = work->bonds;
    const int32_t *offset = b->offset + b->list[slice];
    const uint8_t *living = b->living + b->first[slice];
    const size_t lengths = b->first_inverse[slice], weights = b->first_weight[slice];
    for (size_t r = begin; r < end; r += ROWS) {
        const size_t second = r + ROWS - 1 < end ? r + ROWS - 1 : r; /* the last may have none */
        const unsigned bits = living[r] | (second > r ? (unsigned)living[second] << KR_LANES : 0);
        struct row row[COUNT];
        __builtin_prefetch(b->inverse + KR_LANES * (lengths + r) + LENGTHS_AHEAD);
        if (rim)
            __builtin_prefetch(b->weight + KR_LANES * (weights + r - begin) + LENGTHS_AHEAD);
        for (size_t p = 0; p < COUNT; p++) {
            const size_t lane = part + p * WIDTH % NODES;
            const size_t at = p * WIDTH / NODES ? second : r;
            struct place inverse = {KR_LANES * (lengths + at) + lane, KR_LANES * (lengths + second)};
            struct place weight = {KR_LANES * (weights + at - begin) + lane,
                                   KR_LANES * (weights + second - begin)};
            row[p].j = (struct place){l[p].node.at + (size_t)(ptrdiff_t)offset[at],
                                      l[p].node.upper + (size_t)(ptrdiff_t)offset[second]};
            row[p].keep = mask_of(bits >> (part + p * WIDTH));
            general_row(work, shape, &l[p], inverse, weight, rim, &row[p]);
        }
        add_rows(l, work, shape, row);
    }
}

/* The sums of NODES nodes from `node` on. Two rows at a time have two sums for each. */
INLINE void end_general(const struct kr_kernel_work *work, struct shape shape, size_t node,
                        struct lanes l[COUNT]) {
    double *const *to = results_of(work, shape);
    for (int d = 0; d < results(shape); d++) {
        if ((int)NODES < (int)WIDTH)
            store_folded(to[d] + node, l[0].sum[d], unit_of(work, shape));
        else if (ROWS > 1)
            store(to[d] + node, l[0].sum[d] + l[COUNT - 1].sum[d], unit_of(work, shape));
        else
            for (size_t p = 0; p < COUNT; p++)
                store(to[d] + node + p * WIDTH, l[p].sum[d], unit_of(work, shape));
    }
}

INLINE void do_general(const struct kr_kernel_work *work, struct shape shape, size_t slice) {
    const struct kr_bonds *b = work->bonds;
    const size_t count = b->first[slice + 1] - b->first[slice];
    const size_t rim = count - (b->first_weight[slice + 1] - b->first_weight[slice]);
    const size_t first = slice * KR_LANES;
    integer left = 0;
    shape.apart = (int)NODES < (int)WIDTH;
    for (size_t part = 0; part < KR_LANES; part += NODES) {
        struct lanes l[COUNT];
        for (size_t p = 0; p < COUNT; p++)
            l[p] = begin_lanes(work, shape,
                               (struct place){first + part + p * WIDTH % NODES, first});
        do_rows(l, work, shape, slice, part, 0, 0, rim);
        do_rows(l, work, shape, slice, part, 1, rim, count);
        end_general(work, shape, first + part, l);
        left |= any_bit(l[0].left | l[COUNT - 1].left);
    }
    work->flag[slice] = has_left(left);
}

#endif
