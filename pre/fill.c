/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Requests to gmsh and checks of its replies.
 *
 * The points on the loops are laid exactly where they were asked for, so that neighbours share
 * them to the last bit. The cells are then held against the loops by their sides: each side of a
 * cell must be walked back by just one other cell, or be a side of a loop.
 */
#include "fill.h"

#include "base/memory.h"
#include "cell.h"
#include "mesh.h"
#include "side.h"

#include <math.h>
#include <string.h>

/* Size 0.98 and blossom: nearest to one cell a spacing squared (mean area 1.01) at the least
 * scatter of area. Algorithm 6 makes cells a tenth smaller at 1.5 times the scatter; simple
 * recombination leaves more triangles. 7, 8 and 11 crash or do not exist in gmsh 4.8, and the
 * recombinations 2 and 3 make cells that overlap. Subdivision is not used: it needs an even number
 * of cells on each straight run, and a run may be odd. */
const struct kr_fill_method kr_fill_methods[] = {
    {"packing of parallelograms (9), blossom", 9, 1, 0.98},
    {"frontal-Delaunay (6), blossom", 6, 1, 1.0},
    {"packing of parallelograms (9), simple", 9, 0, 0.98},
    {"frontal-Delaunay (6), simple", 6, 0, 1.0},
};
const size_t kr_fill_n_methods = sizeof kr_fill_methods / sizeof *kr_fill_methods;

/* gmsh computes points on lines in double precision from numbers below 1e5: 1e-6 spacings is far
 * above its rounding and far below a wrong place. */
static const double SAME_PLACE = 1e-6;
static const double SAME_AREA = 1e-10;

void kr_fill_ask(const struct kr_gmsh_region *region, const struct kr_fill_method *method,
                 FILE *file) {
    fprintf(file, "region algorithm %d recombination %d size %.17g loops %zu\n", method->algorithm,
            method->recombination, method->size, region->n_loops);
    for (size_t l = 0; l < region->n_loops; l++) {
        fprintf(file, "loop %zu\n", region->first[l + 1] - region->first[l]);
        for (size_t k = region->first[l]; k < region->first[l + 1]; k++)
            fprintf(file, "%.17g %.17g %zu\n", region->corner[2 * k], region->corner[2 * k + 1],
                    region->segments[k]);
    }
}

static const double *next_corner(const struct kr_gmsh_region *region, size_t loop, size_t k) {
    return region->corner + 2 * (k + 1 < region->first[loop + 1] ? k + 1 : region->first[loop]);
}

double kr_gmsh_twice_area(const struct kr_gmsh_region *region) {
    double twice = 0;
    for (size_t l = 0; l < region->n_loops; l++) {
        /* About the loop's own first corner: nothing is lost for a small loop far away. */
        const double *o = region->corner + 2 * region->first[l];
        for (size_t k = region->first[l]; k < region->first[l + 1]; k++) {
            const double *a = region->corner + 2 * k, *b = next_corner(region, l, k);
            twice += (a[0] - o[0]) * (b[1] - o[1]) - (b[0] - o[0]) * (a[1] - o[1]);
        }
    }
    return twice;
}

static size_t points_on_loops(const struct kr_gmsh_region *region) {
    size_t n = 0;
    for (size_t k = 0; k < region->first[region->n_loops]; k++)
        n += region->segments[k];
    return n;
}

/** A count that the rest of the reply can hold: each item takes two characters or more. */
static int read_count(FILE *file, const char *format, size_t limit, size_t *count) {
    return fscanf(file, format, count) == 1 && *count <= limit;
}

static size_t bytes_of(FILE *file) {
    fseek(file, 0, SEEK_END);
    long size = ftell(file);
    rewind(file);
    return size > 0 ? (size_t)size : 0;
}

static int read_cells(struct kr_gmsh_region *region, FILE *file, size_t limit) {
    size_t n, corners;
    for (int kind = 0; kind < 2; kind++) {
        if (!read_count(file, " cells %zu", limit, &n))
            return 0;
        size_t total = region->n_cells + n, at = region->cell_first[region->n_cells];
        region->cell_first = kr_realloc(region->cell_first, total + 1, sizeof(size_t));
        region->vertex = kr_realloc(region->vertex, at + 4 * n, sizeof(size_t));
        for (size_t c = 0; c < n; c++) {
            if (fscanf(file, "%zu", &corners) != 1 || corners < 3 || corners > 4)
                return 0;
            for (size_t k = 0; k < corners; k++)
                if (fscanf(file, "%zu", &region->vertex[at + k]) != 1 ||
                    region->vertex[at + k] >= region->n_points)
                    return 0;
            at += corners;
            region->cell_first[++region->n_cells] = at;
        }
    }
    char end[4] = "";
    return region->n_cells > 0 && fscanf(file, " %3s", end) == 1 && !strcmp(end, "end");
}

static char *parse(struct kr_gmsh_region *region, FILE *file) {
    size_t limit = bytes_of(file) / 2;
    if (!read_count(file, " nodes %zu", limit, &region->n_points) ||
        region->n_points < region->n_on_loops)
        return kr_text("its reply ends early");
    region->point = KR_NEW(double, 2 * region->n_points);
    for (size_t k = 0; k < 2 * region->n_points; k++)
        if (fscanf(file, "%lf", &region->point[k]) != 1 || !isfinite(region->point[k]))
            return kr_text("its reply ends early");
    region->cell_first = KR_NEW(size_t, 1);
    return read_cells(region, file, limit) ? NULL : kr_text("its reply ends early");
}

/** Lay the points of the loops where they were asked for. */
static char *lay_loops(struct kr_gmsh_region *region) {
    size_t p = 0;
    for (size_t l = 0; l < region->n_loops; l++)
        for (size_t k = region->first[l]; k < region->first[l + 1]; k++) {
            const double *a = region->corner + 2 * k, *b = next_corner(region, l, k);
            for (size_t s = 0; s < region->segments[k]; s++, p++) {
                /* In this order whole numbers stay whole: the lattice's points are exact. */
                double n = (double)region->segments[k], t = (double)s;
                double x = a[0] + t * (b[0] - a[0]) / n, y = a[1] + t * (b[1] - a[1]) / n;
                double *point = region->point + 2 * p;
                if (!(hypot(point[0] - x, point[1] - y) <= SAME_PLACE))
                    return kr_text("it moved a point of the boundary from (%g, %g) to (%g, %g)", x,
                                   y, point[0], point[1]);
                point[0] = x;
                point[1] = y;
            }
        }
    return NULL;
}

/** Place of the point that follows p on its loop. */
static size_t *followers(const struct kr_gmsh_region *region) {
    size_t *next = KR_NEW(size_t, region->n_on_loops), p = 0;
    for (size_t l = 0; l < region->n_loops; l++) {
        size_t begin = p;
        for (size_t k = region->first[l]; k < region->first[l + 1]; k++)
            for (size_t s = 0; s < region->segments[k]; s++, p++)
                next[p] = p + 1;
        next[p - 1] = begin;
    }
    return next;
}

/** The boundary of the cells is the loops, and no two cells overlap. */
static char *boundary_fault(const struct kr_gmsh_region *region) {
    struct kr_sides *sides =
        kr_sides_create(region->n_points, region->n_cells, region->cell_first, region->vertex);
    size_t *next = followers(region), on_loops = 0;
    char *fault = NULL;
    for (size_t s = 0; s < sides->count && !fault; s++) {
        size_t a = sides->side[s].from, b = sides->side[s].to;
        const double *point = region->point + 2 * a;
        size_t back = kr_sides_find(sides, b, a, NULL);
        if (kr_sides_find(sides, a, b, NULL) > 1 || back > 1)
            fault = kr_text("cells overlap at (%g, %g)", point[0], point[1]);
        else if (back == 1)
            continue;
        else if (a < region->n_on_loops && next[a] == b)
            on_loops++;
        else
            fault = kr_text("the cells leave a gap at (%g, %g)", point[0], point[1]);
    }
    if (!fault && on_loops != region->n_on_loops)
        fault = kr_text("the cells meet %zu of %zu sides of the boundary", on_loops,
                        region->n_on_loops);
    kr_free(next);
    kr_sides_free(sides);
    return fault;
}

static char *area_fault(const struct kr_gmsh_region *region) {
    double sum = 0, wanted = kr_gmsh_twice_area(region) / 2;
    for (size_t c = 0; c < region->n_cells; c++) {
        double corner[8], centroid[2];
        size_t n = region->cell_first[c + 1] - region->cell_first[c];
        for (size_t k = 0; k < n; k++)
            memcpy(corner + 2 * k, region->point + 2 * region->vertex[region->cell_first[c] + k],
                   2 * sizeof *corner);
        if (!kr_cell_is_sound(n, corner))
            return kr_text("a cell at (%g, %g) is folded or has no area", corner[0], corner[1]);
        sum += kr_cell_polygon(n, corner, centroid);
    }
    if (!(fabs(sum - wanted) <= SAME_AREA * wanted))
        return kr_text("the cells' areas sum to %.12g instead of %.12g spacings squared", sum,
                       wanted);
    return NULL;
}

static void forget(struct kr_gmsh_region *region) {
    region->point = kr_free(region->point);
    region->cell_first = kr_free(region->cell_first);
    region->vertex = kr_free(region->vertex);
    region->n_points = region->n_cells = 0;
}

char *kr_fill_read(struct kr_gmsh_region *region, FILE *file) {
    region->n_on_loops = points_on_loops(region);
    char *fault = parse(region, file);
    if (!fault)
        fault = lay_loops(region);
    if (!fault)
        fault = boundary_fault(region);
    if (!fault)
        fault = area_fault(region);
    if (fault)
        forget(region);
    return fault;
}

void kr_gmsh_region_free(struct kr_gmsh_region *region) {
    forget(region);
    kr_free(region->first);
    kr_free(region->corner);
    kr_free(region->segments);
}
