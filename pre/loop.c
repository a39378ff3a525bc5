/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The area of a loop. See loop.h.
 */
#include "loop.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

void kr_loop_add(struct kr_loop *loop, const double point[2], const double bulge[2], int group, int on_line) {
    KR_GROW(loop->bulge, loop->n, loop->bulge_room);
    KR_GROW(loop->group, loop->n, loop->group_room);
    KR_GROW(loop->on_line, loop->n, loop->line_room);
    KR_GROW(loop->point, loop->n, loop->point_room);
    memcpy(loop->point[loop->n], point, sizeof *loop->point);
    memcpy(loop->bulge[loop->n], bulge, sizeof *loop->bulge);
    loop->group[loop->n] = group;
    loop->on_line[loop->n++] = on_line;
}

static double cross_sum(size_t n, double (*p)[2], double (*q)[2]) {
    double sum = 0;
    for (size_t k = 0; k < n; k++) {
        size_t l = k + 1 < n ? k + 1 : 0;
        double px = p[k][0] - p[0][0], py = p[k][1] - p[0][1];
        double lx = p[l][0] - p[0][0], ly = p[l][1] - p[0][1];
        sum += p == q ? px * ly - py * lx
                      : px * q[l][1] - py * q[l][0] + q[k][0] * ly - q[k][1] * lx;
    }
    return sum;
}

/** Share s of their bulge by which the corners must move for the polygon to have the exact area.
 *  Twice the area is A + B s + C s^2; the root near 0 without cancellation; 0 if there is none. */
static double share_to_move(struct kr_loop *loop, double exact) {
    double a = cross_sum(loop->n, loop->point, loop->point) - 2 * exact, c = 0;
    double b = cross_sum(loop->n, loop->point, loop->bulge);
    for (size_t k = 0; k < loop->n; k++) {
        const double *p = loop->bulge[k], *q = loop->bulge[k + 1 < loop->n ? k + 1 : 0];
        c += p[0] * q[1] - p[1] * q[0];
    }
    double under = b * b - 4 * a * c;
    return b == 0 || under < 0 ? 0 : -2 * a / (b + copysign(sqrt(under), b));
}

/** Where hardly a corner stands on an arc (roundings smaller than a spacing), all corners that are
 *  not held by a straight side of the lattice move along their mean normal. */
static void bulge_everywhere(struct kr_loop *loop) {
    for (size_t k = 0; k < loop->n; k++) {
        size_t before = k ? k - 1 : loop->n - 1, after = k + 1 < loop->n ? k + 1 : 0;
        const double *p = loop->point[before], *q = loop->point[after];
        double x = q[0] - p[0], y = q[1] - p[1], length = hypot(x, y);
        int held = loop->on_line[before] || loop->on_line[k] ||
                   loop->group[before] != loop->group[k] || length == 0;
        loop->bulge[k][0] = held ? 0 : y / length;
        loop->bulge[k][1] = held ? 0 : -x / length;
    }
}

double kr_loop_area(const struct kr_loop *loop) {
    return cross_sum(loop->n, loop->point, loop->point) / 2;
}

void kr_loop_mend(struct kr_loop *loop, double exact) {
    double miss = kr_loop_area(loop) - exact;
    if (fabs(miss) <= 1e-14 * fabs(exact)) /* straight sides alone: whole numbers stay whole */
        return;
    double s = share_to_move(loop, exact);
    if (fabs(s) > 0.5 || s == 0) { /* 1/12 to 1/6 is what circles need */
        bulge_everywhere(loop);
        s = share_to_move(loop, exact);
    }
    for (size_t k = 0; k < loop->n; k++)
        for (int d = 0; d < 2; d++)
            loop->point[k][d] += s * loop->bulge[k][d];
}

void kr_loop_free(struct kr_loop *loop) {
    kr_free(loop->point);
    kr_free(loop->bulge);
    kr_free(loop->group);
    kr_free(loop->on_line);
    *loop = (struct kr_loop){0};
}
