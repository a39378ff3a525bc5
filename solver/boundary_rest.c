/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Loads on a body at rest: what is prescribed, how far it moves in a load step, and what holds it.
 */
#include "boundary_private.h"

void kr_boundary_fixed(const struct kr_boundary *b, unsigned char *fixed) {
    for (size_t k = 0; k < b->count; k++)
        for (int d = 0; d < b->dim; d++)
            if (b->load[k].kind != BODY_FORCE && b->load[k].part[d].expression)
                for (size_t m = 0; m < b->load[k].set->count; m++)
                    fixed[b->load[k].set->node[m]] |= (unsigned char)(1u << d);
}

void kr_boundary_way(struct kr_boundary *b, const struct kr_body *body, double from, double t,
                     double *const move[3]) {
    for (size_t k = 0; k < b->count; k++) {
        const struct kr_load *load = &b->load[k];
        for (int d = 0; d < b->dim; d++) {
            int moves = load->kind == VELOCITY;
            if (load->kind == BODY_FORCE || !load->part[d].expression)
                continue;
            struct kr_load_value v =
                kr_load_value_begin(b, load, d, moves ? 0.5 * (from + t) : t);
            for (size_t m = 0; m < load->set->count; m++) {
                int64_t i = load->set->node[m];
                double value = kr_load_value_of(&v, i);
                move[d][i] = moves ? value * (t - from) : value - body->u[d][i];
            }
        }
    }
}

void kr_boundary_rest(struct kr_boundary *b, const struct kr_body *body, double t) {
    for (size_t k = 0; k < b->count; k++) {
        struct kr_load *load = &b->load[k];
        for (int d = 0; d < b->dim; d++) {
            double sum = 0;
            if (!load->part[d].expression)
                continue;
            struct kr_load_value v = kr_load_value_begin(b, load, d, t);
            for (size_t m = 0; m < load->set->count; m++) {
                int64_t i = load->set->node[m];
                sum += body->bonds->volume[i] *
                       (load->kind == BODY_FORCE ? kr_load_value_of(&v, i) : -body->force[d][i]);
            }
            load->reaction[d] = sum;
        }
    }
}

int kr_boundary_moves(const struct kr_boundary *b, size_t k) {
    return b->load[k].kind != BODY_FORCE;
}

const struct kr_set *kr_boundary_nodes(const struct kr_boundary *b, size_t k) {
    return b->load[k].set;
}
