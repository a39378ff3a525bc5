/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What a case leads to, told without running it: constants, speeds, memory, time.
 */
#include "run.h"

#include "base/error.h"
#include "base/machine.h"
#include "base/memory.h"
#include "base/progress.h"
#include "crack.h"
#include "equilibrium.h"
#include "ledger.h"
#include "stress.h"
#include "topology.h"
#include "wave.h"

/* Seconds of one step, from a few. */
static double step_time(struct kr_body *body) {
    enum { TRIES = 5 };
    double begun = kr_progress_clock();
    for (int k = 0; k < TRIES; k++)
        kr_body_force(body, 0);
    return (kr_progress_clock() - begun) / TRIES;
}

/* ---- memory ---- */

static int at_once(void *nothing) {
    (void)nothing;
    return 1;
}

/* What statics.c holds, up to the first product with the stiffness, when all of the ladder of grids is there. */
static void rehearse_static(struct kr_run *run, size_t stage) {
    enum { VECTORS = 4 }; /* of struct statics, and in the records the equilibrium before */
    struct kr_equilibrium *q = kr_equilibrium_create(run->body);
    double *room[VECTORS][3];
    for (int k = 0; k < VECTORS; k++)
        for (int d = 0; d < run->body->dim; d++)
            room[k][d] = kr_bonds_padded(run->body->n);
    q->tolerance = run->stage[stage].tolerance;
    q->quiet = 1;
    q->stop = at_once;
    kr_rest_loads(q->rest, run->boundary[stage], run->stage[stage].end);
    kr_boundary_way(run->boundary[stage], run->body, 0, run->stage[stage].end, q->move);
    kr_equilibrium_find(q);
    for (int k = 0; k < VECTORS; k++)
        for (int d = 0; d < run->body->dim; d++)
            kr_bonds_padded_free(room[k][d]);
    kr_equilibrium_free(q);
}

/* Hold for a moment what a run holds beside the body (records.c, output.c), so that the system can tell the peak: no
 * formula stays true for long. */
static void rehearse(struct kr_run *run) {
    size_t corners;
    struct kr_crack *crack = kr_crack_create(run->bonds, run->c->damage_threshold);
    struct kr_ledger *ledger = kr_ledger_create(run->body);
    double *row = KR_NEW(double, run->nodes->n *KR_TENSOR);
    if (run->nodes->n_points)
        kr_free(kr_topology_make(run->nodes, &corners));
    for (size_t k = 0; k < run->n_stages; k++)
        if (run->stage[k].kind == KR_STAGE_STATIC)
            rehearse_static(run, k);
    kr_free(row);
    kr_ledger_free(ledger);
    kr_crack_free(crack);
}

void kr_run_explain(struct kr_run *run) {
    const struct kr_material *m = &run->bonds->material;
    struct kr_wave wave =
        kr_wave_speeds(m->youngs_modulus, m->poissons_ratio, m->density, (enum kr_model)m->model);
    char model[32], profile[32];
    kr_case_word(KR_MODEL_WORDS, m->model, model);
    kr_case_word(KR_MICROMODULUS_WORDS, m->profile, profile);
    kr_say("  law %s, %s: Poisson's ratio of the model %.4g, %s micromodulus c %.5g N/m^%d",
           m->law->name, model, m->poissons_ratio, profile, m->micromodulus,
           m->model == KR_SOLID ? 6 : 5);
    kr_say("  critical stretch s0 %.5g, horizon over spacing m = %.3g", m->critical_stretch,
           m->horizon / run->nodes->spacing);
    kr_say("  wave speeds: longitudinal %.1f, shear %.1f, Rayleigh %.1f m/s", wave.longitudinal,
           wave.shear, wave.rayleigh);
    double seconds = step_time(run->body) * 1.1 * (double)run->steps;
    rehearse(run);
    kr_say("  memory %.0f MiB at the most, of %.0f MiB; about %.0f s for %ld steps", kr_machine_peak() / 1048576,
           kr_machine_memory() / 1048576, seconds, run->steps);
}
