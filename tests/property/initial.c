/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Initial velocities by a formula, and Rayleigh's damping: the kinetic energy at the start is that of the formula,
 * and a free flight is slowed like exp(-damping t).
 */
#include "test.h"

#include "cases.h"
#include "plates.h"

static const double SPACING = 0.1e-3, HORIZON = 0.3001e-3;
enum { ACROSS = 20, ROWS = 14 };

/* The first and the last record of a free plate. */
static void fly(const char *velocity, const char *stage, struct kr_test_record ends[2]) {
    struct kr_test_case t;
    struct kr_test_record record[64];
    char *deck = kr_text(KR_TEST_PMMA(0) "initial: {velocity: %s}\nstages: [%s]\n", velocity, stage);
    kr_test_case_open(&t, kr_plate_lattice(ACROSS, ROWS, SPACING), HORIZON, deck);
    kr_run_solve(t.run, "", 0);
    size_t count = kr_test_history(&t, record, 64);
    ends[0] = record[0];
    ends[1] = record[count - 1];
    kr_test_case_close(&t);
    kr_free(deck);
}

static void test_stages_damping_slows_a_flight(void **state) {
    (void)state;
    struct kr_test_record r[2];
    const double mass = KR_PMMA_DENSITY * ACROSS * ROWS * SPACING * SPACING;
    fly("[3 m/s, -1 m/s]", "{kind: dynamic, end_time: 20 us, damping: 2.5e4 s^-1}", r);
    kr_check_near(r[0].kinetic / (0.5 * mass * 10), 1, 1e-12);
    kr_figure("kinetic energy left after 20 us: %.6f, exp(-1) is %.6f", r[1].kinetic / r[0].kinetic, exp(-1));
    /* Velocities lag by half a step of some 0.05 us: 2.5e4 times that. */
    kr_check_near(r[1].kinetic / r[0].kinetic, exp(-1), 1.5e-3);
}

/* Turning and growing about the middle: both components are formulas of the place. */
static void test_stages_initial_velocity_by_a_formula(void **state) {
    (void)state;
    struct kr_test_record r[2];
    double x = 0, y = 0; /* m^2: sums of squares of the distances from the middle */
    for (int k = 0; k < ACROSS; k++)
        x += ROWS * pow((k + 0.5 - 0.5 * ACROSS) * SPACING, 2);
    for (int k = 0; k < ROWS; k++)
        y += ACROSS * pow((k + 0.5 - 0.5 * ROWS) * SPACING, 2);
    fly("['30*(x-0.001) - 100*(y-0.0007) m/s', '20*(y-0.0007) + 50*(x-0.001) m/s']",
        "{kind: dynamic, end_time: 1 us}", r);
    double wanted = 0.5 * KR_PMMA_DENSITY * SPACING * SPACING *
                    ((30 * 30 + 50 * 50) * x + (100 * 100 + 20 * 20) * y);
    kr_check_near(r[0].kinetic / wanted, 1, 1e-8); /* history has nine digits */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stages_damping_slows_a_flight),
        cmocka_unit_test(test_stages_initial_velocity_by_a_formula),
    };
    kr_run_tests(tests);
}
