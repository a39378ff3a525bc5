/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From holes to regions: mark the cells of all boxes, repair corner contacts, number the connected
 * sets, and walk along their perimeters.
 */
#include "boxes.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

enum { FREE = -1, MARKED = -2 };

/** Lattice line at or outward of x (in spacings), kept on the plate. A box that ends on a line to
 *  1e-6 spacings is meant to end there. */
static size_t snap(double x, int outward, size_t most) {
    double line = outward > 0 ? ceil(x - 1e-6) : floor(x + 1e-6);
    return line <= 0 ? 0 : line >= (double)most ? most : (size_t)line;
}

static void mark_box(const struct kr_lattice *lattice, const struct kr_case_hole *hole,
                     double padding, int32_t *of_cell) {
    double reach = (hole->radius + padding) / lattice->spacing;
    double x = hole->centre[0] / lattice->spacing, y = hole->centre[1] / lattice->spacing;
    size_t left = snap(x - reach, -1, lattice->columns);
    size_t right = snap(x + reach, 1, lattice->columns);
    size_t bottom = snap(y - reach, -1, lattice->rows), top = snap(y + reach, 1, lattice->rows);
    for (size_t j = bottom; j < top; j++)
        for (size_t i = left; i < right; i++)
            of_cell[kr_lattice_cell(lattice, i, j)] = MARKED;
}

/** Mark a third cell wherever two marked ones meet only at a corner; returns how many. A new cell
 *  may make a new contact, so the caller repeats until none is left. */
static size_t repair_corners(const struct kr_lattice *lattice, int32_t *of_cell) {
    size_t repaired = 0;
    for (size_t j = 1; j < lattice->rows; j++)
        for (size_t i = 1; i < lattice->columns; i++) {
            int32_t *below = of_cell + kr_lattice_cell(lattice, i - 1, j - 1);
            int32_t *above = below + lattice->columns;
            if (below[0] == above[1] && below[1] == above[0] && below[0] != below[1]) {
                (below[0] == MARKED ? &below[1] : &below[0])[0] = MARKED;
                repaired++;
            }
        }
    return repaired;
}

/** Give one number to all marked cells connected with this one over sides. */
static size_t flood(const struct kr_lattice *lattice, size_t start, int32_t number,
                    int32_t *of_cell) {
    size_t room = 64, waiting = 1, cells = 0, columns = lattice->columns;
    size_t *stack = KR_NEW(size_t, room);
    stack[0] = start;
    of_cell[start] = number;
    while (waiting) {
        size_t c = stack[--waiting], i = c % columns, j = c / columns;
        size_t near[4];
        int n = 0;
        cells++;
        if (i > 0)
            near[n++] = c - 1;
        if (i + 1 < columns)
            near[n++] = c + 1;
        if (j > 0)
            near[n++] = c - columns;
        if (j + 1 < lattice->rows)
            near[n++] = c + columns;
        for (int k = 0; k < n; k++)
            if (of_cell[near[k]] == MARKED) {
                of_cell[near[k]] = number;
                KR_GROW(stack, waiting, room);
                stack[waiting++] = near[k];
            }
    }
    kr_free(stack);
    return cells;
}

static void number_regions(const struct kr_lattice *lattice, struct kr_regions *regions) {
    size_t room = 0;
    for (size_t c = 0; c < lattice->columns * lattice->rows; c++)
        if (regions->of_cell[c] == MARKED) {
            KR_GROW(regions->region, regions->count, room);
            struct kr_region *region = &regions->region[regions->count];
            memset(region, 0, sizeof *region);
            region->n_cells = flood(lattice, c, (int32_t)regions->count, regions->of_cell);
            regions->count++;
        }
}

/** Region of a cell, FREE outside the plate. */
static int32_t region_at(const struct kr_lattice *lattice, const int32_t *of_cell, size_t i,
                         size_t j) {
    /* i = 0 less one is the largest number, thus also outside. */
    return i < lattice->columns && j < lattice->rows ? of_cell[kr_lattice_cell(lattice, i, j)]
                                                     : FREE;
}

/** Direction in which a perimeter leaves lattice point (i, j): 0 to 3 for +x, +y, -x, -y, or -1.
 *  With corner contacts repaired there is at most one. */
static int way_out(const struct kr_lattice *lattice, const int32_t *of_cell, size_t i, size_t j) {
    int in[4] = {/* is the cell in a region: below left, below right, above right, above left */
                 region_at(lattice, of_cell, i - 1, j - 1) != FREE,
                 region_at(lattice, of_cell, i, j - 1) != FREE,
                 region_at(lattice, of_cell, i, j) != FREE,
                 region_at(lattice, of_cell, i - 1, j) != FREE};
    /* Going in direction d, cell d + 2 lies on the left and cell d + 1 on the right. */
    for (int d = 0; d < 4; d++)
        if (in[(d + 2) % 4] && !in[(d + 1) % 4])
            return d;
    return -1;
}

/** Walk once around from a corner; `walked` marks the points left behind. */
static struct kr_region_loop walk(const struct kr_lattice *lattice, const int32_t *of_cell,
                                  size_t i, size_t j, unsigned char *walked) {
    struct kr_region_loop loop = {0, NULL};
    size_t room = 0, start = kr_lattice_point(lattice, i, j), at = start;
    int heading = -1;
    do {
        int way = way_out(lattice, of_cell, i, j);
        kr_assert(way >= 0 && !walked[at]);
        walked[at] = 1;
        if (way != heading) {
            KR_GROW(loop.corner, loop.n_corners, room);
            loop.corner[loop.n_corners++] = (struct kr_region_corner){i, j, 0};
        }
        loop.corner[loop.n_corners - 1].run++;
        heading = way;
        i += way == 0 ? 1 : way == 2 ? (size_t)-1 : 0;
        j += way == 1 ? 1 : way == 3 ? (size_t)-1 : 0;
        at = kr_lattice_point(lattice, i, j);
    } while (at != start);
    return loop;
}

static void walk_perimeters(const struct kr_lattice *lattice, struct kr_regions *regions) {
    static const int left_of[4][2] = {{0, 0}, {-1, 0}, {-1, -1}, {0, -1}};
    unsigned char *walked = KR_NEW(unsigned char, (lattice->columns + 1) * (lattice->rows + 1));
    for (size_t j = 0; j <= lattice->rows; j++)
        for (size_t i = 0; i <= lattice->columns; i++) {
            int way = way_out(lattice, regions->of_cell, i, j);
            if (way < 0 || walked[kr_lattice_point(lattice, i, j)])
                continue;
            /* The lowest, then leftmost point of a loop is a corner, and a region's own lowest
             * stands on its outer perimeter: that is met first. */
            int32_t r = region_at(lattice, regions->of_cell, i + (size_t)left_of[way][0],
                                  j + (size_t)left_of[way][1]);
            struct kr_region *region = &regions->region[r];
            region->loop = kr_realloc(region->loop, region->n_loops + 1, sizeof *region->loop);
            region->loop[region->n_loops++] = walk(lattice, regions->of_cell, i, j, walked);
        }
    kr_free(walked);
}

/** Put each hole into the region of its centre. */
static void share_holes(const struct kr_lattice *lattice, size_t n_holes,
                        const struct kr_case_hole *hole, struct kr_regions *regions) {
    for (size_t h = 0; h < n_holes; h++) {
        size_t i = (size_t)(hole[h].centre[0] / lattice->spacing);
        size_t j = (size_t)(hole[h].centre[1] / lattice->spacing);
        int32_t r = region_at(lattice, regions->of_cell, i, j);
        kr_assert(r >= 0);
        struct kr_region *region = &regions->region[r];
        region->hole = kr_realloc(region->hole, region->n_holes + 1, sizeof *region->hole);
        region->hole[region->n_holes++] = h;
    }
}

struct kr_regions *kr_regions_create(const struct kr_lattice *lattice, size_t n_holes,
                                     const struct kr_case_hole *hole, double padding) {
    struct kr_regions *regions = KR_NEW(struct kr_regions, 1);
    size_t cells = lattice->columns * lattice->rows;
    regions->of_cell = KR_NEW(int32_t, cells);
    for (size_t c = 0; c < cells; c++)
        regions->of_cell[c] = FREE;
    for (size_t h = 0; h < n_holes; h++)
        mark_box(lattice, &hole[h], padding, regions->of_cell);
    while (repair_corners(lattice, regions->of_cell))
        ;
    number_regions(lattice, regions);
    walk_perimeters(lattice, regions);
    share_holes(lattice, n_holes, hole, regions);
    return regions;
}

void kr_regions_free(struct kr_regions *regions) {
    if (!regions)
        return;
    for (size_t r = 0; r < regions->count; r++) {
        for (size_t l = 0; l < regions->region[r].n_loops; l++)
            kr_free(regions->region[r].loop[l].corner);
        kr_free(regions->region[r].loop);
        kr_free(regions->region[r].hole);
    }
    kr_free(regions->region);
    kr_free(regions->of_cell);
    kr_free(regions);
}
