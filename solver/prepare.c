/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Making a case ready to run (the first half of run.h).
 */
#include "run.h"

#include "base/error.h"
#include "base/machine.h"
#include "base/memory.h"
#include "base/progress.h"
#include "initial.h"
#include "precrack.h"
#include "rest.h"
#include "stress.h"
#include "time_step.h"
#include "weight.h"

#include <math.h>
#include <omp.h>
#include <string.h>

static void check_word(struct kr_deck *deck, const int *field, int choice, const char *words,
                       const char *in_file) {
    char in_deck[32];
    kr_case_word(words, choice, in_deck);
    if (strcmp(in_deck, in_file))
        kr_deck_fault(deck, field,
                      "found '%s', but the node file was made for '%s'; run kirsch-nodes again",
                      in_deck, in_file);
}

/* The surface factors belong to one horizon, model and weight: others would be wrong in silence. */
static void check_made_for(struct kr_deck *deck, const struct kr_case *c, int partial_volume,
                           const struct kr_nodes *nodes) {
    const struct kr_nodes_made_for *made = &nodes->made_for;
    if (nodes->dim != kr_case_dim(c)) {
        kr_deck_fault(deck, &c->model,
                      nodes->dim == 3 ? "this model is for plates, but the node file holds a body in "
                                        "three dimensions; take solid"
                                      : "the model is solid, but the node file holds a plate; run "
                                        "kirsch-nodes again, or take plane-stress or plane-strain");
        return;
    }
    if (fabs(made->horizon / c->horizon - 1) > 1e-12)
        kr_deck_fault(deck, &c->horizon,
                      "found %g m, but the node file was made for %g m; run kirsch-nodes again",
                      c->horizon, made->horizon);
    check_word(deck, &c->partial_volume, partial_volume, KR_PARTIAL_VOLUME_WORDS,
               made->partial_volume);
    check_word(deck, &c->surface_correction, c->surface_correction, KR_SURFACE_WORDS,
               made->surface_correction);
    if (c->surface_correction == KR_SURFACE_NONE)
        return;
    check_word(deck, &c->model, c->model, KR_MODEL_WORDS, made->model);
    check_word(deck, &c->micromodulus, c->micromodulus, KR_MICROMODULUS_WORDS, made->micromodulus);
    if (c->surface_correction == KR_SURFACE_ENERGY)
        check_word(deck, &c->surface_deformation, c->surface_deformation, KR_DEFORMATION_WORDS,
                   made->deformation);
}

/* The vectors of the loop and of the records alone (bonds.h, body.h, ledger.h, output.c): the families come on top. */
static void check_memory(const struct kr_nodes *nodes) {
    const size_t dim = (size_t)nodes->dim, numbers = (dim + 4) + (3 * dim + 1) + dim + KR_TENSOR;
    char what[64];
    snprintf(what, sizeof what, "%zu nodes", nodes->n);
    kr_machine_need((double)(numbers * sizeof(double) * nodes->n) + (double)kr_memory_bytes(), what);
}

static void mark_no_fail(const struct kr_case *c, const struct kr_nodes *nodes,
                         struct kr_bonds *bonds) {
    const char *const *name = c->no_fail.item;
    for (size_t k = 0; k < c->no_fail.count; k++) {
        const struct kr_set *set = kr_nodes_set(nodes, name[k]);
        for (size_t m = 0; m < set->count; m++)
            bonds->no_fail[set->node[m]] = 1;
    }
}

/* Nodes without any bond: those that stand on a pre-crack. */
static void warn_of_bare_nodes(const struct kr_bonds *b) {
    size_t bare = 0, first = 0;
    for (size_t slice = 0; slice < b->n_slices; slice++) {
        int bonds[KR_LANES] = {0};
        for (size_t row = b->first[slice]; row < b->first[slice + 1]; row++)
            for (int lane = 0; lane < KR_LANES; lane++)
                bonds[lane] += b->living[row] >> lane & 1;
        for (size_t i = slice * KR_LANES; i < b->n && i < (slice + 1) * KR_LANES; i++)
            if (!bonds[i % KR_LANES]) {
                first = bare ? first : i;
                bare++;
            }
    }
    if (bare)
        kr_warn("%zu nodes stand on a pre-crack and have lost all their bonds, such as the one at (%.6g, %.6g) mm; "
                "put the crack between two rows of nodes, half a spacing beside", bare, 1e3 * b->x[0][first],
                1e3 * b->x[1][first]);
}

/* Cut all bonds that cross a pre-crack. */
static void cut_precracks(struct kr_run *run, struct kr_deck *deck) {
    const struct kr_case *c = run->c;
    const struct kr_case_crack *from = c->cracks.item;
    for (size_t k = 0; k < c->cracks.count; k++) {
        char *path = from[k].file ? kr_deck_beside(deck, from[k].file) : NULL;
        struct kr_precrack *crack = kr_precrack_create(&from[k], path);
        size_t cut = kr_precrack_cut(crack, run->bonds, c->count_precrack);
        if (!cut)
            kr_warn("%s: the pre-crack crosses no bond; is it where the body is, and longer than a "
                    "spacing?", kr_deck_where(deck, &from[k]));
        run->precrack += cut;
        kr_precrack_free(crack);
        kr_free(path);
    }
    if (run->precrack)
        warn_of_bare_nodes(run->bonds);
}

/* Say what one-sided weights do: the net force of a wave of the plate's size on a body without loads,
 * over the sum of the forces' sizes. Symmetric weights leave 1e-16. */
static void report_drift(struct kr_body *body, double width) {
    const struct kr_bonds *b = body->bonds;
    double net[3] = {0}, all = 0;
    for (size_t i = 0; i < body->n; i++) {
        double angle = 2 * M_PI / width * (b->x[0][i] + 2 * b->x[1][i]);
        body->u[0][i] = 1e-6 * width * sin(angle);
        body->u[1][i] = 1e-6 * width * cos(angle);
    }
    kr_body_force(body, 0);
    for (int d = 0; d < body->dim; d++)
        for (size_t i = 0; i < body->n; i++) {
            net[d] += b->volume[i] * body->force[d][i];
            all += b->volume[i] * fabs(body->force[d][i]);
            body->u[d][i] = 0;
        }
    kr_say("  one-sided weights: a wave of the plate's width leaves a net force of %.1e of all forces, "
           "so momentum drifts", hypot(hypot(net[0], net[1]), net[2]) / all);
}

/* The largest step in time: as the deck gives it, or the safe one. */
static double choose_time_step(struct kr_run *run, struct kr_deck *deck,
                               struct kr_time_step *found) {
    const struct kr_case *c = run->c;
    *found = kr_time_step_find(run->body, run->nodes->spacing);
    double dt = c->time_step > 0 ? c->time_step : c->safety_factor * found->stable;
    if (dt > found->stable)
        kr_deck_fault(deck, &c->time_step,
                      "found %.4g us, but steps above %.4g us are unstable; leave it out to have %.4g us",
                      1e6 * dt, 1e6 * found->stable, 1e6 * c->safety_factor * found->stable);
    return dt;
}

/* A stage that moves: steps shortened a little so that whole ones reach the end. */
static void plan_moving(struct kr_run *run, struct kr_stage *stage, double end, double dt,
                        const struct kr_time_step *found) {
    stage->end = end;
    stage->steps = (long)ceil(end / dt * (1 - 1e-9));
    stage->dt = end / (double)stage->steps;
    run->dt = stage->dt;
    kr_say("  time step %.5g us, %ld steps (stable below %.5g us by power iteration in %d rounds; "
           "classical bound %.5g us, Courant %.5g us)",
           1e6 * stage->dt, stage->steps, 1e6 * found->stable, found->iterations,
           1e6 * found->classical, 1e6 * found->courant);
}

static void plan_static(struct kr_stage *stage) {
    const struct kr_case_steps *steps = stage->load_steps->item;
    stage->steps = stage->load_steps->count ? 0 : 1;
    stage->end = stage->load_steps->count ? 0 : 1;
    for (size_t k = 0; k < stage->load_steps->count; k++) {
        stage->steps += (long)steps[k].count;
        stage->end += (double)steps[k].count * steps[k].size;
    }
    kr_say("  static stage of %ld load steps", stage->steps);
}

static void plan_stages(struct kr_run *run, struct kr_deck *deck) {
    const struct kr_case *c = run->c;
    const struct kr_case_stage *from = c->stages.item;
    struct kr_time_step found;
    double dt = choose_time_step(run, deck, &found);
    run->dt = run->safe_step = dt;
    for (size_t k = 0; k < run->n_stages; k++) {
        struct kr_stage *stage = &run->stage[k];
        *stage = (struct kr_stage){.kind = KR_STAGE_DYNAMIC, .breaks = 1};
        if (run->staged)
            *stage = (struct kr_stage){.kind = from[k].kind,
                                       .damping = from[k].damping,
                                       .least_step = from[k].least_step,
                                       .end_below = from[k].end_below,
                                       .tolerance = from[k].tolerance,
                                       .breaks = from[k].breaks,
                                       .load_steps = &from[k].steps};
        if (stage->kind == KR_STAGE_STATIC)
            plan_static(stage);
        else
            plan_moving(run, stage, run->staged ? from[k].end_time : c->end_time,
                        stage->kind == KR_STAGE_RELAXATION ? KR_REST_STEP * dt : dt, &found);
        run->steps += stage->steps;
    }
}

static void create_boundaries(struct kr_run *run, struct kr_deck *deck) {
    const struct kr_case_stage *from = run->c->stages.item;
    run->staged = run->c->stages.count > 0;
    run->n_stages = run->staged ? run->c->stages.count : 1;
    run->stage = KR_NEW(struct kr_stage, run->n_stages);
    run->boundary = KR_NEW(struct kr_boundary *, run->n_stages);
    for (size_t k = 0; k < run->n_stages; k++)
        run->boundary[k] = kr_boundary_create(
            deck, kr_case_loads(run->c, run->staged ? &from[k] : NULL), run->nodes);
}

struct kr_run *kr_run_create(struct kr_deck *deck, const struct kr_case *c) {
    struct kr_run *run = KR_NEW(struct kr_run, 1);
    char *path = kr_case_file(c, "plate.nodes.h5");
    *run = (struct kr_run){.c = c, .nodes = kr_nodes_read(path)};
    struct kr_material material = kr_material_of(c);
    int partial_volume = kr_weights_choose(deck, c, run->nodes);
    check_made_for(deck, c, partial_volume, run->nodes);
    check_memory(run->nodes);
    kr_boundary_check(deck, c, run->nodes);
    run->probes = kr_probes_create(deck, c, run->nodes);
    kr_deck_finish(deck);

    double begun = kr_progress_clock();
    run->bonds = kr_bonds_create(run->nodes, &material, partial_volume);
    cut_precracks(run, deck);
    mark_no_fail(c, run->nodes, run->bonds);
    run->body = kr_body_create(run->bonds);
    create_boundaries(run, deck);
    if (c->precision == KR_MIXED)
        kr_body_mix(run->body);
    kr_deck_finish(deck);
    struct kr_bonds_size size = kr_bonds_size(run->bonds);
    kr_say("  %zu nodes, %zu bonds (%.1f a node), %zu cut by pre-cracks; families in %.2f s", run->nodes->n,
           run->bonds->count / 2, (double)run->bonds->count / (double)run->nodes->n, run->precrack,
           kr_progress_clock() - begun);
    kr_say("  loop '%s' on %d threads, lanes filled to %.0f %%, %.0f %% of the slices on the lattice, "
           "%.0f B a node", run->body->kernel->name, omp_get_max_threads(), 100 * size.lane_fill,
           100 * size.lattice_share, (double)kr_memory_bytes() / (double)run->nodes->n);
    if (partial_volume == KR_PARTIAL_VOLUME_HHB_ONE_SIDED)
        report_drift(run->body, c->width);
    plan_stages(run, deck);
    kr_deck_finish(deck);
    kr_initial_set(c, run->nodes, run->body);
    kr_free(path);
    return run;
}

void kr_run_free(struct kr_run *run) {
    for (size_t k = 0; k < run->n_stages; k++)
        kr_boundary_free(run->boundary[k]);
    kr_free(run->boundary);
    kr_probes_free(run->probes);
    kr_free(run->stage);
    kr_body_free(run->body);
    kr_bonds_free(run->bonds);
    kr_nodes_free(run->nodes);
    kr_free(run);
}
