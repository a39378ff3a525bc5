/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The loop over all bonds: force and strain energy of every node, and the
 * force's derivative in a direction. This file is compiled once for
 * each kind of processor; the width of a vector follows from the target.
 *
 *    f_i = sum_j c w_ij V_j (s/|xi+eta|) (xi+eta)        theory.md (7); plates paper eq. 11
 *    W_i = 1/2 sum_j w_ij V_j c |xi| energy(s)           theory.md (8)
 *    (J v)_i = sum_j c w_ij V_j/|xi| (pull e v_ij + tangent (xi+eta).v_ij/|xi|^2 (xi+eta))   (8a)
 *    w_ij = (lambda_i + lambda_j)/2 phi_ij,  c = c(|xi|)  theory.md (6e)
 *
 * without square root or division, by q = eta . (2 xi + eta) = |xi+eta|^2 - |xi|^2, e = q/|xi|^2 and
 * the polynomials of fit.h. q has no cancellation, however small the stretch.
 *
 *   xi    bond vector at rest [m]        eta   difference of displacements [m]
 *   e     see above                      keep  all bits set in the lanes whose bond lives
 *   v_ij  difference of directions, v_j - v_i
 *
 * Damage costs nothing here: the loop only notes that some bond of a slice left the range, and
 * exact.c does that slice again, bond by bond. The readable form of this loop is there, too.
 */
#include "kernel.h"

#include <stdint.h>

#if defined(__AVX512F__)
enum { WIDTH = 8 };
#elif defined(__AVX__)
enum { WIDTH = 4 };
#else
enum { WIDTH = 2 };
#endif

enum { ALL = (1 << KR_LANES) - 1 };

/* What a loop sums. Always a constant, so that what is not asked for is not compiled. */
enum what { FORCE, ENERGY, PRODUCT };

typedef double vector __attribute__((vector_size(WIDTH * 8)));
typedef double vector_anywhere __attribute__((vector_size(WIDTH * 8), aligned(8), may_alias));
typedef int64_t mask __attribute__((vector_size(WIDTH * 8)));
typedef float floats __attribute__((vector_size(WIDTH * 4), aligned(4), may_alias));

#define INLINE static inline __attribute__((always_inline))

INLINE vector load(const double *from) {
    return *(const vector_anywhere *)from;
}

INLINE void store(double *to, vector value) {
    *(vector_anywhere *)to = value;
}

INLINE vector load_floats(const float *from) {
    return __builtin_convertvector(*(const floats *)from, vector);
}

INLINE vector same(double value) {
    return value - (vector){0};
}

/* Lanes of a vector whose bit in `bits` is set. */
INLINE mask mask_of(unsigned bits) {
#if defined(__AVX512F__)
    const mask lane = {1, 2, 4, 8, 16, 32, 64, 128};
#elif defined(__AVX__)
    const mask lane = {1, 2, 4, 8};
#else
    const mask lane = {1, 2};
#endif
    return (((mask){0} + (int64_t)bits) & lane) != 0;
}

INLINE vector only(vector value, mask keep) {
    return (vector)((mask)value & keep);
}

INLINE int any_sign(mask m) {
    int64_t all = 0;
    for (int k = 0; k < WIDTH; k++)
        all |= m[k];
    return all < 0;
}

/* Two interleaved Horner chains, in e^2: half the latency of one. `terms` is even. */
INLINE vector polynomial(const double *coefficient, int terms, vector e) {
    vector square = e * e;
    vector even = same(coefficient[terms - 2]), odd = same(coefficient[terms - 1]);
    for (int k = terms - 4; k >= 0; k -= 2) {
        even = even * square + coefficient[k];
        odd = odd * square + coefficient[k + 1];
    }
    return odd * e + even;
}

/* A slice's lanes while its rows are summed. */
struct lanes {
    size_t node;         /* of the first lane */
    vector u[3], x[3], v[3], factor;
    vector sum[3];       /* force or product; sum[0] is the energy */
    mask left;           /* sign bits of lanes in which e left the range */
};

INLINE const struct kr_polynomial *polynomial_for(const struct kr_fit *fit, enum what what) {
    return what == ENERGY ? &fit->store : &fit->pull;
}

/* Add a row of bonds: `scale` is all of c w V/|xi| but the lambdas (force, product), or c w V |xi|.
 * `whole`: all lanes live, as in most rows, and `keep` is not looked at. */
INLINE void add_row(struct lanes *l, const struct kr_kernel_work *work, int dim, int terms,
                    enum what what, int whole, size_t j, const vector *xi, vector inverse_square,
                    vector scale, mask keep) {
    const struct kr_bonds *b = work->bonds;
    vector eta[3], stretched[3], q = {0};
    for (int d = 0; d < dim; d++) {
        eta[d] = load(work->u[d] + j) - l->u[d];
        stretched[d] = xi[d] + eta[d];
        q += eta[d] * (xi[d] + stretched[d]);
    }
    vector e = whole ? q * inverse_square : only(q * inverse_square, keep);
    l->left |= (mask)(b->flag_above - e) | (mask)(e - b->flag_below);
    vector both = scale * (l->factor + load(b->factor + j));
    vector pull = polynomial(polynomial_for(&b->fit, what)->coefficient, terms, e) * both * e;
    if (what == ENERGY)
        l->sum[0] += pull * e;
    if (what == FORCE)
        for (int d = 0; d < dim; d++)
            l->sum[d] += pull * stretched[d];
    if (what == PRODUCT) {
        vector v[3], along = {0};
        for (int d = 0; d < dim; d++) {
            v[d] = load(work->v[d] + j) - l->v[d];
            along += v[d] * stretched[d];
        }
        vector tangent = polynomial(b->fit.tangent.coefficient, terms, e) * both * inverse_square;
        tangent = whole ? tangent * along : only(tangent * along, keep);
        for (int d = 0; d < dim; d++)
            l->sum[d] += pull * v[d] + tangent * stretched[d];
    }
}

INLINE void sum_lattice(struct lanes *l, const struct kr_kernel_work *work, int dim, int terms,
                        enum what what, size_t slice, int part) {
    const struct kr_bonds *b = work->bonds;
    for (size_t r = b->first[slice]; r < b->first[slice + 1]; r++) {
        const struct kr_bond_kind *kind = &b->kinds[b->kind[r]];
        const size_t j = l->node + (size_t)(ptrdiff_t)b->offset[r];
        const vector inverse_square = same(kind->inverse_square);
        const vector scale = same(what == ENERGY ? kind->store : kind->pull);
        vector xi[3];
        for (int d = 0; d < dim; d++)
            xi[d] = same(kind->xi[d]);
        if (b->living[r] == ALL)
            add_row(l, work, dim, terms, what, 1, j, xi, inverse_square, scale, (mask){0});
        else
            add_row(l, work, dim, terms, what, 0, j, xi, inverse_square, scale,
                    mask_of((unsigned)b->living[r] >> (part * WIDTH)));
    }
}

/* Shares of the conical micromodulus at these lengths. */
INLINE vector cone(vector length, double horizon) {
    vector share = 1 - length / same(horizon);
    return only(share, share > 0);
}

INLINE void sum_general(struct lanes *l, const struct kr_kernel_work *work, int dim, int terms,
                        int conical, enum what what, size_t slice, int part) {
    const struct kr_bonds *b = work->bonds;
    const float *inverse = b->inverse + KR_LANES * b->first_inverse[slice] + part * WIDTH;
    const float *weight = b->weight + KR_LANES * b->first_weight[slice] + part * WIDTH;
    const double c = b->material.micromodulus * (what == ENERGY ? 0.25 : 0.5);
    for (size_t r = b->first[slice]; r < b->first[slice + 1]; r++) {
        size_t j = l->node + (size_t)(ptrdiff_t)b->offset[r];
        vector xi[3], square = {0};
        for (int d = 0; d < dim; d++) {
            xi[d] = load(b->x[d] + j) - l->x[d];
            square += xi[d] * xi[d];
        }
        /* One Newton step takes 1/|xi| from the 24 bits stored to 48. */
        vector root = load_floats(inverse);
        root = root * (1.5 - 0.5 * square * root * root);
        vector scale = c * load(b->volume + j) * (what == ENERGY ? square * root : root);
        if (conical)
            scale *= cone(square * root, b->material.horizon);
        if (b->kind[r]) {
            scale *= load_floats(weight);
            weight += KR_LANES;
        }
        inverse += KR_LANES;
        if (b->living[r] == ALL)
            add_row(l, work, dim, terms, what, 1, j, xi, root * root, scale, (mask){0});
        else
            add_row(l, work, dim, terms, what, 0, j, xi, root * root, scale,
                    mask_of((unsigned)b->living[r] >> (part * WIDTH)));
    }
}

/* One slice, WIDTH lanes at a time. */
INLINE void do_slice(const struct kr_kernel_work *work, int dim, int terms, int conical,
                     enum what what,
                     size_t slice) {
    const struct kr_bonds *b = work->bonds;
    unsigned char flag = 0;
    for (int part = 0; part < KR_LANES / WIDTH; part++) {
        struct lanes l = {.node = slice * KR_LANES + (size_t)part * WIDTH};
        for (int d = 0; d < dim; d++) {
            l.u[d] = load(work->u[d] + l.node);
            l.x[d] = load(b->x[d] + l.node);
            if (what == PRODUCT)
                l.v[d] = load(work->v[d] + l.node);
        }
        l.factor = load(b->factor + l.node);
        if (b->lattice[slice])
            sum_lattice(&l, work, dim, terms, what, slice, part);
        else
            sum_general(&l, work, dim, terms, conical, what, slice, part);
        if (what == ENERGY)
            store(work->energy + l.node, l.sum[0]);
        for (int d = 0; d < dim && what != ENERGY; d++)
            store((what == FORCE ? work->force : work->product)[d] + l.node, l.sum[d]);
        flag |= (unsigned char)any_sign(l.left);
    }
    work->flag[slice] = flag;
}

/* The common lengths of the polynomials are constants, so that their loops unroll. */
INLINE void do_slices(const struct kr_kernel_work *work, int dim, int conical, enum what what,
                      size_t begin, size_t end) {
    const int terms = polynomial_for(&work->bonds->fit, what)->terms;
    if (terms == 8)
        for (size_t slice = begin; slice < end; slice++)
            do_slice(work, dim, 8, conical, what, slice);
    else if (terms == 10)
        for (size_t slice = begin; slice < end; slice++)
            do_slice(work, dim, 10, conical, what, slice);
    else
        for (size_t slice = begin; slice < end; slice++)
            do_slice(work, dim, terms, conical, what, slice);
}

/* So are the dimension and the profile of the micromodulus. */
INLINE void do_body(const struct kr_kernel_work *work, enum what what, size_t begin, size_t end) {
    const int conical = work->bonds->material.profile == KR_CONICAL;
    if (work->bonds->dim == 2 && !conical)
        do_slices(work, 2, 0, what, begin, end);
    else if (work->bonds->dim == 2)
        do_slices(work, 2, 1, what, begin, end);
    else if (!conical)
        do_slices(work, 3, 0, what, begin, end);
    else
        do_slices(work, 3, 1, what, begin, end);
}

static void force(const struct kr_kernel_work *work, size_t begin, size_t end) {
    do_body(work, FORCE, begin, end);
}

static void energy(const struct kr_kernel_work *work, size_t begin, size_t end) {
    do_body(work, ENERGY, begin, end);
}

static void product(const struct kr_kernel_work *work, size_t begin, size_t end) {
    do_body(work, PRODUCT, begin, end);
}

extern const struct kr_kernel KR_KERNEL;
const struct kr_kernel KR_KERNEL = {
    .name = KR_KERNEL_NAME, .force = force, .energy = energy, .product = product};
