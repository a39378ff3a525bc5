/* SPDX-License-Identifier: BSD-3-Clause
 *
 * How legs start and end: kr_legs_tell_ends of legs.h.
 */
#include "legs.h"

#include "rims.h"

#define NONE KR_FRONT_NONE

/* ---- starts and ends --------------------------------------------------------------------- */

static void tell_start(const struct kr_front *front, const struct kr_rims *rims,
                       const struct kr_chain *chain, struct kr_leg *leg) {
    const struct kr_source *source = front->source + chain->source;
    int rim;
    leg->start = leg->parent != NONE     ? KR_START_FORK
                 : source->is_precrack ? KR_START_PRECRACK
                                       : KR_START_INSIDE;
    if (leg->start != KR_START_INSIDE)
        return;
    rim = kr_rims_nearest(rims, &source->birth, 1);
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

static void tell_end(const struct kr_front *front, const struct kr_rims *rims,
                     const struct kr_chain *chain, struct kr_legs *legs, size_t c) {
    struct kr_leg *leg = legs->item + c;
    int rim;
    if (leg->is_forked) {
        leg->end = KR_END_FORK;
        return;
    }
    if (runs_into(front, legs, c, chain, &leg->other)) {
        leg->end = KR_END_MERGE;
        return;
    }
    rim = kr_rims_nearest(rims, chain->end, chain->end_count);
    leg->end_hole = rim > 0 ? rim : 0;
    leg->end = rim > 0   ? KR_END_HOLE
               : rim < 0 ? KR_END_BOUNDARY
               : has_stopped(front->record, leg) ? KR_END_ARREST
                                                       : KR_END_RUNNING;
}

void kr_legs_tell_ends(const struct kr_front *front, const struct kr_rims *rims,
                       const struct kr_chains *chains, struct kr_legs *legs) {
    for (size_t c = 0; c < legs->count; c++) {
        tell_start(front, rims, chains->item + c, legs->item + c);
        tell_end(front, rims, chains->item + c, legs, c);
    }
}
