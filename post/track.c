/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Follow the tip of a crack; the rules stand in track.h.
 */
#include "track.h"

#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "base/memory.h"

/** A node of the box passes the threshold. */
struct event {
    int64_t step;
    double ahead; /* m: coordinate in the box's direction */
    size_t node;
};

static double ahead_of(const double *x, int direction) {
    double along = x[direction / 2];
    return direction % 2 ? -along : along;
}

static double distance(const struct kr_record *record, size_t i, size_t j) {
    const double *a = record->position + 2 * i, *b = record->position + 2 * j;
    return hypot(a[0] - b[0], a[1] - b[1]);
}

static int earlier(const void *left, const void *right) {
    const struct event *a = left, *b = right;
    if (a->step != b->step)
        return a->step < b->step ? -1 : 1;
    if (a->ahead != b->ahead)
        return a->ahead < b->ahead ? -1 : 1;
    return a->node < b->node ? -1 : a->node > b->node;
}

/** All events in the box, by step and within a step from back to front. */
static struct event *events_in(const struct kr_record *record, const struct kr_case_box *box,
                               size_t *count) {
    struct event *event = NULL;
    size_t n = 0, room = 0;
    for (size_t i = 0; i < record->n; i++) {
        const double *x = record->position + 2 * i;
        int64_t step = kr_record_step(record, i);
        if (step < 0 || x[0] < box->lower[0] || x[0] > box->upper[0] || x[1] < box->lower[1] ||
            x[1] > box->upper[1])
            continue;
        KR_GROW(event, n, room);
        event[n++] = (struct event){step, ahead_of(x, box->direction), i};
    }
    if (n)
        qsort(event, n, sizeof *event, earlier);
    *count = n;
    return event;
}

/** The last of the events of the step that begins at `from`. */
static size_t last_of_step(const struct event *event, size_t count, size_t from) {
    while (from + 1 < count && event[from + 1].step == event[from].step)
        from++;
    return from;
}

/** Whether a move is no growth: farther than to the next cell (2 spacings, as cells vary) and than
 *  a crack could have run since the move before. */
static int is_hop(const struct kr_record *record, const struct kr_track *track, size_t node,
                  int64_t step) {
    const struct kr_tip *last = track->tip + track->count - 1;
    double run = record->rayleigh_speed * (double)(step - last->step) * record->time_step;
    return distance(record, last->node, node) > fmax(2 * record->spacing, run);
}

/** Go through the events and note each move of the tip. */
static void move_tip(const struct kr_record *record, const struct event *event, size_t count,
                     struct kr_track *track) {
    size_t room = 0, last;
    struct event tip, farthest;
    if (!count)
        return;
    tip = farthest = event[last_of_step(event, count, 0)];
    for (size_t k = 0; k < count; k = last + 1) {
        size_t before = tip.node;
        int jumped = 0;
        last = last_of_step(event, count, k);
        for (size_t j = k; j <= last; j++)
            if (event[j].ahead > tip.ahead &&
                distance(record, event[j].node, tip.node) <= record->horizon)
                tip = event[j];
        if (event[last].ahead > farthest.ahead)
            farthest = event[last];
        if (farthest.ahead > tip.ahead + record->horizon) {
            tip = farthest;
            jumped = 1;
        }
        if (tip.node != before || k == 0) {
            jumped |= track->count && is_hop(record, track, tip.node, event[k].step);
            KR_GROW(track->tip, track->count, room);
            track->tip[track->count++] = (struct kr_tip){event[k].step, tip.node, jumped, NAN};
        }
    }
}

/** Index of the tip's last move at or before a step; the first where there is none. */
static size_t move_at(const struct kr_track *track, int64_t step) {
    size_t lower = 0, upper = track->count;
    while (upper - lower > 1) {
        size_t middle = (lower + upper) / 2;
        if (track->tip[middle].step <= step)
            lower = middle;
        else
            upper = middle;
    }
    return lower;
}

/** Mean speed of the tip from one step to a later one; `jumped` tells whether it jumped between. */
static double speed_between(const struct kr_record *record, const struct kr_track *track,
                            int64_t from, int64_t to, int *jumped) {
    size_t a = move_at(track, from), b = move_at(track, to);
    *jumped = 0;
    for (size_t k = a + 1; k <= b; k++)
        *jumped |= track->tip[k].jumped;
    return distance(record, track->tip[a].node, track->tip[b].node) /
           ((double)(to - from) * record->time_step);
}

static void find_speeds(const struct kr_record *record, int64_t window, struct kr_track *track) {
    const int64_t begin = track->tip[0].step;
    int jumped;
    for (size_t k = 0; k < track->count && track->arrival > begin; k++) {
        int64_t to = track->tip[k].step + window, from;
        double speed;
        to = to < track->arrival ? to : track->arrival;
        from = to - window > begin ? to - window : begin;
        speed = speed_between(record, track, from, to, &jumped);
        if (jumped)
            continue;
        track->tip[k].speed = speed;
        track->top_speed = fmax(track->top_speed, speed); /* fmax leaves a NaN for a number */
    }
}

static void find_mean_speed(const struct kr_record *record, struct kr_track *track) {
    int64_t start = track->tip[0].step;
    int jumped;
    if (isinf(record->first_break))
        return;
    if (llround(record->first_break / record->time_step) > start)
        start = llround(record->first_break / record->time_step);
    if (track->arrival > start)
        track->mean_speed = speed_between(record, track, start, track->arrival, &jumped);
}

void kr_track_follow(const struct kr_record *record, const struct kr_case_box *box, int64_t window,
                     struct kr_track *track) {
    size_t count;
    struct event *event = events_in(record, box, &count);
    kr_assert(window >= 1 && box->direction >= 0 && box->direction < 4);
    *track = (struct kr_track){.mean_speed = NAN, .top_speed = NAN, .arrival = -1};
    move_tip(record, event, count, track);
    kr_free(event);
    if (!track->count)
        return;
    track->arrival = track->tip[track->count - 1].step;
    find_speeds(record, window, track);
    find_mean_speed(record, track);
}

void kr_track_clear(struct kr_track *track) {
    track->tip = kr_free(track->tip);
    track->count = 0;
}

struct kr_case_box kr_track_whole(const struct kr_record *record) {
    struct kr_case_box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}, 0};
    for (size_t i = 0; i < record->n; i++)
        for (size_t a = 0; a < 2; a++) {
            box.lower[a] = fmin(box.lower[a], record->position[2 * i + a]);
            box.upper[a] = fmax(box.upper[a], record->position[2 * i + a]);
        }
    return box;
}
