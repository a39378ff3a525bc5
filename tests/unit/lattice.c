/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The lattice that fits a plate, and the regions of it around holes.
 */
#include "test.h"

#include "boxes.h"
#include "lattice.h"

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
    kr_check_stops(misfit, NULL, 2, "the nearest that fit are 0.0429553265 mm and 0.0430292599 mm");
    kr_check_stops(slight_misfit, NULL, 2, "cannot be cut into whole squares");
    kr_check_stops(too_coarse, NULL, 2, "the nearest that fits is");
}

/** Check that every perimeter is a closed walk of lattice steps with the region on its left, and
 *  that the perimeters together bound just the region's cells. */
static void check_perimeters(const struct kr_lattice *lattice, const struct kr_regions *regions) {
    for (size_t r = 0; r < regions->count; r++) {
        const struct kr_region *region = &regions->region[r];
        long twice_area = 0;
        size_t cells = 0;
        for (size_t l = 0; l < region->n_loops; l++) {
            const struct kr_region_loop *loop = &region->loop[l];
            long steps = 0, loop_area = 0;
            for (size_t k = 0; k < loop->n_corners; k++) {
                const struct kr_region_corner *a = &loop->corner[k];
                const struct kr_region_corner *b = &loop->corner[(k + 1) % loop->n_corners];
                long dx = (long)b->i - (long)a->i, dy = (long)b->j - (long)a->j;
                assert_true((dx == 0) != (dy == 0));
                assert_int_equal(labs(dx) + labs(dy), a->run);
                loop_area += (long)a->i * (long)b->j - (long)b->i * (long)a->j;
                steps += (long)a->run;
            }
            assert_int_equal(steps % 2, 0); /* quadrilaterals can fill it */
            assert_true(l == 0 ? loop_area > 0 : loop_area < 0);
            twice_area += loop_area;
        }
        for (size_t c = 0; c < lattice->columns * lattice->rows; c++)
            cells += regions->of_cell[c] == (int32_t)r;
        assert_int_equal(cells, region->n_cells);
        assert_int_equal(twice_area, 2 * cells);
    }
}

/** No two cells of regions meet at a corner only. */
static void check_corners(const struct kr_lattice *lattice, const struct kr_regions *regions) {
    for (size_t j = 1; j < lattice->rows; j++)
        for (size_t i = 1; i < lattice->columns; i++) {
            const int32_t *below = regions->of_cell + kr_lattice_cell(lattice, i - 1, j - 1);
            const int32_t *above = below + lattice->columns;
            int is_contact = (below[0] < 0) == (above[1] < 0) && (below[1] < 0) == (above[0] < 0) &&
                             (below[0] < 0) != (below[1] < 0);
            assert_false(is_contact);
        }
}

static struct kr_regions *regions_of(const struct kr_lattice *lattice, size_t n,
                                     const struct kr_case_hole *hole, double padding) {
    struct kr_regions *regions = kr_regions_create(lattice, n, hole, padding);
    check_perimeters(lattice, regions);
    check_corners(lattice, regions);
    return regions;
}

static void a_box_is_snapped_outward(void **unused) {
    (void)unused;
    struct kr_lattice lattice = {20, 16, 0.1};
    struct kr_case_hole hole = {{0.93, 0.8}, 0.2}; /* 0.93 - 0.4 = 5.3, 13.3; 4 and 12 exactly */
    struct kr_regions *regions = regions_of(&lattice, 1, &hole, 0.2);
    assert_int_equal(regions->count, 1);
    assert_int_equal(regions->region[0].n_cells, 9 * 8);
    assert_int_equal(regions->region[0].loop[0].corner[0].i, 5);
    assert_int_equal(regions->region[0].loop[0].corner[0].j, 4);
    assert_int_equal(regions->region[0].loop[0].n_corners, 4);
    kr_regions_free(regions);
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
            struct kr_regions *regions = regions_of(&lattice, 1, &hole, 2 * one / of);
            assert_int_equal(regions->region[0].n_cells, 64);
            kr_regions_free(regions);
        }
}

static void a_box_ends_at_the_plate(void **unused) {
    (void)unused;
    struct kr_lattice lattice = {20, 16, 0.1};
    struct kr_case_hole hole = {{0.25, 1.4}, 0.15};
    struct kr_regions *regions = regions_of(&lattice, 1, &hole, 0.25);
    assert_int_equal(regions->region[0].n_cells, 7 * 6);
    kr_regions_free(regions);
}

static void boxes_that_overlap_or_touch_are_one(void **unused) {
    (void)unused;
    struct kr_lattice lattice = {40, 20, 0.1};
    struct kr_case_hole overlap[] = {{{1, 1}, 0.3}, {{1.7, 1.1}, 0.3}};
    struct kr_case_hole touch[] = {{{1, 1}, 0.3}, {{2, 1}, 0.3}};
    struct kr_case_hole apart[] = {{{1, 1}, 0.3}, {{2.1, 1}, 0.3}};
    struct kr_regions *regions = regions_of(&lattice, 2, overlap, 0.2);
    assert_int_equal(regions->count, 1);
    assert_int_equal(regions->region[0].n_holes, 2);
    assert_int_equal(regions->region[0].n_cells, 100 + 100 - 3 * 9);
    kr_regions_free(regions);
    regions = regions_of(&lattice, 2, touch, 0.2);
    assert_int_equal(regions->count, 1);
    assert_int_equal(regions->region[0].loop[0].n_corners, 4);
    kr_regions_free(regions);
    regions = regions_of(&lattice, 2, apart, 0.2);
    assert_int_equal(regions->count, 2);
    kr_regions_free(regions);
}

static void corner_contacts_are_repaired(void **unused) {
    (void)unused;
    struct kr_lattice lattice = {40, 40, 0.1};
    struct kr_case_hole rising[] = {{{1, 1}, 0.3}, {{2, 2}, 0.3}};
    struct kr_case_hole falling[] = {{{1, 2}, 0.3}, {{2, 1}, 0.3}};
    for (int k = 0; k < 2; k++) {
        struct kr_regions *regions = regions_of(&lattice, 2, k ? falling : rising, 0.2);
        assert_int_equal(regions->count, 1);
        assert_int_equal(regions->region[0].n_cells, 2 * 100 + 1);
        kr_regions_free(regions);
    }
}

/** The cell that joins two boxes touches a third one's corner, in a row that was passed before. */
static void a_repair_that_makes_a_contact_is_repaired(void **unused) {
    (void)unused;
    struct kr_lattice lattice = {40, 40, 0.1};
    struct kr_case_hole hole[] = {{{1.5, 1.5}, 0.3}, {{2.5, 2.5}, 0.3}, {{2.6, 1.4}, 0.3}};
    struct kr_regions *regions = regions_of(&lattice, 3, hole, 0.2);
    assert_int_equal(regions->count, 1);
    assert_int_equal(regions->region[0].n_cells, 3 * 100 + 2);
    kr_regions_free(regions);
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
    struct kr_regions *regions = regions_of(&lattice, 8, hole, 0.05);
    assert_int_equal(regions->count, 8); /* two cells stay between neighbours */
    kr_regions_free(regions);
    regions = regions_of(&lattice, 8, hole, 0.1); /* snapped, they touch */
    assert_int_equal(regions->count, 1);
    assert_int_equal(regions->region[0].n_loops, 2);
    assert_int_equal(regions->region[0].n_holes, 8);
    assert_int_equal(regions->region[0].n_cells, 800);
    kr_regions_free(regions);
}

static void many_random_boxes_have_sound_perimeters(void **unused) {
    (void)unused;
    struct kr_lattice lattice = {150, 110, 0.1};
    uint64_t state = 5;
    for (int trial = 0; trial < 200; trial++) {
        struct kr_case_hole hole[40];
        size_t holes = 0;
        for (size_t h = 0; h < 40; h++) {
            double draw[3];
            for (int d = 0; d < 3; d++) {
                state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
                draw[d] = (double)(state >> 11) / 9007199254740992.0;
            }
            hole[h] = (struct kr_case_hole){{0.1 + 14.8 * draw[0], 0.1 + 10.8 * draw[1]},
                                            0.05 + 0.3 * draw[2]};
        }
        struct kr_regions *regions = regions_of(&lattice, 40, hole, 0.31);
        for (size_t r = 0; r < regions->count; r++)
            holes += regions->region[r].n_holes;
        assert_int_equal(holes, 40);
        kr_regions_free(regions);
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
