/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Probes. See probe.h. The mean over nodes m of a set:  sum of V_m q_m / sum of V_m
 */
#include "probe.h"

#include "base/memory.h"
#include "nodes.h"
#include "quantity.h"

#include <math.h>

struct probe {
    const char *name;
    int quantity;
    size_t count;
    const int64_t *node; /* (count) of the set, or `nearest` */
    int64_t nearest;
};

struct kr_probes {
    size_t count;
    int dim;
    struct probe *probe;
};

static int64_t nearest_to(const struct kr_nodes *nodes, const double *at, double *away) {
    int64_t best = 0;
    *away = INFINITY;
    for (size_t i = 0; i < nodes->n; i++) {
        double square = 0;
        for (int d = 0; d < nodes->dim; d++) {
            double way = nodes->position[i * (size_t)nodes->dim + (size_t)d] - at[d];
            square += way * way;
        }
        if (sqrt(square) < *away) {
            *away = sqrt(square);
            best = (int64_t)i;
        }
    }
    return best;
}

static void make_probe(struct kr_deck *deck, const struct kr_case_probe *from,
                       const struct kr_nodes *nodes, struct probe *to) {
    double away = 0;
    *to = (struct probe){.name = from->name, .quantity = from->quantity, .count = 1};
    if (kr_deck_given(deck, &from->set)) {
        const struct kr_set *set = kr_nodes_set(nodes, from->set);
        to->count = set ? set->count : 0;
        to->node = set ? set->node : NULL;
        return;
    }
    to->nearest = nearest_to(nodes, from->at, &away);
    to->node = &to->nearest;
    if (away > nodes->spacing)
        kr_deck_fault(deck, from->at, "the nearest node is %.3g spacings away; expected a place in the "
                                      "body", away / nodes->spacing);
}

struct kr_probes *kr_probes_create(struct kr_deck *deck, const struct kr_case *c,
                                   const struct kr_nodes *nodes) {
    struct kr_probes *probes = KR_NEW(struct kr_probes, 1);
    const struct kr_case_probe *from = c->probes.item;
    *probes = (struct kr_probes){.count = c->probes.count, .dim = nodes->dim};
    probes->probe = KR_NEW(struct probe, probes->count);
    for (size_t k = 0; k < probes->count; k++)
        make_probe(deck, &from[k], nodes, &probes->probe[k]);
    return probes;
}

void kr_probes_free(struct kr_probes *probes) {
    kr_free(probes->probe);
    kr_free(probes);
}

void kr_probes_header(const struct kr_probes *probes, FILE *file) {
    for (size_t k = 0; k < probes->count; k++) {
        const struct probe *p = &probes->probe[k];
        const struct kr_quantity_kind *kind = &kr_quantities[p->quantity];
        char word[32];
        kr_case_word(KR_QUANTITY_WORDS, p->quantity, word);
        for (int m = 0; m < kind->components; m++)
            if (kr_quantity_has(p->quantity, m, probes->dim))
                fprintf(file, ",%s%s %s [%s]", word, kind->suffix[m], p->name, kind->unit);
    }
}

static void mean_of(const struct probe *p, const struct kr_body *body, double *const v[3],
                    double mean[KR_TENSOR]) {
    double value[KR_LANES][KR_TENSOR], volume = 0;
    size_t known = SIZE_MAX; /* the slice in `value`: nodes of sets ascend */
    for (int m = 0; m < KR_TENSOR; m++)
        mean[m] = 0;
    for (size_t k = 0; k < p->count; k++) {
        size_t i = (size_t)p->node[k];
        if (i / KR_LANES != known)
            kr_quantity_slice(p->quantity, body, v, known = i / KR_LANES, value);
        volume += body->bonds->volume[i];
        for (int m = 0; m < KR_TENSOR; m++)
            mean[m] += body->bonds->volume[i] * value[i % KR_LANES][m];
    }
    for (int m = 0; m < KR_TENSOR; m++)
        mean[m] /= volume;
}

void kr_probes_write(const struct kr_probes *probes, const struct kr_body *body, double *const v[3],
                     FILE *file) {
    double mean[KR_TENSOR];
    for (size_t k = 0; k < probes->count; k++) {
        const struct probe *p = &probes->probe[k];
        mean_of(p, body, v, mean);
        for (int m = 0; m < KR_TENSOR; m++)
            if (kr_quantity_has(p->quantity, m, probes->dim))
                fprintf(file, ",%.9g", mean[m]);
    }
}
