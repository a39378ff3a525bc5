/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Equilibrium of a body: displacements at which no free node is pulled; theory.md (24) to (26).
 */
#ifndef KR_EQUILIBRIUM_H
#define KR_EQUILIBRIUM_H

#include "rest.h"

/** What to find, and room for it. */
struct kr_equilibrium {
    struct kr_body *body;
    struct kr_rest *rest; /* what is prescribed, the loads, and the residual */
    double *move[3];      /* m: how far prescribed components still have to go; of the others a guess, or 0 */
    double tolerance;     /* of rest->residual */
    int (*stop)(void *);  /* asked between two products whether to give up; NULL: never */
    void *stop_with;
    int quiet; /* no lines of progress */
    int most_steps; /* of Newton; 40 */

    /* how it went */
    enum kr_equilibrium_end {
        KR_EQUILIBRIUM_FOUND,
        KR_EQUILIBRIUM_SLOW,    /* no bound reached the tolerance */
        KR_EQUILIBRIUM_SNAP,    /* no step lowers the energy: there is none near by */
        KR_EQUILIBRIUM_STOPPED, /* by `stop` */
    } end;
    int steps, products; /* of Newton; products of the stiffness with a vector, all together */

    double *room[5][3]; /* vectors of the solver */
};

/** Room for the vectors; nothing is prescribed or loaded yet. Does not own the body. */
struct kr_equilibrium *kr_equilibrium_create(struct kr_body *body);
void kr_equilibrium_free(struct kr_equilibrium *equilibrium);

/** Move the prescribed components by `move`, and the others to where the forces balance, starting
 *  from body->u, or from where `move` leads if that is nearer; body->force is that at the end, loads
 *  included, and `move` is 0. No bond breaks. Bonds that died are seen; loose nodes stay where they are.
 *  Same bits for any number of threads. */
enum kr_equilibrium_end kr_equilibrium_find(struct kr_equilibrium *equilibrium);

/** body->force = that at body->u with the loads; returns the residual. */
double kr_equilibrium_residual(struct kr_equilibrium *equilibrium);

#endif
