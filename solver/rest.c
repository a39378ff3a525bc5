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
    return rest->residual = left == 0 ? 0 : left / rest->pull;
}

static double power_of_node(const void *context, size_t i) {
    const struct kr_rest *rest = context;
    double sum = 0;
    for (int d = 0; d < rest->body->dim; d++)
        if (!(rest->fixed[i] >> d & 1))
            sum += rest->body->force[d][i] * rest->body->v[d][i];
    return sum * rest->body->bonds->volume[i];
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

void kr_rest_stop(struct kr_rest *rest) {
    struct kr_body *body = rest->body;
    if (kr_body_sum(body->n, power_of_node, rest) >= 0)
        return;
    for (int d = 0; d < body->dim; d++)
        for (size_t i = 0; i < body->n; i++)
            if (!(rest->fixed[i] >> d & 1))
                body->v[d][i] = 0;
}

int kr_rest_step(struct kr_rest *rest, struct kr_boundary *boundary, double t, double end,
                 double tolerance) {
    kr_rest_loads(rest, boundary, t);
    kr_rest_stop(rest);
    return kr_rest_measure(rest) <= tolerance && is_loaded(rest, boundary, t, end);
}
