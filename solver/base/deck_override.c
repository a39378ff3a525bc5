/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Variants and --set: values under dotted keys, laid over the tree before the table reads it, so
 * that they are checked like all others. `loads.0.ramp` reaches into a list. A section laid over a
 * section replaces only the keys that it names.
 */
#include "base/deck_private.h"
#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* One change: a value on its way to its place. */
struct change {
    struct kr_deck *deck;
    const char *dotted;
    struct kr_deck_mark at;
};

/* Index that a part of a dotted key stands for; complains and gives NULL if the list has no such
   item. */
static struct kr_deck_node **item_at(const struct change *change, const struct kr_deck_node *list,
                                     const char *part) {
    char *end;
    unsigned long index = strtoul(part, &end, 10);
    if (*part >= '0' && *part <= '9' && !*end && index < list->count)
        return &list->item[index];
    if (list->count)
        kr_deck_complain(change->deck, change->at, change->dotted,
                         "'%s' is no item of a list of %zu; they are counted from 0 to %zu", part,
                         list->count, list->count - 1);
    else
        kr_deck_complain(change->deck, change->at, change->dotted, "the list is empty");
    return NULL;
}

static void no_section(const struct change *change, const struct kr_deck_node *node,
                       const char *part) {
    kr_deck_complain(change->deck, change->at, change->dotted,
                     "'%s' lies within '%s', which is a value and no section", part, node->text);
}

/* The node below `node` that a part of the key names; sections that are not there are made. */
static struct kr_deck_node *step(const struct change *change, struct kr_deck_node *node,
                                 const char *part) {
    if (node->kind == KR_DECK_SEQUENCE) {
        struct kr_deck_node **item = item_at(change, node, part);
        return item ? *item : NULL;
    }
    if (node->kind == KR_DECK_SCALAR && *node->text) {
        no_section(change, node, part);
        return NULL;
    }
    node->kind = KR_DECK_MAPPING;
    struct kr_deck_node *child = kr_deck_node_find(node, part);
    if (!child) {
        child = kr_deck_node_create(KR_DECK_MAPPING, change->at);
        child->name = kr_text_copy(part);
        kr_deck_node_add(node, child);
    }
    return child;
}

static void put_key(struct kr_deck_node *section, struct kr_deck_node *value);

/* Lay `value` over what stands at `place`. */
static void replace(struct kr_deck_node **place, struct kr_deck_node *value) {
    if ((*place)->kind == KR_DECK_MAPPING && value->kind == KR_DECK_MAPPING) {
        for (size_t i = 0; i < value->count; i++)
            put_key(*place, value->item[i]);
        value->count = 0;
        kr_deck_node_free(value);
    } else {
        kr_deck_node_free(*place);
        *place = value;
    }
}

static void put_key(struct kr_deck_node *section, struct kr_deck_node *value) {
    for (size_t i = 0; i < section->count; i++)
        if (!strcmp(section->item[i]->name, value->name)) {
            replace(&section->item[i], value);
            return;
        }
    kr_deck_node_add(section, value);
}

/* Put the value under the last part of its key. Takes it over. */
static void put(const struct change *change, struct kr_deck_node *node, const char *part,
                struct kr_deck_node *value) {
    kr_free(value->name);
    value->name = kr_text_copy(part);
    value->name_at = change->at;
    if (node->kind == KR_DECK_SEQUENCE) {
        struct kr_deck_node **item = item_at(change, node, part);
        if (item)
            replace(item, value);
        else
            kr_deck_node_free(value);
    } else if (node->kind == KR_DECK_SCALAR && *node->text) {
        no_section(change, node, part);
        kr_deck_node_free(value);
    } else {
        node->kind = KR_DECK_MAPPING;
        put_key(node, value);
    }
}

/* Lay a value over the tree. Takes it over. */
static void lay(struct kr_deck *deck, const char *dotted, struct kr_deck_node *value,
                struct kr_deck_mark at) {
    struct change change = {deck, dotted, at};
    struct kr_deck_node *node = deck->root;
    char *parts = kr_text_copy(dotted), *part = parts, *dot;
    for (; node && (dot = strchr(part, '.')); part = dot + 1) {
        *dot = 0;
        node = step(&change, node, part);
    }
    if (node)
        put(&change, node, part, value);
    else
        kr_deck_node_free(value);
    kr_free(parts);
}

/* Lay one text of --set over the tree. */
static void lay_set(struct kr_deck *deck, const char *set) {
    const struct kr_deck_mark at = {0, 0};
    const char *equals = strchr(set, '=');
    if (!equals || equals == set) {
        kr_deck_complain(deck, at, NULL,
                         "--set '%.60s': expected a key and its value, such as "
                         "'--set mesh.spacing=\"0.1 mm\"'",
                         set);
        return;
    }
    char *dotted = kr_text("%.*s", (int)(equals - set), set), *why = NULL;
    struct kr_deck_node *value = kr_deck_parse(deck, equals + 1, strlen(equals + 1), &at, &why);
    if (value)
        lay(deck, dotted, value, at);
    else
        kr_deck_complain(deck, at, dotted, "'%.60s' is no YAML: %s", equals + 1, why);
    kr_free(why);
    kr_free(dotted);
}

/* Take the key `variants` out of the tree: it is no part of the case itself. */
static void take_variants(struct kr_deck *deck) {
    struct kr_deck_node *root = deck->root;
    for (size_t i = 0; i < root->count; i++)
        if (!strcmp(root->item[i]->name, "variants")) {
            deck->variants = root->item[i];
            memmove(root->item + i, root->item + i + 1, (root->count - i - 1) * sizeof *root->item);
            root->count--;
            return;
        }
}

/* Names of all variants, "full, coarse", owned by the caller. */
static char *variant_names(const struct kr_deck *deck) {
    char *names = kr_text_copy("");
    for (size_t i = 0; deck->variants && i < deck->variants->count; i++) {
        char *more = kr_text("%s%s'%s'", names, i ? ", " : "", deck->variants->item[i]->name);
        kr_free(names);
        names = more;
    }
    return names;
}

static void lay_variant(struct kr_deck *deck, const char *name) {
    int usable = deck->variants && deck->variants->kind == KR_DECK_MAPPING;
    struct kr_deck_node *variant = usable ? kr_deck_node_find(deck->variants, name) : NULL;
    if (!variant) {
        char *names = usable ? variant_names(deck) : kr_text_copy("");
        kr_deck_complain(deck, (struct kr_deck_mark){0, 0}, NULL,
                         "unknown variant '%.60s'; the deck has %s", name, *names ? names : "none");
        kr_free(names);
    } else if (variant->kind == KR_DECK_MAPPING) {
        for (size_t i = 0; i < variant->count; i++) {
            char *dotted = kr_text_copy(variant->item[i]->name);
            lay(deck, dotted, variant->item[i], variant->item[i]->name_at);
            kr_free(dotted);
        }
        variant->count = 0;
    }
}

void kr_deck_override(struct kr_deck *deck, const char *variant, size_t n_set,
                      const char *const *set) {
    take_variants(deck);
    if (variant)
        lay_variant(deck, variant);
    for (size_t i = 0; i < n_set; i++)
        lay_set(deck, set[i]);
}

static int has_items(const struct kr_deck_key *row) {
    return row->type == KR_DECK_LIST || row->type == KR_DECK_MAP || row->type == KR_DECK_VECTOR ||
           row->type == KR_DECK_NUMBERS || row->type == KR_DECK_TEXTS ||
           row->type == KR_DECK_FORMULAS;
}

/* Row and rest of a dotted key: complains and gives NULL where the table does not know it. */
static const struct kr_deck_key *follow(struct kr_deck *deck, const struct kr_deck_node *key,
                                        const char *path) {
    const struct kr_deck_key *keys = deck->keys, *row = NULL;
    char *parts = kr_text_copy(key->name), *rest = parts, *part;
    while (keys && (part = strsep(&rest, "."))) {
        row = kr_deck_row(keys, part);
        if (!row) {
            kr_deck_unknown(deck, keys, part, key->name_at, path);
            break;
        }
        keys = row->keys;
        if (has_items(row) && rest)
            strsep(&rest, "."); /* the number or name of an item */
    }
    if (row && !keys && rest) {
        kr_deck_complain(deck, key->name_at, path, "'%s' holds no keys", row->name);
        row = NULL;
    }
    kr_free(parts);
    return row;
}

void kr_deck_check_variants(struct kr_deck *deck) {
    const struct kr_deck_node *all = deck->variants;
    if (!all || (all->kind == KR_DECK_SCALAR && !*all->text))
        return;
    if (all->kind != KR_DECK_MAPPING)
        kr_deck_complain(deck, all->name_at, "variants",
                         "expected variants by name, each with keys and values, such as "
                         "'full: {mesh.spacing: 0.04 mm}'");
    for (size_t i = 0; i < all->count && all->kind == KR_DECK_MAPPING; i++) {
        const struct kr_deck_node *variant = all->item[i];
        char *path = kr_text("variants.%s", variant->name);
        if (variant->kind != KR_DECK_MAPPING)
            kr_deck_complain(deck, variant->name_at, path,
                             "expected keys and values, such as '{mesh.spacing: 0.04 mm}'");
        for (size_t j = 0; j < variant->count && variant->kind == KR_DECK_MAPPING; j++) {
            char *full = kr_text("%s: %s", path, variant->item[j]->name);
            follow(deck, variant->item[j], full);
            kr_free(full);
        }
        kr_free(path);
    }
}
