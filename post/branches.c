/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Count the branches of a crack; the rule stands in branches.h, and its steps are numbered below.
 */
#include "branches.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "near.h"

#define NONE SIZE_MAX

/* Branches count from this many horizons, which is also about as many bands. */
enum { SHORTEST = 3 };

/** A connected piece of a band. Distances count in hops along the graph from the start. */
struct piece {
    size_t crack;     /* connected heap it belongs to */
    size_t before;    /* piece of the band before; NONE at the start */
    size_t behind;    /* pieces linked to it as `before` that lead to a living end */
    size_t near, far; /* its nodes of least and greatest distance */
    int has_next;     /* some piece follows it */
    int joins;        /* two branches meet in it */
    int is_end;
};

/** The damaged nodes as a graph. */
struct graph {
    const struct kr_record *record;
    size_t n;         /* damaged nodes */
    double *position; /* (n x 2) */
    double *time;     /* (n) */
    struct kr_near *near;
    size_t *crack, *hops, *piece, *queue; /* (n) */
    size_t cracks, pieces, room;
    struct piece *list;
    size_t *start;   /* (cracks) earliest node of each */
    size_t band;     /* hops in a band */
    double shortest; /* m: of a branch */
};

static double distance(const double *a, const double *b) {
    return hypot(a[0] - b[0], a[1] - b[1]);
}

static const double *place(const struct graph *graph, size_t node) {
    return graph->position + 2 * node;
}

/* ---- 1: the graph ------------------------------------------------------------------------ */

static void collect_damaged(struct graph *graph) {
    const struct kr_record *record = graph->record;
    graph->position = KR_NEW(double, 2 * record->n);
    graph->time = KR_NEW(double, record->n);
    for (size_t i = 0; i < record->n; i++)
        if (!isinf(record->damage_time[i])) {
            memcpy(graph->position + 2 * graph->n, record->position + 2 * i, 2 * sizeof(double));
            graph->time[graph->n++] = record->damage_time[i];
        }
}

static struct graph graph_of(const struct kr_record *record) {
    struct graph graph = {.record = record, .shortest = SHORTEST * record->horizon};
    double reach = fmax(1.6 * record->spacing, record->horizon / 2);
    double hops = round(record->horizon / reach);
    collect_damaged(&graph);
    graph.near = kr_near_create(graph.n, graph.position, reach);
    graph.band = hops > 1 ? (size_t)hops : 1;
    graph.crack = KR_NEW(size_t, graph.n);
    graph.hops = KR_NEW(size_t, graph.n);
    graph.piece = KR_NEW(size_t, graph.n);
    graph.queue = KR_NEW(size_t, graph.n);
    graph.start = KR_NEW(size_t, graph.n);
    for (size_t i = 0; i < graph.n; i++)
        graph.crack[i] = graph.hops[i] = graph.piece[i] = NONE;
    return graph;
}

static void free_graph(struct graph *graph) {
    kr_near_free(graph->near);
    kr_free(graph->position);
    kr_free(graph->time);
    kr_free(graph->crack);
    kr_free(graph->hops);
    kr_free(graph->piece);
    kr_free(graph->queue);
    kr_free(graph->start);
    kr_free(graph->list);
}

/** Put the unlabelled neighbours of a node, of those that `band_of` allows, into the queue. */
static size_t spread(struct graph *graph, size_t *label, size_t node, size_t end, int in_band) {
    size_t count;
    const size_t *found = kr_near_find(graph->near, place(graph, node), &count);
    for (size_t k = 0; k < count; k++) {
        size_t j = found[k];
        if (label[j] != NONE ||
            (in_band && graph->hops[j] / graph->band != graph->hops[node] / graph->band))
            continue;
        label[j] = label[node];
        graph->queue[end++] = j;
    }
    return end;
}

/** Label all that is connected to a node, within its band or at large; returns how many. */
static size_t flood(struct graph *graph, size_t *label, size_t node, size_t value, int in_band) {
    size_t end = 1;
    label[node] = value;
    graph->queue[0] = node;
    for (size_t k = 0; k < end; k++)
        end = spread(graph, label, graph->queue[k], end, in_band);
    return end;
}

static void find_cracks(struct graph *graph) {
    for (size_t i = 0; i < graph->n; i++) {
        size_t start = i, count;
        if (graph->crack[i] != NONE)
            continue;
        count = flood(graph, graph->crack, i, graph->cracks, 0);
        for (size_t k = 0; k < count; k++)
            if (graph->time[graph->queue[k]] < graph->time[start])
                start = graph->queue[k];
        graph->start[graph->cracks++] = start;
    }
}

/* ---- 2: bands and their pieces ----------------------------------------------------------- */

/** Breadth-first distance of every node from the start of its crack. */
static void find_hops(struct graph *graph) {
    size_t end = 0, count;
    for (size_t i = 0; i < graph->n; i++)
        if (graph->time[i] < 0 || graph->start[graph->crack[i]] == i) {
            graph->hops[i] = 0;
            graph->queue[end++] = i;
        }
    for (size_t k = 0; k < end; k++) {
        size_t i = graph->queue[k];
        const size_t *found = kr_near_find(graph->near, place(graph, i), &count);
        for (size_t f = 0; f < count; f++)
            if (graph->hops[found[f]] == NONE) {
                graph->hops[found[f]] = graph->hops[i] + 1;
                graph->queue[end++] = found[f];
            }
    }
    kr_assert(end == graph->n);
}

static void find_pieces(struct graph *graph) {
    for (size_t i = 0; i < graph->n; i++) {
        size_t count;
        struct piece *piece;
        if (graph->piece[i] != NONE)
            continue;
        KR_GROW(graph->list, graph->pieces, graph->room);
        piece = graph->list + graph->pieces;
        *piece = (struct piece){graph->crack[i], NONE, 0, i, i, 0, 0, 0};
        count = flood(graph, graph->piece, i, graph->pieces++, 1);
        for (size_t k = 0; k < count; k++) {
            size_t j = graph->queue[k];
            if (graph->hops[j] < graph->hops[piece->near])
                piece->near = j;
            if (graph->hops[j] > graph->hops[piece->far])
                piece->far = j;
        }
    }
}

/** Visit every pair of pieces p, q where p follows q, perhaps more than once. */
static void each_link(struct graph *graph, void (*visit)(struct piece *, size_t p, size_t q)) {
    size_t count;
    for (size_t i = 0; i < graph->n; i++) {
        const size_t *found = kr_near_find(graph->near, place(graph, i), &count);
        for (size_t k = 0; k < count; k++)
            if (graph->hops[found[k]] / graph->band + 1 == graph->hops[i] / graph->band)
                visit(graph->list, graph->piece[i], graph->piece[found[k]]);
    }
}

static void link_pieces(struct piece *list, size_t p, size_t q) {
    if (list[p].before == NONE)
        list[p].before = q;
    list[q].has_next = 1;
}

/** The ways back from p's two forerunners to their common one tell whether two branches meet in p:
 *  they are then longer than the few bands over which a rough crack falls into pieces. */
static void note_join(struct piece *list, size_t p, size_t q) {
    size_t back = list[p].before, bands = 0;
    while (back != q && list[back].before != NONE && list[q].before != NONE) {
        back = list[back].before;
        q = list[q].before;
        bands++;
    }
    if (bands >= SHORTEST)
        list[p].joins = 1;
}

/* ---- 3: ends ----------------------------------------------------------------------------- */

/** The first piece of the branch that ends in `p`: behind the last fork, or behind the start, or
 *  where two branches meet. */
static size_t first_of_branch(const struct graph *graph, size_t p) {
    const struct piece *list = graph->list;
    while (!list[p].joins && list[p].before != NONE && list[list[p].before].behind == 1 &&
           list[list[p].before].before != NONE)
        p = list[p].before;
    return p;
}

static double length_of_branch(const struct graph *graph, size_t p) {
    size_t first = first_of_branch(graph, p);
    if (graph->list[first].before == NONE)
        return 0; /* the start itself: nothing grew */
    return distance(place(graph, graph->list[first].near), place(graph, graph->list[p].far));
}

/** Prune the shortest branch, if it is too short. */
static int prune_one(struct graph *graph) {
    size_t shortest = NONE, first;
    double length = graph->shortest;
    for (size_t p = 0; p < graph->pieces; p++)
        if (graph->list[p].is_end && length_of_branch(graph, p) < length) {
            length = length_of_branch(graph, p);
            shortest = p;
        }
    if (shortest == NONE)
        return 0;
    first = first_of_branch(graph, shortest);
    graph->list[shortest].is_end = 0;
    if (graph->list[first].before != NONE)
        graph->list[graph->list[first].before].behind--;
    return 1;
}

/** Count, from an end back to the start, that it is there; up to where another end has done so. */
static void count_back(struct graph *graph, size_t p) {
    struct piece *list = graph->list;
    while (list[p].before != NONE && list[list[p].before].behind++ == 0)
        p = list[p].before;
}

static void find_ends(struct graph *graph) {
    for (size_t p = 0; p < graph->pieces; p++) {
        struct piece *piece = graph->list + p;
        piece->is_end = !piece->has_next;
        if (piece->is_end)
            count_back(graph, p);
    }
    while (prune_one(graph))
        continue;
}

/* ---- 4: continuations across holes ------------------------------------------------------- */

/** Length of the straight line that lies in material, up to `most`. */
static double length_in_material(struct kr_near *material, const double *a, const double *b,
                                 double sample, double most) {
    double length = distance(a, b), inside = 0;
    size_t samples = (size_t)ceil(length / sample);
    for (size_t k = 0; k < samples && inside <= most; k++) {
        double part = ((double)k + 0.5) / (double)samples;
        double at[2] = {a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])};
        if (kr_near_any(material, at))
            inside += length / (double)samples;
    }
    return inside;
}

/** The end of an earlier crack that a crack continues; NONE if there is none. */
static size_t continued_end(const struct graph *graph, size_t crack, struct kr_near *material) {
    size_t start = graph->start[crack], best = NONE;
    double least = graph->shortest;
    for (size_t p = 0; p < graph->pieces; p++) {
        const struct piece *piece = graph->list + p;
        double inside;
        if (!piece->is_end || piece->crack == crack || graph->time[piece->far] > graph->time[start])
            continue;
        inside = length_in_material(material, place(graph, piece->far), place(graph, start),
                                    graph->record->spacing / 2, least);
        if (inside < least) {
            least = inside;
            best = p;
        }
    }
    return best;
}

/** Count the cracks that continue no other, and mark the ends that are continued. */
static size_t count_cracks(const struct graph *graph, char *is_continued) {
    struct kr_near *material =
        kr_near_create(graph->record->n, graph->record->position, graph->record->spacing);
    char *grew = kr_alloc(graph->cracks, 1);
    size_t count = 0;
    for (size_t p = 0; p < graph->pieces; p++)
        if (graph->list[p].is_end)
            grew[graph->list[p].crack] = 1;
    for (size_t c = 0; c < graph->cracks; c++) {
        size_t end = NONE;
        if (grew[c] && graph->time[graph->start[c]] >= 0)
            end = continued_end(graph, c, material);
        if (end != NONE)
            is_continued[end] = 1;
        count += grew[c] && end == NONE;
    }
    kr_free(grew);
    kr_near_free(material);
    return count;
}

struct kr_branches kr_branches_count(const struct kr_record *record) {
    struct kr_branches result = {0};
    struct graph graph = graph_of(record);
    result.damaged = graph.n;
    result.countable = 2 * graph.n <= record->n;
    if (result.countable && graph.n) {
        char *is_continued;
        find_cracks(&graph);
        find_hops(&graph);
        find_pieces(&graph);
        each_link(&graph, link_pieces);
        each_link(&graph, note_join);
        find_ends(&graph);
        is_continued = kr_alloc(graph.pieces, 1);
        result.cracks = count_cracks(&graph, is_continued);
        for (size_t p = 0; p < graph.pieces; p++)
            result.branches += graph.list[p].is_end && !is_continued[p];
        kr_free(is_continued);
    }
    free_graph(&graph);
    return result;
}
