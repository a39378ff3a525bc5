/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Weights of bonds: which share of a node's volume lies inside the horizon of another, and how the
 * surface factors of both ends make the bond's; theory.md (10), (11).
 */
#ifndef KR_WEIGHT_H
#define KR_WEIGHT_H

#include "case.h"
#include "nodes.h"
#include "search.h"
#include "share.h"

#include <math.h>

/** Share phi of a cell of size r_j = V_j^(1/dim) inside the horizon of a node at distance L:
 *  a ramp from 1 to 0 as L grows from horizon - r_j/2 to horizon + r_j/2; plates paper eq. 13. */
static inline double kr_weight_hhb_one_sided(double distance, double horizon, double size) {
    double phi = (horizon + 0.5 * size - distance) / size;
    return phi < 0 ? 0 : phi > 1 ? 1 : phi;
}

/** The weight phi_ij that node i gives node j where it hangs on their sizes alone (none, hhb,
 *  hhb-one-sided), theory.md (10). 0: there is no bond. Of these only hhb-one-sided differs from
 * the weight seen from j; the others have the same bits from both ends.
 *
 *  in  partial_volume  enum kr_partial_volume
 *  in  distance, horizon, size_i, size_j  [m]
 */
static inline double kr_weight(int partial_volume, double distance, double horizon, double size_i,
                               double size_j) {
    /* Distances on a lattice are often just the horizon: rounding must not decide. */
    const double tie = 1 + 1e-9;
    if (partial_volume == KR_PARTIAL_VOLUME_NONE)
        return distance <= horizon * tie ? 1 : 0;
    double phi = kr_weight_hhb_one_sided(distance, horizon, size_j);
    if (partial_volume != KR_PARTIAL_VOLUME_HHB_ONE_SIDED)
        phi = 0.5 * (kr_weight_hhb_one_sided(distance, horizon, size_i) + phi);
    return phi > 1e-9 ? phi : 0;
}

/** Farthest distance at which two nodes of these sizes can be bonded [m]; not for exact weights. */
static inline double kr_weight_reach(int partial_volume, double horizon, double largest_size) {
    if (partial_volume == KR_PARTIAL_VOLUME_NONE)
        return horizon * (1 + 1e-9);
    return horizon + 0.5 * largest_size;
}

/** All that the weights of a set of nodes need. */
struct kr_weights {
    const struct kr_nodes *nodes; /* not owned */
    int partial_volume;
    double horizon;
    double reach; /* m: no bond is longer */
    double *size; /* (n) m: V^(1/dim) */
    struct kr_shares *shares; /* exact only */
    size_t *first_kept; /* (n + 1) of kr_weights_keep; NULL before */
    int *kept_with;     /* the higher node of each weight kept */
    float *kept;        /* phi, rounded as bonds_make.c stores it; NULL: none are kept */
};

/** The partial volume of a case on these nodes. Exact shares need cells: where the deck
 *  leaves the choice open, nodes without get hhb; where it asks for exact ones, that is a fault. */
int kr_weights_choose(struct kr_deck *deck, const struct kr_case *c, const struct kr_nodes *nodes);

/** Get ready to weigh. Stops (exit 2) where exact weights are asked of nodes without cells. The nodes
 *  must outlive the weights. */
struct kr_weights *kr_weights_create(const struct kr_nodes *nodes, double horizon,
                                     int partial_volume);
void kr_weights_free(struct kr_weights *weights);

/** Find the exact weights that a cell's cut decides once and for all, in parallel, for whoever asks for
 *  each bond several times: from both ends, in several passes. Pairs of lattice nodes are left out.
 *
 *  in  search      made for the reach of the weights
 *  in  on_lattice  (n) 1 for nodes whose weights among each other are known otherwise
 *  Keeps nothing where the weights are not exact, or more than 1e8.
 */
void kr_weights_keep(struct kr_weights *weights, const struct kr_search *search,
                     const unsigned char *on_lattice);

/** phi_ij of two nodes at a distance [m], any partial volume; theory.md (10). */
double kr_weights_phi(const struct kr_weights *weights, size_t i, size_t j, double distance);

/** The share of cell j inside the horizon of node i, from its polygon or solid; theory.md
 *  (10a). */
double kr_weights_share(const struct kr_weights *weights, size_t i, size_t j);

/** phi of two cells of a square (cubic) lattice, xi [m] apart. */
double kr_weight_lattice(int partial_volume, int dim, const double *xi, double horizon,
                         double spacing);

/** Whether node i has the square cell of the lattice about it, so that kr_weight_lattice is right.
 */
int kr_weights_is_square(const struct kr_weights *weights, size_t i, double spacing);

/** lambda_ij over (lambda_i + lambda_j)/2: 1 for factors of the energy method; theory.md (11). The
 *  loop over bonds takes the mean of the two factors, so what differs from it goes into the weight.
 *  Exactly 1 where it is 1 but for rounding. */
double kr_weights_pairing(const struct kr_weights *weights, size_t i, size_t j);

#endif
