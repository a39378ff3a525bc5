/* SPDX-License-Identifier: BSD-3-Clause
 *
 * PETSc on the same energy as solver/equilibrium.c; theory.md (2), (3), (8), (24). `make oracle`, where
 * petsc-dev is installed.
 *
 *    energy = sum over pairs of  k L s^2/2 - sum of V b.u ,   s = sqrt(1 + (y.y - xi.xi)/L^2) - 1
 *
 * Written here from the list of bonds, in the textbook's way: no loop, polynomial or product of the solver
 * takes part. SNES has the whole matrix and a direct factorisation; TAO's LMVM sees energies and gradients alone.
 */
#include "test.h"

#include "equilibrium.h"
#include "plates.h"
#include "precrack.h"

#include <petsctao.h>

static const double SPACING = 0.1e-3, HORIZON = 0.3001e-3;

/* A body in equilibrium, and what PETSc needs of it. */
struct problem {
    struct kr_bonds *bonds;
    struct kr_body *body;
    struct kr_equilibrium *q;
    int dim;
    size_t count;      /* pairs, and what they are */
    struct kr_bond *pair;
    double *k;         /* V_i V_j w c */
    double *at[3];     /* m: displacements in the course of PETSc */
    PetscInt *unknown; /* (n x dim) -1: prescribed */
    PetscInt unknowns;
};

static void list_pairs(struct problem *p) {
    const struct kr_bonds *b = p->bonds;
    size_t room = 0;
    for (size_t slice = 0; slice < b->n_slices; slice++) {
        struct kr_bond_walk walk = kr_bonds_walk(b, slice);
        struct kr_bond bond;
        while (kr_bonds_next(b, &walk, &bond)) {
            if (bond.i > bond.j)
                continue;
            KR_GROW(p->pair, p->count, room);
            p->pair[p->count++] = bond;
        }
    }
    p->k = KR_NEW(double, p->count);
    for (size_t m = 0; m < p->count; m++) {
        const struct kr_bond *bond = &p->pair[m];
        p->k[m] = b->volume[bond->i] * b->volume[bond->j] * bond->weight * 0.5 *
                  (b->factor[bond->i] + b->factor[bond->j]) * b->material.micromodulus;
    }
}

static void number_unknowns(struct problem *p) {
    p->unknown = KR_NEW(PetscInt, p->body->n * (size_t)p->dim);
    for (size_t i = 0; i < p->body->n; i++)
        for (int d = 0; d < p->dim; d++)
            p->unknown[i * (size_t)p->dim + (size_t)d] =
                p->q->rest->fixed[i] >> d & 1 ? -1 : p->unknowns++;
}

/* Stretch of a pair, and its vector y from i to j. */
static double stretch_of(const struct problem *p, const struct kr_bond *bond, double y[3]) {
    double square = 0, rest = 0;
    for (int d = 0; d < p->dim; d++) {
        y[d] = bond->xi[d] + p->at[d][bond->j] - p->at[d][bond->i];
        square += y[d] * y[d];
        rest += bond->xi[d] * bond->xi[d];
    }
    return sqrt(1 + (square - rest) / (bond->length * bond->length)) - 1;
}

static void take(struct problem *p, Vec from) {
    const double *x;
    VecGetArrayRead(from, &x);
    for (size_t i = 0; i < p->body->n; i++)
        for (size_t d = 0; d < (size_t)p->dim; d++) {
            PetscInt m = p->unknown[i * (size_t)p->dim + d];
            if (m >= 0)
                p->at[d][i] = x[m];
        }
    VecRestoreArrayRead(from, &x);
}

static double energy_of(const struct problem *p) {
    double sum = 0, y[3];
    for (size_t m = 0; m < p->count; m++) {
        double s = stretch_of(p, &p->pair[m], y);
        sum += p->k[m] * p->pair[m].length * 0.5 * s * s;
    }
    for (size_t i = 0; i < p->body->n; i++)
        for (int d = 0; d < p->dim; d++)
            sum -= p->bonds->volume[i] * p->q->rest->load[d][i] * p->at[d][i];
    return sum;
}

static void add_to(const struct problem *p, double *g, size_t i, int d, double value) {
    PetscInt m = p->unknown[i * (size_t)p->dim + (size_t)d];
    if (m >= 0)
        g[m] += value;
}

static void gradient_of(const struct problem *p, Vec to) {
    double *g, y[3];
    VecZeroEntries(to);
    VecGetArray(to, &g);
    for (size_t m = 0; m < p->count; m++) {
        const struct kr_bond *bond = &p->pair[m];
        double s = stretch_of(p, bond, y), pull = p->k[m] * s / (bond->length * (1 + s));
        for (int d = 0; d < p->dim; d++) {
            add_to(p, g, bond->i, d, -pull * y[d]);
            add_to(p, g, bond->j, d, pull * y[d]);
        }
    }
    for (size_t i = 0; i < p->body->n; i++)
        for (int d = 0; d < p->dim; d++)
            add_to(p, g, i, d, -p->bonds->volume[i] * p->q->rest->load[d][i]);
    VecRestoreArray(to, &g);
}

static PetscErrorCode objective(Tao tao, Vec x, PetscReal *energy, Vec g, void *context) {
    struct problem *p = context;
    (void)tao;
    take(p, x);
    *energy = energy_of(p);
    gradient_of(p, g);
    return 0;
}

static PetscErrorCode residual(SNES snes, Vec x, Vec g, void *context) {
    struct problem *p = context;
    (void)snes;
    take(p, x);
    gradient_of(p, g);
    return 0;
}

/* Second derivative of k L s^2/2 by y, a block: k/L ( n n^T + s/(1+s) (1 - n n^T) ). */
static PetscErrorCode jacobian(SNES snes, Vec x, Mat a, Mat b, void *context) {
    struct problem *p = context;
    double y[3];
    (void)snes;
    (void)b;
    take(p, x);
    MatZeroEntries(a);
    for (size_t m = 0; m < p->count; m++) {
        const struct kr_bond *bond = &p->pair[m];
        double s = stretch_of(p, bond, y), stiff = p->k[m] / bond->length, square = 0;
        size_t end[2] = {bond->i, bond->j};
        for (int d = 0; d < p->dim; d++)
            square += y[d] * y[d];
        for (int d = 0; d < p->dim; d++)
            for (int e = 0; e < p->dim; e++) {
                double n = y[d] * y[e] / square, value = stiff * (n + s / (1 + s) * ((d == e) - n));
                for (int f = 0; f < 4; f++) {
                    PetscInt row = p->unknown[end[f / 2] * (size_t)p->dim + (size_t)d];
                    PetscInt column = p->unknown[end[f % 2] * (size_t)p->dim + (size_t)e];
                    if (row >= 0 && column >= 0)
                        MatSetValue(a, row, column, f == 0 || f == 3 ? value : -value, ADD_VALUES);
                }
            }
    }
    MatAssemblyBegin(a, MAT_FINAL_ASSEMBLY);
    MatAssemblyEnd(a, MAT_FINAL_ASSEMBLY);
    return 0;
}

/* Prescribed components at their ends, all others at rest. */
static void restart(struct problem *p, double *const prescribed[3], Vec x) {
    for (int d = 0; d < p->dim; d++)
        for (size_t i = 0; i < p->body->n; i++)
            p->at[d][i] = p->q->rest->fixed[i] >> d & 1 ? prescribed[d][i] : 0;
    VecZeroEntries(x);
}

static double by_snes(struct problem *p, Vec x, PetscInt *steps) {
    SNES snes;
    KSP ksp;
    PC pc;
    Mat a;
    Vec g;
    SNESConvergedReason why;
    VecDuplicate(x, &g);
    MatCreateSeqAIJ(PETSC_COMM_SELF, p->unknowns, p->unknowns, p->dim == 2 ? 150 : 600, NULL, &a);
    SNESCreate(PETSC_COMM_SELF, &snes);
    SNESSetType(snes, SNESNEWTONLS);
    SNESSetFunction(snes, g, residual, p);
    SNESSetJacobian(snes, a, a, jacobian, p);
    SNESSetTolerances(snes, 0, 1e-12, 0, 50, 1000);
    SNESGetKSP(snes, &ksp);
    KSPSetType(ksp, KSPPREONLY);
    KSPGetPC(ksp, &pc);
    PCSetType(pc, PCLU);
    SNESSolve(snes, NULL, x);
    SNESGetConvergedReason(snes, &why);
    SNESGetIterationNumber(snes, steps);
    if (why <= 0)
        fail_msg("PETSc ended with reason %d", (int)why);
    SNESDestroy(&snes);
    MatDestroy(&a);
    VecDestroy(&g);
    take(p, x);
    return energy_of(p);
}

static double by_tao(struct problem *p, Vec x, PetscInt *steps) {
    Tao tao;
    TaoConvergedReason why;
    TaoCreate(PETSC_COMM_SELF, &tao);
    TaoSetType(tao, TAOLMVM);
    TaoSetSolution(tao, x);
    TaoSetObjectiveAndGradient(tao, NULL, objective, p);
    TaoSetTolerances(tao, 0, 0, 1e-7);
    TaoSetMaximumIterations(tao, 20000);
    TaoSetMaximumFunctionEvaluations(tao, 40000);
    TaoSolve(tao);
    TaoGetConvergedReason(tao, &why);
    TaoGetIterationNumber(tao, steps);
    if (why <= 0)
        fail_msg("PETSc ended with reason %d", (int)why);
    TaoDestroy(&tao);
    take(p, x);
    return energy_of(p);
}

static struct problem begin(struct kr_nodes *nodes, int model) {
    struct kr_material material = kr_pmma(model, HORIZON);
    struct problem p = {.dim = nodes->dim};
    kr_plate_random_factors(nodes, 5);
    p.bonds = kr_bonds_create(nodes, &material, KR_PARTIAL_VOLUME_HHB);
    p.body = kr_body_create(p.bonds);
    p.q = kr_equilibrium_create(p.body);
    p.q->quiet = 1;
    p.q->tolerance = 1e-9;
    for (int d = 0; d < p.dim; d++)
        p.at[d] = KR_NEW(double, p.body->n);
    kr_nodes_free(nodes);
    return p;
}

static void end(struct problem *p) {
    for (int d = 0; d < p->dim; d++)
        kr_free(p->at[d]);
    kr_free(p->pair);
    kr_free(p->k);
    kr_free(p->unknown);
    kr_equilibrium_free(p->q);
    kr_body_free(p->body);
    kr_bonds_free(p->bonds);
}

/* Held below; above pulled and shorn by 1 % of the height, or drawn by a body force. */
static void load(struct problem *p, double height, int by_force) {
    struct kr_rest *rest = p->q->rest;
    for (size_t i = 0; i < p->body->n; i++) {
        double y = p->bonds->x[1][i];
        int below = y < HORIZON, above = y > height - HORIZON;
        rest->fixed[i] = below || (above && !by_force) ? 7 : 0;
        p->q->move[0][i] = above && !by_force ? 0.003 * height : 0;
        p->q->move[1][i] = above && !by_force ? 0.01 * height : 0;
        rest->load[1][i] = above && by_force ? 1e-3 * KR_PMMA_MODULUS / HORIZON : 0;
        rest->load[0][i] = 0.2 * rest->load[1][i];
    }
}

/* The energy has its least there, so its error is the square of the residual's. */
static void compare(struct problem *p, const char *what) {
    Vec x;
    PetscInt steps[2];
    double *const prescribed[3] = {p->body->u[0], p->body->u[1], p->body->u[2]};
    list_pairs(p);
    assert_int_equal(kr_equilibrium_find(p->q), KR_EQUILIBRIUM_FOUND);
    double ours = kr_body_energy(p->body);
    for (size_t i = 0; i < p->body->n; i++)
        for (int d = 0; d < p->dim; d++)
            ours -= p->bonds->volume[i] * p->q->rest->load[d][i] * p->body->u[d][i];
    number_unknowns(p);
    VecCreateSeq(PETSC_COMM_SELF, p->unknowns, &x);
    restart(p, prescribed, x);
    double newton = by_snes(p, x, &steps[0]);
    restart(p, prescribed, x);
    double quasi = by_tao(p, x, &steps[1]);
    VecDestroy(&x);
    kr_figure("%s: %zu nodes, %d products; energy off that of SNES (%d steps) by %.1e, of TAO (%d) by %.1e",
              what, p->body->n, p->q->products, (int)steps[0], ours / newton - 1, (int)steps[1],
              ours / quasi - 1);
    kr_check_near(ours / newton, 1, 1e-10);
    kr_check_near(ours / quasi, 1, 1e-10);
}

static void plate(int cut, int by_force, const char *what) {
    const size_t across = 48;
    const double size = (double)across * SPACING, from[2] = {0, 0.51 * size}, to[2] = {0.3 * size, 0.56 * size};
    struct problem p = begin(kr_plate_porous(across, across, SPACING, 0.15 * size, 0.2, 7), KR_PLANE_STRESS);
    if (cut)
        kr_precrack_cut_line(p.bonds, from, to, 1);
    load(&p, size, by_force);
    compare(&p, what);
    end(&p);
}

static void test_oracle_plate(void **state) {
    (void)state;
    plate(0, 0, "plate with a hole, moved");
    plate(1, 0, "the same with a crack");
    plate(1, 1, "the same, drawn by a force");
}

static void test_oracle_block(void **state) {
    (void)state;
    struct problem p = begin(kr_plate_block(10, 12, 9, SPACING, 3), KR_SOLID);
    load(&p, 12 * SPACING, 0);
    compare(&p, "block");
    end(&p);
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_oracle_plate),
        cmocka_unit_test(test_oracle_block),
    };
    PetscInitialize(&argc, &argv, NULL, NULL);
    kr_run_tests(tests);
}
