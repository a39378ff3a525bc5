/* SPDX-License-Identifier: BSD-3-Clause
 *
 * THE TIME LOOP: velocity-Verlet in its leapfrog form; theory.md (12).
 *
 *    v(n+1/2) = v(n-1/2) + dt f(n)/rho          kick (half a step at the start)
 *    u(n+1)   = u(n) + dt v(n+1/2)              drift
 *
 * which gives the same displacements as the usual form with one pass less over the nodes. The order
 * within a step: forces at u(n), break bonds, loads, records, kick and drift.
 */
#include "run.h"

#include "base/error.h"
#include "base/progress.h"
#include "interrupt.h"
#include "records.h"
#include "rest.h"
#include "watch.h"

#include <string.h>

/* When a stage that moves writes history and, in a run with stages, outputs. */
struct due {
    struct kr_schedule history, output;
};

static struct due due_of(const struct kr_run *run, const struct kr_stage *stage) {
    const struct kr_case *c = run->c;
    return (struct due){
        .history = kr_schedule_every(c->history_every > 0 ? c->history_every : 20 * stage->dt),
        .output = kr_schedule_of(c->output_every, &c->output_at)};
}

static int output_due(const struct kr_records *r, const struct due *due, long step, double t) {
    const struct kr_stage *stage = &r->run->stage[r->at.stage];
    if (!r->open)
        return kr_output_due(r->output, step);
    return r->at.event || step == 0 || step == stage->steps || kr_schedule_due(&due->output, t, stage->dt);
}

/* The first step of a later stage is the last of the one before, and recorded there. `resting`: a
 * relaxation ends at this step. */
static void record(struct kr_records *r, const struct due *due, long step, double t, int resting) {
    struct kr_run *run = r->run;
    const double dt = run->stage[r->at.stage].dt;
    int output = output_due(r, due, step, t) || resting;
    if ((!output && !kr_schedule_due(&due->history, t, dt)) || (step == 0 && r->at.stage > 0))
        return;
    int last = r->at.stage + 1 == run->n_stages && (step == run->stage[r->at.stage].steps || resting);
    kr_ledger_update(r->ledger, run->boundary[r->at.stage], run->body, r->crack, t, dt, step == 0);
    kr_watch_check(run->body, r->ledger, step, t, dt);
    kr_records_write(r, output, last, step, t);
}

/* Forces at time t of the stage, loads and damping included; bonds may break. Where two stages meet, what
 * is past s0 breaks in the second: the last half kick of the first is with the bond, the first half
 * kick of the second without it, as (13) has it within a stage. */
static void pull(struct kr_run *run, struct kr_records *r, const struct kr_stage *stage, long step,
                 double t) {
    struct kr_body *body = run->body;
    int meets_next = step == stage->steps && r->at.stage + 1 < run->n_stages;
    int breaks = stage->breaks && !meets_next;
    kr_body_force(body, breaks);
    if (breaks && step == 0 && r->at.stage > 0 && body->broken.count)
        kr_body_force(body, 0);
    kr_boundary_push(run->boundary[r->at.stage], body, t);
    if (stage->damping > 0)
        kr_body_damp(body, stage->damping);
    if (breaks)
        kr_records_crack(r, step, t);
}

/* Velocities up to the time of the forces, where the next stage finds them. */
static void end_stage(struct kr_run *run, struct kr_records *r, long step, double t) {
    const size_t size = run->body->n * sizeof(double);
    for (int d = 0; d < run->body->dim; d++)
        memcpy(run->body->v[d], r->ledger->v[d], size);
    kr_records_next_stage(r, step, t);
}

static void end_relaxation(struct kr_rest *rest, const struct kr_stage *stage) {
    if (rest->residual > stage->tolerance)
        kr_warn("the relaxation ended before the body was at rest: residual %.1e, wanted %.1e; give it "
                "more end_time", rest->residual, stage->tolerance);
    kr_rest_free(rest);
}

/* THE TIME LOOP, over one stage. A relaxation (theory.md (27)) ends where the body rests. */
static void run_moving(struct kr_run *run, struct kr_records *r) {
    struct kr_body *body = run->body;
    const struct kr_stage *stage = &run->stage[r->at.stage];
    struct kr_boundary *boundary = run->boundary[r->at.stage];
    const struct due due = due_of(run, stage);
    const double dt = stage->dt;
    const long first = r->at.step;
    struct kr_progress progress = kr_progress_begin("steps", (double)first, (double)stage->steps);
    struct kr_rest *rest = stage->kind == KR_STAGE_RELAXATION ? kr_rest_create(body) : NULL;
    long step = first;
    if (first == 0)
        kr_boundary_start(boundary, body, dt);
    for (;; step++) {
        const double t = (double)step * dt;
        pull(run, r, stage, step, t);
        if (step == 0)
            kr_ledger_begin(r->ledger, boundary, body, r->crack, dt);
        else
            kr_ledger_step(r->ledger, boundary, body, t, dt);
        int resting = rest && kr_rest_step(rest, boundary, t, stage->end, stage->tolerance);
        record(r, &due, step, t, resting);
        if (step == stage->steps || resting)
            break;
        kr_boundary_hold(boundary, body, t, dt);
        kr_body_advance(body, step == 0 ? 0.5 * dt : dt, dt);
        kr_records_save(r, step + 1);
        kr_progress_show(&progress, (double)step,
                         "t %.4g us, %zu bonds broken, %.3g %s of work, of which %.1e unaccounted",
                         1e6 * (r->at.began + t), r->crack->count, r->ledger->external,
                         kr_ledger_unit(body->dim), r->ledger->balance);
    }
    kr_progress_end(&progress, (double)run->bonds->count * (double)(step - first + 1),
                    "directed bond updates");
    if (rest)
        end_relaxation(rest, stage);
    end_stage(run, r, step, (double)step * dt);
}

void kr_run_solve(struct kr_run *run, const char *deck_text, int resume) {
    struct kr_records r;
    int apart = 0;
    kr_records_open(&r, run, deck_text, resume);
    kr_interrupt_begin();
    while (r.at.stage < run->n_stages && !apart)
        if (run->stage[r.at.stage].kind == KR_STAGE_STATIC)
            apart = kr_run_static(run, &r);
        else
            run_moving(run, &r);
    kr_say("  energies at the end [%s]: external work %.4g = kinetic %.4g + strain %.4g + fracture "
           "%.4g, balance %.2e",
           kr_ledger_unit(run->body->dim), r.ledger->external, r.ledger->kinetic, r.ledger->strain,
           r.ledger->fracture, r.ledger->balance);
    kr_records_close(&r);
    kr_checkpoint_remove(run->c);
}
