/* SPDX-License-Identifier: BSD-3-Clause
 *
 * "Did you mean": the key or name nearest to one that is unknown, by the number of letters to insert, to leave out, to
 * replace, or to exchange with their neighbours (Damerau, Commun. ACM 7, 1964).
 */
#include "base/deck_private.h"
#include "base/memory.h"

#include <ctype.h>
#include <string.h>

/* Longer names are no misspelt keys. */
enum { LONGEST = 64 };

static int letter(char c) {
    return c == '_' || c == ' ' ? '-' : tolower((unsigned char)c);
}

static size_t least(size_t a, size_t b) {
    return a < b ? a : b;
}

size_t kr_deck_distance(const char *a, const char *b) {
    size_t table[3][LONGEST + 1], n = strlen(a), m = strlen(b); /* of the rows i, i - 1, i - 2 by turns */
    if (n > LONGEST || m > LONGEST)
        return LONGEST;
    for (size_t j = 0; j <= m; j++)
        table[0][j] = j;
    for (size_t i = 1; i <= n; i++) {
        size_t *row = table[i % 3];
        const size_t *above = table[(i - 1) % 3], *before = table[(i + 1) % 3];
        row[0] = i;
        for (size_t j = 1; j <= m; j++) {
            row[j] = above[j - 1] + (letter(a[i - 1]) != letter(b[j - 1]));
            row[j] = least(row[j], least(above[j], row[j - 1]) + 1);
            if (i > 1 && j > 1 && letter(a[i - 1]) == letter(b[j - 2]) &&
                letter(a[i - 2]) == letter(b[j - 1]))
                row[j] = least(row[j], before[j - 2] + 1);
        }
    }
    return table[n % 3][m];
}

/* Near: at most a third of the letters differ. */
static int is_near(const char *name, const char *known) {
    return 3 * kr_deck_distance(name, known) <= strlen(known);
}

const struct kr_deck_key *kr_deck_row(const struct kr_deck_key *keys, const char *name) {
    for (; keys->name; keys++)
        if (!strcmp(keys->name, name))
            return keys;
    return NULL;
}

/* Twice the distance, and one more where the first letters differ: people rarely miss that one. */
static size_t rank(const char *name, const char *known) {
    return 2 * kr_deck_distance(name, known) + (letter(*name) != letter(*known));
}

const struct kr_deck_key *kr_deck_nearest(const struct kr_deck_key *keys, const char *name) {
    const struct kr_deck_key *best = NULL;
    for (; keys->name; keys++)
        if (is_near(name, keys->name) && (!best || rank(name, keys->name) < rank(name, best->name)))
            best = keys;
    return best;
}

char *kr_deck_elsewhere(const struct kr_deck_key *keys, const char *name, int near) {
    const struct kr_deck_key *here = near ? kr_deck_nearest(keys, name) : kr_deck_row(keys, name);
    if (here)
        return kr_text_copy(here->name);
    for (; keys->name; keys++) {
        char *below = keys->keys ? kr_deck_elsewhere(keys->keys, name, near) : NULL;
        if (below) {
            const char *between = keys->type == KR_DECK_LIST  ? ".0."
                                  : keys->type == KR_DECK_MAP ? ".NAME."
                                                              : ".";
            char *path = kr_text("%s%s%s", keys->name, between, below);
            kr_free(below);
            return path;
        }
    }
    return NULL;
}

/* All names of a table, "grid, spacing, padding", owned by the caller. */
static char *names_of(const struct kr_deck_key *keys) {
    char *names = kr_text_copy("");
    for (size_t i = 0; keys[i].name; i++) {
        char *more = kr_text("%s%s%s", names, i ? ", " : "", keys[i].name);
        kr_free(names);
        names = more;
    }
    return names;
}

/* "'spacing' belongs to section 'mesh'", or "did you mean 'mesh.spacing'?". NULL: not known. */
static char *belongs(const struct kr_deck_key *all, const char *name, int near) {
    char *path = kr_deck_elsewhere(all, name, near);
    if (!path)
        return NULL;
    char *dot = strrchr(path, '.'), *sentence;
    if (near || !dot) {
        sentence =
            kr_text(near ? "did you mean '%s'?" : "'%s' belongs to the top of the deck", path);
    } else {
        *dot = 0;
        sentence = kr_text("'%s' belongs to section '%s'", name, path);
    }
    kr_free(path);
    return sentence;
}

void kr_deck_unknown(struct kr_deck *deck, const struct kr_deck_key *keys, const char *name,
                     struct kr_deck_mark at, const char *path) {
    const struct kr_deck_key *near = kr_deck_nearest(keys, name);
    char *cure = belongs(deck->keys, name, 0);
    if (!cure && near)
        cure = kr_text("did you mean '%s'?", near->name);
    if (!cure)
        cure = belongs(deck->keys, name, 1);
    if (!cure) {
        char *names = names_of(keys);
        cure = kr_text("known here: %s", names);
        kr_free(names);
    }
    kr_deck_complain(deck, at, path, "unknown key; %s", cure);
    kr_free(cure);
}

/* ---- names that the user chose ---- */

/* More are counted, not listed. */
enum { LISTED = 16 };

/* The known names in an order for reading: near ones by their rank, then the others as they come. */
static const char **in_order(const char *name, size_t n, const char *const *known) {
    const char **order = KR_NEW(const char *, n);
    size_t near = 0, far = 0;
    for (size_t k = 0; k < n; k++) {
        size_t at = near + far;
        if (is_near(name, known[k])) {
            for (at = near++; at > 0 && rank(name, known[k]) < rank(name, order[at - 1]);)
                at--;
        } else {
            far++;
        }
        memmove(order + at + 1, order + at, (near + far - 1 - at) * sizeof *order);
        order[at] = known[k];
    }
    return order;
}

void kr_deck_fault_name(struct kr_deck *deck, const char *const *field, const char *kind, size_t n,
                        const char *const *known) {
    const char **order = in_order(*field, n, known);
    char *all = kr_text_copy(n ? "" : "none"), *cure = kr_text("there are");
    for (size_t k = 0; k < n && k < LISTED; k++) {
        char *more = kr_text("%s%s%s", all, k ? ", " : "", order[k]);
        kr_free(all);
        all = more;
    }
    if (n && is_near(*field, order[0])) {
        kr_free(cure);
        cure = kr_text("did you mean '%s'? There are", order[0]);
    }
    char *rest = n > LISTED ? kr_text(" and %zu more", n - LISTED) : kr_text_copy("");
    kr_deck_fault(deck, field, "no %s is called '%.60s'; %s %s%s", kind, *field, cure, all, rest);
    kr_free(rest);
    kr_free(cure);
    kr_free(all);
    kr_free(order);
}
