/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Checks of a case's material: the law is known, and the constants are those of a solid. A unit that is
 * wrong by a thousand shows in the speed of its waves and in the stretch at which bonds break, whatever
 * the scale of the body is.
 */
#include "material/material.h"
#include "case_check.h"
#include "wave.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* m/s. Diamond, the fastest solid, has 18 000. */
static const double fastest_wave = 25e3;

/* The law is one of small strains, as is the calibration of s0: (6). Brittle solids have 1e-4 to 2e-2. */
static const double largest_stretch = 0.1;

static void check_law(struct kr_deck *deck, const struct kr_case *c) {
    char known[256] = "";
    if (!c->law || kr_law_named(c->law))
        return;
    for (size_t k = 0; k < kr_laws_count; k++) {
        size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s", k ? ", " : "", kr_laws[k]->name);
    }
    kr_deck_fault(deck, &c->law, "unknown law '%.40s'; there is %s", c->law, known);
}

/* Bonds leave no choice: 1/3 or 1/4, written with as few digits as people do. */
static void check_poisson(struct kr_deck *deck, const struct kr_case *c) {
    double own = c->model == KR_PLANE_STRESS ? 1.0 / 3 : 1.0 / 4;
    if (kr_deck_given(deck, &c->poissons_ratio) && fabs(c->poissons_ratio - own) > 0.005)
        kr_deck_fault(deck, &c->poissons_ratio,
                      "found %g, but bonds make it %.4g in this model; leave it out, and compare with "
                      "others at that value", c->poissons_ratio, own);
}

static void check_waves(struct kr_deck *deck, const struct kr_case *c) {
    double nu = c->model == KR_PLANE_STRESS ? 1.0 / 3 : 1.0 / 4;
    struct kr_wave wave = kr_wave_speeds(c->youngs_modulus, nu, c->density, (enum kr_model)c->model);
    if (!(wave.longitudinal <= fastest_wave))
        kr_deck_fault(deck, &c->youngs_modulus,
                      "%g Pa at a density of %g kg/m^3 gives waves of %.3g m/s, faster than in any "
                      "solid (diamond: 18000); look at the units of both",
                      c->youngs_modulus, c->density, wave.longitudinal);
}

static void check_stretch(struct kr_deck *deck, const struct kr_case *c) {
    double s0 = kr_material_of(c).critical_stretch;
    if (!isinf(s0) && !(s0 > 0 && s0 <= largest_stretch))
        kr_deck_fault(deck, &c->fracture_energy,
                      "%g J/m^2 with Young's modulus %g Pa and horizon %g m makes bonds break at a "
                      "stretch of %.3g, expected above 0 and at most %g (brittle solids have 0.0001 to 0.02): look at "
                      "the units, or take a larger horizon",
                      c->fracture_energy, c->youngs_modulus, c->horizon, s0, largest_stretch);
}

void kr_case_check_material(struct kr_deck *deck, const struct kr_case *c) {
    check_poisson(deck, c);
    check_law(deck, c);
    if (!(c->youngs_modulus > 0) || !(c->density > 0) || !(c->horizon > 0))
        return; /* a fault of the reader */
    check_waves(deck, c);
    if (c->law && kr_law_named(c->law))
        check_stretch(deck, c);
}
