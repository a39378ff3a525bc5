/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Segments and polygons in a plane. See flat.h.
 */
#include "flat.h"

#include <math.h>

double kr_flat_turn(const double p[2], const double q[2], const double r[2]) {
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

int kr_flat_segments_meet(const double p[2], const double q[2], const double a[2],
                          const double c[2]) {
    double a_side = kr_flat_turn(p, q, a), c_side = kr_flat_turn(p, q, c);
    double p_side = kr_flat_turn(a, c, p), q_side = kr_flat_turn(a, c, q);
    if (a_side == 0 && c_side == 0) /* on one line: they meet where their extents overlap */
        return fmax(fmin(p[0], q[0]), fmin(a[0], c[0])) <=
                   fmin(fmax(p[0], q[0]), fmax(a[0], c[0])) &&
               fmax(fmin(p[1], q[1]), fmin(a[1], c[1])) <=
                   fmin(fmax(p[1], q[1]), fmax(a[1], c[1]));
    return a_side * c_side <= 0 && p_side * q_side <= 0;
}

static double distance(const double a[2], const double b[2], const double place[2]) {
    double along[2] = {b[0] - a[0], b[1] - a[1]}, off[2] = {place[0] - a[0], place[1] - a[1]};
    double square = along[0] * along[0] + along[1] * along[1];
    double t = square > 0 ? (off[0] * along[0] + off[1] * along[1]) / square : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(off[0] - t * along[0], off[1] - t * along[1]);
}

int kr_flat_is_in(size_t n, const double *corner, const double place[2], double near) {
    int inside = 0;
    for (size_t k = 0; k < n; k++) {
        const double *a = corner + 2 * k, *b = corner + 2 * ((k + 1) % n);
        double turn = kr_flat_turn(a, b, place);
        if (distance(a, b, place) <= near)
            return 1;
        if ((a[1] <= place[1]) != (b[1] <= place[1]))
            inside ^= (turn > 0) == (a[1] <= place[1]);
    }
    return inside;
}

int kr_flat_meets(size_t n, const double *corner, const double p[2], const double q[2]) {
    for (size_t k = 0; k < n; k++)
        if (kr_flat_segments_meet(p, q, corner + 2 * k, corner + 2 * ((k + 1) % n)))
            return 1;
    return kr_flat_is_in(n, corner, p, 0);
}
