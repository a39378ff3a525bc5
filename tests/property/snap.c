/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A slender strip pressed along itself in one load step buckles far, through states that are not stable. The stage must
 * find the equilibrium that small load steps lead to.
 */
#include "test.h"

#include "cases.h"
#include "plates.h"
#include "settle.h"
#include "time_step.h"

static const double SPACING = 0.1e-3, HORIZON = 0.3001e-3;
enum { SPAN = 80, ROWS = 3, RISE = 1, HELD = 6 }; /* cells */

/* Rows that are bent a little, so that it is known to which side they give way; `left` and `right` are their
 * ends. */
static struct kr_nodes *strip(void) {
    struct kr_nodes *nodes = kr_plate_lattice(SPAN, ROWS, SPACING);
    int64_t *end[2] = {KR_NEW(int64_t, nodes->n), KR_NEW(int64_t, nodes->n)};
    size_t count[2] = {0, 0};
    for (size_t i = 0; i < nodes->n; i++) {
        double x = ((double)(i % SPAN) + 0.5) / SPAN;
        nodes->position[2 * i + 1] += 4 * RISE * SPACING * x * (1 - x);
        for (int side = 0; side < 2; side++)
            if ((side ? 1 - x : x) * SPAN < HELD)
                end[side][count[side]++] = (int64_t)i;
    }
    kr_nodes_add_set(nodes, "left", count[0], end[0], 0);
    kr_nodes_add_set(nodes, "right", count[1], end[1], 0);
    return nodes;
}

/* A static stage of so many load steps: the strain energy, and how far the middle is off its place. */
static double by_stage(double push, int steps, double *off) {
    struct kr_test_case t;
    struct kr_test_record record[200];
    char *deck = kr_text(KR_TEST_PMMA(0) "loads: [{set: left, displacement: [0 m, 0 m]}, {set: right, displacement: "
                         "['%.17g*t m', 0 m]}]\nstages: [{kind: static, steps: [{count: %d, size: '%.17g s'}]}]\n",
                         -push * SPAN * SPACING, steps, 1.0 / steps);
    kr_test_case_open(&t, strip(), HORIZON, deck);
    kr_run_solve(t.run, "", 0);
    *off = t.run->body->u[1][SPAN + SPAN / 2] / SPACING;
    double energy = record[kr_test_history(&t, record, 200) - 1].strain;
    kr_test_case_close(&t);
    kr_free(deck);
    return energy;
}

/* Whether Newton's first run reaches the equilibrium hangs on rounding; where it does not, damped motion does. */
static void test_statics_snap(void **state) {
    (void)state;
    const double push = 0.14;
    double off[2];
    double at_once = by_stage(push, 1, &off[0]), slowly = by_stage(push, 100, &off[1]);
    kr_figure("pushed by %.3f of its span: middle off by %.4f cells at once, %.4f in 100 steps; energies off by %.1e",
              push, off[0], off[1], at_once / slowly - 1);
    /* To a residual of 1e-6 of the push; the strip is softer by some (80/3)^2 across than along. */
    kr_check_near(fabs(off[0] / off[1]), 1, 1e-3);
    kr_check_near(at_once / slowly, 1, 1e-5);
}

/* The strip pushed at once, by Newton with so few steps that it cannot follow the buckling, which takes it some ten;
 * with damped motion or without. The strain energy, NAN where no equilibrium is found. */
static double by_few_steps(double push, int steps, enum kr_equilibrium_end (*find)(struct kr_equilibrium *)) {
    struct kr_nodes *nodes = strip();
    struct kr_material material = kr_pmma(KR_PLANE_STRESS, HORIZON);
    material.critical_stretch = INFINITY;
    struct kr_bonds *bonds = kr_bonds_create(nodes, &material, KR_PARTIAL_VOLUME_HHB);
    struct kr_body *body = kr_body_create(bonds);
    struct kr_equilibrium *q = kr_equilibrium_create(body);
    for (int side = 0; side < 2; side++) {
        const struct kr_set *set = kr_nodes_set(nodes, side ? "right" : "left");
        for (size_t m = 0; m < set->count; m++) {
            q->rest->fixed[set->node[m]] = 3;
            q->move[0][set->node[m]] = side ? -push * SPAN * SPACING : 0;
        }
    }
    q->most_steps = steps;
    double energy = find(q) == KR_EQUILIBRIUM_FOUND ? kr_body_energy(body) : NAN;
    kr_equilibrium_free(q);
    kr_body_free(body);
    kr_bonds_free(bonds);
    kr_nodes_free(nodes);
    return energy;
}

static enum kr_equilibrium_end settle(struct kr_equilibrium *q) {
    return kr_settle(q, 0.8 * kr_time_step_find(q->body, SPACING).stable);
}

/* What static stages call falls back on damped motion where Newton ends without an equilibrium. */
static void test_statics_snap_by_damped_motion(void **state) {
    (void)state;
    const double push = 0.14;
    double off, slowly = by_stage(push, 100, &off), newton = by_few_steps(push, 4, kr_equilibrium_find);
    assert_true(isnan(newton));
    kr_check_near(by_few_steps(push, 4, settle) / slowly, 1, 1e-5);
    /* One step of Newton is not enough from where motion first ends; from nearer by it is. */
    kr_check_near(by_few_steps(push, 1, settle) / slowly, 1, 1e-5);
    assert_int_equal(kr_memory_outstanding(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_statics_snap),
                                       cmocka_unit_test(test_statics_snap_by_damped_motion)};
    kr_run_tests(tests);
}
