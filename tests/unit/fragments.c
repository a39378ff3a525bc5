/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Fragments of a plate of 24 x 11 nodes, 0.5 mm apart, that bonds hold together over three spacings.
 */
#include "test.h"

#include "fragments.h"

enum { COLUMNS = 24, ROWS = 11, N = COLUMNS * ROWS };
static const double spacing = 0.5e-3;

/* What a test holds: freed behind it also where it fails, lest the next one finds arrays left. */
static struct kr_record *held_record;
static struct kr_fragments held;

static int let_go(void **state) {
    (void)state;
    kr_fragments_clear(&held);
    kr_record_free(held_record);
    held_record = NULL;
    return kr_memory_outstanding() > 0;
}

static struct kr_record *plate(void) {
    struct kr_record *r = held_record = KR_NEW(struct kr_record, 1);
    *r = (struct kr_record){.dim = 2,
                            .n = N,
                            .position = KR_NEW(double, 2 * N),
                            .volume = KR_NEW(double, N),
                            .damage_time = KR_NEW(double, N),
                            .spacing = spacing,
                            .horizon = 3 * spacing,
                            .density = 1190};
    for (size_t i = 0; i < N; i++) {
        r->position[2 * i] = (double)(i % COLUMNS) * spacing;
        r->position[2 * i + 1] = (double)(i / COLUMNS) * spacing;
        r->volume[i] = spacing * spacing;
    }
    r->bond = KR_NEW(int32_t, 2 * N * 40);
    return r;
}

/** Break the bonds across the middle of two columns, but for `spared` of them. */
static void cut(struct kr_record *r, size_t column, size_t spared) {
    for (size_t i = 0; i < N; i++)
        for (size_t j = 0; j < N; j++) {
            double length = hypot(r->position[2 * i] - r->position[2 * j],
                                  r->position[2 * i + 1] - r->position[2 * j + 1]);
            if (i % COLUMNS >= column || j % COLUMNS < column || length > 3.01 * spacing)
                continue;
            if (spared) {
                spared--;
                continue;
            }
            r->bond[2 * r->broken] = (int32_t)j; /* either end may come first */
            r->bond[2 * r->broken++ + 1] = (int32_t)i;
        }
}

static struct kr_fragments find(const struct kr_record *r, const struct kr_case *c,
                                struct kr_precrack *const *crack, const double *velocity) {
    kr_fragments_find(r, c, crack, velocity, &held);
    return held;
}

static void done(void) {
    assert_int_equal(let_go(NULL), 0);
}

static void tree_fragments_of_a_cut_plate(void **state) {
    struct kr_record *r = plate();
    struct kr_case c = {.partial_volume = KR_PARTIAL_VOLUME_NONE};
    struct kr_fragments f;
    const double cell = 1190 * spacing * spacing;
    double v[3 * N];
    (void)state;
    for (size_t i = 0; i < N; i++) {
        v[3 * i] = i % COLUMNS < 7 ? -3 : 2;
        v[3 * i + 1] = 0.25;
        v[3 * i + 2] = 0;
    }
    cut(r, 7, 0);
    f = find(r, &c, NULL, v);
    assert_int_equal(f.count, 2);
    assert_int_equal(f.item[0].count, 17 * ROWS);
    assert_int_equal(f.item[1].count, 7 * ROWS);
    assert_int_equal(f.of[6], 1);
    assert_int_equal(f.of[7], 0);
    kr_check_near(f.item[1].mass, 7 * ROWS * cell, 1e-12 * cell * N);
    kr_check_near(f.item[1].centre[0], 3 * spacing, 1e-15);
    kr_check_near(f.item[1].centre[1], 5 * spacing, 1e-15);
    kr_check_near(f.item[1].momentum[0], -3 * 7 * ROWS * cell, 1e-12 * cell * N);
    kr_check_near(f.item[0].momentum[0], 2 * 17 * ROWS * cell, 1e-12 * cell * N);
    kr_check_near(f.item[0].momentum[1], 0.25 * 17 * ROWS * cell, 1e-12 * cell * N);
    kr_check_near(f.item[0].extent, hypot(16, 10) * spacing, 1e-15);
    done();
}

/** One living bond holds two halves together. */
static void tree_fragments_hang_by_one_bond(void **state) {
    struct kr_record *r = plate();
    struct kr_case c = {.partial_volume = KR_PARTIAL_VOLUME_NONE};
    struct kr_fragments f;
    (void)state;
    cut(r, 7, 1);
    f = find(r, &c, NULL, NULL);
    assert_int_equal(f.count, 1);
    assert_true(isnan(f.item[0].momentum[0]));
    kr_check_near(f.item[0].extent, hypot(23, 10) * spacing, 1e-15);
    done();
}

/** A pre-crack's bonds are in no list: it is cut anew. */
static void tree_fragments_know_the_precrack(void **state) {
    struct kr_record *r = plate();
    struct kr_case_crack crack = {{11.5 * spacing, -1}, {11.5 * spacing, 1}};
    struct kr_case c = {.partial_volume = KR_PARTIAL_VOLUME_HHB,
                        .cracks = {.item = &crack, .count = 1}};
    struct kr_fragments f;
    struct kr_precrack *cut = kr_precrack_create(&crack, NULL);
    (void)state;
    f = find(r, &c, &cut, NULL);
    kr_precrack_free(cut);
    assert_int_equal(f.count, 2);
    assert_int_equal(f.item[0].count, 12 * ROWS);
    assert_int_equal(f.item[0].first, 0); /* equal masses: the lower node first */
    done();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(tree_fragments_of_a_cut_plate, let_go),
        cmocka_unit_test_teardown(tree_fragments_hang_by_one_bond, let_go),
        cmocka_unit_test_teardown(tree_fragments_know_the_precrack, let_go),
    };
    kr_run_tests(tests);
}
