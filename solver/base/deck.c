/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The deck: opening, faults, closing. The other files of the deck are listed in deck_private.h.
 */
#include "base/deck.h"

#include "base/deck_private.h"
#include "base/error.h"
#include "base/memory.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* Largest deck that is read [bytes]; a thousand times what people write. */
enum { LARGEST = 16 << 20 };

/* ---- faults ---- */

static void add_fault(struct kr_deck *deck, struct kr_deck_mark at, const char *path,
                      const char *format, va_list arguments) {
    char *sentence = NULL;
    int length = vasprintf(&sentence, format, arguments);
    kr_assert(length >= 0);
    KR_GROW(deck->fault, deck->n_faults, deck->faults_room);
    deck->fault[deck->n_faults] = (struct kr_deck_complaint){
        at, deck->n_faults, kr_text("%s%s%s", path ? path : "", path ? ": " : "", sentence)};
    free(sentence);
    /* What was found is the user's text: it must not spread over lines or move the cursor. */
    for (char *c = deck->fault[deck->n_faults].text; *c; c++)
        if ((unsigned char)*c < ' ' || *c == 0x7f)
            *c = ' ';
    deck->n_faults++;
}

void kr_deck_complain(struct kr_deck *deck, struct kr_deck_mark at, const char *path,
                      const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    add_fault(deck, at, path, format, arguments);
    va_end(arguments);
}

/* The last note of an address is the most particular one: an item of a list begins with its first
   key. */
static const struct kr_deck_field *field_at(const struct kr_deck *deck, const void *address) {
    for (size_t i = deck->n_fields; address && i-- > 0;)
        if (deck->field[i].address == address)
            return &deck->field[i];
    return NULL;
}

void kr_deck_fault(struct kr_deck *deck, const void *address, const char *format, ...) {
    const struct kr_deck_field *field = field_at(deck, address);
    va_list arguments;
    va_start(arguments, format);
    add_fault(deck, field ? field->at : (struct kr_deck_mark){1, 1}, field ? field->path : NULL,
              format, arguments);
    va_end(arguments);
}

size_t kr_deck_faults(const struct kr_deck *deck) {
    return deck->n_faults;
}

/* By line and column; the command line stands last. */
static int compare(const void *a, const void *b) {
    const struct kr_deck_complaint *p = a, *q = b;
    if (!p->at.line != !q->at.line)
        return p->at.line ? -1 : 1;
    if (p->at.line != q->at.line)
        return p->at.line < q->at.line ? -1 : 1;
    if (p->at.column != q->at.column)
        return p->at.column < q->at.column ? -1 : 1;
    return p->number < q->number ? -1 : 1;
}

void kr_deck_finish(struct kr_deck *deck) {
    if (!deck->n_faults)
        return;
    fflush(stdout);
    qsort(deck->fault, deck->n_faults, sizeof *deck->fault, compare);
    for (size_t i = 0; i < deck->n_faults; i++) {
        const struct kr_deck_complaint *fault = &deck->fault[i];
        if (fault->at.line)
            fprintf(stderr, "%s:%d:%d: %s\n", deck->path, fault->at.line, fault->at.column,
                    fault->text);
        else
            fprintf(stderr, "command line: %s\n", fault->text);
    }
    kr_stop(KR_EXIT_INPUT, "%zu fault%s in %s; nothing was done", deck->n_faults,
            deck->n_faults == 1 ? "" : "s", deck->path);
}

/* ---- where values came from ---- */

void *kr_deck_own(struct kr_deck *deck, void *array) {
    KR_GROW(deck->kept, deck->n_kept, deck->kept_room);
    return deck->kept[deck->n_kept++] = array;
}

const char *kr_deck_keep(struct kr_deck *deck, char *text) {
    return kr_deck_own(deck, text);
}

void kr_deck_note(const struct kr_deck_spot *spot, const void *address) {
    struct kr_deck *deck = spot->deck;
    KR_GROW(deck->field, deck->n_fields, deck->fields_room);
    deck->field[deck->n_fields++] =
        (struct kr_deck_field){address, kr_text_copy(spot->path), spot->node->at, spot->given,
                               spot->node->count};
}

int kr_deck_given(const struct kr_deck *deck, const void *address) {
    const struct kr_deck_field *field = field_at(deck, address);
    return field && field->given;
}

size_t kr_deck_count(const struct kr_deck *deck, const void *address) {
    const struct kr_deck_field *field = field_at(deck, address);
    return field && field->given ? field->count : 0;
}

const char *kr_deck_where(struct kr_deck *deck, const void *address) {
    const struct kr_deck_field *field = field_at(deck, address);
    if (!field)
        return deck->path;
    if (!field->at.line)
        return kr_deck_keep(deck, kr_text("command line: %s", field->path));
    return kr_deck_keep(
        deck, kr_text("%s:%d:%d: %s", deck->path, field->at.line, field->at.column, field->path));
}

const char *kr_deck_folder(const struct kr_deck *deck) {
    return deck->folder;
}

char *kr_deck_beside(const struct kr_deck *deck, const char *file) {
    return file[0] == '/' ? kr_text_copy(file) : kr_text("%s/%s", deck->folder, file);
}

const char *kr_deck_path(const struct kr_deck *deck) {
    return deck->path;
}

/* ---- opening and closing ---- */

/* The whole file, with its length; owned by the caller. */
static char *slurp(const char *path, size_t *length) {
    FILE *file = fopen(path, "rb");
    if (!file)
        kr_stop(KR_EXIT_INPUT, "%s cannot be read: %s", path, strerror(errno));
    char *text = kr_alloc(LARGEST + 1, 1);
    *length = fread(text, 1, LARGEST + 1, file);
    if (ferror(file))
        kr_stop(KR_EXIT_INPUT, "%s cannot be read: %s", path, strerror(errno));
    if (*length > LARGEST)
        kr_stop(KR_EXIT_INPUT, "%s is larger than %d MiB; is it a deck?", path, LARGEST >> 20);
    fclose(file);
    return text;
}

static char *folder_of(const char *path) {
    const char *slash = strrchr(path, '/');
    if (!slash)
        return kr_text_copy(".");
    return slash == path ? kr_text_copy("/") : kr_text("%.*s", (int)(slash - path), path);
}

struct kr_deck *kr_deck_open(const char *path, const char *variant, size_t n_set,
                             const char *const *set) {
    size_t length = 0;
    char *text = slurp(path, &length), *why = NULL;
    struct kr_deck *deck = KR_NEW(struct kr_deck, 1);
    deck->path = kr_text_copy(path);
    deck->folder = folder_of(path);
    deck->root = kr_deck_parse(deck, text, length, NULL, &why);
    kr_free(text);
    if (deck->root->kind != KR_DECK_MAPPING) {
        char *found = kr_deck_node_show(deck->root);
        kr_stop(KR_EXIT_INPUT, "%s: found %s, expected sections with keys, such as 'geometry:'",
                path, found);
    }
    kr_deck_override(deck, variant, n_set, set);
    return deck;
}

void kr_deck_close(struct kr_deck *deck) {
    if (!deck)
        return;
    for (size_t i = 0; i < deck->n_faults; i++)
        kr_free(deck->fault[i].text);
    for (size_t i = 0; i < deck->n_fields; i++)
        kr_free(deck->field[i].path);
    for (size_t i = 0; i < deck->n_kept; i++)
        kr_free(deck->kept[i]);
    for (size_t i = 0; i < deck->n_spare; i++)
        kr_deck_node_free(deck->spare[i]);
    kr_deck_node_free(deck->root);
    kr_deck_node_free(deck->variants);
    kr_free(deck->fault);
    kr_free(deck->field);
    kr_free(deck->kept);
    kr_free(deck->spare);
    kr_free(deck->path);
    kr_free(deck->folder);
    kr_free(deck);
}
