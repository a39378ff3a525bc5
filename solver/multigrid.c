/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The ladder of grids and its V-cycle. See coarse.h; theory.md (21) to (23).
 *
 *   B r = D^-1 r + P M P^T r      D   blocks of the diagonal of the stiffness
 *                                 P   interpolation from the finest grid
 *                                 M   V-cycle on it: block Gauss-Seidel forwards, then the coarser
 *                                     grid, then backwards; dense factors on the coarsest
 *
 * A grid as wide as the horizon is fine enough: shorter waves are all about as stiff, for a bond has the
 * length of the horizon, and D alone does for them.
 */
#include "multigrid.h"

#include "base/memory.h"
#include "grid.h"

#include <math.h>
#include <string.h>

enum { MOST_LEVELS = 24, FEW_VERTICES = 120 };

struct kr_multigrid {
    const struct kr_body *body;
    const unsigned char *fixed;
    double *diagonal, *inverse; /* (n x dim x dim): blocks of the nodes' own stiffness */
    int levels;
    struct kr_grid_level *grid[MOST_LEVELS];
    double *factor; /* dense L of the coarsest grid; unit lower triangle, pivots on its diagonal */
};

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
        for (size_t a = 0; a < corners; a++) {
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

static void make_first(struct kr_multigrid *c) {
    const struct kr_bonds *b = c->body->bonds;
    double width = reach_of(b) * (1 + 1e-9);
    const size_t square = (size_t)(b->dim * b->dim);
    struct kr_grid_maker *maker = kr_grid_begin(b->dim, b->n, b->x, width);
    join_bonds(maker, b, kr_grid_join);
    kr_grid_elements(maker);
    join_bonds(maker, b, kr_grid_tie);
    c->grid[c->levels++] = kr_grid_finish(maker, b->x);
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

static void make_next(struct kr_multigrid *c) {
    const struct kr_grid_level *fine = c->grid[c->levels - 1];
    const size_t square = (size_t)(fine->dim * fine->dim);
    struct kr_grid_maker *maker =
        kr_grid_begin(fine->dim, fine->n_vertices, fine->x, 2 * fine->width);
    join_blocks(maker, fine, kr_grid_join);
    kr_grid_elements(maker);
    join_blocks(maker, fine, kr_grid_tie);
    struct kr_grid_level *grid = c->grid[c->levels++] = kr_grid_finish(maker, fine->x);
    struct kr_grid_row *row = kr_grid_row_create(grid);
    for (size_t v = 0; v < fine->n_vertices; v++) {
        for (size_t k = fine->first[v]; k < fine->first[v + 1]; k++)
            if (!is_zero(fine->block + k * square, square))
                kr_grid_row_add(row, grid, (size_t)fine->column[k], fine->block + k * square);
        kr_grid_row_end(row, grid, v, grid->block, 0);
    }
    kr_grid_row_free(row);
}

static void invert_diagonals(struct kr_grid_level *grid) {
    const size_t square = (size_t)(grid->dim * grid->dim);
    for (size_t v = 0; v < grid->n_vertices; v++)
        for (size_t k = grid->first[v]; k < grid->first[v + 1]; k++)
            if ((size_t)grid->column[k] == v)
                kr_grid_invert(grid->dim, grid->block + k * square, grid->inverse + v * square);
}

/* L D L^T of the coarsest stiffness. Pivots that are rounding belong to free motions: 0. */
static void factorise(struct kr_multigrid *c) {
    const struct kr_grid_level *grid = c->grid[c->levels - 1];
    const size_t dim = (size_t)grid->dim, n = grid->n_vertices * dim;
    double *a = c->factor = KR_NEW(double, n * n), largest = 0;
    for (size_t v = 0; v < grid->n_vertices; v++)
        for (size_t k = grid->first[v]; k < grid->first[v + 1]; k++)
            for (size_t d = 0; d < dim; d++)
                for (size_t e = 0; e < dim; e++)
                    a[(v * dim + d) * n + (size_t)grid->column[k] * dim + e] =
                        grid->block[(k * dim + d) * dim + e];
    for (size_t i = 0; i < n; i++)
        largest = fmax(largest, a[i * n + i]);
    for (size_t k = 0; k < n; k++) {
        double pivot = a[k * n + k];
        if (!(pivot > 1e-12 * largest))
            pivot = a[k * n + k] = 0;
        for (size_t i = k + 1; i < n; i++) {
            double share = pivot > 0 ? a[i * n + k] / pivot : 0;
            for (size_t j = k + 1; j <= i && share != 0; j++)
                a[i * n + j] -= share * a[j * n + k];
        }
        for (size_t i = k + 1; i < n; i++)
            a[i * n + k] = pivot > 0 ? a[i * n + k] / pivot : 0;
    }
}

struct kr_multigrid *kr_multigrid_create(const struct kr_body *body, const unsigned char *fixed) {
    struct kr_multigrid *c = KR_NEW(struct kr_multigrid, 1);
    const size_t square = (size_t)(body->dim * body->dim);
    *c = (struct kr_multigrid){.body = body, .fixed = fixed};
    c->diagonal = KR_NEW(double, body->n * square);
    c->inverse = KR_NEW(double, body->n * square);
    make_first(c);
    while (c->grid[c->levels - 1]->n_vertices > FEW_VERTICES && c->levels < MOST_LEVELS) {
        size_t before = c->grid[c->levels - 1]->n_vertices;
        make_next(c);
        if (4 * c->grid[c->levels - 1]->n_vertices > 3 * before)
            break; /* many loose pieces: coarser grids have nothing more to join */
    }
    for (int k = 0; k < c->levels; k++)
        invert_diagonals(c->grid[k]);
    if (c->grid[c->levels - 1]->n_vertices <= 10 * FEW_VERTICES)
        factorise(c);
    return c;
}

void kr_multigrid_free(struct kr_multigrid *c) {
    for (int k = 0; k < c->levels; k++)
        kr_grid_free(c->grid[k]);
    kr_free(c->diagonal);
    kr_free(c->inverse);
    kr_free(c->factor);
    kr_free(c);
}

int kr_multigrid_levels(const struct kr_multigrid *c, size_t *vertices) {
    *vertices = c->grid[0]->n_vertices;
    return c->levels;
}

/* ---- the V-cycle ---- */

/* rest = r - A z in row v. */
static void rest_of(const struct kr_grid_level *g, size_t v, double rest[3]) {
    const int dim = g->dim;
    for (int d = 0; d < dim; d++)
        rest[d] = g->r[v * (size_t)dim + (size_t)d];
    for (size_t k = g->first[v]; k < g->first[v + 1]; k++) {
        const double *block = g->block + k * (size_t)(dim * dim);
        const double *z = g->z + (size_t)g->column[k] * (size_t)dim;
        for (int d = 0; d < dim; d++)
            for (int e = 0; e < dim; e++)
                rest[d] -= block[d * dim + e] * z[e];
    }
}

static void relax(struct kr_grid_level *g, int backwards) {
    const size_t dim = (size_t)g->dim;
    double rest[3];
    for (size_t m = 0; m < g->n_vertices; m++) {
        size_t v = backwards ? g->n_vertices - 1 - m : m;
        rest_of(g, v, rest);
        for (size_t d = 0; d < dim; d++)
            for (size_t e = 0; e < dim; e++)
                g->z[v * dim + d] += g->inverse[(v * dim + d) * dim + e] * rest[e];
    }
}

static void solve_coarsest(const struct kr_multigrid *c, struct kr_grid_level *g) {
    const size_t n = g->n_vertices * (size_t)g->dim;
    const double *a = c->factor;
    for (size_t i = 0; i < n; i++) {
        g->z[i] = g->r[i];
        for (size_t j = 0; j < i; j++)
            g->z[i] -= a[i * n + j] * g->z[j];
    }
    for (size_t i = 0; i < n; i++)
        g->z[i] = a[i * n + i] > 0 ? g->z[i] / a[i * n + i] : 0;
    for (size_t i = n; i-- > 0;)
        for (size_t j = 0; j < i; j++)
            g->z[j] -= a[i * n + j] * g->z[i];
}

/* `to` of the vertices gathers from points, or points take over from vertices. */
static void gather(const struct kr_grid_level *g, const double *from, double *to) {
    const size_t dim = (size_t)g->dim, corners = (size_t)g->corners;
    memset(to, 0, g->n_vertices * dim * sizeof *to);
    for (size_t i = 0; i < g->n; i++)
        for (size_t a = 0; a < corners; a++) {
            size_t v = (size_t)g->vertex[(size_t)g->element[i] * corners + a];
            for (size_t d = 0; d < dim; d++)
                to[v * dim + d] += g->share[i * corners + a] * from[i * dim + d];
        }
}

static void spread(const struct kr_grid_level *g, const double *from, double *to) {
    const size_t dim = (size_t)g->dim, corners = (size_t)g->corners;
    for (size_t i = 0; i < g->n; i++)
        for (size_t a = 0; a < corners; a++) {
            size_t v = (size_t)g->vertex[(size_t)g->element[i] * corners + a];
            for (size_t d = 0; d < dim; d++)
                to[i * dim + d] += g->share[i * corners + a] * from[v * dim + d];
        }
}

static void cycle(struct kr_multigrid *c, int level) {
    struct kr_grid_level *g = c->grid[level];
    memset(g->z, 0, g->n_vertices * (size_t)g->dim * sizeof *g->z);
    if (level == c->levels - 1 && c->factor) {
        solve_coarsest(c, g);
        return;
    }
    relax(g, 0);
    if (level < c->levels - 1) {
        struct kr_grid_level *next = c->grid[level + 1];
        for (size_t v = 0; v < g->n_vertices; v++)
            rest_of(g, v, g->rest + v * (size_t)g->dim);
        gather(next, g->rest, next->r);
        cycle(c, level + 1);
        spread(next, next->z, g->z);
    }
    relax(g, 1);
}

/* ---- between the nodes and the first grid ---- */

static void gather_nodes(struct kr_multigrid *c, double *const r[3]) {
    struct kr_grid_level *g = c->grid[0];
    const size_t dim = (size_t)g->dim, corners = (size_t)g->corners;
    memset(g->r, 0, g->n_vertices * dim * sizeof *g->r);
    for (size_t i = 0; i < g->n; i++)
        for (size_t a = 0; a < corners; a++) {
            size_t v = (size_t)g->vertex[(size_t)g->element[i] * corners + a];
            for (size_t d = 0; d < dim; d++)
                g->r[v * dim + d] += g->share[i * corners + a] * r[d][i];
        }
}

void kr_multigrid_solve(struct kr_multigrid *c, double *const r[3], double *const z[3]) {
    struct kr_grid_level *g = c->grid[0];
    const size_t dim = (size_t)g->dim, corners = (size_t)g->corners;
    gather_nodes(c, r);
    cycle(c, 0);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < g->n; i++) {
        const int32_t *vertex = g->vertex + (size_t)g->element[i] * corners;
        for (size_t d = 0; d < dim; d++) {
            double sum = 0;
            for (size_t a = 0; a < corners; a++)
                sum += g->share[i * corners + a] * g->z[(size_t)vertex[a] * dim + d];
            for (size_t e = 0; e < dim; e++)
                sum += c->inverse[(i * dim + d) * dim + e] * r[e][i];
            z[d][i] = c->fixed[i] >> d & 1 ? 0 : sum;
        }
    }
}

void kr_multigrid_add_diagonal(const struct kr_multigrid *c, double shift, double *const x[3],
                            double *const y[3]) {
    const size_t dim = (size_t)c->body->dim;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < c->body->n; i++)
        for (size_t d = 0; d < dim; d++)
            y[d][i] += shift * c->diagonal[(i * dim + d) * dim + d] * x[d][i];
}
