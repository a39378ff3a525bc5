/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Formulas of the deck: an expression and then a unit, "0.3*min(t/200e-6, 1) m/s". Nothing marks
 * where one ends and the other begins, so the shortest tail is taken that is a unit of the right
 * kind and leaves an expression before it.
 */
#include "base/deck_private.h"
#include "base/expression.h"
#include "base/memory.h"
#include "base/unit.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

/* Sentence about a text that is no expression with finite value; NULL if it is one. A value that
   varies cannot be judged before it is used, so it may be infinite here. */
static char *fault_of(const char *text, double factor) {
    char *why = NULL;
    struct kr_expression *expression = kr_expression_create(text, &why);
    if (!expression) {
        char *cure = kr_text("%s; expected numbers, x, y, z [m], t [s] and functions such as sin and min", why);
        kr_free(why);
        return cure;
    }
    int varies =
        kr_expression_varies_in_space(expression) || kr_expression_varies_in_time(expression);
    if (!varies && !isfinite(factor * kr_expression_value(expression, 0, 0, 0, 0)))
        why = kr_text_copy("its value is not finite");
    kr_expression_free(expression);
    return why;
}

/* Whether a unit may begin at text + i: a letter after a blank, a digit or a bracket. */
static int may_begin_unit(const char *text, size_t i) {
    unsigned char c = (unsigned char)text[i], before = (unsigned char)text[i - 1];
    return (isalpha(c) || c >= 0x80) &&
           (isspace(before) || isdigit(before) || before == ')' || before == '.');
}

/* Split off the unit, in place. Returns its factor; 0 where no split works, with a sentence. */
static double split(char *text, const char *unit, char **why) {
    size_t length = strlen(text);
    for (size_t i = length; i-- > 1;) {
        double factor = may_begin_unit(text, i) ? kr_unit_factor(text + i, unit) : 0;
        if (factor == 0)
            continue;
        char *head = kr_text("%.*s", (int)i, text), *fault = fault_of(head, factor);
        kr_free(head);
        if (!fault) {
            while (i && isspace((unsigned char)text[i - 1]))
                i--;
            text[i] = 0;
            kr_free(*why);
            *why = NULL;
            return factor;
        }
        kr_free(*why);
        *why = fault;
    }
    return 0;
}

/* Sentence for a formula that could not be split; `fault` is what was wrong with its head where a
   unit was found. */
static char *explain(const char *text, const char *unit, const char *fault) {
    double number;
    char *why = NULL, *bare = fault_of(text, 1);
    if (fault)
        why = kr_text("found '%.60s': %s", text, fault);
    else if (bare && kr_unit_number(text, &number) &&
             kr_unit_read(text, unit, &number, &why) == 0 && why)
        ; /* a plain quantity with a wrong unit: the units' own sentence */
    else
        why = kr_text("found '%.60s', expected %s%s with its unit at the end, such as '%.60s %s'",
                      text, bare ? "an expression in x, y, z, t of " : "", kr_unit_noun(unit),
                      bare ? "2*t" : text, kr_unit_common(unit));
    kr_free(bare);
    return why;
}

void kr_deck_formula_read(const struct kr_deck_spot *spot, struct kr_deck_formula *place) {
    const char *unit = spot->key->unit;
    char *fault = NULL;
    kr_deck_note(spot, place);
    if (spot->node->kind != KR_DECK_SCALAR || !*spot->node->text) {
        kr_deck_mismatch(spot, "");
        return;
    }
    char *text = kr_deck_own(spot->deck, kr_text_copy(spot->node->text));
    if (!strcmp(text, "free")) {
        *place = (struct kr_deck_formula){text, 1, 1};
    } else if (kr_unit_beyond(text)) {
        fault = kr_unit_beyond_said(text, unit);
        *place = (struct kr_deck_formula){text, 1, 0};
        kr_deck_complain(spot->deck, spot->node->at, spot->path, "%s", fault);
    } else if (!strcmp(unit, "1")) {
        fault = fault_of(text, 1);
        *place = (struct kr_deck_formula){text, 1, 0};
        if (fault)
            kr_deck_complain(spot->deck, spot->node->at, spot->path, "found '%.60s': %s", text,
                             fault);
    } else {
        double factor = split(text, unit, &fault);
        *place = (struct kr_deck_formula){text, factor, 0};
        char *why = factor == 0 ? explain(text, unit, fault) : NULL;
        if (why)
            kr_deck_complain(spot->deck, spot->node->at, spot->path, "%s", why);
        kr_free(why);
    }
    kr_free(fault);
}
