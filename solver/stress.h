/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Stress and strain of a node, from its living bonds; theory.md (29), (30). For looking at: the motion
 * needs neither.
 */
#ifndef KR_STRESS_H
#define KR_STRESS_H

#include "body.h"

/** Components of a symmetric tensor in the order of XDMF: xx, xy, xz, yy, yz, zz; those along z are 0 in
 *  a plate. */
enum { KR_TENSOR = 6 };

/** Stress [Pa] of the nodes of one slice: what their bonds carry across a cut, per area (the virial),
 *
 *    sigma_i = 1/2 sum over j of V_j f_ij (xi + eta)                                           (29)
 *
 *  f_ij: force density of the bond on i per volume of j. Positive in tension. The energy is right by
 *  construction: half of sigma times a uniform small strain is the strain energy density.
 */
void kr_stress_slice(const struct kr_body *body, size_t slice, double stress[KR_LANES][KR_TENSOR]);

/** Strain of the nodes of one slice: of the displacement gradient G that fits the neighbours best,
 *
 *    G = (sum of phi V eta xi) (sum of phi V xi xi)^-1 ,   strain = (G + G^T + G^T G)/2        (30)
 *
 *  Exact for any uniform deformation, 0 for any rotation; NaN where too few bonds live to tell it.
 */
void kr_strain_slice(const struct kr_body *body, size_t slice, double strain[KR_LANES][KR_TENSOR]);

#endif
