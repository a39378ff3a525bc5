/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Sums over branches; see total.h.
 */
#include "total.h"

#include <math.h>

struct kr_total kr_total_of(const struct kr_tree *tree) {
    struct kr_total total = {.mean_speed = NAN,
                             .top_speed = NAN,
                             .top_error = NAN,
                             .first_branching = INFINITY,
                             .arrival = tree->count ? 0 : NAN};
    double time = 0;
    for (size_t b = 0; b < tree->count; b++) {
        const struct kr_branch *branch = tree->branch + b;
        total.length += branch->length;
        total.energy += branch->energy;
        time += branch->last_time - branch->first_time - branch->trapped;
        if (isnan(total.top_speed) || branch->top_speed - branch->top_error > total.top_speed - total.top_error) {
            total.top_speed = branch->top_speed;
            total.top_error = branch->top_error;
        }
        total.arrival = fmax(total.arrival, branch->last_time);
        if (branch->start == KR_START_FORK)
            total.first_branching = fmin(total.first_branching, branch->first_time);
    }
    if (time > 0)
        total.mean_speed = total.length / time;
    return total;
}
