/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Loads as the deck gives them: checked, compiled, and their values at a time.
 */
#include "boundary_private.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- from the deck ---- */

static int is_given(const struct kr_deck_formula formula[3]) {
    return formula[0].text || formula[0].is_free;
}

static const struct kr_deck_formula *formulas_of(const struct kr_case_load *from,
                                                 enum kr_load_kind *kind) {
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

void kr_boundary_unknown_set(struct kr_deck *deck, const char *const *place, const char *kind,
                             const struct kr_nodes *nodes) {
    const char **known = KR_NEW(const char *, nodes->n_sets);
    for (size_t s = 0; s < nodes->n_sets; s++)
        known[s] = nodes->set[s].name;
    kr_deck_fault_name(deck, place, kind, nodes->n_sets, known);
    kr_free(known);
}

const struct kr_set *kr_boundary_find_set(struct kr_deck *deck, const char *const *place,
                                          const struct kr_nodes *nodes) {
    const struct kr_set *set = kr_nodes_set(nodes, *place);
    if (set && set->count)
        return set;
    if (set)
        kr_deck_fault(deck, place, "set '%s' has no node in it", *place);
    else
        kr_boundary_unknown_set(deck, place, "set", nodes);
    return NULL;
}

static void check_loads(struct kr_deck *deck, const struct kr_deck_list *list,
                        const struct kr_nodes *nodes) {
    const struct kr_case_load *load = list->item;
    for (size_t k = 0; k < list->count; k++) {
        const struct kr_set *set = kr_boundary_find_set(deck, &load[k].set, nodes);
        if (set && set->measure <= 0 && is_given(load[k].traction))
            kr_deck_fault(deck, &load[k].set,
                          "set '%s' belongs to no boundary, so a traction has no %s to act on; "
                          "use a boundary, a set 'within' a distance of one, or body_force",
                          load[k].set, nodes->dim == 3 ? "area" : "length");
    }
}

void kr_boundary_check(struct kr_deck *deck, const struct kr_case *c,
                       const struct kr_nodes *nodes) {
    const struct kr_case_stage *stage = c->stages.item;
    const struct kr_case_probe *probe = c->probes.item;
    const char *const *name = c->no_fail.item;
    check_loads(deck, &c->loads, nodes);
    for (size_t k = 0; k < c->stages.count; k++)
        check_loads(deck, &stage[k].loads, nodes);
    for (size_t k = 0; k < c->no_fail.count; k++)
        kr_boundary_find_set(deck, &name[k], nodes);
    for (size_t k = 0; k < c->probes.count; k++)
        if (kr_deck_given(deck, &probe[k].set))
            kr_boundary_find_set(deck, &probe[k].set, nodes);
}

static struct kr_table *table_of(struct kr_deck *deck, const struct kr_case_load *from) {
    if (!kr_deck_given(deck, &from->table_file))
        return NULL;
    char *path = kr_deck_beside(deck, from->table_file);
    const char *column = kr_deck_given(deck, &from->table_column) ? from->table_column : NULL;
    struct kr_table *table = kr_table_read(deck, &from->table_file, path, column);
    kr_free(path);
    return table;
}

static void make_load(struct kr_deck *deck, const struct kr_case_load *from,
                      const struct kr_nodes *nodes, struct kr_load *load) {
    load->set = kr_nodes_set(nodes, from->set);
    const struct kr_deck_formula *formula = formulas_of(from, &load->kind);
    double share = formula == from->traction ? load->set->measure / volume_of(nodes, load->set) : 1;
    load->ramp = from->ramp;
    load->table = table_of(deck, from);
    load->repeats = from->table_repeats;
    for (int d = 0; d < nodes->dim; d++) {
        char *why = NULL;
        if (!formula[d].text || formula[d].is_free)
            continue;
        load->part[d].expression = kr_expression_create(formula[d].text, &why);
        kr_assert(load->part[d].expression); /* the deck has checked it */
        load->part[d].factor = formula[d].factor * share;
    }
}

static const double *place_of(const struct kr_nodes *nodes, size_t i) {
    return nodes->position + i * (size_t)nodes->dim;
}

/* Two loads must not prescribe the same component of a node. */
static void check_conflicts(struct kr_deck *deck, const struct kr_deck_list *loads,
                            const struct kr_boundary *b) {
    int *owner = KR_NEW(int, b->nodes->n * (size_t)b->dim);
    const struct kr_case_load *from = loads->item;
    for (size_t k = 0; k < b->count; k++) {
        const struct kr_load *load = &b->load[k];
        int fault = 0;
        size_t node = 0;
        if (load->kind == BODY_FORCE)
            continue;
        for (size_t m = 0; m < load->set->count && !fault; m++)
            for (int d = 0; d < b->dim && !fault; d++) {
                int *at = &owner[b->dim * load->set->node[m] + d];
                if (!load->part[d].expression)
                    continue;
                fault = *at;
                node = (size_t)load->set->node[m];
                *at = (int)k + 1;
            }
        if (fault)
            kr_deck_fault(deck, &from[k].set,
                          "sets '%s' and '%s' share nodes, such as the one at (%g, %g) mm, and both "
                          "prescribe the same component; leave it 'free' in one of them",
                          from[k].set, from[fault - 1].set, 1e3 * place_of(b->nodes, node)[0],
                          1e3 * place_of(b->nodes, node)[1]);
    }
    kr_free(owner);
}

struct kr_boundary *kr_boundary_create(struct kr_deck *deck, const struct kr_deck_list *loads,
                                       const struct kr_nodes *nodes) {
    struct kr_boundary *b = KR_NEW(struct kr_boundary, 1);
    *b = (struct kr_boundary){.dim = nodes->dim, .nodes = nodes, .count = loads->count};
    b->load = KR_NEW(struct kr_load, b->count);
    const struct kr_case_load *from = loads->item;
    for (size_t k = 0; k < b->count; k++)
        make_load(deck, &from[k], nodes, &b->load[k]);
    check_conflicts(deck, loads, b);
    return b;
}

void kr_boundary_free(struct kr_boundary *b) {
    for (size_t k = 0; k < b->count; k++) {
        kr_table_free(b->load[k].table);
        for (int d = 0; d < 3; d++)
            if (b->load[k].part[d].expression)
                kr_expression_free(b->load[k].part[d].expression);
    }
    kr_free(b->load);
    kr_free(b);
}

/* ---- values ---- */

static double value_at(const struct kr_load_value *v, double x, double y, double z) {
    double value =
        v->ramp * v->part->factor * kr_expression_value(v->part->expression, x, y, z, v->t);
    if (!isfinite(value))
        kr_stop(KR_EXIT_NUMBERS,
                "the load on set '%s' is %g at x = %g, y = %g m, t = %g s; expected a finite number: "
                "look for a division by zero or a root of a negative number",
                v->load->set->name, isnan(value) ? NAN : value, x, y, v->t);
    return value;
}

struct kr_load_value kr_load_value_begin(const struct kr_boundary *b, const struct kr_load *load, int d,
                                double t) {
    struct kr_load_value v = {.boundary = b, .load = load, .part = &load->part[d], .t = t};
    v.ramp = load->ramp > 0 && t < load->ramp ? t / load->ramp : 1;
    if (load->table)
        v.ramp *= kr_table_value(load->table, t, load->repeats);
    v.varies = kr_expression_varies_in_space(v.part->expression);
    if (!v.varies)
        v.everywhere = value_at(&v, 0, 0, 0);
    return v;
}

double kr_load_value_of(const struct kr_load_value *v, int64_t i) {
    if (!v->varies)
        return v->everywhere;
    const struct kr_nodes *nodes = v->boundary->nodes;
    const double *x = nodes->position + i * nodes->dim;
    return value_at(v, x[0], x[1], nodes->dim == 3 ? x[2] : 0);
}
