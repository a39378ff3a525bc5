/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What the table knows, in writing: the deck as it was understood, and the reference of all keys.
 */
#include "base/deck_private.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/unit.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the deck as it was understood ---- */

/* The shortest decimal (of six digits or more) that reads back as the same number: 0.00016, not
 * 0.00016000000000000001. */
static void print_number(FILE *file, double value) {
    char text[32];
    int digits = 6;
    do
        snprintf(text, sizeof text, "%.*g", digits, value);
    while (digits++ < 17 && strtod(text, NULL) != value);
    fputs(text, file);
}

/* In quotes and on one line, so that no text can pass for another key. */
static void print_text(FILE *file, const char *text) {
    if (!text) {
        fputs("none", file);
        return;
    }
    fputc('"', file);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            fputc('\\', file);
        if (*text == '\n')
            fputs("\\n", file);
        else
            fputc(*text, file);
    }
    fputc('"', file);
}

static void print_formula(FILE *file, const struct kr_deck_formula *formula) {
    if (!formula->text || formula->is_free) {
        fputs(formula->text ? "free" : "none", file);
        return;
    }
    print_text(file, formula->text);
    fputs(" * ", file);
    print_number(file, formula->factor);
}

/* `count` values of a row's type at `place`, in brackets. */
static void print_many(FILE *file, const struct kr_deck_key *key, const void *place, size_t count) {
    fputc('[', file);
    for (size_t i = 0; i < count; i++) {
        if (i)
            fputs(", ", file);
        if (key->type == KR_DECK_FORMULAS)
            print_formula(file, (const struct kr_deck_formula *)place + i);
        else if (key->type == KR_DECK_TEXTS)
            print_text(file, ((const char *const *)place)[i]);
        else
            print_number(file, ((const double *)place)[i]);
    }
    fputc(']', file);
}

static void print_word(FILE *file, const struct kr_deck_key *key, int value) {
    int length = 0;
    const char *word = kr_deck_word(key->words, (size_t)value, &length);
    kr_assert(word);
    fprintf(file, "%.*s", length, word);
}

static void print_value(FILE *file, const struct kr_deck_key *key, const void *place) {
    const struct kr_deck_list *list = place;
    switch (key->type) {
    case KR_DECK_NUMBER:
        print_number(file, *(const double *)place);
        break;
    case KR_DECK_INTEGER:
        fprintf(file, "%" PRId64, *(const int64_t *)place);
        break;
    case KR_DECK_BOOLEAN:
        fputs(*(const int *)place ? "true" : "false", file);
        break;
    case KR_DECK_CHOICE:
        print_word(file, key, *(const int *)place);
        break;
    case KR_DECK_TEXT:
        print_text(file, *(const char *const *)place);
        break;
    case KR_DECK_FORMULA:
        print_formula(file, place);
        break;
    case KR_DECK_VECTOR:
    case KR_DECK_FORMULAS:
        print_many(file, key, place, key->count);
        break;
    default:
        print_many(file, key, list->item, list->count);
    }
    if (key->unit && strcmp(key->unit, "1"))
        fprintf(file, " %s", key->unit);
}

static void print_keys(FILE *file, const struct kr_deck_key *keys, const char *path,
                       const char *from);

static void print_items(FILE *file, const struct kr_deck_key *key, const char *path,
                        const struct kr_deck_list *list) {
    fprintf(file, "%s: %zu\n", path, list->count);
    for (size_t i = 0; i < list->count; i++) {
        const char *item = (const char *)list->item + i * key->item_size;
        const char *const *name = (const char *const *)(const void *)item;
        char *below =
            key->type == KR_DECK_MAP ? kr_text("%s.%s.", path, *name) : kr_text("%s.%zu.", path, i);
        print_keys(file, key->keys, below, item);
        kr_free(below);
    }
}

static void print_key(FILE *file, const struct kr_deck_key *key, const char *before,
                      const char *from) {
    char *path = kr_text("%s%s", before, key->name);
    const void *place = from + key->offset;
    if (key->type == KR_DECK_SECTION) {
        char *below = kr_text("%s.", path);
        print_keys(file, key->keys, below, place);
        kr_free(below);
    } else if (key->type == KR_DECK_LIST || key->type == KR_DECK_MAP) {
        print_items(file, key, path, place);
    } else {
        fprintf(file, "%s = ", path);
        print_value(file, key, place);
        fputc('\n', file);
    }
    kr_free(path);
}

static void print_keys(FILE *file, const struct kr_deck_key *keys, const char *path,
                       const char *from) {
    for (; keys->name; keys++)
        print_key(file, keys, path, from);
}

/* Whether `name` is among words separated by blanks. */
static int among(const char *name, const char *words) {
    int length;
    const char *word;
    for (size_t i = 0; (word = kr_deck_word(words, i, &length)); i++)
        if (strlen(name) == (size_t)length && !strncmp(name, word, (size_t)length))
            return 1;
    return 0;
}

char *kr_deck_resolved(const struct kr_deck *deck, const char *sections) {
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    kr_assert(file && deck->keys);
    for (const struct kr_deck_key *key = deck->keys; key->name; key++)
        if (!sections || among(key->name, sections))
            print_key(file, key, "", deck->into);
    fclose(file);
    char *copy = kr_text_copy(text);
    free(text);
    return copy;
}

/* ---- the reference ---- */

/* What one writes behind the key. */
static void print_kind(FILE *file, const struct kr_deck_key *key) {
    int length;
    const char *word, *noun = key->unit ? kr_unit_noun(key->unit) : "";
    switch (key->type) {
    case KR_DECK_INTEGER:
        fputs("a whole number", file);
        break;
    case KR_DECK_BOOLEAN:
        fputs("`true` or `false`", file);
        break;
    case KR_DECK_CHOICE:
        for (size_t i = 0; (word = kr_deck_word(key->words, i, &length)); i++)
            fprintf(file, "%s`%.*s`", i ? ", " : "", length, word);
        break;
    case KR_DECK_TEXT:
        fputs("text", file);
        break;
    case KR_DECK_TEXTS:
        fputs("list of texts", file);
        break;
    case KR_DECK_VECTOR:
        if (key->fewest)
            fprintf(file, "list of %zu or %zu, each %s", key->fewest, key->count, noun);
        else
            fprintf(file, "list of %zu, each %s", key->count, noun);
        break;
    case KR_DECK_NUMBERS:
        if (key->count > 1)
            fprintf(file, "list of lists of %zu, each %s", key->count, noun);
        else
            fprintf(file, "list, each %s", noun);
        break;
    case KR_DECK_FORMULA:
        fprintf(file, "formula of %s", noun);
        break;
    case KR_DECK_FORMULAS:
        fprintf(file, "list of up to %zu formulas, each %s", key->count, noun);
        break;
    default:
        fputs(noun, file);
    }
}

static void print_range(FILE *file, const struct kr_deck_key *key) {
    if (key->least == 0 && key->most == 0)
        return;
    const char *unit = key->unit && strcmp(key->unit, "1") ? key->unit : "";
    const char *blank = *unit ? " " : "";
    if (isfinite(key->least))
        fprintf(file, "%s %g%s%s", key->exclusive ? "above" : "from", key->least, blank, unit);
    if (isfinite(key->most))
        fprintf(file, "%sto %g%s%s", isfinite(key->least) ? " " : "", key->most, blank, unit);
}

static void print_row(FILE *file, const struct kr_deck_key *key) {
    int has_unit = key->unit && strcmp(key->unit, "1");
    fprintf(file, "| `%s` | ", key->name);
    print_kind(file, key);
    fprintf(file, " | %s | ", has_unit ? key->unit : "");
    if (!key->fallback)
        fputs("required", file);
    else if (*key->fallback)
        fprintf(file, "`%s`", key->fallback);
    fputs(" | ", file);
    print_range(file, key);
    fprintf(file, " | %s |\n", key->text);
}

static int has_values(const struct kr_deck_key *keys) {
    for (; keys->name; keys++)
        if (!keys->keys)
            return 1;
    return 0;
}

/* A table of the single values, then a heading for everything that has keys of its own. */
static void print_tables(FILE *file, const struct kr_deck_key *keys, const char *path) {
    if (has_values(keys))
        fputs("\n| key | value | SI unit | default | range | meaning |\n"
              "|---|---|---|---|---|---|\n",
              file);
    for (const struct kr_deck_key *key = keys; key->name; key++)
        if (!key->keys)
            print_row(file, key);
    for (const struct kr_deck_key *key = keys; key->name; key++) {
        if (!key->keys)
            continue;
        char *full = kr_text("%s%s", path, key->name);
        char *below = kr_text("%s.%s", full,
                              key->type == KR_DECK_LIST  ? "N."
                              : key->type == KR_DECK_MAP ? "NAME."
                                                         : "");
        fprintf(file, "\n%s `%s`%s\n\n%s\n", *path ? "###" : "##", full,
                key->type == KR_DECK_LIST  ? ", a list"
                : key->type == KR_DECK_MAP ? ", by name"
                                           : "",
                key->text);
        print_tables(file, key->keys, below);
        kr_free(below);
        kr_free(full);
    }
}

void kr_deck_reference(FILE *file, const struct kr_deck_key *keys) {
    fputs(
        "# The deck\n\n"
        "This page is generated by `make docs` from the table that reads the deck.\n\n"
        "A deck is a YAML file. A quantity is written with its unit, `0.16 mm`; any unit that\n"
        "converts to the SI unit in the table will do. A key without a default is optional\n"
        "unless it says required. A formula is an expression in `x`, `y`, `z` [m], `t` [s],\n"
        "`pi` and `e`, followed by its unit, `0.3*min(t/200e-6, 1) m/s` (in quotes where a\n"
        "comma stands within a YAML list); the word `free` leaves a component out.\n\n"
        "Any key can be changed from the command line, `--set mesh.spacing=\"0.1 mm\"` (items of\n"
        "lists by number, from 0: `--set loads.0.ramp=\"10 us\"`), and by a named variant of the\n"
        "deck, chosen with `--variant full`:\n\n"
        "```yaml\nvariants:\n  full: {mesh.spacing: 0.04 mm, nodes.horizon: 0.16 mm}\n```\n",
        file);
    print_tables(file, keys, "");
}
