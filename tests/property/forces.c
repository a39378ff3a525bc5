/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What every law must hold on every node set: no force at rest, under translation or rotation; no
 * force or moment on the whole; force = - gradient of the energy; the product is the force's
 * derivative and symmetric. On a plate with a hole among
 * unequal cells, random or corrected surface factors, and a cut; on a block of cubes, half of them
 * unequal.
 */
#include "test.h"

#include "base/memory.h"
#include "plates.h"
#include "precrack.h"

static const double SPACING = 0.1e-3, HORIZON = 0.37e-3;

struct subject {
    const char *name;
    struct kr_bonds *bonds;
    struct kr_body *body;
};

static struct subject finish(const char *name, struct kr_nodes *nodes,
                             const struct kr_material *material) {
    struct subject s = {.name = name};
    s.bonds = kr_bonds_create(nodes, material, KR_PARTIAL_VOLUME_HHB);
    s.body = kr_body_create(s.bonds);
    kr_nodes_free(nodes);
    return s;
}

static struct kr_material material_of(const struct kr_law *law) {
    return kr_material_make(law, KR_PLANE_STRESS, KR_PMMA_MODULUS, KR_PMMA_DENSITY,
                            KR_PMMA_FRACTURE_ENERGY, HORIZON);
}

static struct subject plate(const struct kr_law *law, int corrected) {
    const double from[2] = {-1e-3, 1.7e-3}, to[2] = {1.5e-3, 1.6e-3};
    struct kr_material material = material_of(law);
    struct kr_nodes *nodes =
        kr_plate_porous(53, 37, SPACING, 5.3 * SPACING, corrected ? 0.1 : 0.3, 3);
    if (corrected)
        kr_surface_correct(nodes, &material, KR_PARTIAL_VOLUME_HHB, KR_ISOTROPIC);
    else
        kr_plate_random_factors(nodes, 7);
    struct subject s = finish(corrected ? "corrected plate" : "plate", nodes, &material);
    kr_precrack_cut_line(s.bonds, from, to, 1);
    return s;
}

static struct subject block(const struct kr_law *law) {
    struct kr_material material = material_of(law);
    struct kr_nodes *nodes = kr_plate_block(11, 10, 9, 1.3 * SPACING, 3);
    kr_plate_random_factors(nodes, 7);
    return finish("block", nodes, &material);
}

static void for_every_subject(void (*check)(struct subject *)) {
    for (size_t k = 0; k < kr_laws_count; k++)
        for (int kind = 0; kind < 3; kind++) {
            struct subject s = kind < 2 ? plate(kr_laws[k], kind) : block(kr_laws[k]);
            check(&s);
            kr_body_free(s.body);
            kr_bonds_free(s.bonds);
        }
}

static double size_of(const struct kr_body *body, double *const v[3], size_t i) {
    double square = 0;
    for (int d = 0; d < body->dim; d++)
        square += v[d][i] * v[d][i];
    return sqrt(square);
}

static double largest_force(const struct kr_body *body) {
    double most = 0;
    for (size_t i = 0; i < body->n; i++)
        most = fmax(most, size_of(body, body->force, i));
    return most;
}

/* Equal displacements have no difference, not even a rounded one: the force is just 0. */
static void check_translation(struct subject *s) {
    const double shift[3] = {0.317e-3, -0.711e-3, 0.129e-3};
    for (int moved = 0; moved < 2; moved++) {
        for (int d = 0; d < s->body->dim; d++)
            for (size_t i = 0; i < s->body->n; i++)
                s->body->u[d][i] = moved * shift[d];
        kr_body_force(s->body, 0);
        assert_true(largest_force(s->body) == 0);
    }
}

static void test_no_force_at_rest_or_moved(void **state) {
    (void)state;
    for_every_subject(check_translation);
}

static void turn(struct kr_body *body, double angle) {
    for (size_t i = 0; i < body->n; i++) {
        double x = body->bonds->x[0][i], y = body->bonds->x[1][i];
        body->u[0][i] = (cos(angle) - 1) * x - sin(angle) * y;
        body->u[1][i] = sin(angle) * x + (cos(angle) - 1) * y;
        if (body->dim == 3)
            body->u[2][i] = 0;
    }
}

/* Displacements of some 4 mm are rounded to 4e-19 m and bonds are 0.05 mm or longer: stretches are
 * wrong by 2e-14 at the most, and so is the force, of that under a strain of 1. */
static void check_rotation(struct subject *s) {
    const double angle[2] = {0.1, 0.77};
    for (size_t i = 0; i < s->body->n; i++)
        s->body->u[0][i] = 1e-6 * s->bonds->x[0][i], s->body->u[1][i] = 0;
    kr_body_force(s->body, 0);
    double stretched = largest_force(s->body) / 1e-6;
    for (int k = 0; k < 2; k++) {
        turn(s->body, angle[k]);
        kr_body_force(s->body, 0);
        kr_figure("%s turned by %g: force %.1e of that under a strain of 1", s->name, angle[k],
                  largest_force(s->body) / stretched);
        kr_check_near(largest_force(s->body) / stretched, 0, 2e-14);
    }
}

static void test_no_force_under_rotation(void **state) {
    (void)state;
    for_every_subject(check_rotation);
}

/* Both ends of a bond pull alike but for rounding, of 2^-48 in 1/|xi| (kernel.c). */
static void check_momentum(struct subject *s) {
    double sum[3] = {0}, moment = 0, all = 0;
    const struct kr_body *b = s->body;
    kr_plate_shake(s->body, 1e-3 * SPACING, 21);
    kr_body_force(s->body, 0);
    for (size_t i = 0; i < b->n; i++) {
        double volume = s->bonds->volume[i];
        for (int d = 0; d < b->dim; d++)
            sum[d] += volume * b->force[d][i];
        moment += volume * ((s->bonds->x[0][i] + b->u[0][i]) * b->force[1][i] -
                            (s->bonds->x[1][i] + b->u[1][i]) * b->force[0][i]);
        all += volume * size_of(b, b->force, i);
    }
    double length = 50 * SPACING;
    kr_figure("%s: force on the whole %.1e, moment %.1e of all", s->name,
              (fabs(sum[0]) + fabs(sum[1]) + fabs(sum[2])) / all, moment / (all * length));
    for (int d = 0; d < 3; d++)
        kr_check_near(sum[d] / all, 0, 1e-12);
    kr_check_near(moment / (all * length), 0, 1e-12);
}

static void test_momentum_is_kept(void **state) {
    (void)state;
    for_every_subject(check_momentum);
}

/* Central differences over h = 1e-2 of the displacements a. Rounding of the total energy, of order
 * K a^2 N 1e-16, is 1e-16 N a/h = 3e-11 of the force K a; the third derivative adds h^2/(a dx) =
 * 1e-7. */
static void check_gradient(struct subject *s) {
    const double size = 1e-3 * SPACING, h = 1e-2 * size;
    uint64_t seed = 99;
    double mean = 0, worst = 0;
    kr_plate_shake(s->body, size, 22);
    kr_body_force(s->body, 0);
    for (size_t i = 0; i < s->body->n; i++)
        mean += s->bonds->volume[i] * size_of(s->body, s->body->force, i) / (double)s->body->n;
    for (int k = 0; k < 100; k++) {
        size_t i = (size_t)kr_random(&seed, 0, (double)s->body->n);
        double *u = &s->body->u[k % s->body->dim][i], at = *u;
        *u = at + h;
        double above = kr_body_energy(s->body);
        *u = at - h;
        double below = kr_body_energy(s->body);
        *u = at;
        double force = s->body->force[k % s->body->dim][i] * s->bonds->volume[i];
        worst = fmax(worst, fabs((below - above) / (2 * h) - force) / mean);
    }
    kr_figure("%s: energy's gradient off the force by %.1e", s->name, worst);
    kr_check_near(worst, 0, 1e-6);
}

static void test_force_is_the_energys_gradient(void **state) {
    (void)state;
    for_every_subject(check_gradient);
}

/* Two directions and what comes of them. */
struct directions {
    double *v[2][3], *product[2][3];
};

static struct directions directions_create(struct subject *s) {
    struct directions all;
    uint64_t seed = 5;
    for (int k = 0; k < 2; k++)
        for (int d = 0; d < s->body->dim; d++) {
            all.v[k][d] = kr_bonds_padded(s->body->n);
            all.product[k][d] = kr_bonds_padded(s->body->n);
            for (size_t i = 0; i < s->body->n; i++)
                all.v[k][d][i] = SPACING * kr_random(&seed, -1, 1);
        }
    for (int k = 0; k < 2; k++)
        kr_body_product(s->body, all.v[k], all.product[k]);
    return all;
}

static void directions_free(struct directions *all, int dim) {
    for (int k = 0; k < 2; k++)
        for (int d = 0; d < dim; d++) {
            kr_bonds_padded_free(all->v[k][d]);
            kr_bonds_padded_free(all->product[k][d]);
        }
}

/* Adds h v to the displacements and returns the forces there in arrays of their own. */
static void force_moved(struct subject *s, double *const v[3], double h, double *force[3]) {
    for (int d = 0; d < s->body->dim; d++)
        for (size_t i = 0; i < s->body->n; i++)
            s->body->u[d][i] += h * v[d][i];
    kr_body_force(s->body, 0);
    for (int d = 0; d < s->body->dim; d++) {
        force[d] = KR_NEW(double, s->body->n);
        memcpy(force[d], s->body->force[d], s->body->n * sizeof(double));
    }
}

/* Central differences over h v, |v| <= dx: h = 1e-5 leaves h^2 = 1e-10 of the third derivative, and
 * of rounding the forces' 1e-15 (of strains 1e-3) over h: 1e-13. Tension and pressure of 1e-2 on
 * average, so that the part which turns with the bonds counts. */
static void check_product(struct subject *s) {
    const double h = 1e-5;
    double *above[3], *below[3], worst = 0, most = 0, symmetric[2] = {0};
    for (int sign = -1; sign <= 1; sign += 2) {
        kr_plate_shake(s->body, 1e-3 * SPACING, 23);
        for (size_t i = 0; i < s->body->n; i++)
            s->body->u[0][i] += sign * 1e-2 * s->bonds->x[0][i];
        struct directions all = directions_create(s);
        force_moved(s, all.v[0], h, above);
        force_moved(s, all.v[0], -2 * h, below);
        for (int d = 0; d < s->body->dim; d++) {
            for (size_t i = 0; i < s->body->n; i++) {
                double quotient = (above[d][i] - below[d][i]) / (2 * h);
                worst = fmax(worst, fabs(quotient - all.product[0][d][i]));
                most = fmax(most, fabs(quotient));
                for (int k = 0; k < 2; k++)
                    symmetric[k] +=
                        s->bonds->volume[i] * all.v[k][d][i] * all.product[1 - k][d][i];
            }
            kr_free(above[d]);
            kr_free(below[d]);
        }
        directions_free(&all, s->body->dim);
    }
    kr_figure("%s: product off the force's difference quotient by %.1e, asymmetry %.1e", s->name,
              worst / most, symmetric[0] / symmetric[1] - 1);
    kr_check_near(worst / most, 0, 1e-8);
    /* Two random vectors: of n products that cancel to their root, 2^-48 of each. */
    kr_check_near(symmetric[0] / symmetric[1], 1, 1e-11);
}

static void test_product_is_the_forces_derivative(void **state) {
    (void)state;
    for_every_subject(check_product);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_force_at_rest_or_moved),
        cmocka_unit_test(test_no_force_under_rotation),
        cmocka_unit_test(test_momentum_is_kept),
        cmocka_unit_test(test_force_is_the_energys_gradient),
        cmocka_unit_test(test_product_is_the_forces_derivative),
    };
    kr_run_tests(tests);
}
