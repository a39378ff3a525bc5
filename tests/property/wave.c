/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Plane waves along x: forces give the lattice's own dispersion, sums over all bonds
 *
 *    rho omega^2 = sum_j c w_ij V_j xi_x^2/|xi|^3 (1 - cos(k xi_x))
 *
 * long waves travel at the classical speed, and the time loop swings at that frequency.
 */
#include "test.h"

#include "cases.h"
#include "plates.h"
#include "wave.h"
#include "weight.h"

static const double SPACING = 0.1e-3;

/* Strains so small that the geometry is linear to 1e-9. */
static const double STRAIN = 1e-9;

/* omega^2 of the lattice. */
static double dispersion(const struct kr_material *m, double k) {
    const double volume = SPACING * SPACING;
    int reach = (int)ceil(m->horizon / SPACING) + 1;
    double sum = 0;
    for (int a = -reach; a <= reach; a++)
        for (int b = -reach; b <= reach; b++) {
            double x = a * SPACING, length = hypot(x, b * SPACING);
            if (a)
                sum += m->micromodulus *
                       kr_weight(KR_PARTIAL_VOLUME_HHB, length, m->horizon, SPACING, SPACING) *
                       volume * x * x / pow(length, 3) * (1 - cos(k * x));
        }
    return sum / m->density;
}

/* omega^2 = -a/u of the middle node under u = A sin(k x + phase). */
static double measured(struct kr_body *body, size_t middle, double k) {
    for (size_t i = 0; i < body->n; i++)
        body->u[0][i] = STRAIN / k * sin(k * (body->bonds->x[0][i]) + 0.7);
    kr_body_force(body, 0);
    return -body->force[0][middle] / (body->bonds->material.density * body->u[0][middle]);
}

static void check_waves(const struct kr_law *law, int model, int m) {
    /* Wavelengths in spacings; the shortest that a lattice knows is 2. */
    static const double wavelengths[] = {2, 2.37, 3.1, 5.3, 11.7, 33, 64, 16 * 6, 500};
    size_t side = 2 * (size_t)m + 5;
    struct kr_material material = kr_material_make(law, model, KR_PMMA_MODULUS, KR_PMMA_DENSITY,
                                                   KR_PMMA_FRACTURE_ENERGY, m * SPACING);
    struct kr_nodes *nodes = kr_plate_lattice(side, side, SPACING);
    struct kr_bonds *bonds = kr_bonds_create(nodes, &material, KR_PARTIAL_VOLUME_HHB);
    struct kr_body *body = kr_body_create(bonds);
    struct kr_wave wave = kr_wave_speeds(KR_PMMA_MODULUS, material.poissons_ratio, KR_PMMA_DENSITY,
                                         (enum kr_model)model);
    double worst = 0, worst_speed = 0;
    for (size_t w = 0; w < sizeof wavelengths / sizeof *wavelengths; w++) {
        double k = 2 * M_PI / (wavelengths[w] * SPACING);
        double square = measured(body, kr_plate_middle(side, side), k);
        worst = fmax(worst, fabs(square / dispersion(&material, k) - 1));
        if (wavelengths[w] >= 16 * m)
            worst_speed = fmax(worst_speed, fabs(sqrt(square) / k / wave.longitudinal - 1));
    }
    kr_figure(
        "%s nu %.2f m %d: omega^2 off the lattice's by %.1e, long waves' speed off by %.2f %%",
        law->name, material.poissons_ratio, m, worst, 100 * worst_speed);
    /* Weights are kept in float32, 6e-8. */
    kr_check_near(worst, 0, 1e-7);
    /* m = 4 makes the lattice 1.6 % too stiff (constants.c), 0.8 % in speed; waves of 16 horizons
     * are 0.3 % slow: (k delta)^2 5/144 of omega^2, by the next term of the cosine. */
    kr_check_near(worst_speed, 0, 0.01);
    kr_body_free(body);
    kr_bonds_free(bonds);
    kr_nodes_free(nodes);
}

static void test_waves_have_the_lattices_dispersion(void **state) {
    (void)state;
    for (size_t k = 0; k < kr_laws_count; k++)
        for (int model = KR_PLANE_STRESS; model <= KR_PLANE_STRAIN; model++)
            for (int m = 4; m <= 6; m += 2)
                check_waves(kr_laws[k], model, m);
}

enum { COLUMNS = 81, ROWS = 65, WAVELENGTH = 16 };

/* A body force B sin(k x), suddenly, on the whole of a plate: the middle swings as
 * u = B/(rho omega^2) (1 - cos(omega t)) until news from the edges arrives, 40 spacings off.
 * After 5/4 periods, when sound has gone 20 spacings, u passes its mean. Returns omega/wanted - 1.
 */
static double swing(int steps_a_period) {
    const double k = 2 * M_PI / (WAVELENGTH * SPACING), horizon = 3 * SPACING;
    struct kr_material material = kr_pmma(KR_PLANE_STRESS, horizon);
    const double square = dispersion(&material, k), period = 2 * M_PI / sqrt(square);
    const double pull = KR_PMMA_DENSITY * square * 1e-6 / k;
    const double node = (COLUMNS / 2 + 0.5 - WAVELENGTH / 4.0) * SPACING;
    struct kr_test_case t;
    struct kr_nodes *nodes = kr_plate_lattice(COLUMNS, ROWS, SPACING);
    char *deck = kr_text(KR_TEST_PMMA(0) "solver: {end_time: %.17g s, time_step: %.17g s}\n"
                                         "loads: [{set: plate, body_force: "
                                         "['%.17g*sin(%.17g*(x-%.17g)) N/m^3', free]}]\n",
                         1.25 * period, 1.0000001 * period / steps_a_period, pull, k, node);
    kr_test_sets(nodes, COLUMNS, ROWS);
    kr_test_case_open(&t, nodes, horizon, deck);
    kr_run_solve(t.run, "", 0);
    double u = t.run->body->u[0][kr_plate_middle(COLUMNS, ROWS)] * KR_PMMA_DENSITY * square / pull;
    kr_test_case_close(&t);
    kr_free(deck);
    return asin(u - 1) / (2.5 * M_PI);
}

/* Leapfrog swings at 2/dt asin(omega dt/2), by (omega dt)^2/24 faster. Strains of 1e-6 and the
 * first forerunners of the edges may add 1e-6. */
static void test_waves_swing_in_time(void **state) {
    static const int steps[] = {20, 40, 80, 400};
    double before = 0;
    (void)state;
    for (int s = 0; s < 4; s++) {
        double off = swing(steps[s]), expected = steps[s] / M_PI * asin(M_PI / steps[s]) - 1;
        kr_figure("%d steps a period: frequency off by %.3e, expected %.3e", steps[s], off,
                  expected);
        kr_check_near(off, expected, 1e-6);
        if (before > 0 && s < 3)
            kr_check_near(before / off, 4, 0.1);
        before = off;
    }
    kr_check_near(before, 0, 1e-3);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_waves_have_the_lattices_dispersion),
        cmocka_unit_test(test_waves_swing_in_time),
    };
    kr_run_tests(tests);
}
