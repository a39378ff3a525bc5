/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Families, pre-cracks and damage against brute force over all pairs of nodes, on a plate with a
 * hole among unequal cells.
 */
#include "test.h"

#include "plates.h"
#include "precrack.h"
#include "weight.h"

enum { COLUMNS = 41, ROWS = 34 };
static const double SPACING = 0.1e-3, HORIZON = 0.37e-3;

/* Weights are kept in float32: 24 bits. */
static const double FLOAT32 = 6e-8;

/* Where the crack runs: past nodes, not through them. */
static const double FROM[2] = {-0.2e-3, 1.713e-3}, TO[2] = {1.337e-3, 1.481e-3};

struct plate {
    struct kr_nodes *nodes;
    struct kr_bonds *bonds;
    int partial_volume;
    unsigned char *seen; /* (n x n): living bonds from i to j */
};

static struct plate plate_make(int partial_volume) {
    struct plate p = {.partial_volume = partial_volume};
    struct kr_material material = kr_pmma(KR_PLANE_STRESS, HORIZON);
    p.nodes = kr_plate_porous(COLUMNS, ROWS, SPACING, 5.3 * SPACING, 0.3, 11);
    p.bonds = kr_bonds_create(p.nodes, &material, partial_volume);
    p.seen = KR_NEW(unsigned char, p.nodes->n *p.nodes->n);
    return p;
}

static void plate_free(struct plate *p) {
    kr_free(p->seen);
    kr_bonds_free(p->bonds);
    kr_nodes_free(p->nodes);
}

/* The weight of a pair from the definition; 0: no bond. */
static double brute_weight(const struct plate *p, size_t i, size_t j) {
    const double *x = p->nodes->position;
    double length = hypot(x[2 * j] - x[2 * i], x[2 * j + 1] - x[2 * i + 1]);
    return i == j ? 0
                  : kr_weight(p->partial_volume, length, HORIZON, sqrt(p->nodes->volume[i]),
                              sqrt(p->nodes->volume[j]));
}

/* Count every living bond into `seen` and hold its geometry against the definition. */
static void look(struct plate *p) {
    struct kr_bond bond;
    memset(p->seen, 0, p->nodes->n * p->nodes->n);
    for (size_t slice = 0; slice < p->bonds->n_slices; slice++) {
        struct kr_bond_walk walk = kr_bonds_walk(p->bonds, slice);
        while (kr_bonds_next(p->bonds, &walk, &bond)) {
            const double *from = p->nodes->position + 2 * bond.i;
            const double *to = p->nodes->position + 2 * bond.j;
            p->seen[bond.i * p->nodes->n + bond.j]++;
            kr_check_near(bond.weight, brute_weight(p, bond.i, bond.j), FLOAT32);
            /* Of two coordinates of at most 4 mm each with 2^-53 rounding. */
            for (int d = 0; d < 2; d++)
                kr_check_near(bond.xi[d], to[d] - from[d], 4e-3 * 2.3e-16);
        }
    }
}

static size_t check_families(int partial_volume) {
    struct plate p = plate_make(partial_volume);
    size_t n = p.nodes->n, bonds = 0;
    look(&p);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            assert_int_equal(p.seen[i * n + j], brute_weight(&p, i, j) > 0);
            bonds += p.seen[i * n + j];
        }
    assert_int_equal(bonds, p.bonds->count);
    struct kr_bonds_size size = kr_bonds_size(p.bonds);
    kr_figure("%zu nodes, %zu bonds, %.0f %% of the slices on the lattice", n, bonds / 2,
              100 * size.lattice_share);
    assert_true(size.lattice_share > 0.1 && size.lattice_share < 0.9); /* both kinds are met */
    plate_free(&p);
    return bonds;
}

static void test_families_are_complete(void **state) {
    (void)state;
    check_families(KR_PARTIAL_VOLUME_HHB);
    check_families(KR_PARTIAL_VOLUME_NONE);
}

/* Side of the line through a and b on which (x, y) lies. */
static int side(const double a[2], const double b[2], const double *x) {
    return (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]) > 0;
}

static int brute_crosses(const struct plate *p, size_t i, size_t j) {
    const double *from = p->nodes->position + 2 * i, *to = p->nodes->position + 2 * j;
    return side(FROM, TO, from) != side(FROM, TO, to) && side(from, to, FROM) != side(from, to, TO);
}

/* Damage by plates paper eq. 10 from the bonds seen alive. `whole`: whether a pair counts as one of
 * the family. */
static double brute_damage(const struct plate *p, size_t i, int count) {
    double all = 0, left = 0;
    for (size_t j = 0; j < p->nodes->n; j++) {
        double share = brute_weight(p, i, j) * p->nodes->volume[j];
        if (count || !brute_crosses(p, i, j))
            all += share;
        if (p->seen[i * p->nodes->n + j])
            left += share;
    }
    return 1 - left / all;
}

static void check_damage(struct plate *p, int count) {
    double worst = 0, most = 0;
    for (size_t i = 0; i < p->nodes->n; i++) {
        double brute = brute_damage(p, i, count), damage = kr_bonds_damage(p->bonds, i);
        worst = fmax(worst, fabs(damage - brute));
        most = fmax(most, damage);
    }
    kr_figure("damage up to %.3f, off brute force by %.1e", most, worst);
    kr_check_near(worst, 0, FLOAT32);
}

static void check_cut(int count) {
    struct plate p = plate_make(KR_PARTIAL_VOLUME_HHB);
    size_t n = p.nodes->n, cut = 0, said = kr_precrack_cut_line(p.bonds, FROM, TO, count);
    look(&p);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            int crosses = brute_weight(&p, i, j) > 0 && brute_crosses(&p, i, j);
            assert_int_equal(p.seen[i * n + j], brute_weight(&p, i, j) > 0 && !crosses);
            cut += (size_t)crosses;
        }
    assert_int_equal(said, cut / 2);
    assert_true(cut > 100);
    check_damage(&p, count);
    plate_free(&p);
}

static void test_precrack_cuts_what_crosses_it(void **state) {
    (void)state;
    check_cut(1);
    check_cut(0);
}

/* Pull some bonds past s0: both ends forget them, for good, and the damage says so. */
static void test_broken_stays_broken(void **state) {
    struct plate p = plate_make(KR_PARTIAL_VOLUME_HHB);
    struct kr_body *body = kr_body_create(p.bonds);
    size_t n = p.nodes->n;
    double s0 = p.bonds->material.critical_stretch;
    (void)state;
    for (size_t i = 0; i < n / 2; i++)
        p.bonds->no_fail[i] = 1;
    kr_plate_shake(body, 1.0 * s0 * SPACING, 5);
    kr_body_force(body, 1);
    size_t broken = body->broken.count, expected = 0;
    look(&p);
    for (size_t i = 0; i < n; i++)
        for (size_t j = i + 1; j < n; j++) {
            double q = 0, square = 0;
            for (int d = 0; d < 2; d++) {
                double xi =
                    p.nodes->position[2 * j + (size_t)d] - p.nodes->position[2 * i + (size_t)d];
                double eta = body->u[d][j] - body->u[d][i];
                q += eta * (2 * xi + eta);
                square += xi * xi;
            }
            int breaks = i >= n / 2 && q / square > s0 * (2 + s0);
            int alive = brute_weight(&p, i, j) > 0 && !breaks;
            assert_int_equal(p.seen[i * n + j], alive);
            assert_int_equal(p.seen[j * n + i], alive);
            expected += brute_weight(&p, i, j) > 0 && breaks;
        }
    kr_figure("%zu of %zu bonds broke", broken, p.bonds->count / 2);
    assert_int_equal(broken, expected);
    assert_true(broken > 100);
    check_damage(&p, 1);

    unsigned char *before = KR_NEW(unsigned char, n *n);
    memcpy(before, p.seen, n * n);
    for (int round = 0; round < 3; round++) {
        kr_plate_shake(body, round ? 1e-3 * SPACING : 0, (uint64_t)round);
        kr_body_force(body, 1);
        assert_int_equal(body->broken.count, 0);
        look(&p);
        assert_memory_equal(p.seen, before, n * n);
    }
    kr_free(before);
    kr_body_free(body);
    plate_free(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_families_are_complete),
        cmocka_unit_test(test_precrack_cuts_what_crosses_it),
        cmocka_unit_test(test_broken_stays_broken),
    };
    kr_run_tests(tests);
}
