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
#include "checkpoint.h"
#include "crack.h"
#include "interrupt.h"
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
    struct kr_schedule history_due;
    struct kr_checkpoint at;
    double saved; /* clock of the last checkpoint */
};

/* Returns the step to begin with. */
static long records_open(struct kr_run *run, const char *deck_text, int resume,
                         struct records *r) {
    const struct kr_case *c = run->c;
    char *path = kr_case_file(c, "history.csv");
    *r = (struct records){
        .crack = kr_crack_create(run->bonds, c->damage_threshold),
        .ledger = kr_ledger_create(run->body),
        .history_due = kr_schedule_every(c->history_every > 0 ? c->history_every : 20 * run->dt),
        .saved = kr_progress_clock(),
    };
    r->at = (struct kr_checkpoint){.steps = run->steps,
                                   .dt = run->dt,
                                   .deck_text = deck_text,
                                   .body = run->body,
                                   .ledger = r->ledger,
                                   .crack = r->crack};
    if (resume) {
        kr_checkpoint_read(c, &r->at);
        kr_say("  resumed at step %ld, t = %.4g us", r->at.step, 1e6 * (double)r->at.step * run->dt);
    } else {
        kr_checkpoint_remove(c);
        kr_boundary_start(run->boundary, run->body, run->dt);
    }
    r->output =
        kr_output_create(c, run->nodes, run->bonds, run->dt, run->steps, resume, deck_text);
    r->history = kr_history_open(path, run->boundary, run->body->dim, r->at.history);
    kr_free(path);
    return r->at.step;
}

static void records_close(struct records *r) {
    kr_output_free(r->output);
    kr_history_close(r->history);
    kr_crack_free(r->crack);
    kr_ledger_free(r->ledger);
}

static void record(struct kr_run *run, struct records *r, long step, double t) {
    int output = kr_output_due(r->output, step);
    if (!output && !kr_schedule_due(&r->history_due, t, run->dt))
        return;
    kr_ledger_update(r->ledger, run->boundary, run->body, r->crack, t, run->dt, step == 0);
    kr_history_write(r->history, r->ledger, run->boundary, r->crack, step, t);
    kr_watch_check(run->body, r->ledger, step, t, run->dt);
    if (output)
        kr_output_write(r->output, run->body, r->ledger, r->crack, step, t);
}

/* A checkpoint before the step `next`, where time or a signal asks for one; stops where asked to. */
static void save(const struct kr_run *run, struct records *r, long next) {
    enum kr_interrupt asked = kr_interrupt_asked();
    double every = run->c->checkpoint_every, now = kr_progress_clock();
    if (asked == KR_INTERRUPT_NONE && !(every > 0 && now - r->saved >= every))
        return;
    r->at.step = next;
    r->at.history = kr_history_bytes(r->history);
    kr_checkpoint_write(run->c, &r->at);
    r->saved = now;
    if (asked == KR_INTERRUPT_STOP)
        kr_stop(KR_EXIT_SIGNAL,
                "stopped by a signal before step %ld of %ld; all is in %s/checkpoint.h5: go on with "
                "the same command (kirsch), or kirsch-solve --resume",
                next, run->steps, run->c->folder);
}

void kr_run_solve(struct kr_run *run, const char *deck_text, int resume) {
    struct kr_body *body = run->body;
    struct records r;
    const long first = records_open(run, deck_text, resume, &r);
    const char *energy = kr_ledger_unit(body->dim);
    struct kr_progress progress =
        kr_progress_begin("steps", (double)first, (double)run->steps);
    kr_interrupt_begin();
    for (long step = first;; step++) {
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
        save(run, &r, step + 1);
        kr_progress_show(&progress, (double)step,
                         "t %.4g us, %zu bonds broken, %.3g %s of work, balance %.1e", 1e6 * t,
                         r.crack->count, r.ledger->external, energy, r.ledger->balance);
    }
    kr_progress_end(&progress, (double)run->bonds->count * (double)(run->steps - first + 1),
                    "directed bond updates");
    kr_say("  energies at the end [%s]: external work %.4g = kinetic %.4g + strain %.4g + fracture "
           "%.4g, balance %.2e",
           energy, r.ledger->external, r.ledger->kinetic, r.ledger->strain, r.ledger->fracture,
           r.ledger->balance);
    records_close(&r);
    kr_checkpoint_remove(run->c);
}
