/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Legs: what a tip runs in one go, from a source or a fork to the next fork or its end. A branch of
 * the tree (tree.h) is a leg and those that carry it on across holes.
 *
 * Where two arms leave a fork at an angle the damage lies in one heap for about two horizons before
 * it is seen to be two. So the fork is placed where straight lines through the first three horizons
 * of the arms meet (least squares), if that lies before them and beside the leg they come from; the
 * damage beyond it goes to the nearer arm. The centre line (path.h) goes by the nodes next to the ways
 * that lead on; twigs at the sides do not bend it.
 */
#ifndef KR_LEGS_H
#define KR_LEGS_H

#include "chains.h"
#include "path.h"
#include "rims.h"

enum kr_start { KR_START_PRECRACK, KR_START_HOLE, KR_START_BOUNDARY, KR_START_INSIDE,
                KR_START_FORK };
enum kr_end { KR_END_FORK, KR_END_MERGE, KR_END_HOLE, KR_END_BOUNDARY, KR_END_ARREST,
              KR_END_RUNNING };

struct kr_leg {
    size_t parent;     /* leg it forks from; NONE */
    int is_forked;     /* it ends in a fork */
    int start, end;    /* enum kr_start, enum kr_end */
    int start_hole, end_hole; /* number of the hole; 0: none */
    size_t other;      /* leg it ran into; NONE */
    struct kr_path path;
    double first_time, last_time; /* s */
    double from[2], to[2];        /* m */
    double begin_s, end_s;        /* m: along the path */
    double energy;                /* J/m: of the bonds that broke beside it */
};

struct kr_legs {
    size_t count;
    struct kr_leg *item; /* parents stand before children */
    size_t *of;          /* (front's n) leg of a node; NONE */
    double scattered;    /* J/m: of bonds that broke beside none */
};

/** Find the legs of a run in 2D. */
void kr_legs_find(const struct kr_front *front, struct kr_legs *legs);
void kr_legs_clear(struct kr_legs *legs);

/** Steps of kr_legs_find. Place the forks: anchor (chains x 2), not a number where a path begins by
 *  itself; moves nodes between legs. */
void kr_legs_place_forks(const struct kr_front *front, const struct kr_chains *chains,
                         size_t *of, double *anchor);
/** Tell of which damage one tip alone is the cause: alone (front's n) is 0 within a horizon of a rim,
 *  which cuts the nodes' families, and of the damage of a leg that it does not fork from or with. There
 *  whole ligaments pass the threshold at once, and what looks like a fast tip is none. */
void kr_legs_tell_alone(const struct kr_front *front, const struct kr_rims *rims,
                        const struct kr_chains *chains, const size_t *of, char *alone);
/** Tell how each leg starts and ends. */
void kr_legs_tell_ends(const struct kr_front *front, const struct kr_rims *rims,
                       const struct kr_chains *chains, struct kr_legs *legs);
/** Share the energy of the broken bonds out to legs and moves. */
void kr_legs_share_energy(const struct kr_front *front, struct kr_legs *legs);

#endif
