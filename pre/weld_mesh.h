/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From welded cells, and the squares of the lattice around them, to a mesh with its boundary in groups.
 */
#ifndef KR_WELD_MESH_H
#define KR_WELD_MESH_H

#include "plate_body.h"
#include "weld.h"

/** The mesh; squares stand first.
 *
 *  in   is_other   (lattice cells) not 0 where a cell of the body is no square
 *  out  n_squares  how many there are
 */
struct kr_mesh *kr_weld_mesh(const struct kr_weld *weld, const struct kr_plate_body *body, const unsigned char *is_other,
                             size_t *n_squares);

#endif
