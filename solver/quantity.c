/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The table of fields. See quantity.h.
 */
#include "quantity.h"

#include <string.h>

static const char *const scalar[] = {""}, *const vector[] = {"_x", "_y", "_z"},
                         *const tensor[] = {"_xx", "_xy", "_xz", "_yy", "_yz", "_zz"};

const struct kr_quantity_kind kr_quantities[KR_QUANTITIES] = {
    {"Displacement", "m", 3, "Vector", vector},
    {"Velocity", "m/s", 3, "Vector", vector},
    {"Damage", "1", 1, "Scalar", scalar},
    {"Stored_Elastic_Energy_Density", "J/m^3", 1, "Scalar", scalar},
    {"Stress", "Pa", KR_TENSOR, "Tensor6", tensor},
    {"Strain", "1", KR_TENSOR, "Tensor6", tensor},
};

int kr_quantity_has(int field, int k, int dim) {
    return k < kr_quantities[field].components && (dim == 3 || !strchr(kr_quantities[field].suffix[k], 'z'));
}

/* Nodes of a slice: the last one may be shorter. */
static size_t lanes_of(const struct kr_body *body, size_t slice) {
    size_t left = body->n - slice * KR_LANES;
    return left < KR_LANES ? left : KR_LANES;
}

void kr_quantity_slice(int field, const struct kr_body *body, double *const v[3], size_t slice,
                    double value[KR_LANES][KR_TENSOR]) {
    if (field == KR_QUANTITY_STRESS) {
        kr_stress_slice(body, slice, value);
        return;
    }
    if (field == KR_QUANTITY_STRAIN) {
        kr_strain_slice(body, slice, value);
        return;
    }
    memset(value, 0, sizeof(double[KR_LANES][KR_TENSOR]));
    for (size_t lane = 0; lane < lanes_of(body, slice); lane++) {
        size_t i = slice * KR_LANES + lane;
        if (field == KR_QUANTITY_DAMAGE)
            value[lane][0] = kr_bonds_damage(body->bonds, i);
        else if (field == KR_QUANTITY_ENERGY)
            value[lane][0] = body->energy[i];
        else
            for (int d = 0; d < body->dim; d++)
                value[lane][d] = field == KR_QUANTITY_VELOCITY ? v[d][i] : body->u[d][i];
    }
}
