/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What acts on a body from outside: body forces, tractions (as body forces over the nodes of a set)
 * and prescribed displacements and velocities; their work and the reactions.
 */
#ifndef KR_BOUNDARY_H
#define KR_BOUNDARY_H

#include "body.h"
#include "case.h"
#include "nodes.h"

struct kr_boundary; /* Opaque: boundary_private.h. */

/** Check that the sets that loads, probes and no_fail name are there and not empty, and that tractions act on
 *  sets that belong to a boundary; what is wrong is a fault of the deck. */
void kr_boundary_check(struct kr_deck *deck, const struct kr_case *c, const struct kr_nodes *nodes);

/** Fault the name at `place`, and say which sets there are; `kind` is "set" or says which. */
void kr_boundary_unknown_set(struct kr_deck *deck, const char *const *place, const char *kind,
                             const struct kr_nodes *nodes);

/** The set named at `place`; NULL and a fault of the deck if there is none or nothing in it. */
const struct kr_set *kr_boundary_find_set(struct kr_deck *deck, const char *const *place,
                                          const struct kr_nodes *nodes);

/** Loads (struct kr_case_load) of a case that has passed kr_boundary_check. A fault of the deck: two loads that
 *  prescribe the same component of a node. */
struct kr_boundary *kr_boundary_create(struct kr_deck *deck, const struct kr_deck_list *loads,
                                       const struct kr_nodes *nodes);
void kr_boundary_free(struct kr_boundary *boundary);

/** Prescribed motion at time 0: where a displacement is prescribed, body->u becomes it, and
 *  body->v what leads on from there; where a velocity is, body->v becomes it. */
void kr_boundary_start(struct kr_boundary *boundary, struct kr_body *body, double dt);

/** Add the body forces at time t [s] to body->force. A traction T on a set gives the body force
 *  T * (length of its boundary)/(volume of the set): the whole force is T times the length. */
void kr_boundary_push(struct kr_boundary *boundary, struct kr_body *body, double t);

/** Prescribed motion of the step from t to t + dt: where it is prescribed, body->v becomes the
 *  velocity at t + dt/2 and body->force zero, so that the step leaves it as it is. A prescribed
 *  displacement gives the velocity that leads there from body->u. */
void kr_boundary_hold(struct kr_boundary *boundary, struct kr_body *body, double t, double dt);

/** Velocities v [m/s] at time t of the prescribed components, others untouched; arguments as for
 *  kr_boundary_power. */
void kr_boundary_velocity(struct kr_boundary *boundary, const struct kr_body *body, double t,
                          double dt, int first, double *const v[3]);

/** Power [W/m in 2D] of all loads at time t, and the reactions, from the forces at t and the velocity
 *  body->v half a step before t (at the start itself where `first`): the support of a prescribed
 *  node pulls with V (rho a - f). */
double kr_boundary_power(struct kr_boundary *boundary, const struct kr_body *body, double t,
                         double dt, int first);

/** Mark the prescribed components: bit d of fixed[i] (n). */
void kr_boundary_fixed(const struct kr_boundary *boundary, unsigned char *fixed);

/** Whether load k prescribes a motion (1) or a force (0); its nodes. */
int kr_boundary_moves(const struct kr_boundary *boundary, size_t k);
const struct kr_set *kr_boundary_nodes(const struct kr_boundary *boundary, size_t k);

/** move[d][i] of each prescribed component: from body->u to where it is at time t. A velocity moves by
 *  its value in the middle of the time from `from` to t. */
void kr_boundary_way(struct kr_boundary *boundary, const struct kr_body *body, double from, double t,
                     double *const move[3]);

/** The reactions of a body at rest, from body->force (loads included), at time t. */
void kr_boundary_rest(struct kr_boundary *boundary, const struct kr_body *body, double t);

/** Loads and what they pulled with at the last kr_boundary_power or kr_boundary_rest. */
size_t kr_boundary_count(const struct kr_boundary *boundary);
const char *kr_boundary_set(const struct kr_boundary *boundary, size_t k);
/** Component d of the force of load k on the body [N/m, in 3D N]. */
double kr_boundary_reaction(const struct kr_boundary *boundary, size_t k, int d);

#endif
