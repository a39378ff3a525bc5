/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What the files of multigrid.h share: the ladder, and how its grids are made.
 */
#ifndef KR_MULTIGRID_PRIVATE_H
#define KR_MULTIGRID_PRIVATE_H

#include "grid.h"
#include "multigrid.h"

enum { KR_MOST_LEVELS = 24 };

struct kr_multigrid {
    const struct kr_body *body;
    const unsigned char *fixed;
    double *diagonal, *inverse; /* (n x dim x dim): blocks of the nodes' own stiffness */
    int levels;
    struct kr_grid_level *grid[KR_MOST_LEVELS];
    double *factor; /* dense L of the coarsest grid; unit lower triangle, pivots on its diagonal */
};


/** Put the grid as wide as the longest bond on the ladder, and find `diagonal` and `inverse`. */
void kr_multigrid_first(struct kr_multigrid *c);

/** Put the grid twice as wide as the last one on it. */
void kr_multigrid_next(struct kr_multigrid *c);

#endif
