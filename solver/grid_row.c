/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From the finer stiffness to that on the vertices, row by row; theory.md (22).
 */
#include "grid.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/* Blocks of a row by the corners of the elements it reaches. */
struct kr_grid_row {
    size_t count, room;
    int32_t *element;
    double *block; /* (room x corners x dim x dim) */
};

struct kr_grid_row *kr_grid_row_create(const struct kr_grid_level *grid) {
    struct kr_grid_row *row = KR_NEW(struct kr_grid_row, 1);
    (void)grid;
    return row;
}

void kr_grid_row_free(struct kr_grid_row *row) {
    kr_free(row->element);
    kr_free(row->block);
    kr_free(row);
}

static double *blocks_for(struct kr_grid_row *row, int32_t element, size_t each) {
    for (size_t k = 0; k < row->count; k++)
        if (row->element[k] == element)
            return row->block + k * each;
    if (row->count == row->room) {
        row->room = row->room ? 2 * row->room : 16;
        row->element = kr_realloc(row->element, row->room, sizeof *row->element);
        row->block = kr_realloc(row->block, row->room * each, sizeof *row->block);
    }
    row->element[row->count] = element;
    memset(row->block + row->count * each, 0, each * sizeof *row->block);
    return row->block + row->count++ * each;
}

void kr_grid_row_add(struct kr_grid_row *row, const struct kr_grid_level *grid, size_t j,
                     const double *block) {
    size_t square = (size_t)(grid->dim * grid->dim), corners = (size_t)grid->corners;
    if (grid->element[j] < 0)
        return;
    double *into = blocks_for(row, grid->element[j], corners * square);
    const double *share = grid->share + j * corners;
    for (size_t a = 0; a < corners; a++)
        for (size_t k = 0; k < square; k++)
            into[a * square + k] += share[a] * block[k];
}

static size_t place_of(const struct kr_grid_level *grid, size_t v, int32_t w) {
    size_t low = grid->first[v], high = grid->first[v + 1];
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (grid->column[middle] < w)
            low = middle + 1;
        else
            high = middle;
    }
    kr_assert(low < grid->first[v + 1] && grid->column[low] == w);
    return low;
}

void kr_grid_row_end(struct kr_grid_row *row, const struct kr_grid_level *grid, size_t i, double *into,
                     size_t from) {
    size_t square = (size_t)(grid->dim * grid->dim), corners = (size_t)grid->corners;
    if (grid->element[i] < 0)
        row->count = 0;
    const int32_t *mine = grid->vertex + (row->count ? (size_t)grid->element[i] * corners : 0);
    for (size_t k = 0; k < row->count; k++)
        for (size_t b = 0; b < corners; b++) {
            const double *reached = row->block + (k * corners + b) * square;
            int32_t w = grid->vertex[(size_t)row->element[k] * corners + b];
            for (size_t a = 0; a < corners; a++) {
                double share = grid->share[i * corners + a];
                double *block = into + (place_of(grid, (size_t)mine[a], w) - from) * square;
                for (size_t m = 0; m < square; m++)
                    block[m] += share * reached[m];
            }
        }
    row->count = 0;
}

/* By the sweep operator, which leaves minus the inverse. A pivot that is rounding (1e-10 of the
 * largest entry) is a direction without stiffness. */
void kr_grid_invert(int dim, const double *block, double *inverse) {
    double a[9], largest = 0;
    for (int k = 0; k < dim; k++)
        largest = fmax(largest, block[k * dim + k]);
    memcpy(a, block, (size_t)(dim * dim) * sizeof *a);
    for (int k = 0; k < dim; k++) {
        double pivot = a[k * dim + k];
        int none = !(pivot > 1e-10 * largest);
        for (int i = 0; i < dim && !none; i++)
            for (int j = 0; j < dim; j++)
                if (i != k && j != k)
                    a[i * dim + j] -= a[i * dim + k] * a[k * dim + j] / pivot;
        for (int i = 0; i < dim; i++)
            a[i * dim + k] = a[k * dim + i] = none ? 0 : a[i * dim + k] / pivot;
        a[k * dim + k] = none ? 0 : -1 / pivot;
    }
    for (int k = 0; k < dim * dim; k++)
        inverse[k] = -a[k];
}
