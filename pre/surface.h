/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Surface correction by the energy method.
 */
#ifndef KR_SURFACE_H
#define KR_SURFACE_H

#include "material/material.h"
#include "nodes.h"

struct kr_surface_report {
    int iterations;
    double reference;      /* W0, J/m^3 */
    double least, most;    /* of the factors */
    size_t least_at, most_at; /* their nodes */
    double residual;       /* largest |W_i/W0 - 1| after the last iteration */
};

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
 *  Stops (exit 4) if it does not converge in 1000 iterations, or if a bond's mean factor is not positive.
 */
struct kr_surface_report kr_surface_correct(struct kr_nodes *nodes,
                                            const struct kr_material *material, int partial_volume,
                                            int deformation);

/** W0: strain energy density [J/m^3] of a full family at a spacing of horizon/25 under the uniform
 *  deformation. */
double kr_surface_reference(const struct kr_material *material, int partial_volume,
                            int deformation);

#endif
