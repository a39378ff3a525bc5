/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Loads. Each load of the deck acts on the nodes of one set, component by component: a component
 * has a formula or is free. Body forces (and tractions) act through the force, prescribed motion
 * through the velocity of the coming half step. Nothing here depends on the number of threads: sets
 * are small and are gone through in order.
 */
#include "boundary.h"

#include "base/error.h"
#include "base/expression.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum kind { BODY_FORCE, VELOCITY, DISPLACEMENT };

/* One component of one load. */
struct part {
    struct kr_expression *expression; /* NULL: free */
    double factor;                    /* to SI, and from traction to body force */
};

struct load {
    const struct kr_set *set;
    enum kind kind;
    double ramp;
    struct part part[3];
    double reaction[3];
};

struct kr_boundary {
    int dim;
    const struct kr_nodes *nodes; /* not owned */
    size_t count;
    struct load *load;
};

/* ---- from the deck ---- */

static int is_given(const struct kr_deck_formula formula[3]) {
    return formula[0].text || formula[0].is_free;
}

static const struct kr_deck_formula *formulas_of(const struct kr_case_load *from,
                                                 enum kind *kind) {
    *kind = DISPLACEMENT;
    if (is_given(from->displacement))
        return from->displacement;
    *kind = VELOCITY;
    if (is_given(from->velocity))
        return from->velocity;
    *kind = BODY_FORCE;
    return is_given(from->traction) ? from->traction : from->body_force;
}

static double volume_of(const struct kr_nodes *nodes, const struct kr_set *set) {
    double volume = 0;
    for (size_t k = 0; k < set->count; k++)
        volume += nodes->volume[set->node[k]];
    return volume;
}

/* The set named at `place`; a fault of the deck if there is none or nothing in it. */
static const struct kr_set *set_named(struct kr_deck *deck, const char *const *place,
                                      const struct kr_nodes *nodes) {
    char known[512] = "";
    const struct kr_set *set = kr_nodes_set(nodes, *place);
    if (set && set->count)
        return set;
    for (size_t s = 0; s < nodes->n_sets; s++) {
        size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s", s ? ", " : "", nodes->set[s].name);
    }
    if (set)
        kr_deck_fault(deck, place, "set '%s' has no node in it", *place);
    else
        kr_deck_fault(deck, place, "no set is called '%s'; there are %s", *place, known);
    return NULL;
}

void kr_boundary_check(struct kr_deck *deck, const struct kr_case *c,
                       const struct kr_nodes *nodes) {
    const struct kr_case_load *load = c->loads.item;
    const char *const *name = c->no_fail.item;
    for (size_t k = 0; k < c->loads.count; k++) {
        const struct kr_set *set = set_named(deck, &load[k].set, nodes);
        if (set && set->measure <= 0 && is_given(load[k].traction))
            kr_deck_fault(deck, &load[k].set,
                          "set '%s' belongs to no boundary, so a traction has no %s to act on; "
                          "use a boundary, a set 'within' a distance of one, or body_force",
                          load[k].set, nodes->dim == 3 ? "area" : "length");
    }
    for (size_t k = 0; k < c->no_fail.count; k++)
        set_named(deck, &name[k], nodes);
}

static void make_load(const struct kr_case_load *from, const struct kr_nodes *nodes,
                      struct load *load) {
    load->set = kr_nodes_set(nodes, from->set);
    const struct kr_deck_formula *formula = formulas_of(from, &load->kind);
    double share = formula == from->traction ? load->set->measure / volume_of(nodes, load->set) : 1;
    load->ramp = from->ramp;
    for (int d = 0; d < nodes->dim; d++) {
        char *why = NULL;
        if (!formula[d].text || formula[d].is_free)
            continue;
        load->part[d].expression = kr_expression_create(formula[d].text, &why);
        kr_assert(load->part[d].expression); /* the deck has checked it */
        load->part[d].factor = formula[d].factor * share;
    }
}

/* Two loads must not prescribe the same component of a node. */
static void check_conflicts(struct kr_deck *deck, const struct kr_case *c,
                            const struct kr_boundary *b) {
    int *owner = KR_NEW(int, b->nodes->n * (size_t)b->dim);
    const struct kr_case_load *from = c->loads.item;
    for (size_t k = 0; k < b->count; k++) {
        const struct load *load = &b->load[k];
        int fault = 0;
        if (load->kind == BODY_FORCE)
            continue;
        for (size_t m = 0; m < load->set->count && !fault; m++)
            for (int d = 0; d < b->dim && !fault; d++) {
                int *at = &owner[b->dim * load->set->node[m] + d];
                if (!load->part[d].expression)
                    continue;
                fault = *at;
                *at = (int)k + 1;
            }
        if (fault)
            kr_deck_fault(deck, &from[k].set,
                          "sets '%s' and '%s' share nodes and both prescribe the same component; "
                          "leave it 'free' in one of them",
                          from[k].set, from[fault - 1].set);
    }
    kr_free(owner);
}

struct kr_boundary *kr_boundary_create(struct kr_deck *deck, const struct kr_case *c,
                                       const struct kr_nodes *nodes) {
    struct kr_boundary *b = KR_NEW(struct kr_boundary, 1);
    *b = (struct kr_boundary){.dim = nodes->dim, .nodes = nodes, .count = c->loads.count};
    b->load = KR_NEW(struct load, b->count);
    const struct kr_case_load *from = c->loads.item;
    for (size_t k = 0; k < b->count; k++)
        make_load(&from[k], nodes, &b->load[k]);
    check_conflicts(deck, c, b);
    return b;
}

void kr_boundary_free(struct kr_boundary *b) {
    for (size_t k = 0; k < b->count; k++)
        for (int d = 0; d < 3; d++)
            if (b->load[k].part[d].expression)
                kr_expression_free(b->load[k].part[d].expression);
    kr_free(b->load);
    kr_free(b);
}

/* ---- values ---- */

/* A component's value for the nodes of its set, one after the other at one time. */
struct value {
    const struct kr_boundary *boundary;
    const struct load *load;
    const struct part *part;
    double t, ramp, everywhere;
    int varies;
};

static double value_at(const struct value *v, double x, double y, double z) {
    double value =
        v->ramp * v->part->factor * kr_expression_value(v->part->expression, x, y, z, v->t);
    if (!isfinite(value))
        kr_stop(KR_EXIT_NUMBERS,
                "the load on set '%s' is %g at x = %g, y = %g m, t = %g s; expected a finite number: "
                "look for a division by zero or a root of a negative number",
                v->load->set->name, value, x, y, v->t);
    return value;
}

static struct value value_begin(const struct kr_boundary *b, const struct load *load, int d,
                                double t) {
    struct value v = {.boundary = b, .load = load, .part = &load->part[d], .t = t};
    v.ramp = load->ramp > 0 && t < load->ramp ? t / load->ramp : 1;
    v.varies = kr_expression_varies_in_space(v.part->expression);
    if (!v.varies)
        v.everywhere = value_at(&v, 0, 0, 0);
    return v;
}

static double value_of(const struct value *v, int64_t i) {
    if (!v->varies)
        return v->everywhere;
    const struct kr_nodes *nodes = v->boundary->nodes;
    const double *x = nodes->position + i * nodes->dim;
    return value_at(v, x[0], x[1], nodes->dim == 3 ? x[2] : 0);
}

/* ---- what loads do ---- */

void kr_boundary_push(struct kr_boundary *b, struct kr_body *body, double t) {
    for (size_t k = 0; k < b->count; k++) {
        const struct load *load = &b->load[k];
        for (int d = 0; d < b->dim; d++) {
            if (load->kind != BODY_FORCE || !load->part[d].expression)
                continue;
            struct value v = value_begin(b, load, d, t);
            for (size_t m = 0; m < load->set->count; m++)
                body->force[d][load->set->node[m]] += value_of(&v, load->set->node[m]);
        }
    }
}

/* Velocity at t + dt/2 of a prescribed component. */
static struct value motion_begin(const struct kr_boundary *b, const struct load *load, int d,
                                 double t, double dt) {
    return value_begin(b, load, d, load->kind == VELOCITY ? t + 0.5 * dt : t + dt);
}

static double motion_of(const struct value *v, const struct kr_body *body, int d, int64_t i,
                        double dt) {
    double value = value_of(v, i);
    return v->load->kind == VELOCITY ? value : (value - body->u[d][i]) / dt;
}

void kr_boundary_hold(struct kr_boundary *b, struct kr_body *body, double t, double dt) {
    for (size_t k = 0; k < b->count; k++) {
        const struct load *load = &b->load[k];
        for (int d = 0; d < b->dim; d++) {
            if (load->kind == BODY_FORCE || !load->part[d].expression)
                continue;
            struct value v = motion_begin(b, load, d, t, dt);
            for (size_t m = 0; m < load->set->count; m++) {
                int64_t i = load->set->node[m];
                body->v[d][i] = motion_of(&v, body, d, i, dt);
                body->force[d][i] = 0;
            }
        }
    }
}

void kr_boundary_start(struct kr_boundary *b, struct kr_body *body, double dt) {
    for (size_t k = 0; k < b->count; k++) {
        const struct load *load = &b->load[k];
        for (int d = 0; d < b->dim; d++) {
            if (load->kind == BODY_FORCE || !load->part[d].expression)
                continue;
            struct value now = value_begin(b, load, d, 0), next = motion_begin(b, load, d, 0, dt);
            for (size_t m = 0; m < load->set->count; m++) {
                int64_t i = load->set->node[m];
                if (load->kind == DISPLACEMENT)
                    body->u[d][i] = value_of(&now, i);
                body->v[d][i] = load->kind == VELOCITY ? value_of(&now, i)
                                                       : motion_of(&next, body, d, i, dt);
            }
        }
    }
}

void kr_boundary_velocity(struct kr_boundary *b, const struct kr_body *body, double t, double dt,
                          int first, double *const v[3]) {
    for (size_t k = 0; k < b->count; k++) {
        const struct load *load = &b->load[k];
        for (int d = 0; d < b->dim; d++) {
            if (load->kind == BODY_FORCE || !load->part[d].expression)
                continue;
            struct value motion = motion_begin(b, load, d, t, dt);
            for (size_t m = 0; m < load->set->count; m++) {
                int64_t i = load->set->node[m];
                double before = body->v[d][i], after = motion_of(&motion, body, d, i, dt);
                v[d][i] = first ? before : 0.5 * (before + after);
            }
        }
    }
}

/* Force of one load's component d on the body; its power is added. */
static double pull_of(const struct kr_boundary *b, const struct load *load,
                      const struct kr_body *body, int d, double t, double dt, int first,
                      double *power) {
    const double density = body->bonds->material.density, kick = first ? 0.5 * dt : dt;
    double sum = 0;
    int moves = load->kind != BODY_FORCE;
    struct value v = moves ? motion_begin(b, load, d, t, dt) : value_begin(b, load, d, t);
    for (size_t m = 0; m < load->set->count; m++) {
        int64_t i = load->set->node[m];
        double before = body->v[d][i], volume = body->bonds->volume[i];
        double after = moves ? motion_of(&v, body, d, i, dt)
                             : before + kick * body->force[d][i] / density;
        double pull = moves ? volume * (density * (after - before) / kick - body->force[d][i])
                            : volume * value_of(&v, i);
        sum += pull;
        *power += pull * (first ? before : 0.5 * (before + after));
    }
    return sum;
}

double kr_boundary_power(struct kr_boundary *b, const struct kr_body *body, double t, double dt,
                         int first) {
    double power = 0;
    for (size_t k = 0; k < b->count; k++)
        for (int d = 0; d < b->dim; d++)
            if (b->load[k].part[d].expression)
                b->load[k].reaction[d] =
                    pull_of(b, &b->load[k], body, d, t, dt, first, &power);
    return power;
}

size_t kr_boundary_count(const struct kr_boundary *b) {
    return b->count;
}

const char *kr_boundary_set(const struct kr_boundary *b, size_t k) {
    return b->load[k].set->name;
}

double kr_boundary_reaction(const struct kr_boundary *b, size_t k, int d) {
    return b->load[k].reaction[d];
}
