/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Numbers of nodes and elements. See gather_order.h.
 */
#include "gather_order.h"

#include "base/error.h"
#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

static int by_tag(const void *a, const void *b) {
    size_t p = ((const struct kr_gather_node *)a)->tag, q = ((const struct kr_gather_node *)b)->tag;
    return (p > q) - (p < q);
}

static void sort_nodes(struct kr_gather *gather) {
    struct kr_gather_node *node = gather->node;
    size_t k = 1;
    while (k < gather->n_nodes && node[k].tag > node[k - 1].tag)
        k++;
    if (k < gather->n_nodes)
        qsort(node, gather->n_nodes, sizeof *node, by_tag);
    for (k = 1; k < gather->n_nodes; k++)
        if (node[k].tag == node[k - 1].tag)
            kr_stop(KR_EXIT_INPUT, "%s: node %zu stands twice in the file", gather->path,
                    node[k].tag);
}

/** Place of a node: at once where the numbers have no gaps, else by halving. */
static size_t place_of(const struct kr_gather *gather, size_t tag) {
    const struct kr_gather_node *node = gather->node;
    size_t low = 0, high = gather->n_nodes;
    if (high && tag >= node[0].tag && tag - node[0].tag < high && node[tag - node[0].tag].tag == tag)
        return node[tag - node[0].tag].place;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (node[middle].tag == tag)
            return node[middle].place;
        if (node[middle].tag < tag)
            low = middle + 1;
        else
            high = middle;
    }
    kr_stop(KR_EXIT_INPUT, "%s: an element has node %zu, which %s does not hold", gather->path, tag,
            "$Nodes");
}

/** Whether the nodes stand in the file by their numbers, without gaps: then these tell the places. */
static int is_in_turn(const struct kr_gather *gather) {
    const struct kr_gather_node *node = gather->node;
    for (size_t k = 0; k < gather->n_nodes; k++)
        if (node[k].tag != node[0].tag + k || node[k].place != k)
            return 0;
    return 1;
}

void kr_gather_resolve(struct kr_gather *gather) {
    sort_nodes(gather);
    const size_t in_turn = is_in_turn(gather) ? gather->n_nodes : 0;
    const size_t least = in_turn ? gather->node[0].tag : 0;
    for (int dim = 0; dim < 4; dim++) {
        size_t *node = gather->pile[dim].node;
        for (size_t k = 0; k < gather->pile[dim].n_nodes; k++) {
            size_t place = node[k] - least; /* huge where the number is smaller */
            node[k] = place < in_turn ? place : place_of(gather, node[k]);
        }
    }
}

/* ---- elements ---- */

struct numbered {
    size_t tag, at;
};

static int by_number(const void *a, const void *b) {
    const struct numbered *p = a, *q = b;
    if (p->tag != q->tag)
        return p->tag < q->tag ? -1 : 1;
    return (p->at > q->at) - (p->at < q->at);
}

size_t *kr_gather_order(const struct kr_gather *gather, const struct kr_pile *pile) {
    size_t *order = KR_NEW_RAW(size_t, pile->count), k = 1;
    for (size_t i = 0; i < pile->count; i++)
        order[i] = i;
    while (k < pile->count && pile->tag[k] > pile->tag[k - 1])
        k++;
    if (k >= pile->count)
        return order;
    struct numbered *item = KR_NEW(struct numbered, pile->count);
    for (size_t i = 0; i < pile->count; i++)
        item[i] = (struct numbered){pile->tag[i], i};
    qsort(item, pile->count, sizeof *item, by_number);
    for (k = 0; k < pile->count; k++) {
        if (k && item[k].tag == item[k - 1].tag)
            kr_stop(KR_EXIT_INPUT, "%s: element %zu stands twice in the file", gather->path,
                    item[k].tag);
        order[k] = item[k].at;
    }
    kr_free(item);
    return order;
}

static int is_same(const struct kr_pile *pile, size_t a, size_t b) {
    return pile->type[a] == pile->type[b] &&
           !memcmp(pile->node + pile->first[a], pile->node + pile->first[b],
                   kr_element(pile->type[a])->nodes * sizeof *pile->node);
}

/** Whether two elements are in a group together: then they are no copies but a fault. */
static int share_group(const size_t *group_of, size_t a, size_t b) {
    return group_of[a] == group_of[b];
}

size_t *kr_gather_merge(const struct kr_gather *gather, int dim) {
    const struct kr_pile *pile = &gather->pile[dim];
    size_t *stands = KR_NEW_RAW(size_t, pile->count);
    for (size_t k = 0; k < pile->count; k++)
        stands[k] = k;
    if (!gather->merges)
        return stands;
    size_t *group_of = KR_NEW(size_t, pile->count);
    size_t *next = KR_NEW(size_t, pile->count), *head = KR_NEW(size_t, gather->n_nodes);
    for (size_t g = 0; g < gather->n_groups; g++)
        for (size_t k = 0; gather->group[g].dim == dim && k < gather->group[g].count; k++)
            group_of[gather->group[g].member[k]] = g + 1;
    for (size_t k = 0; k < pile->count; k++) {
        size_t *at = &head[pile->node[pile->first[k]]], other = *at;
        while (other && (!is_same(pile, other - 1, k) || share_group(group_of, other - 1, k)))
            other = next[other - 1];
        if (other)
            stands[k] = stands[other - 1];
        next[k] = *at;
        *at = k + 1;
    }
    kr_free(head);
    kr_free(next);
    kr_free(group_of);
    return stands;
}
