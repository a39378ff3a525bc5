/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Arrival and length from the sources, steps (3) and (4) of front.h: two floods by a priority queue
 * (Dijkstra, Numer. Math. 1, 1959). The order (arrival, length, rank) is total, so that the result
 * does not depend on how the queue breaks ties.
 */
#include "front.h"

#include <math.h>

#include "base/memory.h"

#define NONE KR_FRONT_NONE

struct entry {
    double arrival, length;
    size_t rank, i;
};

/** A binary heap; entries that were overtaken stay in it and are passed over. */
struct queue {
    struct entry *item; /* item[0] is the least */
    size_t count, room;
};

static int before(const struct entry *a, const struct entry *b) {
    if (a->arrival != b->arrival)
        return a->arrival < b->arrival;
    if (a->length != b->length)
        return a->length < b->length;
    return a->rank < b->rank;
}

static void push(struct queue *queue, struct entry entry) {
    size_t k;
    KR_GROW(queue->item, queue->count, queue->room);
    k = queue->count++;
    for (; k && before(&entry, queue->item + (k - 1) / 2); k = (k - 1) / 2)
        queue->item[k] = queue->item[(k - 1) / 2];
    queue->item[k] = entry;
}

static struct entry pop(struct queue *queue) {
    struct entry least = queue->item[0], last = queue->item[--queue->count];
    size_t k = 0;
    for (;;) {
        size_t child = 2 * k + 1;
        if (child >= queue->count)
            break;
        if (child + 1 < queue->count && before(queue->item + child + 1, queue->item + child))
            child++;
        if (!before(queue->item + child, &last))
            break;
        queue->item[k] = queue->item[child];
        k = child;
    }
    queue->item[k] = last;
    return least;
}

/** Nodes of the pre-crack and births of the other sources: all that is reached at no length. */
static void begin(struct kr_front *front, struct queue *queue) {
    for (size_t s = 0; s < front->n_sources; s++) {
        size_t i = front->source[s].birth;
        front->source_of[i] = s;
        push(queue, (struct entry){fmax(front->time[i], 0), 0, front->rank[i], i});
    }
}

/** How far j is by way of i. Within a pre-crack all nodes are reached at no length. */
static double step(const struct kr_front *front, size_t i, size_t j) {
    return front->time[i] < 0 && front->time[j] < 0 ? 0 : kr_front_step(front, i, j);
}

static void find_arrivals(struct kr_front *front) {
    struct queue queue = {0};
    begin(front, &queue);
    while (queue.count) {
        struct entry now = pop(&queue);
        if (!isinf(front->arrival[now.i]))
            continue;
        front->arrival[now.i] = now.arrival;
        for (size_t k = front->first[now.i]; k < front->first[now.i + 1]; k++) {
            size_t j = (size_t)front->near[k];
            if (isinf(front->arrival[j]))
                push(&queue, (struct entry){fmax(now.arrival, front->time[j]), 0, front->rank[j], j});
        }
    }
    kr_free(queue.item);
}

/** One more node is final: tell its neighbours. */
static void tell(struct kr_front *front, struct queue *queue, const char *done, size_t i) {
    for (size_t k = front->first[i]; k < front->first[i + 1]; k++) {
        size_t j = (size_t)front->near[k];
        double length = front->length[i] + step(front, i, j);
        if (done[j] || front->arrival[j] < front->arrival[i] || length > front->length[j] ||
            (length == front->length[j] && (front->parent[j] == NONE ||
                                            front->rank[front->parent[j]] <= front->rank[i])))
            continue;
        front->length[j] = length;
        front->parent[j] = i;
        front->source_of[j] = front->source_of[i];
        push(queue, (struct entry){front->arrival[j], length, front->rank[j], j});
    }
}

static void find_lengths(struct kr_front *front) {
    struct queue queue = {0};
    char *done = KR_NEW(char, front->n);
    size_t *order = KR_NEW(size_t, front->n), count = 0;
    begin(front, &queue);
    for (size_t s = 0; s < front->n_sources; s++)
        front->length[front->source[s].birth] = 0;
    while (queue.count) {
        size_t i = pop(&queue).i;
        if (done[i])
            continue;
        done[i] = 1;
        order[count++] = i;
        tell(front, &queue, done, i);
    }
    while (count) { /* who was told last leads to nobody who is not yet counted */
        size_t i = order[--count], parent = front->parent[i];
        front->leads[i] = fmax(front->leads[i], front->length[i]);
        if (parent != NONE)
            front->leads[parent] = fmax(front->leads[parent], front->leads[i]);
    }
    kr_free(queue.item);
    kr_free(order);
    kr_free(done);
}

void kr_front_spread(struct kr_front *front) {
    front->source_of = KR_NEW(size_t, front->n);
    front->arrival = KR_NEW(double, front->n);
    front->length = KR_NEW(double, front->n);
    front->leads = KR_NEW(double, front->n);
    front->parent = KR_NEW(size_t, front->n);
    for (size_t i = 0; i < front->n; i++) {
        front->source_of[i] = front->parent[i] = NONE;
        front->arrival[i] = front->length[i] = INFINITY;
    }
    find_arrivals(front);
    find_lengths(front);
}
