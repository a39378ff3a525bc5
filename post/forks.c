/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Where the forks are: kr_legs_place_forks of legs.h.
 */
#include "legs.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

#define NONE KR_FRONT_NONE

/* Lines closer than this (sine of the angle, squared) do not meet in a place worth the name: 10
 * degrees. A fork farther before its arms than this many horizons is not theirs. */
static const double LEAST_SINE_SQUARE = 0.03;
enum { FARTHEST = 5 };

/** The begin of an arm as a straight line. */
struct line {
    double at[2], along[2];
};

static struct line line_of(const struct kr_front *front, const struct kr_chain *chain,
                           struct kr_path *path) {
    double far[2], length;
    struct line line;
    kr_path_lay(front, chain->count, chain->node, NULL, path);
    kr_path_point(path, 0, line.at);
    kr_path_point(path, fmin(kr_path_window(front->record), path->s[path->n - 1]), far);
    length = hypot(far[0] - line.at[0], far[1] - line.at[1]);
    for (int a = 0; a < 2; a++)
        line.along[a] = length > 0 ? (far[a] - line.at[a]) / length : 0;
    return line;
}

/** The point nearest to some lines; 0 where they are about parallel. */
static int meet(const struct line *line, size_t count, double x[2]) {
    double a = 0, b = 0, c = 0, right[2] = {0}, det;
    for (size_t k = 0; k < count; k++) {
        const double *e = line[k].along, *p = line[k].at;
        double xx = 1 - e[0] * e[0], xy = -e[0] * e[1], yy = 1 - e[1] * e[1];
        a += xx;
        b += xy;
        c += yy;
        right[0] += xx * p[0] + xy * p[1];
        right[1] += xy * p[0] + yy * p[1];
    }
    det = a * c - b * b; /* of two lines: the squared sine of their angle */
    x[0] = (c * right[0] - b * right[1]) / det;
    x[1] = (a * right[1] - b * right[0]) / det;
    return det > LEAST_SINE_SQUARE;
}

static int is_before(const struct line *line, size_t count, const double x[2], double farthest) {
    for (size_t k = 0; k < count; k++) {
        const double *e = line[k].along, *p = line[k].at;
        double ahead = (p[0] - x[0]) * e[0] + (p[1] - x[1]) * e[1];
        if (ahead < -farthest / FARTHEST || ahead > farthest)
            return 0;
    }
    return 1;
}

/** Distance of a point from the arm that begins at the anchor. */
static double distance_to_arm(const struct line *line, const double *anchor, const double *x) {
    double e[2] = {line->at[0] - anchor[0], line->at[1] - anchor[1]};
    double square = e[0] * e[0] + e[1] * e[1];
    double part =
        square > 0 ? ((x[0] - anchor[0]) * e[0] + (x[1] - anchor[1]) * e[1]) / square : 0;
    part = fmin(fmax(part, 0), 1);
    return hypot(anchor[0] + part * e[0] - x[0], anchor[1] + part * e[1] - x[1]);
}

/** Give the damage of the parent beyond the fork to the nearer arm, but never all of it. */
static void hand_over(const struct kr_front *front, const struct kr_chain *parent,
                      const struct kr_path *trunk, const struct line *line, const size_t *child,
                      size_t count, const double *fork, size_t *of) {
    const double far = FARTHEST * front->record->horizon;
    double away, at = kr_path_nearest(trunk, fmax(trunk->s[trunk->n - 1] - far, 0), fork, &away);
    for (size_t k = 0; k < parent->count; k++) {
        size_t i = parent->node[k], best = 0;
        if (of[i] != of[parent->node[0]] || k == 0 || kr_path_place(front, trunk, i, NULL) <= at)
            continue;
        for (size_t c = 1; c < count; c++)
            if (distance_to_arm(line + c, fork, front->x + 3 * i) <
                distance_to_arm(line + best, fork, front->x + 3 * i))
                best = c;
        of[i] = child[best];
    }
}

static void place_fork(const struct kr_front *front, const struct kr_chains *chains, size_t c,
                       size_t *of, double *anchor) {
    const struct kr_chain *parent = chains->item + c;
    struct line *line = KR_NEW(struct line, parent->n_children);
    size_t *child = KR_NEW(size_t, parent->n_children), count = 0;
    struct kr_path trunk, arm;
    double fork[2], away = INFINITY;
    for (size_t k = c + 1; k < chains->count; k++)
        if (chains->item[k].parent == c) {
            line[count] = line_of(front, chains->item + k, &arm);
            child[count++] = k;
            kr_path_clear(&arm);
        }
    kr_path_lay(front, parent->count, parent->node, NULL, &trunk);
    if (meet(line, count, fork) &&
        is_before(line, count, fork, FARTHEST * front->record->horizon))
        kr_path_nearest(&trunk, 0, fork, &away);
    if (away <= front->record->horizon)
        hand_over(front, parent, &trunk, line, child, count, fork, of);
    else
        kr_path_point(&trunk, trunk.s[trunk.n - 1], fork);
    for (size_t k = 0; k < count; k++)
        memcpy(anchor + 2 * child[k], fork, sizeof fork);
    kr_path_clear(&trunk);
    kr_free(line);
    kr_free(child);
}

void kr_legs_place_forks(const struct kr_front *front, const struct kr_chains *chains,
                         size_t *of, double *anchor) {
    for (size_t c = 0; c < 2 * chains->count; c++)
        anchor[c] = NAN;
    for (size_t c = 0; c < chains->count; c++)
        if (chains->item[c].n_children)
            place_fork(front, chains, c, of, anchor);
}
