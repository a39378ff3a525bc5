/* SPDX-License-Identifier: BSD-3-Clause
 *
 * How far a body is from rest, and motion that is damped until it is there (relaxation); theory.md (25),
 * (28).
 */
#ifndef KR_REST_H
#define KR_REST_H

#include "body.h"
#include "boundary.h"

/** Share of a safe time step that is safe with kr_rest_damp: forces grow by up to 1.8, frequencies by
 *  the root of that. */
#define KR_REST_STEP 0.7

struct kr_rest {
    struct kr_body *body; /* not owned */
    unsigned char *fixed; /* (n) bit d set: component d of the node is prescribed */
    double *load[3];      /* N/m^3: body forces */
    double residual;      /* sum of |V f| over free components, over `pull` or `least_pull` */
    double least_pull;    /* N/m, in 3D N: so that a body without load is at rest, too; 0: none */
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

/** Local damping: each force on a free node becomes weaker by 0.8 of it where it drives the motion and
 *  stronger by as much where it holds against it; theory.md (28). */
void kr_rest_damp(struct kr_rest *rest);

/** One step of a relaxation: find the residual with the loads of time t [s], then damp the forces.
 *  Returns whether the body rests (residual up to `tolerance`) under loads that do not change any more
 *  until `end` [s]. */
int kr_rest_step(struct kr_rest *rest, struct kr_boundary *boundary, double t, double end,
                 double tolerance);

#endif
