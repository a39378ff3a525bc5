/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Materials. A law says how hard a bond pulls at a stretch s and what energy it then holds; this is
 * all that a new material needs: one file like pmb.c and one line in laws.h. The
 * fast loop follows by itself, for it evaluates a polynomial fitted to the law (fit.h).
 */
#ifndef KR_MATERIAL_H
#define KR_MATERIAL_H

#include "case.h"

#include <stddef.h>

/** A bond law in units of the micromodulus c [N/m^5 in 2D, N/m^6 in 3D]: F = c * force(s) is the bond force
 *  density per volume squared, w = c |xi| energy(s) the micropotential, energy' = force. Near
 *  rest force(s) -> s, so that c alone fixes the elastic constants. Smooth for |s| <= s0. */
struct kr_law {
    const char *name;
    const char *text; /* one sentence for people */
    double (*force)(double s);
    double (*energy)(double s);
    double (*stiffness)(double s); /* force' */
};

/** All laws, and how many. */
extern const struct kr_law *const kr_laws[];
extern const size_t kr_laws_count;

/** The law of this name, NULL if there is none. */
const struct kr_law *kr_law_named(const char *name);

/** A law with its constants. */
struct kr_material {
    const struct kr_law *law;
    int model;            /* enum kr_model */
    double youngs_modulus;  /* Pa */
    double poissons_ratio;  /* the model's own: 1/3 or 1/4 */
    double density;         /* kg/m^3 */
    double fracture_energy; /* J/m^2; 0: does not break */
    double horizon;         /* m */
    double micromodulus;    /* c of the shortest bonds, N/m^5; 3D: N/m^6 */
    int profile;            /* enum kr_micromodulus: how c falls with the length of a bond */
    double critical_stretch; /* s0; infinite where it does not break */
};

/** Constants from the classical ones, with a constant micromodulus; theory.md (5) to (6d), plates
 *  paper eq. 6 and 9.
 *
 *    plane stress  nu = 1/3   c = 9 E/(pi delta^3)      s0 = sqrt(4 pi G0/(9 E delta))
 *    plane strain  nu = 1/4   c = 48 E/(5 pi delta^3)   s0 = sqrt(5 pi G0/(12 E delta))
 *    solid         nu = 1/4   c = 12 E/(pi delta^4)     s0 = sqrt(5 G0/(6 E delta))
 *
 *  for the linear law; for others s0 is where energy(s0) equals half the square of the linear one.
 */
struct kr_material kr_material_make(const struct kr_law *law, int model, double youngs_modulus,
                                    double density, double fracture_energy, double horizon);

/** Give the material the other profile (enum kr_micromodulus); c and s0 follow. Conical, (6e), (6f):
 *
 *    c(r) = c (1 - r/delta),   0 beyond
 *
 *    plane stress   c = 36 E/(pi delta^3)      s0 = sqrt(5 pi G0/(9 E delta))
 *    plane strain   c = 192 E/(5 pi delta^3)   s0 = sqrt(25 pi G0/(48 E delta))
 *    solid          c = 60 E/(pi delta^4)      s0 = sqrt(G0/(E delta))
 */
void kr_material_profile(struct kr_material *material, int profile);

/** c of a bond of this length [m]. */
static inline double kr_material_micromodulus(const struct kr_material *m, double length) {
    double share = m->profile == KR_CONICAL ? 1 - length / m->horizon : 1;
    return share > 0 ? m->micromodulus * share : 0;
}

/** The material of a case. */
struct kr_material kr_material_of(const struct kr_case *c);

#endif
