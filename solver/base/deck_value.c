/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Single values: text of the deck -> number, word, vector in the struct. A number that cannot be
 * read becomes NaN: comparisons with it are false, so that checks made later, before the faults
 * stop the program, do not complain about it a second time.
 */
#include "base/deck_private.h"
#include "base/memory.h"
#include "base/unit.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void kr_deck_mismatch(const struct kr_deck_spot *spot, const char *cure) {
    char *found = kr_deck_node_show(spot->node), *expected = kr_deck_expected(spot->key);
    kr_deck_complain(spot->deck, spot->node->at, spot->path, "found %s, expected %s%s", found,
                     expected, cure);
    kr_free(found);
    kr_free(expected);
}

void kr_deck_spoil(const struct kr_deck_key *key, void *place) {
    size_t count = key->type == KR_DECK_NUMBER ? 1 : key->type == KR_DECK_VECTOR ? key->count : 0;
    for (size_t i = 0; i < count; i++)
        ((double *)place)[i] = NAN;
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
    *place = NAN;
    if (spot->node->kind != KR_DECK_SCALAR || !*spot->node->text) {
        char *found = kr_deck_node_show(spot->node), *expected = kr_deck_expected_number(spot->key);
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
        kr_deck_mismatch(spot, errno ? "; it is too large" : "");
    else if (in_range(spot, (double)value))
        *place = value;
}

static void read_boolean(const struct kr_deck_spot *spot, int *place) {
    const char *text = spot->node->text ? spot->node->text : "";
    if (strcmp(text, "true") && strcmp(text, "false"))
        kr_deck_mismatch(spot, "");
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
        kr_deck_mismatch(spot, cure ? cure : "");
    kr_free(cure);
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
            kr_deck_formula_read(&item, into);
        else if (spot->key->type == KR_DECK_TEXTS)
            read_text(&item, into);
        else
            read_number(&item, into);
        kr_free(path);
    }
}

/* VECTOR and FORMULAS. The whole is noted after its parts, so that the address which it shares with
   the first of them leads to the whole. */
static void read_fixed(const struct kr_deck_spot *spot, void *place, size_t size) {
    const struct kr_deck_node *node = spot->node, unread = {.at = node->at};
    struct kr_deck_spot whole = *spot;
    const char *cure = spot->key->type == KR_DECK_FORMULAS ? comma_cure(node) : "";
    size_t fewest = spot->key->type == KR_DECK_FORMULAS ? 1 : spot->key->fewest;
    if (node->kind != KR_DECK_SEQUENCE || node->count > spot->key->count ||
        node->count < (fewest ? fewest : spot->key->count) || *cure) {
        kr_deck_mismatch(spot, cure);
        kr_deck_spoil(spot->key, place);
        whole.node = &unread;
    } else {
        read_each(spot, place, size);
    }
    kr_deck_note(&whole, place);
}

/* A list of lists of `count` numbers, read into one array. */
static void read_rows(const struct kr_deck_spot *spot, struct kr_deck_list *list) {
    size_t columns = spot->key->count;
    list->count = columns * spot->node->count;
    list->item = kr_deck_own(spot->deck, kr_alloc(list->count, sizeof(double)));
    for (size_t i = 0; i < spot->node->count; i++) {
        char *path = kr_text("%s.%zu", spot->path, i);
        struct kr_deck_spot row = *spot;
        row.path = path;
        row.node = spot->node->item[i];
        if (row.node->kind == KR_DECK_SEQUENCE && row.node->count == columns)
            read_each(&row, (char *)((double *)list->item + i * columns), sizeof(double));
        else
            kr_deck_mismatch(&row, "");
        for (size_t k = 0; row.node->count != columns && k < columns; k++)
            ((double *)list->item)[i * columns + k] = NAN;
        kr_free(path);
    }
}

static void read_list(const struct kr_deck_spot *spot, struct kr_deck_list *list, size_t size) {
    kr_deck_note(spot, list);
    if (spot->node->kind != KR_DECK_SEQUENCE) {
        kr_deck_mismatch(spot, "");
        return;
    }
    list->given = spot->given;
    if (spot->key->type == KR_DECK_NUMBERS && spot->key->count > 1) {
        read_rows(spot, list);
        return;
    }
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
        kr_deck_formula_read(spot, place);
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
