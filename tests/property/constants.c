/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The constants of every law: the micromodulus gives the classical strain energy, the critical
 * stretch the fracture energy, by sums over the bonds that the solver itself makes. Each pair of
 * sums, at a middle node of a lattice:
 *
 *    W  = strain energy density under a small uniaxial strain
 *    G  = energy at s0 of the bonds that cross a line between two columns, per length of the line
 */
#include "test.h"

#include "exact.h"
#include "plates.h"

static const double HORIZON = 0.16e-3, STRAIN = 1e-7;

/* Strain energy density [J/m^3] of a uniaxial strain without sideways motion. */
static double classical_energy(const struct kr_material *m) {
    double nu = m->poissons_ratio, modulus = m->youngs_modulus;
    if (m->model == KR_PLANE_STRESS)
        return modulus * STRAIN * STRAIN / (2 * (1 - nu * nu));
    return modulus * (1 - nu) * STRAIN * STRAIN / (2 * (1 + nu) * (1 - 2 * nu));
}

/* A lattice so wide that its middle node, and all bonds across a line beside it, are complete. */
static size_t width_of(int m) {
    return 4 * (size_t)m + 5;
}

static struct kr_bonds *make_bonds(const struct kr_law *law, int model, int m, int partial_volume) {
    struct kr_material material = kr_material_make(law, model, KR_PMMA_MODULUS, KR_PMMA_DENSITY,
                                                   KR_PMMA_FRACTURE_ENERGY, HORIZON);
    struct kr_nodes *nodes = kr_plate_lattice(width_of(m), width_of(m), HORIZON / m);
    struct kr_bonds *bonds = kr_bonds_create(nodes, &material, partial_volume);
    kr_nodes_free(nodes);
    return bonds;
}

/* W/W_classical - 1 in the middle, for strain along x. */
static double energy_error(struct kr_bonds *bonds, size_t width) {
    struct kr_body *body = kr_body_create(bonds);
    for (size_t i = 0; i < body->n; i++)
        body->u[0][i] = STRAIN * bonds->x[0][i];
    kr_body_energy(body);
    double w = body->energy[kr_plate_middle(width, width)];
    kr_body_free(body);
    return w / classical_energy(&bonds->material) - 1;
}

/* G/G0 - 1. Every row of the lattice is like the middle one, so the bonds that begin in this row
 * left of the line and end right of it stand for one spacing of the line. */
static double fracture_error(const struct kr_bonds *bonds, size_t width, double spacing) {
    size_t middle = kr_plate_middle(width, width), row = middle / width;
    double line = bonds->x[0][middle] + 0.5 * spacing, sum = 0;
    for (size_t slice = row * width / KR_LANES; slice <= (row + 1) * width / KR_LANES; slice++) {
        struct kr_bond_walk walk = kr_bonds_walk(bonds, slice);
        struct kr_bond bond;
        while (kr_bonds_next(bonds, &walk, &bond))
            if (bond.i / width == row && bonds->x[0][bond.i] < line && bonds->x[0][bond.j] > line)
                sum += kr_exact_pair_energy(bonds, &bond, bonds->material.critical_stretch);
    }
    return sum / spacing / bonds->material.fracture_energy - 1;
}

struct errors {
    double energy, fracture;
};

static struct errors errors_of(const struct kr_law *law, int model, int m, int partial_volume) {
    struct kr_bonds *bonds = make_bonds(law, model, m, partial_volume);
    struct errors e = {energy_error(bonds, width_of(m)),
                       fracture_error(bonds, width_of(m), HORIZON / m)};
    char name[32];
    kr_case_word(KR_PARTIAL_VOLUME_WORDS, partial_volume, name);
    kr_figure("%s nu %.2f m %2d %-4s: strain energy %+.2f %%, fracture energy %+.2f %%", law->name,
              bonds->material.poissons_ratio, m, name, 100 * e.energy, 100 * e.fracture);
    kr_bonds_free(bonds);
    return e;
}

static void for_every_law(void (*check)(const struct kr_law *, int model)) {
    for (size_t k = 0; k < kr_laws_count; k++)
        for (int model = KR_PLANE_STRESS; model <= KR_PLANE_STRAIN; model++)
            check(kr_laws[k], model);
}

/* What the lattice leaves. The ramp of hhb is a horizon smeared over one spacing h; integrands r^2
 * (W) and r^3 (G) gain h^2/(4 delta^2) and h^2/(2 delta^2) by it; the kink of |xi_x| at xi_x = 0
 * takes h^2/(6 delta^2) of G again (Euler and Maclaurin). So W errs by 1/(4 m^2), G by 1/(3 m^2),
 * but for the chance meetings of the circle with the lattice. By Poisson's sum a wave k of the
 * lattice adds at most (p+2) sqrt(2/pi) (2 pi m |k|)^(-3/2) to the integral of r^p, p = 1 (W) or 2
 * (G), times its share by direction. All four shortest k give 0.8 m^(-3/2) for both; with the ramp
 * they vanish, and the next twelve give 0.1 (W) and 0.2 (G). The rest of the series is worth
 * another quarter. */
static void check_errors(const struct errors *e, int m, int partial_volume) {
    double chance = (partial_volume == KR_PARTIAL_VOLUME_HHB ? 0.25 : 1) * pow(m, -1.5);
    int ramp = partial_volume == KR_PARTIAL_VOLUME_HHB;
    kr_check_near(e->energy, ramp * 0.25 / (m * m), chance);
    kr_check_near(e->fracture, ramp / (3.0 * m * m), chance);
}

static void check_coarse(const struct kr_law *law, int model) {
    static const int ms[] = {3, 4, 6};
    struct errors before = {INFINITY, INFINITY}, e;
    for (int k = 0; k < 3; k++, before = e) {
        e = errors_of(law, model, ms[k], KR_PARTIAL_VOLUME_HHB);
        check_errors(&e, ms[k], KR_PARTIAL_VOLUME_HHB);
        assert_true(fabs(e.energy) < fabs(before.energy));
        assert_true(fabs(e.fracture) < fabs(before.fracture));
    }
    for (int k = 0; k < 3; k++) {
        e = errors_of(law, model, ms[k], KR_PARTIAL_VOLUME_NONE);
        check_errors(&e, ms[k], KR_PARTIAL_VOLUME_NONE);
    }
}

static void test_constants_on_coarse_lattices(void **state) {
    (void)state;
    for_every_law(check_coarse);
}

/* As good as the integrals themselves: m = 25 is also what the surface factors take for W0. */
static void check_fine(const struct kr_law *law, int model) {
    struct errors e = errors_of(law, model, 25, KR_PARTIAL_VOLUME_HHB);
    check_errors(&e, 25, KR_PARTIAL_VOLUME_HHB);
    kr_check_near(e.energy, 0, 0.01);
    kr_check_near(e.fracture, 0, 0.01);
}

static void test_constants_on_a_fine_lattice(void **state) {
    (void)state;
    for_every_law(check_fine);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_constants_on_coarse_lattices),
        cmocka_unit_test(test_constants_on_a_fine_lattice),
    };
    kr_run_tests(tests);
}
