/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Area and centroid of a polygon: a fan of triangles about the first vertex, whose signed areas
 * also serve where the polygon is not convex.
 */
#include "cell.h"

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

static double triangle(const double *a, const double *b, const double *c) {
    return ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2;
}

int kr_cell_is_sound(size_t n, const double *p) {
    double centroid[2];
    if (!(kr_cell_polygon(n, p, centroid) > 0))
        return 0;
    if (n != 4)
        return 1;
    return (triangle(p, p + 2, p + 4) > 0 && triangle(p, p + 4, p + 6) > 0) ||
           (triangle(p, p + 2, p + 6) > 0 && triangle(p + 2, p + 4, p + 6) > 0);
}
