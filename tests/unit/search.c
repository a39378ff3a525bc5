/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Cell lists against brute force, and the weights of partial volumes.
 */
#include "test.h"

#include "plates.h"
#include "search.h"
#include "weight.h"

enum { MOST = 700 };

static double distance(int dim, const double *a, const double *b) {
    double square = 0;
    for (int d = 0; d < dim; d++)
        square += (a[d] - b[d]) * (a[d] - b[d]);
    return sqrt(square);
}

static void check_search(int dim, double reach, double aspect) {
    double position[3 * MOST];
    uint64_t seed = 17;
    size_t pairs = 0;
    int near[MOST];
    struct kr_found all = {0};
    for (size_t k = 0; k < (size_t)dim * MOST; k++)
        position[k] = kr_random(&seed, -0.3, 0.7) * (k % (size_t)dim ? 1 : aspect);
    struct kr_search *search = kr_search_create(dim, MOST, position, reach);
    for (size_t i = 0; i < MOST; i++) {
        size_t found = kr_search_near(search, i, near, MOST), expected = 0;
        for (size_t j = 0; j < MOST; j++)
            if (j != i &&
                distance(dim, position + i * (size_t)dim, position + j * (size_t)dim) <= reach) {
                assert_true(expected < found);
                assert_int_equal(near[expected++], j); /* ascending */
            }
        assert_int_equal(found, expected);
        kr_search_find(search, i, &all);
        assert_int_equal(all.count, found);
        if (found)
            assert_memory_equal(all.near, near, found * sizeof *near);
        if (found > 1)
            assert_int_equal(kr_search_near(search, i, near, 1), found); /* counts without room */
        pairs += found;
    }
    kr_figure("%dD, reach %.2f: %.1f neighbours a point", dim, reach, (double)pairs / MOST);
    kr_free(all.near);
    kr_search_free(search);
}

static void test_search_finds_what_brute_force_finds(void **state) {
    (void)state;
    check_search(2, 0.071, 1);
    check_search(2, 0.33, 10);
    check_search(2, 3.1, 1); /* one bin */
    check_search(3, 0.17, 1);
    check_search(3, 0.4, 5);
}

static void test_weights_of_partial_volumes(void **state) {
    const double delta = 0.31, a = 0.1, b = 0.07;
    (void)state;
    /* Paper eq. 13: 1 up to delta - r/2, 1/2 at delta, 0 from delta + r/2 on, linear between. */
    kr_check_near(kr_weight_hhb_one_sided(delta - 0.6 * a, delta, a), 1, 0);
    kr_check_near(kr_weight_hhb_one_sided(delta - 0.3 * a, delta, a), 0.8, 1e-14);
    kr_check_near(kr_weight_hhb_one_sided(delta, delta, a), 0.5, 1e-14);
    kr_check_near(kr_weight_hhb_one_sided(delta + 0.2 * a, delta, a), 0.3, 1e-14);
    kr_check_near(kr_weight_hhb_one_sided(delta + 0.6 * a, delta, a), 0, 0);
    for (double length = 0.2; length < 0.4; length += 0.0037) {
        double phi = kr_weight(KR_PARTIAL_VOLUME_HHB, length, delta, a, b);
        assert_true(phi == kr_weight(KR_PARTIAL_VOLUME_HHB, length, delta, b, a));
        kr_check_near(phi,
                      0.5 * kr_weight_hhb_one_sided(length, delta, a) +
                          0.5 * kr_weight_hhb_one_sided(length, delta, b),
                      1e-9);
        assert_true(kr_weight(KR_PARTIAL_VOLUME_NONE, length, delta, a, b) == (length <= delta));
        if (length > kr_weight_reach(KR_PARTIAL_VOLUME_HHB, delta, a))
            assert_true(phi == 0);
    }
    /* A lattice bond just as long as the horizon belongs to the family, however 3 * 0.1 is rounded.
     */
    assert_true(kr_weight(KR_PARTIAL_VOLUME_NONE, 3 * 0.1, 0.3, 0.1, 0.1) == 1);
    assert_true(kr_weight(KR_PARTIAL_VOLUME_NONE, 0.1 + 0.1 + 0.1, 0.3, 0.1, 0.1) == 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_search_finds_what_brute_force_finds),
        cmocka_unit_test(test_weights_of_partial_volumes),
    };
    kr_run_tests(tests);
}
