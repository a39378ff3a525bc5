/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The ladder of grids and its V-cycle. See multigrid.h; theory.md (21) to (23).
 *
 *   B r = D^-1 r + P M P^T r      D   blocks of the diagonal of the stiffness
 *                                 P   interpolation from the finest grid
 *                                 M   V-cycle on it: block Gauss-Seidel forwards, then the coarser
 *                                     grid, then backwards; dense factors on the coarsest
 *
 * A grid as wide as the horizon is fine enough: shorter waves are all about as stiff, for a bond has the
 * length of the horizon, and D alone does for them.
 */
#include "multigrid_private.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

enum { FEW_VERTICES = 120 };

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
    kr_multigrid_first(c);
    while (c->grid[c->levels - 1]->n_vertices > FEW_VERTICES && c->levels < KR_MOST_LEVELS) {
        size_t before = c->grid[c->levels - 1]->n_vertices;
        kr_multigrid_next(c);
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
        for (size_t a = 0; a < corners && g->element[i] >= 0; a++) {
            size_t v = (size_t)g->vertex[(size_t)g->element[i] * corners + a];
            for (size_t d = 0; d < dim; d++)
                to[v * dim + d] += g->share[i * corners + a] * from[i * dim + d];
        }
}

static void spread(const struct kr_grid_level *g, const double *from, double *to) {
    const size_t dim = (size_t)g->dim, corners = (size_t)g->corners;
    for (size_t i = 0; i < g->n; i++)
        for (size_t a = 0; a < corners && g->element[i] >= 0; a++) {
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
        for (size_t a = 0; a < corners && g->element[i] >= 0; a++) {
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
        int takes_part = g->element[i] >= 0;
        const int32_t *vertex = g->vertex + (takes_part ? (size_t)g->element[i] * corners : 0);
        for (size_t d = 0; d < dim; d++) {
            double sum = 0;
            for (size_t a = 0; a < corners && takes_part; a++)
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
