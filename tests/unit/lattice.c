/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The lattice that fits a plate, boxes marked on it, and the perimeters of what is marked.
 */
#include "test.h"

#include "boxes.h"
#include "lattice.h"
#include "region.h"

static void decimals_fit(void **unused) {
    (void)unused;
    struct kr_lattice lattice = kr_lattice_fit(50e-3, 25e-3, 0.04e-3);
    assert_int_equal(lattice.columns, 1250);
    assert_int_equal(lattice.rows, 625);
    lattice = kr_lattice_fit(0.3, 0.1, 0.1); /* 0.3 / 0.1 is not 3 in binary */
    assert_int_equal(lattice.columns, 3);
    assert_int_equal(lattice.rows, 1);
}

static void misfit(void *unused) {
    (void)unused;
    kr_lattice_fit(50e-3, 25e-3, 0.043e-3);
}

static void slight_misfit(void *unused) {
    (void)unused;
    kr_lattice_fit(50e-3, 25e-3 * (1 + 3e-9), 0.05e-3);
}

static void too_coarse(void *unused) {
    (void)unused;
    kr_lattice_fit(1, 1, 2.5);
}

static void a_misfit_stops_and_names_the_nearest(void **unused) {
    (void)unused;
    /* 50/0.043 = 1162.8 and 25/0.043 = 581.4: only even numbers of columns fit both sides. */
    kr_check_stops(misfit, NULL, 2, "the nearest that fit are 0.0429553264605 mm and 0.0430292598967 mm; or keep it with "
                   "geometry.width: 50.009 mm and geometry.height: 24.983 mm");
    assert_int_equal(kr_lattice_fit(50e-3, 25e-3, 0.0429553264605e-3).columns, 1164);
    assert_int_equal(kr_lattice_fit(50e-3, 25e-3, 0.0430292598967e-3).rows, 581);
    assert_int_equal(kr_lattice_fit(50.009e-3, 24.983e-3, 0.043e-3).rows, 581);
    kr_check_stops(slight_misfit, NULL, 2, "cannot be cut into whole squares");
    kr_check_stops(too_coarse, NULL, 2, "the nearest that fits is");
}

/** A lattice, what is marked of it, and the regions of a plate without holes. */
struct marks {
    struct kr_lattice lattice;
    unsigned char *marked;
    struct kr_regions regions;
};

static size_t count_marked(const struct marks *m) {
    size_t n = 0;
    for (size_t c = 0; c < m->lattice.columns * m->lattice.rows; c++)
        n += m->marked[c];
    return n;
}

/** Check that every perimeter is a closed walk of lattice steps with the region on its left, and
 *  that the perimeters together bound just the marked cells. */
static void check_perimeters(const struct marks *m) {
    long twice_area = 0, wide = (long)m->lattice.columns + 1;
    for (size_t r = 0; r < m->regions.count; r++)
        for (size_t l = 0; l < m->regions.region[r].n_loops; l++) {
            const struct kr_region_loop *loop = &m->regions.region[r].loop[l];
            long loop_area = 0;
            for (size_t k = 0; k < loop->n; k++) {
                long a = (long)loop->point[k], b = (long)loop->point[(k + 1) % loop->n];
                assert_int_equal(labs(b % wide - a % wide) + labs(b / wide - a / wide), 1);
                loop_area += (a % wide) * (b / wide) - (b % wide) * (a / wide);
            }
            assert_int_equal(loop->n % 2, 0); /* quadrilaterals can fill it */
            assert_true(l == 0 ? loop_area > 0 : loop_area < 0);
            kr_check_near(2 * loop->area, loop_area, 0);
            twice_area += loop_area;
        }
    assert_int_equal(twice_area, 2 * count_marked(m));
}

/** No two marked cells meet at a corner only. */
static void check_corners(const struct marks *m) {
    for (size_t j = 1; j < m->lattice.rows; j++)
        for (size_t i = 1; i < m->lattice.columns; i++) {
            const unsigned char *below = m->marked + kr_lattice_cell(&m->lattice, i - 1, j - 1);
            const unsigned char *above = below + m->lattice.columns;
            assert_false(below[0] == above[1] && below[1] == above[0] && below[0] != below[1]);
        }
}

static struct marks marks_of(const struct kr_lattice *lattice, size_t n,
                             const struct kr_case_hole *hole, double padding) {
    size_t cells = lattice->columns * lattice->rows;
    struct marks m = {.lattice = *lattice, .marked = KR_NEW(unsigned char, cells)};
    struct kr_curve frame = kr_curve_frame((double)lattice->columns, (double)lattice->rows);
    struct kr_polygon polygon = kr_polygon_of(&(struct kr_shape){1, &frame}, lattice);
    int32_t *holder = KR_NEW(int32_t, cells);
    for (size_t h = 0; h < n; h++) {
        double box[1][4];
        for (int d = 0; d < 4; d++)
            box[0][d] =
                (hole[h].centre[d % 2] + (d < 2 ? -hole[h].radius : hole[h].radius)) /
                lattice->spacing;
        kr_boxes_mark(lattice, 1, (const double(*)[4])box, padding / lattice->spacing, m.marked);
    }
    kr_boxes_join_corners(lattice, m.marked);
    m.regions = kr_regions_of(lattice, &polygon, holder, m.marked);
    kr_free(holder);
    kr_curve_free(&frame);
    kr_polygon_free(&polygon);
    check_perimeters(&m);
    check_corners(&m);
    return m;
}

static void free_marks(struct marks *m) {
    kr_free(m->marked);
    kr_regions_free(&m->regions);
}

static void a_box_is_snapped_outward(void **unused) {
    (void)unused;
    struct kr_lattice lattice = {20, 16, 0.1};
    struct kr_case_hole hole = {{0.93, 0.8}, 0.2}; /* 0.93 - 0.4 = 5.3, 13.3; 4 and 12 exactly */
    struct marks m = marks_of(&lattice, 1, &hole, 0.2);
    assert_int_equal(m.regions.count, 1);
    assert_int_equal(count_marked(&m), 9 * 8);
    assert_int_equal(m.regions.region[0].loop[0].point[0], 4 * 21 + 5);
    assert_int_equal(m.regions.region[0].loop[0].n, 2 * (9 + 8));
    free_marks(&m);
    assert_int_equal(kr_memory_outstanding(), 0);
}

/** Boxes that end on lattice lines in decimals; in binary some end a rounding above or below, and
 *  none may grow by a cell for it. */
static void decimals_are_not_snapped_to_the_next_line(void **unused) {
    (void)unused;
    static const double step[][2] = {{1, 10}, {1, 1e4}, {4, 1e5}, {3, 1e5}, {7, 1e3}};
    for (size_t k = 0; k < sizeof step / sizeof *step; k++)
        for (int i = 5; i < 36; i++) {
            double one = step[k][0], of = step[k][1];
            struct kr_lattice lattice = {40, 40, one / of};
            struct kr_case_hole hole = {{i * one / of, (41 - i) * one / of}, 2 * one / of};
            struct marks m = marks_of(&lattice, 1, &hole, 2 * one / of);
            assert_int_equal(count_marked(&m), 64);
            free_marks(&m);
        }
}

static void a_box_ends_at_the_plate(void **unused) {
    (void)unused;
    struct kr_lattice lattice = {20, 16, 0.1};
    struct kr_case_hole hole = {{0.25, 1.4}, 0.15};
    struct marks m = marks_of(&lattice, 1, &hole, 0.25);
    assert_int_equal(count_marked(&m), 7 * 6);
    free_marks(&m);
}

static void boxes_that_overlap_or_touch_are_one(void **unused) {
    (void)unused;
    struct kr_lattice lattice = {40, 20, 0.1};
    struct kr_case_hole overlap[] = {{{1, 1}, 0.3}, {{1.7, 1.1}, 0.3}};
    struct kr_case_hole touch[] = {{{1, 1}, 0.3}, {{2, 1}, 0.3}};
    struct kr_case_hole apart[] = {{{1, 1}, 0.3}, {{2.1, 1}, 0.3}};
    struct marks m = marks_of(&lattice, 2, overlap, 0.2);
    assert_int_equal(m.regions.count, 1);
    assert_int_equal(count_marked(&m), 100 + 100 - 3 * 9);
    free_marks(&m);
    m = marks_of(&lattice, 2, touch, 0.2);
    assert_int_equal(m.regions.count, 1);
    assert_int_equal(m.regions.region[0].loop[0].n, 2 * (20 + 10));
    free_marks(&m);
    m = marks_of(&lattice, 2, apart, 0.2);
    assert_int_equal(m.regions.count, 2);
    free_marks(&m);
}

static void corner_contacts_are_repaired(void **unused) {
    (void)unused;
    struct kr_lattice lattice = {40, 40, 0.1};
    struct kr_case_hole rising[] = {{{1, 1}, 0.3}, {{2, 2}, 0.3}};
    struct kr_case_hole falling[] = {{{1, 2}, 0.3}, {{2, 1}, 0.3}};
    for (int k = 0; k < 2; k++) {
        struct marks m = marks_of(&lattice, 2, k ? falling : rising, 0.2);
        assert_int_equal(m.regions.count, 1);
        assert_int_equal(count_marked(&m), 2 * 100 + 1);
        free_marks(&m);
    }
}

/** The cell that joins two boxes touches a third one's corner, in a row that was passed before. */
static void a_repair_that_makes_a_contact_is_repaired(void **unused) {
    (void)unused;
    struct kr_lattice lattice = {40, 40, 0.1};
    struct kr_case_hole hole[] = {{{1.5, 1.5}, 0.3}, {{2.5, 2.5}, 0.3}, {{2.6, 1.4}, 0.3}};
    struct marks m = marks_of(&lattice, 3, hole, 0.2);
    assert_int_equal(m.regions.count, 1);
    assert_int_equal(count_marked(&m), 3 * 100 + 2);
    free_marks(&m);
}

static void a_ring_of_boxes_has_an_inner_perimeter(void **unused) {
    (void)unused;
    struct kr_lattice lattice = {60, 60, 0.1};
    struct kr_case_hole hole[8];
    size_t n = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (i != 1 || j != 1)
                hole[n++] = (struct kr_case_hole){{1.5 + 1.0 * i, 1.5 + 1.0 * j}, 0.35};
    struct marks m = marks_of(&lattice, 8, hole, 0.05);
    assert_int_equal(m.regions.count, 8); /* two cells stay between neighbours */
    free_marks(&m);
    m = marks_of(&lattice, 8, hole, 0.1); /* snapped, they touch */
    assert_int_equal(m.regions.count, 1);
    assert_int_equal(m.regions.region[0].n_loops, 2);
    assert_int_equal(count_marked(&m), 800);
    free_marks(&m);
}

static void many_random_boxes_have_sound_perimeters(void **unused) {
    (void)unused;
    struct kr_lattice lattice = {150, 110, 0.1};
    uint64_t state = 5;
    for (int trial = 0; trial < 200; trial++) {
        struct kr_case_hole hole[40];
        for (size_t h = 0; h < 40; h++) {
            double draw[3];
            for (int d = 0; d < 3; d++) {
                state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
                draw[d] = (double)(state >> 11) / 9007199254740992.0;
            }
            hole[h] = (struct kr_case_hole){{0.1 + 14.8 * draw[0], 0.1 + 10.8 * draw[1]},
                                            0.05 + 0.3 * draw[2]};
        }
        struct marks m = marks_of(&lattice, 40, hole, 0.31);
        free_marks(&m);
    }
    assert_int_equal(kr_memory_outstanding(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(decimals_fit),
        cmocka_unit_test(a_misfit_stops_and_names_the_nearest),
        cmocka_unit_test(a_box_is_snapped_outward),
        cmocka_unit_test(decimals_are_not_snapped_to_the_next_line),
        cmocka_unit_test(a_box_ends_at_the_plate),
        cmocka_unit_test(boxes_that_overlap_or_touch_are_one),
        cmocka_unit_test(corner_contacts_are_repaired),
        cmocka_unit_test(a_repair_that_makes_a_contact_is_repaired),
        cmocka_unit_test(a_ring_of_boxes_has_an_inner_perimeter),
        cmocka_unit_test(many_random_boxes_have_sound_perimeters),
    };
    kr_run_tests(tests);
}
