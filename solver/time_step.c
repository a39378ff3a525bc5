/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Power iteration: u <- -f(u)/rho, scaled; the Rayleigh quotient -sum V f.u/(rho sum V u.u) grows
 * towards omega_max^2. Velocity-Verlet is stable for steps below 2/omega_max.
 */
#include "time_step.h"

#include "base/error.h"
#include "wave.h"

#include <math.h>
#include <string.h>

enum { MOST_ITERATIONS = 100 };

/* The quotient's change per iteration at which it is taken as found; it then still lacks well below
 * 1 %, which the safety factor covers. */
static const double ENOUGH = 2e-4;

static double square_of_node(const void *context, size_t i) {
    const struct kr_body *body = context;
    double sum = 0;
    for (int d = 0; d < body->dim; d++)
        sum += body->u[d][i] * body->u[d][i];
    return sum * body->bonds->volume[i];
}

static double force_of_node(const void *context, size_t i) {
    const struct kr_body *body = context;
    double sum = 0;
    for (int d = 0; d < body->dim; d++)
        sum -= body->u[d][i] * body->force[d][i];
    return sum * body->bonds->volume[i];
}

/* A start that holds all wavelengths: signs drawn by a hash of the node's number. */
static void start(struct kr_body *body, double size) {
    for (size_t i = 0; i < body->n; i++)
        for (int d = 0; d < body->dim; d++) {
            uint64_t h = (i * 3 + (uint64_t)d + 1) * UINT64_C(0x9E3779B97F4A7C15);
            h = (h ^ (h >> 29)) * UINT64_C(0xBF58476D1CE4E5B9);
            body->u[d][i] = h >> 63 ? size : -size;
        }
}

static double classical_of(const struct kr_bonds *b) {
    double largest = 0;
#pragma omp parallel for reduction(max : largest)
    for (size_t slice = 0; slice < b->n_slices; slice++) {
        struct kr_bond_walk walk = kr_bonds_walk(b, slice);
        struct kr_bond bond;
        double sum[KR_LANES] = {0};
        while (kr_bonds_next(b, &walk, &bond))
            sum[bond.lane] += kr_material_micromodulus(&b->material, bond.length) * bond.weight *
                              b->volume[bond.j] * 0.5 * (b->factor[bond.i] + b->factor[bond.j]) / bond.length;
        for (int lane = 0; lane < KR_LANES; lane++)
            largest = fmax(largest, sum[lane]);
    }
    return sqrt(2 * b->material.density / largest);
}

struct kr_time_step kr_time_step_find(struct kr_body *body, double spacing) {
    const struct kr_material *m = &body->bonds->material;
    struct kr_time_step found = {.classical = classical_of(body->bonds)};
    /* So small that geometry stays linear to 1e-9, so large that nothing underflows. */
    double size = 1e-9 * spacing, before = 0, quotient = 0;
    start(body, size);
    while (found.iterations < MOST_ITERATIONS) {
        kr_body_force(body, 0);
        double norm = kr_body_sum(body->n, square_of_node, body);
        quotient = kr_body_sum(body->n, force_of_node, body) / (m->density * norm);
        found.iterations++;
        if (found.iterations > 10 && quotient - before < ENOUGH * quotient)
            break;
        before = quotient;
        /* The next vector, at about the size of the first: |f| is near rho omega^2 |u|. */
        double scale = 1 / (m->density * quotient);
        for (int d = 0; d < body->dim; d++)
            for (size_t i = 0; i < body->n; i++)
                body->u[d][i] = -scale * body->force[d][i];
    }
    if (!(quotient > 0) || !isfinite(quotient))
        kr_stop(KR_EXIT_NUMBERS, "no highest frequency found (its square is %g); look for nodes "
                                 "without bonds or a material without stiffness", quotient);
    for (int d = 0; d < body->dim; d++) {
        memset(body->u[d], 0, body->n * sizeof(double));
        memset(body->force[d], 0, body->n * sizeof(double));
    }
    found.frequency = sqrt(quotient);
    found.stable = 2 / found.frequency;
    struct kr_wave wave =
        kr_wave_speeds(m->youngs_modulus, m->poissons_ratio, m->density, (enum kr_model)m->model);
    found.courant = spacing / wave.longitudinal;
    return found;
}
