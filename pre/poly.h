/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A tetrahedron less all that lies behind some planes: a convex polyhedron. In a tetrahedron a
 * function known at its corners is taken to be linear, so its zero is such a plane.
 *
 * Vertices are kept as weights of the four corners: the value of any function at them is
 * sum_k w_k f_k, summed in the order of the corners. Two tetrahedra that share a face and name its
 * corners in the same order find the same vertices in it to the last bit.
 */
#ifndef KR_POLY_H
#define KR_POLY_H

#include <stddef.h>

/* A tetrahedron gains a face a plane, and no face more than two corners each time: room for 12. */
enum { KR_POLY_VERTICES = 64, KR_POLY_FACES = 16, KR_POLY_CORNERS = 28, KR_POLY_PLANES = 12 };

struct kr_poly_face {
    int label;
    size_t n;
    unsigned char corner[KR_POLY_CORNERS]; /* counter-clockwise seen from outside */
};

struct kr_poly {
    size_t n, n_faces;
    double weight[KR_POLY_VERTICES][4];
    struct kr_poly_face face[KR_POLY_FACES];
};

/** The whole tetrahedron. Labels: of the face opposite to each corner.
 *
 *  in  is_mirrored  whether its corners are in the order of a negative volume
 */
void kr_poly_begin(struct kr_poly *poly, int is_mirrored, const int label[4]);

/** Keep where a function is positive. The face made by it gets the label, and so does a face on which
 *  it is zero. Nothing left: n is 0.
 *
 *  in  value  (4) at the corners
 */
void kr_poly_clip(struct kr_poly *poly, const double value[4], int label);

/** What a polyhedron is cut into: its faces as fans about the vertex of the least number, and
 *  tetrahedra between the least of all and the faces it is not in. So every triangle is a side of a
 *  tetrahedron, and neighbours cut a face alike whether it is flat or not. Numbers of vertices; triangles are counter-clockwise seen from outside. */
struct kr_poly_pieces {
    size_t n_tetrahedra, n_triangles;
    unsigned char tetrahedron[2 * KR_POLY_VERTICES][4], triangle[2 * KR_POLY_VERTICES][3];
    int label[2 * KR_POLY_VERTICES]; /* (triangles) */
};

/** in  number  (vertices) of each among all points */
void kr_poly_cut(const struct kr_poly *poly, const size_t *number, struct kr_poly_pieces *pieces);

/** Corners of the six tetrahedra around the diagonal of a cube (corner c: bits of x, y, z), in
 *  ascending order; the sides of the cube that their faces opposite to the first and last corner lie
 *  in (0, 1: low, high along x; ...); the last three are mirrored. */
extern const struct kr_kuhn {
    unsigned char corner[4], side_of_first, side_of_last;
    int is_mirrored;
} kr_kuhn[6];

#endif
