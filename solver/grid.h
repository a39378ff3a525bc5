/* SPDX-License-Identifier: BSD-3-Clause
 *
 * One grid of the ladder of multigrid.h: elements and vertices over a set of points, the
 * interpolation between the two, and the stiffness on the vertices.
 */
#ifndef KR_GRID_LADDER_H
#define KR_GRID_LADDER_H

#include <stddef.h>
#include <stdint.h>

enum { KR_CORNERS = 8 };

struct kr_grid_level {
    int dim, corners; /* 4 in 2D, 8 in 3D */
    double width;     /* m, of a cell */
    double origin[3];
    int64_t cells[3];

    /* per point of the finer grid (or node) */
    size_t n;
    int32_t *element; /* (n) -1: takes no part */
    double *share;    /* (n x corners) of the corners of its element in its displacement */

    size_t n_elements;
    int32_t *vertex; /* (n_elements x corners) */
    int64_t *cell;   /* (n_elements) place in the lattice */

    size_t n_vertices;
    double *x[3]; /* m, of the vertices */

    /* stiffness on the vertices: rows of blocks of dim x dim, columns ascending */
    size_t *first;
    int32_t *column;
    double *block;
    double *inverse; /* (n_vertices) of the diagonal blocks */

    double *r, *z, *rest; /* (n_vertices x dim) room of the V-cycle */
};

/** Lay cells of this width over n points. No elements yet: kr_grid_join tells which points hang
 *  together, kr_grid_elements closes that, kr_grid_tie and kr_grid_finish do the same for corners.
 *
 *  in  idle  (n) points without stiffness; owned by the caller until kr_grid_finish. Each as an element of
 *            its own would leave four (eight) idle vertices to the next grid, and these as many again.
 */
struct kr_grid_maker;
struct kr_grid_maker *kr_grid_begin(int dim, size_t n, double *const x[3], const unsigned char *idle,
                                    double width);
void kr_grid_join(struct kr_grid_maker *maker, size_t i, size_t j);
void kr_grid_elements(struct kr_grid_maker *maker);
void kr_grid_tie(struct kr_grid_maker *maker, size_t i, size_t j);
struct kr_grid_level *kr_grid_finish(struct kr_grid_maker *maker, double *const x[3]);
void kr_grid_free(struct kr_grid_level *grid);

/** A row of the finer stiffness while it is brought onto the vertices. */
struct kr_grid_row;
struct kr_grid_row *kr_grid_row_create(const struct kr_grid_level *grid);
void kr_grid_row_free(struct kr_grid_row *row);
/** Add the block (dim x dim) that point j has in it. */
void kr_grid_row_add(struct kr_grid_row *row, const struct kr_grid_level *grid, size_t j,
                     const double *block);
/** It was the row of point i: P^T A P of it is added to `into`, which stands for grid->block from its block
 *  number `from` on; the row is empty again. */
void kr_grid_row_end(struct kr_grid_row *row, const struct kr_grid_level *grid, size_t i, double *into,
                     size_t from);

/** Invert a symmetric block; directions without stiffness get 0. */
void kr_grid_invert(int dim, const double *block, double *inverse);

#endif
