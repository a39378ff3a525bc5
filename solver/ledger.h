/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The energy ledger: what went in, what is there, what fracture took.
 */
#ifndef KR_LEDGER_H
#define KR_LEDGER_H

#include "body.h"
#include "boundary.h"
#include "crack.h"

/** Energies at one time [J/m in 2D, J in 3D]. */
struct kr_ledger {
    double kinetic, strain, fracture, external;
    double most_external; /* the most that external was so far, in size */
    double power;   /* W/m, in 3D W: of the loads at the last step */
    double balance; /* external - kinetic - strain - fracture as of the last kr_ledger_update: 0 but
                       for the error of the time integration */
    double *v[3]; /* m/s: room for the velocities at the time of the forces */
    size_t n;
    int dim;
};

/** "J/m" in 2D, "J" in 3D. */
const char *kr_ledger_unit(int dim);

struct kr_ledger *kr_ledger_create(const struct kr_body *body);
void kr_ledger_free(struct kr_ledger *ledger);

/** Add the external work up to time t by the trapezoidal rule on the power; once every later step. */
void kr_ledger_step(struct kr_ledger *ledger, struct kr_boundary *boundary,
                    const struct kr_body *body, double t, double dt);

/** Begin a stage at its time 0, forces included: what a sudden motion of the supports
 *  (kr_boundary_start) has put in already is external work. */
void kr_ledger_begin(struct kr_ledger *ledger, struct kr_boundary *boundary, struct kr_body *body,
                     const struct kr_crack *crack, double dt);

/** Bring kinetic, strain and fracture up to time t, and the velocities at t into ledger->v. */
void kr_ledger_update(struct kr_ledger *ledger, struct kr_boundary *boundary, struct kr_body *body,
                      const struct kr_crack *crack, double t, double dt, int first);

/** The ledger of a body at rest: `work` more was done on it; energies as they are. What is missing in the
 *  balance has gone into motion that came to rest. */
void kr_ledger_rest(struct kr_ledger *ledger, struct kr_body *body, const struct kr_crack *crack,
                    double work);

#endif
