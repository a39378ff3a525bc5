/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The part of a polygon inside a circle against an independent integration: slices x = constant,
 * cut with polygon and circle, summed by Gauss's rule between all places where the slice's length
 * has a kink.
 */
#include "test.h"

#include "cell.h"
#include "disc.h"
#include "plates.h"

enum { CORNERS = 9, MOST_KINKS = 64, POINTS = 40 };

static int by_value(const void *p, const void *q) {
    double a = *(const double *)p, b = *(const double *)q;
    return (a > b) - (a < b);
}

/* Area and moments of one slice of a simple polygon inside the circle. */
static void slice(size_t n, const double *point, double r, double x, double out[3]) {
    double y[CORNERS + 1], half = sqrt(fmax(r * r - x * x, 0));
    size_t count = 0;
    for (size_t k = 0; k < n; k++) {
        const double *p = point + 2 * k, *q = point + 2 * ((k + 1) % n);
        if ((p[0] <= x) != (q[0] <= x))
            y[count++] = p[1] + (x - p[0]) / (q[0] - p[0]) * (q[1] - p[1]);
    }
    qsort(y, count, sizeof *y, by_value);
    out[0] = out[1] = out[2] = 0;
    for (size_t k = 0; k + 1 < count; k += 2) {
        double low = fmax(y[k], -half), high = fmin(y[k + 1], half);
        if (low >= high)
            continue;
        out[0] += high - low;
        out[1] += x * (high - low);
        out[2] += 0.5 * (high * high - low * low);
    }
}

/* Nodes and weights of Gauss's rule on -1 .. 1: Newton's iteration on Legendre's polynomial. */
static void gauss(double *node, double *weight) {
    for (int k = 0; k < POINTS; k++) {
        double x = cos(M_PI * (k + 0.75) / (POINTS + 0.5)), slope = 1;
        for (int round = 0; round < 50; round++) {
            double before = 1, now = x;
            for (int n = 2; n <= POINTS; n++) {
                double next = ((2 * n - 1) * x * now - (n - 1) * before) / n;
                before = now;
                now = next;
            }
            slope = POINTS * (x * now - before) / (x * x - 1);
            x -= now / slope;
        }
        node[k] = x;
        weight[k] = 2 / ((1 - x * x) * slope * slope);
    }
}

/* x of all corners, of where edges meet the circle, and of the circle's ends. */
static size_t kinks_of(size_t n, const double *point, double r, double *kink) {
    size_t count = 0;
    kink[count++] = -r;
    kink[count++] = r;
    for (size_t k = 0; k < n; k++) {
        const double *p = point + 2 * k, *q = point + 2 * ((k + 1) % n);
        double dx = q[0] - p[0], dy = q[1] - p[1], a = dx * dx + dy * dy;
        double b = p[0] * dx + p[1] * dy, c = p[0] * p[0] + p[1] * p[1] - r * r;
        kink[count++] = fmin(fmax(p[0], -r), r);
        for (int sign = -1; sign <= 1 && b * b > a * c; sign += 2)
            kink[count++] = fmin(fmax(p[0] + (-b + sign * sqrt(b * b - a * c)) / a * dx, -r), r);
    }
    qsort(kink, count, sizeof *kink, by_value);
    return count;
}

/* Between kinks with x = r sin(angle), in which the circle's chord is smooth. */
static struct kr_disc_part integrate(size_t n, const double *point, double r) {
    double kink[MOST_KINKS], node[POINTS], weight[POINTS], at[3];
    size_t count = kinks_of(n, point, r, kink);
    struct kr_disc_part sum = {0};
    gauss(node, weight);
    for (size_t k = 0; k + 1 < count; k++) {
        double low = asin(kink[k] / r), high = asin(kink[k + 1] / r);
        for (int g = 0; g < POINTS; g++) {
            double angle = 0.5 * (low + high) + 0.5 * (high - low) * node[g];
            double width = 0.5 * (high - low) * weight[g] * r * cos(angle);
            slice(n, point, r, r * sin(angle), at);
            sum.area += width * at[0];
            sum.moment[0] += width * at[1];
            sum.moment[1] += width * at[2];
        }
    }
    return sum;
}

/* A star about some place, with corners at random distances: seldom convex. Size about 1. */
static void random_polygon(uint64_t *seed, size_t n, double *point) {
    double x = kr_random(seed, -3, 3), y = kr_random(seed, -3, 3);
    for (size_t k = 0; k < n; k++) {
        double angle = 2 * M_PI * ((double)k + kr_random(seed, 0.1, 0.9)) / (double)n;
        double distance = kr_random(seed, 0.15, 1);
        point[2 * k] = x + distance * cos(angle);
        point[2 * k + 1] = y + distance * sin(angle);
    }
}

/* Polygons of size 1 and circles up to 4 times as large: 1e-13 is some 100 roundings. */
static void test_random_polygons(void **state) {
    uint64_t seed = 20;
    double point[2 * CORNERS], worst = 0;
    int cut = 0;
    (void)state;
    for (int round = 0; round < 4000; round++) {
        size_t n = 3 + (size_t)round % (CORNERS - 2);
        double r = kr_random(&seed, 0.3, 4), centroid[2];
        random_polygon(&seed, n, point);
        struct kr_disc_part got = kr_disc_polygon(n, point, r), wanted = integrate(n, point, r);
        cut += wanted.area > 0.01 && wanted.area < 0.99 * kr_cell_polygon(n, point, centroid);
        worst = fmax(worst, fabs(got.area - wanted.area));
        kr_check_near(got.area, wanted.area, 1e-13);
        for (int d = 0; d < 2; d++)
            kr_check_near(got.moment[d], wanted.moment[d], 4e-13); /* lever arms up to 4 */
    }
    kr_figure("areas off by %.1e at most; %d of 4000 polygons cut by the circle", worst, cut);
    assert_true(cut > 1000);
}

/* Where answers are known: inside, outside, around, touching, a corner at the centre. */
static void test_known_parts(void **state) {
    const double away[2] = {3, 0}, zero[2] = {0, 0}, corner[2] = {0.5, 0.5};
    (void)state;
    kr_check_near(kr_disc_square(zero, 1, 2).area, 1, 1e-15);
    kr_check_near(kr_disc_square(away, 1, 2).area, 0, 1e-15);
    kr_check_near(kr_disc_square(zero, 8, 2).area, 4 * M_PI, 1e-14);
    kr_check_near(kr_disc_square(corner, 1, 0.5).area, M_PI / 16, 1e-15);
    kr_check_near(kr_disc_square(corner, 1, 1).area, M_PI / 4, 1e-15);
    kr_check_near(kr_disc_square(corner, 1, 1).moment[0], 1.0 / 3, 1e-15);
    kr_check_near(kr_disc_square(away, 2, 2).area, 0, 1e-15);    /* touches from outside */
    kr_check_near(kr_disc_square(zero, 2, 1).area, M_PI, 1e-14); /* and from inside */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_polygons),
        cmocka_unit_test(test_known_parts),
    };
    kr_run_tests(tests);
}
