/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What the same equilibrium costs by plain nonlinear conjugate gradients (Polak and Ribiere, from the force
 * alone, each step by one product along the line), as the plates paper has it (Zhang et al. 2016): a row of
 * Markdown for the nodes in FOLDER. `make equilibrium` calls it.
 */
#include "base/error.h"
#include "base/memory.h"
#include "base/progress.h"
#include "equilibrium.h"
#include "run.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char usage[] = "plain [--variant V] --output FOLDER case.yaml: print a row of the table.\n";

enum { MOST = 100000 };

struct vector {
    double *d[3];
};

static struct vector vector_of(const struct kr_body *body) {
    struct vector v = {{0}};
    for (int d = 0; d < body->dim; d++)
        v.d[d] = kr_bonds_padded(body->n);
    return v;
}

static void vector_free(const struct kr_body *body, struct vector *v) {
    for (int d = 0; d < body->dim; d++)
        kr_bonds_padded_free(v->d[d]);
}

static double inner(const struct kr_body *body, const struct vector *a, const struct vector *b) {
    double sum = 0;
    for (int d = 0; d < body->dim; d++)
#pragma omp parallel for reduction(+ : sum)
        for (size_t i = 0; i < body->n; i++)
            sum += a->d[d][i] * b->d[d][i];
    return sum;
}

/* r = V f on free components. */
static double forces(struct kr_equilibrium *q, struct vector *r) {
    const struct kr_body *body = q->body;
    double residual = kr_equilibrium_residual(q);
    for (int d = 0; d < body->dim; d++)
#pragma omp parallel for
        for (size_t i = 0; i < body->n; i++)
            r->d[d][i] = q->rest->fixed[i] >> d & 1 ? 0 : body->bonds->volume[i] * body->force[d][i];
    return residual;
}

/* p.A p by one pass over the bonds. */
static double curvature(struct kr_body *body, const struct vector *p, struct vector *y) {
    kr_body_product(body, p->d, y->d);
    for (int d = 0; d < body->dim; d++)
#pragma omp parallel for
        for (size_t i = 0; i < body->n; i++)
            y->d[d][i] *= -body->bonds->volume[i];
    return inner(body, p, y);
}

/* to = from + factor to, or to += factor from */
static void combine(const struct kr_body *body, struct vector *to, double scale, const struct vector *from,
                    double factor) {
    for (int d = 0; d < body->dim; d++)
#pragma omp parallel for
        for (size_t i = 0; i < body->n; i++)
            to->d[d][i] = scale * to->d[d][i] + factor * from->d[d][i];
}

/* Returns the number of passes over the bonds. */
static int minimise(struct kr_equilibrium *q) {
    struct kr_body *body = q->body;
    struct vector r = vector_of(body), before = vector_of(body), p = vector_of(body), y = vector_of(body);
    struct vector u = {{body->u[0], body->u[1], body->u[2]}};
    double residual = forces(q, &r), square = inner(body, &r, &r);
    int passes = 1;
    combine(body, &p, 0, &r, 1);
    while (residual > q->tolerance && passes < MOST) {
        double bend = curvature(body, &p, &y), along = inner(body, &r, &p);
        if (!(bend > 0) || !(along > 0)) {
            combine(body, &p, 0, &r, 1);
            bend = curvature(body, &p, &y);
            along = square;
            passes++;
        }
        combine(body, &u, 1, &p, along / fabs(bend));
        combine(body, &before, 0, &r, 1);
        residual = forces(q, &r);
        passes += 2;
        double was = square;
        square = inner(body, &r, &r);
        combine(body, &p, fmax(0, (square - inner(body, &r, &before)) / was), &r, 1);
    }
    vector_free(body, &r);
    vector_free(body, &before);
    vector_free(body, &p);
    vector_free(body, &y);
    return passes;
}

int main(int argc, char **argv) {
    struct kr_case_arguments arguments;
    struct kr_case c;
    kr_error_program("plain");
    kr_case_arguments(argc, argv, usage, &arguments);
    struct kr_deck *deck = kr_case_open(&arguments, &c);
    struct kr_run *run = kr_run_create(deck, &c);
    struct kr_equilibrium *q = kr_equilibrium_create(run->body);
    double begun = kr_progress_clock();
    q->tolerance = run->stage[0].tolerance;
    kr_rest_loads(q->rest, run->boundary[0], run->stage[0].end);
    kr_boundary_way(run->boundary[0], run->body, 0, run->stage[0].end, q->move);
    for (int d = 0; d < run->body->dim; d++)
        memcpy(run->body->u[d], q->move[d], run->body->n * sizeof(double));
    int passes = minimise(q);
    printf("%zu %.1e %d %.1f\n", run->body->n, q->rest->residual, passes, kr_progress_clock() - begun);
    kr_equilibrium_free(q);
    kr_run_free(run);
    kr_deck_close(deck);
    kr_free(arguments.set);
    kr_free(arguments.left);
    return KR_EXIT_OK;
}
