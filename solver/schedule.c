/* SPDX-License-Identifier: BSD-3-Clause
 *
 * When something is due. A due time T belongs to the step with t - dt/2 < T <= t + dt/2.
 */
#include "schedule.h"

#include <math.h>

struct kr_schedule kr_schedule_every(double every) {
    return (struct kr_schedule){.every = every};
}

struct kr_schedule kr_schedule_of(double every, const struct kr_deck_list *at) {
    return (struct kr_schedule){.every = every, .at = at};
}

int kr_schedule_due(const struct kr_schedule *schedule, double t, double dt) {
    /* A step's end and the next one's beginning must be the same number, or rounding could lose a
     * time that falls between the two. */
    double step = round(t / dt), from = (step - 0.5) * dt, to = (step + 0.5) * dt;
    if (schedule->every > 0 && floor(to / schedule->every) > floor(from / schedule->every))
        return 1;
    for (size_t k = 0; schedule->at && k < schedule->at->count; k++) {
        double due = ((const double *)schedule->at->item)[k];
        if (from < due && due <= to)
            return 1;
    }
    return 0;
}
