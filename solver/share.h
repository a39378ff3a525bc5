/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The part of a cell that lies inside the horizon of a node: its share of the cell, and its moment; theory.md (10a),
 * (10b). Knows the shapes of cells and nothing of bonds.
 */
#ifndef KR_SHARE_H
#define KR_SHARE_H

#include "nodes.h"

/** A part of a cell over the cell's volume: the share, and its moment [m] about the node that looks. */
struct kr_share {
    double part, moment[3];
};

struct kr_shares {
    const struct kr_nodes *nodes; /* not owned */
    double horizon;
    double *radius;     /* (n) m: of the circle (sphere) about the node that holds its cell */
    size_t *first_side; /* (n + 1) of each polyhedron's outside, in `side`; NULL: there is none */
    unsigned short *side; /* (sides x 3) triangles, as places among the corners of the cell */
};

/** Measure the cells of nodes, which must outlive that. Stops (exit 2) where they have none, or one of a shape that
 *  is not known. */
struct kr_shares *kr_shares_create(const struct kr_nodes *nodes, double horizon);
void kr_shares_free(struct kr_shares *shares);

/** What of cell j lies inside the horizon of node i. */
struct kr_share kr_shares_of(const struct kr_shares *shares, size_t i, size_t j);

/** The same on a square (cubic) lattice, xi [m] being the vector between the nodes. */
struct kr_share kr_share_of_lattice(int dim, const double xi[3], double horizon, double spacing);

/** Whether node i has the square cell of the lattice about it; its volume is known to be that of the square. */
int kr_shares_is_square(const struct kr_shares *shares, size_t i, double spacing);

/** Length of a vector of 2 or 3 components. */
double kr_share_length(int dim, const double *vector);

#endif
