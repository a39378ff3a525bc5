/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Cell lists. Points are counted into square bins of half the reach in width (a counting sort, so
 * each bin holds its points in ascending order); the neighbours of a point lie in its bin and those
 * up to two away, where these come near enough. Where points are few and far between, bins are wider.
 */
#include "search.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct kr_search {
    int dim;
    const double *position;
    double reach, width, lower[3]; /* width of a bin */
    long bins[3];   /* 1 where there is no such dimension */
    size_t *first;  /* (number of bins + 1) */
    int *member;    /* (n) points by bin */
};

static void bin_of(const struct kr_search *s, size_t i, long bin[3]) {
    bin[2] = 0;
    for (int d = 0; d < s->dim; d++)
        bin[d] = (long)((s->position[i * (size_t)s->dim + (size_t)d] - s->lower[d]) / s->width);
}

static size_t bin_number(const struct kr_search *s, const long bin[3]) {
    return (size_t)((bin[2] * s->bins[1] + bin[1]) * s->bins[0] + bin[0]);
}

static double bins_wanted(const struct kr_search *s, const double *upper) {
    double bins = 1;
    for (int d = 0; d < s->dim; d++) /* the difference alone may be infinite */
        bins *= floor(upper[d] / s->width - s->lower[d] / s->width) + 1;
    return bins;
}

static void find_bounds(struct kr_search *s, size_t n) {
    double upper[3] = {0};
    for (int d = 0; d < s->dim; d++) {
        s->lower[d] = INFINITY;
        upper[d] = -INFINITY;
        for (size_t i = 0; i < n; i++) {
            double x = s->position[i * (size_t)s->dim + (size_t)d];
            s->lower[d] = fmin(s->lower[d], x);
            upper[d] = fmax(upper[d], x);
        }
    }
    const double most = 100 * (double)n + 1000; /* dense points have fewer bins */
    while (n && bins_wanted(s, upper) > most)
        s->width *= 2;
    for (int d = 0; d < 3; d++)
        s->bins[d] = d < s->dim && n ? (long)((upper[d] - s->lower[d]) / s->width) + 1 : 1;
}

struct kr_search *kr_search_create(int dim, size_t n, const double *position, double reach) {
    kr_assert(reach > 0 && (dim == 2 || dim == 3));
    struct kr_search *s = KR_NEW(struct kr_search, 1);
    *s = (struct kr_search){.dim = dim, .position = position, .reach = reach, .width = 0.5 * reach};
    find_bounds(s, n);
    size_t bins = (size_t)(s->bins[0] * s->bins[1] * s->bins[2]);
    s->first = KR_NEW(size_t, bins + 1);
    s->member = KR_NEW(int, n);
    long bin[3];
    for (size_t i = 0; i < n; i++) {
        bin_of(s, i, bin);
        s->first[bin_number(s, bin) + 1]++;
    }
    for (size_t b = 0; b < bins; b++)
        s->first[b + 1] += s->first[b];
    size_t *next = KR_NEW(size_t, bins);
    for (size_t b = 0; b < bins; b++)
        next[b] = s->first[b];
    for (size_t i = 0; i < n; i++) {
        bin_of(s, i, bin);
        s->member[next[bin_number(s, bin)]++] = (int)i;
    }
    kr_free(next);
    return s;
}

void kr_search_free(struct kr_search *s) {
    kr_free(s->first);
    kr_free(s->member);
    kr_free(s);
}

static int compare(const void *a, const void *b) {
    return (*(const int *)a > *(const int *)b) - (*(const int *)a < *(const int *)b);
}

/* End of the ascending run that begins at `from`. */
static size_t run_end(const int *a, size_t from, size_t n) {
    size_t k = from + 1;
    while (k < n && a[k - 1] < a[k])
        k++;
    return k < n ? k : n;
}

/* Merge the runs of a in pairs into b; returns how many pairs (or single last runs) there were. */
static size_t merge_runs(const int *a, size_t n, int *b) {
    size_t pairs = 0;
    for (size_t at = 0; at < n; pairs++) {
        size_t p = at, middle = run_end(a, at, n), q = middle;
        size_t end = middle < n ? run_end(a, middle, n) : n;
        for (; at < end; at++)
            b[at] = q == end || (p < middle && a[p] < a[q]) ? a[p++] : a[q++];
    }
    return pairs;
}

/* The points of each bin are a run already. */
static void sort_ascending(int *a, size_t n) {
    enum { MOST = 4096 };
    int other[MOST];
    if (n > MOST) {
        qsort(a, n, sizeof *a, compare);
        return;
    }
    for (size_t pairs = 2; pairs > 1;) {
        pairs = merge_runs(a, n, other);
        memcpy(a, other, n * sizeof *a);
    }
}

/* Square of the distance from a place to bin number k along d; 0 within it. The width is stretched by
 * what rounding may have moved a point over a bin's edge. */
static double square_to(const struct kr_search *s, const double *here, int d, long k) {
    const double edge = 1e-9 * s->width;
    double low = s->lower[d] + (double)k * s->width - edge, high = low + s->width + 2 * edge;
    double away = here[d] < low ? low - here[d] : here[d] > high ? here[d] - high : 0;
    return away * away;
}

/* The points of bin b within the reach; returns the new number found. */
static size_t look_into(const struct kr_search *s, size_t b, size_t i, int *near, size_t room,
                        size_t found) {
    const size_t dim = (size_t)s->dim;
    const double *here = s->position + i * dim;
    for (size_t k = s->first[b]; k < s->first[b + 1]; k++) {
        size_t j = (size_t)s->member[k];
        double square = 0;
        for (size_t d = 0; d < dim; d++)
            square +=
                (s->position[j * dim + d] - here[d]) * (s->position[j * dim + d] - here[d]);
        if (square > s->reach * s->reach || j == i)
            continue;
        if (found < room)
            near[found] = (int)j;
        found++;
    }
    return found;
}

size_t kr_search_near(const struct kr_search *s, size_t i, int *near, size_t room) {
    const double *here = s->position + i * (size_t)s->dim, most = s->reach * s->reach;
    long low[3] = {0}, high[3] = {0}, bin[3];
    size_t found = 0;
    bin_of(s, i, bin);
    for (int d = 0; d < s->dim; d++) {
        low[d] = bin[d] > 2 ? bin[d] - 2 : 0;
        high[d] = bin[d] + 2 < s->bins[d] ? bin[d] + 2 : s->bins[d] - 1;
    }
    for (bin[2] = low[2]; bin[2] <= high[2]; bin[2]++) {
        double z = s->dim == 3 ? square_to(s, here, 2, bin[2]) : 0;
        for (bin[1] = low[1]; bin[1] <= high[1]; bin[1]++) {
            double yz = z + square_to(s, here, 1, bin[1]);
            for (bin[0] = low[0]; bin[0] <= high[0]; bin[0]++)
                if (yz + square_to(s, here, 0, bin[0]) <= most)
                    found = look_into(s, bin_number(s, bin), i, near, room, found);
        }
    }
    if (found <= room)
        sort_ascending(near, found);
    return found;
}

void kr_search_find(const struct kr_search *s, size_t i, struct kr_found *found) {
    found->count = kr_search_near(s, i, found->near, found->room);
    if (found->count <= found->room)
        return;
    found->room = 2 * found->count;
    found->near = kr_realloc(found->near, found->room, sizeof *found->near);
    found->count = kr_search_near(s, i, found->near, found->room);
}
