/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A body in motion: displacements, velocities, forces and energies of all nodes.
 */
#ifndef KR_BODY_H
#define KR_BODY_H

#include "exact.h"

struct kr_body {
    struct kr_bonds *bonds;  /* not owned */
    const struct kr_kernel *kernel;
    int dim;
    size_t n;
    double *u[3];      /* m */
    double *v[3];      /* m/s; half a step behind during the time loop, see run.c */
    double *force[3];  /* N/m^3, internal and body forces together */
    double *energy;    /* J/m^3, strain energy density as of the last kr_body_energy */
    unsigned char *flag;
    struct kr_rounded *rounded;      /* of u; NULL unless the precision is mixed */
    struct kr_broken_list broken;    /* of the last kr_body_force, each pair once, i < j, sorted */
    struct kr_broken_list *by_block; /* room of the threads */
};

/** A body at rest. Does not own the bonds. */
struct kr_body *kr_body_create(struct kr_bonds *bonds);
void kr_body_free(struct kr_body *body);

/** From now on the loop over bonds works in mixed precision (kernel.h). */
void kr_body_mix(struct kr_body *body);

/** Internal force density of every node at the displacements u; theory.md (7), plates paper eq. 11.
 *
 *  may_break: then break the bonds past the critical stretch (they pull with half their force in
 *  this step, see exact.h); they are listed in body->broken, both ends are cleared and the damage
 *  is up to date.
 *
 *  Threads: one slice is summed by one thread, in a fixed order: same bits for any number.
 */
void kr_body_force(struct kr_body *body, int may_break);

/** Strain energy density of every node into body->energy; returns the total [J/m, in 3D J]. */
double kr_body_energy(struct kr_body *body);

/** Derivative of the internal force density at the displacements u in a direction; theory.md (8a):
 *
 *    product_i = d/dh f_i(u + h v) at h = 0 = (J v)_i ,    V_i J_ij = V_j J_ji
 *
 *  in   v        m, dim arrays of kr_bonds_padded
 *  out  product  N/m^3, dim arrays of kr_bonds_padded, overwritten; not v
 *  Bonds neither break nor heal. Threads: as kr_body_force.
 */
void kr_body_product(struct kr_body *body, double *const v[], double *const product[]);

/** v += kick * force/rho, then u += drift * v, for all nodes; times in s; theory.md (12). Nobody
 *  changes u between this and the next force, energy or product: in mixed precision they take it as
 *  it was rounded here. */
void kr_body_advance(struct kr_body *body, double kick, double drift);

/** force -= damping rho v, damping [1/s]; theory.md (27). */
void kr_body_damp(struct kr_body *body, double damping);

/** Whether a living bond that may break is past the critical stretch, as of the last kr_body_force
 *  that broke none. */
int kr_body_overstretched(const struct kr_body *body);

/** Sum of term(context, i) over all nodes, by a fixed tree: same bits for any number of threads. */
double kr_body_sum(size_t n, double (*term)(const void *context, size_t i), const void *context);

#endif
