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
 * What one row of bonds adds is in kernel_row.h; which rows there are, in kernel_lattice.h and
 * kernel_general.h; vectors, in kernel_vector.h. Here: all slices.
 *
 * Damage costs nothing here: the loop only notes that some bond of a slice left the range, and
 * exact.c does that slice again, bond by bond. The readable form of this loop is there, too.
 *
 * How fast: docs/performance.md.
 */
#include "kernel_general.h"
#include "kernel_lattice.h"

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
