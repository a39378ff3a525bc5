/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Names of boundaries and sets, held against those that the mesh of this deck can have, before it is
 * made. Whether a boundary has any edge, and how many holes come from a file, only the mesh tells:
 * what may be there passes, and kirsch-nodes looks again.
 */
#include "base/memory.h"
#include "case_check.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* So many of the holes or voids are listed one by one; nobody reads more. */
enum { LISTED = 20 };

/* Names, each owned. `holes` and `voids`: how many there can be, SIZE_MAX where no one knows yet. */
struct names {
    size_t n, room, holes, voids;
    char **name;
};

static void add(struct names *names, char *name) {
    KR_GROW(names->name, names->n, names->room);
    names->name[names->n++] = name;
}

static void add_numbered(struct names *names, const char *stem, size_t count) {
    if (count == SIZE_MAX) {
        add(names, kr_text("%s1 and on", stem));
        return;
    }
    for (size_t k = 1; k <= count && k <= LISTED; k++)
        add(names, kr_text("%s%zu", stem, k));
}

/* ---- what the mesh can have (plate.h, block.h) ---- */

static void add_outline(struct names *names, const struct kr_case_outline *part) {
    if (!kr_case_is_rectangle(part))
        add(names, kr_text_copy(part->name && *part->name ? part->name : "outline"));
    if (part->shape == KR_OUTLINE_CAD)
        names->holes = SIZE_MAX; /* its faces may have holes */
}

static size_t plus(size_t a, size_t b) {
    return a > SIZE_MAX - b ? SIZE_MAX : a + b;
}

static void add_holes(struct names *names, const struct kr_case *c) {
    size_t pores = c->pores.count > 0       ? (size_t)c->pores.count
                   : kr_case_has_pores(c) ? SIZE_MAX
                                          : 0;
    int spheres = c->pores.shape == KR_PORE_SPHERE;
    names->holes = plus(names->holes, plus(c->holes.count, spheres ? 0 : pores));
    names->voids = plus(c->voids.count, spheres ? pores : 0);
    add_numbered(names, "hole_", names->holes);
    add_numbered(names, "void_", names->voids);
}

static void add_boundaries(struct names *names, const struct kr_case *c) {
    static const char *const side[] = {"left", "right", "bottom", "top", "front", "back"};
    const struct kr_case_outline *part = c->outline.parts.item;
    for (int k = 0; k < 2 * kr_case_dim(c); k++)
        add(names, kr_text_copy(side[k]));
    for (size_t k = 0; k < c->outline.parts.count; k++)
        add_outline(names, &part[k]);
    if (!c->outline.parts.count)
        add_outline(names, &c->outline);
    if (c->body.file && *c->body.file)
        add(names, kr_text_copy("outline"));
    add_holes(names, c);
}

/* ---- the checks ---- */

/* Whether the name is the stem and a number from 1 to `most`. */
static int is_numbered(const char *name, const char *stem, size_t most) {
    size_t length = strlen(stem);
    const char *number = name + length;
    if (strncmp(name, stem, length) || *number < '1' || *number > '9' ||
        number[strspn(number, "0123456789")])
        return 0;
    return strtoull(number, NULL, 10) <= most;
}

static int knows(const struct names *names, const char *name) {
    for (size_t k = 0; k < names->n; k++)
        if (!strcmp(names->name[k], name))
            return 1;
    return is_numbered(name, "hole_", names->holes) || is_numbered(name, "void_", names->voids);
}

static void check(struct kr_deck *deck, const char *const *field, const char *kind,
                  const struct names *names) {
    if (*field && !knows(names, *field))
        kr_deck_fault_name(deck, field, kind, names->n, (const char *const *)names->name);
}

static void check_list(struct kr_deck *deck, const struct kr_deck_list *list,
                       const struct names *names) {
    const char *const *name = list->item;
    for (size_t k = 0; k < list->count; k++)
        check(deck, &name[k], "set", names);
}

static void check_loads(struct kr_deck *deck, const struct kr_deck_list *list,
                        const struct names *names) {
    const struct kr_case_load *load = list->item;
    for (size_t k = 0; k < list->count; k++)
        check(deck, &load[k].set, "set", names);
}

/* The deck's sets come in turn: each may be made of those above it. */
static void check_sets(struct kr_deck *deck, const struct kr_case *c,
                       const struct names *boundaries, struct names *sets) {
    const struct kr_case_set *set = c->sets.item;
    for (size_t k = 0; k < c->sets.count; k++) {
        check(deck, &set[k].of, "boundary", boundaries);
        check_list(deck, &set[k].join, sets);
        check_list(deck, &set[k].meet, sets);
        check_list(deck, &set[k].less, sets);
        check_list(deck, &set[k].without, sets);
        if (!knows(sets, set[k].name))
            add(sets, kr_text_copy(set[k].name));
    }
}

static void free_names(struct names *names) {
    for (size_t k = 0; k < names->n; k++)
        kr_free(names->name[k]);
    kr_free(names->name);
}

void kr_case_check_names(struct kr_deck *deck, const struct kr_case *c) {
    const struct kr_case_stage *stage = c->stages.item;
    const struct kr_case_probe *probe = c->probes.item;
    struct names boundaries = {0}, sets = {0};
    add_boundaries(&boundaries, c);
    add_boundaries(&sets, c);
    add(&sets, kr_text_copy(kr_case_dim(c) == 3 ? "body" : "plate"));
    check_sets(deck, c, &boundaries, &sets);
    check_loads(deck, &c->loads, &sets);
    for (size_t k = 0; k < c->stages.count; k++)
        check_loads(deck, &stage[k].loads, &sets);
    for (size_t k = 0; k < c->probes.count; k++)
        if (kr_deck_given(deck, &probe[k].set))
            check(deck, &probe[k].set, "set", &sets);
    check_list(deck, &c->no_fail, &sets);
    free_names(&boundaries);
    free_names(&sets);
}
