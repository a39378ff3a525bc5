/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What the files of the deck share; nobody else includes it.
 *
 *   deck_tree.c      YAML text -> tree of nodes with positions (the only file that knows libfyaml)
 *   deck_override.c  variants and --set: changes to the tree
 *   deck_read.c      tree + table -> struct, key by key
 *   deck_value.c     one scalar of the tree -> one place in the struct
 *   deck_formula.c   the same for expressions with units
 *   deck_nearest.c   "did you mean"
 *   deck_print.c     the deck as understood, and the reference of its keys
 *   deck.c           opening, faults, closing
 */
#ifndef KR_DECK_PRIVATE_H
#define KR_DECK_PRIVATE_H

#include "base/deck.h"

enum kr_deck_kind { KR_DECK_SCALAR, KR_DECK_SEQUENCE, KR_DECK_MAPPING };

/** Place in the deck file, from 1; line 0: the command line. */
struct kr_deck_mark {
    int line, column;
};

/** One value of the YAML tree, with the key it stands under. */
struct kr_deck_node {
    enum kr_deck_kind kind;
    char *name;                  /* its key, NULL for items of a sequence and the root */
    struct kr_deck_mark at;      /* of the value (a mapping's: its first key) */
    struct kr_deck_mark name_at; /* of the key */
    char *text;                  /* SCALAR; "" where nothing is written */
    int refused;                 /* a fault was found already; there is nothing to read */
    size_t count, room;
    struct kr_deck_node **item; /* SEQUENCE, MAPPING */
};

struct kr_deck_complaint {
    struct kr_deck_mark at;
    size_t number; /* keeps the order of those on one place */
    char *text;    /* with the key, without the place */
};

/** A place in the struct that was read and where its value came from. */
struct kr_deck_field {
    const void *address;
    char *path; /* "geometry.holes.0.radius" */
    struct kr_deck_mark at;
    int given;
    size_t count; /* of components, where it is a list */
};

struct kr_deck {
    char *path, *folder;
    struct kr_deck_node *root;
    struct kr_deck_node *variants; /* part of the root until the deck is read */
    const char *variant;           /* the chosen one; NULL: none */
    const struct kr_deck_key *keys;
    const void *into;
    size_t n_faults, faults_room, n_fields, fields_room, n_kept, kept_room, n_spare, spare_room;
    struct kr_deck_complaint *fault;
    struct kr_deck_field *field;
    void **kept;                 /* arrays that end with the deck */
    struct kr_deck_node **spare; /* trees of defaults */
};

/** Where the reader stands: handed down from section to key. */
struct kr_deck_spot {
    struct kr_deck *deck;
    const struct kr_deck_key *key;   /* the row */
    const struct kr_deck_node *node; /* the value */
    const char *path;                /* "nodes.horizon" */
    int given;                       /* 0: the node is the row's fallback */
};

/* ---- deck.c */
/** Add a fault at a place; `path` (or NULL) is the key it is about. */
void kr_deck_complain(struct kr_deck *deck, struct kr_deck_mark at, const char *path,
                      const char *format, ...) __attribute__((format(printf, 4, 5)));
/** Note where the value at an address came from. */
void kr_deck_note(const struct kr_deck_spot *spot, const void *address);
/** Hand an array over to the deck. Returns it. */
void *kr_deck_own(struct kr_deck *deck, void *array);

/* ---- deck_tree.c */
/** Parse YAML. `at` is NULL for the deck file (the tree carries its places, and what is no YAML
 *  stops); else all nodes get that place, and what is no YAML gives NULL and a sentence in why. */
struct kr_deck_node *kr_deck_parse(struct kr_deck *deck, const char *text, size_t length,
                                   const struct kr_deck_mark *at, char **why);
struct kr_deck_node *kr_deck_node_create(enum kr_deck_kind kind, struct kr_deck_mark at);
void kr_deck_node_add(struct kr_deck_node *parent, struct kr_deck_node *child);
void kr_deck_node_free(struct kr_deck_node *node);
/** The value under a key of a mapping; NULL if there is none. */
struct kr_deck_node *kr_deck_node_find(const struct kr_deck_node *mapping, const char *name);
/** What was found, in words: "'0.16'", "nothing", "a list of 3", "a section". By the caller. */
char *kr_deck_node_show(const struct kr_deck_node *node);

/* ---- deck_override.c */
/** Lay the chosen variant and the texts of --set over the tree. */
void kr_deck_override(struct kr_deck *deck, const char *variant, size_t n_set,
                      const char *const *set);
/** Check that the variants not chosen name known keys. */
void kr_deck_check_variants(struct kr_deck *deck);

/* ---- deck_value.c */
/** Read the node of a row that is no section, list or map of keys. Faults are collected. */
void kr_deck_value(const struct kr_deck_spot *spot, void *place);
/** Complain: "found '3', expected true or false", and `cure` behind it. */
void kr_deck_mismatch(const struct kr_deck_spot *spot, const char *cure);
/** Put NaN into the numbers of a row that cannot be read or is missing. */
void kr_deck_spoil(const struct kr_deck_key *key, void *place);
/* ---- deck_expected.c: what is expected, as a part of a sentence, owned by the caller */
/** Of a row; and of one number of it, as "a length in mm", "a pure number". */
char *kr_deck_expected(const struct kr_deck_key *key);
char *kr_deck_expected_number(const struct kr_deck_key *key);
/** The n-th of words separated by blanks: its beginning and length; NULL past the last. */
const char *kr_deck_word(const char *words, size_t n, int *length);

/* ---- deck_formula.c */
/** Read one formula. Faults are collected. */
void kr_deck_formula_read(const struct kr_deck_spot *spot, struct kr_deck_formula *place);

/* ---- deck_nearest.c */
/** How many letters must change to make b from a, upper and lower case and - and _ being equal. */
size_t kr_deck_distance(const char *a, const char *b);
/** The row of a table whose name is nearest to `name`, NULL if none is near. */
const struct kr_deck_key *kr_deck_nearest(const struct kr_deck_key *keys, const char *name);
/** Dotted path of a key of this name (or near it, if `near`) anywhere in the table, by the caller;
 *  NULL if there is none. */
char *kr_deck_elsewhere(const struct kr_deck_key *keys, const char *name, int near);

/** Row of the table by name, NULL if there is none. */
const struct kr_deck_key *kr_deck_row(const struct kr_deck_key *keys, const char *name);
/** Complain about a key that the table does not know, with the nearest one that it does. */
void kr_deck_unknown(struct kr_deck *deck, const struct kr_deck_key *keys, const char *name,
                     struct kr_deck_mark at, const char *path);

#endif
