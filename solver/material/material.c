/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The list of laws, and the constants that every law shares.
 *
 * c follows from the strain energy of a uniform strain, s0 from the energy of the bonds that cross a
 * unit of crack area; both integrals are checked by tests/property/constants.c.
 */
#include "material/material.h"

#include "base/error.h"

#include <math.h>
#include <string.h>

#define KR_LAW(name) extern const struct kr_law kr_law_##name;
#include "material/laws.h"
#undef KR_LAW

const struct kr_law *const kr_laws[] = {
#define KR_LAW(name) &kr_law_##name,
#include "material/laws.h"
#undef KR_LAW
};
const size_t kr_laws_count = sizeof kr_laws / sizeof kr_laws[0];

/* One row a model: c = micromodulus E/(pi delta^(dim + 1)), s0 = sqrt(stretch G0/(E delta)); first for
 * the constant, then for the conical profile. */
static const struct {
    int dim;
    double poissons_ratio, micromodulus[2], stretch[2];
} models[] = {
    [KR_PLANE_STRESS] = {2, 1.0 / 3, {9.0, 36.0}, {4.0 / 9 * M_PI, 5.0 / 9 * M_PI}},
    [KR_PLANE_STRAIN] = {2, 1.0 / 4, {48.0 / 5, 192.0 / 5}, {5.0 / 12 * M_PI, 25.0 / 48 * M_PI}},
    [KR_SOLID] = {3, 1.0 / 4, {12.0, 60.0}, {5.0 / 6, 1.0}},
};

const struct kr_law *kr_law_named(const char *name) {
    for (size_t k = 0; k < kr_laws_count; k++)
        if (!strcmp(kr_laws[k]->name, name))
            return kr_laws[k];
    return NULL;
}

/* The stretch at which a law's bond holds this energy, by bisection: energies grow with s. */
static double stretch_at(const struct kr_law *law, double energy) {
    double low = 0, high = 1;
    while (law->energy(high) < energy && high < 1e6)
        high *= 2;
    for (int k = 0; k < 200; k++) {
        double middle = 0.5 * (low + high);
        *(law->energy(middle) < energy ? &low : &high) = middle;
    }
    return high;
}

void kr_material_profile(struct kr_material *m, int profile) {
    double modulus = m->youngs_modulus;
    m->profile = profile;
    m->micromodulus = models[m->model].micromodulus[profile] * modulus /
                      (M_PI * pow(m->horizon, models[m->model].dim + 1));
    m->critical_stretch = INFINITY;
    if (m->fracture_energy > 0) {
        double linear = sqrt(models[m->model].stretch[profile] * m->fracture_energy /
                             (modulus * m->horizon));
        m->critical_stretch = stretch_at(m->law, 0.5 * linear * linear);
    }
}

struct kr_material kr_material_make(const struct kr_law *law, int model, double youngs_modulus,
                                    double density, double fracture_energy, double horizon) {
    struct kr_material m = {
        .law = law,
        .model = model,
        .youngs_modulus = youngs_modulus,
        .poissons_ratio = models[model].poissons_ratio,
        .density = density,
        .fracture_energy = fracture_energy,
        .horizon = horizon,
    };
    kr_material_profile(&m, KR_CONSTANT);
    return m;
}

struct kr_material kr_material_of(const struct kr_case *c) {
    const struct kr_law *law = kr_law_named(c->law);
    kr_assert(law); /* kr_case_check has seen to it */
    struct kr_material m = kr_material_make(law, c->model, c->youngs_modulus, c->density,
                                            c->fracture_energy, c->horizon);
    kr_material_profile(&m, c->micromodulus);
    return m;
}
