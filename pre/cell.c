/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Area and centroid of a polygon: a fan of triangles about the first vertex, whose signed areas
 * also serve where the polygon is not convex. Volume and centroid of a solid: the signed
 * tetrahedra between its first vertex and the triangles of its faces.
 */
#include "cell.h"

#include "solid.h"

#include <math.h>

double kr_cell_polygon(size_t n, const double *point, double centroid[2]) {
    const double x0 = point[0], y0 = point[1];
    double twice_area = 0, moment_x = 0, moment_y = 0, sum_x = 0, sum_y = 0;
    for (size_t k = 1; k < n; k++) {
        sum_x += point[2 * k] - x0;
        sum_y += point[2 * k + 1] - y0;
    }
    for (size_t k = 1; k + 1 < n; k++) {
        double ax = point[2 * k] - x0, ay = point[2 * k + 1] - y0;
        double bx = point[2 * k + 2] - x0, by = point[2 * k + 3] - y0;
        double cross = ax * by - bx * ay;
        twice_area += cross;
        moment_x += cross * (ax + bx);
        moment_y += cross * (ay + by);
    }
    int is_flat = twice_area == 0;
    centroid[0] = x0 + (is_flat ? sum_x / (double)n : moment_x / (3 * twice_area));
    centroid[1] = y0 + (is_flat ? sum_y / (double)n : moment_y / (3 * twice_area));
    return twice_area / 2;
}

double kr_cell_area(size_t n, const double *point) {
    const double x0 = point[0], y0 = point[1];
    double twice_area = 0;
    for (size_t k = 1; k + 1 < n; k++)
        twice_area += (point[2 * k] - x0) * (point[2 * k + 3] - y0) -
                      (point[2 * k + 2] - x0) * (point[2 * k + 1] - y0);
    return twice_area / 2;
}

static double triangle(const double *a, const double *b, const double *c) {
    return ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2;
}

int kr_cell_is_sound(size_t n, const double *p) {
    if (!(kr_cell_area(n, p) > 0))
        return 0;
    if (n != 4)
        return 1;
    return (triangle(p, p + 2, p + 4) > 0 && triangle(p, p + 4, p + 6) > 0) ||
           (triangle(p, p + 2, p + 6) > 0 && triangle(p + 2, p + 4, p + 6) > 0);
}

static double triple(const double *a, const double *b, const double *c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

static void away(const double *from, const double *to, double way[3]) {
    for (int d = 0; d < 3; d++)
        way[d] = to[d] - from[d];
}

double kr_cell_triangle(const double *a, const double *b, const double *c) {
    double u[3], v[3];
    away(a, b, u);
    away(a, c, v);
    return hypot(hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2]), u[0] * v[1] - u[1] * v[0]) / 2;
}

double kr_cell_tetrahedron(const double *a, const double *b, const double *c, const double *d) {
    double u[3], v[3], w[3];
    away(a, b, u);
    away(a, c, v);
    away(a, d, w);
    return triple(u, v, w) / 6;
}

static void add_triangle(const double *a, const double *b, const double *c, double sum[4]) {
    double six = triple(a, b, c);
    sum[3] += six;
    for (int d = 0; d < 3; d++)
        sum[d] += six * (a[d] + b[d] + c[d]);
}

/** Add six times the volume and twenty-four times the moment between a face and the origin. */
static void add_face(size_t n, const double *point, double sum[4]) {
    double middle[3];
    if (n == 3) {
        add_triangle(point, point + 3, point + 6, sum);
        return;
    }
    kr_solid_middle(n, point, middle);
    for (size_t k = 0; k < n; k++)
        add_triangle(middle, point + 3 * k, point + 3 * (k + 1 < n ? k + 1 : 0), sum);
}

/** The tetrahedra of a polyhedron, taken together. */
static double pieces(size_t n, const double *point, double centroid[3]) {
    double volume = 0, moment[3] = {0}, middle[3];
    for (size_t k = 0; k < n; k += 4) {
        double part = kr_cell_solid(4, point + 3 * k, middle);
        volume += part;
        for (int d = 0; d < 3; d++)
            moment[d] += part * (middle[d] - point[d]);
    }
    for (int d = 0; d < 3; d++)
        centroid[d] = point[d] + (volume == 0 ? 0 : moment[d] / volume);
    return volume;
}

double kr_cell_solid(size_t n, const double *point, double centroid[3]) {
    if (kr_solid_is_pieces(n))
        return pieces(n, point, centroid);
    const struct kr_solid *solid = kr_solid(n);
    double local[3 * 20], face[3 * KR_MOST_FACE], sum[4] = {0}, mean[3] = {0};
    size_t number[20], vertex[KR_MOST_FACE];
    for (size_t k = 0; k < n; k++) {
        number[k] = k;
        for (size_t d = 0; d < 3; d++) {
            local[3 * k + d] = point[3 * k + d] - point[d];
            mean[d] += local[3 * k + d] / (double)n;
        }
    }
    /* Vertices at one place count as two here: their triangles are empty. */
    for (size_t f = 0; f < solid->n_faces; f++) {
        size_t corners = kr_solid_face(n, number, f, vertex);
        for (size_t k = 0; k < 3 * corners; k++)
            face[k] = local[3 * vertex[k / 3] + k % 3];
        add_face(corners, face, sum);
    }
    for (int d = 0; d < 3; d++)
        centroid[d] = point[d] + (sum[3] == 0 ? mean[d] : sum[d] / (4 * sum[3]));
    return sum[3] / 6;
}

double kr_cell_face(size_t n, const double *point, double middle[3]) {
    double area = 0;
    kr_solid_middle(n, point, middle);
    for (size_t k = 0; k < n; k++)
        area += kr_cell_triangle(middle, point + 3 * k, point + 3 * (k + 1 < n ? k + 1 : 0));
    return area;
}
