/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The energy ledger. Velocities live half a step before the forces; at the time of the forces they
 * are v + dt/2 f/rho, or what is prescribed, and with these all terms are of second order in dt.
 */
#include "ledger.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

const char *kr_ledger_unit(int dim) {
    return dim == 2 ? "J/m" : "J";
}

struct kr_ledger *kr_ledger_create(const struct kr_body *body) {
    struct kr_ledger *ledger = KR_NEW(struct kr_ledger, 1);
    *ledger = (struct kr_ledger){.n = body->n, .dim = body->dim};
    for (int d = 0; d < body->dim; d++)
        ledger->v[d] = kr_bonds_padded(body->n);
    return ledger;
}

void kr_ledger_free(struct kr_ledger *ledger) {
    for (int d = 0; d < ledger->dim; d++)
        kr_bonds_padded_free(ledger->v[d]);
    kr_free(ledger);
}

void kr_ledger_step(struct kr_ledger *ledger, struct kr_boundary *boundary,
                    const struct kr_body *body, double t, double dt) {
    double power = kr_boundary_power(boundary, body, t, dt, 0);
    ledger->external += 0.5 * dt * (ledger->power + power);
    ledger->most_external = fmax(ledger->most_external, fabs(ledger->external));
    ledger->power = power;
}

struct motion {
    const struct kr_ledger *ledger;
    const struct kr_bonds *bonds;
};

static double kinetic_of_node(const void *context, size_t i) {
    const struct motion *m = context;
    double square = 0;
    for (int d = 0; d < m->ledger->dim; d++)
        square += m->ledger->v[d][i] * m->ledger->v[d][i];
    return 0.5 * m->bonds->material.density * m->bonds->volume[i] * square;
}

void kr_ledger_update(struct kr_ledger *ledger, struct kr_boundary *boundary, struct kr_body *body,
                      const struct kr_crack *crack, double t, double dt, int first) {
    const double half = first ? 0 : 0.5 * dt / body->bonds->material.density;
    for (int d = 0; d < body->dim; d++) {
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < body->n; i++)
            ledger->v[d][i] = body->v[d][i] + half * body->force[d][i];
    }
    kr_boundary_velocity(boundary, body, t, dt, first, ledger->v);
    struct motion motion = {ledger, body->bonds};
    ledger->kinetic = kr_body_sum(body->n, kinetic_of_node, &motion);
    ledger->strain = kr_body_energy(body);
    ledger->fracture = crack->energy;
    ledger->balance = ledger->external - ledger->kinetic - ledger->strain - ledger->fracture;
}

void kr_ledger_begin(struct kr_ledger *ledger, struct kr_boundary *boundary, struct kr_body *body,
                     const struct kr_crack *crack, double dt) {
    double before = ledger->balance; /* of the stages before */
    kr_ledger_update(ledger, boundary, body, crack, 0, dt, 1);
    ledger->external = ledger->kinetic + ledger->strain + ledger->fracture + before;
    ledger->most_external = fmax(ledger->most_external, fabs(ledger->external));
    ledger->power = kr_boundary_power(boundary, body, 0, dt, 1);
}

void kr_ledger_rest(struct kr_ledger *ledger, struct kr_body *body, const struct kr_crack *crack,
                    double work) {
    ledger->external += work;
    ledger->most_external = fmax(ledger->most_external, fabs(ledger->external));
    ledger->power = ledger->kinetic = 0;
    for (int d = 0; d < body->dim; d++)
        memset(ledger->v[d], 0, body->n * sizeof(double));
    ledger->strain = kr_body_energy(body);
    ledger->fracture = crack->energy;
    ledger->balance = ledger->external - ledger->strain - ledger->fracture;
}
