/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The faces of solid cells, found by their vertices. A face inside the body belongs to two cells and
 * is seen from them in opposite senses; one on its boundary belongs to one. All else is a fault.
 */
#ifndef KR_FACE_H
#define KR_FACE_H

#include "element.h"
#include "mesh.h"

struct kr_face {
    size_t cell;
    size_t face; /* which of the cell's */
};

struct kr_faces {
    const struct kr_mesh *mesh; /* not owned */
    size_t count;
    size_t *first;        /* (n_points + 1) where the faces with this lowest vertex begin */
    struct kr_face *face; /* (count) by their lowest vertex, then in the order of cells */
};

/** What is known of a face: how many cells have it, how many of them in the sense asked for, and
 *  the last of the cells. */
struct kr_face_match {
    size_t count, same, cell;
};

/** All faces of a mesh of solids whose vertices are in range. Faces that have collapsed to a line
 *  are not among them. */
struct kr_faces *kr_faces_create(const struct kr_mesh *mesh);

/** Cells that have a face with these vertices, in this order round it or the opposite one. */
struct kr_face_match kr_faces_match(const struct kr_faces *faces, size_t n, const size_t *vertex);

/** The vertices of a cell's face; see kr_solid_face. */
size_t kr_faces_vertices(const struct kr_faces *faces, struct kr_face face, size_t *vertex);

void kr_faces_free(struct kr_faces *faces);

#endif
