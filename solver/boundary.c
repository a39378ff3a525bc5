/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Loads. Each load of the deck acts on the nodes of one set, component by component: a component
 * has a formula or is free. Body forces (and tractions) act through the force, prescribed motion
 * through the velocity of the coming half step. Nothing here depends on the number of threads: sets
 * are small and are gone through in order.
 */
#include "boundary_private.h"

void kr_boundary_push(struct kr_boundary *b, struct kr_body *body, double t) {
    for (size_t k = 0; k < b->count; k++) {
        const struct kr_load *load = &b->load[k];
        for (int d = 0; d < b->dim; d++) {
            if (load->kind != BODY_FORCE || !load->part[d].expression)
                continue;
            struct kr_load_value v = kr_load_value_begin(b, load, d, t);
            for (size_t m = 0; m < load->set->count; m++)
                body->force[d][load->set->node[m]] += kr_load_value_of(&v, load->set->node[m]);
        }
    }
}

/* Velocity at t + dt/2 of a prescribed component. */
static struct kr_load_value motion_begin(const struct kr_boundary *b, const struct kr_load *load, int d,
                                 double t, double dt) {
    return kr_load_value_begin(b, load, d, load->kind == VELOCITY ? t + 0.5 * dt : t + dt);
}

static double motion_of(const struct kr_load_value *v, const struct kr_body *body, int d, int64_t i,
                        double dt) {
    double value = kr_load_value_of(v, i);
    return v->load->kind == VELOCITY ? value : (value - body->u[d][i]) / dt;
}

void kr_boundary_hold(struct kr_boundary *b, struct kr_body *body, double t, double dt) {
    for (size_t k = 0; k < b->count; k++) {
        const struct kr_load *load = &b->load[k];
        for (int d = 0; d < b->dim; d++) {
            if (load->kind == BODY_FORCE || !load->part[d].expression)
                continue;
            struct kr_load_value v = motion_begin(b, load, d, t, dt);
            for (size_t m = 0; m < load->set->count; m++) {
                int64_t i = load->set->node[m];
                body->v[d][i] = motion_of(&v, body, d, i, dt);
                body->force[d][i] = 0;
            }
        }
    }
}

void kr_boundary_start(struct kr_boundary *b, struct kr_body *body, double dt) {
    for (size_t k = 0; k < b->count; k++) {
        const struct kr_load *load = &b->load[k];
        for (int d = 0; d < b->dim; d++) {
            if (load->kind == BODY_FORCE || !load->part[d].expression)
                continue;
            struct kr_load_value now = kr_load_value_begin(b, load, d, 0), next = motion_begin(b, load, d, 0, dt);
            for (size_t m = 0; m < load->set->count; m++) {
                int64_t i = load->set->node[m];
                if (load->kind == DISPLACEMENT)
                    body->u[d][i] = kr_load_value_of(&now, i);
                body->v[d][i] = load->kind == VELOCITY ? kr_load_value_of(&now, i)
                                                       : motion_of(&next, body, d, i, dt);
            }
        }
    }
}

void kr_boundary_velocity(struct kr_boundary *b, const struct kr_body *body, double t, double dt,
                          int first, double *const v[3]) {
    for (size_t k = 0; k < b->count; k++) {
        const struct kr_load *load = &b->load[k];
        for (int d = 0; d < b->dim; d++) {
            if (load->kind == BODY_FORCE || !load->part[d].expression)
                continue;
            struct kr_load_value motion = motion_begin(b, load, d, t, dt);
            for (size_t m = 0; m < load->set->count; m++) {
                int64_t i = load->set->node[m];
                double before = body->v[d][i], after = motion_of(&motion, body, d, i, dt);
                v[d][i] = first ? before : 0.5 * (before + after);
            }
        }
    }
}

/* Force of one load's component d on the body; its power is added. */
static double pull_of(const struct kr_boundary *b, const struct kr_load *load,
                      const struct kr_body *body, int d, double t, double dt, int first,
                      double *power) {
    const double density = body->bonds->material.density, kick = first ? 0.5 * dt : dt;
    double sum = 0;
    int moves = load->kind != BODY_FORCE;
    struct kr_load_value v = moves ? motion_begin(b, load, d, t, dt) : kr_load_value_begin(b, load, d, t);
    for (size_t m = 0; m < load->set->count; m++) {
        int64_t i = load->set->node[m];
        double before = body->v[d][i], volume = body->bonds->volume[i];
        double after = moves ? motion_of(&v, body, d, i, dt)
                             : before + kick * body->force[d][i] / density;
        double pull = moves ? volume * (density * (after - before) / kick - body->force[d][i])
                            : volume * kr_load_value_of(&v, i);
        sum += pull;
        *power += pull * (first ? before : 0.5 * (before + after));
    }
    return sum;
}

double kr_boundary_power(struct kr_boundary *b, const struct kr_body *body, double t, double dt,
                         int first) {
    double power = 0;
    for (size_t k = 0; k < b->count; k++)
        for (int d = 0; d < b->dim; d++)
            if (b->load[k].part[d].expression)
                b->load[k].reaction[d] =
                    pull_of(b, &b->load[k], body, d, t, dt, first, &power);
    return power;
}

size_t kr_boundary_count(const struct kr_boundary *b) {
    return b->count;
}

const char *kr_boundary_set(const struct kr_boundary *b, size_t k) {
    return b->load[k].set->name;
}

double kr_boundary_reaction(const struct kr_boundary *b, size_t k, int d) {
    return b->load[k].reaction[d];
}
