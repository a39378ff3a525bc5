/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The loop over all bonds: force and strain energy of every node, and the force's derivative in a
 * direction. This file is compiled once for each kind of processor and each precision; the width of
 * a vector follows from the target.
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
 *
 * Mixed precision (KR_FLOAT): what is made of the differences is float, and so are the sums over a
 * family. A displacement is the sum of two floats there (kr_rounded), so that its differences are as
 * good as those of doubles rounded to float, without the cost of conversions: the difference of the
 * high parts is exact where they are close, and else not small.
 * How fast: docs/performance.md.
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

#ifdef KR_FLOAT
typedef float number;
typedef int32_t integer;
#else
typedef double number;
typedef int64_t integer;
#endif

/* Vectors that go through the arithmetic together: one chain of dependent operations leaves the
 * processor idle. They are the halves of twins, two rows of a slice (where a vector spans it), or two
 * parts of a row. */
enum { COUNT = 2, TWO_ROWS = (int)WIDTH == (int)KR_LANES };

typedef number vector __attribute__((vector_size(WIDTH * sizeof(number))));
typedef integer mask __attribute__((vector_size(WIDTH * sizeof(number))));
typedef double doubles __attribute__((vector_size(WIDTH * 8)));
typedef double doubles_anywhere __attribute__((vector_size(WIDTH * 8), aligned(8), may_alias));
typedef float floats_anywhere __attribute__((vector_size(WIDTH * 4), aligned(4), may_alias));

#define INLINE static inline __attribute__((always_inline))

/* In float32, e is off by some 1e-7: slices are flagged a little before a bond breaks. */
#ifdef KR_FLOAT
static const number EARLY = 1 - 1e-5f;
#else
static const number EARLY = 1;
#endif

/* What a loop sums. */
enum what { FORCE, ENERGY, PRODUCT };

/* What the compiler shall know as constants, so that loops unroll and what is not asked for is not
 * compiled. whole: all lanes live, `keep` is not looked at. */
struct shape {
    enum what what;
    int dim, terms, whole;
};

/* ---- vectors ---- */

INLINE doubles load(const double *from) {
    return *(const doubles_anywhere *)from;
}

INLINE void store(double *to, doubles value) {
    *(doubles_anywhere *)to = value;
}

INLINE vector narrow(doubles value) {
    return __builtin_convertvector(value, vector);
}

/* Displacements of WIDTH nodes. */
#ifdef KR_FLOAT
struct displacements {
    vector high, low;
};
#else
struct displacements {
    vector all;
};
#endif

INLINE vector load_floats(const float *from) {
    return __builtin_convertvector(*(const floats_anywhere *)from, vector);
}

INLINE struct displacements load_u(const struct kr_kernel_work *work, int d, size_t node) {
#ifdef KR_FLOAT
    return (struct displacements){load_floats(work->rounded->high[d] + node),
                                  load_floats(work->rounded->low[d] + node)};
#else
    return (struct displacements){load(work->u[d] + node)};
#endif
}

INLINE vector minus(struct displacements to, struct displacements from) {
#ifdef KR_FLOAT
    return (to.high - from.high) + (to.low - from.low);
#else
    return to.all - from.all;
#endif
}

INLINE vector load_factor(const struct kr_kernel_work *work, size_t node) {
#ifdef KR_FLOAT
    return load_floats(work->rounded->factor + node);
#else
    return load(work->bonds->factor + node);
#endif
}

INLINE vector same(double value) {
    return (number)value - (vector){0};
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
    return (((mask){0} + (integer)bits) & lane) != 0;
}

INLINE vector only(vector value, mask keep) {
    return (vector)((mask)value & keep);
}

INLINE int any_sign(mask m) {
    integer all = 0;
    for (int k = 0; k < WIDTH; k++)
        all |= m[k];
    return all < 0;
}

INLINE const struct kr_fit *fit_of(const struct kr_bonds *b) {
#ifdef KR_FLOAT
    return &b->fit_mixed;
#else
    return &b->fit;
#endif
}

INLINE void polynomial(int terms, const double *coefficient, const vector *e, vector *value) {
    for (int p = 0; p < COUNT; p++)
        value[p] = same(coefficient[terms - 1]);
    for (int k = terms - 2; k >= 0; k--)
        for (int p = 0; p < COUNT; p++)
            value[p] = value[p] * e[p] + (number)coefficient[k];
}

/* ---- rows ---- */

/* The WIDTH nodes from `node` on, and what is summed for them. */
struct lanes {
    size_t node;
    struct displacements u[3];
    doubles v[3], x[3];
    vector factor;
    vector sum[3]; /* force or product; sum[0] is the energy. All still without c/2 */
    mask left;     /* sign bits of lanes in which e left the range */
};

/* Bonds from such nodes to those from j on. */
struct row {
    size_t j;
    vector xi[3], inverse_square;
    vector scale; /* phi V/|xi| for force and product, phi V |xi|/2 for the energy */
    mask keep;
};

INLINE void add_products(struct lanes l[COUNT], const struct kr_kernel_work *work,
                         struct shape shape, const struct row row[COUNT], const vector *e,
                         const vector *both, const vector *pull, vector stretched[COUNT][3]) {
    vector tangent[COUNT];
    polynomial(shape.terms, fit_of(work->bonds)->tangent.coefficient, e, tangent);
    for (int p = 0; p < COUNT; p++) {
        vector v[3], along = {0}, turned = tangent[p] * both[p] * row[p].inverse_square;
        for (int d = 0; d < shape.dim; d++) {
            v[d] = narrow(load(work->v[d] + row[p].j) - l[p].v[d]);
            along += v[d] * stretched[p][d];
        }
        along *= shape.whole ? turned : only(turned, row[p].keep);
        for (int d = 0; d < shape.dim; d++)
            l[p].sum[d] += pull[p] * v[d] + along * stretched[p][d];
    }
}

INLINE void add_rows(struct lanes l[COUNT], const struct kr_kernel_work *work, struct shape shape,
                     const struct row row[COUNT]) {
    const struct kr_bonds *b = work->bonds;
    const struct kr_polynomial *fit = shape.what == ENERGY ? &fit_of(b)->store : &fit_of(b)->pull;
    vector stretched[COUNT][3], e[COUNT], both[COUNT], pull[COUNT];
    for (int p = 0; p < COUNT; p++) {
        vector q = {0};
        for (int d = 0; d < shape.dim; d++) {
            vector eta = minus(load_u(work, d, row[p].j), l[p].u[d]);
            stretched[p][d] = row[p].xi[d] + eta;
            q += eta * (row[p].xi[d] + stretched[p][d]);
        }
        e[p] = q * row[p].inverse_square;
        if (!shape.whole)
            e[p] = only(e[p], row[p].keep);
        l[p].left |= (mask)(EARLY * (number)b->flag_above - e[p]) | (mask)(e[p] - (number)b->flag_below);
        both[p] = row[p].scale * (l[p].factor + load_factor(work, row[p].j));
    }
    polynomial(shape.terms, fit->coefficient, e, pull);
    for (int p = 0; p < COUNT; p++) {
        pull[p] *= e[p] * both[p];
        if (shape.what == ENERGY)
            l[p].sum[0] += pull[p] * e[p];
        if (shape.what == FORCE)
            for (int d = 0; d < shape.dim; d++)
                l[p].sum[d] += pull[p] * stretched[p][d];
    }
    if (shape.what == PRODUCT)
        add_products(l, work, shape, row, e, both, pull, stretched);
}

/* ---- where rows come from ---- */

/* A row of a lattice slice; row->j is set. */
INLINE void lattice_row(const struct kr_bonds *b, struct shape shape, size_t r, struct row *row) {
#ifdef KR_FLOAT
    const struct kr_bond_geometry32 *g = &b->kinds[b->kind[r]].rounded;
#else
    const struct kr_bond_geometry *g = &b->kinds[b->kind[r]].geometry;
#endif
    for (int d = 0; d < shape.dim; d++)
        row->xi[d] = same(g->xi[d]);
    row->inverse_square = same(g->inverse_square);
    row->scale = same(shape.what == ENERGY ? g->store : g->pull);
}

/* Shares of the conical micromodulus, theory.md (6e). */
INLINE vector cone(vector inverse, double horizon) {
    vector share = 1 - 1 / (inverse * (number)horizon);
    return only(share, share > 0);
}

/* A row of a general slice; row->j is set. inverse: of its lengths; weight: NULL where all are 1. */
INLINE void general_row(const struct kr_bonds *b, struct shape shape, const struct lanes *l,
                        const float *inverse, const float *weight, struct row *row) {
    vector root = load_floats(inverse);
    for (int d = 0; d < shape.dim; d++)
        row->xi[d] = narrow(load(b->x[d] + row->j) - l->x[d]);
    row->inverse_square = root * root;
    row->scale = narrow(load(b->volume + row->j)) *
                 (shape.what == ENERGY ? (number)0.5 / root : root);
    if (b->material.profile == KR_CONICAL)
        row->scale *= cone(root, b->material.horizon);
    if (weight)
        row->scale *= load_floats(weight);
}

/* ---- slices ---- */

INLINE struct lanes begin_lanes(const struct kr_kernel_work *work, struct shape shape, size_t node) {
    struct lanes l = {.node = node, .factor = load_factor(work, node)};
    for (int d = 0; d < shape.dim; d++) {
        l.u[d] = load_u(work, d, node);
        l.x[d] = load(work->bonds->x[d] + node);
        if (shape.what == PRODUCT)
            l.v[d] = load(work->v[d] + node);
    }
    return l;
}

INLINE void end_lanes(const struct lanes *l, const struct kr_kernel_work *work,
                      struct shape shape) {
    const double half_c = 0.5 * work->bonds->material.micromodulus;
    double *const *to = shape.what == PRODUCT  ? work->product
                        : shape.what == ENERGY ? &work->energy
                                               : work->force;
    for (int d = 0; d < (shape.what == ENERGY ? 1 : shape.dim); d++)
        store(to[d] + l->node, __builtin_convertvector(l->sum[d], doubles) * half_c);
    work->flag[l->node / KR_LANES] |= (unsigned char)any_sign(l->left);
}

INLINE size_t other_end(const struct kr_bonds *b, const struct lanes *l, size_t r) {
    return l->node + (size_t)(ptrdiff_t)b->offset[r];
}

/* Twins, the two slices from `slice` on: the rows of the first serve both. */
INLINE void do_twins(const struct kr_kernel_work *work, struct shape shape, size_t slice) {
    const struct kr_bonds *b = work->bonds;
    shape.whole = 1;
    for (size_t part = 0; part < 2 * KR_LANES; part += COUNT * WIDTH) {
        struct lanes l[COUNT];
        struct row row[COUNT];
        for (int p = 0; p < COUNT; p++)
            l[p] = begin_lanes(work, shape, slice * KR_LANES + part + (size_t)p * WIDTH);
        for (size_t r = b->first[slice]; r < b->first[slice + 1]; r++) {
            for (int p = 0; p < COUNT; p++) {
                row[p].j = other_end(b, &l[p], r);
                lattice_row(b, shape, r, &row[p]);
            }
            add_rows(l, work, shape, row);
        }
        for (int p = 0; p < COUNT; p++)
            end_lanes(&l[p], work, shape);
    }
}

/* Rows begin to end - 1 of a slice. lattice, rim: constants; rim: rows that store weights. */
INLINE void do_rows(struct lanes l[COUNT], const struct kr_kernel_work *work, struct shape shape,
                    size_t slice, size_t part, int lattice, int rim, size_t begin, size_t end) {
    const struct kr_bonds *b = work->bonds;
    /* From a row's number to its place among those that store lengths, or weights; may wrap. */
    const size_t to_inverse = b->first_inverse[slice] - b->first[slice];
    const size_t to_weight = b->first_weight[slice] - begin;
    for (size_t r = begin; r < end; r += TWO_ROWS ? COUNT : 1) {
        struct row row[COUNT];
        for (size_t p = 0; p < COUNT; p++) {
            size_t lane = TWO_ROWS ? 0 : part + p * WIDTH, at = r;
            unsigned living = b->living[r];
            if (TWO_ROWS && p > 0) { /* the last row may have no second */
                at = r + p < end ? r + p : r;
                living = r + p < end ? b->living[at] : 0;
            }
            row[p].j = other_end(b, &l[p], at);
            row[p].keep = mask_of(living >> lane);
            if (lattice)
                lattice_row(b, shape, at, &row[p]);
            else
                general_row(b, shape, &l[p], b->inverse + KR_LANES * (at + to_inverse) + lane,
                            rim ? b->weight + KR_LANES * (at + to_weight) + lane : NULL,
                            &row[p]);
        }
        add_rows(l, work, shape, row);
    }
}

INLINE void do_slice(const struct kr_kernel_work *work, struct shape shape, size_t slice) {
    const struct kr_bonds *b = work->bonds;
    const size_t begin = b->first[slice], end = b->first[slice + 1];
    const size_t rim = end - (b->first_weight[slice + 1] - b->first_weight[slice]);
    for (size_t part = 0; part < KR_LANES; part += TWO_ROWS ? WIDTH : COUNT * WIDTH) {
        struct lanes l[COUNT];
        for (size_t p = 0; p < COUNT; p++)
            l[p] = begin_lanes(work, shape,
                               slice * KR_LANES + (TWO_ROWS ? 0 : part + p * WIDTH));
        if (b->lattice[slice]) {
            do_rows(l, work, shape, slice, part, 1, 0, begin, end);
        } else {
            do_rows(l, work, shape, slice, part, 0, 0, begin, rim);
            do_rows(l, work, shape, slice, part, 0, 1, rim, end);
        }
        for (int d = 0; d < shape.dim && TWO_ROWS; d++)
            l[0].sum[d] += l[1].sum[d];
        l[0].left |= l[1].left;
        for (int p = 0; p < (TWO_ROWS ? 1 : COUNT); p++)
            end_lanes(&l[p], work, shape);
    }
}

INLINE void do_slices(const struct kr_kernel_work *work, struct shape shape, size_t begin,
                      size_t end) {
    for (size_t slice = begin; slice < end; slice++)
        work->flag[slice] = 0;
    for (size_t slice = begin; slice < end; slice++) {
        if (slice % 2 == 0 && work->bonds->twin[slice / 2])
            do_twins(work, shape, slice++);
        else
            do_slice(work, shape, slice);
    }
}

/* The common lengths of the polynomials, and the dimension, are made constants here. */
INLINE void do_dimension(const struct kr_kernel_work *work, enum what what, int dim, size_t begin,
                         size_t end) {
    const struct kr_fit *fit = fit_of(work->bonds);
    const int terms = what == ENERGY ? fit->store.terms : fit->pull.terms;
    if (terms == 4)
        do_slices(work, (struct shape){what, dim, 4, 0}, begin, end);
    else if (terms == 6)
        do_slices(work, (struct shape){what, dim, 6, 0}, begin, end);
    else if (terms == 8)
        do_slices(work, (struct shape){what, dim, 8, 0}, begin, end);
    else
        do_slices(work, (struct shape){what, dim, terms, 0}, begin, end);
}

INLINE void do_all(const struct kr_kernel_work *work, enum what what, size_t begin, size_t end) {
    if (work->bonds->dim == 2)
        do_dimension(work, what, 2, begin, end);
    else
        do_dimension(work, what, 3, begin, end);
}

static void force(const struct kr_kernel_work *work, size_t begin, size_t end) {
    do_all(work, FORCE, begin, end);
}

static void energy(const struct kr_kernel_work *work, size_t begin, size_t end) {
    do_all(work, ENERGY, begin, end);
}

static void product(const struct kr_kernel_work *work, size_t begin, size_t end) {
    do_all(work, PRODUCT, begin, end);
}

/* Chains that do not wait for each other: more than an operation takes cycles, times pipes. */
static double multiply_adds(size_t count) {
    enum { CHAINS = 12 };
    vector chain[CHAINS], factor = same(0.999), term = same(1e-3);
    for (int k = 0; k < CHAINS; k++)
        chain[k] = same(k);
    for (size_t done = 0; done < count; done += CHAINS * WIDTH)
        for (int k = 0; k < CHAINS; k++)
            chain[k] = chain[k] * factor + term;
    for (int k = 1; k < CHAINS; k++)
        chain[0] += chain[k];
    return (double)chain[0][0];
}

extern const struct kr_kernel KR_KERNEL;
const struct kr_kernel KR_KERNEL = {
    .name = KR_KERNEL_NAME, .force = force, .energy = energy, .product = product,
    .multiply_adds = multiply_adds};
