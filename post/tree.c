/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From legs to branches and events; the rule about holes stands in tree.h.
 */
#include "tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

#define NONE KR_FRONT_NONE

const char *kr_tree_start(int start) {
    static const char *const word[] = {"pre-crack", "hole", "boundary", "inside", "branch"};
    return word[start];
}

const char *kr_tree_end(int end) {
    static const char *const word[] = {"branch", "merge", "hole", "boundary", "arrest", "running"};
    return word[end];
}

const char *kr_tree_event(int kind) {
    static const char *const word[] = {"birth",      "branch", "merge",          "enter hole",
                                       "leave hole", "arrest", "reach boundary", "speck"};
    return word[kind];
}

size_t kr_tree_tips(const struct kr_tree *tree) {
    size_t count = 0;
    for (size_t b = 0; b < tree->count; b++)
        count += tree->branch[b].end != KR_END_FORK;
    return count;
}

size_t kr_tree_cracks(const struct kr_tree *tree) {
    size_t count = 0;
    for (size_t b = 0; b < tree->count; b++)
        count += tree->branch[b].parent == 0;
    return count;
}

/* ---- branches ---------------------------------------------------------------------------- */

/** The order in which legs are made into branches: by time, then by place. */
struct turn {
    double time;
    int is_arm; /* after the leg it forks from */
    double x[2];
    size_t leg;
};

static int sooner(const void *left, const void *right) {
    const struct turn *a = left, *b = right;
    if (a->time != b->time)
        return a->time < b->time ? -1 : 1;
    if (a->is_arm != b->is_arm)
        return a->is_arm < b->is_arm ? -1 : 1;
    if (a->x[0] != b->x[0])
        return a->x[0] < b->x[0] ? -1 : 1;
    return a->x[1] < b->x[1] ? -1 : a->x[1] > b->x[1];
}

static struct turn *turns_of(const struct kr_legs *legs) {
    struct turn *turn = KR_NEW(struct turn, legs->count);
    for (size_t c = 0; c < legs->count; c++) {
        const struct kr_leg *leg = legs->item + c;
        turn[c] = (struct turn){leg->first_time, leg->parent != NONE, {leg->to[0], leg->to[1]}, c};
    }
    if (legs->count)
        qsort(turn, legs->count, sizeof *turn, sooner);
    return turn;
}

/** Of the branches that entered a hole before a time, the one that did so last; `free` asks for one
 *  that has not gone on. 0: none. */
static size_t entered(const struct kr_tree *tree, int hole, double time, int free) {
    size_t best = 0;
    for (size_t b = 0; b < tree->count; b++) {
        const struct kr_branch *branch = tree->branch + b;
        for (size_t k = 0; k < branch->n_legs; k++) {
            const struct kr_leg *leg = tree->legs.item + branch->leg[k];
            if (leg->end != KR_END_HOLE || leg->end_hole != hole || leg->last_time > time ||
                (free && k + 1 < branch->n_legs))
                continue;
            if (!best || leg->last_time > tree->branch[best - 1].last_time)
                best = b + 1;
        }
    }
    return best;
}

static void note_hole(struct kr_branch *branch, int hole) {
    if (!hole || (branch->n_holes && branch->hole[branch->n_holes - 1] == hole))
        return;
    KR_GROW(branch->hole, branch->n_holes, branch->holes_room);
    branch->hole[branch->n_holes++] = hole;
}

static void add_leg(struct kr_tree *tree, size_t number, size_t c) {
    const struct kr_leg *leg = tree->legs.item + c;
    struct kr_branch *branch = tree->branch + number - 1;
    KR_GROW(branch->leg, branch->n_legs, branch->legs_room);
    branch->leg[branch->n_legs++] = c;
    if (branch->n_legs > 1)
        branch->trapped += leg->first_time - branch->last_time;
    note_hole(branch, leg->start_hole);
    note_hole(branch, leg->end_hole);
    branch->end = leg->end;
    branch->last_time = leg->last_time;
    memcpy(branch->to, leg->to, sizeof branch->to);
    branch->length += leg->end_s - leg->begin_s;
    branch->energy += leg->energy;
    tree->branch_of_leg[c] = number;
}

static void begin_branch(struct kr_tree *tree, size_t c, size_t parent) {
    const struct kr_leg *leg = tree->legs.item + c;
    KR_GROW(tree->branch, tree->count, tree->room);
    tree->branch[tree->count++] = (struct kr_branch){.parent = parent,
                                                     .start = leg->start,
                                                     .first_time = leg->first_time,
                                                     .from = {leg->from[0], leg->from[1]},
                                                     .mean_speed = NAN,
                                                     .top_speed = NAN,
                                                     .top_error = NAN};
    add_leg(tree, tree->count, c);
}

static void place_leg(struct kr_tree *tree, size_t c) {
    const struct kr_leg *leg = tree->legs.item + c;
    size_t on = 0;
    if (leg->start == KR_START_HOLE)
        on = entered(tree, leg->start_hole, leg->first_time, 1);
    if (on)
        add_leg(tree, on, c);
    else if (leg->start == KR_START_HOLE)
        begin_branch(tree, c, entered(tree, leg->start_hole, leg->first_time, 0));
    else
        begin_branch(tree, c, leg->parent == NONE ? 0 : tree->branch_of_leg[leg->parent]);
}

/** The top speed: of the fits that have their whole window on the part of a leg that the tip ran alone, or in the middle
 *  of a part shorter than that, the one whose speed less its standard error is greatest. The greatest speed itself would
 *  be that of the worst fit. */
static void find_top(struct kr_branch *branch, const struct kr_path *path, double window) {
    size_t first = 0, last = path->count;
    double rim;
    while (first < last && !path->move[first].is_alone)
        first++;
    while (last > first && !path->move[last - 1].is_alone)
        last--;
    if (first == last)
        return;
    rim = fmin(window, 0.45 * (path->move[last - 1].s - path->move[first].s));
    for (size_t m = first; m < last; m++) {
        const struct kr_move *move = path->move + m;
        if (isnan(move->speed) || move->s < path->move[first].s + rim ||
            move->s > path->move[last - 1].s - rim ||
            move->speed - move->error <= branch->top_speed - branch->top_error)
            continue; /* top_speed is not a number before the first */
        branch->top_speed = move->speed;
        branch->top_error = move->error;
    }
}

/** Mean over the time of running, and the top speed. */
static void find_speeds(struct kr_tree *tree, struct kr_branch *branch) {
    const double window = kr_path_window(tree->front->record);
    double time = branch->last_time - branch->first_time - branch->trapped;
    if (time > 0 && branch->length > 0)
        branch->mean_speed = branch->length / time;
    for (size_t k = 0; k < branch->n_legs; k++)
        find_top(branch, &tree->legs.item[branch->leg[k]].path, window);
}

/* ---- events ------------------------------------------------------------------------------ */

static void note(struct kr_tree *tree, double time, int kind, size_t branch, const double *x,
                 int hole, size_t other) {
    KR_GROW(tree->event, tree->n_events, tree->events_room);
    tree->event[tree->n_events++] =
        (struct kr_event){time, kind, branch, other, {x[0], x[1]}, hole};
}

static void note_start(struct kr_tree *tree, size_t number, size_t k, const struct kr_leg *leg) {
    const size_t parent = tree->branch[number - 1].parent;
    int kind = leg->start == KR_START_FORK ? KR_EVENT_BRANCH
               : k > 0 || parent         ? KR_EVENT_LEAVE
                                         : KR_EVENT_BIRTH;
    note(tree, leg->first_time, kind, number, leg->from, leg->start_hole, k ? 0 : parent);
}

static void note_end(struct kr_tree *tree, size_t number, const struct kr_leg *leg) {
    static const int kind[] = {[KR_END_MERGE] = KR_EVENT_MERGE,
                               [KR_END_HOLE] = KR_EVENT_ENTER,
                               [KR_END_BOUNDARY] = KR_EVENT_BOUNDARY,
                               [KR_END_ARREST] = KR_EVENT_ARREST};
    size_t other = leg->other == NONE ? 0 : tree->branch_of_leg[leg->other];
    if (leg->end != KR_END_FORK && leg->end != KR_END_RUNNING)
        note(tree, leg->last_time, kind[leg->end], number, leg->to, leg->end_hole, other);
}

static int event_order(const void *left, const void *right) {
    const struct kr_event *a = left, *b = right;
    if (a->time != b->time)
        return a->time < b->time ? -1 : 1;
    if (a->branch != b->branch)
        return a->branch < b->branch ? -1 : 1;
    if (a->x[0] != b->x[0])
        return a->x[0] < b->x[0] ? -1 : 1;
    return a->x[1] < b->x[1] ? -1 : a->x[1] > b->x[1];
}

static void find_events(struct kr_tree *tree) {
    for (size_t b = 0; b < tree->count; b++)
        for (size_t k = 0; k < tree->branch[b].n_legs; k++) {
            const struct kr_leg *leg = tree->legs.item + tree->branch[b].leg[k];
            note_start(tree, b + 1, k, leg);
            note_end(tree, b + 1, leg);
        }
    for (size_t k = 0; k < tree->owners.n_specks; k++) {
        size_t i = tree->owners.item[k].birth;
        note(tree, tree->front->time[i], KR_EVENT_SPECK, 0, tree->front->x + 3 * i, 0, k + 1);
    }
    if (tree->n_events)
        qsort(tree->event, tree->n_events, sizeof *tree->event, event_order);
}

/* ---- all --------------------------------------------------------------------------------- */

struct kr_tree *kr_tree_grow(const struct kr_record *record) {
    struct kr_tree *tree = KR_NEW(struct kr_tree, 1);
    struct turn *turn;
    *tree = (struct kr_tree){0};
    for (size_t i = 0; i < record->n; i++)
        tree->damaged += !isinf(record->damage_time[i]);
    tree->countable = record->dim == 2 && 2 * tree->damaged <= record->n;
    if (!tree->countable)
        return tree;
    tree->front = kr_front_create(record);
    kr_legs_find(tree->front, &tree->legs);
    tree->branch_of_leg = KR_NEW(size_t, tree->legs.count);
    turn = turns_of(&tree->legs);
    for (size_t k = 0; k < tree->legs.count; k++)
        place_leg(tree, turn[k].leg);
    for (size_t b = 0; b < tree->count; b++)
        find_speeds(tree, tree->branch + b);
    kr_owners_find(tree->front, &tree->legs, tree->branch_of_leg, &tree->owners);
    find_events(tree);
    kr_free(turn);
    return tree;
}

void kr_tree_free(struct kr_tree *tree) {
    if (!tree)
        return;
    for (size_t b = 0; b < tree->count; b++) {
        kr_free(tree->branch[b].hole);
        kr_free(tree->branch[b].leg);
    }
    kr_owners_clear(&tree->owners);
    kr_legs_clear(&tree->legs);
    kr_front_free(tree->front);
    kr_free(tree->branch_of_leg);
    kr_free(tree->branch);
    kr_free(tree->event);
    kr_free(tree);
}
