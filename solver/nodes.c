/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Nodes in memory: making, ordering and checking them. The file is nodes_file.c's.
 */
#include "nodes.h"

#include "base/error.h"
#include "base/memory.h"
#include "search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct kr_nodes *kr_nodes_create(int dim, size_t n) {
    struct kr_nodes *nodes = KR_NEW(struct kr_nodes, 1);
    nodes->dim = dim;
    nodes->n = n;
    nodes->position = KR_NEW(double, n *(size_t)dim);
    nodes->volume = KR_NEW(double, n);
    nodes->factor = KR_NEW(double, n);
    nodes->tag = KR_NEW(int64_t, n);
    for (size_t i = 0; i < n; i++) {
        nodes->factor[i] = 1;
        nodes->tag[i] = (int64_t)i + 1;
    }
    return nodes;
}

void kr_nodes_free(struct kr_nodes *nodes) {
    for (size_t s = 0; s < nodes->n_sets; s++) {
        kr_free(nodes->set[s].name);
        kr_free(nodes->set[s].node);
    }
    kr_free(nodes->set);
    kr_free(nodes->position);
    kr_free(nodes->volume);
    kr_free(nodes->factor);
    kr_free(nodes->axis_factor);
    kr_free(nodes->partition);
    kr_free(nodes->tag);
    kr_free(nodes->point);
    kr_free(nodes->first);
    kr_free(nodes->vertex);
    kr_free(nodes);
}

const struct kr_set *kr_nodes_set(const struct kr_nodes *nodes, const char *name) {
    for (size_t s = 0; s < nodes->n_sets; s++)
        if (!strcmp(nodes->set[s].name, name))
            return &nodes->set[s];
    return NULL;
}

struct kr_set *kr_nodes_add_set(struct kr_nodes *nodes, const char *name, size_t count,
                                int64_t *node, double measure) {
    nodes->set = kr_realloc(nodes->set, nodes->n_sets + 1, sizeof *nodes->set);
    nodes->set[nodes->n_sets] = (struct kr_set){kr_text_copy(name), count, node, measure};
    return &nodes->set[nodes->n_sets++];
}

/* ---- order ---- */

static void reorder_cells(struct kr_nodes *nodes, const size_t *order) {
    if (!nodes->n_points)
        return;
    int64_t *first = KR_NEW(int64_t, nodes->n + 1);
    int64_t *vertex = KR_NEW(int64_t, (size_t)nodes->first[nodes->n]);
    for (size_t k = 0; k < nodes->n; k++) {
        int64_t begin = nodes->first[order[k]], count = nodes->first[order[k] + 1] - begin;
        first[k + 1] = first[k] + count;
        memcpy(vertex + first[k], nodes->vertex + begin, (size_t)count * sizeof *vertex);
    }
    kr_free(nodes->first);
    kr_free(nodes->vertex);
    nodes->first = first;
    nodes->vertex = vertex;
}

static int ascending(const void *p, const void *q) {
    int64_t a = *(const int64_t *)p, b = *(const int64_t *)q;
    return (a > b) - (a < b);
}

static void reorder_sets(struct kr_nodes *nodes, const size_t *order) {
    int64_t *now_at = KR_NEW(int64_t, nodes->n);
    for (size_t k = 0; k < nodes->n; k++)
        now_at[order[k]] = (int64_t)k;
    for (size_t s = 0; s < nodes->n_sets; s++) {
        struct kr_set *set = &nodes->set[s];
        for (size_t k = 0; k < set->count; k++)
            set->node[k] = now_at[set->node[k]];
        qsort(set->node, set->count, sizeof *set->node, ascending);
    }
    kr_free(now_at);
}

void kr_nodes_reorder(struct kr_nodes *nodes, const size_t *order) {
    kr_assert(!nodes->axis_factor && !nodes->partition); /* made once the order stands */
    size_t dim = (size_t)nodes->dim;
    double *position = KR_NEW(double, nodes->n *dim), *volume = KR_NEW(double, nodes->n);
    double *factor = KR_NEW(double, nodes->n);
    int64_t *tag = KR_NEW(int64_t, nodes->n);
    for (size_t k = 0; k < nodes->n; k++) {
        memcpy(position + k * dim, nodes->position + order[k] * dim, dim * sizeof *position);
        volume[k] = nodes->volume[order[k]];
        factor[k] = nodes->factor[order[k]];
        tag[k] = nodes->tag[order[k]];
    }
    kr_free(nodes->position);
    kr_free(nodes->volume);
    kr_free(nodes->factor);
    kr_free(nodes->tag);
    nodes->position = position;
    nodes->volume = volume;
    nodes->factor = factor;
    nodes->tag = tag;
    reorder_cells(nodes, order);
    reorder_sets(nodes, order);
}

/* ---- checks ---- */

/* m. Squares of distances must stay numbers. */
static const double farthest = 1e100;

static char *fault_of_numbers(const struct kr_nodes *nodes) {
    size_t dim = (size_t)nodes->dim;
    for (size_t i = 0; i < nodes->n; i++) {
        for (size_t d = 0; d < dim; d++)
            if (!isfinite(nodes->position[i * dim + d]))
                return kr_text("node %zu (tag %lld) has the position %g; expected a finite number",
                               i, (long long)nodes->tag[i], nodes->position[i * dim + d]);
            else if (fabs(nodes->position[i * dim + d]) > farthest)
                return kr_text("node %zu (tag %lld) stands at %g m; expected at most %g", i,
                               (long long)nodes->tag[i], nodes->position[i * dim + d], farthest);
        if (!(nodes->volume[i] > 0) || !isfinite(nodes->volume[i]))
            return kr_text("node %zu (tag %lld) has the volume %g; expected a positive number", i,
                           (long long)nodes->tag[i], nodes->volume[i]);
        for (size_t d = 0; d < dim && nodes->axis_factor; d++)
            if (!(nodes->axis_factor[i * dim + d] > 0) || !isfinite(nodes->axis_factor[i * dim + d]))
                return kr_text("node %zu (tag %lld) has the axis factor %g; expected a positive one",
                               i, (long long)nodes->tag[i], nodes->axis_factor[i * dim + d]);
        if (!isfinite(nodes->factor[i]))
            return kr_text("node %zu (tag %lld) has the surface factor %g; expected a finite one",
                           i, (long long)nodes->tag[i], nodes->factor[i]);
    }
    return NULL;
}

static char *fault_of_sets(const struct kr_nodes *nodes) {
    for (size_t s = 0; s < nodes->n_sets; s++) {
        const struct kr_set *set = &nodes->set[s];
        for (size_t k = 0; k < set->count; k++)
            if (set->node[k] < 0 || set->node[k] >= (int64_t)nodes->n ||
                (k && set->node[k] <= set->node[k - 1]))
                return kr_text("set '%s' holds the node %lld at place %zu; expected ascending "
                               "numbers from 0 to %zu",
                               set->name, (long long)set->node[k], k, nodes->n - 1);
    }
    return NULL;
}

/* Tetrahedra, pyramids, wedges and hexahedra of first and second order; 24 or more: a polyhedron as
 * so many tetrahedra. */
static int is_solid(int64_t vertices) {
    static const int64_t known[] = {4, 5, 6, 8, 10, 13, 15, 20};
    for (size_t k = 0; k < sizeof known / sizeof *known; k++)
        if (vertices == known[k])
            return 1;
    return vertices >= 24 && vertices % 4 == 0;
}

/* Where the corners of each cell begin: looked at before any corner, for a place beyond the end may stand
 * anywhere in between. */
static char *fault_of_begins(const struct kr_nodes *nodes) {
    for (size_t i = 0; i < nodes->n; i++) {
        if (nodes->first[i] < 0 || nodes->first[i + 1] < nodes->first[i])
            return kr_text("the corners of node %zu's cell begin at %lld, and those of the next at %lld; "
                           "expected ascending places", i, (long long)nodes->first[i],
                           (long long)nodes->first[i + 1]);
        int64_t corners = nodes->first[i + 1] - nodes->first[i];
        if (corners < 3)
            return kr_text("the cell of node %zu has fewer than 3 corners", i);
        if (nodes->dim == 3 && !is_solid(corners))
            return kr_text("the cell of node %zu has %lld vertices, and no solid has so many", i,
                           (long long)corners);
    }
    return NULL;
}

static char *fault_of_cells(const struct kr_nodes *nodes) {
    if (!nodes->n_points)
        return NULL;
    char *fault = fault_of_begins(nodes);
    for (size_t i = 0; i < nodes->n && !fault; i++)
        for (int64_t k = nodes->first[i]; k < nodes->first[i + 1] && !fault; k++)
            if (nodes->vertex[k] < 0 || nodes->vertex[k] >= (int64_t)nodes->n_points)
                fault = kr_text("the cell of node %zu has the corner %lld; expected 0 to %zu", i,
                                (long long)nodes->vertex[k], nodes->n_points - 1);
    return fault;
}

/* Two nodes at one place have no bond direction. A millionth of the spacing is one place. */
static char *fault_of_places(const struct kr_nodes *nodes) {
    size_t dim = (size_t)nodes->dim;
    char *fault = NULL;
    struct kr_search *search =
        kr_search_create(nodes->dim, nodes->n, nodes->position, 0.25 * nodes->spacing);
    int near[1];
    for (size_t i = 0; i < nodes->n && !fault; i++) {
        if (!kr_search_near(search, i, near, 1))
            continue;
        double square = 0;
        for (size_t d = 0; d < dim; d++)
            square += pow(nodes->position[i * dim + d] -
                              nodes->position[(size_t)near[0] * dim + d], 2);
        if (sqrt(square) < 1e-6 * nodes->spacing)
            fault = kr_text("nodes %zu and %d (tags %lld and %lld) stand at one place (%g, %g) m; "
                            "expected each cell once",
                            i, near[0], (long long)nodes->tag[i], (long long)nodes->tag[near[0]],
                            nodes->position[i * dim], nodes->position[i * dim + 1]);
    }
    kr_search_free(search);
    return fault;
}

char *kr_nodes_fault(const struct kr_nodes *nodes) {
    if (!nodes->n)
        return kr_text_copy("there are no nodes");
    if (!(nodes->spacing > 0) || !isfinite(nodes->spacing))
        return kr_text("the spacing is %g m; expected a positive number", nodes->spacing);
    char *fault = fault_of_numbers(nodes);
    if (!fault)
        fault = fault_of_sets(nodes);
    if (!fault)
        fault = fault_of_cells(nodes);
    return fault ? fault : fault_of_places(nodes);
}
