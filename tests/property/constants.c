/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The constants of every law, model and profile of the micromodulus: c gives the classical strain
 * energy, the critical stretch the fracture energy, by sums over the bonds that the solver itself
 * makes. Each pair of sums, at a middle node of a lattice:
 *
 *    W  = strain energy density under a small uniaxial strain
 *    G  = energy at s0 of the bonds that cross a line (3D: a plane) between two columns, per length
 *         (area) of it
 */
#include "test.h"

#include "exact.h"
#include "plates.h"

static const double HORIZON = 0.16e-3, STRAIN = 1e-7;

/* One combination of what the constants hang on, on a lattice of m spacings a horizon. */
struct choice {
    const struct kr_law *law;
    int model, profile, m, partial_volume;
};

static int dim_of(const struct choice *c) {
    return c->model == KR_SOLID ? 3 : 2;
}

/* Strain energy density [J/m^3] of a uniaxial strain without sideways motion. */
static double classical_energy(const struct kr_material *m) {
    double nu = m->poissons_ratio, modulus = m->youngs_modulus;
    if (m->model == KR_PLANE_STRESS)
        return modulus * STRAIN * STRAIN / (2 * (1 - nu * nu));
    return modulus * (1 - nu) * STRAIN * STRAIN / (2 * (1 + nu) * (1 - 2 * nu));
}

/* So wide that the middle node's family is whole, and so is each half of the families that meet
 * across the line beside it. */
static size_t width_of(const struct choice *c) {
    return 2 * (size_t)c->m + 5;
}

static struct kr_bonds *make_bonds(const struct choice *c) {
    struct kr_material material =
        kr_material_make(c->law, c->model, KR_PMMA_MODULUS, KR_PMMA_DENSITY,
                         KR_PMMA_FRACTURE_ENERGY, HORIZON);
    kr_material_profile(&material, c->profile);
    size_t width = width_of(c);
    double spacing = HORIZON / c->m;
    struct kr_nodes *nodes = dim_of(c) == 2 ? kr_plate_lattice(width, width, spacing)
                                            : kr_block_lattice(width, width, width, spacing);
    struct kr_bonds *bonds = kr_bonds_create(nodes, &material, c->partial_volume);
    kr_nodes_free(nodes);
    return bonds;
}

static size_t middle_of(const struct choice *c) {
    size_t width = width_of(c), half = width / 2;
    return (dim_of(c) == 3 ? half * width * width : 0) + half * width + half;
}

/* W/W_classical - 1 in the middle, for strain along x. */
static double energy_error(const struct choice *c, struct kr_bonds *bonds) {
    struct kr_body *body = kr_body_create(bonds);
    for (size_t i = 0; i < body->n; i++)
        body->u[0][i] = STRAIN * bonds->x[0][i];
    kr_body_energy(body);
    double w = body->energy[middle_of(c)];
    kr_body_free(body);
    return w / classical_energy(&bonds->material) - 1;
}

/* G/G0 - 1. Every row of the lattice is like the middle one, so the bonds that begin in this row
 * left of the line and end right of it stand for one spacing (square) of the line (plane). */
static double fracture_error(const struct choice *c, const struct kr_bonds *bonds) {
    double spacing = HORIZON / c->m, sum = 0;
    size_t width = width_of(c), middle = middle_of(c), row = middle / width;
    double line = bonds->x[0][middle] + 0.5 * spacing;
    for (size_t slice = row * width / KR_LANES; slice <= (row + 1) * width / KR_LANES; slice++) {
        struct kr_bond_walk walk = kr_bonds_walk(bonds, slice);
        struct kr_bond bond;
        while (kr_bonds_next(bonds, &walk, &bond))
            if (bond.i / width == row && bonds->x[0][bond.i] < line && bonds->x[0][bond.j] > line)
                sum += kr_exact_pair_energy(bonds, &bond, bonds->material.critical_stretch);
    }
    return sum / pow(spacing, dim_of(c) - 1) / bonds->material.fracture_energy - 1;
}

struct errors {
    double energy, fracture;
};

static struct errors errors_of(const struct choice *c) {
    struct kr_bonds *bonds = make_bonds(c);
    struct errors e = {energy_error(c, bonds), fracture_error(c, bonds)};
    char partial[32], model[32], profile[32];
    kr_case_word(KR_PARTIAL_VOLUME_WORDS, c->partial_volume, partial);
    kr_case_word(KR_MODEL_WORDS, c->model, model);
    kr_case_word(KR_MICROMODULUS_WORDS, c->profile, profile);
    kr_figure("%s %-12s %-8s m %2d %-4s: strain energy %+.2f %%, fracture energy %+.2f %%",
              c->law->name, model, profile, c->m, partial, 100 * e.energy, 100 * e.fracture);
    kr_bonds_free(bonds);
    return e;
}

/* What the lattice leaves, h = delta/m.
 *
 * The ramp of hhb is a horizon smeared over one spacing. An integrand r^p cut at delta gains
 * p (p+1) h^2/(24 delta^2) by it; one that falls to zero there as a cone loses
 * (p+1)(p+2) h^2/(48 delta^2). W integrates r^2 (3D: r^3), G r^3 (r^4).
 *
 * G also has the kink of |xi_x| at xi_x = 0, which takes h^2/6 of the integral of c |xi| over that
 * line (plane), over that of c |xi| |xi_x| over all (Euler and Maclaurin): 1 (5/3), for the cone 5/3
 * (5/2), over delta^2.
 *
 * The rest are chance meetings of the circle with the lattice. By Poisson's sum a wave k of the
 * lattice adds at most (p+2) sqrt(2/pi) (2 pi m |k|)^(-3/2) to the integral of r^p in 2D, p = 1 (W)
 * or 2 (G), times its share by direction. All four shortest k give 0.8 m^(-3/2) for both; with the
 * ramp they vanish, and the next twelve give 0.1 (W) and 0.2 (G). The rest of the series is worth
 * another quarter. In 3D it is (p+3) (2 pi m |k|)^(-2); the six shortest give 1.0 and 0.5, the next
 * twelve 0.5 and 0.7 m^(-2), or 0.11 and 0.16 with the ramp. The cone has a kink at the circle and no
 * jump: (p+3)/(2 pi m) of all that in 2D, (p+4)/(2 pi m) in 3D, less than 1/m. */
static void check_errors(const struct choice *c, const struct errors *e) {
    int ramp = c->partial_volume == KR_PARTIAL_VOLUME_HHB, cone = c->profile == KR_CONICAL;
    int solid = c->model == KR_SOLID, p = solid ? 3 : 2;
    double m = c->m, wave = solid ? 2 / (m * m) : pow(m, -1.5);
    double w = ramp ? (cone ? -(p + 1) * (p + 2) / 48.0 : p * (p + 1) / 24.0) : 0;
    double g = ramp ? (cone ? -(p + 2) * (p + 3) / 48.0 : (p + 1) * (p + 2) / 24.0) : 0;
    double kink = solid ? (cone ? 5.0 / 2 : 5.0 / 3) : cone ? 5.0 / 3 : 1;
    double chance = cone ? wave / m : ramp ? wave / 4 : wave;
    kr_check_near(e->energy, w / (m * m), chance);
    kr_check_near(e->fracture, (g - kink / 6) / (m * m), chance);
}

static void for_every_choice(void (*check)(struct choice)) {
    for (size_t k = 0; k < kr_laws_count; k++)
        for (int model = KR_PLANE_STRESS; model <= KR_SOLID; model++)
            for (int profile = KR_CONSTANT; profile <= KR_CONICAL; profile++)
                check((struct choice){.law = kr_laws[k], .model = model, .profile = profile});
}

static void check_coarse(struct choice c) {
    static const int ms[] = {3, 4, 6};
    struct errors before = {INFINITY, INFINITY}, e;
    c.partial_volume = KR_PARTIAL_VOLUME_HHB;
    for (int k = 0; k < 3; k++, before = e) {
        c.m = ms[k];
        e = errors_of(&c);
        check_errors(&c, &e);
        assert_true(fabs(e.energy) < fabs(before.energy));
        assert_true(fabs(e.fracture) < fabs(before.fracture));
    }
    c.partial_volume = KR_PARTIAL_VOLUME_NONE;
    for (int k = 0; k < 3; k++) {
        c.m = ms[k];
        e = errors_of(&c);
        check_errors(&c, &e);
    }
}

static void test_solid_and_plate_constants_on_coarse_lattices(void **state) {
    (void)state;
    for_every_choice(check_coarse);
}

/* As good as the integrals themselves: m = 25 is also what the surface factors take for W0. */
static void check_fine(struct choice c) {
    c.m = c.model == KR_SOLID ? 7 : 25;
    c.partial_volume = KR_PARTIAL_VOLUME_HHB;
    struct errors e = errors_of(&c);
    check_errors(&c, &e);
    kr_check_near(e.energy, 0, c.model == KR_SOLID ? 0.02 : 0.01);
    kr_check_near(e.fracture, 0, c.model == KR_SOLID ? 0.02 : 0.01);
}

static void test_solid_and_plate_constants_on_a_fine_lattice(void **state) {
    (void)state;
    for_every_choice(check_fine);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_solid_and_plate_constants_on_coarse_lattices),
        cmocka_unit_test(test_solid_and_plate_constants_on_a_fine_lattice),
    };
    kr_run_tests(tests);
}
