/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What the parts of the cut grid share: cut_cells.c tells which cubes are cut and joins slivers, cut_cube.c cuts one,
 * cut_mesh.c makes the mesh. No other file includes this.
 *
 * A cube in the making is a range in one list of tetrahedra and one of outer triangles; those on its
 * six sides become boundary only where no cell lies behind the side.
 */
#ifndef KR_CUTTING_H
#define KR_CUTTING_H

#include "block_body.h"
#include "solid_builder.h"

#include <stdint.h>

/* Labels of triangles: a surface is its place among the cutters. */
enum { KR_CUT_INNER = -1, KR_CUT_SIDE = -2 }; /* side s is KR_CUT_SIDE - s */

struct kr_cut_triangle {
    size_t point[3];
    int label;
};

/** A cube that a surface cuts, or that a sliver joins. */
struct kr_cut_cube {
    size_t at[3];
    size_t tetrahedra, triangles; /* where they begin; the next cube's are behind */
    double volume, side[6];       /* spacings cubed and squared */
    size_t root;                  /* cube that it is joined to, itself if to none */
    double joined;                /* volume of all that is joined to a root */
    int is_whole;
};

/* What a lattice cell is, in `state`: whole, behind a surface (KR_CUT_GONE less 1 + its group), or cut. */
enum { KR_CUT_WHOLE = 0, KR_CUT_GONE = -1 };

struct kr_cutting {
    const struct kr_block_body *body;
    struct kr_field *field; /* (cutters) */
    struct kr_solid_builder builder;
    int32_t *state; /* (lattice cells) place among the cubes plus 1 where cut */
    size_t n_cubes, cubes_room, n_tetrahedra, tetrahedra_room, n_triangles, triangles_room;
    struct kr_cut_cube *cube;
    size_t (*tetrahedron)[4];
    struct kr_cut_triangle *triangle;
};

/** Lattice cell behind a side; its number plus 1, 0 beyond the block. */
size_t kr_cut_behind(const struct kr_block_body *body, const size_t at[3], int side);

/** The cube that a cube is joined to in the end. */
static inline size_t kr_cut_root(const struct kr_cutting *cutting, size_t cube) {
    while (cutting->cube[cube].root != cube)
        cube = cutting->cube[cube].root;
    return cube;
}

/** Cut a cube by some surfaces, of which `value` has the functions at its corners, and add what is left; returns its
 *  place, or -1 if nothing is. */
long kr_cut_cube(struct kr_cutting *cutting, const size_t at[3], size_t n_cutters, const size_t *cutter,
                 const double (*value)[8]);

/** Put all cells and their boundary into the builder. */
void kr_cut_take(struct kr_cutting *cutting);

#endif
