/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Stress and strain: both are those of Hooke's law under a uniform strain; strain sees no rotation;
 * stress and strain hold the energy; in equilibrium stress carries the load past a hole, and is
 * Kirsch's beside it.
 */
#include "test.h"

#include "equilibrium.h"
#include "plates.h"
#include "stress.h"
#include "surface.h"

static const double SPACING = 0.1e-3, HORIZON = 0.3001e-3;

/* A body whose factors make the energy of an isotropic strain right at each node. */
static struct kr_body *body_of(struct kr_nodes *nodes, int model) {
    struct kr_material material = kr_pmma(model, HORIZON);
    kr_surface_correct(nodes, &material, KR_PARTIAL_VOLUME_HHB, KR_ISOTROPIC);
    struct kr_bonds *bonds = kr_bonds_create(nodes, &material, KR_PARTIAL_VOLUME_HHB);
    kr_nodes_free(nodes);
    return kr_body_create(bonds);
}

static void free_body(struct kr_body *body) {
    struct kr_bonds *bonds = body->bonds;
    kr_body_free(body);
    kr_bonds_free(bonds);
}

/* u = (G) x */
static void deform(struct kr_body *body, double g[3][3]) {
    for (int d = 0; d < body->dim; d++)
        for (size_t i = 0; i < body->n; i++) {
            body->u[d][i] = 0;
            for (int e = 0; e < body->dim; e++)
                body->u[d][i] += g[d][e] * body->bonds->x[e][i];
        }
}

/* Green's strain of the gradient, component k of a tensor. */
static double green(int dim, double g[3][3], int k) {
    static const int row[] = {0, 0, 0, 1, 1, 2}, column[] = {0, 1, 2, 1, 2, 2};
    int i = row[k], j = column[k];
    double sum = 0;
    for (int l = 0; l < dim; l++)
        sum += 0.5 * g[l][i] * g[l][j];
    return i < dim && j < dim ? sum + 0.5 * (g[i][j] + g[j][i]) : 0;
}

static double worst_strain(const struct kr_body *body, double g[3][3]) {
    double strain[KR_LANES][KR_TENSOR], worst = 0;
    for (size_t slice = 0; slice < body->bonds->n_slices; slice++) {
        kr_strain_slice(body, slice, strain);
        for (size_t i = slice * KR_LANES; i < body->n && i < (slice + 1) * KR_LANES; i++)
            for (int k = 0; k < KR_TENSOR; k++)
                worst = fmax(worst, fabs(strain[i % KR_LANES][k] - green(body->dim, g, k)));
    }
    return worst;
}

/* Sums of some 100 terms of doubles. */
static void strain_is_greens(struct kr_body *body) {
    double g[3][3] = {{3e-3, -2e-3, 1e-3}, {4e-3, -1e-3, 2e-3}, {-1e-3, 3e-3, 2e-3}};
    double turn[3][3] = {{cos(0.3) - 1, -sin(0.3), 0}, {sin(0.3), cos(0.3) - 1, 0}, {0, 0, 0}};
    deform(body, g);
    kr_check_near(worst_strain(body, g), 0, 1e-12);
    deform(body, turn);
    kr_check_near(worst_strain(body, turn), 0, 1e-12);
}

static void test_stress_strain_is_greens(void **state) {
    (void)state;
    struct kr_body *plate = body_of(kr_plate_porous(30, 30, SPACING, 6 * SPACING, 0.2, 3), KR_PLANE_STRESS);
    struct kr_body *block = body_of(kr_plate_block(9, 8, 10, SPACING, 3), KR_SOLID);
    strain_is_greens(plate);
    strain_is_greens(block);
    free_body(plate);
    free_body(block);
}

/* Whether the node's family is full. */
static int is_full(const struct kr_body *body, size_t i, const double *high) {
    int full = 1;
    for (int d = 0; d < body->dim; d++)
        full &= fmin(body->bonds->x[d][i], high[d] - body->bonds->x[d][i]) > HORIZON + SPACING;
    return full;
}

/* One factor for all nodes, with which a full family holds the energy of Hooke's law under an isotropic
 * strain. Its stress is then Hooke's too, E e/(1 - nu) or in 3D E e/(1 - 2 nu), on the diagonal and nothing
 * beside it. */
static void hooke(struct kr_body *body, size_t middle, const double *high, double stiffness) {
    const double e = 1e-7;
    double g[3][3] = {{e, 0, 0}, {0, e, 0}, {0, 0, e}}, stress[KR_LANES][KR_TENSOR], worst = 0;
    size_t inside = 0;
    deform(body, g);
    for (size_t i = 0; i < body->n; i++)
        body->bonds->factor[i] = 1;
    kr_body_energy(body);
    double factor = 0.5 * body->dim * stiffness * e * e / body->energy[middle];
    for (size_t i = 0; i < body->n; i++)
        body->bonds->factor[i] = factor;
    for (size_t slice = 0; slice < body->bonds->n_slices; slice++) {
        kr_stress_slice(body, slice, stress);
        for (size_t i = slice * KR_LANES; i < body->n && i < (slice + 1) * KR_LANES; i++) {
            if (!is_full(body, i, high))
                continue;
            inside++;
            for (int k = 0; k < KR_TENSOR; k++) {
                int diagonal = k == 0 || k == 3 || (k == 5 && body->dim == 3);
                worst = fmax(worst, fabs(stress[i % KR_LANES][k] / (stiffness * e) - diagonal));
            }
        }
    }
    kr_figure("%dD: stress of %zu nodes off Hooke's by %.1e (factor %.4f)", body->dim, inside, worst, factor);
    assert_true(inside > 50);
    /* Off by the strain, and by the polynomial that stands for the law in the energy. */
    kr_check_near(worst, 0, 10 * e);
    kr_check_near(factor, 1, 0.1); /* what is lost by the spacing */
}

static void test_stress_is_hookes(void **state) {
    (void)state;
    struct kr_body *plate = body_of(kr_plate_lattice(40, 41, SPACING), KR_PLANE_STRESS);
    struct kr_body *block = body_of(kr_block_lattice(15, 16, 17, SPACING), KR_SOLID);
    hooke(plate, 20 * 40 + 20, (const double[]){40 * SPACING, 41 * SPACING}, KR_PMMA_MODULUS / (1 - 1.0 / 3));
    hooke(block, (8 * 16 + 8) * 15 + 7, (const double[]){15 * SPACING, 16 * SPACING, 17 * SPACING}, KR_PMMA_MODULUS / (1 - 2.0 / 4));
    free_body(plate);
    free_body(block);
}

/* Half of stress times strain is the energy density, at each node, whatever its family; off by the
 * strain. */
static void test_stress_holds_the_energy(void **state) {
    (void)state;
    const double factor[] = {0.5, 1, 1, 0.5, 1, 0.5};
    double g[3][3] = {{3e-7, -2e-7, 1e-7}, {4e-7, -1e-7, 2e-7}, {-1e-7, 3e-7, 2e-7}}, worst = 0;
    double stress[KR_LANES][KR_TENSOR];
    struct kr_body *body = body_of(kr_plate_block(9, 8, 10, SPACING, 3), KR_SOLID);
    deform(body, g);
    kr_body_energy(body);
    for (size_t slice = 0; slice < body->bonds->n_slices; slice++) {
        kr_stress_slice(body, slice, stress);
        for (size_t i = slice * KR_LANES; i < body->n && i < (slice + 1) * KR_LANES; i++) {
            double held = 0;
            for (int k = 0; k < KR_TENSOR; k++)
                held += factor[k] * stress[i % KR_LANES][k] * green(3, g, k);
            worst = fmax(worst, fabs(held / body->energy[i] - 1));
        }
    }
    kr_figure("half of stress times strain off the energy by %.1e", worst);
    kr_check_near(worst, 0, 1e-5);
    free_body(body);
}

/* ---- a plate with a hole, pulled ---- */

struct pulled {
    struct kr_body *body;
    struct kr_equilibrium *q;
    double size, radius;
};

static struct pulled pull_plate(void) {
    const size_t across = 140;
    struct pulled p = {.size = (double)across * SPACING, .radius = 14 * SPACING};
    p.body = body_of(kr_plate_porous(across, across, SPACING, p.radius, 0, 1), KR_PLANE_STRESS);
    p.q = kr_equilibrium_create(p.body);
    p.q->quiet = 1;
    p.q->tolerance = 1e-8;
    for (size_t i = 0; i < p.body->n; i++) {
        double y = p.body->bonds->x[1][i];
        int end = y < HORIZON || y > p.size - HORIZON;
        /* Rollers, so that Poisson's contraction is free; one node does not slide. */
        p.q->rest->fixed[i] = end ? (unsigned char)(2 | (i == across / 2)) : 0;
        p.q->move[1][i] = end ? 1e-5 * (y - 0.5 * p.size) : 0;
    }
    assert_int_equal(kr_equilibrium_find(p.q), KR_EQUILIBRIUM_FOUND);
    return p;
}

static void end_pull(struct pulled *p) {
    kr_equilibrium_free(p->q);
    free_body(p->body);
}

/* The virial: in equilibrium the sum of V sigma_yy is that of the supports' forces times where they are. */
static void check_virial(const struct pulled *p) {
    const struct kr_body *b = p->body;
    double stress[KR_LANES][KR_TENSOR], held = 0, pulled = 0;
    for (size_t slice = 0; slice < b->bonds->n_slices; slice++) {
        kr_stress_slice(b, slice, stress);
        for (size_t i = slice * KR_LANES; i < b->n && i < (slice + 1) * KR_LANES; i++) {
            double volume = b->bonds->volume[i];
            held += volume * stress[i % KR_LANES][3];
            pulled -= volume * b->force[1][i] * (b->bonds->x[1][i] + b->u[1][i]);
        }
    }
    kr_figure("sum of V sigma_yy off that of the supports by %.1e", held / pulled - 1);
    kr_check_near(held / pulled, 1, 1e-7);
}

/* sigma_yy at (x, y) from the middle of the hole over the mean stress of the whole plate. */
static double stress_at(const struct pulled *p, double x, double y) {
    const struct kr_body *b = p->body;
    double stress[KR_LANES][KR_TENSOR], mean = 0, value = 0, nearest = INFINITY;
    for (size_t i = 0; i < b->n; i++)
        mean -= b->bonds->x[1][i] > 0.5 * p->size ? b->bonds->volume[i] * b->force[1][i] : 0;
    for (size_t i = 0; i < b->n; i++) {
        double away = hypot(b->bonds->x[0][i] - 0.5 * p->size - x, b->bonds->x[1][i] - 0.5 * p->size - y);
        if (away >= nearest)
            continue;
        nearest = away;
        kr_stress_slice(b, i / KR_LANES, stress);
        value = stress[i % KR_LANES][3];
    }
    return value / (mean / p->size);
}

/* Kirsch (1898): sigma_yy on the axis across the pull and on the one along it, r from the middle. The hole
 * takes a fifth of the width (some 3 % more), and has jagged rims of a seventh of its radius. */
static void check_kirsch(const struct pulled *p) {
    const double far[] = {1.5, 2, 3};
    for (int k = 0; k < 3; k++) {
        double a2 = 1 / (far[k] * far[k]), a4 = a2 * a2, r = far[k] * p->radius;
        double across = 1 + 0.5 * a2 + 1.5 * a4, along = 1 - 2.5 * a2 + 1.5 * a4;
        double got[2] = {stress_at(p, r, 0), stress_at(p, 0, r)};
        kr_figure("at %.1f radii: across %.3f (Kirsch %.3f), along %.3f (%.3f)", far[k], got[0], across,
                  got[1], along);
        kr_check_near(got[0], across, 0.08 * across);
        kr_check_near(got[1], along, 0.08);
    }
}

static void test_stress_around_a_hole(void **state) {
    (void)state;
    struct pulled p = pull_plate();
    check_virial(&p);
    check_kirsch(&p);
    end_pull(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stress_strain_is_greens),
        cmocka_unit_test(test_stress_is_hookes),
        cmocka_unit_test(test_stress_holds_the_energy),
        cmocka_unit_test(test_stress_around_a_hole),
    };
    kr_run_tests(tests);
}
