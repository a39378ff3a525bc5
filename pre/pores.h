/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Random pores by the rules of the plates paper, section 6.
 */
#ifndef KR_PORES_H
#define KR_PORES_H

#include "case.h"

/** Throw pores into a plate of width x height [m]: radius even between the least and the most, centre
 *  even over the places at least `edge_diameters` of the pore's own diameters from each edge, thrown
 *  again if the rims of two pores come nearer than `gap`.
 *
 *  Places and radii are whole nanometres, and only integers decide: the same seed gives the same
 *  pores on every machine.
 *
 *  out  hole    room for pores->count holes
 *  out  throws  how many throws it took
 *  returns how many were placed before pores->attempts throws were used up.
 */
size_t kr_pores_throw(const struct kr_case_pores *pores, double width, double height,
                      struct kr_case_hole *hole, int64_t *throws);

#endif
