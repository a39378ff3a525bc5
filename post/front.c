/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The spread of damage; the four steps stand in front.h.
 */
#include "front.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "search.h"

#define NONE KR_FRONT_NONE

double kr_front_distance(const struct kr_front *front, size_t i, size_t j) {
    const double *a = front->x + 3 * i, *b = front->x + 3 * j;
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

double kr_front_step(const struct kr_front *front, size_t i, size_t j) {
    int power;
    frexp(front->record->horizon, &power);
    return ldexp(rint(ldexp(kr_front_distance(front, i, j), 30 - power)), power - 30);
}

/* ---- 1: the graph ------------------------------------------------------------------------ */

static void collect(struct kr_front *front) {
    const struct kr_record *record = front->record;
    const size_t dim = (size_t)record->dim;
    for (size_t i = 0; i < record->n; i++)
        front->n += !isinf(record->damage_time[i]);
    front->node = KR_NEW(size_t, front->n);
    front->x = KR_NEW(double, 3 * front->n);
    front->time = KR_NEW(double, front->n);
    for (size_t i = 0, k = 0; i < record->n; i++)
        if (!isinf(record->damage_time[i])) {
            memcpy(front->x + 3 * k, record->position + dim * i, dim * sizeof(double));
            front->time[k] = record->damage_time[i];
            front->node[k++] = i;
        }
}

static void find_neighbours(struct kr_front *front) {
    struct kr_search *search = kr_search_create(3, front->n, front->x, front->reach);
    struct kr_found found = {0};
    size_t room = 0, count = 0;
    front->first = KR_NEW(size_t, front->n + 1);
    for (size_t i = 0; i < front->n; i++) {
        kr_search_find(search, i, &found);
        for (size_t k = 0; k < found.count; k++) {
            KR_GROW(front->near, count, room);
            front->near[count++] = found.near[k];
        }
        front->first[i + 1] = count;
    }
    kr_free(found.near);
    kr_search_free(search);
}

struct timed {
    double time, around;
    size_t i;
};

static int earlier(const void *left, const void *right) {
    const struct timed *a = left, *b = right;
    if (a->time != b->time)
        return a->time < b->time ? -1 : 1;
    if (a->around != b->around)
        return a->around < b->around ? -1 : 1;
    return a->i < b->i ? -1 : a->i > b->i;
}

static struct timed timed_of(const struct kr_front *front, size_t i) {
    const double unit =
        1e-6 * front->record->time_step / front->record->horizon; /* not by rounding */
    struct timed node = {front->time[i], 0, i};
    for (size_t k = front->first[i]; k < front->first[i + 1]; k++) {
        size_t j = (size_t)front->near[k];
        node.around += (front->time[j] - front->time[i]) /
                       fmax(kr_front_distance(front, i, j), 1e-3 * front->record->spacing);
    }
    node.around = rint(node.around / unit);
    return node;
}

static void find_ranks(struct kr_front *front) {
    struct timed *order = KR_NEW(struct timed, front->n);
    front->rank = KR_NEW(size_t, front->n);
    for (size_t i = 0; i < front->n; i++)
        order[i] = timed_of(front, i);
    if (front->n)
        qsort(order, front->n, sizeof *order, earlier);
    for (size_t k = 0; k < front->n; k++)
        front->rank[order[k].i] = k;
    kr_free(order);
}

/* ---- 2: sources -------------------------------------------------------------------------- */

/** A heap of nodes while it grows; the arrays are indexed by its root in the union-find forest. */
struct heaps {
    size_t *up;      /* (n) towards the root; NONE: not yet added */
    size_t *birth;   /* (n) */
    size_t *far;     /* (n) the node farthest from the birth */
    char *is_source; /* (n) of a birth: it stays one */
};

static size_t root_of(struct heaps *heaps, size_t i) {
    while (heaps->up[i] != i)
        i = heaps->up[i] = heaps->up[heaps->up[i]];
    return i;
}

static double reach_of(const struct kr_front *front, const struct heaps *heaps, size_t root) {
    return kr_front_distance(front, heaps->birth[root], heaps->far[root]);
}

static int is_crack(const struct kr_front *front, const struct heaps *heaps, size_t root) {
    return front->time[heaps->birth[root]] < 0 ||
           reach_of(front, heaps, root) >=
               KR_FRONT_SHORTEST * front->record->horizon * (1 - KR_FRONT_SLACK);
}

static void look_farther(const struct kr_front *front, struct heaps *heaps, size_t root,
                         size_t node) {
    if (kr_front_distance(front, heaps->birth[root], node) > reach_of(front, heaps, root))
        heaps->far[root] = node;
}

/** Two heaps become one; it goes on as the crack among them, or else as the one born first. Two
 *  pre-cracks that touch are one; two cracks stay two sources. */
static size_t join(const struct kr_front *front, struct heaps *heaps, size_t a, size_t b) {
    const int crack_a = is_crack(front, heaps, a), crack_b = is_crack(front, heaps, b);
    const size_t birth_a = heaps->birth[a], birth_b = heaps->birth[b];
    if (crack_a < crack_b ||
        (crack_a == crack_b && front->rank[birth_b] < front->rank[birth_a])) {
        size_t swap = a;
        a = b;
        b = swap;
    }
    if (crack_a && crack_b && !(front->time[birth_a] < 0 && front->time[birth_b] < 0))
        heaps->is_source[heaps->birth[b]] = 1;
    heaps->up[b] = a;
    look_farther(front, heaps, a, heaps->birth[b]);
    look_farther(front, heaps, a, heaps->far[b]);
    return a;
}

static void add_node(const struct kr_front *front, struct heaps *heaps, size_t i) {
    size_t root = i;
    heaps->up[i] = heaps->birth[i] = heaps->far[i] = i;
    for (size_t k = front->first[i]; k < front->first[i + 1]; k++) {
        size_t j = (size_t)front->near[k], other;
        if (heaps->up[j] == NONE)
            continue;
        other = root_of(heaps, j);
        if (other == root)
            continue;
        root = root == i ? other : join(front, heaps, root, other);
        if (heaps->up[i] == i && root != i) { /* the node itself goes to the first heap it meets */
            heaps->up[i] = root;
            look_farther(front, heaps, root, i);
        }
    }
}

static void list_sources(struct kr_front *front, struct heaps *heaps) {
    for (size_t i = 0; i < front->n; i++)
        if (heaps->up[i] == i && is_crack(front, heaps, i))
            heaps->is_source[heaps->birth[i]] = 1;
    for (size_t i = 0; i < front->n; i++)
        if (heaps->is_source[i]) {
            KR_GROW(front->source, front->n_sources, front->sources_room);
            front->source[front->n_sources++] = (struct kr_source){i, front->time[i] < 0};
        }
}

static void find_sources(struct kr_front *front) {
    size_t *order = KR_NEW(size_t, front->n);
    struct heaps heaps = {KR_NEW(size_t, front->n), KR_NEW(size_t, front->n),
                          KR_NEW(size_t, front->n), KR_NEW(char, front->n)};
    for (size_t i = 0; i < front->n; i++) {
        order[front->rank[i]] = i;
        heaps.up[i] = NONE;
    }
    for (size_t k = 0; k < front->n; k++)
        add_node(front, &heaps, order[k]);
    list_sources(front, &heaps);
    kr_free(order);
    kr_free(heaps.up);
    kr_free(heaps.birth);
    kr_free(heaps.far);
    kr_free(heaps.is_source);
}

struct kr_front *kr_front_create(const struct kr_record *record) {
    struct kr_front *front = KR_NEW(struct kr_front, 1);
    *front = (struct kr_front){.record = record};
    front->reach = fmax(1.6 * record->spacing, record->horizon / 2) * (1 + KR_FRONT_SLACK);
    collect(front);
    find_neighbours(front);
    find_ranks(front);
    find_sources(front);
    kr_front_spread(front);
    return front;
}

void kr_front_free(struct kr_front *front) {
    if (!front)
        return;
    kr_free(front->node);
    kr_free(front->x);
    kr_free(front->time);
    kr_free(front->first);
    kr_free(front->near);
    kr_free(front->rank);
    kr_free(front->source);
    kr_free(front->source_of);
    kr_free(front->arrival);
    kr_free(front->length);
    kr_free(front->leads);
    kr_free(front->parent);
    kr_free(front);
}
