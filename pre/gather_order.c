/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Numbers of nodes and elements. See gather_order.h.
 */
#include "gather_order.h"

#include "base/error.h"
#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/** A number in the file and the place of what has it. */
struct numbered {
    size_t tag, place;
};

static int by_tag(const void *a, const void *b) {
    const struct numbered *p = a, *q = b;
    if (p->tag != q->tag)
        return p->tag < q->tag ? -1 : 1;
    return (p->place > q->place) - (p->place < q->place);
}

static int is_ascending(const size_t *tag, size_t n) {
    for (size_t k = 1; k < n; k++)
        if (tag[k] <= tag[k - 1])
            return 0;
    return 1;
}

/** The numbers of `what` in ascending order, owned by the caller; stops where one stands twice. */
static struct numbered *sort_tags(const struct kr_gather *gather, const size_t *tag, size_t n, const char *what) {
    struct numbered *item = KR_NEW_RAW(struct numbered, n);
    for (size_t k = 0; k < n; k++)
        item[k] = (struct numbered){tag[k], k};
    if (!is_ascending(tag, n))
        qsort(item, n, sizeof *item, by_tag);
    for (size_t k = 1; k < n; k++)
        if (item[k].tag == item[k - 1].tag)
            kr_stop(KR_EXIT_INPUT, "%s: %s %zu stands twice in the file", gather->path, what, item[k].tag);
    return item;
}

/* ---- nodes ---- */

_Noreturn static void stop_missing(const struct kr_gather *gather, size_t tag) {
    kr_stop(KR_EXIT_INPUT, "%s: an element has node %zu, which $Nodes does not hold", gather->path, tag);
}

/** Place of a node by halving. */
static size_t place_of(const struct kr_gather *gather, const struct numbered *node, size_t tag) {
    size_t low = 0, high = gather->n_nodes;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (node[middle].tag == tag)
            return node[middle].place;
        if (node[middle].tag < tag)
            low = middle + 1;
        else
            high = middle;
    }
    stop_missing(gather, tag);
}

/** Nodes that stand in the file by their numbers, without gaps, as nearly always: these tell the places. */
static void resolve_in_turn(struct kr_gather *gather, size_t least) {
    for (int dim = 0; dim < 4; dim++) {
        struct kr_pile *pile = &gather->pile[dim];
        size_t most = 0;
        for (size_t k = 0; k < pile->n_nodes; k++) {
            pile->node[k] -= least; /* huge where the number is smaller */
            most = pile->node[k] > most ? pile->node[k] : most;
        }
        for (size_t k = 0; most >= gather->n_nodes && k < pile->n_nodes; k++)
            if (pile->node[k] >= gather->n_nodes)
                stop_missing(gather, pile->node[k] + least);
    }
}

/** Nodes in another order or with gaps between their numbers. */
static void resolve_sorted(struct kr_gather *gather) {
    struct numbered *node = sort_tags(gather, gather->node_tag, gather->n_nodes, "node");
    for (int dim = 0; dim < 4; dim++)
        for (size_t k = 0; k < gather->pile[dim].n_nodes; k++)
            gather->pile[dim].node[k] = place_of(gather, node, gather->pile[dim].node[k]);
    kr_free(node);
}

static int is_in_turn(const size_t *tag, size_t n) {
    for (size_t k = 0; k < n; k++)
        if (tag[k] != tag[0] + k)
            return 0;
    return 1;
}

void kr_gather_resolve(struct kr_gather *gather) {
    if (gather->n_nodes && is_in_turn(gather->node_tag, gather->n_nodes))
        resolve_in_turn(gather, gather->node_tag[0]);
    else
        resolve_sorted(gather);
}

/* ---- elements ---- */

size_t *kr_gather_order(const struct kr_gather *gather, const struct kr_pile *pile) {
    if (is_ascending(pile->tag, pile->count))
        return NULL;
    struct numbered *item = sort_tags(gather, pile->tag, pile->count, "element");
    size_t *order = KR_NEW_RAW(size_t, pile->count);
    for (size_t k = 0; k < pile->count; k++)
        order[k] = item[k].place;
    kr_free(item);
    return order;
}

static int is_same(const struct kr_pile *pile, size_t a, size_t b) {
    const size_t *p, *q;
    const struct kr_element *kind = kr_pile_element(pile, a, &p);
    return kind == kr_pile_element(pile, b, &q) && !memcmp(p, q, kind->nodes * sizeof *p);
}

/** Whether two elements are in a group together: then they are no copies but a fault. */
static int share_group(const size_t *group_of, size_t a, size_t b) {
    return group_of[a] == group_of[b];
}

size_t *kr_gather_merge(const struct kr_gather *gather, int dim) {
    const struct kr_pile *pile = &gather->pile[dim];
    if (!gather->merges)
        return NULL;
    size_t *stands = KR_NEW_RAW(size_t, pile->count), *group_of = KR_NEW(size_t, pile->count);
    size_t *next = KR_NEW(size_t, pile->count), *head = KR_NEW(size_t, gather->n_nodes), merged = 0;
    for (size_t g = 0; g < gather->n_groups; g++)
        for (size_t k = 0; gather->group[g].dim == dim && k < gather->group[g].count; k++)
            group_of[gather->group[g].member[k]] = g + 1;
    for (size_t k = 0; k < pile->count; k++) {
        const size_t *node;
        kr_pile_element(pile, k, &node);
        size_t *at = &head[node[0]], other = *at;
        while (other && (!is_same(pile, other - 1, k) || share_group(group_of, other - 1, k)))
            other = next[other - 1];
        stands[k] = other ? stands[other - 1] : k;
        merged += other > 0;
        next[k] = *at;
        *at = k + 1;
    }
    kr_free(head);
    kr_free(next);
    kr_free(group_of);
    return merged ? stands : kr_free(stands);
}
