/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The crack tip and its speed, as in appendix 2 of the plates paper (Peng, Chen and Bobaru, Int. J.
 * Fract., 2023).
 *
 * The tip of a box at a step is the node of the box, farthest in the box's direction, whose damage
 * has passed the threshold. One thing is added: where two branches run side by side the lead
 * changes between them, and a tip that followed it would race to and fro. So the tip stays on its
 * own branch until another is more than one horizon ahead; then it jumps. It also jumps when the
 * crack enters a hole and leaves it on the other side.
 */
#ifndef KR_TRACK_H
#define KR_TRACK_H

#include "case.h"
#include "record.h"

/** The tip reached `node` at `step`. */
struct kr_tip {
    int64_t step;
    size_t node;
    int jumped;   /* it came by a jump, not by growth */
    double speed; /* m/s; NaN where it jumps within the window */
};

struct kr_track {
    size_t count;
    struct kr_tip *tip; /* (count) in the order of steps, one a step at which it moved */
    double mean_speed;  /* m/s; NaN if the crack did not grow in the box */
    double top_speed;   /* m/s; NaN if there is no window without a jump */
    int64_t arrival;    /* the last step at which the tip moved; -1: no tip */
};

/** Follow the tip of one box.
 *
 *    v_i = |a_{i+w} - a_i| / (w dt),  a_i the tip at step i, w the window
 *
 *  Within w steps of its arrival (its last move) the tip would seem to slow down, so there the
 *  window is moved back to end at the arrival.
 *  mean_speed: straight distance between the tip at the first growth (the step at which the run's
 *              first bond broke, or at which the box has its first tip, whichever is later) and at
 *              its arrival, over the time between; jumps included, as if the crack ran through
 * holes top_speed:  the greatest v_i of windows without a jump
 *
 *  in  box     lower, upper [m] (nodes on the rim count), direction;  window >= 1
 *  out track   to be cleared by kr_track_clear; count 0 where nothing in the box is damaged
 */
void kr_track_follow(const struct kr_record *record, const struct kr_case_box *box, int64_t window,
                     struct kr_track *track);
void kr_track_clear(struct kr_track *track);

/** The box around all nodes, direction +x: for a deck that gives none. */
struct kr_case_box kr_track_whole(const struct kr_record *record);

#endif
