/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Fields: what can be told of every node at a time, for outputs and probes.
 */
#ifndef KR_QUANTITY_H
#define KR_QUANTITY_H

#include "stress.h"

/** What is known of a field; kr_quantities stand in the order of enum kr_quantity. */
struct kr_quantity_kind {
    const char *name; /* of its dataset */
    const char *unit;
    int components;       /* 1, 3 or 6 (KR_TENSOR); in a plate those along z are 0 */
    const char *xdmf;     /* what ParaView takes it for */
    const char *const *suffix; /* (components) "_x", ... */
};

extern const struct kr_quantity_kind kr_quantities[KR_QUANTITIES];

/** Whether component k of a field is there in a body of so many dimensions. */
int kr_quantity_has(int field, int k, int dim);

/** Values of the nodes of one slice. v [m/s]: velocities; energies are those of the last
 *  kr_body_energy. */
void kr_quantity_slice(int field, const struct kr_body *body, double *const v[3], size_t slice,
                    double value[KR_LANES][KR_TENSOR]);

#endif
