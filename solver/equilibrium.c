/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Newton's method, each step solved by conjugate gradients as far as it is worth; theory.md (24):
 *
 *    A p = r ,   r_i = V_i f_i(u) ,   A = -dr/du ,   u <- u + a p
 *
 * with A p one pass over the bonds each (kr_body_product), and multigrid.h as the preconditioner. A body
 * of small strains is nearly linear, so two or three steps do. Prescribed components move in the first step,
 * and the others with them, or have done so by a good guess: never is a row of bonds stretched by a whole load step.
 */
#include "equilibrium.h"

#include "base/memory.h"
#include "base/progress.h"
#include "multigrid.h"

#include <math.h>
#include <string.h>

enum { MOST_PRODUCTS = 600, MOST_HALVINGS = 12 };

/* To which the first step, that moves supports, is solved: it lands at about the strain anyway. */
static const double FIRST = 1e-3;

/* Of the stiffness's diagonal: keeps nodes that hang on too few bonds to be held (25). The softest
 * wave of a body of 1000 horizons is 100 times stiffer. */
static const double SHIFT = 1e-9;

enum { SOLUTION, REST, PRECONDITIONED, DIRECTION, PRODUCT, VECTORS };

struct kr_equilibrium *kr_equilibrium_create(struct kr_body *body) {
    struct kr_equilibrium *q = KR_NEW(struct kr_equilibrium, 1);
    *q = (struct kr_equilibrium){.body = body, .tolerance = 1e-6, .most_steps = 40};
    q->rest = kr_rest_create(body);
    for (int d = 0; d < body->dim; d++) {
        q->move[d] = kr_bonds_padded(body->n);
        for (int k = 0; k < VECTORS; k++)
            q->room[k][d] = kr_bonds_padded(body->n);
    }
    return q;
}

void kr_equilibrium_free(struct kr_equilibrium *q) {
    for (int d = 0; d < q->body->dim; d++) {
        kr_bonds_padded_free(q->move[d]);
        for (int k = 0; k < VECTORS; k++)
            kr_bonds_padded_free(q->room[k][d]);
    }
    kr_rest_free(q->rest);
    kr_free(q);
}

/* ---- sums ---- */

struct pair {
    int dim;
    double *const *a, *const *b;
};

static double product_of_node(const void *context, size_t i) {
    const struct pair *p = context;
    double sum = 0;
    for (int d = 0; d < p->dim; d++)
        sum += p->a[d][i] * p->b[d][i];
    return sum;
}

static double dot(const struct kr_body *body, double *const a[3], double *const b[3]) {
    struct pair pair = {body->dim, a, b};
    return kr_body_sum(body->n, product_of_node, &pair);
}

static double largest_of(const struct kr_body *body, double *const v[3]) {
    double most = 0;
#pragma omp parallel for reduction(max : most)
    for (size_t i = 0; i < body->n; i++)
        for (int d = 0; d < body->dim; d++)
            most = fmax(most, fabs(v[d][i]));
    return most;
}

double kr_equilibrium_residual(struct kr_equilibrium *q) {
    struct kr_body *body = q->body;
    kr_body_force(body, 0);
    for (int d = 0; d < body->dim; d++)
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < body->n; i++)
            body->force[d][i] += q->rest->load[d][i];
    return kr_rest_measure(q->rest);
}

/* ---- the linear problem ---- */

/* y = A v + SHIFT D v on free components, 0 on the others. */
static void multiply(struct kr_equilibrium *q, const struct kr_multigrid *coarse, double *const v[3],
                     double *const y[3]) {
    struct kr_body *body = q->body;
    const double *volume = body->bonds->volume;
    kr_body_product(body, v, y);
    for (int d = 0; d < body->dim; d++)
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < body->n; i++)
            y[d][i] *= -volume[i];
    kr_multigrid_add_diagonal(coarse, SHIFT, v, y);
    for (int d = 0; d < body->dim; d++)
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < body->n; i++)
            if (q->rest->fixed[i] >> d & 1)
                y[d][i] = 0;
    q->products++;
}

/* a += factor b */
static void add(const struct kr_body *body, double *const a[3], double factor, double *const b[3]) {
    for (int d = 0; d < body->dim; d++)
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < body->n; i++)
            a[d][i] += factor * b[d][i];
}

/* SOLUTION = how the prescribed components move, REST = what then pulls on the free ones. */
static void begin(struct kr_equilibrium *q, const struct kr_multigrid *coarse) {
    const struct kr_body *body = q->body;
    double *const *x = q->room[SOLUTION], *const *r = q->room[REST];
    for (int d = 0; d < body->dim; d++)
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < body->n; i++) {
            int fixed = q->rest->fixed[i] >> d & 1;
            x[d][i] = fixed ? q->move[d][i] : 0;
            r[d][i] = fixed ? 0 : body->bonds->volume[i] * body->force[d][i];
        }
    if (largest_of(body, x) > 0) {
        multiply(q, coarse, x, q->room[PRODUCT]);
        add(body, r, -1, q->room[PRODUCT]);
    }
}

static void show(struct kr_equilibrium *q, struct kr_progress *progress, double share, int k) {
    if (!q->quiet)
        kr_progress_note(progress, "  step %d of Newton, residual %.1e: product %d, rest %.1e, %.2f times "
                         "less each", q->steps + 1, q->rest->residual, k, share, k ? pow(share, -1.0 / k) : 1);
}

/* Conjugate gradients until sqrt(r.z) is `enough` of what it was. Curvature that is not positive ends
 * it with what there is. Returns 0 when stopped. */
static int solve(struct kr_equilibrium *q, struct kr_multigrid *coarse, double enough,
                 struct kr_progress *progress) {
    const struct kr_body *body = q->body;
    double *const *x = q->room[SOLUTION], *const *r = q->room[REST];
    double *const *z = q->room[PRECONDITIONED], *const *p = q->room[DIRECTION];
    double *const *y = q->room[PRODUCT];
    kr_multigrid_solve(coarse, r, z);
    double rz = dot(body, r, z), first = rz;
    for (int d = 0; d < body->dim; d++)
        memcpy(p[d], z[d], body->n * sizeof(double));
    for (int k = 0; k < MOST_PRODUCTS && rz > enough * enough * first; k++) {
        if (q->stop && q->stop(q->stop_with))
            return 0;
        show(q, progress, sqrt(rz / first), k);
        multiply(q, coarse, p, y);
        double curvature = dot(body, p, y);
        if (!(curvature > 0)) {
            if (k == 0)
                add(body, x, 1, p);
            break;
        }
        add(body, x, rz / curvature, p);
        add(body, r, -rz / curvature, y);
        kr_multigrid_solve(coarse, r, z);
        double next = dot(body, r, z), ratio = next / rz;
        rz = next;
        for (int d = 0; d < body->dim; d++)
#pragma omp parallel for schedule(static)
            for (size_t i = 0; i < body->n; i++)
                p[d][i] = z[d][i] + ratio * p[d][i];
    }
    return 1;
}

/* ---- Newton ---- */

/* What the free components of the step gain of the energy: sum of V f.x. */
static double slope_of_node(const void *context, size_t i) {
    const struct kr_equilibrium *q = context;
    double sum = 0;
    for (int d = 0; d < q->body->dim; d++)
        if (!(q->rest->fixed[i] >> d & 1))
            sum += q->body->force[d][i] * q->room[SOLUTION][d][i];
    return sum * q->body->bonds->volume[i];
}

/* Go along the step, shortened until the force along it or the residual is less than before; 0 where
 * that never is. A step that moves supports is gone whole. */
static int go(struct kr_equilibrium *q, int moves) {
    struct kr_body *body = q->body;
    const double before = q->rest->residual, slope = kr_body_sum(body->n, slope_of_node, q);
    double share = 1;
    add(body, body->u, 1, q->room[SOLUTION]);
    for (int k = 0; k < MOST_HALVINGS; k++) {
        double after = kr_equilibrium_residual(q);
        if (moves || after < before ||
            fabs(kr_body_sum(body->n, slope_of_node, q)) < 0.9 * fabs(slope))
            return isfinite(after);
        add(body, body->u, -0.5 * share, q->room[SOLUTION]);
        share *= 0.5;
    }
    return 0;
}

static void forget_moves(struct kr_equilibrium *q) {
    for (int d = 0; d < q->body->dim; d++)
        memset(q->move[d], 0, q->body->n * sizeof(double));
}

static int moves_supports(const struct kr_equilibrium *q) {
    for (int d = 0; d < q->body->dim; d++)
        for (size_t i = 0; i < q->body->n; i++)
            if (q->rest->fixed[i] >> d & 1 && q->move[d][i] != 0)
                return 1;
    return 0;
}

/* Go where `move` leads, unless that is farther from equilibrium than the first step would end. */
static int take_guess(struct kr_equilibrium *q) {
    struct kr_body *body = q->body;
    for (int d = 0; d < body->dim; d++)
        memcpy(q->room[SOLUTION][d], body->u[d], body->n * sizeof(double));
    add(body, body->u, 1, q->move);
    if (kr_equilibrium_residual(q) <= FIRST) {
        forget_moves(q);
        return 1;
    }
    for (int d = 0; d < body->dim; d++)
        memcpy(body->u[d], q->room[SOLUTION][d], body->n * sizeof(double));
    return 0;
}

static enum kr_equilibrium_end iterate(struct kr_equilibrium *q, struct kr_multigrid *coarse, int moves,
                                       struct kr_progress *progress) {
    for (q->steps = 0; q->steps < q->most_steps; q->steps++) {
        if (!moves && q->rest->residual <= q->tolerance)
            return KR_EQUILIBRIUM_FOUND;
        double enough = moves ? FIRST : fmin(1e-2, fmax(1e-4, 0.3 * q->tolerance / q->rest->residual));
        begin(q, coarse);
        if (!solve(q, coarse, enough, progress))
            return KR_EQUILIBRIUM_STOPPED;
        if (!go(q, moves))
            return KR_EQUILIBRIUM_SNAP;
        if (moves)
            forget_moves(q);
        moves = 0;
    }
    return q->rest->residual <= q->tolerance ? KR_EQUILIBRIUM_FOUND : KR_EQUILIBRIUM_SLOW;
}

enum kr_equilibrium_end kr_equilibrium_find(struct kr_equilibrium *q) {
    int moves = 0;
    q->steps = q->products = 0;
    q->end = KR_EQUILIBRIUM_FOUND;
    if (largest_of(q->body, q->move) == 0 || !take_guess(q)) {
        moves = moves_supports(q);
        kr_equilibrium_residual(q);
    }
    if (!moves && q->rest->residual <= q->tolerance)
        return q->end;
    struct kr_progress progress = kr_progress_begin("equilibrium", 0, 0);
    struct kr_multigrid *coarse = kr_multigrid_create(q->body, q->rest->fixed);
    q->end = iterate(q, coarse, moves, &progress);
    kr_multigrid_free(coarse);
    kr_progress_wipe(&progress);
    return q->end;
}
