/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The volume behind a surface of facets.
 *
 * A flat facet with its corners on a bent surface loses volume: per area, the mean of the distances of
 * its edges' middles from the surface (Simpson's rule for a quadratic surface). Each corner is moved by
 * the mean of that over its facets, weighted by their areas; so the volume is right to a higher order.
 */
#include "coarse.h"

#include "base/memory.h"
#include "cell.h"

#include <math.h>
#include <string.h>

/* No corner moves farther than this, in spacings: at sharp edges the rule overshoots. */
static const double FARTHEST = 0.25;

/** Unit normal into the body at a place near the surface; along the block's sides where it lies on
 *  one. */
static void normal_at(const struct kr_coarse *coarse, const double p[3], double normal[3]) {
    const double step = 1e-4;
    size_t cutter;
    double length = 0;
    for (int d = 0; d < 3; d++) {
        double q[3] = {p[0], p[1], p[2]};
        normal[d] = 0;
        if (p[d] == 0 || p[d] == (double)coarse->body->n[d])
            continue;
        q[d] = p[d] + step;
        normal[d] = kr_coarse_value(coarse->body, q, &cutter);
        q[d] = p[d] - step;
        normal[d] -= kr_coarse_value(coarse->body, q, &cutter);
        length = hypot(length, normal[d]);
    }
    for (int d = 0; d < 3 && length > 0; d++)
        normal[d] /= length;
}

/** Mean of the function at the middles of a facet's edges. */
static double gap_of(const struct kr_coarse *coarse, const struct kr_solid_region *r, const size_t *v) {
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        const double *p = r->point[v[k]], *q = r->point[v[(k + 1) % 3]];
        const double middle[3] = {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2};
        size_t cutter;
        sum += kr_coarse_value(coarse->body, middle, &cutter);
    }
    return sum / 3;
}

/** Whether a tetrahedron has kept a volume. */
static int is_sound(const struct kr_solid_region *r, const size_t *v) {
    double u[3][3];
    for (int k = 0; k < 3; k++)
        for (int d = 0; d < 3; d++)
            u[k][d] = r->point[v[k + 1]][d] - r->point[v[0]][d];
    return u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1]) +
               u[0][1] * (u[1][2] * u[2][0] - u[1][0] * u[2][2]) +
               u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0]) > 1e-6;
}

void kr_coarse_even(const struct kr_coarse *coarse, struct kr_solid_region *r, const int *label) {
    size_t n = r->n_points, again = 1;
    double *area = KR_NEW(double, n), *lost = KR_NEW(double, n);
    double(*old)[3] = kr_alloc(n, sizeof *old);
    memcpy(old, r->point, n * sizeof *old);
    for (size_t t = 0; t < r->n_triangles; t++) {
        const size_t *v = r->triangle[t];
        if (label[t] != KR_COARSE_SURFACE)
            continue;
        double a = kr_cell_triangle(r->point[v[0]], r->point[v[1]], r->point[v[2]]), gap = gap_of(coarse, r, v);
        for (int k = 0; k < 3; k++) {
            area[v[k]] += a;
            lost[v[k]] += a * gap;
        }
    }
    for (size_t p = 0; p < n; p++) {
        double normal[3], move;
        if (area[p] == 0)
            continue;
        normal_at(coarse, old[p], normal);
        move = fmax(-FARTHEST, fmin(FARTHEST, -lost[p] / area[p]));
        for (int d = 0; d < 3; d++)
            r->point[p][d] += move * normal[d];
    }
    while (again) { /* a corner that would turn a tetrahedron over stays where it was */
        again = 0;
        for (size_t c = 0; c < r->n_cells; c++)
            for (int k = 0; k < 4 && !is_sound(r, r->cell[c]); k++) {
                size_t p = r->cell[c][k];
                again |= memcmp(r->point[p], old[p], sizeof *old) != 0;
                memcpy(r->point[p], old[p], sizeof *old);
            }
    }
    kr_free(area);
    kr_free(lost);
    kr_free(old);
}
