/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Nodes near a boundary. Its triangles (faces are fans about their middles, edges of a plate
 * triangles without area) look for the nodes around them in square bins, so the time grows with
 * what is near and not with nodes times faces.
 */
#include "vicinity.h"

#include "base/memory.h"
#include "cell.h"
#include "solid.h"

#include <math.h>
#include <string.h>

/* The nodes in bins: a counting sort. */
struct bins {
    const struct kr_nodes *nodes;
    double size, lower[3];
    long count[3];
    size_t *first, *node;
};

static void place_of(const struct kr_nodes *nodes, size_t i, double x[3]) {
    for (size_t d = 0; d < 3; d++)
        x[d] = d < (size_t)nodes->dim ? nodes->position[(size_t)nodes->dim * i + d] : 0;
}

static long step_of(const struct bins *b, double x, int d) {
    double step = floor((x - b->lower[d]) / b->size);
    return step < 0 ? 0 : step >= (double)b->count[d] ? b->count[d] - 1 : (long)step;
}

static size_t bin_of(const struct bins *b, const double x[3]) {
    return (size_t)((step_of(b, x[2], 2) * b->count[1] + step_of(b, x[1], 1)) * b->count[0] +
                    step_of(b, x[0], 0));
}

static struct bins bins_create(const struct kr_nodes *nodes) {
    struct bins b = {.nodes = nodes, .size = 4 * nodes->spacing,
                     .lower = {INFINITY, INFINITY, INFINITY}};
    double upper[3] = {-INFINITY, -INFINITY, -INFINITY}, x[3];
    for (size_t i = 0; i < nodes->n; i++) {
        place_of(nodes, i, x);
        for (int d = 0; d < 3; d++) {
            b.lower[d] = fmin(b.lower[d], x[d]);
            upper[d] = fmax(upper[d], x[d]);
        }
    }
    for (int d = 0; d < 3; d++)
        b.count[d] = (long)((upper[d] - b.lower[d]) / b.size) + 1;
    size_t bins = (size_t)(b.count[0] * b.count[1] * b.count[2]);
    b.first = KR_NEW(size_t, bins + 2); /* one ahead: filled below it moves into place */
    b.node = KR_NEW(size_t, nodes->n);
    for (int fill = 0; fill < 2; fill++) {
        for (size_t i = 0; i < nodes->n; i++) {
            place_of(nodes, i, x);
            size_t at = bin_of(&b, x);
            if (fill)
                b.node[b.first[at + 1]++] = i;
            else
                b.first[at + 2]++;
        }
        for (size_t k = 2; k < bins + 2 && !fill; k++)
            b.first[k] += b.first[k - 1];
    }
    return b;
}

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double from_segment(const double x[3], const double a[3], const double b[3]) {
    double along[3], off[3];
    for (int d = 0; d < 3; d++) {
        along[d] = b[d] - a[d];
        off[d] = x[d] - a[d];
    }
    double square = dot(along, along), t = square > 0 ? dot(off, along) / square : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    for (int d = 0; d < 3; d++)
        off[d] -= t * along[d];
    return sqrt(dot(off, off));
}

/* The foot on the plane, if it lies within; else the nearest side. */
double kr_vicinity_distance(const double x[3], const double a[3], const double b[3],
                            const double c[3]) {
    const double *corner[3] = {a, b, c};
    double u[3], v[3], off[3], normal[3];
    for (int d = 0; d < 3; d++) {
        u[d] = b[d] - a[d];
        v[d] = c[d] - a[d];
        off[d] = x[d] - a[d];
    }
    for (int d = 0; d < 3; d++)
        normal[d] = u[(d + 1) % 3] * v[(d + 2) % 3] - u[(d + 2) % 3] * v[(d + 1) % 3];
    double square = dot(normal, normal), nearest = INFINITY;
    int inside = square > 0;
    for (int k = 0; k < 3; k++) {
        const double *p = corner[k], *q = corner[(k + 1) % 3];
        double side[3], to[3], across[3];
        for (int d = 0; d < 3; d++) {
            side[d] = q[d] - p[d];
            to[d] = x[d] - p[d];
        }
        for (int d = 0; d < 3; d++)
            across[d] = side[(d + 1) % 3] * to[(d + 2) % 3] - side[(d + 2) % 3] * to[(d + 1) % 3];
        inside = inside && dot(across, normal) >= 0;
        nearest = fmin(nearest, from_segment(x, p, q));
    }
    return inside ? fabs(dot(off, normal)) / sqrt(square) : nearest;
}

/* Mark what is within a distance of one triangle. */
static void mark_near(const struct bins *b, const double corner[9], double within,
                      unsigned char *mark) {
    long low[3], high[3], at[3];
    for (int d = 0; d < 3; d++) {
        double least = fmin(fmin(corner[d], corner[3 + d]), corner[6 + d]);
        double most = fmax(fmax(corner[d], corner[3 + d]), corner[6 + d]);
        low[d] = step_of(b, least - within, d);
        high[d] = step_of(b, most + within, d);
    }
    for (at[2] = low[2]; at[2] <= high[2]; at[2]++)
        for (at[1] = low[1]; at[1] <= high[1]; at[1]++)
            for (at[0] = low[0]; at[0] <= high[0]; at[0]++) {
                size_t bin = (size_t)((at[2] * b->count[1] + at[1]) * b->count[0] + at[0]);
                for (size_t k = b->first[bin]; k < b->first[bin + 1]; k++) {
                    size_t i = b->node[k];
                    double x[3];
                    place_of(b->nodes, i, x);
                    if (!mark[i] && kr_vicinity_distance(x, corner, corner + 3, corner + 6) <= within)
                        mark[i] = 1;
                }
            }
}

static double mark_edge(const struct bins *b, const struct kr_mesh *mesh, size_t edge,
                        double within, unsigned char *mark) {
    double corner[9] = {0};
    for (size_t k = 0; k < 3; k++)
        memcpy(corner + 3 * k, mesh->point + 3 * mesh->edge[2 * edge + (k > 0)],
               2 * sizeof *corner);
    mark_near(b, corner, within, mark);
    return hypot(corner[3] - corner[0], corner[4] - corner[1]);
}

static double mark_face(const struct bins *b, const struct kr_mesh *mesh, size_t face,
                        double within, unsigned char *mark) {
    double point[3 * KR_MOST_FACE], corner[9];
    size_t from = mesh->face_first[face], n = mesh->face_first[face + 1] - from;
    for (size_t k = 0; k < n; k++)
        memcpy(point + 3 * k, mesh->point + 3 * mesh->face[from + k], 3 * sizeof *point);
    double area = kr_cell_face(n, point, corner);
    for (size_t k = 0; k < n; k++) {
        memcpy(corner + 3, point + 3 * k, 3 * sizeof *corner);
        memcpy(corner + 6, point + 3 * (k + 1 < n ? k + 1 : 0), 3 * sizeof *corner);
        mark_near(b, corner, within, mark);
    }
    return area;
}

double kr_vicinity_mark(const struct kr_mesh *mesh, const struct kr_mesh_group *group,
                        const struct kr_nodes *nodes, double within, unsigned char *mark) {
    struct bins bins = bins_create(nodes);
    double measure = 0;
    for (size_t k = 0; k < group->count; k++)
        measure += mesh->dim == 2 ? mark_edge(&bins, mesh, group->member[k], within, mark)
                                  : mark_face(&bins, mesh, group->member[k], within, mark);
    kr_free(bins.first);
    kr_free(bins.node);
    return measure;
}
