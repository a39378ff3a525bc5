/* SPDX-License-Identifier: BSD-3-Clause
 *
 * YAML text -> tree of nodes. libfyaml parses; its tree is copied into a plain one, which the rest
 * of the deck can change without knowing libfyaml. Refused on the way, each with its place: keys
 * given twice, aliases (a few lines of them can stand for gigabytes), tags, keys that are no text.
 */
#include "base/deck_private.h"
#include "base/error.h"
#include "base/memory.h"

#include <libfyaml.h>
#include <string.h>

/* More keys than anybody writes; keeps the search for doubles from growing with the square. */
enum { MOST_KEYS = 4096 };

struct copier {
    struct kr_deck *deck;
    const struct kr_deck_mark *at; /* NULL: places of the text itself */
};

struct kr_deck_node *kr_deck_node_create(enum kr_deck_kind kind, struct kr_deck_mark at) {
    struct kr_deck_node *node = KR_NEW(struct kr_deck_node, 1);
    node->kind = kind;
    node->at = node->name_at = at;
    return node;
}

void kr_deck_node_add(struct kr_deck_node *parent, struct kr_deck_node *child) {
    KR_GROW(parent->item, parent->count, parent->room);
    parent->item[parent->count++] = child;
}

void kr_deck_node_free(struct kr_deck_node *node) {
    if (!node)
        return;
    for (size_t i = 0; i < node->count; i++)
        kr_deck_node_free(node->item[i]);
    kr_free(node->item);
    kr_free(node->name);
    kr_free(node->text);
    kr_free(node);
}

struct kr_deck_node *kr_deck_node_find(const struct kr_deck_node *mapping, const char *name) {
    for (size_t i = 0; i < mapping->count; i++)
        if (!strcmp(mapping->item[i]->name, name))
            return mapping->item[i];
    return NULL;
}

char *kr_deck_node_show(const struct kr_deck_node *node) {
    if (node->kind == KR_DECK_SEQUENCE)
        return kr_text("a list of %zu", node->count);
    if (node->kind == KR_DECK_MAPPING)
        return kr_text("a section");
    return *node->text ? kr_text("'%.60s%s'", node->text, strlen(node->text) > 60 ? "..." : "")
                       : kr_text("nothing");
}

/* Place of a libfyaml scalar; `fallback` where it has none (it is not written at all). libfyaml
   marks what stands within quotes; people look for the quote. */
static struct kr_deck_mark mark_of(struct fy_node *from, struct kr_deck_mark fallback) {
    struct fy_token *token = fy_node_is_scalar(from) ? fy_node_get_scalar_token(from) : NULL;
    const struct fy_mark *mark = token ? fy_token_start_mark(token) : NULL;
    enum fy_node_style style = fy_node_get_style(from);
    int quoted =
        mark && mark->column > 0 && (style == FYNS_SINGLE_QUOTED || style == FYNS_DOUBLE_QUOTED);
    return mark ? (struct kr_deck_mark){mark->line + 1, mark->column + 1 - quoted} : fallback;
}

/* Text of a scalar. A NUL can come from an escape ("\0"); it would cut the text silently. */
static char *text_of(struct copier *copier, struct fy_node *from, struct kr_deck_mark at) {
    size_t length = 0;
    const char *text = fy_node_get_scalar(from, &length);
    char *copy = kr_alloc(length + 1, 1);
    if (length)
        memcpy(copy, text, length);
    if (strlen(copy) != length)
        kr_deck_complain(copier->deck, at, NULL, "a text with a zero byte, which no key needs");
    return copy;
}

static struct kr_deck_node *copy_node(struct copier *copier, struct fy_node *from,
                                      struct kr_deck_mark at, const char *path);

static void copy_items(struct copier *copier, struct fy_node *from, struct kr_deck_node *into,
                       const char *path) {
    void *iterator = NULL;
    struct fy_node *item;
    while ((item = fy_node_sequence_iterate(from, &iterator))) {
        char *item_path = kr_text("%s%s%zu", path, *path ? "." : "", into->count);
        struct kr_deck_mark at = copier->at ? *copier->at : mark_of(item, into->at);
        kr_deck_node_add(into, copy_node(copier, item, at, item_path));
        kr_free(item_path);
    }
}

/* Copy one pair of key and value; a key that stands there already is left out. */
static void copy_pair(struct copier *copier, struct fy_node_pair *pair, struct kr_deck_node *into,
                      const char *path) {
    struct fy_node *key = fy_node_pair_key(pair), *value = fy_node_pair_value(pair);
    if (!key || !fy_node_is_scalar(key) || fy_node_is_alias(key)) {
        kr_deck_complain(copier->deck, into->at, *path ? path : NULL,
                         "a key that is no plain word");
        return;
    }
    struct kr_deck_mark at = copier->at ? *copier->at : mark_of(key, into->at);
    char *name = text_of(copier, key, at);
    char *full = kr_text("%s%s%s", path, *path ? "." : "", name);
    const struct kr_deck_node *first = kr_deck_node_find(into, name);
    if (first) {
        kr_deck_complain(copier->deck, at, full, "given twice; the first is in line %d",
                         first->name_at.line);
        kr_free(name);
    } else {
        struct kr_deck_mark value_at = copier->at || !value ? at : mark_of(value, at);
        struct kr_deck_node *child = copy_node(copier, value, value_at, full);
        if (!into->count)
            into->at = at;
        child->name = name;
        child->name_at = at;
        kr_deck_node_add(into, child);
    }
    kr_free(full);
}

static void copy_pairs(struct copier *copier, struct fy_node *from, struct kr_deck_node *into,
                       const char *path) {
    void *iterator = NULL;
    struct fy_node_pair *pair;
    while ((pair = fy_node_mapping_iterate(from, &iterator))) {
        if (into->count == MOST_KEYS) {
            kr_deck_complain(copier->deck, into->at, *path ? path : NULL,
                             "more than %d keys in one section", MOST_KEYS);
            return;
        }
        copy_pair(copier, pair, into, path);
    }
}

/* `from` is NULL where nothing is written behind a key. */
static struct kr_deck_node *copy_node(struct copier *copier, struct fy_node *from,
                                      struct kr_deck_mark at, const char *path) {
    struct kr_deck_node *node = kr_deck_node_create(KR_DECK_SCALAR, at);
    size_t length = 0;
    node->refused = from && fy_node_is_alias(from);
    if (node->refused)
        kr_deck_complain(copier->deck, at, path, "an alias ('*name'); write the value out");
    else if (from && fy_node_get_tag(from, &length))
        kr_deck_complain(copier->deck, at, path, "a YAML tag ('!name'), which decks do not use");
    if (!from || fy_node_is_scalar(from)) {
        node->text = from && !node->refused ? text_of(copier, from, at) : kr_text_copy("");
    } else if (fy_node_is_sequence(from)) {
        node->kind = KR_DECK_SEQUENCE;
        copy_items(copier, from, node, path);
        if (node->count && !copier->at)
            node->at = node->item[0]->at;
    } else {
        node->kind = KR_DECK_MAPPING;
        copy_pairs(copier, from, node, path);
    }
    return node;
}

/* What libfyaml has to say: the first of its messages. */
static char *first_message(struct fy_diag *diag, struct kr_deck_mark *at) {
    void *iterator = NULL;
    const struct fy_diag_error *error = fy_diag_errors_iterate(diag, &iterator);
    *at = (struct kr_deck_mark){error ? error->line : 1, error ? error->column : 1};
    return kr_text_copy(error && error->msg ? error->msg : "it cannot be parsed");
}

/* Sentence about a second document, and its place. */
static char *second_document(struct copier *copier, struct fy_document *second,
                             struct kr_deck_mark *at) {
    struct kr_deck_node *tree = copy_node(copier, fy_document_root(second), *at, "");
    *at = tree->at;
    kr_deck_node_free(tree);
    return kr_text_copy("a second document begins here, after '---'; a deck is one");
}

/* Parse with libfyaml and copy the one document that may stand there. */
static struct kr_deck_node *parse_with(struct fy_parser *parser, struct fy_diag *diag,
                                       struct copier *copier, struct kr_deck_mark *wrong,
                                       char **why) {
    struct kr_deck_node *tree = NULL;
    struct fy_document *document = fy_parse_load_document(parser);
    struct fy_document *second = document ? fy_parse_load_document(parser) : NULL;
    struct kr_deck_mark start = copier->at ? *copier->at : (struct kr_deck_mark){1, 1};
    if (fy_diag_got_error(diag))
        *why = first_message(diag, wrong);
    else if (second)
        *why = second_document(copier, second, wrong);
    else
        tree = copy_node(copier, document ? fy_document_root(document) : NULL, start, "");
    if (second)
        fy_parse_document_destroy(parser, second);
    if (document)
        fy_parse_document_destroy(parser, document);
    return tree;
}

/* Place of the first byte that is neither UTF-8 nor an ordinary character; 0 if there is none.
   libfyaml would read such a text as empty. */
static int bad_byte(const char *text, size_t length, struct kr_deck_mark *at) {
    size_t begin = 0, follow = 0;
    *at = (struct kr_deck_mark){1, 1};
    for (size_t i = 0; i < length; i++) {
        unsigned char c = (unsigned char)text[i];
        int continues = (c & 0xc0) == 0x80;
        at->column = (int)(i - begin) + 1;
        if (continues != (follow > 0) || c == 0x7f || c >= 0xf8 ||
            (c < 0x20 && !strchr("\t\n\r", c)) || !c)
            return 1;
        follow = continues ? follow - 1 : c >= 0xf0 ? 3 : c >= 0xe0 ? 2 : c >= 0xc0 ? 1 : 0;
        if (c == '\n') {
            at->line++;
            begin = i + 1;
        }
    }
    return follow > 0;
}

struct kr_deck_node *kr_deck_parse(struct kr_deck *deck, const char *text, size_t length,
                                   const struct kr_deck_mark *at, char **why) {
    struct kr_deck_node *tree = NULL;
    struct kr_deck_mark wrong = {1, 1};
    char *fault = NULL;
    if (bad_byte(text, length, &wrong)) {
        fault = kr_text_copy("a byte that is no UTF-8 text");
    } else {
        struct fy_diag_cfg quiet;
        fy_diag_cfg_default(&quiet);
        quiet.fp = NULL;
        quiet.level = FYET_ERROR;
        struct fy_diag *diag = fy_diag_create(&quiet);
        fy_diag_set_collect_errors(diag, true);
        struct fy_parse_cfg config = {.flags = FYPCF_ALLOW_DUPLICATE_KEYS |
                                               FYPCF_DEFAULT_VERSION_1_2 | FYPCF_JSON_NONE,
                                      .diag = diag};
        struct fy_parser *parser = fy_parser_create(&config);
        kr_assert(diag && parser);
        fy_parser_set_string(parser, text, length);
        tree = parse_with(parser, diag, &(struct copier){deck, at}, &wrong, &fault);
        fy_parser_destroy(parser);
        fy_diag_destroy(diag);
    }
    if (fault && !at)
        kr_stop(KR_EXIT_INPUT, "%s:%d:%d: not a YAML file: %s", deck->path, wrong.line,
                wrong.column, fault);
    *why = fault;
    return tree;
}
