/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The loop over all bonds, built from one source for several kinds of processors.
 */
#ifndef KR_KERNEL_H
#define KR_KERNEL_H

#include "bonds.h"

/** Node values as mixed precision reads them: u is high + low to 48 bits. Arrays with room for a
 *  pair of slices before and behind, as those of kr_bonds_padded. */
struct kr_rounded {
    float *high[3], *low[3]; /* m */
    float *factor, *volume;  /* lambda; m^2, in 3D m^3 */
    int32_t *place[3];       /* position in units, modulo 2^32: differences within a family are right */
    double unit;             /* m, 2^-30 of the horizon */
    int current;             /* high and low are those of u: kr_body_advance left them so */
};

/** What a kernel reads and writes, all arrays from kr_bonds_padded. */
struct kr_kernel_work {
    const struct kr_bonds *bonds;
    const double *u[3];     /* m */
    const struct kr_rounded *rounded; /* of u, for mixed precision */
    double *force[3];       /* N/m^3, written by `force` */
    double *energy;         /* J/m^3, written by `energy` */
    const double *v[3];     /* m, the direction of `product` */
    double *product[3];     /* N/m^3, written by `product` */
    unsigned char *flag;    /* (n_slices) set to 1 where some living bond's e is out of the range of
                               the polynomials (past the critical stretch, too): what was written
                               for that slice is worthless and the exact loop must do it again */
};

/** One build of the loop. The functions do slices begin to end - 1. */
struct kr_kernel {
    const char *name;
    void (*force)(const struct kr_kernel_work *work, size_t begin, size_t end);
    void (*energy)(const struct kr_kernel_work *work, size_t begin, size_t end);
    void (*product)(const struct kr_kernel_work *work, size_t begin, size_t end);
    /* Does `count` multiply-adds on numbers of the loop's kind, as fast as this processor can, and
       returns a number made of them; for kirsch-bench. */
    double (*multiply_adds)(size_t count);
};

/** The best build for this processor; the environment's KIRSCH_KERNEL (baseline, avx2, avx512) picks
 *  another one that it can run. Stops (exit 2) if it cannot. */
const struct kr_kernel *kr_kernel_best(void);

/** The same loop in mixed precision: differences of displacements as good as in double, what is made
 *  of them in float32; docs/performance.md. */
const struct kr_kernel *kr_kernel_mixed(void);

#endif
