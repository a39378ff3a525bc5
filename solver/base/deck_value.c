/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Single values: text of the deck -> number, word, vector, formula in the struct.
 *
 * A formula is an expression and then a unit, "0.3*min(t/200e-6, 1) m/s". Nothing marks where one
 * ends and the other begins, so the shortest tail is taken that is a unit of the right kind and
 * leaves an expression before it.
 */
#include "base/deck_private.h"
#include "base/error.h"
#include "base/expression.h"
#include "base/memory.h"
#include "base/unit.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *kr_deck_word(const char *words, size_t n, int *length) {
    for (;; n--) {
        words += strspn(words, " ");
        *length = (int)strcspn(words, " ");
        if (!*length)
            return NULL;
        if (!n)
            return words;
        words += *length;
    }
}

/* "near-boundary, uniform", owned by the caller. */
static char *list_words(const char *words) {
    char *list = kr_text_copy("");
    int length;
    const char *word;
    for (size_t i = 0; (word = kr_deck_word(words, i, &length)); i++) {
        char *more = kr_text("%s%s%.*s", list, i ? ", " : "", length, word);
        kr_free(list);
        list = more;
    }
    return list;
}

/* "a length in mm", "a pure number", as a part of a sentence. */
static char *expected_number(const struct kr_deck_key *key) {
    if (!strcmp(key->unit, "1"))
        return kr_text("a pure number");
    return kr_text("%s in %s", kr_unit_noun(key->unit), kr_unit_common(key->unit));
}

static char *expected_section(const struct kr_deck_key *key) {
    const char *intro = key->type == KR_DECK_SECTION ? "a section with"
                        : key->type == KR_DECK_LIST  ? "a list ('- ...') of items with"
                                                     : "names, each with";
    char *text = kr_text("%s %s", intro, key->keys->name);
    for (const struct kr_deck_key *below = key->keys + 1; below->name; below++) {
        char *more = kr_text("%s, %s", text, below->name);
        kr_free(text);
        text = more;
    }
    return text;
}

static char *expected_many(const struct kr_deck_key *key) {
    char *one = expected_number(key), *text;
    if (key->type == KR_DECK_VECTOR)
        text = kr_text("a list of %zu, each %s", key->count, one);
    else if (key->type == KR_DECK_NUMBERS)
        text = kr_text("a list, each %s", one);
    else
        text = kr_text("a list of at most %zu, each an expression in x, y, z, t and then %s, or "
                       "'free'",
                       key->count, one);
    kr_free(one);
    return text;
}

char *kr_deck_expected(const struct kr_deck_key *key) {
    char *part, *text;
    switch (key->type) {
    case KR_DECK_NUMBER:
        return expected_number(key);
    case KR_DECK_INTEGER:
        return kr_text("a whole number");
    case KR_DECK_BOOLEAN:
        return kr_text("true or false");
    case KR_DECK_CHOICE:
        part = list_words(key->words);
        text = kr_text("one of %s", part);
        break;
    case KR_DECK_TEXT:
        return kr_text("a text");
    case KR_DECK_TEXTS:
        return kr_text("a list of texts");
    case KR_DECK_FORMULA:
        part = expected_number(key);
        text = kr_text("an expression in x, y, z, t and then %s", part);
        break;
    case KR_DECK_VECTOR:
    case KR_DECK_NUMBERS:
    case KR_DECK_FORMULAS:
        return expected_many(key);
    default:
        return expected_section(key);
    }
    kr_free(part);
    return text;
}

/* "found '3', expected true or false", and `cure` behind it. */
static void mismatch(const struct kr_deck_spot *spot, const char *cure) {
    char *found = kr_deck_node_show(spot->node), *expected = kr_deck_expected(spot->key);
    kr_deck_complain(spot->deck, spot->node->at, spot->path, "found %s, expected %s%s", found,
                     expected, cure);
    kr_free(found);
    kr_free(expected);
}

/* Whether the value lies in the row's range; complains if not. */
static int in_range(const struct kr_deck_spot *spot, double value) {
    const struct kr_deck_key *key = spot->key;
    const char *unit = key->unit && strcmp(key->unit, "1") ? key->unit : "";
    const char *blank = *unit ? " " : "";
    int low = key->exclusive ? value <= key->least : value < key->least;
    if ((key->least == 0 && key->most == 0) || !(low || value > key->most))
        return 1;
    kr_deck_complain(spot->deck, spot->node->at, spot->path, "found '%.60s', expected %s %g%s%s",
                     spot->node->text,
                     !low             ? "at most"
                     : key->exclusive ? "more than"
                                      : "at least",
                     low ? key->least : key->most, blank, unit);
    return 0;
}

static void read_number(const struct kr_deck_spot *spot, double *place) {
    double value = 0;
    char *why = NULL;
    kr_deck_note(spot, place);
    if (spot->node->kind != KR_DECK_SCALAR || !*spot->node->text) {
        char *found = kr_deck_node_show(spot->node), *expected = expected_number(spot->key);
        kr_deck_complain(spot->deck, spot->node->at, spot->path, "found %s, expected %s", found,
                         expected);
        kr_free(found);
        kr_free(expected);
    } else if (!kr_unit_read(spot->node->text, spot->key->unit, &value, &why)) {
        kr_deck_complain(spot->deck, spot->node->at, spot->path, "%s", why);
        kr_free(why);
    } else if (in_range(spot, value)) {
        *place = value;
    }
}

static void read_integer(const struct kr_deck_spot *spot, int64_t *place) {
    const char *text = spot->node->text;
    char *end = NULL;
    errno = 0;
    long long value = text ? strtoll(text, &end, 10) : 0;
    if (!text || !*text || isspace((unsigned char)*text) || *end || errno)
        mismatch(spot, errno ? "; it is too large" : "");
    else if (in_range(spot, (double)value))
        *place = value;
}

static void read_boolean(const struct kr_deck_spot *spot, int *place) {
    const char *text = spot->node->text ? spot->node->text : "";
    if (strcmp(text, "true") && strcmp(text, "false"))
        mismatch(spot, "");
    else
        *place = *text == 't';
}

static void read_choice(const struct kr_deck_spot *spot, int *place) {
    const char *text = spot->node->text ? spot->node->text : "", *word;
    char *cure = NULL;
    int length, found = 0;
    for (size_t i = 0; !found && (word = kr_deck_word(spot->key->words, i, &length)); i++) {
        char *known = kr_text("%.*s", length, word);
        found = !strcmp(text, known);
        if (found)
            *place = (int)i;
        else if (!cure && 3 * kr_deck_distance(text, known) <= strlen(known))
            cure = kr_text("; did you mean '%s'?", known);
        kr_free(known);
    }
    if (!found)
        mismatch(spot, cure ? cure : "");
    kr_free(cure);
}

/* ---- formulas ---- */

/* Sentence about a text that is no expression with finite value; NULL if it is one. A value that
   varies cannot be judged before it is used, so it may be infinite here. */
static char *fault_of(const char *text) {
    char *why = NULL;
    struct kr_expression *expression = kr_expression_create(text, &why);
    if (!expression)
        return why;
    int varies =
        kr_expression_varies_in_space(expression) || kr_expression_varies_in_time(expression);
    if (!varies && !isfinite(kr_expression_value(expression, 0, 0, 0, 0)))
        why = kr_text_copy("its value is not finite");
    kr_expression_free(expression);
    return why;
}

/* Whether a unit may begin at text + i: after a blank, a digit or a bracket, but not in the
   exponent of a number (1e-3) nor within a word. */
static int may_begin_unit(const char *text, size_t i) {
    unsigned char c = (unsigned char)text[i], before = (unsigned char)text[i - 1];
    if (!isalpha(c) && c < 0x80)
        return 0;
    if ((c == 'e' || c == 'E') && (isdigit(before) || before == '.') &&
        (isdigit((unsigned char)text[i + 1]) || strchr("+-", text[i + 1])))
        return 0;
    return isspace(before) || isdigit(before) || before == ')' || before == '.';
}

/* Split off the unit, in place. Returns its factor; 0 where no split works, with a sentence. */
static double split(char *text, const char *unit, char **why) {
    size_t length = strlen(text);
    for (size_t i = length; i-- > 1;) {
        double factor = may_begin_unit(text, i) ? kr_unit_factor(text + i, unit) : 0;
        if (factor == 0)
            continue;
        char *head = kr_text("%.*s", (int)i, text), *fault = fault_of(head);
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
    char *why = NULL, *bare = fault_of(text);
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

static void read_formula(const struct kr_deck_spot *spot, struct kr_deck_formula *place) {
    const char *unit = spot->key->unit;
    char *fault = NULL;
    kr_deck_note(spot, place);
    if (spot->node->kind != KR_DECK_SCALAR || !*spot->node->text) {
        mismatch(spot, "");
        return;
    }
    char *text = kr_deck_own(spot->deck, kr_text_copy(spot->node->text));
    if (!strcmp(text, "free")) {
        *place = (struct kr_deck_formula){text, 1, 1};
    } else if (!strcmp(unit, "1")) {
        fault = fault_of(text);
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

/* ---- lists of values ---- */

/* A comma in brackets ends an item of a YAML list: "[min(t, 1) m, free]" is three. */
static const char *comma_cure(const struct kr_deck_node *node) {
    for (size_t i = 0; i < node->count; i++)
        if (node->item[i]->text && strchr(node->item[i]->text, '(') &&
            !strchr(node->item[i]->text, ')'))
            return "; put an expression with commas in quotes";
    return "";
}

static void read_text(const struct kr_deck_spot *spot, const char **place) {
    kr_deck_note(spot, place);
    if (spot->node->kind == KR_DECK_SCALAR) {
        *place = spot->node->text;
        return;
    }
    char *found = kr_deck_node_show(spot->node);
    kr_deck_complain(spot->deck, spot->node->at, spot->path, "found %s, expected a text", found);
    kr_free(found);
}

/* Read every item of the node's list by the row's type into places of `size` bytes. */
static void read_each(const struct kr_deck_spot *spot, char *place, size_t size) {
    for (size_t i = 0; i < spot->node->count; i++) {
        char *path = kr_text("%s.%zu", spot->path, i);
        struct kr_deck_spot item = *spot;
        item.path = path;
        item.node = spot->node->item[i];
        void *into = place + i * size;
        if (spot->key->type == KR_DECK_FORMULAS)
            read_formula(&item, into);
        else if (spot->key->type == KR_DECK_TEXTS)
            read_text(&item, into);
        else
            read_number(&item, into);
        kr_free(path);
    }
}

static void read_fixed(const struct kr_deck_spot *spot, void *place, size_t size) {
    const struct kr_deck_node *node = spot->node;
    int fewer = spot->key->type == KR_DECK_FORMULAS;
    kr_deck_note(spot, place);
    if (node->kind != KR_DECK_SEQUENCE || node->count > spot->key->count || !node->count ||
        (node->count < spot->key->count && !fewer))
        mismatch(spot, comma_cure(node));
    else
        read_each(spot, place, size);
}

static void read_list(const struct kr_deck_spot *spot, struct kr_deck_list *list, size_t size) {
    kr_deck_note(spot, list);
    if (spot->node->kind != KR_DECK_SEQUENCE) {
        mismatch(spot, "");
        return;
    }
    list->given = spot->given;
    list->count = spot->node->count;
    list->item = kr_deck_own(spot->deck, kr_alloc(list->count, size));
    read_each(spot, list->item, size);
}

void kr_deck_value(const struct kr_deck_spot *spot, void *place) {
    switch (spot->key->type) {
    case KR_DECK_NUMBER:
        read_number(spot, place);
        return;
    case KR_DECK_TEXT:
        read_text(spot, place);
        return;
    case KR_DECK_FORMULA:
        read_formula(spot, place);
        return;
    case KR_DECK_VECTOR:
        read_fixed(spot, place, sizeof(double));
        return;
    case KR_DECK_FORMULAS:
        read_fixed(spot, place, sizeof(struct kr_deck_formula));
        return;
    case KR_DECK_NUMBERS:
        read_list(spot, place, sizeof(double));
        return;
    case KR_DECK_TEXTS:
        read_list(spot, place, sizeof(char *));
        return;
    default:
        break;
    }
    kr_deck_note(spot, place);
    if (spot->key->type == KR_DECK_INTEGER)
        read_integer(spot, place);
    else if (spot->key->type == KR_DECK_BOOLEAN)
        read_boolean(spot, place);
    else
        read_choice(spot, place);
}
