/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The grids of the ladder: from the bonds onto the first, from each onto the next; theory.md (21), (22).
 */
#include "multigrid_private.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

/* ---- bonds ---- */

/* Widest reach of a living bond along an axis [m]. */
static double reach_of(const struct kr_bonds *b) {
    double reach = 0;
#pragma omp parallel for reduction(max : reach)
    for (size_t slice = 0; slice < b->n_slices; slice++) {
        struct kr_bond_walk walk = kr_bonds_walk(b, slice);
        struct kr_bond bond;
        while (kr_bonds_next(b, &walk, &bond))
            reach = fmax(reach, bond.length);
    }
    return reach;
}

/* Stiffness of a pair along itself [N/m in 2D]: V_i V_j w c force'(s)/|xi|, at least 0. */
static double stiffness_of(const struct kr_bonds *b, const struct kr_bond *bond,
                           double *const u[3]) {
    const struct kr_material *m = &b->material;
    const double h = 1e-6; /* error of the quotient of order h^2 */
    const double *const from[3] = {u[0], u[1], u[2]};
    double s = kr_exact_stretch(b, bond, from);
    double slope = (m->law->force(s + h) - m->law->force(s - h)) / (2 * h);
    double weight = 0.5 * (b->factor[bond->i] + b->factor[bond->j]) * bond->weight;
    return fmax(0, b->volume[bond->i] * b->volume[bond->j] * weight *
                       kr_material_micromodulus(m, bond->length) * slope /
                       bond->length);
}

/* k n n^T with n the bond's direction at the displacements. */
static void block_of(const struct kr_body *body, const struct kr_bond *bond, double *block) {
    double n[3], square = 0;
    for (int d = 0; d < body->dim; d++) {
        n[d] = bond->xi[d] + body->u[d][bond->j] - body->u[d][bond->i];
        square += n[d] * n[d];
    }
    double k = stiffness_of(body->bonds, bond, body->u) / square;
    for (int d = 0; d < body->dim; d++)
        for (int e = 0; e < body->dim; e++)
            block[d * body->dim + e] = k * n[d] * n[e];
}

static void mask(int dim, unsigned rows, unsigned columns, const double *from, double sign,
                 double *to) {
    for (int d = 0; d < dim; d++)
        for (int e = 0; e < dim; e++)
            to[d * dim + e] =
                rows >> d & 1 || columns >> e & 1 ? 0 : sign * from[d * dim + e];
}

/* ---- building ---- */

static void join_bonds(struct kr_grid_maker *maker, const struct kr_bonds *b,
                       void (*link)(struct kr_grid_maker *, size_t, size_t)) {
    for (size_t slice = 0; slice < b->n_slices; slice++) {
        struct kr_bond_walk walk = kr_bonds_walk(b, slice);
        struct kr_bond bond;
        while (kr_bonds_next(b, &walk, &bond))
            if (bond.i < bond.j)
                link(maker, bond.i, bond.j);
    }
}

/* Nodes without stiffness: all components prescribed, or no bond left. Owned by the caller. */
static unsigned char *idle_nodes(const struct kr_multigrid *c) {
    const struct kr_bonds *b = c->body->bonds;
    const unsigned char all = (unsigned char)((1u << b->dim) - 1);
    unsigned char *idle = KR_NEW(unsigned char, b->n);
    memset(idle, 1, b->n);
#pragma omp parallel for schedule(static)
    for (size_t slice = 0; slice < b->n_slices; slice++) {
        struct kr_bond_walk walk = kr_bonds_walk(b, slice);
        struct kr_bond bond;
        while (kr_bonds_next(b, &walk, &bond))
            idle[bond.i] = (c->fixed[bond.i] & all) == all;
    }
    return idle;
}

/* The stiffness on the first grid is summed in as many parts as this, which are then joined in turn: the
 * same bits for any number of threads. Nodes stand in rows, so parts hardly overlap. */
enum { PARTS = 16 };
struct part {
    size_t slice[2];    /* first and one past the last */
    size_t from, count; /* blocks of the grid that it reaches */
    double *block;
};

static void find_part(const struct kr_multigrid *c, int k, struct part *part) {
    const struct kr_grid_level *g = c->grid[0];
    const size_t slices = c->body->bonds->n_slices, corners = (size_t)g->corners;
    size_t low = g->n_vertices, high = 0;
    part->slice[0] = slices * (size_t)k / PARTS;
    part->slice[1] = slices * ((size_t)k + 1) / PARTS;
    for (size_t i = part->slice[0] * KR_LANES; i < part->slice[1] * KR_LANES && i < g->n; i++)
        for (size_t a = 0; a < corners && g->element[i] >= 0; a++) {
            size_t v = (size_t)g->vertex[(size_t)g->element[i] * corners + a];
            low = v < low ? v : low;
            high = v > high ? v : high;
        }
    part->from = low <= high ? g->first[low] : 0;
    part->count = low <= high ? g->first[high + 1] - part->from : 0;
    part->block = KR_NEW(double, part->count * (size_t)(g->dim * g->dim));
}

/* Rows of the eight nodes of a slice onto the first grid, and their diagonal blocks. */
static void slice_rows(struct kr_multigrid *c, size_t slice, struct kr_grid_row *row[KR_LANES],
                       const struct part *part) {
    const struct kr_body *body = c->body;
    const size_t square = (size_t)(body->dim * body->dim);
    struct kr_bond_walk walk = kr_bonds_walk(body->bonds, slice);
    struct kr_bond bond;
    double block[9], masked[9];
    while (kr_bonds_next(body->bonds, &walk, &bond)) {
        block_of(body, &bond, block);
        mask(body->dim, c->fixed[bond.i], c->fixed[bond.j], block, -1, masked);
        kr_grid_row_add(row[bond.lane], c->grid[0], bond.j, masked);
        for (size_t k = 0; k < square; k++)
            c->diagonal[bond.i * square + k] += block[k];
    }
    for (size_t lane = 0; lane < KR_LANES; lane++) {
        size_t i = slice * KR_LANES + lane;
        if (i >= body->n)
            break;
        double *own = c->diagonal + i * square;
        memcpy(block, own, sizeof *own * square);
        mask(body->dim, c->fixed[i], c->fixed[i], block, 1, own);
        kr_grid_row_add(row[lane], c->grid[0], i, own);
        kr_grid_row_end(row[lane], c->grid[0], i, part->block, part->from);
        kr_grid_invert(body->dim, own, c->inverse + i * square);
    }
}

static void part_rows(struct kr_multigrid *c, const struct part *part) {
    struct kr_grid_row *row[KR_LANES];
    for (int lane = 0; lane < KR_LANES; lane++)
        row[lane] = kr_grid_row_create(c->grid[0]);
    for (size_t slice = part->slice[0]; slice < part->slice[1]; slice++)
        slice_rows(c, slice, row, part);
    for (int lane = 0; lane < KR_LANES; lane++)
        kr_grid_row_free(row[lane]);
}

void kr_multigrid_first(struct kr_multigrid *c) {
    const struct kr_bonds *b = c->body->bonds;
    double width = reach_of(b) * (1 + 1e-9);
    const size_t square = (size_t)(b->dim * b->dim);
    unsigned char *idle = idle_nodes(c);
    struct kr_grid_maker *maker = kr_grid_begin(b->dim, b->n, b->x, idle, width);
    join_bonds(maker, b, kr_grid_join);
    kr_grid_elements(maker);
    join_bonds(maker, b, kr_grid_tie);
    c->grid[c->levels++] = kr_grid_finish(maker, b->x);
    kr_free(idle);
    struct part part[PARTS];
#pragma omp parallel for schedule(dynamic, 1)
    for (int k = 0; k < PARTS; k++) {
        find_part(c, k, &part[k]);
        part_rows(c, &part[k]);
    }
    for (int k = 0; k < PARTS; k++) {
        double *to = c->grid[0]->block + part[k].from * square;
        for (size_t m = 0; m < part[k].count * square; m++)
            to[m] += part[k].block[m];
        kr_free(part[k].block);
    }
}

static int is_zero(const double *block, size_t square) {
    for (size_t k = 0; k < square; k++)
        if (block[k] != 0)
            return 0;
    return 1;
}

static void join_blocks(struct kr_grid_maker *maker, const struct kr_grid_level *fine,
                        void (*link)(struct kr_grid_maker *, size_t, size_t)) {
    const size_t square = (size_t)(fine->dim * fine->dim);
    for (size_t v = 0; v < fine->n_vertices; v++)
        for (size_t k = fine->first[v]; k < fine->first[v + 1]; k++)
            if (!is_zero(fine->block + k * square, square))
                link(maker, v, (size_t)fine->column[k]);
}

/* Vertices whose diagonal block is 0. Owned by the caller. */
static unsigned char *idle_vertices(const struct kr_grid_level *grid) {
    const size_t square = (size_t)(grid->dim * grid->dim);
    unsigned char *idle = KR_NEW(unsigned char, grid->n_vertices);
    for (size_t v = 0; v < grid->n_vertices; v++)
        for (size_t k = grid->first[v]; k < grid->first[v + 1]; k++)
            if ((size_t)grid->column[k] == v)
                idle[v] = (unsigned char)is_zero(grid->block + k * square, square);
    return idle;
}

void kr_multigrid_next(struct kr_multigrid *c) {
    const struct kr_grid_level *fine = c->grid[c->levels - 1];
    const size_t square = (size_t)(fine->dim * fine->dim);
    unsigned char *idle = idle_vertices(fine);
    struct kr_grid_maker *maker =
        kr_grid_begin(fine->dim, fine->n_vertices, fine->x, idle, 2 * fine->width);
    join_blocks(maker, fine, kr_grid_join);
    kr_grid_elements(maker);
    join_blocks(maker, fine, kr_grid_tie);
    struct kr_grid_level *grid = c->grid[c->levels++] = kr_grid_finish(maker, fine->x);
    kr_free(idle);
    struct kr_grid_row *row = kr_grid_row_create(grid);
    for (size_t v = 0; v < fine->n_vertices; v++) {
        for (size_t k = fine->first[v]; k < fine->first[v + 1]; k++)
            if (!is_zero(fine->block + k * square, square))
                kr_grid_row_add(row, grid, (size_t)fine->column[k], fine->block + k * square);
        kr_grid_row_end(row, grid, v, grid->block, 0);
    }
    kr_grid_row_free(row);
}
