/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Cells of more than four corners in files that know triangles and quadrilaterals only: each is cut
 * into triangles, and the triangles of all of them are the group `kirsch_pieces`. Those of one cell have
 * numbers that follow each other; the next cell's begin after a gap of one. So any program shows the
 * mesh as it is, and kirsch-nodes puts the cells together again.
 */
#ifndef KR_PIECES_H
#define KR_PIECES_H

#include "mesh.h"

#define KR_PIECES_GROUP "kirsch_pieces"

/** Cut the cells of more than four corners in place; nothing happens where there are none. */
void kr_pieces_cut(struct kr_mesh *mesh);

/** Put pieces together in place; nothing happens without the group. Stops (exit 2), naming `path`,
 *  where pieces that belong together bound no simple polygon. */
void kr_pieces_join(struct kr_mesh *mesh, const char *path);

#endif
