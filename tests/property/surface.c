/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Surface factors: under the deformation they were made for, every node holds the energy of a full
 * family; in the bulk they are what the lattice's sum asks for; what cannot be corrected stops.
 */
#include "test.h"

#include "base/error.h"
#include "plates.h"

static const double SPACING = 0.1e-3, HORIZON = 0.3e-3, STRAIN = 1e-4;

/* W_i of a body stretched by these strains, added to `sum` with a share. */
static void add_energy(struct kr_body *body, double x, double y, double share, double *sum) {
    for (size_t i = 0; i < body->n; i++) {
        body->u[0][i] = x * body->bonds->x[0][i];
        body->u[1][i] = y * body->bonds->x[1][i];
    }
    kr_body_energy(body);
    for (size_t i = 0; i < body->n; i++)
        sum[i] += share * body->energy[i];
}

static void add_deformation(struct kr_body *body, int deformation, double *sum) {
    double half = deformation == KR_MEAN_OVER_AXES ? 0.5 : 1;
    if (deformation == KR_ISOTROPIC)
        add_energy(body, STRAIN, STRAIN, 1, sum);
    if (deformation == KR_UNIAXIAL_X || deformation == KR_MEAN_OVER_AXES)
        add_energy(body, STRAIN, 0, half, sum);
    if (deformation == KR_UNIAXIAL_Y || deformation == KR_MEAN_OVER_AXES)
        add_energy(body, 0, STRAIN, half, sum);
}

/* The iteration ends at 1e-7; its residual is carried along and drifts from the true one by
 * rounding only. */
static void check_energy(const struct kr_law *law, int model, int deformation) {
    struct kr_material material =
        kr_material_make(law, model, KR_PMMA_MODULUS, KR_PMMA_DENSITY, 0, HORIZON);
    struct kr_nodes *nodes = kr_plate_porous(48, 40, SPACING, 4.7 * SPACING, 0.1, 3);
    struct kr_surface_report report =
        kr_surface_correct(nodes, &material, KR_PARTIAL_VOLUME_HHB, deformation);
    struct kr_bonds *bonds = kr_bonds_create(nodes, &material, KR_PARTIAL_VOLUME_HHB);
    struct kr_body *body = kr_body_create(bonds);
    double *energy = KR_NEW(double, nodes->n), worst = 0;
    double reference = kr_surface_reference(&material, 2, KR_PARTIAL_VOLUME_HHB, deformation);
    char name[32];
    add_deformation(body, deformation, energy);
    for (size_t i = 0; i < nodes->n; i++)
        worst = fmax(worst, fabs(energy[i] / reference - 1));
    kr_case_word(KR_DEFORMATION_WORDS, deformation, name);
    kr_figure("%s nu %.2f %-14s: factors %.3f to %.3f in %d iterations, energies off by %.1e",
              law->name, material.poissons_ratio, name, report.least, report.most,
              report.iterations, worst);
    kr_check_near(worst, 0, 1e-6);
    kr_free(energy);
    kr_body_free(body);
    kr_bonds_free(bonds);
    kr_nodes_free(nodes);
}

static void test_surface_energy_is_that_of_the_bulk(void **state) {
    (void)state;
    for (size_t k = 0; k < kr_laws_count; k++)
        for (int model = KR_PLANE_STRESS; model <= KR_PLANE_STRAIN; model++)
            for (int deformation = KR_UNIAXIAL_Y; deformation <= KR_MEAN_OVER_AXES; deformation++)
                check_energy(kr_laws[k], model, deformation);
}

enum { SIDE = 101 };

/* Cells between node i of the lattice and the nearest edge. */
static int depth_of(size_t i) {
    int x = (int)(i % SIDE), y = (int)(i / SIDE);
    int near_x = x < SIDE - 1 - x ? x : SIDE - 1 - x, near_y = y < SIDE - 1 - y ? y : SIDE - 1 - y;
    return near_x < near_y ? near_x : near_y;
}

/* Factors are never quite equal in the bulk. lambda_i plus the mean of its family's lambda is twice
 * the bulk's; what edges leave over are waves with mean(e^(k x)) = -1. For m = 3, weights by the
 * bonds' energies under strain along x, the one of longest reach has k = (0.429 + 1.30 i)/spacing
 * (found by Newton's iteration). So the factors differ by about e^(-0.429 n), n cells from the
 * edge: 1 % at 11 cells (4 horizons), 1e-7 at 40. Corners, the worst, begin with 3.5: 5 covers it.
 */
static void test_surface_factors_fade_into_the_bulk(void **state) {
    struct kr_material material = kr_pmma(KR_PLANE_STRESS, HORIZON);
    struct kr_nodes *nodes = kr_plate_lattice(SIDE, SIDE, SPACING);
    double off[SIDE] = {0};
    (void)state;
    kr_surface_correct(nodes, &material, KR_PARTIAL_VOLUME_HHB, KR_UNIAXIAL_Y);
    double bulk = nodes->factor[kr_plate_middle(SIDE, SIDE)];
    for (size_t i = 0; i < nodes->n; i++)
        off[depth_of(i)] = fmax(off[depth_of(i)], fabs(nodes->factor[i] / bulk - 1));
    for (int n = 0; n <= SIDE / 2; n++) {
        if (n % 10 == 0)
            kr_figure("%2d cells from the edge: factors off the middle's by %.1e", n, off[n]);
        kr_check_near(off[n], 0, 5 * exp(-0.429 * n) + 1e-7);
    }
    /* The middle's own value: W0 over the energy of its family with lambda = 1. */
    for (size_t i = 0; i < nodes->n; i++)
        nodes->factor[i] = 1;
    struct kr_bonds *bonds = kr_bonds_create(nodes, &material, KR_PARTIAL_VOLUME_HHB);
    struct kr_body *body = kr_body_create(bonds);
    double *energy = KR_NEW(double, nodes->n);
    add_deformation(body, KR_UNIAXIAL_Y, energy);
    double reference = kr_surface_reference(&material, 2, KR_PARTIAL_VOLUME_HHB, KR_UNIAXIAL_Y);
    kr_check_near(bulk, reference / energy[kr_plate_middle(SIDE, SIDE)], 1e-7);
    kr_free(energy);
    kr_body_free(body);
    kr_bonds_free(bonds);
    kr_nodes_free(nodes);
}

/* A plate with too coarse a lattice for uniaxial strain, and a wire along x that holds no energy
 * under strain along y at all. */
static void correct(void *argument) {
    int wire = *(int *)argument;
    struct kr_material material = kr_pmma(KR_PLANE_STRESS, HORIZON);
    struct kr_nodes *nodes = wire ? kr_plate_lattice(40, 1, SPACING)
                                  : kr_plate_porous(48, 40, SPACING, 4.7 * SPACING, 0.3, 3);
    kr_surface_correct(nodes, &material, KR_PARTIAL_VOLUME_HHB, KR_UNIAXIAL_Y);
}

static void test_surface_factors_refuse_nonsense(void **state) {
    int wire = 0;
    (void)state;
    kr_check_stops(correct, &wire, KR_EXIT_NUMBERS, "make their bond push");
    wire = 1;
    kr_check_stops(correct, &wire, KR_EXIT_NUMBERS, "iterations, most at the node at (");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_surface_energy_is_that_of_the_bulk),
        cmocka_unit_test(test_surface_factors_fade_into_the_bulk),
        cmocka_unit_test(test_surface_factors_refuse_nonsense),
    };
    kr_run_tests(tests);
}
