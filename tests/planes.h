/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What must hold of every mesh of a plate, for the tests of grids.
 */
#ifndef KR_PLANES_H
#define KR_PLANES_H

#include "cell.h"
#include "mesh.h"
#include "plate.h"
#include "side.h"
#include "test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MM 1e-3

/** A plate of 6 by 6 mm on a grid of this spacing, its padding three of them. Owned by the caller:
 *  the mesh, and the report. */
static inline struct kr_mesh *kr_test_plate(const struct kr_case_outline *outline, size_t n,
                                            const struct kr_case_hole *hole, enum kr_grid grid,
                                            double spacing, struct kr_plate_report *report) {
    const char *build = getenv("BUILD");
    char *helper = kr_text("%s/kirsch-gmsh", build ? build : "build");
    struct kr_plate plate = {.width = 6 * MM,
                             .height = 6 * MM,
                             .spacing = spacing,
                             .padding = 3 * spacing,
                             .grid = grid,
                             .n_holes = n,
                             .hole = hole,
                             .gmsh = {helper, 0, 0},
                             .lloyd_steps = 5,
                             .outline = *outline};
    struct kr_mesh *mesh = kr_plate_mesh(&plate, report);
    kr_free(helper);
    return mesh;
}

/** Lengths of a hole that is written in mm, in m. */
static inline void kr_test_in_mm(struct kr_case_hole *hole) {
    double *length[] = {&hole->centre[0], &hole->centre[1], &hole->radius, &hole->radii[0],
                        &hole->radii[1],  &hole->size[0],   &hole->size[1], &hole->length,
                        &hole->width,     &hole->corner_radius};
    for (size_t l = 0; l < sizeof length / sizeof *length; l++)
        *length[l] *= MM;
}

/** No two sides of a cell cross. */
static inline void kr_test_simple(const struct kr_mesh *mesh, size_t c) {
    size_t n = mesh->first[c + 1] - mesh->first[c];
    const size_t *v = mesh->vertex + mesh->first[c];
    for (size_t k = 0; k < n; k++)
        for (size_t l = k + 2; l < n - (k == 0); l++) {
            const double *a = mesh->point + 3 * v[k], *b = mesh->point + 3 * v[(k + 1) % n];
            const double *p = mesh->point + 3 * v[l], *q = mesh->point + 3 * v[(l + 1) % n];
            double x = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
            double y = (b[0] - a[0]) * (q[1] - a[1]) - (b[1] - a[1]) * (q[0] - a[0]);
            double z = (q[0] - p[0]) * (a[1] - p[1]) - (q[1] - p[1]) * (a[0] - p[0]);
            double w = (q[0] - p[0]) * (b[1] - p[1]) - (q[1] - p[1]) * (b[0] - p[0]);
            assert_false(((x > 0) != (y > 0)) && ((z > 0) != (w > 0)));
        }
}

/** Every side without a cell behind it is an edge of just one group, and at every point as many
 *  edges end as begin. Returns the length of all edges [mm]. */
static inline double kr_test_groups(const struct kr_mesh *mesh) {
    struct kr_sides *sides =
        kr_sides_create(mesh->n_points, mesh->n_cells, mesh->first, mesh->vertex);
    int *balance = KR_NEW(int, mesh->n_points);
    size_t rim = 0, grouped = 0;
    double length = 0;
    for (size_t s = 0; s < sides->count; s++)
        rim += !kr_sides_find(sides, sides->side[s].to, sides->side[s].from, NULL);
    assert_int_equal(rim, mesh->n_edges);
    for (size_t g = 0; g < mesh->n_groups; g++)
        grouped += mesh->group[g].dim == 1 ? mesh->group[g].count : 0;
    assert_int_equal(grouped, mesh->n_edges);
    for (size_t e = 0; e < mesh->n_edges; e++) {
        const double *p = mesh->point + 3 * mesh->edge[2 * e];
        const double *q = mesh->point + 3 * mesh->edge[2 * e + 1];
        balance[mesh->edge[2 * e]]++;
        balance[mesh->edge[2 * e + 1]]--;
        length += hypot(q[0] - p[0], q[1] - p[1]);
        assert_int_equal(kr_sides_find(sides, mesh->edge[2 * e], mesh->edge[2 * e + 1], NULL) +
                             kr_sides_find(sides, mesh->edge[2 * e + 1], mesh->edge[2 * e], NULL),
                         1);
    }
    for (size_t p = 0; p < mesh->n_points; p++)
        assert_int_equal(balance[p], 0);
    kr_free(balance);
    kr_sides_free(sides);
    return length / MM;
}

/** Area of all cells [mm^2]; each is positive and simple. */
/** Area of all cells [mm^2]; each is positive and simple. */
static inline double kr_test_plane(const struct kr_mesh *mesh) {
    long double sum = 0;
    for (size_t c = 0; c < mesh->n_cells; c++) {
        double corner[2 * 64], centroid[2];
        size_t n = mesh->first[c + 1] - mesh->first[c];
        assert_true(n <= 64);
        for (size_t k = 0; k < n; k++)
            memcpy(corner + 2 * k, mesh->point + 3 * mesh->vertex[mesh->first[c] + k],
                   2 * sizeof *corner);
        double area = kr_cell_polygon(n, corner, centroid);
        assert_true(area > 0);
        kr_test_simple(mesh, c);
        sum += area;
    }
    return (double)sum / (MM * MM);
}

#endif
