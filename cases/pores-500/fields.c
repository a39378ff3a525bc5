/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Random pore fields of the plates paper, section 6 (50 mm by 25 mm, radii 0.75 to 1.5 mm, one
 * diameter from the edges, 0.3 mm apart), each meshed on one grid. A field that cannot be meshed
 * stops the program; all others are held against the exact area and the rules of the pores.
 *
 *    fields GRID FROM TO PORES SPACING     seeds FROM to TO; SPACING in mm
 */
#include "base/error.h"
#include "base/memory.h"
#include "fill.h"
#include "mesh.h"
#include "plate.h"
#include "pores.h"
#include "quality.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double MM = 1e-3;

/* What all fields have in common. */
struct totals {
    double least, most, off, scatter, seconds, longest;
    size_t cells, triangles, regions, retried;
};

static int grid_named(const char *name) {
    char word[32];
    for (int k = 0; k <= KR_GRID_VORONOI; k++) {
        kr_case_word(KR_GRID_WORDS, k, word);
        if (!strcmp(word, name))
            return k;
    }
    kr_stop(KR_EXIT_INPUT, "unknown grid %s; there is %s", name, KR_GRID_WORDS);
}

/* Least distance between the rims of two pores [m]. */
static double least_gap(const struct kr_case_hole *pore, size_t n) {
    double least = INFINITY;
    for (size_t k = 0; k < n; k++)
        for (size_t l = 0; l < k; l++)
            least = fmin(least, hypot(pore[k].centre[0] - pore[l].centre[0],
                                      pore[k].centre[1] - pore[l].centre[1]) -
                                    pore[k].radius - pore[l].radius);
    return least;
}

static void count(const struct kr_mesh *mesh, const struct kr_plate *plate,
                  const struct kr_plate_report *report, struct totals *all) {
    struct kr_quality q =
        kr_quality_of(mesh, report->n_lattice, mesh->n_cells, plate->spacing);
    struct kr_quality whole = kr_quality_of(mesh, 0, mesh->n_cells, plate->spacing);
    double off = fabs(whole.area / report->exact_area - 1);
    if (!(off < 1e-12))
        kr_stop(KR_EXIT_NUMBERS, "the area is off by %g", off);
    all->off = fmax(all->off, off);
    all->least = fmin(all->least, q.least);
    all->most = fmax(all->most, q.most);
    all->scatter += q.variation;
    all->cells += q.n_cells;
    all->triangles += q.n_triangles;
    all->seconds += report->seconds;
    all->longest = fmax(all->longest, report->seconds);
    all->regions += report->n_regions;
    for (size_t r = 0; r < report->n_regions; r++)
        all->retried += strcmp(report->region[r].method, kr_fill_methods[0].words) != 0;
}

static void mesh_field(int grid, int64_t seed, int64_t pores, double spacing,
                       struct totals *all) {
    struct kr_case c = {.width = 50 * MM,
                        .height = 25 * MM,
                        .pores = {.count = pores,
                                  .seed = seed,
                                  .attempts = 1000000,
                                  .radius = {0.75 * MM, 1.5 * MM},
                                  .edge_diameters = 1,
                                  .gap = 0.3 * MM}};
    struct kr_plate_report report;
    struct kr_pores thrown = kr_pores_throw(&c);
    const struct kr_case_hole *pore = thrown.hole;
    if (thrown.placed < (size_t)pores)
        kr_stop(KR_EXIT_INPUT, "seed %lld: no place for %lld pores", (long long)seed,
                (long long)pores);
    if (!(least_gap(pore, (size_t)pores) >= (0.3 - 1e-9) * MM))
        kr_stop(KR_EXIT_NUMBERS, "seed %lld: two pores are too near", (long long)seed);
    struct kr_plate plate = {.width = c.width,
                             .height = c.height,
                             .spacing = spacing,
                             .padding = 3 * spacing,
                             .grid = (enum kr_grid)grid,
                             .n_holes = (size_t)pores,
                             .hole = pore,
                             .lloyd_steps = 5};
    struct kr_mesh *mesh = kr_plate_mesh(&plate, &report);
    char *fault = kr_mesh_fault(mesh);
    if (fault)
        kr_stop(KR_EXIT_NUMBERS, "seed %lld: %s", (long long)seed, fault);
    count(mesh, &plate, &report, all);
    kr_mesh_free(mesh);
    kr_plate_report_free(&report);
    kr_pores_free(&thrown);
}

int main(int argc, char **argv) {
    struct totals all = {.least = INFINITY};
    kr_error_program("fields");
    if (argc != 6)
        kr_stop(KR_EXIT_INPUT, "fields GRID FROM TO PORES SPACING");
    int grid = grid_named(argv[1]);
    int64_t from = atoll(argv[2]), to = atoll(argv[3]), pores = atoll(argv[4]);
    double spacing = atof(argv[5]) * MM;
    if (from < 0 || to < from || pores < 1 || !(spacing > 0))
        kr_stop(KR_EXIT_INPUT, "fields GRID FROM TO PORES SPACING: a number is out of range");
    for (int64_t seed = from; seed <= to; seed++) {
        mesh_field(grid, seed, pores, spacing, &all);
        if ((seed - from + 1) % 50 == 0)
            kr_say("  seed %lld: %.1f s so far", (long long)seed, all.seconds);
    }
    double n = (double)(to - from + 1);
    kr_say("%s: %.0f fields of %lld pores at %s mm, none failed: %zu cells near edges (%.2f %% "
           "triangles), areas %.3f to %.3f spacings squared, mean scatter %.3f, area off by %.1e at "
           "most; %zu regions, %zu of them by another method than the first; %.2f s a field, %.2f s "
           "the longest",
           argv[1], n, (long long)pores, argv[5], all.cells,
           100 * (double)all.triangles / fmax((double)all.cells, 1), all.least, all.most,
           all.scatter / n, all.off, all.regions, all.retried, all.seconds / n, all.longest);
    return 0;
}
