/* SPDX-License-Identifier: BSD-3-Clause
 *
 * When something is due: at even times, at listed times, or both.
 */
#ifndef KR_SCHEDULE_H
#define KR_SCHEDULE_H

#include "base/deck.h"

struct kr_schedule {
    double every; /* s; 0: never */
    const struct kr_deck_list *at; /* double, s; NULL: none. Not owned */
};

struct kr_schedule kr_schedule_every(double every);
struct kr_schedule kr_schedule_of(double every, const struct kr_deck_list *at);

/** Whether a due time lies within half a step of t (so that each falls to just one step). Time 0 is
 *  due for `every`. Knows no past: the same after a restart. */
int kr_schedule_due(const struct kr_schedule *schedule, double t, double dt);

#endif
