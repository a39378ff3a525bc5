/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The record of fracture: which bonds broke when, and when each node's damage passed the threshold.
 * Dense enough to follow a crack tip step by step without a single snapshot.
 */
#ifndef KR_CRACK_H
#define KR_CRACK_H

#include "body.h"

struct kr_crack {
    size_t n;
    double threshold;
    double *damage_time; /* (n) s; infinite: not yet; -1: by the pre-crack alone */
    double energy;       /* J/m, in 3D J: sum over all broken bonds of what each held when it broke */
    size_t count, room;  /* broken pairs */
    int32_t *pair;       /* (count x 2) */
    double *time;        /* (count) s */
    double *held;        /* (count) likewise */
};

/** Begin a record; nodes whose damage passes the threshold already get -1. */
struct kr_crack *kr_crack_create(const struct kr_bonds *bonds, double threshold);
void kr_crack_free(struct kr_crack *crack);

/** Add what broke in the last kr_body_force, at time t [s]. */
void kr_crack_record(struct kr_crack *crack, const struct kr_body *body, double t);

#endif
