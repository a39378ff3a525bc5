/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The stable step: a linear run just below it stays bounded, just above it grows.
 */
#include "test.h"

#include "base/error.h"
#include "cases.h"
#include "plates.h"
#include "time_step.h"

/* Leapfrog without loads from a random shake so small that all stays linear; returns the largest
 * displacement at the end over that at the start. */
static double growth(struct kr_body *body, double dt, int steps) {
    const double size = 1e-9 * 0.1e-3, kick = dt / body->bonds->material.density;
    double most = 0;
    kr_plate_shake(body, size, 8);
    for (int d = 0; d < 2; d++)
        memset(body->v[d], 0, body->n * sizeof(double));
    for (int step = 0; step < steps; step++) {
        kr_body_force(body, 0);
        for (int d = 0; d < 2; d++)
            for (size_t i = 0; i < body->n; i++) {
                body->v[d][i] += kick * body->force[d][i];
                body->u[d][i] += dt * body->v[d][i];
            }
    }
    for (size_t i = 0; i < body->n; i++)
        most = fmax(most, fabs(body->u[0][i]));
    return most / size;
}

/* omega is found from below within 1 %, so that 0.95 is below the bound and 1.05 above it, where a
 * step multiplies the worst mode by (1 + sqrt(1 - 1/1.05^2))^2 1.05^2 = 1.9. A bounded mode close
 * to the bound may swell by 1/sqrt(1 - 0.95^2) = 3, and random modes add up. */
static void check_step(const char *name, struct kr_nodes *nodes) {
    struct kr_material material = kr_pmma(KR_PLANE_STRESS, 0.3e-3);
    struct kr_bonds *bonds = kr_bonds_create(nodes, &material, KR_PARTIAL_VOLUME_HHB);
    struct kr_body *body = kr_body_create(bonds);
    struct kr_time_step found = kr_time_step_find(body, nodes->spacing);
    double below = growth(body, 0.95 * found.stable, 2000);
    double above = growth(body, 1.05 * found.stable, 60);
    kr_figure(
        "%s: stable %.4g us in %d rounds, classical %.4g, Courant %.4g us; growth %.1f below, "
        "%.1e above",
        name, 1e6 * found.stable, found.iterations, 1e6 * found.classical, 1e6 * found.courant,
        below, above);
    assert_true(below < 30);
    assert_true(above > 1e6);
    /* Gershgorin's circle bounds omega from above. */
    assert_true(found.classical <= found.stable);
    kr_check_near(found.stable * found.frequency, 2, 1e-14);
    kr_body_free(body);
    kr_bonds_free(bonds);
    kr_nodes_free(nodes);
}

static void test_time_step_is_the_bound(void **state) {
    (void)state;
    check_step("lattice", kr_plate_lattice(40, 30, 0.1e-3));
    check_step("porous plate", kr_plate_porous(44, 40, 0.1e-3, 0.5e-3, 0.3, 3));
}

static void test_time_step_leaves_the_body_at_rest(void **state) {
    struct kr_material material = kr_pmma(KR_PLANE_STRESS, 0.3e-3);
    struct kr_nodes *nodes = kr_plate_lattice(20, 20, 0.1e-3);
    struct kr_bonds *bonds = kr_bonds_create(nodes, &material, KR_PARTIAL_VOLUME_HHB);
    struct kr_body *body = kr_body_create(bonds);
    (void)state;
    kr_time_step_find(body, nodes->spacing);
    for (int d = 0; d < 2; d++)
        for (size_t i = 0; i < body->n; i++)
            assert_true(body->u[d][i] == 0 && body->force[d][i] == 0 && body->v[d][i] == 0);
    kr_body_free(body);
    kr_bonds_free(bonds);
    kr_nodes_free(nodes);
}

static struct kr_test_case unstable;

static void remove_folder(void) {
    char *command = kr_text("rm -rf %s", unstable.folder);
    if (system(command))
        fprintf(stderr, "%s is left behind\n", unstable.folder);
    kr_free(command);
}

/* A step too large that the deck could not have asked for: the watch stops the run. */
static void run_unstable(void *argument) {
    struct kr_nodes *nodes = kr_plate_lattice(24, 20, 0.1e-3);
    (void)argument;
    kr_test_sets(nodes, 24, 20);
    kr_test_case_open(&unstable, nodes, 0.3e-3,
                      KR_TEST_PMMA(0) "solver: {end_time: 60 us}\n"
                                      "loads: [{set: top, traction: [free, 1 MPa]}, "
                                      "{set: bottom, traction: [free, -1 MPa]}]\n");
    atexit(remove_folder);
    unstable.run->stage[0].dt *= 1.1 / unstable.c.safety_factor;
    kr_run_solve(unstable.run, "", 0);
}

static void test_unstable_run_stops(void **state) {
    (void)state;
    kr_check_stops(run_unstable, NULL, KR_EXIT_NUMBERS, "there is more than twice the energy");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_time_step_is_the_bound),
        cmocka_unit_test(test_time_step_leaves_the_body_at_rest),
        cmocka_unit_test(test_unstable_run_stops),
    };
    kr_run_tests(tests);
}
