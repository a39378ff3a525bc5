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
#include "base/memory.h"
#include "base/progress.h"
#include "crack.h"
#include "ledger.h"
#include "output.h"
#include "schedule.h"
#include "watch.h"


/* What is recorded while the loop runs. */
struct records {
    struct kr_crack *crack;
    struct kr_ledger *ledger;
    struct kr_history *history;
    struct kr_output *output;
    struct kr_schedule history_due, output_due;
    struct kr_watch watch;
};

static struct records records_open(struct kr_run *run, const char *deck_text) {
    const struct kr_case *c = run->c;
    char *path = kr_case_file(c, "history.csv");
    struct records r = {
        .crack = kr_crack_create(run->bonds, c->damage_threshold),
        .ledger = kr_ledger_create(run->body),
        .history = kr_history_open(path, run->boundary, run->body->dim),
        .output = kr_output_create(c, run->nodes, run->bonds, run->dt, deck_text),
        .history_due = kr_schedule_every(c->history_every > 0 ? c->history_every : 20 * run->dt),
        .output_due = kr_schedule_of(c->output_every, &c->output_at),
    };
    kr_free(path);
    return r;
}

static void records_close(struct records *r, long steps) {
    kr_output_close(r->output, steps);
    kr_history_close(r->history);
    kr_crack_free(r->crack);
    kr_ledger_free(r->ledger);
}

static void record(struct kr_run *run, struct records *r, long step, double t) {
    int last = step == run->steps;
    int history = kr_schedule_due(&r->history_due, t, run->dt) | last;
    int output = kr_schedule_due(&r->output_due, t, run->dt) | last;
    if (!history && !output)
        return;
    kr_ledger_update(r->ledger, run->boundary, run->body, r->crack, t, run->dt, step == 0);
    kr_history_write(r->history, r->ledger, run->boundary, r->crack, step, t);
    kr_watch_check(&r->watch, run->body, r->ledger, step, t, run->dt);
    if (output)
        kr_output_write(r->output, run->body, r->ledger, r->crack, step, t);
}

void kr_run_solve(struct kr_run *run, const char *deck_text) {
    struct kr_body *body = run->body;
    struct records r = records_open(run, deck_text);
    struct kr_progress progress = kr_progress_begin("steps", (double)run->steps);
    kr_boundary_start(run->boundary, body, run->dt);
    for (long step = 0;; step++) {
        const double t = (double)step * run->dt;
        kr_body_force(body, 1);
        kr_boundary_push(run->boundary, body, t);
        kr_crack_record(r.crack, body, t);
        if (step == 0)
            kr_ledger_begin(r.ledger, run->boundary, body, r.crack, run->dt);
        else
            kr_ledger_step(r.ledger, run->boundary, body, t, run->dt);
        record(run, &r, step, t);
        if (step == run->steps)
            break;
        kr_boundary_hold(run->boundary, body, t, run->dt);
        kr_body_advance(body, step == 0 ? 0.5 * run->dt : run->dt, run->dt);
        kr_progress_show(&progress, (double)step,
                         "t %.4g us, %zu bonds broken, %.3g J/m of work, balance %.1e", 1e6 * t,
                         r.crack->count, r.ledger->external, r.ledger->balance);
    }
    kr_progress_end(&progress, (double)run->bonds->count * (double)(run->steps + 1),
                    "directed bond updates");
    kr_say("  energies at the end [J/m]: external work %.4g = kinetic %.4g + strain %.4g + fracture "
           "%.4g, balance %.2e", r.ledger->external, r.ledger->kinetic, r.ledger->strain,
           r.ledger->fracture, r.ledger->balance);
    records_close(&r, run->steps);
}
