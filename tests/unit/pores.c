/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Random pores obey the rules of the plates paper for every seed, and a seed means the same pores
 * everywhere.
 */
#include "test.h"

#include "pore_size.h"
#include "pores.h"

/* Places are whole nanometres and the rules hold for them exactly; metres in double precision
 * differ from them by less than this. */
static const double ROUNDING = 1e-16;

static struct kr_case plate(int64_t count, int64_t seed) {
    return (struct kr_case){.width = 50e-3,
                            .height = 25e-3,
                            .pores = {.count = count,
                                      .seed = seed,
                                      .attempts = 100000,
                                      .radius = {0.75e-3, 1.5e-3},
                                      .edge_diameters = 1,
                                      .gap = 0.3e-3}};
}

/** Throw all pores of a case; returns how many were placed. */
static size_t throw_all(const struct kr_case *c, struct kr_case_hole *pore, int64_t *throws) {
    struct kr_pores got = kr_pores_throw(c);
    size_t placed = got.placed;
    if (placed)
        memcpy(pore, got.hole, placed * sizeof *pore);
    *throws = got.throws;
    kr_pores_free(&got);
    return placed;
}

static void check_edges(const struct kr_case *c, const struct kr_case_hole *pore, double room) {
    assert_true(pore->centre[0] >= room - ROUNDING);
    assert_true(pore->centre[0] <= c->width - room + ROUNDING);
    assert_true(pore->centre[1] >= room - ROUNDING);
    assert_true(pore->centre[1] <= c->height - room + ROUNDING);
}

static double rim_distance(const struct kr_case_hole *a, const struct kr_case_hole *b) {
    return hypot(a->centre[0] - b->centre[0], a->centre[1] - b->centre[1]) - a->radius - b->radius;
}

static void check_rules(const struct kr_case *c, const struct kr_case_hole *pore, size_t n) {
    const struct kr_case_hole *hole = c->holes.item;
    for (size_t k = 0; k < n; k++) {
        assert_true(pore[k].radius >= c->pores.radius[0] && pore[k].radius <= c->pores.radius[1]);
        check_edges(c, &pore[k], 2 * c->pores.edge_diameters * pore[k].radius);
        for (size_t l = 0; l < k; l++)
            assert_true(rim_distance(&pore[k], &pore[l]) >= c->pores.gap - ROUNDING);
        for (size_t h = 0; h < c->holes.count; h++)
            assert_true(rim_distance(&pore[k], &hole[h]) >= c->pores.gap - ROUNDING);
    }
}

static void pores_obey_the_rules_for_200_seeds(void **unused) {
    (void)unused;
    for (int64_t seed = 0; seed < 200; seed++) {
        struct kr_case c = plate(30, seed);
        struct kr_case_hole pore[30];
        int64_t throws;
        assert_int_equal(throw_all(&c, pore, &throws), 30);
        assert_true(throws >= 30 && throws <= 100000);
        check_rules(&c, pore, 30);
    }
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void pores_keep_clear_of_the_decks_holes(void **unused) {
    (void)unused;
    struct kr_case_hole hole[] = {{{25e-3, 12.5e-3}, 8.1234567891e-3}, {{5e-3, 5e-3}, 2e-3}};
    for (int64_t seed = 0; seed < 50; seed++) {
        struct kr_case c = plate(12, seed);
        struct kr_case_hole pore[12];
        int64_t throws;
        c.holes = (struct kr_deck_list){2, hole, 1};
        assert_int_equal(throw_all(&c, pore, &throws), 12);
        check_rules(&c, pore, 12);
    }
}

static void pores_never_touch_the_edges(void **unused) {
    (void)unused;
    for (int64_t seed = 0; seed < 50; seed++) {
        struct kr_case c = plate(20, seed);
        struct kr_case_hole pore[20];
        int64_t throws;
        c.pores.edge_diameters = 0;
        assert_int_equal(throw_all(&c, pore, &throws), 20);
        for (size_t k = 0; k < 20; k++)
            check_edges(&c, &pore[k], pore[k].radius + c.pores.gap);
    }
}

/** The generator is part of the format: a deck's seed must mean the same pores in years to come. */
static void a_seed_means_these_pores(void **unused) {
    (void)unused;
    struct kr_case c = plate(3, 3);
    struct kr_case_hole pore[3];
    int64_t throws;
    throw_all(&c, pore, &throws);
    kr_check_near(pore[0].centre[0], 0.012099424, 0);
    kr_check_near(pore[0].centre[1], 0.007475807, 0);
    kr_check_near(pore[0].radius, 0.001209559, 0);
    kr_check_near(pore[1].centre[0], 0.039662757, 0);
}

/** The nanometres of thirty pores of each distribution, as one number (FNV-1a): the same on every machine,
 *  whatever its libm, for a place fits or not by whole nanometres alone. */
static void seeds_mean_the_same_pores_everywhere(void **unused) {
    static const uint64_t golden[] = {UINT64_C(0xa0ffead502f1aaf6), UINT64_C(0x781eab5ec6ff9149),
                                      UINT64_C(0x113696f09fb6c780), UINT64_C(0x004fbdddac792801)};
    (void)unused;
    for (int distribution = 0; distribution <= KR_BY_AREA; distribution++) {
        struct kr_case c = plate(30, 17);
        struct kr_case_hole pore[30];
        uint64_t digest = UINT64_C(0xCBF29CE484222325);
        int64_t throws;
        c.pores.distribution = distribution;
        c.pores.mean = 1.1e-3;
        c.pores.deviation = 0.3e-3;
        assert_int_equal(throw_all(&c, pore, &throws), 30);
        for (size_t k = 0; k < 30; k++) {
            const double length[] = {pore[k].centre[0], pore[k].centre[1], pore[k].radius};
            for (size_t l = 0; l < 3; l++)
                digest = (digest ^ (uint64_t)llrint(1e9 * length[l])) * UINT64_C(0x100000001B3);
        }
        if (digest != golden[distribution])
            fail_msg("distribution %d: 0x%016llx", distribution, (unsigned long long)digest);
    }
}

static void equal_seeds_give_equal_pores_and_others_do_not(void **unused) {
    (void)unused;
    struct kr_case c = plate(30, 17), d = plate(30, 18);
    struct kr_case_hole one[30], two[30], three[30];
    int64_t throws;
    throw_all(&c, one, &throws);
    throw_all(&c, two, &throws);
    throw_all(&d, three, &throws);
    assert_memory_equal(one, two, sizeof one);
    assert_memory_not_equal(one, three, sizeof one);
}

static void nine_decimals_give_each_number_back(void **unused) {
    (void)unused;
    struct kr_case c = plate(30, 4);
    struct kr_case_hole pore[30];
    int64_t throws;
    throw_all(&c, pore, &throws);
    for (size_t k = 0; k < 30; k++) {
        char text[32];
        snprintf(text, sizeof text, "%.9f", pore[k].centre[0]);
        kr_check_near(strtod(text, NULL), pore[k].centre[0], 0);
        snprintf(text, sizeof text, "%.9f", pore[k].radius);
        kr_check_near(strtod(text, NULL), pore[k].radius, 0);
    }
}

/** Radii and places are even: means of 3000 draws within 4 standard deviations. */
static void radii_and_places_are_even(void **unused) {
    (void)unused;
    double radius = 0, x = 0;
    for (int64_t seed = 0; seed < 3000; seed++) {
        struct kr_case c = plate(1, seed);
        struct kr_case_hole pore;
        int64_t throws;
        throw_all(&c, &pore, &throws);
        radius += pore.radius / 3000;
        x += (pore.centre[0] - c.width / 2) / (c.width / 2 - 2 * pore.radius) / 3000;
    }
    kr_check_near(radius, 1.125e-3, 4 * 0.75e-3 / sqrt(12.0 * 3000));
    kr_check_near(x, 0, 4 * 2 / sqrt(12.0 * 3000));
}

/** Mean and standard deviation of 20000 radii of a distribution. */
static void moments_of(int distribution, double mean, double deviation, double least, double most,
                       double moment[2]) {
    struct kr_case_pores p = {.distribution = distribution,
                              .mean = mean,
                              .deviation = deviation,
                              .radius = {least, most}};
    uint64_t state = 77;
    double sum = 0, squares = 0;
    enum { DRAWS = 20000 };
    for (int k = 0; k < DRAWS; k++) {
        double r = 1e-9 * (double)kr_pore_size_draw(&p, &state).radius;
        assert_true(r >= least - 1e-12 && r <= most + 1e-12);
        sum += r / DRAWS;
        squares += r * r / DRAWS;
    }
    moment[0] = sum;
    moment[1] = sqrt(squares - sum * sum);
}

/** Against closed formulas, within 4 standard errors (of the mean d/sqrt(n), of d about as much). */
static void radii_follow_their_distribution(void **unused) {
    (void)unused;
    const double error = 4 / sqrt(20000);
    double m[2];
    moments_of(KR_NORMAL, 1e-3, 0.1e-3, 0.5e-3, 1.5e-3, m); /* cut off at 5 deviations: as good as whole */
    kr_check_near(m[0], 1e-3, 0.1e-3 * error);
    kr_check_near(m[1], 0.1e-3, 0.1e-3 * error);
    moments_of(KR_NORMAL, 1e-3, 0.3e-3, 1e-3, 9e-3, m); /* the upper half: m + d sqrt(2/pi) */
    kr_check_near(m[0], 1e-3 + 0.3e-3 * sqrt(2 / M_PI), 0.3e-3 * error);
    moments_of(KR_LOGNORMAL, 1e-3, 0.4e-3, 0.05e-3, 20e-3, m);
    kr_check_near(m[0], 1e-3, 0.4e-3 * error);
    kr_check_near(m[1], 0.4e-3, 0.4e-3 * 2 * error); /* its tail weighs more */
    moments_of(KR_BY_AREA, 0, 0, 1e-3, 2e-3, m); /* (2/3)(8 - 1)/(4 - 1) */
    kr_check_near(m[0], 14e-3 / 9, 0.29e-3 * error);
}

static void an_impossible_request_ends(void **unused) {
    (void)unused;
    struct kr_case c = plate(400, 1);
    struct kr_case_hole *pore = KR_NEW(struct kr_case_hole, 400);
    int64_t throws;
    c.pores.attempts = 5000;
    size_t placed = throw_all(&c, pore, &throws);
    assert_int_equal(throws, 5000);
    assert_true(placed > 60 && placed < 200);
    check_rules(&c, pore, placed);
    c.pores.edge_diameters = 20; /* no place at all */
    assert_int_equal(throw_all(&c, pore, &throws), 0);
    kr_free(pore);
    assert_int_equal(kr_memory_outstanding(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pores_obey_the_rules_for_200_seeds),
        cmocka_unit_test(pores_keep_clear_of_the_decks_holes),
        cmocka_unit_test(pores_never_touch_the_edges),
        cmocka_unit_test(a_seed_means_these_pores),
        cmocka_unit_test(seeds_mean_the_same_pores_everywhere),
        cmocka_unit_test(equal_seeds_give_equal_pores_and_others_do_not),
        cmocka_unit_test(nine_decimals_give_each_number_back),
        cmocka_unit_test(radii_and_places_are_even),
        cmocka_unit_test(radii_follow_their_distribution),
        cmocka_unit_test(an_impossible_request_ends),
    };
    kr_run_tests(tests);
}
