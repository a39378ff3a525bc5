/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tree and table -> struct: sections, lists and maps, down to single values (deck_value.c).
 */
#include "base/deck_private.h"
#include "base/error.h"
#include "base/memory.h"

#include <string.h>

/* A table at work: the mapping it reads and the part of the struct it fills. */
struct reading {
    struct kr_deck *deck;
    const struct kr_deck_key *keys;
    const struct kr_deck_node *mapping;
    const char *path; /* "" at the top */
    int given;
    char *into;
};

static void read_keys(const struct reading *reading);

static int is_empty(const struct kr_deck_node *node) {
    return node->kind == KR_DECK_SCALAR && !*node->text;
}

/* A section may be empty or left out: its keys' defaults then stand. */
static void read_section(const struct kr_deck_spot *spot, char *into) {
    struct kr_deck_node nothing = {.kind = KR_DECK_MAPPING, .at = spot->node->at};
    const struct kr_deck_node *mapping = is_empty(spot->node) ? &nothing : spot->node;
    if (mapping->kind != KR_DECK_MAPPING)
        kr_deck_mismatch(spot, "");
    else
        read_keys(
            &(struct reading){spot->deck, spot->key->keys, mapping, spot->path, spot->given, into});
}

/* One item of a list or map, with its own table. */
static void read_item(const struct kr_deck_spot *spot, char *into) {
    kr_deck_note(spot, into);
    if (spot->node->kind == KR_DECK_MAPPING) {
        read_keys(&(struct reading){spot->deck, spot->key->keys, spot->node, spot->path,
                                    spot->given, into});
        return;
    }
    char *found = kr_deck_node_show(spot->node);
    kr_deck_complain(spot->deck, spot->node->at, spot->path,
                     "found %s, expected keys and values, such as '%s: ...'", found,
                     spot->key->keys->name);
    kr_free(found);
}

static void read_items(const struct kr_deck_spot *spot, struct kr_deck_list *list) {
    const struct kr_deck_node *node = spot->node;
    int is_map = spot->key->type == KR_DECK_MAP;
    kr_deck_note(spot, list);
    if (node->kind != (is_map ? KR_DECK_MAPPING : KR_DECK_SEQUENCE)) {
        kr_deck_mismatch(spot, "");
        return;
    }
    list->given = spot->given;
    list->count = node->count;
    list->item = kr_deck_own(spot->deck, kr_alloc(node->count, spot->key->item_size));
    for (size_t i = 0; i < node->count; i++) {
        char *into = (char *)list->item + i * spot->key->item_size;
        char *path = is_map ? kr_text("%s.%s", spot->path, node->item[i]->name)
                            : kr_text("%s.%zu", spot->path, i);
        struct kr_deck_spot item = *spot;
        item.node = node->item[i];
        item.path = path;
        if (is_map)
            memcpy(into, &node->item[i]->name, sizeof(char *));
        read_item(&item, into);
        kr_free(path);
    }
}

/* The tree of a row's default, which is written as it would stand in a deck. */
static const struct kr_deck_node *fallback_of(const struct reading *reading,
                                              const struct kr_deck_key *key) {
    struct kr_deck *deck = reading->deck;
    char *why = NULL;
    struct kr_deck_mark at = reading->mapping->at;
    struct kr_deck_node *node =
        kr_deck_parse(deck, key->fallback, strlen(key->fallback), &at, &why);
    kr_assert(node);
    KR_GROW(deck->spare, deck->n_spare, deck->spare_room);
    return deck->spare[deck->n_spare++] = node;
}

static void dispatch(const struct kr_deck_spot *spot, char *place) {
    switch (spot->key->type) {
    case KR_DECK_SECTION:
        read_section(spot, place);
        break;
    case KR_DECK_LIST:
    case KR_DECK_MAP:
        read_items(spot, (struct kr_deck_list *)(void *)place);
        break;
    default:
        kr_deck_value(spot, place);
    }
}

/* Whether an unknown key of the mapping is this one misspelt: it is then not missing as well. */
static int is_misspelt(const struct reading *reading, const struct kr_deck_key *key) {
    for (size_t i = 0; i < reading->mapping->count; i++) {
        const char *name = reading->mapping->item[i]->name;
        if (!kr_deck_row(reading->keys, name) && kr_deck_nearest(reading->keys, name) == key)
            return 1;
    }
    return 0;
}

/* Complain about a key that must be given. */
static void miss(const struct reading *reading, const struct kr_deck_spot *spot) {
    if (is_misspelt(reading, spot->key))
        return;
    char *expected = kr_deck_expected(spot->key);
    kr_deck_complain(spot->deck, spot->node->at, spot->path, "missing; expected %s", expected);
    kr_free(expected);
}

/* Read one row of the table: what the deck gives, or the default, or nothing where it may lack. */
static void read_row(const struct reading *reading, const struct kr_deck_key *key) {
    struct kr_deck_node nothing = {.kind = KR_DECK_MAPPING, .at = reading->mapping->at};
    const struct kr_deck_node *node = kr_deck_node_find(reading->mapping, key->name);
    char *path = kr_text("%s%s%s", reading->path, *reading->path ? "." : "", key->name);
    char *place = reading->into + key->offset;
    struct kr_deck_spot spot = {reading->deck, key, node ? node : &nothing, path,
                                node && reading->given};
    if (node && node->refused) {
        kr_deck_note(&spot, place);
        kr_deck_spoil(key, place);
    } else if (node || key->type == KR_DECK_SECTION) {
        dispatch(&spot, place);
    } else if (key->fallback && *key->fallback) {
        spot.node = fallback_of(reading, key);
        dispatch(&spot, place);
    } else {
        kr_deck_note(&spot, place);
        if (!key->fallback) {
            miss(reading, &spot);
            kr_deck_spoil(key, place);
        }
    }
    kr_free(path);
}

static void read_keys(const struct reading *reading) {
    for (size_t i = 0; i < reading->mapping->count; i++) {
        const struct kr_deck_node *node = reading->mapping->item[i];
        if (kr_deck_row(reading->keys, node->name))
            continue;
        char *path = kr_text("%s%s%s", reading->path, *reading->path ? "." : "", node->name);
        kr_deck_unknown(reading->deck, reading->keys, node->name, node->name_at, path);
        kr_free(path);
    }
    for (const struct kr_deck_key *key = reading->keys; key->name; key++)
        read_row(reading, key);
}

void kr_deck_read(struct kr_deck *deck, const struct kr_deck_key *keys, void *into) {
    kr_assert(!deck->keys);
    deck->keys = keys;
    deck->into = into;
    read_keys(&(struct reading){deck, keys, deck->root, "", 1, into});
    kr_deck_check_variants(deck);
}
