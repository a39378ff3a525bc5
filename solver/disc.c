/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Circle and polygon. By Green's theorem the figure is the sum, over the polygon's edges p -> q, of
 * the signed figures that p, q and the centre span. Where the edge runs inside the circle that is
 * a triangle, where it runs outside the sector between the two directions:
 *
 *    triangle  A = (p x q)/2          M = A (p + q)/3
 *    sector    A = r^2 theta/2        M = r^3/3 (p^/|p| - q^/|q|)        v^ = v turned by -90
 * degrees
 *
 *    theta  angle from p to q, -pi to pi        x  cross product
 */
#include "disc.h"

#include <math.h>

static double cross(const double p[2], const double q[2]) {
    return p[0] * q[1] - p[1] * q[0];
}

static double dot(const double p[2], const double q[2]) {
    return p[0] * q[0] + p[1] * q[1];
}

static void add_triangle(const double p[2], const double q[2], struct kr_disc_part *sum) {
    double area = 0.5 * cross(p, q);
    sum->area += area;
    for (int d = 0; d < 2; d++)
        sum->moment[d] += area * (p[d] + q[d]) / 3;
}

static void add_sector(const double p[2], const double q[2], double r, struct kr_disc_part *sum) {
    double to_p = hypot(p[0], p[1]), to_q = hypot(q[0], q[1]), cube = r * r * r / 3;
    sum->area += 0.5 * r * r * atan2(cross(p, q), dot(p, q));
    sum->moment[0] += cube * (q[1] / to_q - p[1] / to_p);
    sum->moment[1] += cube * (p[0] / to_p - q[0] / to_q);
}

/* Where the line p + t (q - p) is inside the circle: between t[0] and t[1], cut to 0 .. 1. Returns
 * 0 if nowhere. The roots of a t^2 + 2 b t + c = 0 without cancellation. */
static int inside(const double p[2], const double q[2], double r, double t[2]) {
    double along[2] = {q[0] - p[0], q[1] - p[1]}, to_p = hypot(p[0], p[1]);
    double a = dot(along, along), b = dot(p, along), c = (to_p - r) * (to_p + r);
    double square = a * r * r - cross(p, q) * cross(p, q); /* = b^2 - a c */
    if (a == 0 || square <= 0)
        return 0;
    double root = sqrt(square), far = b > 0 ? -b - root : -b + root;
    t[0] = b > 0 ? far / a : c / far;
    t[1] = b > 0 ? c / far : far / a;
    t[0] = fmax(t[0], 0);
    t[1] = fmin(t[1], 1);
    return t[0] < t[1];
}

static void add_edge(const double p[2], const double q[2], double r, struct kr_disc_part *sum) {
    double t[2], enter[2], leave[2];
    if (!inside(p, q, r, t)) {
        add_sector(p, q, r, sum);
        return;
    }
    for (int d = 0; d < 2; d++) {
        enter[d] = t[0] > 0 ? p[d] + t[0] * (q[d] - p[d]) : p[d];
        leave[d] = t[1] < 1 ? p[d] + t[1] * (q[d] - p[d]) : q[d];
    }
    if (t[0] > 0)
        add_sector(p, enter, r, sum);
    add_triangle(enter, leave, sum);
    if (t[1] < 1)
        add_sector(leave, q, r, sum);
}

struct kr_disc_part kr_disc_polygon(size_t n, const double *point, double radius) {
    struct kr_disc_part sum = {0};
    for (size_t k = 0; k < n; k++)
        add_edge(point + 2 * k, point + 2 * ((k + 1) % n), radius, &sum);
    return sum;
}

struct kr_disc_part kr_disc_square(const double centre[2], double side, double radius) {
    const double h = 0.5 * side;
    const double corner[8] = {centre[0] - h, centre[1] - h, centre[0] + h, centre[1] - h,
                              centre[0] + h, centre[1] + h, centre[0] - h, centre[1] + h};
    return kr_disc_polygon(4, corner, radius);
}
