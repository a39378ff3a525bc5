/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Radii by rejection: drawn evenly, and kept with a probability of the density over its largest
 * value in the range (J. von Neumann, Various techniques used in connection with random digits,
 * 1951).
 *
 *    normal     exp(-(r - m)^2/(2 d^2))
 *    lognormal  exp(-(ln r - mu)^2/(2 s^2))/r,   s^2 = ln(1 + d^2/m^2),  mu = ln m - s^2/2
 *    by-area    r: the area pi r^2 is then drawn evenly
 */
#include "pore_size.h"

#include "base/memory.h"
#include "random.h"

#include <math.h>
#include <stdlib.h>

static const double NANOMETRES_A_METRE = 1e9;

/** Logarithm of the density of a radius [m], up to a constant. */
static double log_density(const struct kr_case_pores *p, double r) {
    double m = p->mean, d = p->deviation, s2 = log1p(d * d / (m * m));
    switch ((enum kr_distribution)p->distribution) {
    case KR_NORMAL:
        return -(r - m) * (r - m) / (2 * d * d);
    case KR_LOGNORMAL:
        return -pow(log(r / m) + s2 / 2, 2) / (2 * s2) - log(r);
    case KR_BY_AREA:
        return log(r);
    case KR_UNIFORM:
        break;
    }
    return 0;
}

/** Where the density is largest: at its mode, or at the end of the range nearest to it. */
static double mode_of(const struct kr_case_pores *p) {
    double s2 = log1p(p->deviation * p->deviation / (p->mean * p->mean));
    double mode = p->distribution == KR_NORMAL      ? p->mean
                  : p->distribution == KR_LOGNORMAL ? p->mean * exp(-1.5 * s2)
                                                    : INFINITY;
    return fmin(fmax(mode, p->radius[0]), p->radius[1]);
}

static int64_t nanometres(double metres) {
    int64_t whole = llround(metres * NANOMETRES_A_METRE);
    return whole > 0 ? whole : 1;
}

static int64_t draw_radius(const struct kr_case_pores *p, uint64_t *state) {
    int64_t least = nanometres(p->radius[0]), most = nanometres(p->radius[1]), r;
    if (p->distribution == KR_UNIFORM)
        return kr_random_between(state, least, most);
    double highest = log_density(p, mode_of(p));
    do
        r = kr_random_between(state, least, most);
    while (kr_random_share(state) >=
           exp(log_density(p, (double)r / NANOMETRES_A_METRE) - highest));
    return r;
}

/** An ellipse by its longer half axis. */
static void stretch(const struct kr_case_pores *p, uint64_t *state, struct kr_pore_size *size) {
    double aspect = p->aspect[0] + (p->aspect[1] - p->aspect[0]) * kr_random_share(state);
    size->shorter = llround((double)size->radius / aspect);
    size->shorter = size->shorter > 0 ? size->shorter : 1;
    size->angle = kr_random_between(state, 0, 179999);
}

struct kr_pore_size kr_pore_size_draw(const struct kr_case_pores *p, uint64_t *state) {
    struct kr_pore_size size = {.radius = draw_radius(p, state)};
    size.shorter = size.radius;
    if (p->shape == KR_PORE_ELLIPSE)
        stretch(p, state, &size);
    return size;
}

static int larger_first(const void *a, const void *b) {
    const struct kr_pore_size *p = a, *q = b;
    if (p->radius != q->radius)
        return p->radius < q->radius ? 1 : -1;
    if (p->shorter != q->shorter)
        return p->shorter < q->shorter ? 1 : -1;
    return p->angle < q->angle ? 1 : p->angle > q->angle ? -1 : 0;
}

struct kr_pore_size *kr_pore_sizes_draw(const struct kr_case_pores *p, double area,
                                        uint64_t *state, size_t *n) {
    struct kr_pore_size *size = NULL;
    double wanted = p->porosity * area * NANOMETRES_A_METRE * NANOMETRES_A_METRE / M_PI, sum = 0;
    size_t room = 0;
    for (*n = 0; sum < wanted; (*n)++) {
        KR_GROW(size, *n, room);
        size[*n] = kr_pore_size_draw(p, state);
        double own = (double)size[*n].radius * (double)size[*n].shorter, missing = wanted - sum;
        sum += own;
        if (own < missing)
            continue;
        double scale = sqrt(missing / own);
        int64_t fitted = llround((double)size[*n].radius * scale);
        if (fitted >= nanometres(p->radius[0])) {
            size[*n].radius = fitted;
            size[*n].shorter = llround((double)size[*n].shorter * scale);
        } else if (own - missing > missing) {
            break; /* nearer without it */
        }
    }
    if (*n)
        qsort(size, *n, sizeof *size, larger_first);
    return size;
}
