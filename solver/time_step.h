/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The largest stable time step, and classical estimates of it.
 */
#ifndef KR_TIME_STEP_H
#define KR_TIME_STEP_H

#include "body.h"

struct kr_time_step {
    double stable;    /* s: 2/omega_max, from the power iteration */
    double frequency; /* rad/s: omega_max */
    int iterations;
    double classical; /* s: min over nodes of sqrt(2 rho/sum_j c w V/|xi|), always safe */
    double courant;   /* s: spacing over the longitudinal wave speed */
};

/** Find the highest frequency of the body as it is, by power iteration on the force under a tiny
 *  displacement; theory.md (14). omega_max is found from below, within about 1 %.
 *  Uses and zeroes u and force of the body, which must be at rest and undeformed. */
struct kr_time_step kr_time_step_find(struct kr_body *body, double spacing);

#endif
