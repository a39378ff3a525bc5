/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A plate from its description: the checks that no mesh could survive, and the uniform grid. The
 * near-boundary grid is in near_boundary.c.
 */
#include "plate.h"

#include "base/error.h"
#include "base/memory.h"
#include "builder.h"
#include "base/child.h"
#include "near_boundary.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

size_t kr_plate_sides(double radius, double spacing) {
    double fours = nearbyint(2 * PI * radius / (4 * spacing));
    return 4 * (fours > 2 ? (size_t)fours : 2);
}

double kr_plate_corner_radius(double radius, size_t sides) {
    double theta = 2 * PI / (double)sides;
    return radius * sqrt(theta / sin(theta));
}

/** How far a hole reaches from its centre on this grid. */
static double reach(const struct kr_plate *plate, const struct kr_case_hole *hole) {
    return plate->grid == KR_GRID_UNIFORM
               ? hole->radius
               : kr_plate_corner_radius(hole->radius, kr_plate_sides(hole->radius, plate->spacing));
}

static void check_hole(const struct kr_plate *plate, size_t h) {
    const struct kr_case_hole *hole = &plate->hole[h];
    const double *c = hole->centre, r = reach(plate, hole);
    if (!(hole->radius > 0) || !isfinite(hole->radius))
        kr_stop(KR_EXIT_INPUT, "hole_%zu has radius %g m; it must be positive", h + 1,
                hole->radius);
    if (!(c[0] - r > 0 && c[0] + r < plate->width && c[1] - r > 0 && c[1] + r < plate->height))
        kr_stop(KR_EXIT_INPUT,
                "hole_%zu (centre %.9g mm, %.9g mm, radius %.9g mm) cuts or touches the outline of "
                "the plate of %.9g mm by %.9g mm: holes must lie inside",
                h + 1, 1e3 * c[0], 1e3 * c[1], 1e3 * hole->radius, 1e3 * plate->width,
                1e3 * plate->height);
    for (size_t k = 0; k < h; k++) {
        const struct kr_case_hole *other = &plate->hole[k];
        double distance = hypot(c[0] - other->centre[0], c[1] - other->centre[1]);
        if (!(distance > r + reach(plate, other)))
            kr_stop(KR_EXIT_INPUT,
                    "hole_%zu (centre %.9g mm, %.9g mm, radius %.9g mm) cuts or touches hole_%zu "
                    "(centre %.9g mm, %.9g mm, radius %.9g mm): move them apart",
                    h + 1, 1e3 * c[0], 1e3 * c[1], 1e3 * hole->radius, k + 1,
                    1e3 * other->centre[0], 1e3 * other->centre[1], 1e3 * other->radius);
    }
}

/** Mark the cells whose centre lies in a hole by the hole's number plus 1; returns how many. */
static size_t mark_hole(const struct kr_lattice *lattice, const struct kr_case_hole *hole,
                        int32_t number, int32_t *hole_of) {
    double dx = lattice->spacing, r = hole->radius;
    double left = floor((hole->centre[0] - r) / dx), bottom = floor((hole->centre[1] - r) / dx);
    size_t marked = 0;
    for (size_t j = bottom > 0 ? (size_t)bottom : 0;
         j < lattice->rows && (double)j * dx <= hole->centre[1] + r; j++)
        for (size_t i = left > 0 ? (size_t)left : 0;
             i < lattice->columns && (double)i * dx <= hole->centre[0] + r; i++) {
            double x = ((double)i + 0.5) * dx - hole->centre[0];
            double y = ((double)j + 0.5) * dx - hole->centre[1];
            if (x * x + y * y < r * r) {
                hole_of[kr_lattice_cell(lattice, i, j)] = number;
                marked++;
            }
        }
    return marked;
}

/** Edges between the squares left and those that a hole took, square by square of the hole. */
static void staircase_edges(struct kr_builder *builder, const int32_t *hole_of, int32_t number) {
    const struct kr_lattice *lattice = &builder->lattice;
    static const int to[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}}; /* neighbour over side k */
    static const int end[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}; /* corners */
    for (size_t c = 0; c < lattice->columns * lattice->rows; c++) {
        if (hole_of[c] != number)
            continue;
        size_t i = c % lattice->columns, j = c / lattice->columns;
        for (int k = 0; k < 4; k++) {
            size_t ni = i + (size_t)to[k][0], nj = j + (size_t)to[k][1];
            if (ni >= lattice->columns || nj >= lattice->rows ||
                hole_of[kr_lattice_cell(lattice, ni, nj)])
                continue;
            /* The body lies outside this square: walk its side backwards. */
            kr_builder_edge(
                builder,
                kr_builder_lattice_point(builder, i + (size_t)end[k + 1][0],
                                         j + (size_t)end[k + 1][1]),
                kr_builder_lattice_point(builder, i + (size_t)end[k][0], j + (size_t)end[k][1]));
        }
    }
}

static struct kr_mesh *uniform(const struct kr_plate *plate, const struct kr_lattice *lattice,
                               struct kr_plate_report *report) {
    size_t cells = lattice->columns * lattice->rows, gone = 0;
    int32_t *hole_of = KR_NEW(int32_t, cells);
    unsigned char *is_gone = KR_NEW(unsigned char, cells);
    for (size_t h = 0; h < plate->n_holes; h++) {
        size_t marked = mark_hole(lattice, &plate->hole[h], (int32_t)h + 1, hole_of);
        if (!marked)
            kr_stop(
                KR_EXIT_INPUT,
                "hole_%zu of radius %.9g mm holds the centre of no cell of %.9g mm: the uniform "
                "grid cannot show it; take a finer spacing",
                h + 1, 1e3 * plate->hole[h].radius, 1e3 * lattice->spacing);
        gone += marked;
    }
    struct kr_builder builder = kr_builder_begin(lattice);
    for (size_t c = 0; c < cells; c++) {
        is_gone[c] = hole_of[c] != 0;
        if (!is_gone[c])
            kr_builder_square(&builder, c % lattice->columns, c / lattice->columns);
    }
    kr_builder_outline(&builder, is_gone);
    for (size_t h = 0; h < plate->n_holes; h++) {
        char *name = kr_text("hole_%zu", h + 1);
        staircase_edges(&builder, hole_of, (int32_t)h + 1);
        kr_builder_group_edges(&builder, name);
        kr_free(name);
    }
    report->n_lattice = cells - gone;
    report->polygonal_area = (double)(cells - gone) * lattice->spacing * lattice->spacing;
    kr_free(hole_of);
    kr_free(is_gone);
    return kr_builder_end(&builder);
}

struct kr_mesh *kr_plate_mesh(const struct kr_plate *plate, struct kr_plate_report *report) {
    double started = kr_child_clock();
    struct kr_lattice lattice = kr_lattice_fit(plate->width, plate->height, plate->spacing);
    *report = (struct kr_plate_report){.exact_area = plate->width * plate->height};
    for (size_t h = 0; h < plate->n_holes; h++) {
        check_hole(plate, h);
        report->exact_area -= PI * plate->hole[h].radius * plate->hole[h].radius;
    }
    struct kr_mesh *mesh = plate->grid == KR_GRID_UNIFORM
                               ? uniform(plate, &lattice, report)
                               : kr_near_boundary_mesh(plate, &lattice, report);
    report->seconds = kr_child_clock() - started;
    return mesh;
}

void kr_plate_report_free(struct kr_plate_report *report) {
    for (size_t r = 0; r < report->n_regions; r++)
        kr_free(report->region[r].name);
    report->region = kr_free(report->region);
    report->n_regions = 0;
}
