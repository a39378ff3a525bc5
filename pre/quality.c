/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The quality report. Sums are compensated: they are held against an exact area to 1e-12.
 */
#include "quality.h"

#include "base/error.h"
#include "base/memory.h"
#include "cell.h"

#include <math.h>
#include <string.h>

static double area_of(const struct kr_mesh *mesh, size_t cell, double *corner,
                      double centroid[2]) {
    size_t n = mesh->first[cell + 1] - mesh->first[cell];
    for (size_t k = 0; k < n; k++)
        memcpy(corner + 2 * k, mesh->point + 3 * mesh->vertex[mesh->first[cell] + k],
               2 * sizeof *corner);
    return kr_cell_polygon(n, corner, centroid);
}

/** Distance, in spacings, from the nearest centre of a square of the lattice. */
static double shift_of(const double place[2], double spacing) {
    double x = place[0] / spacing - 0.5, y = place[1] / spacing - 0.5;
    return hypot(x - nearbyint(x), y - nearbyint(y));
}

struct kr_quality kr_quality_of(const struct kr_mesh *mesh, size_t from, size_t to,
                                double spacing) {
    struct kr_quality q = {0};
    size_t most_corners = 4;
    double lost = 0, squares = 0;
    if (from >= to)
        return q;
    for (size_t c = from; c < to; c++)
        if (mesh->first[c + 1] - mesh->first[c] > most_corners)
            most_corners = mesh->first[c + 1] - mesh->first[c];
    double *corner = KR_NEW(double, 2 * most_corners);
    q.least = INFINITY;
    for (size_t c = from; c < to; c++) {
        double centroid[2], area = area_of(mesh, c, corner, centroid), sum = q.area + area;
        q.shift = fmax(q.shift, shift_of(centroid, spacing));
        lost += fabs(q.area) >= area ? (q.area - sum) + area : (area - sum) + q.area;
        q.area = sum;
        q.least = fmin(q.least, area / (spacing * spacing));
        q.most = fmax(q.most, area / (spacing * spacing));
        q.n_triangles += mesh->first[c + 1] - mesh->first[c] == 3;
    }
    q.area += lost;
    q.n_cells = to - from;
    double mean = q.area / (double)q.n_cells;
    for (size_t c = from; c < to; c++) {
        double centroid[2], off = area_of(mesh, c, corner, centroid) - mean;
        squares += off * off;
    }
    q.mean = mean / (spacing * spacing);
    q.variation = sqrt(squares / (double)q.n_cells) / mean;
    kr_free(corner);
    return q;
}

static void print_cells(const char *which, const struct kr_quality *q) {
    if (q->n_cells)
        kr_say("  %-12s %9zu %9zu   %.4f   %.4f   %.4f   %.4f    %.4f", which, q->n_cells, q->n_triangles,
               q->least, q->mean, q->most, q->variation, q->shift);
}

void kr_quality_print(const struct kr_mesh *mesh, const struct kr_plate *plate,
                      const struct kr_plate_report *report) {
    double dx = plate->spacing;
    char grid[32];
    kr_case_word(KR_GRID_WORDS, (int)plate->grid, grid);
    struct kr_quality all = kr_quality_of(mesh, 0, mesh->n_cells, dx);
    struct kr_quality lattice = kr_quality_of(mesh, 0, report->n_lattice, dx);
    struct kr_quality boxes = kr_quality_of(mesh, report->n_lattice, mesh->n_cells, dx);
    kr_say("plate %.9g mm by %.9g mm, %zu holes, spacing %.9g mm, %s grid", 1e3 * plate->width,
           1e3 * plate->height, plate->n_holes, 1e3 * dx,
           grid);
    kr_say("  %zu points, %zu boundary edges in %zu named groups, %.2f s", mesh->n_points,
           mesh->n_edges, mesh->n_groups, report->seconds);
    kr_say("  %-12s %9s %9s   area over spacing squared", "", "", "");
    kr_say("  %-12s %9s %9s   %-6s   %-6s   %-6s   %-7s   %s", "", "cells", "triangles", "least",
           "mean", "most", "scatter", "shift");
    print_cells("all", &all);
    print_cells("lattice", &lattice);
    print_cells("near edges", &boxes);
    kr_say("  area %.9g mm^2; off by %.1e from the polygons that the cells fill, by %.1e from "
           "the exact curves",
           1e6 * all.area, all.area / report->polygonal_area - 1,
           all.area / report->exact_area - 1);
    kr_say("  edges off the true curves by %.2g spacings at most; %.0f MB of memory",
           report->conformity / dx, 1e-6 * (double)kr_memory_peak());
    for (size_t r = 0; r < report->n_regions; r++)
        kr_say("  region %s: %zu cells, %zu triangles, %.2f s, %s", report->region[r].name,
               report->region[r].n_cells, report->region[r].n_triangles, report->region[r].seconds,
               report->region[r].method);
}
