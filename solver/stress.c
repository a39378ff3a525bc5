/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Stress by the virial (Silling and Lehoucq 2008, their stress tensor averaged over a family), strain by
 * least squares over the family (the shape tensor of Silling et al. 2007). See stress.h.
 */
#include "stress.h"

#include <math.h>
#include <string.h>

static const int ROW[KR_TENSOR] = {0, 0, 0, 1, 1, 2}, COLUMN[KR_TENSOR] = {0, 1, 2, 1, 2, 2};

void kr_stress_slice(const struct kr_body *body, size_t slice, double stress[KR_LANES][KR_TENSOR]) {
    const struct kr_bonds *b = body->bonds;
    const struct kr_material *m = &b->material;
    const double *const u[3] = {body->u[0], body->u[1], body->u[2]};
    struct kr_bond_walk walk = kr_bonds_walk(b, slice);
    struct kr_bond bond;
    memset(stress, 0, sizeof(double[KR_LANES][KR_TENSOR]));
    while (kr_bonds_next(b, &walk, &bond)) {
        double s = kr_exact_stretch(b, &bond, u), y[3] = {0};
        double weight = 0.5 * (b->factor[bond.i] + b->factor[bond.j]) * bond.weight;
        double pull = 0.5 * weight * kr_material_micromodulus(m, bond.length) * m->law->force(s) *
                      b->volume[bond.j] / (bond.length * (1 + s));
        for (int d = 0; d < b->dim; d++)
            y[d] = bond.xi[d] + u[d][bond.j] - u[d][bond.i];
        for (int k = 0; k < KR_TENSOR; k++)
            stress[bond.lane][k] += pull * y[ROW[k]] * y[COLUMN[k]];
    }
}

/* ---- strain ---- */

/* The two sums of (30). */
struct family {
    double shape[3][3], moved[3][3];
};

/* Inverse by cofactors; 0 where bonds span too little: then the determinant is far below the product of
 * the diagonal, which bounds it. */
static int invert(int dim, double a[3][3], double inverse[3][3]) {
    const double least = 1e-6;
    if (dim == 2)
        a[2][2] = 1;
    double bound = a[0][0] * a[1][1] * a[2][2], determinant = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int p = (j + 1) % 3, q = (j + 2) % 3, r = (i + 1) % 3, s = (i + 2) % 3;
            inverse[i][j] = a[p][r] * a[q][s] - a[p][s] * a[q][r];
        }
    for (int j = 0; j < 3; j++)
        determinant += a[0][j] * inverse[j][0];
    if (!(determinant > least * bound))
        return 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            inverse[i][j] /= determinant;
    return 1;
}

static void strain_of(int dim, struct family *f, double strain[KR_TENSOR]) {
    double inverse[3][3], g[3][3] = {{0}};
    int known = invert(dim, f->shape, inverse);
    for (int i = 0; i < dim && known; i++)
        for (int j = 0; j < dim; j++)
            for (int k = 0; k < dim; k++)
                g[i][j] += f->moved[i][k] * inverse[k][j];
    for (int k = 0; k < KR_TENSOR; k++) {
        int i = ROW[k], j = COLUMN[k];
        strain[k] = i < dim && j < dim && !known ? NAN : 0.5 * (g[i][j] + g[j][i]);
        for (int l = 0; l < dim; l++)
            strain[k] += 0.5 * g[l][i] * g[l][j];
    }
}

void kr_strain_slice(const struct kr_body *body, size_t slice, double strain[KR_LANES][KR_TENSOR]) {
    const struct kr_bonds *b = body->bonds;
    struct kr_bond_walk walk = kr_bonds_walk(b, slice);
    struct kr_bond bond;
    struct family family[KR_LANES] = {0};
    while (kr_bonds_next(b, &walk, &bond)) {
        struct family *f = &family[bond.lane];
        double share = bond.weight * b->volume[bond.j];
        for (int i = 0; i < b->dim; i++)
            for (int j = 0; j < b->dim; j++) {
                f->shape[i][j] += share * bond.xi[i] * bond.xi[j];
                f->moved[i][j] +=
                    share * (body->u[i][bond.j] - body->u[i][bond.i]) * bond.xi[j];
            }
    }
    for (int lane = 0; lane < KR_LANES; lane++)
        strain_of(b->dim, &family[lane], strain[lane]);
}
