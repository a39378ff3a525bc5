/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Part of the loop over bonds (kernel.c): what a row of bonds adds to the sums of the nodes that it starts from.
 * Knows the law's polynomials and nothing of how rows are stored.
 *
 * Mixed precision (KR_FLOAT): what is made of the differences is float, and so are the sums over a
 * family. A displacement is the sum of two floats there (kr_rounded), so that its differences are as
 * good as those of doubles rounded to float, without the cost of conversions: the difference of the
 * high parts is exact where they are close, and else not small. Positions are whole numbers modulo
 * 2^32, whose differences are exact within a family.
 */
#ifndef KR_KERNEL_ROW_H
#define KR_KERNEL_ROW_H

#include "kernel.h"
#include "kernel_vector.h"

/* A batch is COUNT vectors that go through the arithmetic together: one chain of dependent operations
 * leaves the processor idle. It holds a pair of slices, or two rows of one, or a part of a row. */
enum {
    COUNT = 2 * (int)WIDTH > (int)KR_PAIR ? 1 : 2,
    BATCH = COUNT * WIDTH,
    ROWS = BATCH > KR_LANES ? BATCH / KR_LANES : 1, /* of a slice, in a batch */
    NODES = BATCH / ROWS,                           /* of a slice, in a batch */
};

/* What a loop sums. */
enum what { FORCE, ENERGY, PRODUCT };

/* What the compiler shall know as constants, so that loops unroll and what is not asked for is not
 * compiled. whole: all lanes live, `keep` is not looked at. apart: the upper half of a vector is
 * another row. */
struct shape {
    enum what what;
    int dim, terms, whole, apart;
};

INLINE const struct kr_fit *fit_of(const struct kr_bonds *b) {
#ifdef KR_FLOAT
    return &b->fit_mixed;
#else
    return &b->fit;
#endif
}

/* ---- nodes ---- */

/* Displacements of WIDTH nodes. */
struct displacements {
    vector high, low; /* low: 0 in double precision */
};

INLINE struct displacements load_u(const struct kr_kernel_work *work, int d, struct place node,
                                   int apart) {
#ifdef KR_FLOAT
    return (struct displacements){load_floats(work->rounded->high[d], node, apart),
                                  load_floats(work->rounded->low[d], node, apart)};
#else
    (void)apart;
    return (struct displacements){.high = load(work->u[d], node)};
#endif
}

INLINE vector minus(struct displacements to, struct displacements from) {
#ifdef KR_FLOAT
    return (to.high - from.high) + (to.low - from.low);
#else
    return to.high - from.high;
#endif
}

INLINE vector load_factor(const struct kr_kernel_work *work, struct place node, int apart) {
#ifdef KR_FLOAT
    return load_floats(work->rounded->factor, node, apart);
#else
    (void)apart;
    return load(work->bonds->factor, node);
#endif
}

/* WIDTH nodes, and what is summed for them. */
struct lanes {
    struct place node;
    struct displacements u[3];
    vector factor;
    vector sum[3]; /* force or product; sum[0] is the energy. All still without c/2 */
    mask left;     /* bits of all t: the exponent's highest is set where some |t| was 2 or more */
};

INLINE struct lanes begin_lanes(const struct kr_kernel_work *work, struct shape shape,
                                struct place node) {
    struct lanes l = {.node = node, .factor = load_factor(work, node, shape.apart)};
    for (int d = 0; d < shape.dim; d++)
        l.u[d] = load_u(work, d, node, shape.apart);
    return l;
}

/* Whether some bond left the range of the polynomials. */
INLINE unsigned char has_left(integer left) {
    return (left >> (8 * sizeof(integer) - 2)) & 1;
}

/* ---- rows ---- */

/* Bonds from such nodes to those at j. */
struct row {
    struct place j;
    vector xi[3], to_t; /* to_t: scale/|xi|^2 */
    vector pull;        /* phi V/|xi|^3 */
    mask keep;
};

INLINE void polynomial(int terms, const double *coefficient, const vector *t, vector *value) {
    for (int p = 0; p < COUNT; p++)
        value[p] = same(coefficient[terms - 1]);
    for (int k = terms - 2; k >= 0; k--)
        for (int p = 0; p < COUNT; p++)
            value[p] = value[p] * t[p] + (number)coefficient[k];
}

INLINE void add_products(struct lanes l[COUNT], const struct kr_kernel_work *work,
                         struct shape shape, const struct row row[COUNT], const vector *t,
                         const vector *both, const vector *pull, vector stretched[COUNT][3]) {
    vector tangent[COUNT];
    polynomial(shape.terms, fit_of(work->bonds)->tangent.coefficient, t, tangent);
    for (int p = 0; p < COUNT; p++) {
        vector v[3], along = {0}, turned = tangent[p] * both[p];
        for (int d = 0; d < shape.dim; d++) {
            v[d] = load_difference(work->v[d], row[p].j, l[p].node, shape.apart);
            along += v[d] * stretched[p][d];
        }
        along *= shape.whole ? turned : only(turned, row[p].keep);
        for (int d = 0; d < shape.dim; d++)
            l[p].sum[d] += pull[p] * v[d] + along * stretched[p][d];
    }
}

INLINE void add_rows(struct lanes l[COUNT], const struct kr_kernel_work *work, struct shape shape,
                     const struct row row[COUNT]) {
    const struct kr_fit *fit = fit_of(work->bonds);
    const struct kr_polynomial *law = shape.what == ENERGY ? &fit->store : &fit->pull;
    vector stretched[COUNT][3], q[COUNT], t[COUNT], both[COUNT], pull[COUNT];
    for (int p = 0; p < COUNT; p++) {
        q[p] = (vector){0};
        for (int d = 0; d < shape.dim; d++) {
            vector eta = minus(load_u(work, d, row[p].j, shape.apart), l[p].u[d]);
            stretched[p][d] = row[p].xi[d] + eta;
            q[p] += eta * (row[p].xi[d] + stretched[p][d]);
        }
        if (!shape.whole)
            q[p] = only(q[p], row[p].keep);
        t[p] = q[p] * row[p].to_t - (number)fit->shift;
        l[p].left |= (mask)t[p];
        both[p] = row[p].pull * (l[p].factor + load_factor(work, row[p].j, shape.apart));
    }
    polynomial(shape.terms, law->coefficient, t, pull);
    for (int p = 0; p < COUNT; p++) {
        pull[p] *= q[p] * both[p];
        if (shape.what == ENERGY)
            l[p].sum[0] += pull[p] * q[p];
        if (shape.what == FORCE)
            for (int d = 0; d < shape.dim; d++)
                l[p].sum[d] += pull[p] * stretched[p][d];
    }
    if (shape.what == PRODUCT)
        add_products(l, work, shape, row, t, both, pull, stretched);
}

/* ---- results ---- */

INLINE double *const *results_of(const struct kr_kernel_work *work, struct shape shape) {
    return shape.what == PRODUCT  ? work->product
           : shape.what == ENERGY ? &work->energy
                                  : work->force;
}

/* phi V/|xi|^3 c/2 (lambda_i + lambda_j) store q^2 is twice the energy. */
INLINE double unit_of(const struct kr_kernel_work *work, struct shape shape) {
    return (shape.what == ENERGY ? 0.25 : 0.5) * work->bonds->material.micromodulus;
}

INLINE int results(struct shape shape) {
    return shape.what == ENERGY ? 1 : shape.dim;
}

#endif
