/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Checks of a case that need more than one key. Faults join those of the reader; what is doubtful
 * but possible is a warning.
 */
#include "base/error.h"
#include "case_check.h"

#include <math.h>
#include <string.h>

/* More nodes than 31-bit indices of neighbours can name. */
static const double most_nodes = 2e9;

/* Quotients of decimals miss by a few bits: 0.16 mm holds "3 spacings" of 0.16/3 mm. */
static const double rounding = 1e-9;

static void check_mesh(struct kr_deck *deck, const struct kr_case *c) {
    double narrow = fmin(c->width, c->height);
    if (!(c->spacing > 0) || !(narrow > 0))
        return; /* a fault of the reader */
    if (c->spacing > narrow / 2)
        kr_deck_fault(deck, &c->spacing,
                      "%g m is more than half of the plate's narrower side of %g m; a plate needs "
                      "many cells across",
                      c->spacing, narrow);
    else if (c->width / c->spacing * (c->height / c->spacing) > most_nodes)
        kr_deck_fault(deck, &c->spacing,
                      "%g m gives %.2g nodes on this plate, more than %g; take a coarser spacing",
                      c->spacing, c->width / c->spacing * (c->height / c->spacing), most_nodes);
    else if (c->horizon < 2 * c->spacing * (1 - rounding))
        kr_deck_fault(deck, &c->horizon,
                      "%g m is %.3g spacings; it must be at least 2, and 3 to 6 are usual",
                      c->horizon, c->horizon / c->spacing);
    if (c->horizon > narrow)
        kr_deck_fault(deck, &c->horizon, "%g m is more than the plate's narrower side of %g m",
                      c->horizon, narrow);
}

int kr_case_is_name(const char *text) {
    const char *good = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    return *text && !text[strspn(text, good)];
}

int kr_case_check_count(struct kr_deck *deck, const struct kr_case *c, const void *vector) {
    size_t count = kr_deck_count(deck, vector), dim = (size_t)kr_case_dim(c);
    if (count && count != dim)
        kr_deck_fault(deck, vector, "found %zu component%s, expected %zu: the model is %s", count,
                      count == 1 ? "" : "s", dim,
                      dim == 3 ? "solid" : "a plate; material.model: solid has three");
    return count == dim;
}

void kr_case_check_box(struct kr_deck *deck, const double *lower, const double *upper, int dim) {
    for (int k = 0; k < dim; k++)
        if (lower[k] >= upper[k])
            kr_deck_fault(deck, upper, "%c = %g m is not above that of `lower`, %g m", "xyz"[k],
                          upper[k], lower[k]);
}

static int is_all_free(const struct kr_deck_formula formula[3]) {
    for (int d = 0; d < 3; d++)
        if (formula[d].text && !formula[d].is_free)
            return 0;
    return 1;
}

static void check_load(struct kr_deck *deck, const struct kr_case *c,
                       const struct kr_case_load *load) {
    const struct kr_deck_formula *kinds[] = {load->displacement, load->velocity, load->traction,
                                             load->body_force};
    const struct kr_deck_formula *first = NULL;
    int count = 0;
    for (int i = 0; i < 4; i++)
        if (kr_deck_given(deck, kinds[i])) {
            if (count++)
                kr_deck_fault(deck, kinds[i],
                              "a load has just one of displacement, velocity, traction and "
                              "body_force; make it a load of its own");
            else
                first = kinds[i];
        }
    if (!count)
        kr_deck_fault(deck, &load->set,
                      "the load does nothing; expected one of displacement, velocity, traction and "
                      "body_force");
    else if (kr_case_check_count(deck, c, first) && is_all_free(first))
        kr_deck_fault(deck, first, "all components are free; the load does nothing");
}

static void check_loads(struct kr_deck *deck, const struct kr_case *c,
                        const struct kr_deck_list *list) {
    const struct kr_case_load *loads = list->item;
    for (size_t i = 0; i < list->count; i++)
        check_load(deck, c, &loads[i]);
}

static void check_sets_and_loads(struct kr_deck *deck, const struct kr_case *c) {
    const struct kr_case_set *sets = c->sets.item;
    const struct kr_case_stage *stages = c->stages.item;
    for (size_t i = 0; i < c->sets.count; i++)
        kr_case_check_set(deck, c, &sets[i]);
    check_loads(deck, c, &c->loads);
    for (size_t k = 0; k < c->stages.count; k++)
        check_loads(deck, c, &stages[k].loads);
}

static void check_initial(struct kr_deck *deck, const struct kr_case *c) {
    const struct kr_deck_formula *field[] = {c->initial_displacement, c->initial_velocity};
    for (int k = 0; k < 2; k++) {
        kr_case_check_count(deck, c, field[k]);
        for (int d = 0; d < 3; d++)
            if (field[k][d].is_free)
                kr_deck_fault(deck, &field[k][d], "found 'free', expected an expression or 0; nothing "
                                                  "is free at time 0");
    }
}

static void check_times(struct kr_deck *deck, const struct kr_case *c) {
    const double *at = c->output_at.item;
    if (!(c->end_time > 0))
        return; /* a fault of the reader */
    if (c->time_step > c->end_time)
        kr_deck_fault(deck, &c->time_step, "%g s is more than end_time, %g s", c->time_step,
                      c->end_time);
    else if (c->time_step > 0 && c->end_time / c->time_step > 1e12)
        kr_deck_fault(deck, &c->time_step, "%g s makes %.2g steps until end_time; is a unit wrong?",
                      c->time_step, c->end_time / c->time_step);
    if (c->output_every > c->end_time)
        kr_deck_fault(deck, &c->output_every, "%g s is more than end_time, %g s", c->output_every,
                      c->end_time);
    if (c->history_every > c->end_time)
        kr_deck_fault(deck, &c->history_every, "%g s is more than end_time, %g s", c->history_every,
                      c->end_time);
    if (c->output_every > 0 && c->end_time / c->output_every > 1e6)
        kr_deck_fault(deck, &c->output_every, "%g s makes %.2g outputs; at most a million are made",
                      c->output_every, c->end_time / c->output_every);
    for (size_t i = 0; i < c->output_at.count; i++)
        if (at[i] > c->end_time * (1 + rounding))
            kr_deck_fault(deck, &at[i], "%g s is after end_time, %g s", at[i], c->end_time);
}

static void check_deformation(struct kr_deck *deck, const struct kr_case *c) {
    int along_z = c->surface_deformation == KR_UNIAXIAL_Z || c->surface_deformation == KR_STRESS_Z;
    char word[32];
    kr_case_word(KR_DEFORMATION_WORDS, along_z ? c->surface_deformation : 0, word);
    if (along_z && c->model <= KR_PLANE_STRAIN)
        kr_deck_fault(deck, &c->surface_deformation,
                      "%s is for bodies in 3D; a plate has x and y", word);
}

int kr_case_quantity(const char *word) {
    char known[32];
    for (int k = 0; k < KR_QUANTITIES; k++) {
        kr_case_word(KR_QUANTITY_WORDS, k, known);
        if (!strcmp(word, known))
            return k;
    }
    return -1;
}

int kr_case_outputs_on_events(const struct kr_case *c) {
    return c->first_damage || c->every_bonds > 0;
}

static void check_probes(struct kr_deck *deck, const struct kr_case *c) {
    const struct kr_case_probe *probe = c->probes.item;
    for (size_t k = 0; k < c->probes.count; k++) {
        int at = kr_deck_given(deck, probe[k].at), set = kr_deck_given(deck, &probe[k].set);
        if (at == set)
            kr_deck_fault(deck, &probe[k], "%s; a probe has one of them",
                          at ? "both 'set' and 'at'" : "neither 'set' nor 'at'");
        if (at)
            kr_case_check_count(deck, c, probe[k].at);
        if (!kr_case_is_name(probe[k].name))
            kr_deck_fault(deck, &probe[k].name,
                          "a probe's name may have letters, digits, '_' and '-', no others");
    }
}

static void check_fields(struct kr_deck *deck, const struct kr_case *c) {
    const char *const *word = c->fields.item;
    if (c->fields.given && !c->fields.count)
        kr_deck_fault(deck, &c->fields, "empty; leave it out to have the usual fields");
    for (size_t k = 0; k < c->fields.count; k++)
        if (kr_case_quantity(word[k]) < 0)
            kr_deck_fault(deck, &word[k], "unknown field '%.40s'; there are %s", word[k],
                          KR_QUANTITY_WORDS);
}

int kr_case_dim(const struct kr_case *c) {
    return c->model == KR_SOLID ? 3 : 2;
}

void kr_case_check(struct kr_deck *deck, const struct kr_case *c) {
    const struct kr_case_box *boxes = c->boxes.item;
    check_mesh(deck, c);
    kr_case_check_geometry(deck, c);
    kr_case_check_pores(deck, c);
    kr_case_check_solid(deck, c);
    check_sets_and_loads(deck, c);
    kr_case_check_cracks(deck, c);
    check_initial(deck, c);
    kr_case_check_stages(deck, c);
    check_times(deck, c);
    for (size_t i = 0; i < c->boxes.count; i++)
        if (kr_deck_given(deck, boxes[i].lower) && kr_deck_given(deck, boxes[i].upper))
            kr_case_check_box(deck, boxes[i].lower, boxes[i].upper, 2);
    check_fields(deck, c);
    check_probes(deck, c);
    check_deformation(deck, c);
    kr_case_check_material(deck, c);
}

static int loads_use(const struct kr_deck_list *list, const char *set) {
    const struct kr_case_load *loads = list->item;
    for (size_t i = 0; i < list->count; i++)
        if (!strcmp(loads[i].set, set))
            return 1;
    return 0;
}

static int is_used(const struct kr_case *c, const char *set) {
    const struct kr_case_stage *stages = c->stages.item;
    const struct kr_case_probe *probes = c->probes.item;
    const char *const *names = c->no_fail.item;
    int used = loads_use(&c->loads, set);
    for (size_t k = 0; k < c->stages.count && !used; k++)
        used = loads_use(&stages[k].loads, set);
    for (size_t k = 0; k < c->probes.count && !used; k++)
        used = probes[k].set && !strcmp(probes[k].set, set);
    if (used)
        return 1;
    for (size_t i = 0; i < c->no_fail.count; i++)
        if (!strcmp(names[i], set))
            return 1;
    return 0;
}

void kr_case_warn(struct kr_deck *deck, const struct kr_case *c) {
    const struct kr_case_set *sets = c->sets.item;
    if (c->horizon < 3 * c->spacing * (1 - rounding))
        kr_warn("%s: %.3g spacings; below 3 the directions of the lattice show in the cracks",
                kr_deck_where(deck, &c->horizon), c->horizon / c->spacing);
    if (c->partial_volume == KR_PARTIAL_VOLUME_HHB_ONE_SIDED)
        kr_warn("%s: the two ends of a bond weigh it differently where cells are unequal: momentum "
                "drifts and energy is not kept; hhb does without",
                kr_deck_where(deck, &c->partial_volume));
    for (size_t i = 0; i < c->sets.count; i++)
        if (!is_used(c, sets[i].name))
            kr_warn("%s: no load, probe or no_fail uses this set", kr_deck_where(deck, &sets[i].name));
}
