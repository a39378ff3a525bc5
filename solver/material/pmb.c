/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Prototype microelastic brittle material: a linear spring until it breaks.
 *
 *    F = c s ,  w = c |xi| s^2 / 2          theory.md (3); plates paper eq. 4 and 7
 *
 *    s   stretch, (|xi + eta| - |xi|)/|xi|
 */
#include "material/material.h"

static double force(double s) {
    return s;
}

static double energy(double s) {
    return 0.5 * s * s;
}

static double stiffness(double s) {
    (void)s;
    return 1;
}

const struct kr_law kr_law_pmb = {
    .name = "pmb",
    .text = "prototype microelastic brittle: linear in the stretch until it breaks",
    .force = force,
    .energy = energy,
    .stiffness = stiffness,
};
