/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What is due when: each due time falls to just one step, and to the nearest.
 */
#include "test.h"

#include "schedule.h"

/* Steps out of 0 to n - 1 that are due; those at `every` k must be the nearest to it. */
static int count_due(const struct kr_schedule *schedule, double dt, int n) {
    int count = 0;
    for (int step = 0; step < n; step++)
        count += kr_schedule_due(schedule, step * dt, dt);
    return count;
}

static void test_schedule_every(void **state) {
    static const double ratio[] = {1, 1.37, 2, 3.7, 10, 64.3}; /* of the interval to the step */
    const double dt = 0.0371e-6;
    (void)state;
    for (size_t k = 0; k < sizeof ratio / sizeof *ratio; k++) {
        struct kr_schedule schedule = kr_schedule_every(ratio[k] * dt);
        int steps = 5000, due = 0;
        for (int step = 0; step < steps; step++) {
            double at = (double)step / ratio[k];
            int here = kr_schedule_due(&schedule, step * dt, dt);
            /* The nearest due time is at most half a step away, or rounding away from half. */
            if (here)
                kr_check_near(at, round(at), 0.5 / ratio[k] + 1e-9);
            due += here;
        }
        kr_check_near(due, floor((steps - 0.5) / ratio[k]) + 1, ratio[k] == 1 ? 0 : 1e-9);
    }
}

static void test_schedule_begins_and_may_never_come(void **state) {
    struct kr_schedule schedule = kr_schedule_every(1e-6), never = kr_schedule_every(0);
    (void)state;
    assert_true(kr_schedule_due(&schedule, 0, 1e-8));
    assert_int_equal(count_due(&never, 1e-8, 1000), 0);
}

static void test_schedule_at_listed_times(void **state) {
    double at[] = {0, 1.234e-6, 1.2401e-6, 7.7e-6};
    struct kr_deck_list list = {4, at, 1};
    struct kr_schedule schedule = kr_schedule_of(0, &list);
    const double dt = 0.01e-6;
    (void)state;
    assert_int_equal(count_due(&schedule, dt, 1000), 4);
    assert_true(kr_schedule_due(&schedule, 0, dt));
    assert_true(kr_schedule_due(&schedule, 123 * dt, dt));
    assert_true(kr_schedule_due(&schedule, 124 * dt, dt));
    assert_true(kr_schedule_due(&schedule, 770 * dt, dt));
    assert_false(kr_schedule_due(&schedule, 122 * dt, dt));
    schedule = kr_schedule_of(5e-6, &list);
    assert_int_equal(count_due(&schedule, dt, 1000), 5); /* 0, 1.234, 1.2401, 5, 7.7 us */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_schedule_every),
        cmocka_unit_test(test_schedule_begins_and_may_never_come),
        cmocka_unit_test(test_schedule_at_listed_times),
    };
    kr_run_tests(tests);
}
