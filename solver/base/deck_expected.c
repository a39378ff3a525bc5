/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What the deck expects of a key, as a part of a sentence.
 */
#include "base/deck_private.h"
#include "base/memory.h"
#include "base/unit.h"

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

char *kr_deck_expected_number(const struct kr_deck_key *key) {
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
    char *one = kr_deck_expected_number(key), *text;
    if (key->type == KR_DECK_VECTOR && key->fewest)
        text = kr_text("a list of %zu or %zu, each %s", key->fewest, key->count, one);
    else if (key->type == KR_DECK_VECTOR)
        text = kr_text("a list of %zu, each %s", key->count, one);
    else if (key->type == KR_DECK_NUMBERS && key->count > 1)
        text = kr_text("a list of lists of %zu, each %s", key->count, one);
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
        return kr_deck_expected_number(key);
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
        part = kr_deck_expected_number(key);
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
