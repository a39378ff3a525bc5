/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Finding cells with the same vertices, in whatever order.
 */
#ifndef KR_COPIES_H
#define KR_COPIES_H

#include "mesh.h"

/** Which cells (n_cells) have the vertices of an earlier one. Of a cell the first `size` vertices count, of cells that are
 *  gone none. Owned by the caller. */
unsigned char *kr_mesh_copies(const struct kr_mesh *mesh, const size_t *size, const unsigned char *is_gone);

#endif
