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
 * the polynomials of fit.h in t = scale e - shift. q has no cancellation, however small the stretch.
 *
 *   xi    bond vector at rest [m]        eta   difference of displacements [m]
 *   keep  all bits set in the lanes whose bond lives
 *   v_ij  difference of directions, v_j - v_i
 *
 * Lattice slices go by pairs, for the two of a pair have the same rows; other slices go two rows at a
 * time where a vector spans a slice. What comes next is fetched into the caches by hand: the processor
 * does not guess it from so many streams (docs/performance.md).
 *
 * Damage costs nothing here: the loop only notes that some bond of a slice left the range, and
 * exact.c does that slice again, bond by bond. The readable form of this loop is there, too.
 *
 * Mixed precision (KR_FLOAT): what is made of the differences is float, and so are the sums over a
 * family. A displacement is the sum of two floats there (kr_rounded), so that its differences are as
 * good as those of doubles rounded to float, without the cost of conversions: the difference of the
 * high parts is exact where they are close, and else not small. Positions are whole numbers modulo
 * 2^32, whose differences are exact within a family.
 * How fast: docs/performance.md.
 */
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

/* Nodes, and lengths, to fetch ahead. */
enum { NODES_AHEAD = 2 * KR_PAIR, LENGTHS_AHEAD = 512 };

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

/* ---- lattice slices ---- */

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

/* ---- general slices ---- */

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

/* ---- all slices ---- */

INLINE void do_slices(const struct kr_kernel_work *work, struct shape shape, size_t begin,
                      size_t end) {
    const struct kr_bonds *b = work->bonds;
    struct shape whole = shape;
    whole.whole = 1;
    for (size_t slice = begin; slice < end; slice++)
        if (!b->lattice[slice])
            do_general(work, shape, slice);
        else if (b->twin[slice / 2])
            do_pair(work, whole, slice++);
        else
            do_pair(work, shape, slice++);
}

/* The common lengths of the polynomials, and the dimension, are made constants here. */
INLINE void do_dimension(const struct kr_kernel_work *work, enum what what, int dim, size_t begin,
                         size_t end) {
    const struct kr_fit *fit = fit_of(work->bonds);
    const int terms = what == ENERGY ? fit->store.terms : fit->pull.terms;
#ifdef KR_FLOAT
    enum { USUAL = 4, SHORT = 3 };
#else
    enum { USUAL = 7, SHORT = 6 };
#endif
    if (terms == USUAL)
        do_slices(work, (struct shape){.what = what, .dim = dim, .terms = USUAL}, begin, end);
    else if (terms == SHORT)
        do_slices(work, (struct shape){.what = what, .dim = dim, .terms = SHORT}, begin, end);
    else
        do_slices(work, (struct shape){.what = what, .dim = dim, .terms = terms}, begin, end);
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
