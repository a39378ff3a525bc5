/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The loop over bonds in its readable form, one bond after the other with the law itself. It serves
 * where the fast loop (kernel.c) gives up: slices with a bond past the critical stretch. Tests hold
 * the fast loop against it.
 */
#ifndef KR_EXACT_H
#define KR_EXACT_H

#include "kernel.h"

/** A bond that broke. */
struct kr_broken {
    int i, j;      /* i < j once both ends were brought together */
    double weight; /* phi as seen from i */
    double energy; /* J/m, in 3D J: what the pair held when it broke; of one end: half of it */
};

/** A growing list of them. */
struct kr_broken_list {
    size_t count, room;
    struct kr_broken *item;
};

/** Stretch s of a bond under the displacements u [m]. */
double kr_exact_stretch(const struct kr_bonds *bonds, const struct kr_bond *bond,
                        const double *const u[3]);

/** Energy of the pair [J/m, in 3D J]: V_i V_j w_ij c |xi| energy(s). */
double kr_exact_pair_energy(const struct kr_bonds *bonds, const struct kr_bond *bond, double stretch);

/** Force density [N/m^3] of the nodes of one slice; theory.md (7), plates paper eq. 11. */
void kr_exact_force(const struct kr_kernel_work *work, size_t slice);

/** Strain energy density [J/m^3] of the nodes of one slice; theory.md (8). */
void kr_exact_energy(const struct kr_kernel_work *work, size_t slice);

/** Derivative of the force density in the direction v [N/m^3]; theory.md (8a). */
void kr_exact_product(const struct kr_kernel_work *work, size_t slice);

/** Break the bonds of one slice that are past the critical stretch, but for those of no-fail nodes:
 *  clears this end's bit and adds (i, j) to the list. The other end is its own slice's business.
 *
 *  To be called after kr_exact_force: half the pull of a breaking bond is taken off again. The kick
 *  of this step ends one half step, in which the bond still held, and begins the next, in which it is
 *  gone. With this the energy that a bond takes along is just what it held when it broke, and the
 *  ledger closes to second order in the time step; theory.md (13).
 */
void kr_exact_break(struct kr_bonds *bonds, const struct kr_kernel_work *work, size_t slice,
                    struct kr_broken_list *list);

#endif
