/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The tree of cracks of a run in 2D: branches, how each begins and ends, and what happened when
 * (branches.csv, tips.csv and events.csv of docs/formats.md). How it is found stands in front.h,
 * chains.h, legs.h and path.h, from the damage inward; theory.md has it in words.
 *
 * A leg that begins at the rim of a hole goes on as the branch that entered this hole last before
 * and has not gone on; where all have, it is a branch of its own, child of the last.
 */
#ifndef KR_TREE_H
#define KR_TREE_H

#include "legs.h"
#include "owners.h"

struct kr_branch {
    size_t parent;            /* number of the branch, from 1; 0: none */
    int start, end;           /* enum kr_start, enum kr_end */
    double first_time, last_time; /* s */
    double from[2], to[2];    /* m */
    double length;            /* m, holes left out */
    double mean_speed, top_speed, top_error; /* m/s, one standard error; NaN: too short */
    double trapped;           /* s in holes */
    double energy;            /* J/m */
    size_t n_holes, holes_room;
    int *hole;                /* (n_holes) in the order met */
    size_t n_legs, legs_room;
    size_t *leg;              /* (n_legs) of kr_tree.legs */
};

enum kr_event_kind { KR_EVENT_BIRTH, KR_EVENT_BRANCH, KR_EVENT_MERGE, KR_EVENT_ENTER,
                     KR_EVENT_LEAVE, KR_EVENT_ARREST, KR_EVENT_BOUNDARY, KR_EVENT_SPECK };

struct kr_event {
    double time; /* s */
    int kind;    /* enum kr_event_kind */
    size_t branch, other; /* numbers; 0: none. Of a speck: 0 and the speck's */
    double x[2]; /* m */
    int hole;    /* number; 0: none */
};

struct kr_tree {
    int countable;     /* 0: more than half of the nodes are damaged, or the body is in 3D: there
                          are no lines */
    size_t damaged;
    struct kr_front *front;
    struct kr_legs legs;
    size_t *branch_of_leg; /* (legs.count) numbers */
    struct kr_owners owners;
    size_t count, room;
    struct kr_branch *branch; /* number k is branch[k - 1], in the order of their starts */
    size_t n_events, events_room;
    struct kr_event *event;   /* (n_events) in the order of time */
};

/** Find the tree; in 3D it is empty. The record must outlive it. Owned by the caller. */
struct kr_tree *kr_tree_grow(const struct kr_record *record);
void kr_tree_free(struct kr_tree *tree);

/** Words of branches.csv and events.csv. */
const char *kr_tree_start(int start);
const char *kr_tree_end(int end);
const char *kr_tree_event(int kind);

/** Branches that do not end in a fork; branches without a parent. */
size_t kr_tree_tips(const struct kr_tree *tree);
size_t kr_tree_cracks(const struct kr_tree *tree);

#endif
