/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The part of a polyhedron inside a sphere against what is known in closed form (caps, octants, the
 * whole sphere) and, for tetrahedra, against slices z = constant: a polygon cut by a circle each.
 */
#include "test.h"

#include "ball.h"
#include "cell.h"
#include "disc.h"
#include "plates.h"
#include "solid.h"

/* A box as a hexahedron. */
static void box(const double low[3], const double high[3], double point[24]) {
    static const int up[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                 {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    for (size_t k = 0; k < 24; k++)
        point[k] = up[k / 3][k % 3] ? high[k % 3] : low[k % 3];
}

static void check_box(const double low[3], const double high[3], double radius, double volume,
                      const double moment[3]) {
    double point[24];
    box(low, high, point);
    struct kr_ball_part part = kr_ball_solid(8, point, radius);
    kr_check_near(part.volume, volume, 1e-13);
    for (int d = 0; d < 3; d++)
        kr_check_near(part.moment[d], moment[d], 1e-13);
}

static void test_ball_known_parts(void **state) {
    const double r = 1.23, h = 0.47, none[3] = {0};
    const double cap = M_PI * (r - h) * (r - h) * (2 * r + h) / 3;
    const double lever = M_PI / 4 * pow(r * r - h * h, 2); /* of a cap about the centre */
    const double octant = M_PI / 6 * r * r * r, arm = M_PI / 16 * pow(r, 4);
    (void)state;
    check_box((double[]){-2, -3, -1.5}, (double[]){1.7, 1.9, 2.1}, r, 8 * octant, none);
    check_box((double[]){-0.3, -0.2, -0.1}, (double[]){0.4, 0.5, 0.6}, r, 0.7 * 0.7 * 0.7,
              (double[]){0.343 * 0.05, 0.343 * 0.15, 0.343 * 0.25});
    check_box((double[]){1.3, 0, 0}, (double[]){2, 1, 1}, r, 0, none);
    check_box((double[]){r, -1, -1}, (double[]){2, 1, 1}, r, 0, none); /* touches */
    check_box((double[]){h, -2, -2}, (double[]){2, 2, 2}, r, cap, (double[]){lever, 0, 0});
    check_box((double[]){-2, -2, -2}, (double[]){2, -h, 2}, r, cap, (double[]){0, -lever, 0});
    check_box((double[]){0, 0, 0}, (double[]){2, 2, 2}, r, octant, (double[]){arm, arm, arm});
    check_box((double[]){-2, 0, -3}, (double[]){0, 2, 0}, r, octant, (double[]){-arm, arm, -arm});
    check_box((double[]){-2, -2, 0}, (double[]){2, 2, 2}, r, 4 * octant, (double[]){0, 0, 4 * arm});
}

/* ---- tetrahedra ---- */

static double angle_about(const double *p, const double *middle) {
    return atan2(p[1] - middle[1], p[0] - middle[0]);
}

/* The section of a tetrahedron at z: up to four corners, counter-clockwise. */
static size_t section(const double *point, double z, double *corner) {
    size_t n = 0;
    double middle[2] = {0};
    for (size_t a = 0; a < 4; a++)
        for (size_t b = a + 1; b < 4; b++) {
            const double *p = point + 3 * a, *q = point + 3 * b;
            if ((p[2] < z) == (q[2] < z))
                continue;
            for (size_t d = 0; d < 2; d++)
                corner[2 * n + d] = p[d] + (z - p[2]) / (q[2] - p[2]) * (q[d] - p[d]);
            n++;
        }
    for (size_t k = 0; k < 2 * n; k++)
        middle[k % 2] += corner[k] / (double)n;
    for (size_t k = 1; k < n; k++)
        for (size_t m = k; m > 0 && angle_about(corner + 2 * m, middle) <
                                        angle_about(corner + 2 * m - 2, middle); m--)
            for (size_t d = 0; d < 2; d++) {
                double other = corner[2 * m + d];
                corner[2 * m + d] = corner[2 * m - 2 + d];
                corner[2 * m - 2 + d] = other;
            }
    return n;
}

static struct kr_ball_part by_slices(const double *point, double radius) {
    enum { SLICES = 4000 };
    struct kr_ball_part sum = {0};
    double low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < 4; k++) {
        low = fmin(low, point[3 * k + 2]);
        high = fmax(high, point[3 * k + 2]);
    }
    for (int k = 0; k < SLICES; k++) {
        double step = (high - low) / SLICES, z = low + (k + 0.5) * step, corner[8];
        size_t n = section(point, z, corner);
        if (n < 3 || fabs(z) >= radius)
            continue;
        struct kr_disc_part part = kr_disc_polygon(n, corner, sqrt(radius * radius - z * z));
        sum.volume += part.area * step;
        sum.moment[0] += part.moment[0] * step;
        sum.moment[1] += part.moment[1] * step;
        sum.moment[2] += part.area * z * step;
    }
    return sum;
}

static double worst_of(struct kr_ball_part a, struct kr_ball_part b) {
    double worst = fabs(a.volume - b.volume);
    for (int d = 0; d < 3; d++)
        worst = fmax(worst, fabs(a.moment[d] - b.moment[d]));
    return worst;
}

/* Slices err by (1/4000)^1.5 and less, where the section grows like a root: 4e-6, and mostly by the
 * square. Corners within 1 of a
 * place up to 1.5 away from the centre: parts of all kinds. */
static void test_ball_against_slices(void **state) {
    uint64_t seed = 7;
    double worst = 0;
    int cut = 0;
    (void)state;
    for (int round = 0; round < 300; round++) {
        double point[12], middle[3], centroid[3];
        for (int d = 0; d < 3; d++)
            middle[d] = kr_random(&seed, -1.5, 1.5);
        for (size_t k = 0; k < 12; k++)
            point[k] = middle[k % 3] + kr_random(&seed, -1, 1);
        double volume = kr_cell_solid(4, point, centroid);
        if (volume < 0)
            for (size_t d = 0; d < 3; d++) {
                double other = point[d];
                point[d] = point[3 + d];
                point[3 + d] = other;
            }
        struct kr_ball_part part = kr_ball_solid(4, point, 1);
        cut += part.volume > 1e-3 && part.volume < fabs(volume) * 0.999;
        worst = fmax(worst, worst_of(part, by_slices(point, 1)));
    }
    kr_figure("300 tetrahedra, %d of them cut: off the slices by %.1e", cut, worst);
    assert_true(cut > 100);
    kr_check_near(worst, 0, 4e-6);
}

/* ---- bent faces ---- */

/* A hexahedron moved at random, of 8 or 20 vertices. */
static void bent(size_t n, uint64_t *seed, double *point) {
    const struct kr_solid *solid = kr_solid(n);
    box((double[]){-0.1, 0.2, 0.3}, (double[]){0.9, 1.1, 1.0}, point);
    for (size_t k = 0; k < 24; k++)
        point[k] += kr_random(seed, -0.15, 0.15);
    for (size_t e = 0; n > 8 && e < solid->n_edges; e++)
        for (size_t d = 0; d < 3; d++)
            point[3 * (8 + e) + d] =
                0.5 * (point[3 * solid->edge[e][0] + d] + point[3 * solid->edge[e][1] + d]) +
                kr_random(seed, -0.05, 0.05);
}

/* The signed tetrahedra between the triangles of its faces and a place within. */
static struct kr_ball_part by_tetrahedra(size_t n, const double *point, double radius) {
    struct kr_ball_part sum = {0};
    const double apex[3] = {0.4, 0.6, 0.7};
    for (size_t f = 0; f < kr_solid(n)->n_faces; f++) {
        size_t number[20], vertex[KR_MOST_FACE];
        double face[3 * KR_MOST_FACE], tetrahedron[12];
        for (size_t k = 0; k < n; k++)
            number[k] = k;
        size_t corners = kr_solid_face(n, number, f, vertex);
        for (size_t k = 0; k < 3 * corners; k++)
            face[k] = point[3 * vertex[k / 3] + k % 3];
        for (size_t k = 0; k < corners; k++) {
            kr_solid_middle(corners, face, tetrahedron);
            memcpy(tetrahedron + 3, face + 3 * ((k + 1) % corners), 3 * sizeof *face);
            memcpy(tetrahedron + 6, face + 3 * k, 3 * sizeof *face);
            memcpy(tetrahedron + 9, apex, sizeof apex);
            struct kr_ball_part part = kr_ball_solid(4, tetrahedron, radius);
            sum.volume += part.volume;
            for (int d = 0; d < 3; d++)
                sum.moment[d] += part.moment[d];
        }
    }
    return sum;
}

static void test_ball_of_bent_cells(void **state) {
    uint64_t seed = 11;
    double worst = 0;
    (void)state;
    for (int round = 0; round < 100; round++) {
        double point[60], centroid[3], radius = kr_random(&seed, 0.4, 2.5);
        size_t n = round % 2 ? 8 : 20;
        bent(n, &seed, point);
        struct kr_ball_part part = kr_ball_solid(n, point, radius);
        double volume = kr_cell_solid(n, point, centroid);
        worst = fmax(worst, worst_of(part, by_tetrahedra(n, point, radius)));
        assert_true(part.volume > -1e-12 && part.volume < volume * (1 + 1e-12));
        if (radius > 2.2)
            kr_check_near(part.volume, volume, 1e-13);
    }
    kr_figure("100 bent hexahedra: off their tetrahedra by %.1e", worst);
    kr_check_near(worst, 0, 1e-12); /* some 100 terms of up to radius^3 each */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ball_known_parts),
        cmocka_unit_test(test_ball_against_slices),
        cmocka_unit_test(test_ball_of_bent_cells),
    };
    kr_run_tests(tests);
}
