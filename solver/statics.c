/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A static stage: load step by load step to equilibrium; theory.md (24) to (26).
 *
 *   load step:  move the supports, find equilibrium
 *               while bonds are past s0:  break all of them, find equilibrium again
 *
 * The body goes from one equilibrium to the next without motion; what a crack sets free on the way is
 * lost, and stands in the balance of the ledger.
 */
#include "run.h"

#include "base/error.h"
#include "base/progress.h"
#include "held.h"
#include "interrupt.h"
#include "records.h"
#include "settle.h"

#include <math.h>
#include <string.h>

enum { MOST_ROUNDS = 1000000 };

/* Of the greatest pull so far: forces are measured by no less, or a body that is unloaded again would
 * never come to rest for rounding. */
static const double SLACK = 1e-3;

struct statics {
    struct kr_run *run;
    struct kr_records *r;
    const struct kr_stage *stage;
    struct kr_boundary *boundary;
    struct kr_equilibrium *q;
    double *before[3], *pull[3], *load[3]; /* u, force and loads where the search for equilibrium began */
    double work;                           /* J/m, since then */
    const char *over; /* why the run ends here; NULL while it goes on */
    int resumed; /* in the middle of a load step */
};

/* ---- equilibrium ---- */

static int is_interrupted(void *unused) {
    (void)unused;
    return kr_interrupt_pending();
}

static void copy(const struct kr_body *body, double *const from[3], double *const to[3]) {
    for (int d = 0; d < body->dim; d++)
        memcpy(to[d], from[d], body->n * sizeof(double));
}

/* Work of supports and loads on the way to this equilibrium, by the trapezoidal rule. */
static double work_of_node(const void *context, size_t i) {
    const struct statics *s = context;
    const struct kr_body *body = s->run->body;
    double sum = 0;
    for (int d = 0; d < body->dim; d++) {
        double way = body->u[d][i] - s->before[d][i];
        sum += s->q->rest->fixed[i] >> d & 1
                   ? -0.5 * (s->pull[d][i] + body->force[d][i]) * way
                   : 0;
        sum += 0.5 * (s->load[d][i] + s->q->rest->load[d][i]) * way;
    }
    return sum * body->bonds->volume[i];
}

/* Note where the body is, so that it can go back there. */
static void remember(struct statics *s) {
    kr_equilibrium_residual(s->q);
    copy(s->run->body, s->run->body->u, s->before);
    copy(s->run->body, s->run->body->force, s->pull);
    copy(s->run->body, s->q->rest->load, s->load);
}

static _Noreturn void give_up(const struct statics *s, double t) {
    kr_stop(KR_EXIT_NUMBERS,
            "no equilibrium at t = %.6g s of stage %zu: residual %.1e, wanted %.1e (%s). Smaller load "
            "steps may help, or a dynamic stage from here on; nodes that hang on few bonds are a "
            "likely cause", t, s->r->at.stage + 1, s->q->rest->residual, s->stage->tolerance,
            s->q->end == KR_EQUILIBRIUM_SNAP ? "no step lowers the energy" : "too slow");
}

/* Free components go on as from the equilibrium before the last to the last one, unless bonds broke there. */
static void guess(struct statics *s, double from, double t) {
    const struct kr_body *body = s->run->body;
    const struct kr_checkpoint *at = &s->r->at;
    const double last = from - at->rest_clock, share = last > 0 ? (t - from) / last : 0;
    for (int d = 0; d < body->dim; d++)
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < body->n; i++)
            s->q->move[d][i] = share * (body->u[d][i] - at->rest[d][i]);
}

/* The search that ended began at the equilibrium before this one. */
static void accept(struct statics *s, double from) {
    for (int d = 0; d < s->run->body->dim; d++) {
        double *swapped = s->r->at.rest[d];
        s->r->at.rest[d] = s->before[d];
        s->before[d] = swapped;
    }
    s->r->at.rest_clock = from;
}

/* Equilibrium with the loads of time t; a signal takes the body back to where it was, leaves a
 * checkpoint and ends the run. */
static void find(struct statics *s, long step, double from, double t) {
    struct kr_equilibrium *q = s->q;
    q->rest->least_pull = SLACK * s->r->at.most_pull;
    remember(s);
    kr_rest_loads(q->rest, s->boundary, t);
    guess(s, from, t);
    if (s->r->at.round == 0)
        kr_boundary_way(s->boundary, q->body, from, t, q->move);
    if (kr_settle(q, s->run->safe_step) != KR_EQUILIBRIUM_FOUND) {
        if (kr_interrupt_pending() == KR_INTERRUPT_STOP) {
            copy(q->body, s->before, q->body->u);
            kr_records_save(s->r, step);
        }
        give_up(s, t);
    }
    s->work = kr_body_sum(q->body->n, work_of_node, s);
}

/* ---- load steps ---- */

/* The next time of the deck's load steps after `clock`. */
static double next_time(const struct kr_stage *stage, double clock) {
    const struct kr_case_steps *steps = stage->load_steps->item;
    double t = 0;
    if (!stage->load_steps->count)
        return stage->end;
    for (size_t k = 0; k < stage->load_steps->count; k++)
        for (int64_t m = 1; m <= steps[k].count; m++) {
            double at = t + (double)m * steps[k].size;
            if (at > clock + 1e-9 * steps[k].size)
                return at;
            if (m == steps[k].count)
                t = at;
        }
    return stage->end;
}

/* Round 0 of a load step: to the next load, or, with least_step, only so far that at the most the last
 * and smallest part of it breaks the first bond. Returns the time reached. */
static double first_round(struct statics *s, long step) {
    const double clock = s->r->at.clock;
    double t = next_time(s->stage, clock);
    for (;;) {
        find(s, step, clock, t);
        if (!s->stage->breaks || s->stage->least_step <= 0 || s->r->crack->count ||
            t - clock <= s->stage->least_step * (1 + 1e-9) ||
            !kr_body_overstretched(s->run->body)) {
            accept(s, clock);
            return t;
        }
        copy(s->run->body, s->before, s->run->body->u);
        kr_rest_loads(s->q->rest, s->boundary, clock);
        t = clock + fmax(0.5 * (t - clock), s->stage->least_step);
    }
}

/* Break what is past s0; returns whether there was any. */
static int break_some(struct statics *s, long step) {
    kr_body_force(s->run->body, 1);
    if (!s->run->body->broken.count)
        return 0;
    kr_records_crack(s->r, step, s->r->at.clock);
    if (kr_held_apart(s->run->bonds, s->boundary))
        s->over = "has come apart";
    return !s->over;
}

/* Break bonds and find equilibrium again, until none breaks, or the body holds too little. A run that was stopped goes on behind the
 * breaking. */
static void break_bonds(struct statics *s, long step) {
    struct kr_checkpoint *at = &s->r->at;
    while (s->stage->breaks && at->round < MOST_ROUNDS) {
        if (!s->resumed) {
            if (!break_some(s, step))
                return;
            kr_records_save(s->r, step);
        }
        s->resumed = 0;
        find(s, step, at->clock, at->clock);
        accept(s, at->clock);
        kr_ledger_rest(s->r->ledger, s->run->body, s->r->crack, s->work);
        at->round++;
        if (s->q->rest->pull < s->stage->end_below * at->most_pull) {
            s->over = "holds less than end_below of the most it held";
            return;
        }
    }
    if (at->round == MOST_ROUNDS)
        kr_warn("bonds still break after %d rounds at t = %.6g s; the load step is left there",
                MOST_ROUNDS, at->clock);
}

static void begin(struct statics *s, struct kr_run *run, struct kr_records *r) {
    size_t node;
    *s = (struct statics){.run = run,
                          .r = r,
                          .stage = &run->stage[r->at.stage],
                          .boundary = run->boundary[r->at.stage],
                          .q = kr_equilibrium_create(run->body),
                          .resumed = r->at.round > 0};
    for (int d = 0; d < run->body->dim; d++) {
        s->before[d] = kr_bonds_padded(run->body->n);
        s->pull[d] = kr_bonds_padded(run->body->n);
        s->load[d] = kr_bonds_padded(run->body->n);
        memset(run->body->v[d], 0, run->body->n * sizeof(double));
    }
    s->q->tolerance = s->stage->tolerance;
    s->q->stop = is_interrupted;
    kr_rest_loads(s->q->rest, s->boundary, r->at.clock);
    const char *motion =
        r->crack->count ? NULL : kr_held_free_motion(run->bonds, s->q->rest->fixed, &node);
    if (motion)
        kr_stop(KR_EXIT_INPUT,
                "stage %zu is static, but nothing keeps the body (the piece with the node at %g, %g m) "
                "from %s; hold it by a load such as {set: bottom, displacement: [free, 0 mm]}",
                r->at.stage + 1, run->bonds->x[0][node], run->bonds->x[1][node], motion);
}

static void end(struct statics *s) {
    for (int d = 0; d < s->run->body->dim; d++) {
        kr_bonds_padded_free(s->before[d]);
        kr_bonds_padded_free(s->pull[d]);
        kr_bonds_padded_free(s->load[d]);
    }
    kr_equilibrium_free(s->q);
}

/* Fields are due at the first and the last load step of a stage, every so many, and on events. */
static void write(struct statics *s, int end_of_stage, int last, long step, double t) {
    int due = end_of_stage || s->r->at.event || step % s->run->c->every_steps == 0;
    kr_boundary_rest(s->boundary, s->run->body, t);
    kr_records_write(s->r, due, last, step, t);
}

/* The state before any load. */
static void write_start(struct statics *s) {
    kr_equilibrium_residual(s->q);
    kr_ledger_rest(s->r->ledger, s->run->body, s->r->crack, 0);
    write(s, 0, 0, 0, 0);
}

/* One load step to its end: equilibrium without a bond past s0. */
static void load_step(struct statics *s, long step) {
    struct kr_checkpoint *at = &s->r->at;
    const size_t broken = s->r->crack->count;
    int products = 0;
    double begun = kr_progress_clock();
    if (at->round == 0) {
        at->clock = first_round(s, step);
        products = s->q->products;
        kr_ledger_rest(s->r->ledger, s->run->body, s->r->crack, s->work);
        at->round = 1;
    }
    at->most_pull = fmax(at->most_pull, s->q->rest->pull);
    break_bonds(s, step);
    kr_say("  load step %ld, t %.6g s: residual %.1e after %d products in %.1f s, pull %.6g %s, %zu bonds broken in "
           "%ld rounds", step, at->clock, s->q->rest->residual, products,
           kr_progress_clock() - begun, s->q->rest->pull,
           s->run->body->dim == 2 ? "N/m" : "N", s->r->crack->count - broken, at->round - 1);
}

int kr_run_static(struct kr_run *run, struct kr_records *r) {
    struct statics s;
    begin(&s, run, r);
    long step = r->at.step > 0 ? r->at.step : 1;
    if (r->at.step == 0 && r->at.stage == 0)
        write_start(&s);
    for (;; step++) {
        kr_records_save(r, step);
        load_step(&s, step);
        int done = s.over || r->at.clock >= s.stage->end * (1 - 1e-12);
        write(&s, done, done && (s.over || r->at.stage + 1 == run->n_stages), step, r->at.clock);
        r->at.round = 0;
        if (done)
            break;
    }
    if (s.over)
        kr_say("  the body %s at t = %.6g s of stage %zu: the run ends here", s.over, r->at.clock,
               r->at.stage + 1);
    kr_records_next_stage(r, step, r->at.clock);
    r->at.clock = 0;
    end(&s);
    return s.over != NULL;
}
