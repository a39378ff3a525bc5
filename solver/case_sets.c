/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Checks of one set of nodes: it is of just one kind, and what that kind needs is there.
 */
#include "case_check.h"

#include <stddef.h>

/* A kind of set: the fields that go together, by name and place. */
struct kind {
    const char *text, *name[2];
    const void *field[2]; /* the second NULL: there is one alone */
};

enum { N_KINDS = 9 };

static void kinds_of(const struct kr_case_set *s, struct kind kind[N_KINDS]) {
    const struct kind all[N_KINDS] = {
        {"a boundary (within, of)", {"within", "of"}, {&s->within, &s->of}},
        {"a box (lower, upper)", {"lower", "upper"}, {s->lower, s->upper}},
        {"a disc or ball (centre, radius)", {"centre", "radius"}, {s->centre, &s->radius}},
        {"a half space (through, normal)", {"through", "normal"}, {s->through, s->normal}},
        {"a polygon (points)", {"points"}, {&s->points}},
        {"a union", {"union"}, {&s->join}},
        {"an intersection", {"intersection"}, {&s->meet}},
        {"a difference", {"difference"}, {&s->less}},
        {"a complement (not)", {"not"}, {&s->without}},
    };
    for (int k = 0; k < N_KINDS; k++)
        kind[k] = all[k];
}

/* Whether the fields of a kind are there: 2 all, 1 some, 0 none; with a fault where only some are. */
static int given(struct kr_deck *deck, const struct kr_case_set *set, const struct kind *kind) {
    int first = kr_deck_given(deck, kind->field[0]);
    int second = kind->field[1] ? kr_deck_given(deck, kind->field[1]) : first;
    if (first != second)
        kr_deck_fault(deck, &set->name, "'%s' goes with '%s', which is missing",
                      kind->name[second], kind->name[first]);
    return first + second;
}

static void check_values(struct kr_deck *deck, const struct kr_case *c,
                         const struct kr_case_set *set) {
    const double *vector[] = {set->lower, set->upper, set->centre, set->through, set->normal};
    int dim = kr_case_dim(c), fits = 1;
    for (int k = 0; k < 5; k++)
        if (kr_deck_given(deck, vector[k]))
            fits &= kr_case_check_count(deck, c, vector[k]);
    if (fits && kr_deck_given(deck, set->lower))
        kr_case_check_box(deck, set->lower, set->upper, dim);
    if (kr_deck_given(deck, set->normal) && !set->normal[0] && !set->normal[1] && !set->normal[2])
        kr_deck_fault(deck, set->normal, "all components are 0; expected a direction");
    if (kr_deck_given(deck, &set->points) && dim == 3)
        kr_deck_fault(deck, &set->points, "a polygon is for plates; a solid has box and half space");
    else if (kr_deck_given(deck, &set->points) && set->points.count < 6)
        kr_deck_fault(deck, &set->points, "found %zu corners, expected 3 or more",
                      set->points.count / 2);
    if (kr_deck_given(deck, &set->of) && set->of && !kr_case_is_name(set->of))
        kr_deck_fault(deck, &set->of,
                      "found '%.40s', expected the name of a boundary, such as 'top'", set->of);
}

void kr_case_check_set(struct kr_deck *deck, const struct kr_case *c,
                       const struct kr_case_set *set) {
    struct kind kind[N_KINDS];
    const struct kind *first = NULL;
    int whole = 1;
    kinds_of(set, kind);
    if (!kr_case_is_name(set->name))
        kr_deck_fault(deck, &set->name,
                      "a set's name may have letters, digits, '_' and '-', no others");
    for (int k = 0; k < N_KINDS; k++) {
        int parts = given(deck, set, &kind[k]);
        if (parts && first)
            kr_deck_fault(deck, &set->name, "both %s and %s; a set is one of them", first->text,
                          kind[k].text);
        whole &= parts != 1;
        first = parts ? &kind[k] : first;
    }
    if (!first)
        kr_deck_fault(deck, &set->name,
                      "empty; expected 'within' and 'of', 'lower' and 'upper', 'centre' and "
                      "'radius', 'through' and 'normal', 'points', 'union', 'intersection', "
                      "'difference' or 'not'");
    else if (whole)
        check_values(deck, c, set);
}
