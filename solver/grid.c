/* SPDX-License-Identifier: BSD-3-Clause
 *
 * One grid of the ladder. See grid.h; theory.md (21), (22).
 *
 *   A_coarse = P^T A P ,   P_ia = product over d of (1 - |x_i - x_a|_d / width)
 */
#include "grid.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- elements and vertices ---- */

struct kr_grid_maker {
    struct kr_grid_level *grid;
    const unsigned char *idle; /* (n), not owned */
    int64_t (*place)[3];       /* (n) cell of each point */
    int32_t *parent;           /* (n), then (n_elements x corners): union-find */
};

static int32_t root_of(int32_t *parent, int32_t i) {
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

/* The lower root stays, so that the outcome does not depend on the order of the calls. */
static void unite(int32_t *parent, int32_t i, int32_t j) {
    int32_t a = root_of(parent, i), b = root_of(parent, j);
    parent[a > b ? a : b] = a > b ? b : a;
}

static int32_t *singles(size_t n) {
    int32_t *parent = KR_NEW(int32_t, n);
    for (size_t i = 0; i < n; i++)
        parent[i] = (int32_t)i;
    return parent;
}

/* Number the roots in order, 0, 1, ...; returns how many. number[i] becomes that of i's root, -1 where i
 * is idle. */
static size_t number_roots(int32_t *parent, size_t n, const unsigned char *idle, int32_t *number) {
    size_t count = 0;
    for (size_t i = 0; i < n; i++)
        if (idle && idle[i])
            number[i] = -1;
        else
            number[i] = parent[i] == (int32_t)i ? (int32_t)count++ : number[root_of(parent, (int32_t)i)];
    return count;
}

static void bounds(int dim, size_t n, double *const x[3], double low[3], double high[3]) {
    for (int d = 0; d < dim; d++) {
        low[d] = INFINITY;
        high[d] = -INFINITY;
        for (size_t i = 0; i < n; i++) {
            low[d] = fmin(low[d], x[d][i]);
            high[d] = fmax(high[d], x[d][i]);
        }
    }
}

struct kr_grid_maker *kr_grid_begin(int dim, size_t n, double *const x[3], const unsigned char *idle,
                                    double width) {
    struct kr_grid_maker *maker = KR_NEW(struct kr_grid_maker, 1);
    struct kr_grid_level *grid = maker->grid = KR_NEW(struct kr_grid_level, 1);
    double low[3] = {0}, high[3] = {0};
    *grid = (struct kr_grid_level){.dim = dim, .corners = 1 << dim, .width = width, .n = n};
    bounds(dim, n, x, low, high);
    for (int d = 0; d < 3; d++) {
        /* A quarter of a cell before the first point: vertices of the grid before, half a cell
         * apart, then lie well within cells, and rounding cannot move them into another. */
        grid->origin[d] = low[d] - 0.25 * width;
        grid->cells[d] = d < dim ? (int64_t)floor((high[d] - grid->origin[d]) / width) + 1 : 1;
    }
    maker->place = kr_alloc(n, sizeof *maker->place);
    for (size_t i = 0; i < n; i++)
        for (int d = 0; d < dim; d++) {
            int64_t k = (int64_t)floor((x[d][i] - grid->origin[d]) / width);
            maker->place[i][d] = k < 0 ? 0 : k >= grid->cells[d] ? grid->cells[d] - 1 : k;
        }
    maker->parent = singles(n);
    maker->idle = idle;
    return maker;
}

static int same_cell(const struct kr_grid_maker *maker, size_t i, size_t j) {
    return !memcmp(maker->place[i], maker->place[j], sizeof *maker->place);
}

void kr_grid_join(struct kr_grid_maker *maker, size_t i, size_t j) {
    if (same_cell(maker, i, j) && !maker->idle[i] && !maker->idle[j])
        unite(maker->parent, (int32_t)i, (int32_t)j);
}

void kr_grid_elements(struct kr_grid_maker *maker) {
    struct kr_grid_level *grid = maker->grid;
    grid->element = KR_NEW(int32_t, grid->n);
    grid->n_elements = number_roots(maker->parent, grid->n, maker->idle, grid->element);
    grid->cell = KR_NEW(int64_t, grid->n_elements);
    for (size_t i = 0; i < grid->n; i++) {
        const int64_t *at = maker->place[i];
        if (grid->element[i] >= 0)
            grid->cell[grid->element[i]] = (at[2] * grid->cells[1] + at[1]) * grid->cells[0] + at[0];
    }
    kr_free(maker->parent);
    maker->parent = singles(grid->n_elements * (size_t)grid->corners);
}

/* Bit d of a corner is set on the upper side along d. */
void kr_grid_tie(struct kr_grid_maker *maker, size_t i, size_t j) {
    const struct kr_grid_level *grid = maker->grid;
    int64_t step[3];
    if (grid->element[i] == grid->element[j] || maker->idle[i] || maker->idle[j])
        return;
    for (int d = 0; d < grid->dim; d++) {
        step[d] = maker->place[j][d] - maker->place[i][d];
        if (step[d] < -1 || step[d] > 1)
            return;
    }
    for (int a = 0; a < grid->corners; a++) {
        int b = 0, shared = 1;
        for (int d = 0; d < grid->dim; d++) {
            int upper = (a >> d & 1) - (int)step[d]; /* of j's cell */
            shared &= upper == 0 || upper == 1;
            b |= (upper & 1) << d;
        }
        if (shared)
            unite(maker->parent, grid->element[i] * grid->corners + a,
                  grid->element[j] * grid->corners + b);
    }
}

static void place_vertices(struct kr_grid_level *grid) {
    for (int d = 0; d < grid->dim; d++)
        grid->x[d] = KR_NEW(double, grid->n_vertices);
    for (size_t e = 0; e < grid->n_elements; e++) {
        int64_t cell = grid->cell[e];
        for (int d = 0; d < grid->dim; d++) {
            int64_t k = cell % grid->cells[d];
            cell /= grid->cells[d];
            for (int a = 0; a < grid->corners; a++)
                grid->x[d][grid->vertex[e * (size_t)grid->corners + (size_t)a]] =
                    grid->origin[d] + (double)(k + (a >> d & 1)) * grid->width;
        }
    }
}

static void find_shares(struct kr_grid_level *grid, int64_t (*place)[3], double *const x[3]) {
    grid->share = KR_NEW(double, grid->n * (size_t)grid->corners);
    for (size_t i = 0; i < grid->n; i++)
        for (int a = 0; a < grid->corners; a++) {
            double share = 1;
            for (int d = 0; d < grid->dim; d++) {
                double in = (x[d][i] - grid->origin[d]) / grid->width - (double)place[i][d];
                share *= a >> d & 1 ? in : 1 - in;
            }
            grid->share[i * (size_t)grid->corners + (size_t)a] = share;
        }
}

static int ascending(const void *p, const void *q) {
    const int32_t *a = p, *b = q;
    return (*a > *b) - (*a < *b);
}

/* Elements around each vertex: first[v] .. first[v + 1] in the list returned. */
static int32_t *elements_around(const struct kr_grid_level *grid, size_t *first) {
    size_t corners = (size_t)grid->corners, all = grid->n_elements * corners;
    int32_t *list = KR_NEW(int32_t, all);
    for (size_t k = 0; k < all; k++)
        first[grid->vertex[k] + 2]++;
    for (size_t v = 0; v < grid->n_vertices; v++)
        first[v + 2] += first[v + 1];
    for (size_t k = 0; k < all; k++)
        list[first[grid->vertex[k] + 1]++] = (int32_t)(k / corners);
    return list;
}

/* Two vertices may be coupled if an element of one and an element of the other touch. */
static void find_rows(struct kr_grid_level *grid) {
    size_t corners = (size_t)grid->corners, count = 0, room = 0, begin;
    size_t *around = KR_NEW(size_t, grid->n_vertices + 2);
    int32_t *list = elements_around(grid, around);
    int32_t *seen = KR_NEW(int32_t, grid->n_vertices); /* row + 1 */
    grid->first = KR_NEW(size_t, grid->n_vertices + 1);
    for (size_t v = 0; v < grid->n_vertices; v++) {
        begin = count;
        for (size_t k = around[v]; k < around[v + 1]; k++)
            for (size_t a = 0; a < corners; a++) {
                size_t near = (size_t)grid->vertex[(size_t)list[k] * corners + a];
                for (size_t m = around[near]; m < around[near + 1]; m++)
                    for (size_t b = 0; b < corners; b++) {
                        int32_t w = grid->vertex[(size_t)list[m] * corners + b];
                        if (seen[w] == (int32_t)v + 1)
                            continue;
                        seen[w] = (int32_t)v + 1;
                        KR_GROW(grid->column, count, room);
                        grid->column[count++] = w;
                    }
            }
        qsort(grid->column + begin, count - begin, sizeof *grid->column, ascending);
        grid->first[v + 1] = count;
    }
    kr_free(around);
    kr_free(list);
    kr_free(seen);
}

struct kr_grid_level *kr_grid_finish(struct kr_grid_maker *maker, double *const x[3]) {
    struct kr_grid_level *grid = maker->grid;
    size_t dim = (size_t)grid->dim, all = grid->n_elements * (size_t)grid->corners;
    grid->vertex = KR_NEW(int32_t, all);
    grid->n_vertices = number_roots(maker->parent, all, NULL, grid->vertex);
    place_vertices(grid);
    find_shares(grid, maker->place, x);
    find_rows(grid);
    grid->block = KR_NEW(double, grid->first[grid->n_vertices] * dim * dim);
    grid->inverse = KR_NEW(double, grid->n_vertices * dim * dim);
    grid->r = KR_NEW(double, grid->n_vertices * dim);
    grid->z = KR_NEW(double, grid->n_vertices * dim);
    grid->rest = KR_NEW(double, grid->n_vertices * dim);
    kr_free(maker->place);
    kr_free(maker->parent);
    kr_free(maker);
    return grid;
}

void kr_grid_free(struct kr_grid_level *grid) {
    void *all[] = {grid->element, grid->share,  grid->vertex,  grid->cell, grid->x[0], grid->x[1],
                   grid->x[2],    grid->first,  grid->column,  grid->block, grid->inverse,
                   grid->r,       grid->z,      grid->rest};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        kr_free(all[k]);
    kr_free(grid);
}
