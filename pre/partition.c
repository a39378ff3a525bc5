/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The bond graph and METIS. See partition.h.
 */
#include "partition.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/progress.h"
#include "bonds.h"

#include <math.h>
#include <metis.h>

/* The graph as METIS wants it: the neighbours of node i are to[first[i]] to to[first[i + 1] - 1].
 */
struct graph {
    idx_t n, *first, *to, *weight;
};

/* Count or store the neighbours of one slice's nodes. `next` NULL: count into first[i + 1]. */
static void take_slice(const struct kr_bonds *b, size_t slice, struct graph *g, idx_t *next) {
    struct kr_bond_walk walk = kr_bonds_walk(b, slice);
    struct kr_bond bond;
    while (kr_bonds_next(b, &walk, &bond))
        if (next)
            g->to[next[bond.i]++] = (idx_t)bond.j;
        else
            g->first[bond.i + 1]++;
}

static struct graph make_graph(const struct kr_bonds *b) {
    struct graph g = {.n = (idx_t)b->n};
    idx_t *next = KR_NEW(idx_t, b->n);
    g.first = KR_NEW(idx_t, b->n + 1);
    g.to = KR_NEW(idx_t, b->count);
    g.weight = KR_NEW(idx_t, b->n);
#pragma omp parallel for schedule(dynamic, 256)
    for (size_t slice = 0; slice < b->n_slices; slice++)
        take_slice(b, slice, &g, NULL);
    for (size_t i = 0; i < b->n; i++) {
        g.weight[i] = g.first[i + 1];
        next[i] = g.first[i];
        g.first[i + 1] += g.first[i];
    }
#pragma omp parallel for schedule(dynamic, 256)
    for (size_t slice = 0; slice < b->n_slices; slice++)
        take_slice(b, slice, &g, next);
    kr_free(next);
    return g;
}

static void divide(struct graph *g, idx_t parts, idx_t *part) {
    idx_t options[METIS_NOPTIONS], constraints = 1, cut;
    METIS_SetDefaultOptions(options);
    options[METIS_OPTION_SEED] = 1;
    int status = parts == 1
                     ? METIS_OK /* it fails at one part */
                     : METIS_PartGraphKway(&g->n, &constraints, g->first, g->to, g->weight, NULL,
                                           NULL, &parts, NULL, NULL, options, &cut, part);
    if (status == METIS_ERROR_MEMORY)
        kr_stop(KR_EXIT_MEMORY, "METIS has not enough memory for %lld bonds",
                (long long)g->first[g->n]);
    if (status != METIS_OK)
        kr_stop(KR_EXIT_LIBRARY, "METIS cannot divide the nodes into %lld parts; take fewer",
                (long long)parts);
}

static void judge(const struct graph *g, int parts, const idx_t *part,
                  struct kr_partition_report *report) {
    size_t *nodes = KR_NEW(size_t, (size_t)parts), *work = KR_NEW(size_t, (size_t)parts);
    size_t ends = 0, heaviest = 0;
    for (idx_t i = 0; i < g->n; i++) {
        nodes[part[i]]++;
        work[part[i]] += (size_t)g->weight[i];
        for (idx_t k = g->first[i]; k < g->first[i + 1]; k++)
            ends += part[i] != part[g->to[k]];
    }
    report->bonds = (size_t)g->first[g->n] / 2;
    report->cut = ends / 2;
    report->least = report->most = nodes[0];
    for (int k = 0; k < parts; k++) {
        report->least = nodes[k] < report->least ? nodes[k] : report->least;
        report->most = nodes[k] > report->most ? nodes[k] : report->most;
        heaviest = work[k] > heaviest ? work[k] : heaviest;
    }
    report->balance = (double)heaviest * parts / (double)g->first[g->n];
    kr_free(nodes);
    kr_free(work);
}

struct kr_partition_report kr_partition_make(struct kr_nodes *nodes, double horizon,
                                             int partial_volume, int parts) {
    struct kr_partition_report report = {0};
    struct kr_material none = {
        .law = kr_laws[0], .horizon = horizon, .micromodulus = 1, .critical_stretch = INFINITY};
    double begun = kr_progress_clock();
    /* A graph has both ends of each bond; only one-sided weights may have one. */
    if (partial_volume == KR_PARTIAL_VOLUME_HHB_ONE_SIDED)
        partial_volume = KR_PARTIAL_VOLUME_HHB;
    struct kr_bonds *bonds = kr_bonds_create(nodes, &none, partial_volume);
    if (bonds->count > IDX_MAX)
        kr_stop(KR_EXIT_INPUT,
                "%zu bonds are more than METIS can number, %lld; take a coarser "
                "spacing or a smaller horizon",
                bonds->count, (long long)IDX_MAX);
    struct graph g = make_graph(bonds);
    kr_bonds_free(bonds);
    idx_t *part = KR_NEW(idx_t, nodes->n);
    divide(&g, parts, part);
    judge(&g, parts, part, &report);
    kr_free(nodes->partition);
    nodes->partition = KR_NEW(int64_t, nodes->n);
    for (size_t i = 0; i < nodes->n; i++)
        nodes->partition[i] = part[i];
    kr_free(g.first);
    kr_free(g.to);
    kr_free(g.weight);
    kr_free(part);
    report.seconds = kr_progress_clock() - begun;
    return report;
}
