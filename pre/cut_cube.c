/* SPDX-License-Identifier: BSD-3-Clause
 *
 * One cube of the lattice, less what lies behind some surfaces: six tetrahedra, clipped.
 */
#include "cutting.h"

#include "base/memory.h"
#include "cell.h"
#include "poly.h"

/** Points of the mesh for the vertices of what is left of a tetrahedron with these corners. */
static void place_vertices(struct kr_cutting *cutting, const struct kr_poly *poly,
                           const size_t corner[4][3], size_t *point) {
    for (size_t v = 0; v < poly->n; v++) {
        const double *w = poly->weight[v];
        double place[3];
        for (int d = 0; d < 3; d++)
            place[d] = w[0] * (double)corner[0][d] + w[1] * (double)corner[1][d] +
                       w[2] * (double)corner[2][d] + w[3] * (double)corner[3][d];
        size_t k = 0;
        while (k < 4 && w[k] != 1)
            k++;
        point[v] = k < 4 ? kr_solid_builder_lattice_point(&cutting->builder, corner[k][0],
                                                          corner[k][1], corner[k][2])
                         : kr_solid_builder_point(&cutting->builder, place);
    }
}

static void add_triangle(struct kr_cutting *cutting, struct kr_cut_cube *cube, const size_t p[3], int label) {
    const double *x = cutting->builder.mesh->point;
    KR_GROW(cutting->triangle, cutting->n_triangles, cutting->triangles_room);
    cutting->triangle[cutting->n_triangles++] = (struct kr_cut_triangle){{p[0], p[1], p[2]}, label};
    if (label <= KR_CUT_SIDE)
        cube->side[KR_CUT_SIDE - label] += kr_cell_triangle(x + 3 * p[0], x + 3 * p[1], x + 3 * p[2]);
}

static void add_pieces(struct kr_cutting *cutting, struct kr_cut_cube *cube, const struct kr_poly *poly,
                       const size_t *point) {
    struct kr_poly_pieces pieces;
    const double *x = cutting->builder.mesh->point;
    kr_poly_cut(poly, point, &pieces);
    for (size_t k = 0; k < pieces.n_triangles; k++) {
        const unsigned char *v = pieces.triangle[k];
        if (pieces.label[k] != KR_CUT_INNER)
            add_triangle(cutting, cube, (const size_t[3]){point[v[0]], point[v[1]], point[v[2]]},
                         pieces.label[k]);
    }
    for (size_t k = 0; k < pieces.n_tetrahedra; k++) {
        KR_GROW(cutting->tetrahedron, cutting->n_tetrahedra, cutting->tetrahedra_room);
        size_t *t = cutting->tetrahedron[cutting->n_tetrahedra++];
        for (int c = 0; c < 4; c++)
            t[c] = point[pieces.tetrahedron[k][c]];
        cube->volume += kr_cell_tetrahedron(x + 3 * t[0], x + 3 * t[1], x + 3 * t[2], x + 3 * t[3]);
    }
}

static void cut_tetrahedron(struct kr_cutting *cutting, struct kr_cut_cube *cube, const struct kr_kuhn *kuhn,
                            const double (*value)[8], size_t n_cutters, const size_t *cutter) {
    struct kr_poly poly;
    size_t corner[4][3], point[KR_POLY_VERTICES];
    const int label[4] = {KR_CUT_SIDE - kuhn->side_of_first, KR_CUT_INNER, KR_CUT_INNER,
                          KR_CUT_SIDE - kuhn->side_of_last};
    for (size_t k = 0; k < 4; k++)
        for (int d = 0; d < 3; d++)
            corner[k][d] = cube->at[d] + (kuhn->corner[k] >> d & 1u);
    kr_poly_begin(&poly, kuhn->is_mirrored, label);
    for (size_t c = 0; c < n_cutters && poly.n; c++) {
        double f[4];
        for (int k = 0; k < 4; k++)
            f[k] = value[c][kuhn->corner[k]];
        kr_poly_clip(&poly, f, (int)cutter[c]);
    }
    cube->is_whole &= poly.n == 4 && poly.weight[0][0] == 1 && poly.weight[1][1] == 1 &&
                      poly.weight[2][2] == 1 && poly.weight[3][3] == 1;
    place_vertices(cutting, &poly, (const size_t(*)[3])corner, point);
    add_pieces(cutting, cube, &poly, point);
}

long kr_cut_cube(struct kr_cutting *cutting, const size_t at[3], size_t n_cutters,
                     const size_t *cutter, const double (*value)[8]) {
    struct kr_cut_cube cube = {.at = {at[0], at[1], at[2]}, .tetrahedra = cutting->n_tetrahedra,
                        .triangles = cutting->n_triangles, .root = cutting->n_cubes, .is_whole = 1};
    for (int t = 0; t < 6; t++)
        cut_tetrahedron(cutting, &cube, &kr_kuhn[t], value, n_cutters, cutter);
    if (cutting->n_tetrahedra == cube.tetrahedra)
        return -1;
    cube.joined = cube.volume;
    KR_GROW(cutting->cube, cutting->n_cubes, cutting->cubes_room);
    cutting->cube[cutting->n_cubes] = cube;
    return (long)cutting->n_cubes++;
}
