/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Sphere and polyhedron. The figure inside the sphere is bounded by what of the faces is inside,
 * and by a piece of the sphere. With the divergence theorem for x and for r^2/2:
 *
 *    V = 1/3 sum over faces of h A  +  R^3/3 Omega         M = 1/2 sum over faces of n (S - rho^2 A)
 *
 *    n, h   outward normal of the face and the distance of its plane along n
 *    A, S   of the face's part inside the circle that the sphere cuts out of its plane, with
 *           rho^2 = R^2 - h^2: its area, and the integral over it of the squared distance from the
 *           foot of the centre on the plane
 *    Omega  solid angle of the piece of the sphere. Seen from the centre it is what the faces hide
 *           outside of their circles
 *
 * M has no term of the sphere, for there r^2 = R^2, and n integrated over a closed surface is 0. Edge
 * by edge, as in disc.c: an edge p -> q spans with the foot, where it runs inside the circle, a
 * triangle, and where outside, a sector of the circle and beyond it the rest of the triangle:
 *
 *    triangle  A = (p x q)/2         S = A (p^2 + p.q + q^2)/6
 *    sector    A = rho^2 theta/2     S = rho^4 theta/4          Omega = omega - theta (1 - h/R)
 *    tan(omega/2) = (p x q)/(|p| |q| + h (|p| + |q|) + h^2 + p.q)
 *
 *    theta  angle from p to q at the foot        p, q  in the plane, from the foot; |p| from the centre
 *    omega  solid angle of the triangle foot, p, q (van Oosterom and Strackee, IEEE Trans. Biomed.
 *           Eng. 30, 1983, with the foot as one corner)
 */
#include "ball.h"

#include "solid.h"

#include <math.h>
#include <string.h>

/* One face, in its plane. */
struct face {
    double high, radius; /* |h|, R */
    double square;       /* rho^2; negative where the plane misses the sphere */
    double area, second; /* A, S */
    /* Sums of angles as products of complex numbers, so that a face takes two arctangents. The sum of
     * all omega/2 stays within -pi .. pi; that of all theta may go round once: half turns count. */
    double omega[2], theta[2];
    int turns;
};

static void multiply(double z[2], double real, double imaginary) {
    double before = z[0];
    z[0] = before * real - z[1] * imaginary;
    z[1] = before * imaginary + z[1] * real;
}

static double cross(const double p[2], const double q[2]) {
    return p[0] * q[1] - p[1] * q[0];
}

static double dot(const double p[2], const double q[2]) {
    return p[0] * q[0] + p[1] * q[1];
}

static void add_triangle(struct face *f, const double p[2], const double q[2]) {
    double area = 0.5 * cross(p, q);
    f->area += area;
    f->second += area * (dot(p, p) + dot(p, q) + dot(q, q)) / 6;
}

static void add_sector(struct face *f, const double p[2], const double q[2]) {
    double turn = cross(p, q), along = dot(p, q), h = f->high;
    double to_p = sqrt(dot(p, p) + h * h), to_q = sqrt(dot(q, q) + h * h);
    multiply(f->omega, to_p * to_q + h * (to_p + to_q) + h * h + along, turn);
    if (f->square <= 0)
        return;
    int was_left = f->theta[1] >= 0;
    multiply(f->theta, along, turn);
    if (was_left != (f->theta[1] >= 0) && was_left == (turn > 0))
        f->turns += turn > 0 ? 1 : -1;
}

/* What the sectors add to the face's part; returns Omega. */
static double close_sectors(struct face *f) {
    double theta = atan2(f->theta[1], f->theta[0]) + 2 * M_PI * f->turns;
    double omega = 2 * atan2(f->omega[1], f->omega[0]);
    if (f->square <= 0)
        return omega;
    f->area += 0.5 * f->square * theta;
    f->second += 0.25 * f->square * f->square * theta;
    return omega - theta * (1 - f->high / f->radius);
}

/* Where the line p + t (q - p) is inside the circle: between t[0] and t[1], cut to 0 .. 1. Returns
 * 0 if nowhere. The roots of a t^2 + 2 b t + c = 0 without cancellation. */
static int inside(const struct face *f, const double p[2], const double q[2], double t[2]) {
    double along[2] = {q[0] - p[0], q[1] - p[1]};
    double a = dot(along, along), b = dot(p, along), c = dot(p, p) - f->square;
    double turn = cross(p, q), root = a * f->square - turn * turn; /* = b^2 - a c */
    if (f->square <= 0 || a == 0 || root <= 0)
        return 0;
    root = sqrt(root);
    double far = b > 0 ? -b - root : -b + root;
    t[0] = fmax(b > 0 ? far / a : c / far, 0);
    t[1] = fmin(b > 0 ? c / far : far / a, 1);
    return t[0] < t[1];
}

static void add_edge(struct face *f, const double p[2], const double q[2]) {
    double t[2], enter[2], leave[2];
    if (fmax(dot(p, p), dot(q, q)) <= f->square) {
        add_triangle(f, p, q);
        return;
    }
    if (!inside(f, p, q, t)) {
        add_sector(f, p, q);
        return;
    }
    for (int d = 0; d < 2; d++) {
        enter[d] = t[0] > 0 ? p[d] + t[0] * (q[d] - p[d]) : p[d];
        leave[d] = t[1] < 1 ? p[d] + t[1] * (q[d] - p[d]) : q[d];
    }
    if (t[0] > 0)
        add_sector(f, p, enter);
    add_triangle(f, enter, leave);
    if (t[1] < 1)
        add_sector(f, leave, q);
}

/* Twice the area of a flat polygon times its normal. */
static void normal_of(size_t n, const double *point, double normal[3]) {
    normal[0] = normal[1] = normal[2] = 0;
    for (size_t k = 1; k + 1 < n; k++) {
        double a[3], b[3];
        for (size_t d = 0; d < 3; d++) {
            a[d] = point[3 * k + d] - point[d];
            b[d] = point[3 * k + 3 + d] - point[d];
        }
        for (int d = 0; d < 3; d++)
            normal[d] += a[(d + 1) % 3] * b[(d + 2) % 3] - a[(d + 2) % 3] * b[(d + 1) % 3];
    }
}

/* Two directions in the plane, right-handed with the unit normal. */
static void axes_of(const double normal[3], double u[3], double v[3]) {
    int least = fabs(normal[0]) < fabs(normal[1]) ? 0 : 1;
    if (fabs(normal[2]) < fabs(normal[least]))
        least = 2;
    double length = sqrt(1 - normal[least] * normal[least]);
    int next = (least + 1) % 3, last = (least + 2) % 3;
    u[least] = 0;
    u[next] = -normal[last] / length;
    u[last] = normal[next] / length;
    for (int d = 0; d < 3; d++)
        v[d] = normal[(d + 1) % 3] * u[(d + 2) % 3] - normal[(d + 2) % 3] * u[(d + 1) % 3];
}

static double dot3(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void kr_ball_add_face(size_t n, const double *point, double radius, struct kr_ball_part *sum) {
    double normal[3], u[3], v[3];
    normal_of(n, point, normal);
    double length = sqrt(dot3(normal, normal));
    if (!(length > 0))
        return;
    for (int d = 0; d < 3; d++)
        normal[d] /= length;
    double high = dot3(normal, point);
    struct face f = {.high = fabs(high), .radius = radius, .omega = {1}, .theta = {1},
                     .square = radius * radius - high * high};
    axes_of(normal, u, v);
    const double first[2] = {dot3(u, point), dot3(v, point)};
    double from[2] = {first[0], first[1]};
    for (size_t k = 1; k <= n; k++) {
        double to[2] = {first[0], first[1]};
        if (k < n) {
            to[0] = dot3(u, point + 3 * k);
            to[1] = dot3(v, point + 3 * k);
        }
        add_edge(&f, from, to);
        memcpy(from, to, sizeof from);
    }
    double angle = close_sectors(&f);
    sum->volume += (high * f.area + copysign(radius * radius * radius, high) * angle) / 3;
    for (int d = 0; d < 3; d++)
        sum->moment[d] += 0.5 * normal[d] * (f.second - f.square * f.area);
}

/* Four corners lie in one plane if the fourth is no farther from that of the others than rounding
 * puts it. */
static int is_flat(size_t n, const double *point) {
    double normal[3], off[3], size = 0;
    if (n != 4)
        return n == 3;
    normal_of(3, point, normal);
    for (int d = 0; d < 3; d++) {
        off[d] = point[9 + d] - point[d];
        size = fmax(size, fabs(off[d]));
    }
    return fabs(dot3(off, normal)) <= 1e-12 * size * sqrt(dot3(normal, normal));
}

static void add_fan(size_t n, const double *point, double radius, struct kr_ball_part *sum) {
    double triangle[9];
    kr_solid_middle(n, point, triangle);
    for (size_t k = 0; k < n; k++) {
        memcpy(triangle + 3, point + 3 * k, 3 * sizeof *triangle);
        memcpy(triangle + 6, point + 3 * (k + 1 < n ? k + 1 : 0), 3 * sizeof *triangle);
        kr_ball_add_face(3, triangle, radius, sum);
    }
}

/* The tetrahedra of a polyhedron. */
static void add_pieces(size_t n, const double *point, double radius, struct kr_ball_part *sum) {
    for (size_t k = 0; k < n; k += 4) {
        struct kr_ball_part part = kr_ball_solid(4, point + 3 * k, radius);
        sum->volume += part.volume;
        for (int d = 0; d < 3; d++)
            sum->moment[d] += part.moment[d];
    }
}

struct kr_ball_part kr_ball_solid(size_t n, const double *point, double radius) {
    const struct kr_solid *solid = kr_solid(n);
    struct kr_ball_part sum = {0};
    size_t number[KR_MOST_SOLID], vertex[KR_MOST_FACE];
    double face[3 * KR_MOST_FACE];
    if (kr_solid_is_pieces(n)) {
        add_pieces(n, point, radius, &sum);
        return sum;
    }
    for (size_t k = 0; k < n; k++)
        number[k] = k;
    for (size_t f = 0; f < solid->n_faces; f++) {
        size_t corners = kr_solid_face(n, number, f, vertex);
        for (size_t k = 0; k < corners; k++)
            memcpy(face + 3 * k, point + 3 * vertex[k], 3 * sizeof *face);
        if (is_flat(corners, face))
            kr_ball_add_face(corners, face, radius, &sum);
        else
            add_fan(corners, face, radius, &sum);
    }
    return sum;
}

struct kr_ball_part kr_ball_cube(const double centre[3], double side, double radius) {
    static const signed char corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                             {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    double point[24];
    for (size_t k = 0; k < 24; k++)
        point[k] = centre[k % 3] + 0.5 * side * corner[k / 3][k % 3];
    return kr_ball_solid(8, point, radius);
}
