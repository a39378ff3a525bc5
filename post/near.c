/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Points near a place; see near.h.
 */
#include "near.h"

#include <math.h>

#include "base/error.h"
#include "base/memory.h"

struct kr_near {
    const double *position; /* not owned */
    double reach, lower[2];
    size_t size[2]; /* buckets in x and y */
    size_t *first;  /* (buckets + 1) where a bucket begins in `point` */
    size_t *point;
    size_t count, room;
    size_t *found;
};

/** Bucket in one direction; places outside go to the rim, which loses nothing: the neighbours of a
 *  rim bucket are searched as well. */
static size_t bucket_along(const struct kr_near *near, double x, int axis) {
    double k = floor((x - near->lower[axis]) / near->reach);
    if (!(k > 0))
        return 0;
    return k < (double)(near->size[axis] - 1) ? (size_t)k : near->size[axis] - 1;
}

static size_t bucket_of(const struct kr_near *near, const double *x) {
    return bucket_along(near, x[1], 1) * near->size[0] + bucket_along(near, x[0], 0);
}

/** Fit the buckets to the points. */
static void fit(struct kr_near *near, size_t n) {
    double upper[2] = {0, 0};
    for (size_t i = 0; i < n; i++)
        for (int a = 0; a < 2; a++) {
            double x = near->position[2 * i + (size_t)a];
            near->lower[a] = i && near->lower[a] < x ? near->lower[a] : x;
            upper[a] = i && upper[a] > x ? upper[a] : x;
        }
    for (int a = 0; a < 2; a++)
        near->size[a] = (size_t)((upper[a] - near->lower[a]) / near->reach) + 1;
}

/** Counting sort of the points by bucket; within one they keep their order. */
static void sort(struct kr_near *near, size_t n) {
    size_t buckets = near->size[0] * near->size[1];
    near->first = KR_NEW(size_t, buckets + 2);
    near->point = KR_NEW(size_t, n);
    for (size_t i = 0; i < n; i++)
        near->first[bucket_of(near, near->position + 2 * i) + 2]++;
    for (size_t b = 2; b < buckets + 2; b++)
        near->first[b] += near->first[b - 1];
    for (size_t i = 0; i < n; i++)
        near->point[near->first[bucket_of(near, near->position + 2 * i) + 1]++] = i;
}

struct kr_near *kr_near_create(size_t n, const double *position, double reach) {
    struct kr_near *near = KR_NEW(struct kr_near, 1);
    kr_assert(reach > 0);
    near->position = position;
    near->reach = reach;
    fit(near, n);
    sort(near, n);
    return near;
}

void kr_near_free(struct kr_near *near) {
    if (!near)
        return;
    kr_free(near->first);
    kr_free(near->point);
    kr_free(near->found);
    kr_free(near);
}

/** The rows and columns of buckets to search around a place. */
static void around(const struct kr_near *near, const double place[2], size_t from[2],
                   size_t to[2]) {
    for (int a = 0; a < 2; a++) {
        from[a] = bucket_along(near, place[a] - near->reach, a);
        to[a] = bucket_along(near, place[a] + near->reach, a);
    }
}

static int within(const struct kr_near *near, const double place[2], size_t i) {
    return hypot(near->position[2 * i] - place[0], near->position[2 * i + 1] - place[1]) <=
           near->reach;
}

const size_t *kr_near_find(struct kr_near *near, const double place[2], size_t *count) {
    size_t from[2], to[2];
    around(near, place, from, to);
    near->count = 0;
    for (size_t row = from[1]; row <= to[1]; row++) {
        size_t k = near->first[row * near->size[0] + from[0]];
        size_t end = near->first[row * near->size[0] + to[0] + 1];
        for (; k < end; k++)
            if (within(near, place, near->point[k])) {
                KR_GROW(near->found, near->count, near->room);
                near->found[near->count++] = near->point[k];
            }
    }
    *count = near->count;
    return near->found;
}

int kr_near_any(struct kr_near *near, const double place[2]) {
    size_t count;
    kr_near_find(near, place, &count);
    return count > 0;
}
