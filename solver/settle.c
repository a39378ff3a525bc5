/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Newton's method, and damped motion where it fails. See settle.h.
 */
#include "settle.h"

#include "base/error.h"
#include "base/progress.h"

#include <math.h>
#include <string.h>

enum { MOST_STEPS = 20000 };

/* Newton mostly ends quickly from here; motion needs some ten times the steps for each digit more. */
static const double NEARLY = 0.01;

static void stand_still(struct kr_body *body) {
    for (int d = 0; d < body->dim; d++)
        memset(body->v[d], 0, body->n * sizeof(double));
}

static void hold_supports(struct kr_equilibrium *q) {
    for (int d = 0; d < q->body->dim; d++)
        for (size_t i = 0; i < q->body->n; i++)
            if (q->rest->fixed[i] >> d & 1)
                q->body->force[d][i] = 0;
}

/* Damped motion, supports at rest, down to this residual; returns how many steps it took. */
static int relax(struct kr_equilibrium *q, double dt, double residual) {
    struct kr_progress progress = kr_progress_begin("relaxation", 0, 0);
    int k = 0;
    stand_still(q->body);
    for (; k < MOST_STEPS && kr_equilibrium_residual(q) >= residual; k++) {
        if (q->stop && q->stop(q->stop_with))
            break;
        kr_rest_damp(q->rest);
        hold_supports(q);
        kr_body_advance(q->body, k ? dt : 0.5 * dt, dt);
        if (!q->quiet)
            kr_progress_note(&progress, "  relaxation, step %d, residual %.1e", k, q->rest->residual);
    }
    kr_progress_wipe(&progress);
    stand_still(q->body);
    return k;
}

enum kr_equilibrium_end kr_settle(struct kr_equilibrium *q, double safe_step) {
    double nearly = NEARLY;
    while (kr_equilibrium_find(q) != KR_EQUILIBRIUM_FOUND && q->end != KR_EQUILIBRIUM_STOPPED) {
        if (nearly < 0.1 * q->tolerance)
            break;
        int steps = relax(q, KR_REST_STEP * safe_step, fmax(nearly, 0.5 * q->tolerance));
        if (!q->quiet)
            kr_say("  a snap: no equilibrium near by, %d steps of damped motion to a residual of %.1e", steps,
                   q->rest->residual);
        nearly *= 0.1;
    }
    return q->end;
}
