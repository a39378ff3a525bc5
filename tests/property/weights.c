/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Every partial volume with every surface correction, on a plate with a hole among cells of unequal
 * size and shape: weights equal from both ends, no momentum from nothing, the fast loop like the
 * exact one, lattice slices like general ones. Exact shares fill the circle. The factors do what
 * their method promises.
 */
#include "test.h"

#include "base/error.h"
#include "plates.h"
#include "weight.h"

enum { COLUMNS = 71, ROWS = 61 };
static const double SPACING = 0.1e-3, HORIZON = 0.37e-3, RADIUS = 0.53e-3, DISORDER = 0.25;

/* Weights are kept in float32: 24 bits. */
static const double FLOAT32 = 6e-8;

static const int volumes[] = {KR_PARTIAL_VOLUME_NONE, KR_PARTIAL_VOLUME_HHB,
                              KR_PARTIAL_VOLUME_HHB_ONE_SIDED, KR_PARTIAL_VOLUME_EXACT,
                              KR_PARTIAL_VOLUME_EXACT_CENTROID};
static const int corrections[] = {KR_SURFACE_NONE, KR_SURFACE_VOLUME, KR_SURFACE_FORCE_DENSITY,
                                  KR_SURFACE_ENERGY};
enum { N_VOLUMES = 5, N_CORRECTIONS = 4 };

struct plate {
    struct kr_nodes *nodes;
    struct kr_material material;
    struct kr_bonds *bonds;
    struct kr_body *body;
    struct kr_weights *weights;
};

static struct plate plate_make(int volume, int correction) {
    struct plate p = {.nodes = kr_plate_cells(COLUMNS, ROWS, SPACING, RADIUS, DISORDER, 5),
                      .material = kr_pmma(KR_PLANE_STRESS, HORIZON)};
    kr_surface_make(p.nodes, &p.material, correction, volume, KR_ISOTROPIC);
    p.bonds = kr_bonds_create(p.nodes, &p.material, volume);
    p.body = kr_body_create(p.bonds);
    p.weights = kr_weights_create(p.nodes, HORIZON, volume);
    return p;
}

static void plate_free(struct plate *p) {
    kr_weights_free(p->weights);
    kr_body_free(p->body);
    kr_bonds_free(p->bonds);
    kr_nodes_free(p->nodes);
}

/* The true distance: bonds keep theirs rounded to float32, which a weight near 0 would feel. */
static double true_length(const struct kr_bond *bond) {
    return hypot(bond->xi[0], bond->xi[1]);
}

static double distance_of(const struct kr_nodes *nodes, size_t i, size_t j) {
    const double *x = nodes->position;
    return hypot(x[2 * j] - x[2 * i], x[2 * j + 1] - x[2 * i + 1]);
}

static void name_of(int volume, int correction, char text[80]) {
    char a[32], b[32];
    kr_case_word(KR_PARTIAL_VOLUME_WORDS, volume, a);
    kr_case_word(KR_SURFACE_WORDS, correction, b);
    snprintf(text, 80, "%-14s %-13s", a, b);
}

/* ---- shares ---- */

/* Whether the circle about node i lies in the plate and misses the hole's cells: these reach beyond
 * RADIUS by less than two spacings. */
static int is_whole(const struct kr_nodes *nodes, size_t i) {
    const double *x = nodes->position + 2 * i;
    double width = COLUMNS * SPACING, height = ROWS * SPACING;
    double edge = fmin(fmin(x[0], width - x[0]), fmin(x[1], height - x[1]));
    return edge > HORIZON &&
           hypot(x[0] - width / 2, x[1] - height / 2) > HORIZON + RADIUS + 2 * SPACING;
}

/* The circle's area from the shares that i sees, and from the symmetric weights, both in double. */
static void family_area(const struct kr_weights *w, size_t i, double *shares, double *weights) {
    const struct kr_nodes *nodes = w->nodes;
    *shares = *weights = nodes->volume[i];
    for (size_t j = 0; j < nodes->n; j++)
        if (j != i && distance_of(nodes, i, j) < w->reach) {
            *shares += kr_weights_share(w, i, j) * nodes->volume[j];
            *weights += kr_weights_phi(w, i, j, distance_of(nodes, i, j)) * nodes->volume[j];
        }
}

static void test_exact_shares_fill_the_circle(void **state) {
    const double disc = M_PI * HORIZON * HORIZON;
    struct plate p = plate_make(KR_PARTIAL_VOLUME_EXACT, KR_SURFACE_NONE);
    size_t whole = 0;
    double share = 0, lattice = 0, fitted = 0, weight = 0, stored;
    (void)state;
    for (size_t i = 0; i < p.nodes->n; i++) {
        double shares, weights;
        if (!is_whole(p.nodes, i))
            continue;
        family_area(p.weights, i, &shares, &weights);
        share = fmax(share, fabs(shares / disc - 1));
        weight = fmax(weight, fabs(weights / disc - 1));
        if (p.bonds->lattice[i / KR_LANES]) {
            lattice = fmax(lattice, fabs(weights / disc - 1));
            stored = (p.bonds->family_volume[i] + p.nodes->volume[i]) / disc - 1;
            kr_check_near(stored, 0, FLOAT32);
        } else {
            fitted = fmax(fitted, fabs(shares / disc - 1));
        }
        whole++;
    }
    kr_figure("%zu whole circles: shares off by %.1e (fitted cells %.1e), symmetric weights on the "
              "lattice by %.1e, among fitted cells by %.1e",
              whole, share, fitted, lattice, weight);
    assert_true(whole > 200);
    kr_check_near(share, 0, 1e-12);
    kr_check_near(lattice, 0, 1e-12);
    assert_true(fitted > 0 && weight < 0.02); /* the mean of both ends is not quite the circle */
    plate_free(&p);
}

/* The weight of each stored bond against one from the definition of (10a), (10b) and eq. 13. */
static double definition(const struct plate *p, int volume, const struct kr_bond *bond) {
    size_t i = bond->i, j = bond->j;
    double ri = sqrt(p->nodes->volume[i]), rj = sqrt(p->nodes->volume[j]);
    double to_i = fmin(fmax((HORIZON + ri / 2 - true_length(bond)) / ri, 0), 1);
    double to_j = fmin(fmax((HORIZON + rj / 2 - true_length(bond)) / rj, 0), 1);
    if (volume == KR_PARTIAL_VOLUME_NONE)
        return true_length(bond) <= HORIZON * (1 + 1e-9);
    if (volume == KR_PARTIAL_VOLUME_HHB)
        return 0.5 * (to_i + to_j);
    if (volume == KR_PARTIAL_VOLUME_HHB_ONE_SIDED)
        return to_j;
    if (volume == KR_PARTIAL_VOLUME_EXACT)
        return 0.5 * (kr_weights_share(p->weights, i, j) + kr_weights_share(p->weights, j, i));
    return kr_weights_phi(p->weights, i, j, true_length(bond));
}

static void check_weights(int volume) {
    struct plate p = plate_make(volume, KR_SURFACE_NONE);
    struct kr_bond bond;
    char name[80];
    double worst = 0, uneven = 0;
    for (size_t slice = 0; slice < p.bonds->n_slices; slice++) {
        struct kr_bond_walk walk = kr_bonds_walk(p.bonds, slice);
        while (kr_bonds_next(p.bonds, &walk, &bond)) {
            double back = kr_weights_phi(p.weights, bond.j, bond.i, true_length(&bond));
            double there = kr_weights_phi(p.weights, bond.i, bond.j, true_length(&bond));
            uneven = fmax(uneven, fabs(there - back));
            worst = fmax(worst, fabs(bond.weight - definition(&p, volume, &bond)));
        }
    }
    name_of(volume, KR_SURFACE_NONE, name);
    kr_figure("%s: weights of both ends differ by %.1e", name, uneven);
    kr_check_near(worst, 0, FLOAT32);
    if (volume == KR_PARTIAL_VOLUME_HHB_ONE_SIDED)
        assert_true(uneven > 0.01);
    else
        assert_true(uneven == 0);
    plate_free(&p);
}

static void test_weights_are_as_defined_and_symmetric(void **state) {
    (void)state;
    for (int v = 0; v < N_VOLUMES; v++)
        check_weights(volumes[v]);
}

/* ---- forces ---- */

/* The net force and the net moment about the origin, over the sums of their absolute values. */
static double drift(struct kr_body *body) {
    const struct kr_bonds *b = body->bonds;
    double net[2] = {0}, moment = 0, all = 0, arms = 0;
    kr_body_force(body, 0);
    for (size_t i = 0; i < body->n; i++) {
        double place[2], pull[2];
        for (int d = 0; d < 2; d++) {
            place[d] = b->x[d][i] + body->u[d][i];
            pull[d] = b->volume[i] * body->force[d][i];
            net[d] += pull[d];
            all += fabs(pull[d]);
        }
        moment += place[0] * pull[1] - place[1] * pull[0];
        arms += fabs(place[0] * pull[1]) + fabs(place[1] * pull[0]);
    }
    return fmax(fmax(fabs(net[0]), fabs(net[1])) / all, fabs(moment) / arms);
}

/* The whole body's fast force against the exact loop's. */
static double off_exact(struct kr_body *body) {
    struct kr_kernel_work work = {.bonds = body->bonds};
    double worst = 0, most = 0;
    for (int d = 0; d < 2; d++) {
        work.u[d] = body->u[d];
        work.force[d] = kr_bonds_padded(body->n);
    }
    for (size_t slice = 0; slice < body->bonds->n_slices; slice++)
        kr_exact_force(&work, slice);
    kr_body_force(body, 0);
    for (int d = 0; d < 2; d++) {
        for (size_t i = 0; i < body->n; i++) {
            worst = fmax(worst, fabs(body->force[d][i] - work.force[d][i]));
            most = fmax(most, fabs(work.force[d][i]));
        }
        kr_bonds_padded_free(work.force[d]);
    }
    return worst / most;
}

static void check_forces(int volume, int correction) {
    struct plate p = plate_make(volume, correction);
    char name[80];
    kr_plate_shake(p.body, 1e-3 * SPACING, 4);
    double lost = drift(p.body), off = off_exact(p.body);
    double lattice = kr_bonds_size(p.bonds).lattice_share;
    name_of(volume, correction, name);
    kr_figure("%s: momentum drifts by %.1e, fast loop off by %.1e, %.0f %% lattice", name, lost,
              off, 100 * lattice);
    kr_check_near(off, 0, 1e-12);
    assert_true(lattice > 0.03 && lattice < 0.9);
    if (volume == KR_PARTIAL_VOLUME_HHB_ONE_SIDED)
        assert_true(lost > 1e-7);
    else
        kr_check_near(lost, 0, 1e-12);
    plate_free(&p);
}

static void test_momentum_is_kept(void **state) {
    (void)state;
    for (int v = 0; v < N_VOLUMES; v++)
        for (int c = 0; c < N_CORRECTIONS; c++)
            check_forces(volumes[v], corrections[c]);
}

/* Forces of one plate, with its lattice known or, by a wrong spacing, unknown. */
static struct kr_body *shaken(struct kr_nodes *nodes, int volume, double spacing) {
    struct kr_material material = kr_pmma(KR_PLANE_STRESS, HORIZON);
    nodes->spacing = spacing;
    struct kr_body *body = kr_body_create(kr_bonds_create(nodes, &material, volume));
    kr_plate_shake(body, 1e-3 * SPACING, 4);
    kr_body_force(body, 0);
    return body;
}

static void check_classes(int volume, int correction) {
    struct kr_material material = kr_pmma(KR_PLANE_STRESS, HORIZON);
    struct kr_nodes *nodes = kr_plate_cells(COLUMNS, ROWS, SPACING, RADIUS, DISORDER, 5);
    kr_surface_make(nodes, &material, correction, volume, KR_ISOTROPIC);
    struct kr_body *body[2];
    double worst = 0, most = 0;
    for (int k = 0; k < 2; k++)
        body[k] = shaken(nodes, volume, k ? 0.7 * SPACING : SPACING);
    assert_true(kr_bonds_size(body[0]->bonds).lattice_share > 0.03);
    assert_true(kr_bonds_size(body[1]->bonds).lattice_share == 0);
    for (int d = 0; d < 2; d++)
        for (size_t i = 0; i < nodes->n; i++) {
            worst = fmax(worst, fabs(body[0]->force[d][i] - body[1]->force[d][i]));
            most = fmax(most, fabs(body[0]->force[d][i]));
        }
    /* A weight that rounds to the other neighbour in float32 is off by 6e-8. */
    kr_check_near(worst / most, 0, FLOAT32);
    for (int k = 0; k < 2; k++) {
        struct kr_bonds *bonds = body[k]->bonds;
        kr_body_free(body[k]);
        kr_bonds_free(bonds);
    }
    kr_nodes_free(nodes);
}

static void test_lattice_slices_are_like_general_ones(void **state) {
    (void)state;
    for (int v = 0; v < N_VOLUMES; v++)
        for (int c = 0; c < N_CORRECTIONS; c++)
            check_classes(volumes[v], corrections[c]);
}

/* ---- surface factors ---- */

/* A bond's weight times the mean factor against phi times the factor of its method. */
static double off_method(const struct plate *p, int correction) {
    const struct kr_nodes *nodes = p->nodes;
    struct kr_bond bond;
    double worst = 0;
    for (size_t slice = 0; slice < p->bonds->n_slices; slice++) {
        struct kr_bond_walk walk = kr_bonds_walk(p->bonds, slice);
        while (kr_bonds_next(p->bonds, &walk, &bond)) {
            size_t i = bond.i, j = bond.j;
            double mean = 0.5 * (nodes->factor[i] + nodes->factor[j]), wanted = mean;
            if (correction == KR_SURFACE_VOLUME)
                wanted = 2 / (1 / nodes->factor[i] + 1 / nodes->factor[j]);
            if (correction == KR_SURFACE_FORCE_DENSITY) {
                const double *a = nodes->axis_factor;
                double gx = 0.5 * (a[2 * i] + a[2 * j]), gy = 0.5 * (a[2 * i + 1] + a[2 * j + 1]);
                wanted = true_length(&bond) / hypot(bond.xi[0] / gx, bond.xi[1] / gy);
            }
            double phi = kr_weights_phi(p->weights, i, j, true_length(&bond));
            worst = fmax(worst, fabs(bond.weight * mean / (phi * wanted) - 1));
        }
    }
    return worst;
}

/* V_i and S_i by brute force over all pairs. */
static void family_sums(const struct plate *p, size_t i, double *volume, double pull[2]) {
    const struct kr_nodes *nodes = p->nodes;
    *volume = nodes->volume[i];
    pull[0] = pull[1] = 0;
    for (size_t j = 0; j < nodes->n; j++) {
        double length = distance_of(nodes, i, j);
        if (j == i || length >= p->weights->reach)
            continue;
        double share = kr_weights_phi(p->weights, i, j, length) * nodes->volume[j];
        *volume += share;
        for (int d = 0; d < 2; d++) {
            double n =
                fabs(nodes->position[2 * j + (size_t)d] - nodes->position[2 * i + (size_t)d]) /
                length;
            double stretch = sqrt(1 + 1e-4 * (2 + 1e-4) * n * n) - 1;
            pull[d] += share * p->material.micromodulus * p->material.law->force(stretch) * n;
        }
    }
}

/* Each seventh node's own equation: lambda V_i = V0, lambda_d S_d = S0. */
static double off_equation(const struct plate *p, int correction, int partial_volume) {
    double full = kr_surface_full_pull(&p->material, 2, partial_volume), worst = 0;
    for (size_t i = 0; i < p->nodes->n; i += 7) {
        double volume, pull[2];
        family_sums(p, i, &volume, pull);
        if (correction == KR_SURFACE_VOLUME)
            worst =
                fmax(worst, fabs(p->nodes->factor[i] * volume / (M_PI * HORIZON * HORIZON) - 1));
        else
            for (int d = 0; d < 2; d++)
                worst = fmax(worst,
                             fabs(p->nodes->axis_factor[2 * i + (size_t)d] * pull[d] / full - 1));
    }
    return worst;
}

/* The energy's equation, W_i = W0 under the strain it was made for; the iteration ends at 1e-7. */
static double off_energy(const struct plate *p, int partial_volume) {
    double full = kr_surface_reference(&p->material, 2, partial_volume, KR_ISOTROPIC), worst = 0;
    for (int d = 0; d < 2; d++)
        for (size_t i = 0; i < p->nodes->n; i++)
            p->body->u[d][i] = 1e-4 * p->bonds->x[d][i];
    kr_body_energy(p->body);
    for (size_t i = 0; i < p->nodes->n; i++)
        worst = fmax(worst, fabs(p->body->energy[i] / full - 1));
    return worst;
}

/* All but the energy's are good to the float32 of the weights; stretches of 1e-4 from lengths lose
 * 4 digits of 16. */
static void test_surface_methods_do_what_they_promise(void **state) {
    (void)state;
    for (int v = 0; v < N_VOLUMES; v++)
        for (int c = 1; c < N_CORRECTIONS; c++) {
            struct plate p = plate_make(volumes[v], corrections[c]);
            char name[80];
            double bond = off_method(&p, corrections[c]);
            double node = corrections[c] == KR_SURFACE_ENERGY
                              ? off_energy(&p, volumes[v])
                              : off_equation(&p, corrections[c], volumes[v]);
            name_of(volumes[v], corrections[c], name);
            kr_figure("%s: nodes' equation off by %.1e, bonds' by %.1e", name, node, bond);
            kr_check_near(node, 0, corrections[c] == KR_SURFACE_ENERGY ? 1.1e-7 : FLOAT32);
            kr_check_near(bond, 0, 2 * FLOAT32);
            plate_free(&p);
        }
}

/* The whole sum in polar coordinates: integral of c strain |cos|^3 over the circle. */
static void test_full_pull_is_the_integral(void **state) {
    struct kr_material m = kr_pmma(KR_PLANE_STRESS, HORIZON);
    double classical = m.micromodulus * 1e-4 * (8.0 / 3) * HORIZON * HORIZON / 2;
    (void)state;
    /* dx = delta/25 leaves a fraction of a percent; strain 1e-4 as much of itself. */
    kr_check_near(kr_surface_full_pull(&m, 2, KR_PARTIAL_VOLUME_EXACT) / classical, 1, 2e-3);
}

/* ---- what cannot be ---- */

static void ask_without_cells(void *argument) {
    struct kr_material m = kr_pmma(KR_PLANE_STRESS, HORIZON);
    (void)argument;
    kr_bonds_create(kr_plate_lattice(9, 9, SPACING), &m, KR_PARTIAL_VOLUME_EXACT);
}

static void test_exact_shares_need_cells(void **state) {
    (void)state;
    kr_check_stops(ask_without_cells, NULL, KR_EXIT_INPUT, "need the cells");
}

/* Broken bonds count at both ends with their own weights: damage 1 where all are gone, and all the
 * energy that the body held went with them. */
static void check_damage(int volume, int correction) {
    struct plate p = plate_make(volume, correction);
    for (int d = 0; d < 2; d++)
        for (size_t i = 0; i < p.nodes->n; i++)
            p.body->u[d][i] = 0.5 * p.bonds->x[d][i];
    double held = kr_body_energy(p.body), energy = 0;
    kr_body_force(p.body, 1);
    for (size_t k = 0; k < p.body->broken.count; k++)
        energy += p.body->broken.item[k].energy;
    kr_check_near(energy / held, 1, 1e-12);
    for (size_t i = 0; i < p.nodes->n; i++)
        kr_check_near(kr_bonds_damage(p.bonds, i), 1, 1e-12);
    plate_free(&p);
}

static void test_all_broken_is_damage_one(void **state) {
    (void)state;
    for (int v = 0; v < N_VOLUMES; v++)
        for (int c = 0; c < N_CORRECTIONS; c++)
            check_damage(volumes[v], corrections[c]);
}

/* A stretch along x of just s0: rounding decides which bonds along x break, at each end by itself.
 * What broke at one end must be gone and counted at both. */
static void test_both_ends_know_of_a_break(void **state) {
    struct plate p = plate_make(KR_PARTIAL_VOLUME_EXACT, KR_SURFACE_NONE);
    double s0 = p.material.critical_stretch, lost = 0, counted = 0;
    size_t ends = 0, before = p.bonds->count, after = 0;
    (void)state;
    for (size_t i = 0; i < p.nodes->n; i++)
        p.body->u[0][i] = s0 * p.bonds->x[0][i];
    kr_body_force(p.body, 1);
    for (int k = 0; k < p.bonds->n_blocks; k++)
        ends += p.body->by_block[k].count;
    for (size_t i = 0; i < p.nodes->n; i++)
        lost += p.bonds->lost_volume[i];
    for (size_t k = 0; k < p.body->broken.count; k++) {
        const struct kr_broken *one = &p.body->broken.item[k];
        counted += one->weight * (p.nodes->volume[one->i] + p.nodes->volume[one->j]);
        assert_true(one->i < one->j);
        assert_true(kr_bonds_clear(p.bonds, (size_t)one->i, (size_t)one->j) == 0);
        assert_true(kr_bonds_clear(p.bonds, (size_t)one->j, (size_t)one->i) == 0);
    }
    for (size_t r = 0; r < p.bonds->n_rows; r++)
        after += (size_t)__builtin_popcount(p.bonds->living[r]);
    kr_figure("%zu bonds broke, %zu of them at one end alone", p.body->broken.count,
              2 * p.body->broken.count - ends);
    assert_true(ends < 2 * p.body->broken.count);
    assert_int_equal(before - after, 2 * p.body->broken.count);
    kr_check_near(lost / counted, 1, 1e-12);
    plate_free(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_exact_shares_fill_the_circle),
        cmocka_unit_test(test_weights_are_as_defined_and_symmetric),
        cmocka_unit_test(test_momentum_is_kept),
        cmocka_unit_test(test_lattice_slices_are_like_general_ones),
        cmocka_unit_test(test_surface_methods_do_what_they_promise),
        cmocka_unit_test(test_full_pull_is_the_integral),
        cmocka_unit_test(test_exact_shares_need_cells),
        cmocka_unit_test(test_all_broken_is_damage_one),
        cmocka_unit_test(test_both_ends_know_of_a_break),
    };
    kr_run_tests(tests);
}
