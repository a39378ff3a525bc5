/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Surface correction: nodes near a surface have lost part of their family and are too soft.
 */
#ifndef KR_SURFACE_H
#define KR_SURFACE_H

#include "material/material.h"
#include "nodes.h"

struct kr_surface_report {
    int iterations;        /* 0 where the method does not iterate */
    double reference;      /* of a full family: W0 [J/m^3], V0 [m^2] or S0 [N/m^4] */
    double least, most;    /* of the factors */
    size_t least_at, most_at; /* their nodes */
    double residual;       /* largest |W_i/W0 - 1| after the last iteration */
    size_t worst_at;       /* its node */
};

/** Correct by any method; theory.md (11), (11a), (11b).
 *
 *  in   correction, partial_volume, deformation  enums of case.h; the deformation is for the energy
 *  out  nodes->factor, pairing, axis_factor
 *  Stops (exit 4) where a method has no factors for some node.
 */
struct kr_surface_report kr_surface_make(struct kr_nodes *nodes, const struct kr_material *material,
                                         int correction, int partial_volume, int deformation);

/** Take all factors away: 1 for each node. */
void kr_surface_clear(struct kr_nodes *nodes);

/** Factors lambda for which every node holds the energy of a full family under a uniform strain of
 *  1e-4; steps a to e of section 2 of the plates paper, theory.md (11):
 *
 *    W_i = sum_j (lambda_i + lambda_j)/2 w_ij ,  lambda_i <- lambda_i W0/W_i   until |W0/W_i - 1| < 1e-7
 *
 *  with W0 from a full family at a spacing of horizon/25.
 *
 *  in   partial_volume  enum kr_partial_volume
 *  in   deformation     enum kr_deformation
 *  out  nodes->factor
 *  Found by conjugate gradients where the weights are symmetric, by the iteration itself where not.
 *  Stops (exit 4) if it does not converge in 5000 iterations, or if a bond's mean factor is not positive.
 */
struct kr_surface_report kr_surface_correct(struct kr_nodes *nodes,
                                            const struct kr_material *material, int partial_volume,
                                            int deformation);

/** W0: strain energy density [J/m^3] of a full family at a spacing of horizon/25 under the uniform
 *  deformation; dim 2 or 3. */
double kr_surface_reference(const struct kr_material *material, int dim, int partial_volume,
                            int deformation);

/** Sum over that full family of phi V term(xi), xi [m] with z = 0 in 2D. */
double kr_surface_full_sum(const struct kr_material *material, int dim, int partial_volume,
                           double (*term)(const struct kr_material *, const double xi[3],
                                          const void *context),
                           const void *context);

/** Factors V0/V_i, to be averaged as 2 V0/(V_i + V_j); theory.md (11a). */
struct kr_surface_report kr_surface_volume(struct kr_nodes *nodes,
                                           const struct kr_material *material, int partial_volume);

/** Factors S0/S_i along each axis, to be taken along the bond by an ellipse; theory.md (11b). */
struct kr_surface_report kr_surface_force_density(struct kr_nodes *nodes,
                                                  const struct kr_material *material,
                                                  int partial_volume);

/** V0: area of the horizon's circle [m^2], volume of its sphere [m^3]. */
double kr_surface_full_volume(int dim, double horizon);

/** S0 [N/m^4]: what a full family at a spacing of horizon/25 pulls along an axis, both halves,
 *  strained along it. */
double kr_surface_full_pull(const struct kr_material *material, int dim, int partial_volume);

/** Families of many nodes take seconds: say so before they are looked for. */
void kr_surface_say_begun(const struct kr_nodes *nodes);

/** Fill in the least and largest factor. */
void kr_surface_extremes(const struct kr_nodes *nodes, struct kr_surface_report *report);

#endif
