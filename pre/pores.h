/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Random pores by the rules of the plates paper, section 6, in any outline.
 */
#ifndef KR_PORES_H
#define KR_PORES_H

#include "case.h"

struct kr_pores {
    size_t wanted; /* by the count, or by what the porosity came to */
    size_t placed;
    int64_t throws;
    struct kr_case_hole *hole; /* (placed) */
    double *z;                 /* (placed) m: of the centres of spheres; 0 otherwise */
    double outline, area;      /* m^2: of the outline, and of the pores placed */
    double wanted_area;        /* m^2: of all pores wanted; 0 by a count */
};

/** Throw pores into the outline of a case: sizes from their distribution, centres even over the
 *  places at least `edge_diameters` of the pore's own diameters from each edge, thrown again if the
 *  rim comes nearer than `gap` to that of another pore or of a hole of the deck. A pore keeps the
 *  gap (a nanometre at least) from the edges, too, where edge_diameters alone would let it touch
 *  them. Spheres (pores.shape) keep the same from front and back, and the gap in space. Ellipses and holes that are no circles count as the circles around them.
 *
 *  By a count, each throw draws its own size. By a porosity all sizes are drawn first and placed
 *  one after the other, the largest first.
 *
 *  Places and radii are whole nanometres, and only integers decide where a pore fits: the same seed
 *  gives the same pores on every machine. Each number is the one nearest to its nine decimals, so
 *  text with nine decimals gives it back to the last bit.
 *
 *  Ends when all are placed or pores.attempts throws were used up.
 */
struct kr_pores kr_pores_throw(const struct kr_case *c);

void kr_pores_free(struct kr_pores *pores);

#endif
