/* SPDX-License-Identifier: BSD-3-Clause
 *
 * How far a body is from rest, and motion that is stopped until it is there (relaxation); theory.md (25),
 * (28).
 */
#ifndef KR_REST_H
#define KR_REST_H

#include "body.h"
#include "boundary.h"

struct kr_rest {
    struct kr_body *body; /* not owned */
    unsigned char *fixed; /* (n) bit d set: component d of the node is prescribed */
    double *load[3];      /* N/m^3: body forces */
    double residual;      /* sum of |V f| over free components, over `pull` */
    double pull; /* N/m, in 3D N: what holds the body: half of the sums of |V f| over prescribed
                    components and of |V b| over all, together */
};

/** No component prescribed, no loads. */
struct kr_rest *kr_rest_create(struct kr_body *body);
void kr_rest_free(struct kr_rest *rest);

/** Take over what is prescribed, and the body forces at time t [s]. */
void kr_rest_loads(struct kr_rest *rest, struct kr_boundary *boundary, double t);

/** Find residual and pull from body->force, loads included; returns the residual, 0 where there is no
 *  force at all. */
double kr_rest_measure(struct kr_rest *rest);

/** Stop all free nodes where the forces hold against the motion: the energy is then at its least along
 *  the way. Forces and velocities as the time loop has them. */
void kr_rest_stop(struct kr_rest *rest);

/** One step of a relaxation: kr_rest_stop with the loads of time t [s]. Returns whether the body rests
 *  (residual up to `tolerance`) under loads that do not change any more until `end` [s]. */
int kr_rest_step(struct kr_rest *rest, struct kr_boundary *boundary, double t, double end,
                 double tolerance);

#endif
