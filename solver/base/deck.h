/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The deck: a YAML file read into a C struct by a table, one row a key. The same table checks the
 * deck, gives the defaults and prints the reference in docs/deck.md, so none can drift.
 *
 * All faults are collected, each with line and column, what was found, what was expected and the
 * nearest known key; kr_deck_finish prints them together and stops (exit 2).
 *
 *    struct kr_deck *deck = kr_deck_open("case.yaml", NULL, 0, NULL);
 *    kr_deck_read(deck, kr_case_keys, &c);
 *    if (c.horizon < 3 * c.spacing)
 *        kr_deck_fault(deck, &c.horizon, "horizon %g m is below 3 spacings; ...", c.horizon);
 *    kr_deck_finish(deck);
 */
#ifndef KR_DECK_H
#define KR_DECK_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/** What a key holds, and the C type of its place in the struct. */
enum kr_deck_type {
    KR_DECK_NUMBER,     /* double, in the row's SI unit */
    KR_DECK_INTEGER,    /* int64_t */
    KR_DECK_BOOLEAN,    /* int: `true` or `false` */
    KR_DECK_CHOICE,     /* int: place in the row's list of words */
    KR_DECK_TEXT,       /* const char *, owned by the deck */
    KR_DECK_VECTOR,     /* double[count]: `[50 mm, 25 mm]`; with `fewest`, at least so many */
    KR_DECK_NUMBERS,    /* struct kr_deck_list of double: a list of any length; with `count`, of
                           lists of so many: `[[0 mm, 0 mm], [2 mm, 1 mm]]`, one after the other */
    KR_DECK_TEXTS,      /* struct kr_deck_list of const char * */
    KR_DECK_FORMULA,    /* struct kr_deck_formula: expression in x, y, z, t, then a unit */
    KR_DECK_FORMULAS,   /* struct kr_deck_formula[count]: one a component; `free` leaves one out */
    KR_DECK_SECTION,    /* the row's `keys`, into the same struct */
    KR_DECK_LIST,       /* struct kr_deck_list of items of `item_size`, each read by `keys` */
    KR_DECK_MAP,        /* the same, each item under a name of the user's choice; an item begins
                           with `const char *name` */
};

/** An array owned by the deck. `given` tells a missing list from an empty one. */
struct kr_deck_list {
    size_t count;
    void *item;
    int given;
};

/** A value that may vary in space and time: text of the expression (SI: x, y, z in m, t in s),
 *  times `factor` (from the unit written behind it to SI). `text` is NULL where the key is not
 *  given; `is_free` is set by the word `free`: this component is not prescribed. */
struct kr_deck_formula {
    const char *text;
    double factor;
    int is_free;
};

/** One key of the deck. Rows of a table end with a row whose name is NULL. */
struct kr_deck_key {
    const char *name;
    enum kr_deck_type type;
    size_t offset;         /* of its place in the struct (for a SECTION: added to its keys') */
    const char *unit;      /* SI unit, "m", "Pa", "kg/m^3"; "1" for a pure number */
    const char *fallback;  /* default as it would stand in a deck; NULL: must be given;
                              "": optional, the place stays zeroed */
    double least, most;    /* allowed range in SI, for each number; both 0: any finite number */
    int exclusive;         /* the value must lie above `least`, not at it */
    const char *words;     /* CHOICE: "near-boundary uniform"; the first is 0 */
    size_t count;          /* VECTOR, FORMULAS: how many; NUMBERS: in each; a FORMULAS may be given fewer */
    size_t fewest;         /* VECTOR: the least that may be given (2 in 2D); 0: just `count` */
    const struct kr_deck_key *keys; /* SECTION, LIST, MAP */
    size_t item_size;               /* LIST, MAP */
    const char *text;               /* one or two sentences for the reference */
};

struct kr_deck; /* Opaque. Implemented in deck.c. */

/** Open and parse a deck.
 *
 *  in  path      YAML file
 *  in  variant   NULL, or a name under the deck's own top-level key `variants`, a map of maps from
 *                dotted key to value (`full: {mesh.spacing: 0.04 mm}`), laid over the deck
 *  in  set       n_set texts "mesh.spacing=0.1 mm" from the command line, laid over both
 *
 *  Stops (exit 2) if the file cannot be read or is no YAML, with line and column. An unknown
 *  variant or a bad `set` is a fault, reported with the others.
 */
struct kr_deck *kr_deck_open(const char *path, const char *variant, size_t n_set,
                             const char *const *set);

/** Read the deck by a table into a zeroed struct. Faults are collected: unknown key (with the
 *  nearest known one), missing key, key given twice, missing or wrong unit, out of range, not a
 *  number, wrong shape, unknown word. */
void kr_deck_read(struct kr_deck *deck, const struct kr_deck_key *keys, void *into);

/** Add a fault found later. `field` is the address, within the struct read, of the value at fault:
 *  the message then begins with its line, column and key; NULL for none. The address of an item of
 *  a list or of one number of a vector also works. */
void kr_deck_fault(struct kr_deck *deck, const void *field, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/** Fault a name that is none of those known: "no boundary is called 'tpo'; did you mean 'top'? There
 *  are top, left, ...", those of near spelling first.
 *
 *  in  field   the place, within the struct read, of the name (KR_DECK_TEXT)
 *  in  kind    "boundary"
 *  in  known   (n)
 */
void kr_deck_fault_name(struct kr_deck *deck, const char *const *field, const char *kind, size_t n,
                        const char *const *known);

/** Whether the deck (or a variant, or the command line) gives this value itself. */
int kr_deck_given(const struct kr_deck *deck, const void *field);

/** How many components of a VECTOR or FORMULAS the deck gives itself; 0: the key is not given, or was
 *  at fault. */
size_t kr_deck_count(const struct kr_deck *deck, const void *field);

/** "case.yaml:12:5: nodes.horizon" of a value, for messages after the deck was finished; owned by
 *  the deck. */
const char *kr_deck_where(struct kr_deck *deck, const void *field);

/** Hand a text of kr_text over to the deck: it is freed with it. Returns it. */
const char *kr_deck_keep(struct kr_deck *deck, char *text);

/** Number of faults so far. */
size_t kr_deck_faults(const struct kr_deck *deck);

/** Where there are faults: print them all in the order of their lines, then a line that counts
 *  them, and stop (exit 2). */
void kr_deck_finish(struct kr_deck *deck);

/** The deck as it was understood: every key with its value in SI, defaults included, one a line
 *  ("nodes.horizon = 0.00016 m"), in the table's order. Owned by the caller. `sections` picks
 *  top-level keys, "geometry mesh"; NULL takes all. Equal decks give equal text: it is what
 *  hashes and "is this step out of date" are made from. */
char *kr_deck_resolved(const struct kr_deck *deck, const char *sections);

/** Print the reference of a table as Markdown: key, unit, default, range, meaning. */
void kr_deck_reference(FILE *file, const struct kr_deck_key *keys);

/** Folder of the deck file ("." if none is named), owned by the deck. */
const char *kr_deck_folder(const struct kr_deck *deck);

/** Path of a file that the deck names, seen from its folder; owned by the caller. */
char *kr_deck_beside(const struct kr_deck *deck, const char *file);

/** Path as it was given to kr_deck_open, owned by the deck. */
const char *kr_deck_path(const struct kr_deck *deck);

/** Free all that was read; values in the struct that point into the deck end with it. */
void kr_deck_close(struct kr_deck *deck);

#endif
