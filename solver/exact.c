/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Bond by bond. See exact.h.
 *
 *   s = e/(1 + sqrt(1+e)),  e = eta . (2 xi + eta)/|xi|^2       theory.md (2), free of cancellation
 */
#include "exact.h"

#include "base/memory.h"

#include <math.h>

double kr_exact_stretch(const struct kr_bonds *b, const struct kr_bond *bond,
                        const double *const u[3]) {
    double q = 0;
    for (int d = 0; d < b->dim; d++) {
        double eta = u[d][bond->j] - u[d][bond->i];
        q += eta * (2 * bond->xi[d] + eta);
    }
    double e = q / (bond->length * bond->length);
    return e / (1 + sqrt(1 + e));
}

static double weight_of(const struct kr_bonds *b, const struct kr_bond *bond) {
    return 0.5 * (b->factor[bond->i] + b->factor[bond->j]) * bond->weight;
}

double kr_exact_pair_energy(const struct kr_bonds *b, const struct kr_bond *bond, double stretch) {
    const struct kr_material *m = &b->material;
    return b->volume[bond->i] * b->volume[bond->j] * weight_of(b, bond) *
           kr_material_micromodulus(m, bond->length) * bond->length * m->law->energy(stretch);
}

/* Force density of a bond on its node i. */
static void pair_force(const struct kr_kernel_work *work, const struct kr_bond *bond, double s,
                       double force[3]) {
    const struct kr_bonds *b = work->bonds;
    const struct kr_material *m = &b->material;
    double pull = kr_material_micromodulus(m, bond->length) * m->law->force(s) * weight_of(b, bond) *
                  b->volume[bond->j];
    for (int d = 0; d < b->dim; d++) {
        double eta = work->u[d][bond->j] - work->u[d][bond->i];
        force[d] = pull * (bond->xi[d] + eta) / (bond->length * (1 + s));
    }
}

void kr_exact_force(const struct kr_kernel_work *work, size_t slice) {
    const struct kr_bonds *b = work->bonds;
    struct kr_bond_walk walk = kr_bonds_walk(b, slice);
    struct kr_bond bond;
    double force[3];
    for (int d = 0; d < b->dim; d++)
        for (size_t i = slice * KR_LANES; i < slice * KR_LANES + KR_LANES; i++)
            work->force[d][i] = 0;
    while (kr_bonds_next(b, &walk, &bond)) {
        pair_force(work, &bond, kr_exact_stretch(b, &bond, work->u), force);
        for (int d = 0; d < b->dim; d++)
            work->force[d][bond.i] += force[d];
    }
}

void kr_exact_energy(const struct kr_kernel_work *work, size_t slice) {
    const struct kr_bonds *b = work->bonds;
    struct kr_bond_walk walk = kr_bonds_walk(b, slice);
    struct kr_bond bond;
    for (size_t i = slice * KR_LANES; i < slice * KR_LANES + KR_LANES; i++)
        work->energy[i] = 0;
    while (kr_bonds_next(b, &walk, &bond)) {
        double s = kr_exact_stretch(b, &bond, work->u);
        work->energy[bond.i] += 0.5 * kr_exact_pair_energy(b, &bond, s) / b->volume[bond.i];
    }
}

/* With the unit vector m along the stretched bond, of length L (1+s), the pull F changes along m by
 * F'(s) m.v/L and turns with the bond by F (v - (m.v) m)/(L (1+s)). */
static void pair_product(const struct kr_kernel_work *work, const struct kr_bond *bond, double s,
                         double product[3]) {
    const struct kr_bonds *b = work->bonds;
    const struct kr_material *m = &b->material;
    double c = kr_material_micromodulus(m, bond->length);
    double volume = c * weight_of(b, bond) * b->volume[bond->j] / bond->length;
    double v[3], unit[3], along = 0;
    for (int d = 0; d < b->dim; d++) {
        v[d] = work->v[d][bond->j] - work->v[d][bond->i];
        unit[d] = (bond->xi[d] + work->u[d][bond->j] - work->u[d][bond->i]) /
                  (bond->length * (1 + s));
        along += unit[d] * v[d];
    }
    for (int d = 0; d < b->dim; d++)
        product[d] = volume * (m->law->stiffness(s) * along * unit[d] +
                               m->law->force(s) / (1 + s) * (v[d] - along * unit[d]));
}

void kr_exact_product(const struct kr_kernel_work *work, size_t slice) {
    const struct kr_bonds *b = work->bonds;
    struct kr_bond_walk walk = kr_bonds_walk(b, slice);
    struct kr_bond bond;
    double product[3];
    for (int d = 0; d < b->dim; d++)
        for (size_t i = slice * KR_LANES; i < slice * KR_LANES + KR_LANES; i++)
            work->product[d][i] = 0;
    while (kr_bonds_next(b, &walk, &bond)) {
        pair_product(work, &bond, kr_exact_stretch(b, &bond, work->u), product);
        for (int d = 0; d < b->dim; d++)
            work->product[d][bond.i] += product[d];
    }
}

void kr_exact_break(struct kr_bonds *b, const struct kr_kernel_work *work, size_t slice,
                    struct kr_broken_list *list) {
    struct kr_bond_walk walk = kr_bonds_walk(b, slice);
    struct kr_bond bond;
    double force[3];
    while (kr_bonds_next(b, &walk, &bond)) {
        double s = kr_exact_stretch(b, &bond, work->u);
        if (!(s > b->material.critical_stretch) || b->no_fail[bond.i] || b->no_fail[bond.j])
            continue;
        b->living[bond.row] &= (uint8_t)~(1u << bond.lane);
        b->twin[slice / 2] = 0;
        pair_force(work, &bond, s, force);
        for (int d = 0; d < b->dim; d++)
            work->force[d][bond.i] -= 0.5 * force[d];
        KR_GROW(list->item, list->count, list->room);
        list->item[list->count++] = (struct kr_broken){
            (int)bond.i, (int)bond.j, bond.weight, 0.5 * kr_exact_pair_energy(b, &bond, s)};
    }
}
