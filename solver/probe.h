/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Probes: quantities at a place or over a set, as columns of history.csv.
 */
#ifndef KR_PROBE_H
#define KR_PROBE_H

#include "body.h"
#include "case.h"
#include "nodes.h"

#include <stdio.h>

struct kr_probes; /* Opaque. Implemented in probe.c. */

/** The case's output.probes, their sets checked by kr_boundary_check. A place outside of the body (no node within a
 *  spacing) is a fault of the deck. Owns nothing of what it is made from. */
struct kr_probes *kr_probes_create(struct kr_deck *deck, const struct kr_case *c,
                                   const struct kr_nodes *nodes);
void kr_probes_free(struct kr_probes *probes);

/** Names of the columns, each after a comma: `displacement_x NAME [m]`. */
void kr_probes_header(const struct kr_probes *probes, FILE *file);

/** Values, each after a comma: the mean over the set's volume, or that of the node nearest to the place.
 *  v [m/s]: velocities; energies are those of the last kr_body_energy. */
void kr_probes_write(const struct kr_probes *probes, const struct kr_body *body, double *const v[3],
                     FILE *file);

#endif
