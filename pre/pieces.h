/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Cells of more than four corners in files that know triangles and quadrilaterals only: each is cut
 * into triangles, and the triangles of all of them are the group `kirsch_pieces`. Those of one cell have
 * numbers that follow each other; the next cell's begin after a gap of one. So any program shows the
 * mesh as it is, and kirsch-nodes puts the cells together again. In 3D the same holds of polyhedra
 * and their tetrahedra (element.h).
 */
#ifndef KR_PIECES_H
#define KR_PIECES_H

#include "mesh.h"

#define KR_PIECES_GROUP "kirsch_pieces"

/** Cut the cells that files have no kind for in place; nothing happens where there are none. */
void kr_pieces_cut(struct kr_mesh *mesh);

/** Cut a polygon of a plane mesh into triangles.
 *
 *  in out  v         (n) its points, counter-clockwise; used up
 *  out     triangle  (3 (n - 2)) counter-clockwise
 */
void kr_pieces_triangles(const struct kr_mesh *mesh, size_t n, size_t *v, size_t *triangle);

/** Put pieces together in place; nothing happens without the group. Stops (exit 2), naming `path`,
 *  where pieces that belong together bound no simple polygon, or are not a polyhedron's. */
void kr_pieces_join(struct kr_mesh *mesh, const char *path);

#endif
