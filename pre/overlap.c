/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Polygons that overlap, also where they share no corner.
 *
 * A simple polygon is the sum of the signed triangles of its fan, so what two polygons have in common
 * is the sum of what their triangles have in common, with the product of their signs; this holds
 * for polygons that are not convex, too. Pairs that a side of one of them separates, nearly all, are
 * passed over; pairs are found by a grid of bins.
 */
#include "repair.h"

#include "base/memory.h"
#include "cell.h"

#include <math.h>
#include <string.h>

enum { MOST = 64 };

static double cross(const double *a, const double *b, const double *c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

/** Keep of a convex polygon what lies left of a line. */
static size_t clip(size_t n, double *p, const double *from, const double *to) {
    double out[2 * 16];
    size_t kept = 0;
    for (size_t k = 0; k < n; k++) {
        const double *a = p + 2 * k, *b = p + 2 * (k + 1 < n ? k + 1 : 0);
        double da = cross(from, to, a), db = cross(from, to, b);
        if (da >= 0) {
            memcpy(out + 2 * kept, a, 2 * sizeof *out);
            kept++;
        }
        if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
            double t = da / (da - db);
            out[2 * kept] = a[0] + t * (b[0] - a[0]);
            out[2 * kept + 1] = a[1] + t * (b[1] - a[1]);
            kept++;
        }
    }
    memcpy(p, out, 2 * kept * sizeof *out);
    return kept;
}

/** What two triangles have in common, with the product of their senses. */
static double common_of_triangles(const double *const a[3], const double *const b[3]) {
    double p[2 * 16], centroid[2];
    double sense_a = cross(a[0], a[1], a[2]), sense_b = cross(b[0], b[1], b[2]);
    size_t n = 3;
    if (sense_a == 0 || sense_b == 0)
        return 0;
    for (size_t k = 0; k < 3; k++)
        memcpy(p + 2 * k, a[sense_a > 0 ? k : 2 - k], 2 * sizeof *p);
    for (size_t k = 0; k < 3 && n >= 3; k++) {
        const double *from = b[k], *to = b[(k + 1) % 3];
        n = sense_b > 0 ? clip(n, p, from, to) : clip(n, p, to, from);
    }
    double area = n >= 3 ? fabs(kr_cell_polygon(n, p, centroid)) : 0;
    return (sense_a > 0) == (sense_b > 0) ? area : -area;
}

/** Whether all of b lies right of some side of a, and all of a left of it. */
static int is_apart(size_t n, const double *a, size_t m, const double *b) {
    for (size_t k = 0; k < n; k++) {
        const double *from = a + 2 * k, *to = a + 2 * (k + 1 < n ? k + 1 : 0);
        double rounding = 1e-9 * (pow(to[0] - from[0], 2) + pow(to[1] - from[1], 2));
        int apart = 1;
        for (size_t l = 0; l < m && apart; l++)
            apart = cross(from, to, b + 2 * l) <= rounding;
        for (size_t l = 0; l < n && apart; l++)
            apart = cross(from, to, a + 2 * l) >= -rounding;
        if (apart)
            return 1;
    }
    return 0;
}

double kr_polygons_common(size_t n, const double *a, size_t m, const double *b) {
    double area = 0;
    if (is_apart(n, a, m, b) || is_apart(m, b, n, a))
        return 0;
    for (size_t k = 1; k + 1 < n; k++)
        for (size_t l = 1; l + 1 < m; l++)
            area += common_of_triangles((const double *[]){a, a + 2 * k, a + 2 * k + 2},
                                        (const double *[]){b, b + 2 * l, b + 2 * l + 2});
    return area;
}

/* ---- pairs ---- */

struct box {
    double lower[2], upper[2];
};

struct bins {
    const struct kr_mesh *mesh;
    struct box *box; /* (n_cells) */
    double origin[2], size;
    size_t columns, rows;
    size_t *first, *cell; /* cells whose box's lower corner is in a bin */
};

static size_t corners_of(const struct kr_mesh *mesh, size_t cell, double *corner) {
    size_t n = mesh->first[cell + 1] - mesh->first[cell];
    for (size_t k = 0; k < n; k++)
        memcpy(corner + 2 * k, mesh->point + 3 * mesh->vertex[mesh->first[cell] + k],
               2 * sizeof *corner);
    return n;
}

static struct box box_of(const struct kr_mesh *mesh, size_t cell) {
    struct box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (size_t k = mesh->first[cell]; k < mesh->first[cell + 1]; k++)
        for (int d = 0; d < 2; d++) {
            double x = mesh->point[3 * mesh->vertex[k] + (size_t)d];
            box.lower[d] = fmin(box.lower[d], x);
            box.upper[d] = fmax(box.upper[d], x);
        }
    return box;
}

static size_t step(double x, double origin, double size, size_t count) {
    double k = floor((x - origin) / size);
    return k < 0 ? 0 : k >= (double)count ? count - 1 : (size_t)k;
}

static size_t bin_of(const struct bins *bins, const double *place) {
    return step(place[1], bins->origin[1], bins->size, bins->rows) * bins->columns +
           step(place[0], bins->origin[0], bins->size, bins->columns);
}

/** Bins as large as the largest cell, so that cells which meet stand in bins that touch; but not
 *  more of them than cells. */
static void measure_bins(struct bins *bins) {
    const struct kr_mesh *mesh = bins->mesh;
    double upper[2] = {-INFINITY, -INFINITY};
    bins->origin[0] = bins->origin[1] = INFINITY;
    for (size_t c = 0; c < mesh->n_cells; c++) {
        bins->box[c] = box_of(mesh, c);
        for (int d = 0; d < 2; d++) {
            bins->origin[d] = fmin(bins->origin[d], bins->box[c].lower[d]);
            upper[d] = fmax(upper[d], bins->box[c].upper[d]);
            bins->size = fmax(bins->size, bins->box[c].upper[d] - bins->box[c].lower[d]);
        }
    }
    double width = upper[0] - bins->origin[0], height = upper[1] - bins->origin[1];
    bins->size = fmax(bins->size, sqrt(width * height / (double)mesh->n_cells));
    bins->columns = (size_t)(width / bins->size) + 1;
    bins->rows = (size_t)(height / bins->size) + 1;
}

static void fill_bins(struct bins *bins) {
    const struct kr_mesh *mesh = bins->mesh;
    size_t count = bins->columns * bins->rows, *filled = KR_NEW(size_t, count);
    bins->first = KR_NEW(size_t, count + 1);
    bins->cell = KR_NEW(size_t, mesh->n_cells);
    for (size_t c = 0; c < mesh->n_cells; c++)
        bins->first[bin_of(bins, bins->box[c].lower) + 1]++;
    for (size_t b = 0; b < count; b++)
        bins->first[b + 1] += bins->first[b];
    for (size_t c = 0; c < mesh->n_cells; c++) {
        size_t b = bin_of(bins, bins->box[c].lower);
        bins->cell[bins->first[b] + filled[b]++] = c;
    }
    kr_free(filled);
}

/** Share of the smaller of two cells that both have; 0 at once where their boxes only touch. */
static double share(const struct bins *bins, size_t p, size_t q, double *area) {
    const struct box *a = &bins->box[p], *b = &bins->box[q];
    double corner[2][2 * MOST], centroid[2];
    for (int d = 0; d < 2; d++) {
        double margin = 1e-6 * fmin(a->upper[d] - a->lower[d], b->upper[d] - b->lower[d]);
        if (a->lower[d] > b->upper[d] - margin || b->lower[d] > a->upper[d] - margin)
            return 0;
    }
    size_t n = corners_of(bins->mesh, p, corner[0]), m = corners_of(bins->mesh, q, corner[1]);
    *area = kr_polygons_common(n, corner[0], m, corner[1]);
    return *area / fmin(kr_cell_polygon(n, corner[0], centroid),
                        kr_cell_polygon(m, corner[1], centroid));
}

/** The first cell behind `c` that overlaps it; n_cells if none. A cell that meets it begins at most
 *  one bin before it or within it. */
static size_t first_overlap(const struct bins *bins, size_t c, double *area) {
    const struct box *box = &bins->box[c];
    size_t found = bins->mesh->n_cells;
    double before[2] = {box->lower[0] - bins->size, box->lower[1] - bins->size}, common;
    size_t from[2], to[2];
    for (int d = 0; d < 2; d++) {
        size_t count = d ? bins->rows : bins->columns;
        from[d] = step(before[d], bins->origin[d], bins->size, count);
        to[d] = step(box->upper[d], bins->origin[d], bins->size, count);
    }
    for (size_t row = from[1]; row <= to[1]; row++)
        for (size_t k = bins->first[row * bins->columns + from[0]];
             k < bins->first[row * bins->columns + to[0] + 1]; k++)
            if (bins->cell[k] > c && bins->cell[k] < found &&
                share(bins, c, bins->cell[k], &common) > 1e-6) {
                found = bins->cell[k];
                *area = common;
            }
    return found;
}

int kr_mesh_overlap(const struct kr_mesh *mesh, size_t cell[2], double *area) {
    struct bins bins = {.mesh = mesh, .box = KR_NEW(struct box, mesh->n_cells)};
    measure_bins(&bins);
    fill_bins(&bins);
    size_t c = 0, other = mesh->n_cells;
    while (c < mesh->n_cells && (other = first_overlap(&bins, c, area)) == mesh->n_cells)
        c++;
    cell[0] = c;
    cell[1] = other;
    kr_free(bins.box);
    kr_free(bins.first);
    kr_free(bins.cell);
    return c < mesh->n_cells;
}
