/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Exact curves: areas by closed formulas, inside and outside, distances, and what is left when holes
 * cut the outline and each other. Lengths in metres with a spacing of 1 m.
 */
#include "test.h"

#include "polygon.h"
#include "shape.h"

static struct kr_curve curve_of(struct kr_case_hole hole) {
    return kr_curve_of_hole(&hole, 1, 4, "hole_1");
}

static void check_area(struct kr_case_hole hole, double wanted) {
    for (int k = 0; k < 3; k++) { /* wherever it stands and however it is turned */
        hole.centre[0] = 13.7 * k;
        hole.centre[1] = -4.3 * k;
        hole.angle = 0.83 * k;
        struct kr_curve curve = curve_of(hole);
        kr_check_near(kr_curve_area(&curve) / wanted, 1, 4e-15);
        kr_curve_free(&curve);
    }
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void areas_are_those_of_closed_formulas(void **unused) {
    (void)unused;
    double corner[] = {-2, -1, 3, -1, 0.5, 2.5}, turned[] = {0.5, 2.5, 3, -1, -2, -1};
    struct kr_deck_list points = {6, corner, 1}, clockwise = {6, turned, 1};
    check_area((struct kr_case_hole){.radius = 2.385}, M_PI * 2.385 * 2.385);
    check_area((struct kr_case_hole){.shape = KR_HOLE_ELLIPSE, .radii = {3.1, 1.7}},
               M_PI * 3.1 * 1.7);
    check_area((struct kr_case_hole){.shape = KR_HOLE_RECTANGLE, .size = {5.3, 2.9}}, 5.3 * 2.9);
    check_area((struct kr_case_hole){.shape = KR_HOLE_RECTANGLE,
                                     .size = {5.3, 2.9},
                                     .corner_radius = 0.7},
               5.3 * 2.9 - (4 - M_PI) * 0.49);
    check_area((struct kr_case_hole){.shape = KR_HOLE_RECTANGLE, /* round ends meet: no straight */
                                     .size = {5.3, 2.9},
                                     .corner_radius = 1.45},
               5.3 * 2.9 - (4 - M_PI) * 1.45 * 1.45);
    check_area((struct kr_case_hole){.shape = KR_HOLE_SLOT, .length = 6.1, .width = 1.3},
               (6.1 - 1.3) * 1.3 + M_PI * 1.3 * 1.3 / 4);
    check_area((struct kr_case_hole){.shape = KR_HOLE_POLYGON, .points = points}, 5 * 3.5 / 2);
    check_area((struct kr_case_hole){.shape = KR_HOLE_POLYGON, .points = clockwise}, 5 * 3.5 / 2);
}

static void bad_curve(void *argument) {
    curve_of(*(struct kr_case_hole *)argument);
}

static void shapes_that_are_none_stop(void **unused) {
    (void)unused;
    double bow[] = {0, 0, 2, 2, 2, 0, 0, 2.5}, twice[] = {0, 0, 0, 0, 1, 0, 1, 1};
    struct kr_case_hole crossed = {.shape = KR_HOLE_POLYGON, .points = {8, bow, 1}};
    struct kr_case_hole double_corner = {.shape = KR_HOLE_POLYGON, .points = {8, twice, 1}};
    struct kr_case_hole round = {
        .shape = KR_HOLE_RECTANGLE, .size = {2, 1}, .corner_radius = 0.6};
    kr_check_stops(bad_curve, &crossed, 2, "hole_1: its edge meets itself");
    kr_check_stops(bad_curve, &double_corner, 2, "hole_1: two corners in a row");
    kr_check_stops(bad_curve, &round, 2, "a corner radius of 0.6 m does not fit the side of 1 m");
}

static void inside_and_distance_agree_with_formulas(void **unused) {
    (void)unused;
    struct kr_curve circle = curve_of((struct kr_case_hole){{0.3, -0.2}, 2.1});
    struct kr_curve slot = curve_of(
        (struct kr_case_hole){.shape = KR_HOLE_SLOT, .length = 6, .width = 2, .angle = 0.4});
    for (int i = -40; i <= 40; i++)
        for (int j = -40; j <= 40; j++) {
            double p[2] = {0.1037 * i, 0.0983 * j};
            double off = hypot(p[0] - 0.3, p[1] + 0.2) - 2.1, distance = INFINITY;
            kr_check_near(kr_piece_distance(&circle.piece[0], p), fabs(off), 1e-12);
            assert_int_equal(kr_curve_holds(&circle, p), off < 0);
            double x = cos(0.4) * p[0] + sin(0.4) * p[1], y = cos(0.4) * p[1] - sin(0.4) * p[0];
            off = hypot(x - fmin(fmax(x, -2), 2), y) - 1;
            for (size_t k = 0; k < slot.n; k++)
                distance = fmin(distance, kr_piece_distance(&slot.piece[k], p));
            kr_check_near(distance, fabs(off), 1e-12);
            assert_int_equal(kr_curve_holds(&slot, p), off < 0);
        }
    kr_curve_free(&circle);
    kr_curve_free(&slot);
}

/** What is left of a plate of 20 by 10 when holes are cut out. */
static struct kr_shape cut(size_t n, const struct kr_case_hole *hole) {
    struct kr_curve *curve = KR_NEW(struct kr_curve, n + 1);
    struct kr_layer *layer = KR_NEW(struct kr_layer, n + 1);
    for (size_t h = 0; h <= n; h++) {
        curve[h] = h ? kr_curve_of_hole(&hole[h - 1], 1, 3 + (int)h, "a hole")
                     : kr_curve_frame(20, 10);
        layer[h] = (struct kr_layer){{1, &curve[h]}, h > 0};
    }
    struct kr_shape body = kr_shape_cut(n + 1, layer);
    for (size_t h = 0; h <= n; h++)
        kr_curve_free(&curve[h]);
    kr_free(curve);
    kr_free(layer);
    return body;
}

static void check_cut(size_t n, const struct kr_case_hole *hole, double gone, size_t curves) {
    struct kr_shape body = cut(n, hole);
    kr_check_near(kr_shape_area(&body), 200 - gone, 1e-11);
    assert_int_equal(body.n_curves, curves);
    for (size_t c = 0; c < body.n_curves; c++)
        for (size_t k = 0; k < body.curve[c].n; k++) {
            const struct kr_curve *curve = &body.curve[c];
            assert_memory_equal(curve->piece[k].to, curve->piece[(k + 1) % curve->n].from,
                                sizeof curve->piece[k].to);
        }
    kr_shape_free(&body);
    assert_int_equal(kr_memory_outstanding(), 0);
}

/** Area of a disc beyond a line at distance d from its centre. */
static double segment(double r, double d) {
    return r * r * acos(d / r) - d * sqrt(r * r - d * d);
}

static void holes_are_cut_out_of_the_plate(void **unused) {
    (void)unused;
    double r = 1.7, disc = M_PI * r * r, lens = 2 * segment(r, 1.1);
    struct kr_case_hole inside = {{5.3, 4.1}, r}, corner = {{20, 10}, r}, edge = {{7.3, 0.4}, r};
    struct kr_case_hole pair[] = {{{5.3, 4.1}, r}, {{7.5, 4.1}, r}};
    struct kr_case_hole flush = {{10, 9}, .shape = KR_HOLE_RECTANGLE, .size = {3, 2}};
    struct kr_case_hole beside[] = {{{4, 5}, .shape = KR_HOLE_RECTANGLE, .size = {3, 2}},
                                    {{7, 5}, .shape = KR_HOLE_RECTANGLE, .size = {3, 2}}};
    struct kr_case_hole key[] = {{{10, 5}, 1}, {{10, 5}, .shape = KR_HOLE_SLOT, .length = 6,
                                               .width = 1}};
    struct kr_case_hole apart = {{10, 5}, .shape = KR_HOLE_RECTANGLE, .size = {1, 12}};
    check_cut(1, &inside, disc, 2);
    check_cut(1, &corner, disc / 4, 1);
    check_cut(1, &edge, disc - segment(r, 0.4), 1);
    check_cut(2, pair, 2 * disc - lens, 2);
    check_cut(1, &flush, 6, 1);
    check_cut(2, beside, 12, 2);
    check_cut(1, &apart, 10, 2);
    /* A keyhole: a circle of radius 1 and a slot of half width 1/2. */
    double within = 2 * (M_PI / 2 - segment(1, 0.5)); /* of the band |y| < 1/2 in the circle */
    check_cut(2, key, M_PI + 5 * 1 + M_PI / 4 - within, 2);
}

static void polygons_keep_the_area_and_are_even(void **unused) {
    (void)unused;
    struct kr_lattice lattice = {20, 10, 1};
    struct kr_case_hole hole[] = {
        {{5.3, 4.1}, 1.7},
        {{20, 10}, 2.3},
        {{11, 5}, .shape = KR_HOLE_ELLIPSE, .radii = {2.9, 1.3}, .angle = 0.7},
        {{16, 3}, .shape = KR_HOLE_RECTANGLE, .size = {3, 2.2}, .corner_radius = 0.4, .angle = 0.3},
    };
    struct kr_shape body = cut(4, hole);
    struct kr_polygon polygon = kr_polygon_of(&body, &lattice);
    size_t sides[8] = {0};
    kr_check_near(polygon.area / kr_shape_area(&body), 1, 1e-14);
    for (size_t k = 0; k < polygon.n; k++)
        sides[polygon.group[k]]++;
    assert_int_equal(sides[4], 12); /* 2 pi 1.7 = 10.7, in fours */
    assert_int_equal((sides[0] + sides[1] + sides[2] + sides[3] + sides[5]) % 2, 0);
    assert_int_equal(sides[6] % 4, 0);
    assert_int_equal(sides[7] % 2, 0);
    kr_polygon_free(&polygon);
    kr_shape_free(&body);
    assert_int_equal(kr_memory_outstanding(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(areas_are_those_of_closed_formulas),
        cmocka_unit_test(shapes_that_are_none_stop),
        cmocka_unit_test(inside_and_distance_agree_with_formulas),
        cmocka_unit_test(holes_are_cut_out_of_the_plate),
        cmocka_unit_test(polygons_keep_the_area_and_are_even),
    };
    kr_run_tests(tests);
}
