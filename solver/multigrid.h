/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A ladder of coarse grids under a body, and the preconditioner made from it; theory.md (21) to (23).
 *
 * The nodes lie in cells of a square (cubic) background lattice as wide as the longest bond. The
 * nodes of a cell that living bonds join are an element; its corners carry displacements, which the
 * nodes take over bilinearly. Corners of neighbouring elements are one vertex only where a living
 * bond joins the elements: so the coarse grid tears where the body is torn. The same once more, with cells
 * twice as wide, makes the next grid, until few vertices are left.
 */
#ifndef KR_MULTIGRID_H
#define KR_MULTIGRID_H

#include "body.h"

struct kr_multigrid; /* Opaque. Implemented in multigrid.c. */

/** Build the ladder for the living bonds of a body at its displacements.
 *
 *  in  fixed   (n) bit d set: component d of the node is prescribed; it takes no part
 *  The stiffness of a bond is that along itself, at least 0: the matrices have no negative
 *  eigenvalue. Same bits for any number of threads.
 */
struct kr_multigrid *kr_multigrid_create(const struct kr_body *body, const unsigned char *fixed);
void kr_multigrid_free(struct kr_multigrid *coarse);

/** z = B r for a symmetric B close to the inverse of the stiffness: the blocks of the diagonal and, added
 *  to it, one V-cycle over the ladder. r [N], z [m], both (dim)(n), prescribed components 0. */
void kr_multigrid_solve(struct kr_multigrid *coarse, double *const r[3], double *const z[3]);

/** y += shift (diagonal of the stiffness) x. */
void kr_multigrid_add_diagonal(const struct kr_multigrid *coarse, double shift, double *const x[3],
                            double *const y[3]);

/** Number of grids and of vertices of the finest of them. */
int kr_multigrid_levels(const struct kr_multigrid *coarse, size_t *vertices);

#endif
