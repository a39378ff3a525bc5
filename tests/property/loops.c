/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The fast loop against the readable one, for every build of it that this processor can run, every
 * law, both profiles of the micromodulus, in two and three dimensions, on and off the lattice, with bonds broken and with bonds so far
 * stretched or pressed that slices are done again.
 */
#include "test.h"

#include "base/error.h"
#include "plates.h"
#include "precrack.h"

static const char *const builds[] = {"baseline", "avx2", "avx512"};
static const double SPACING = 0.1e-3;

/* Whether this processor can run a build: kr_kernel_best stops if not. */
static int can_run(const char *build) {
    int status;
    fflush(NULL);
    setenv("KIRSCH_KERNEL", build, 1);
    pid_t child = fork();
    if (child == 0) {
        if (!freopen("/dev/null", "w", stderr))
            _exit(1);
        kr_kernel_best();
        _exit(KR_EXIT_OK);
    }
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == KR_EXIT_OK;
}

/* Largest difference over largest value. */
static double difference(size_t n, const double *a, const double *b) {
    double worst = 0, most = 0;
    for (size_t i = 0; i < n; i++) {
        worst = fmax(worst, fabs(a[i] - b[i]));
        most = fmax(most, fabs(b[i]));
    }
    return worst / most;
}

/* The exact loop at the body's displacements, into arrays of its own; v is some direction. */
static struct kr_kernel_work do_exactly(const struct kr_body *body) {
    struct kr_kernel_work work = {.bonds = body->bonds, .energy = kr_bonds_padded(body->n)};
    for (int d = 0; d < body->dim; d++) {
        work.u[d] = body->u[d];
        work.v[d] = body->v[d];
        work.force[d] = kr_bonds_padded(body->n);
        work.product[d] = kr_bonds_padded(body->n);
    }
    for (size_t slice = 0; slice < body->bonds->n_slices; slice++) {
        kr_exact_force(&work, slice);
        kr_exact_energy(&work, slice);
        kr_exact_product(&work, slice);
    }
    return work;
}

/* Largest relative difference of both loops at the body's displacements. */
static double compare(struct kr_body *body) {
    struct kr_kernel_work exact = do_exactly(body);
    double *product[3] = {0}, worst = 0;
    for (int d = 0; d < body->dim; d++)
        product[d] = kr_bonds_padded(body->n);
    kr_body_force(body, 0);
    kr_body_energy(body);
    kr_body_product(body, body->v, product);
    worst = difference(body->n, body->energy, exact.energy);
    kr_bonds_padded_free(exact.energy);
    for (int d = 0; d < body->dim; d++) {
        worst = fmax(worst, difference(body->n, body->force[d], exact.force[d]));
        worst = fmax(worst, difference(body->n, product[d], exact.product[d]));
        kr_bonds_padded_free(product[d]);
        kr_bonds_padded_free(exact.force[d]);
        kr_bonds_padded_free(exact.product[d]);
    }
    return worst;
}

static size_t flagged(const struct kr_body *body) {
    size_t count = 0;
    for (size_t slice = 0; slice < body->bonds->n_slices; slice++)
        count += body->flag[slice];
    return count;
}

static struct kr_nodes *make_nodes(int dim) {
    struct kr_nodes *nodes = dim == 2 ? kr_plate_porous(61, 43, SPACING, 5.3 * SPACING, 0.3, 3)
                                      : kr_plate_block(19, 13, 17, SPACING, 3);
    kr_plate_random_factors(nodes, 7);
    return nodes;
}

/* The loops share sums of some 50 terms and agree but for rounding and the 1e-13 of the
 * polynomials. */
static void check_build(const char *build, const struct kr_law *law, int dim, int profile,
                        int partial_volume) {
    const double from[2] = {-1e-3, 0.75e-3}, to[2] = {7e-3, 0.65e-3}; /* through twins */
    struct kr_nodes *nodes = make_nodes(dim);
    struct kr_material material =
        kr_material_make(law, dim == 2 ? KR_PLANE_STRESS : KR_SOLID, KR_PMMA_MODULUS, KR_PMMA_DENSITY,
                         KR_PMMA_FRACTURE_ENERGY, (dim == 2 ? 3.7 : 2.3) * SPACING);
    kr_material_profile(&material, profile);
    struct kr_bonds *bonds = kr_bonds_create(nodes, &material, partial_volume);
    struct kr_body *body = kr_body_create(bonds);
    assert_string_equal(body->kernel->name, build);
    if (dim == 2)
        kr_precrack_cut_line(bonds, from, to, 1);
    kr_plate_shake(body, 1e-3 * SPACING, 4);
    for (int d = 0; d < dim; d++) /* some direction for the product */
        for (size_t i = 0; i < body->n; i++)
            body->v[d][i] = SPACING * sin((double)(i * 3 + (size_t)d));
    double worst = compare(body);
    assert_int_equal(flagged(body), 0);
    body->u[0][body->n / 2] += 0.03 * SPACING; /* past s0 and past the range on the other side */
    double stretched = compare(body);
    kr_body_mix(body);
    double mixed = compare(body);
    kr_body_advance(body, 0, 1e-6); /* by some nanometres: rounded anew on the way */
    mixed = fmax(mixed, compare(body));
    assert_true(flagged(body) > 0 && flagged(body) < bonds->n_slices);
    struct kr_bonds_size size = kr_bonds_size(bonds);
    kr_figure("%-8s %s %dD %s, %.0f %% lattice: fast loop off the exact one by %.1e, %.1e, mixed %.1e",
              build, law->name, dim, profile == KR_CONICAL ? "conical" : "constant",
              100 * size.lattice_share, worst, stretched, mixed);
    assert_true(size.lattice_share > 0.02 && size.lattice_share < 0.9);
    kr_check_near(worst, 0, 1e-12);
    kr_check_near(stretched, 0, 1e-12);
    /* float32 rounds each of some 50 terms to 6e-8, and e, which they are made of, as much again. */
    kr_check_near(mixed, 0, 3e-6);
    assert_true(mixed > 1e-9); /* it is another loop */
    kr_body_free(body);
    kr_bonds_free(bonds);
    kr_nodes_free(nodes);
}

static void test_fast_loop_is_the_exact_one(void **state) {
    (void)state;
    for (size_t k = 0; k < sizeof builds / sizeof builds[0]; k++) {
        if (!can_run(builds[k])) {
            kr_figure("%-8s cannot run here", builds[k]);
            continue;
        }
        for (size_t law = 0; law < kr_laws_count; law++)
            for (int dim = 2; dim <= 3; dim++)
                for (int profile = KR_CONSTANT; profile <= KR_CONICAL; profile++) {
                    check_build(builds[k], kr_laws[law], dim, profile, KR_PARTIAL_VOLUME_HHB);
                    check_build(builds[k], kr_laws[law], dim, profile, KR_PARTIAL_VOLUME_NONE);
                }
    }
    unsetenv("KIRSCH_KERNEL");
}

static void ask_for_nonsense(void *argument) {
    setenv("KIRSCH_KERNEL", argument, 1);
    kr_kernel_best();
}

static void test_unknown_build_stops(void **state) {
    (void)state;
    kr_check_stops(ask_for_nonsense, "avx3", KR_EXIT_INPUT, "KIRSCH_KERNEL is 'avx3'");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fast_loop_is_the_exact_one),
        cmocka_unit_test(test_unknown_build_stops),
    };
    kr_run_tests(tests);
}
