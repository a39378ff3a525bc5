/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The files that a deck names: of its mesh, geometry, cracks and loads.
 */
#include "case_check.h"

#include "base/memory.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

/* Visitor and its context. */
struct tour {
    struct kr_deck *deck;
    void (*visit)(void *context, const char *const *field, const char *path);
    void *context;
};

/* Fields that kr_case_complete_geometry has not made paths of: a field of the deck, if it names a file. */
static void call_at(const struct tour *tour, const char *const *field) {
    if (!*field || !**field)
        return;
    char *path = kr_deck_beside(tour->deck, *field);
    tour->visit(tour->context, field, path);
    kr_free(path);
}

/* And those that are paths. */
static void call_at_path(const struct tour *tour, const char *const *field) {
    if (*field && **field)
        tour->visit(tour->context, field, *field);
}

static void tour_geometry(const struct tour *tour, const struct kr_case *c) {
    const struct kr_case_outline *part = c->outline.parts.item;
    const struct kr_case_void *hollow = c->voids.item;
    call_at_path(tour, &c->pores.file);
    call_at_path(tour, &c->outline.file);
    for (size_t k = 0; k < c->outline.parts.count; k++)
        call_at_path(tour, &part[k].file);
    for (size_t k = 0; k < c->voids.count; k++)
        call_at(tour, &hollow[k].file);
    call_at(tour, &c->body.file);
}

static void tour_loads(const struct tour *tour, const struct kr_deck_list *list) {
    const struct kr_case_load *load = list->item;
    for (size_t k = 0; k < list->count; k++)
        call_at(tour, &load[k].table_file);
}

static void tour_mechanics(const struct tour *tour, const struct kr_case *c) {
    const struct kr_case_crack *crack = c->cracks.item;
    const struct kr_case_stage *stage = c->stages.item;
    for (size_t k = 0; k < c->cracks.count; k++)
        call_at(tour, &crack[k].file);
    tour_loads(tour, &c->loads);
    for (size_t k = 0; k < c->stages.count; k++)
        tour_loads(tour, &stage[k].loads);
}

void kr_case_visit_files(struct kr_deck *deck, const struct kr_case *c, enum kr_case_part part,
                         void (*visit)(void *context, const char *const *field, const char *path),
                         void *context) {
    const struct tour tour = {deck, visit, context};
    if (part == KR_CASE_MESH)
        call_at(&tour, &c->mesh_file);
    if (part == KR_CASE_GEOMETRY)
        tour_geometry(&tour, c);
    if (part == KR_CASE_MECHANICS)
        tour_mechanics(&tour, c);
}

static void check_file(void *deck, const char *const *field, const char *path) {
    if (access(path, R_OK))
        kr_deck_fault(deck, field, "%s cannot be read: %s", path, strerror(errno));
}

void kr_case_check_files(struct kr_deck *deck, const struct kr_case *c) {
    for (int part = 0; part < KR_CASE_PARTS; part++)
        kr_case_visit_files(deck, c, (enum kr_case_part)part, check_file, deck);
}
