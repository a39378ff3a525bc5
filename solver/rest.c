/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Rest and relaxation. See rest.h.
 */
#include "rest.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

struct kr_rest *kr_rest_create(struct kr_body *body) {
    struct kr_rest *rest = KR_NEW(struct kr_rest, 1);
    *rest = (struct kr_rest){.body = body, .fixed = KR_NEW(unsigned char, body->n)};
    for (int d = 0; d < body->dim; d++)
        rest->load[d] = kr_bonds_padded(body->n);
    return rest;
}

void kr_rest_free(struct kr_rest *rest) {
    for (int d = 0; d < rest->body->dim; d++)
        kr_bonds_padded_free(rest->load[d]);
    kr_free(rest->fixed);
    kr_free(rest);
}

void kr_rest_loads(struct kr_rest *rest, struct kr_boundary *boundary, double t) {
    struct kr_body pushed = *rest->body;
    memset(rest->fixed, 0, rest->body->n);
    kr_boundary_fixed(boundary, rest->fixed);
    for (int d = 0; d < pushed.dim; d++) {
        pushed.force[d] = rest->load[d];
        memset(rest->load[d], 0, pushed.n * sizeof(double));
    }
    kr_boundary_push(boundary, &pushed, t);
}

static double left_of_node(const void *context, size_t i) {
    const struct kr_rest *rest = context;
    double sum = 0;
    for (int d = 0; d < rest->body->dim; d++)
        if (!(rest->fixed[i] >> d & 1))
            sum += fabs(rest->body->force[d][i]);
    return sum * rest->body->bonds->volume[i];
}

static double pull_of_node(const void *context, size_t i) {
    const struct kr_rest *rest = context;
    double sum = 0;
    for (int d = 0; d < rest->body->dim; d++)
        sum += fabs(rest->load[d][i]) +
               (rest->fixed[i] >> d & 1 ? fabs(rest->body->force[d][i]) : 0);
    return 0.5 * sum * rest->body->bonds->volume[i];
}

double kr_rest_measure(struct kr_rest *rest) {
    double left = kr_body_sum(rest->body->n, left_of_node, rest);
    rest->pull = kr_body_sum(rest->body->n, pull_of_node, rest);
    return rest->residual = left == 0 ? 0 : left / fmax(rest->pull, rest->least_pull);
}

/* Whether prescribed components and loads are where they will be at `end`. */
static int is_loaded(struct kr_rest *rest, struct kr_boundary *boundary, double t, double end) {
    const struct kr_body *body = rest->body;
    double *now[3] = {0}, *way[3] = {0}, changed = 0;
    for (int d = 0; d < body->dim; d++) {
        now[d] = kr_bonds_padded(body->n);
        way[d] = kr_bonds_padded(body->n);
        memcpy(now[d], rest->load[d], body->n * sizeof(double));
    }
    kr_boundary_way(boundary, body, t, end, way);
    kr_rest_loads(rest, boundary, end);
    for (int d = 0; d < body->dim; d++)
        for (size_t i = 0; i < body->n; i++) {
            /* A displacement is reached but for rounding of its last digits. */
            changed = fmax(changed, fabs(way[d][i]) / body->bonds->material.horizon - 1e-9);
            changed = fmax(changed, fabs(now[d][i] - rest->load[d][i]));
        }
    kr_rest_loads(rest, boundary, t);
    for (int d = 0; d < body->dim; d++) {
        kr_bonds_padded_free(now[d]);
        kr_bonds_padded_free(way[d]);
    }
    return changed <= 0;
}

/* Of each force, against the motion: every wave then loses the same share of its energy a period,
 * as with a quarter of critical damping (Cundall 1987; 0.8/pi). */
static const double LOCAL_DAMPING = 0.8;

void kr_rest_damp(struct kr_rest *rest) {
    struct kr_body *body = rest->body;
    for (int d = 0; d < body->dim; d++) {
        double *force = body->force[d];
        const double *v = body->v[d];
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < body->n; i++)
            if (!(rest->fixed[i] >> d & 1) && v[i] != 0)
                force[i] -= copysign(LOCAL_DAMPING * fabs(force[i]), v[i]);
    }
}

int kr_rest_step(struct kr_rest *rest, struct kr_boundary *boundary, double t, double end,
                 double tolerance) {
    kr_rest_loads(rest, boundary, t);
    int resting = kr_rest_measure(rest) <= tolerance && is_loaded(rest, boundary, t, end);
    kr_rest_damp(rest);
    return resting;
}
