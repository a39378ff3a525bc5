/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Random pores by the rules of the plates paper, section 6.
 */
#ifndef KR_PORES_H
#define KR_PORES_H

#include "case.h"

/** Throw pores into the plate of a case: radius even between the least and the most, centre even
 * over the places at least `edge_diameters` of the pore's own diameters from each edge, thrown
 * again if its rim comes nearer than `gap` to that of another pore or of a hole of the deck. A pore
 * keeps the gap (a nanometre at least) from the edges, too, where edge_diameters alone would let it
 * touch them.
 *
 *  Places and radii are whole nanometres, and only integers decide: the same seed gives the same
 *  pores on every machine. Each number is the one nearest to its nine decimals, so text with
 *  nine decimals gives it back to the last bit.
 *
 *  in   c       width, height, holes and pores
 *  out  hole    room for pores.count holes
 *  out  throws  how many throws it took
 *  returns how many were placed before pores.attempts throws were used up.
 */
size_t kr_pores_throw(const struct kr_case *c, struct kr_case_hole *hole, int64_t *throws);

#endif
