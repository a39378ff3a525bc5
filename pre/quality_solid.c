/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The quality report of solids.
 */
#include "quality_solid.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>

/* A hexahedron of a cube's volume at a cube's place is one: to far more than rounding. */
static const double SAME = 1e-9;

/** Distance, in spacings, from the nearest centre of a cube of the lattice. */
static double shift_of(const double place[3], double spacing) {
    double sum = 0;
    for (int d = 0; d < 3; d++) {
        double x = place[d] / spacing - 0.5;
        sum = hypot(sum, x - nearbyint(x));
    }
    return sum;
}

static int is_of(enum kr_cell_kind kind, size_t vertices, double volume, double shift) {
    int is_cube = vertices == 8 && fabs(volume - 1) < SAME && shift < SAME;
    return kind == KR_CELLS_ALL || is_cube == (kind == KR_CELLS_LATTICE);
}

struct kr_quality_solid kr_quality_solid_of(const struct kr_mesh *mesh, enum kr_cell_kind kind,
                                            double spacing) {
    struct kr_quality_solid q = {.least = INFINITY};
    double cube = spacing * spacing * spacing, lost = 0, squares = 0;
    for (size_t c = 0; c < mesh->n_cells; c++) {
        double place[3], volume = kr_mesh_cell_volume(mesh, c, place);
        double share = volume / cube, shift = shift_of(place, spacing), sum = q.volume + volume;
        if (!is_of(kind, mesh->first[c + 1] - mesh->first[c], share, shift))
            continue;
        lost += fabs(q.volume) >= volume ? (q.volume - sum) + volume : (volume - sum) + q.volume;
        q.volume = sum;
        q.n_cells++;
        q.n_tetrahedra += mesh->first[c + 1] - mesh->first[c] == 4;
        q.least = fmin(q.least, share);
        q.most = fmax(q.most, share);
        q.shift = fmax(q.shift, shift);
        squares += (share - 1) * (share - 1);
    }
    q.volume += lost;
    if (!q.n_cells)
        return (struct kr_quality_solid){0};
    q.mean = q.volume / cube / (double)q.n_cells;
    q.variation =
        sqrt(fmax(squares / (double)q.n_cells - (q.mean - 1) * (q.mean - 1), 0)) / q.mean;
    return q;
}

static void print_cells(const char *which, const struct kr_quality_solid *q) {
    if (q->n_cells)
        kr_say("  %-13s %9zu %9zu   %.4f   %.4f   %.4f   %.4f    %.4f", which, q->n_cells,
               q->n_tetrahedra, q->least, q->mean, q->most, q->variation, q->shift);
}

static void print_volume(double volume, const struct kr_block_report *report) {
    kr_say("  volume %.9g mm^3%s", 1e9 * volume,
           report->exact_volume > 0 ? "" : "; that of the true surfaces is not known in closed form");
    if (report->filled_volume > 0)
        kr_say("    off by %.1e from the facets that the cells fill", volume / report->filled_volume - 1);
    if (report->exact_volume > 0)
        kr_say("    off by %.1e from the true surfaces", volume / report->exact_volume - 1);
}

void kr_quality_solid_print(const struct kr_mesh *mesh, const struct kr_block *block,
                            const struct kr_block_report *report) {
    double dx = block->plate.spacing;
    char grid[32];
    kr_case_word(KR_GRID_WORDS, (int)block->plate.grid, grid);
    struct kr_quality_solid all = kr_quality_solid_of(mesh, KR_CELLS_ALL, dx);
    struct kr_quality_solid lattice = kr_quality_solid_of(mesh, KR_CELLS_LATTICE, dx);
    struct kr_quality_solid other = kr_quality_solid_of(mesh, KR_CELLS_OTHER, dx);
    kr_say("solid %.9g mm by %.9g mm by %.9g mm, %zu holes, %zu voids, spacing %.9g mm, %s grid",
           1e3 * block->plate.width, 1e3 * block->plate.height, 1e3 * block->depth,
           block->plate.n_holes, block->n_voids, 1e3 * dx, grid);
    kr_say("  %zu points, %zu boundary faces, %zu named groups, %.2f s", mesh->n_points,
           mesh->n_faces, mesh->n_groups, report->seconds);
    kr_say("  %-13s %9s %9s   volume over spacing cubed", "", "", "");
    kr_say("  %-13s %9s %9s   %-6s   %-6s   %-6s   %-7s   %s", "", "cells", "tetrahedra", "least",
           "mean", "most", "scatter", "shift");
    print_cells("all", &all);
    print_cells("lattice", &lattice);
    print_cells("near surfaces", &other);
    print_volume(all.volume, report);
    kr_say("  faces off the true surfaces by %.2g spacings at most; %.0f MB of memory",
           report->conformity / dx, 1e-6 * (double)kr_memory_peak());
    for (size_t r = 0; r < report->n_regions; r++)
        kr_say("  region %s: %zu cells, %.2f s, %s", report->region[r].name,
               report->region[r].n_cells, report->region[r].seconds, report->region[r].method);
}
