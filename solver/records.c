/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Records of a run. See records.h.
 */
#include "records.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/progress.h"
#include "interrupt.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

/* Two runs in one folder would mix their records. The folder itself is locked, which leaves no file;
   the lock goes with the program, however that ends. Returns what holds it. */
static int lock_folder(const struct kr_case *c) {
    int lock = open(c->folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock >= 0 && flock(lock, LOCK_EX | LOCK_NB) && errno == EWOULDBLOCK)
        kr_stop(KR_EXIT_STORAGE,
                "another kirsch-solve is at work in %s; wait for it, or give this one its own folder "
                "with --output",
                c->folder);
    return lock; /* a file system without locks has none to ask for */
}

/* A checkpoint whose numbers lead nowhere would run for ever or beyond the stages. */
static void check_place(const struct kr_run *run, const struct kr_checkpoint *at) {
    if (at->stage < run->n_stages && at->step >= 0 && at->before >= 0 && at->round >= 0 &&
        (run->stage[at->stage].kind == KR_STAGE_STATIC || at->step <= run->stage[at->stage].steps))
        return;
    kr_stop(KR_EXIT_INPUT,
            "the checkpoint in %s stands at step %ld of stage %zu, which the run does not have; run without --resume",
            run->c->folder, at->step, at->stage + 1);
}

static int has_static_stage(const struct kr_run *run) {
    for (size_t k = 0; k < run->n_stages; k++)
        if (run->stage[k].kind == KR_STAGE_STATIC)
            return 1;
    return 0;
}

void kr_records_open(struct kr_records *r, struct kr_run *run, const char *deck_text, int resume) {
    const struct kr_case *c = run->c;
    char *path = kr_case_file(c, "history.csv");
    *r = (struct kr_records){.run = run,
                             .lock = lock_folder(c),
                             .crack = kr_crack_create(run->bonds, c->damage_threshold),
                             .ledger = kr_ledger_create(run->body),
                             .open = run->staged || kr_case_outputs_on_events(c),
                             .saved = kr_progress_clock()};
    r->at = (struct kr_checkpoint){.steps = run->steps,
                                   .dt = run->dt,
                                   .deck_text = deck_text,
                                   .body = run->body,
                                   .ledger = r->ledger,
                                   .crack = r->crack};
    for (int d = 0; d < run->body->dim && has_static_stage(run); d++)
        r->at.rest[d] = kr_bonds_padded(run->body->n);
    if (resume) {
        kr_checkpoint_read(c, &r->at);
        check_place(run, &r->at);
        kr_say("  resumed at step %ld, t = %.4g us", r->at.before + r->at.step,
               1e6 * (r->at.began + (double)r->at.step * run->stage[r->at.stage].dt));
    } else {
        kr_checkpoint_remove(c);
    }
    /* The step that a later stage begins with was written as the last one of the stage before. */
    int written = r->at.stage > 0 && r->at.step == 0;
    struct kr_output_plan plan = {.dt = run->dt,
                                  .steps = run->steps,
                                  .open = r->open,
                                  .resumed = resume,
                                  .done = r->at.before + r->at.step + written};
    r->output = kr_output_create(c, run->nodes, run->bonds, plan, deck_text);
    r->history =
        kr_history_open(path, run->boundary, run->n_stages, run->body->dim, run->probes,
                        r->at.history);
    if (run->staged)
        r->sites = kr_sites_create(c, run->bonds, r->crack, r->at.sites);
    kr_free(path);
}

void kr_records_close(struct kr_records *r) {
    if (r->sites)
        kr_sites_free(r->sites);
    for (int d = 0; d < 3; d++)
        kr_bonds_padded_free(r->at.rest[d]);
    kr_output_free(r->output);
    kr_history_close(r->history);
    kr_crack_free(r->crack);
    kr_ledger_free(r->ledger);
    if (r->lock >= 0)
        close(r->lock);
}

/* Whether bonds that broke, from the first number to the second, ask for an output. */
static int is_event(const struct kr_case *c, int64_t from, int64_t to) {
    return (c->first_damage && from == 0 && to > 0) ||
           (c->every_bonds && to / c->every_bonds > from / c->every_bonds);
}

void kr_records_crack(struct kr_records *r, long step, double t) {
    size_t from = r->crack->count;
    kr_crack_record(r->crack, r->run->body, r->at.began + t);
    r->at.event |= is_event(r->run->c, (int64_t)from, (int64_t)r->crack->count);
    if (r->sites)
        kr_sites_note(r->sites, r->crack, from,
                      (struct kr_history_time){r->at.before + step, r->at.began + t, r->at.stage, t});
}

void kr_records_write(struct kr_records *r, int output, int last, long step, double t) {
    struct kr_history_time at = {r->at.before + step, r->at.began + t, r->at.stage, t};
    kr_history_write(r->history, r->run->body, r->ledger, r->crack, at);
    if (output)
        kr_output_write(r->output, r->run->body, r->ledger, r->crack, at.step, at.time, last);
    if (output)
        r->at.event = 0;
}

void kr_records_save(struct kr_records *r, long next) {
    const struct kr_case *c = r->run->c;
    enum kr_interrupt asked = kr_interrupt_asked();
    double now = kr_progress_clock();
    int by_steps = c->checkpoint_steps && r->at.round == 0 && next > 0 && next % c->checkpoint_steps == 0;
    int by_time = c->checkpoint_every > 0 && now - r->saved >= c->checkpoint_every;
    if (asked == KR_INTERRUPT_NONE && !by_steps && !by_time)
        return;
    r->at.step = next;
    r->at.history = kr_history_bytes(r->history);
    r->at.sites = r->sites ? kr_sites_bytes(r->sites) : 0;
    kr_checkpoint_write(c, &r->at);
    r->saved = now;
    if (asked == KR_INTERRUPT_STOP)
        kr_stop(KR_EXIT_SIGNAL,
                "stopped by a signal or the time limit before step %ld of %ld; all is in "
                "%s/checkpoint.h5: go on with the same command (kirsch), or kirsch-solve --resume",
                r->at.before + next, r->run->steps, c->folder);
}

void kr_records_next_stage(struct kr_records *r, long steps, double t) {
    r->at.stage++;
    r->at.step = 0;
    r->at.before += steps;
    r->at.began += t;
    r->at.rest_clock = 0;
}
