/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Wave speeds; the equations stand in wave.h.
 */
#include "wave.h"

#include <math.h>

#include "base/error.h"

/** Rayleigh's equation, right side taken from left: negative from 0 (a root that is no wave) to the
 *  one root in (0, 1), then positive. */
static double rayleigh(double x, double ratio) {
    return (2 - x) * (2 - x) - 4 * sqrt(1 - x) * sqrt(1 - x * ratio);
}

/** The root by bisection: 60 halvings reach the last bit of a double. `ratio` = (c_s / c_l)^2. */
static double rayleigh_root(double ratio) {
    double lower = 0, upper = 1;
    for (int k = 0; k < 60; k++) {
        double middle = (lower + upper) / 2;
        if (rayleigh(middle, ratio) < 0)
            lower = middle;
        else
            upper = middle;
    }
    return (lower + upper) / 2;
}

struct kr_wave kr_wave_speeds(double youngs_modulus, double poissons_ratio, double density,
                              enum kr_model model) {
    double nu = poissons_ratio, square = youngs_modulus / density;
    double shear = square / (2 * (1 + nu));
    double longitudinal = model == KR_PLANE_STRESS ? square / (1 - nu * nu)
                                                   : square * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
    struct kr_wave wave;
    kr_assert(square > 0 && longitudinal > shear && shear > 0);
    wave.longitudinal = sqrt(longitudinal);
    wave.shear = sqrt(shear);
    wave.rayleigh = wave.shear * sqrt(rayleigh_root(shear / longitudinal));
    return wave;
}
