/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The energy ledger of whole runs: what loads put in is there as motion, strain or fracture, but
 * for an error that falls with the square of the time step.
 */
#include "test.h"

#include "cases.h"
#include "plates.h"

enum { COLUMNS = 48, ROWS = 32, MOST_RECORDS = 512 };
static const double SPACING = 0.1e-3, HORIZON = 0.31e-3;

/* Run a plate under loads and return the largest |balance| over the largest work, and the last
 * record. The edges move in 12 us by many bonds' worth; waves cross the plate 7 times. */
static double run(const char *loads, const char *material, double time_step,
                  struct kr_test_record *last) {
    struct kr_test_record record[MOST_RECORDS];
    struct kr_test_case t;
    struct kr_nodes *nodes = kr_plate_lattice(COLUMNS, ROWS, SPACING);
    char *deck = kr_text("%ssolver: {end_time: 12 us, time_step: %.17g us}\n"
                         "output: {history_every: 0.4 us}\n%s",
                         material, time_step, loads);
    double balance = 0, work = 0;
    kr_test_sets(nodes, COLUMNS, ROWS);
    kr_test_case_open(&t, nodes, HORIZON, deck);
    kr_run_solve(t.run, "", 0);
    size_t count = kr_test_history(&t, record, MOST_RECORDS);
    assert_true(count > 25);
    for (size_t k = 0; k < count; k++) {
        balance = fmax(balance, fabs(record[k].balance));
        work = fmax(work, fabs(record[k].external));
    }
    *last = record[count - 1];
    kr_test_case_close(&t);
    kr_free(deck);
    return balance / work;
}

/* Halve the step from 0.05 us (0.4 of the largest) on: the error of leapfrog and of the trapezoidal
 * rule for the work both fall as dt^2, so by 4; 3 to 5 leaves room for the next order. */
static void check_order(const char *name, const char *loads) {
    struct kr_test_record last;
    double off[3];
    for (int k = 0; k < 3; k++)
        off[k] = run(loads, KR_TEST_PMMA(0), 0.04 / (1 << k), &last);
    kr_figure("%s: balance off by %.1e, %.1e, %.1e of the work in steps of 40, 20, 10 ns", name,
              off[0], off[1], off[2]);
    kr_check_near(off[2], 0, 1e-3);
    assert_true(off[0] / off[1] > 3 && off[0] / off[1] < 5);
    assert_true(off[1] / off[2] > 3 && off[1] / off[2] < 5);
}

static void test_ledger_closes_under_sudden_traction(void **state) {
    (void)state;
    check_order("sudden traction", "loads:\n- {set: top, traction: [0.7 MPa, 3 MPa]}\n"
                                   "- {set: bottom, traction: [free, -3 MPa]}\n");
}

static void test_ledger_closes_under_ramped_velocity(void **state) {
    (void)state;
    check_order("ramped velocity", "loads:\n- {set: top, velocity: [free, 1.3 m/s], ramp: 5 us}\n"
                                   "- {set: bottom, velocity: [0 m/s, -1.3 m/s], ramp: 5 us}\n");
}

static void test_ledger_closes_under_sudden_velocity(void **state) {
    (void)state;
    check_order("sudden velocity", "loads:\n- {set: top, velocity: [free, 1.3 m/s]}\n"
                                   "- {set: bottom, velocity: [0 m/s, -1.3 m/s]}\n");
}

static void test_ledger_closes_under_displacement(void **state) {
    (void)state;
    check_order("displacement",
                "loads:\n- {set: top, displacement: [free, '2e-6*sin(3e5*t)^2 m']}\n"
                "- {set: left, body_force: [1e9*y N/m^3, free]}\n");
}

/* A crack runs from a cut through the plate, in steps of 0.8 of the largest. A bond that breaks
 * takes what it holds along, and the half kick that exact.c leaves out keeps the order of dt^2;
 * waves as short as the lattice, which breaking makes, have omega dt = 1.6 and are worth the 1 %.
 */
static void test_ledger_closes_while_cracks_run(void **state) {
    struct kr_test_record last;
    double off[2];
    (void)state;
    for (int k = 0; k < 2; k++) {
        off[k] = run("cracks: {precracks: [{from: [0 mm, 1.6 mm], to: [2 mm, 1.6 mm]}]}\n"
                     "no_fail: [top, bottom]\nloads:\n- {set: top, traction: [free, 8 MPa]}\n"
                     "- {set: bottom, traction: [free, -8 MPa]}\n",
                     KR_TEST_PMMA(200), k ? 0.02 : 0.08, &last);
        kr_figure(
            "crack, steps of %d ns: %ld bonds broken, fracture %.0f %% of the work, balance off by "
            "%.1e",
            k ? 20 : 80, last.broken, 100 * last.fracture / last.external, off[k]);
        assert_true(last.broken > 500);
        kr_check_near(off[k], 0, 0.01);
    }
    assert_true(off[1] < off[0]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ledger_closes_under_sudden_traction),
        cmocka_unit_test(test_ledger_closes_under_ramped_velocity),
        cmocka_unit_test(test_ledger_closes_under_sudden_velocity),
        cmocka_unit_test(test_ledger_closes_under_displacement),
        cmocka_unit_test(test_ledger_closes_while_cracks_run),
    };
    kr_run_tests(tests);
}
