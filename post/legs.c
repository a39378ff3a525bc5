/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From chains of damaged nodes to legs with paths and moves; see legs.h.
 */
#include "legs.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"

#define NONE KR_FRONT_NONE

/** Whether the way to where the crack went leads through a node: on by a branch's length, or to the
 *  end of the leg. */
static int leads_on(const struct kr_front *front, size_t i, double end) {
    const double horizon = front->record->horizon * (1 - KR_FRONT_SLACK);
    return front->leads[i] - front->length[i] >= KR_FRONT_SHORTEST * horizon ||
           front->leads[i] >= end - horizon * (1 + 2 * KR_FRONT_SLACK);
}

/** Whether a node or a neighbour in its leg leads on: not so in twigs at its sides. */
static int is_core(const struct kr_front *front, const size_t *of, size_t i, double end) {
    int core = leads_on(front, i, end);
    for (size_t f = front->first[i]; f < front->first[i + 1] && !core; f++) {
        size_t j = (size_t)front->near[f];
        core = of[j] == of[i] && leads_on(front, j, end);
    }
    return core;
}

/** Nodes of a leg in the order of their lengths: those of its chain that still belong to it, all or
 *  those that the centre line goes by. */
static size_t keep_own(const struct kr_front *front, const struct kr_chain *chain,
                       const size_t *of, size_t leg, int core, size_t *node) {
    double end = front->length[chain->node[chain->count - 1]];
    size_t count = 0;
    for (size_t k = 0; k < chain->count; k++)
        if (of[chain->node[k]] == leg && (!core || is_core(front, of, chain->node[k], end)))
            node[count++] = chain->node[k];
    return count;
}

static size_t take_from_parent(const struct kr_chain *parent, const size_t *of, size_t leg,
                               size_t *node) {
    size_t count = 0;
    for (size_t k = 0; k < parent->count; k++)
        if (of[parent->node[k]] == leg)
            node[count++] = parent->node[k];
    return count;
}

static void trace_leg(const struct kr_front *front, const struct kr_chains *chains, size_t c,
                      const double *anchor, const char *alone, struct kr_legs *legs) {
    const struct kr_chain *chain = chains->item + c;
    struct kr_leg *leg = legs->item + c;
    size_t room = chain->count + (chain->parent == NONE ? 0 : chains->item[chain->parent].count);
    size_t *node = KR_NEW(size_t, room);
    size_t count = keep_own(front, chain, legs->of, c, 1, node);
    kr_assert(count > 0);
    kr_path_lay(front, count, node, isnan(anchor[2 * c]) ? NULL : anchor + 2 * c, &leg->path);
    count = keep_own(front, chain, legs->of, c, 0, node);
    if (chain->parent != NONE)
        count += take_from_parent(chains->item + chain->parent, legs->of, c, node + count);
    kr_path_follow(front, count, node, alone, &leg->path);
    kr_free(node);
}

/** Begin and end in place and time; forks come from the anchors of the arms. */
static void measure_leg(const struct kr_chains *chains, size_t c, const double *anchor,
                        struct kr_legs *legs) {
    struct kr_leg *leg = legs->item + c;
    const struct kr_path *path = &leg->path;
    const struct kr_move *last = path->move + path->count - 1;
    int anchored = !isnan(anchor[2 * c]);
    leg->parent = chains->item[c].parent;
    leg->is_forked = chains->item[c].n_children > 0;
    leg->other = NONE;
    leg->begin_s = anchored ? 0 : path->move[0].s;
    leg->end_s = last->s;
    memcpy(leg->from, anchored ? anchor + 2 * c : path->move[0].x, sizeof leg->from);
    memcpy(leg->to, last->x, sizeof leg->to);
    leg->first_time = path->move[0].time;
    leg->last_time = last->time;
}

/** The moves of an arm begin at the fork. */
static void begin_at_fork(struct kr_leg *leg) {
    struct kr_path *path = &leg->path;
    struct kr_move at = path->move[0];
    if (at.s <= 0 && at.time <= leg->first_time)
        return;
    at = (struct kr_move){
        leg->first_time, 0, {leg->from[0], leg->from[1]}, at.angle, NAN, NAN, NAN, 0};
    path->move = kr_realloc(path->move, path->count + 1, sizeof at);
    memmove(path->move + 1, path->move, path->count++ * sizeof at);
    path->move[0] = at;
}

/** The moves of a leg end at its fork: what its tip did later, or farther on, its arms did. */
static void end_at_fork(struct kr_leg *leg) {
    struct kr_path *path = &leg->path;
    struct kr_move at = path->move[path->count - 1];
    double away, near = kr_path_nearest(path, 0, leg->to, &away);
    while (path->count && (path->move[path->count - 1].time > leg->last_time ||
                           path->move[path->count - 1].s > near))
        path->count--;
    leg->end_s = near + away;
    at = (struct kr_move){
        leg->last_time, leg->end_s, {leg->to[0], leg->to[1]}, at.angle, NAN, NAN, NAN, 0};
    path->move = kr_realloc(path->move, path->count + 1, sizeof at);
    path->move[path->count++] = at;
}

/** A leg that forks ends where and when its arms begin: all at one time. */
static void join_arms(struct kr_legs *legs, size_t c) {
    struct kr_leg *leg = legs->item + c;
    for (size_t k = c + 1; k < legs->count; k++)
        if (legs->item[k].parent == c) {
            memcpy(leg->to, legs->item[k].from, sizeof leg->to);
            leg->last_time = fmin(leg->last_time, legs->item[k].first_time);
        }
    for (size_t k = c + 1; k < legs->count; k++)
        if (legs->item[k].parent == c) {
            legs->item[k].first_time = leg->last_time;
            begin_at_fork(legs->item + k);
        }
    end_at_fork(leg);
}

void kr_legs_find(const struct kr_front *front, struct kr_legs *legs) {
    struct kr_chains chains;
    struct kr_rims *rims = kr_rims_create(front);
    double *anchor;
    char *alone = KR_NEW(char, front->n);
    kr_assert(front->record->dim == 2);
    kr_chains_find(front, &chains);
    *legs = (struct kr_legs){.count = chains.count};
    legs->item = KR_NEW(struct kr_leg, chains.count);
    legs->of = KR_NEW(size_t, front->n);
    if (front->n)
        memcpy(legs->of, chains.of, front->n * sizeof *legs->of);
    anchor = KR_NEW(double, 2 * chains.count);
    kr_legs_place_forks(front, &chains, legs->of, anchor);
    kr_legs_tell_alone(front, rims, &chains, legs->of, alone);
    for (size_t c = 0; c < chains.count; c++)
        trace_leg(front, &chains, c, anchor, alone, legs);
    for (size_t c = 0; c < chains.count; c++)
        measure_leg(&chains, c, anchor, legs);
    for (size_t c = 0; c < chains.count; c++)
        if (legs->item[c].is_forked)
            join_arms(legs, c);
    kr_legs_tell_ends(front, rims, &chains, legs);
    kr_legs_share_energy(front, legs);
    kr_free(anchor);
    kr_free(alone);
    kr_rims_free(rims);
    kr_chains_clear(&chains);
}

void kr_legs_clear(struct kr_legs *legs) {
    for (size_t c = 0; c < legs->count; c++)
        kr_path_clear(&legs->item[c].path);
    kr_free(legs->item);
    kr_free(legs->of);
    *legs = (struct kr_legs){0};
}
