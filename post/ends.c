/* SPDX-License-Identifier: BSD-3-Clause
 *
 * How legs start and end, and what energy they took: the last two steps of legs.h.
 */
#include "legs.h"

#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "base/memory.h"
#include "search.h"

#define NONE KR_FRONT_NONE

/* ---- rims -------------------------------------------------------------------------------- */

/** The damaged nodes look for rims among all nodes. */
struct rims {
    const struct kr_front *front;
    size_t n;
    double *x; /* (n x 3) m: a place of the front, then the nodes of the rims */
    int *rim;  /* (n) */
    int *found;
    struct kr_search *search;
};

/** Rim nodes and the nodes asked for in one search: asked nodes stand first. */
static struct rims rims_of(const struct kr_front *front) {
    const struct kr_record *record = front->record;
    struct rims rims = {front, front->n};
    for (size_t i = 0; record->rim && i < record->n; i++)
        rims.n += record->rim[i] != KR_RIM_NONE;
    rims.x = KR_NEW(double, 3 * rims.n);
    rims.rim = KR_NEW(int, rims.n);
    rims.found = KR_NEW(int, rims.n);
    for (size_t k = 0; k < 3 * front->n; k++)
        rims.x[k] = front->x[k];
    for (size_t i = 0, k = front->n; record->rim && i < record->n; i++)
        if (record->rim[i] != KR_RIM_NONE) {
            rims.rim[k] = record->rim[i];
            for (size_t a = 0; a < 2; a++)
                rims.x[3 * k + a] = record->position[2 * i + a];
            k++;
        }
    rims.search = kr_search_create(3, rims.n, rims.x, record->horizon);
    return rims;
}

static void free_rims(struct rims *rims) {
    kr_search_free(rims->search);
    kr_free(rims->x);
    kr_free(rims->rim);
    kr_free(rims->found);
}

/** The rim nearest to any of some nodes, within a horizon; holes before boundaries. */
static int rim_near(const struct rims *rims, const size_t *node, size_t count) {
    double least = INFINITY;
    int rim = KR_RIM_NONE;
    for (size_t k = 0; k < count; k++) {
        size_t more = kr_search_near(rims->search, node[k], rims->found, rims->n);
        for (size_t f = 0; f < more; f++) {
            size_t j = (size_t)rims->found[f];
            double away = hypot(rims->x[3 * j] - rims->x[3 * node[k]],
                                rims->x[3 * j + 1] - rims->x[3 * node[k] + 1]);
            int is_hole = rims->rim[j] > 0;
            if (rims->rim[j] == KR_RIM_NONE || is_hole < (rim > 0))
                continue;
            if (away < least || is_hole > (rim > 0)) {
                least = away;
                rim = rims->rim[j];
            }
        }
    }
    return rim;
}

/* ---- starts and ends --------------------------------------------------------------------- */

static void tell_start(const struct rims *rims, const struct kr_chain *chain,
                       struct kr_leg *leg) {
    const struct kr_source *source = rims->front->source + chain->source;
    int rim;
    leg->start = leg->parent != NONE     ? KR_START_FORK
                 : source->is_precrack ? KR_START_PRECRACK
                                       : KR_START_INSIDE;
    if (leg->start != KR_START_INSIDE)
        return;
    rim = rim_near(rims, &source->birth, 1);
    leg->start = rim > 0 ? KR_START_HOLE : rim < 0 ? KR_START_BOUNDARY : KR_START_INSIDE;
    leg->start_hole = rim > 0 ? rim : 0;
}

/** Whether j is damage of another crack than the leg: of another leg, or of a pre-crack that the leg
 *  does not come from. */
static int is_other(const struct kr_front *front, const struct kr_legs *legs, size_t c,
                    size_t source, size_t j) {
    if (front->time[j] < 0)
        return front->source_of[j] != source;
    return legs->of[j] != NONE && legs->of[j] != c;
}

/** The leg that the end of leg c ran into; NONE. What lies ahead was there first or came from the
 *  other side: only the outermost nodes are asked, a reach from the end. */
static int runs_into(const struct kr_front *front, const struct kr_legs *legs, size_t c,
                     const struct kr_chain *chain, size_t *other) {
    *other = NONE;
    for (size_t k = 0; k < chain->end_count; k++) {
        size_t i = chain->end[k];
        for (size_t f = front->first[i]; f < front->first[i + 1]; f++) {
            size_t j = (size_t)front->near[f];
            if (!is_other(front, legs, c, chain->source, j))
                continue;
            *other = legs->of[j];
            return 1;
        }
    }
    return 0;
}

/** The tip stands if, at its mean speed, it had had the time for three horizons more. */
static int has_stopped(const struct kr_record *record, const struct kr_leg *leg) {
    double end = (double)record->steps * record->time_step, run = leg->end_s - leg->begin_s;
    double time = leg->last_time - leg->first_time;
    return (end - leg->last_time) * run > KR_FRONT_SHORTEST * record->horizon * time;
}

static void tell_end(const struct rims *rims, const struct kr_chain *chain,
                     struct kr_legs *legs, size_t c) {
    struct kr_leg *leg = legs->item + c;
    int rim;
    if (leg->is_forked) {
        leg->end = KR_END_FORK;
        return;
    }
    if (runs_into(rims->front, legs, c, chain, &leg->other)) {
        leg->end = KR_END_MERGE;
        return;
    }
    rim = rim_near(rims, chain->end, chain->end_count);
    leg->end_hole = rim > 0 ? rim : 0;
    leg->end = rim > 0   ? KR_END_HOLE
               : rim < 0 ? KR_END_BOUNDARY
               : has_stopped(rims->front->record, leg) ? KR_END_ARREST
                                                       : KR_END_RUNNING;
}

void kr_legs_tell_ends(const struct kr_front *front, const struct kr_chains *chains,
                       struct kr_legs *legs) {
    struct rims rims = rims_of(front);
    for (size_t c = 0; c < legs->count; c++) {
        tell_start(&rims, chains->item + c, legs->item + c);
        tell_end(&rims, chains->item + c, legs, c);
    }
    free_rims(&rims);
}
