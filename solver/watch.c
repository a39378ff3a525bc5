/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The watch over a run. An unstable step doubles the energy within some tens of steps, so energies
 * that exceed what went in by a factor are caught long before numbers overflow.
 */
#include "watch.h"

#include "base/error.h"

#include <math.h>

/* The ledger closes to better than 1 % when all is well. */
static const double FAR_TOO_MUCH = 2;

static size_t worst_node(const struct kr_body *body) {
    size_t worst = 0;
    double most = -1;
    for (size_t i = 0; i < body->n; i++)
        for (int d = 0; d < body->dim; d++) {
            double speed = fabs(body->v[d][i]);
            if (!isfinite(speed) || !isfinite(body->u[d][i]))
                return i;
            if (speed > most) {
                most = speed;
                worst = i;
            }
        }
    return worst;
}

static _Noreturn void explode(const struct kr_body *body, const char *what, long step, double t,
                              double dt) {
    size_t i = worst_node(body);
    const struct kr_bonds *b = body->bonds;
    kr_stop(KR_EXIT_NUMBERS,
            "%s at step %ld, t = %.4g us, worst at node %zu (%.4g, %.4g) mm with speed %.3g m/s. "
            "Likely cause: the time step %.3g us is above the stable one; leave solver.time_step out "
            "or lower it or solver.safety_factor. Else check units of stiffness, density and loads",
            what, step, 1e6 * t, i, 1e3 * b->x[0][i], 1e3 * b->x[1][i], body->v[1][i], 1e6 * dt);
}

void kr_watch_check(const struct kr_body *body, const struct kr_ledger *ledger, long step,
                    double t, double dt) {
    double inside = ledger->kinetic + ledger->strain + ledger->fracture;
    if (!isfinite(inside) || !isfinite(ledger->external))
        explode(body, "an energy is not a number", step, t, dt);
    /* In the first steps the work is near zero and its quadrature coarse. */
    if (step > 50 && inside > FAR_TOO_MUCH * ledger->most_external && inside > 0)
        explode(body, "there is more than twice the energy that went in", step, t, dt);
}
