/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The uniform grid. An edge of the staircase belongs to the boundary that took the square behind
 * it; on the frame, to the nearest edge of the outline: a side, or that of a disc which touches it.
 */
#include "uniform.h"

#include "base/error.h"
#include "base/memory.h"
#include "builder.h"
#include "outline.h"

#include <math.h>

static const int to[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}}; /* neighbour over side k */
static const size_t end[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}; /* corners */

/** Group of the edge of the outline that is nearest to the middle of a square's side. */
static int nearest_group(const struct kr_plate_body *body, size_t i, size_t j, int k) {
    const double middle[2] = {(double)i + 0.5 + to[k][0] / 2.0, (double)j + 0.5 + to[k][1] / 2.0};
    double least = INFINITY;
    int group = KR_OUTLINE_SIDES;
    for (size_t c = 0; c < body->exact.n_curves; c++)
        for (size_t p = 0; p < body->exact.curve[c].n; p++) {
            const struct kr_piece *piece = &body->exact.curve[c].piece[p];
            double far = piece->group < body->first_hole ? kr_piece_distance(piece, middle) : INFINITY;
            if (far < least) {
                least = far;
                group = piece->group;
            }
        }
    return group;
}

/** Group of the edge over side k of a square, -1 where another square lies there. */
static int group_over(const struct kr_plate_body *body, size_t i, size_t j, int k) {
    size_t ni = i + (size_t)to[k][0], nj = j + (size_t)to[k][1];
    if (ni >= body->lattice.columns || nj >= body->lattice.rows) /* 0 less one is large */
        return nearest_group(body, i, j, k);
    int group = (int)body->holder[kr_lattice_cell(&body->lattice, ni, nj)] - 1;
    return group < 0 || group >= body->first_hole ? group : nearest_group(body, i, j, k);
}

/** All edges, a group after the other. */
static void add_edges(struct kr_builder *builder, const struct kr_plate_body *body) {
    const struct kr_lattice *lattice = &body->lattice;
    size_t n = 0, room = 0, *edge = NULL; /* 4 cell + side, then sorted by group */
    size_t *count = KR_NEW(size_t, body->n_groups + 1);
    for (size_t c = 0; c < lattice->columns * lattice->rows; c++)
        for (int k = 0; k < 4 && !body->holder[c]; k++) {
            int group = group_over(body, c % lattice->columns, c / lattice->columns, k);
            if (group < 0)
                continue;
            KR_GROW(edge, n, room);
            edge[n++] = 4 * c + (size_t)k;
            count[group + 1]++;
        }
    for (size_t g = 0; g < body->n_groups; g++)
        count[g + 1] += count[g];
    size_t *sorted = KR_NEW(size_t, n), *at = KR_NEW(size_t, body->n_groups);
    for (size_t e = 0; e < n; e++) {
        size_t c = edge[e] / 4;
        int g = group_over(body, c % lattice->columns, c / lattice->columns, (int)(edge[e] % 4));
        sorted[count[g] + at[g]++] = edge[e];
    }
    for (size_t g = 0; g < body->n_groups; g++) {
        for (size_t e = count[g]; e < count[g + 1]; e++) {
            size_t i = sorted[e] / 4 % lattice->columns, j = sorted[e] / 4 / lattice->columns;
            const size_t *p = end[sorted[e] % 4], *q = end[sorted[e] % 4 + 1];
            kr_builder_edge(builder, kr_builder_lattice_point(builder, i + p[0], j + p[1]),
                            kr_builder_lattice_point(builder, i + q[0], j + q[1]));
        }
        kr_builder_group_edges(builder, body->group[g]);
    }
    kr_free(edge);
    kr_free(count);
    kr_free(sorted);
    kr_free(at);
}

static void check_holes(const struct kr_plate_body *body) {
    size_t cells = body->lattice.columns * body->lattice.rows;
    unsigned char *seen = KR_NEW(unsigned char, body->n_groups + 1);
    for (size_t c = 0; c < cells; c++)
        seen[body->holder[c]] = 1;
    for (size_t g = (size_t)body->first_hole; g < body->n_groups; g++)
        if (!seen[g + 1])
            kr_stop(KR_EXIT_INPUT,
                    "%s holds the centre of no cell of %.9g mm: the uniform grid cannot show it; "
                    "take a finer spacing",
                    body->group[g], 1e3 * body->lattice.spacing);
    kr_free(seen);
}

struct kr_mesh *kr_uniform_mesh(const struct kr_plate *plate, const struct kr_plate_body *body,
                                struct kr_plate_report *report) {
    const struct kr_lattice *lattice = &body->lattice;
    struct kr_builder builder = kr_builder_begin(lattice);
    check_holes(body);
    for (size_t c = 0; c < lattice->columns * lattice->rows; c++)
        if (!body->holder[c])
            kr_builder_square(&builder, c % lattice->columns, c / lattice->columns);
    add_edges(&builder, body);
    report->n_lattice = builder.mesh->n_cells;
    report->polygonal_area = (double)report->n_lattice * plate->spacing * plate->spacing;
    if (!report->n_lattice)
        kr_stop(KR_EXIT_INPUT, "the holes leave nothing of the plate");
    return kr_builder_end(&builder);
}
