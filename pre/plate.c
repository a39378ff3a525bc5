/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A plate from its description, on the grid that it names.
 */
#include "plate.h"

#include "base/child.h"
#include "base/memory.h"
#include "near_boundary.h"
#include "plate_body.h"
#include "uniform.h"
#include "voronoi.h"

#include <math.h>

/** Distance of a place [m] from the true curves of a group. */
static double off_curve(const struct kr_plate_body *body, int group, const double *place) {
    double dx = body->lattice.spacing, p[2] = {place[0] / dx, place[1] / dx}, least = INFINITY;
    for (size_t c = 0; c < body->exact.n_curves; c++)
        for (size_t k = 0; k < body->exact.curve[c].n; k++)
            if (body->exact.curve[c].piece[k].group == group)
                least = fmin(least, kr_piece_distance(&body->exact.curve[c].piece[k], p));
    return least * dx;
}

static double conformity_of(const struct kr_mesh *mesh, const struct kr_plate_body *body) {
    double most = 0;
    for (size_t g = 0; g < body->n_groups; g++) {
        const struct kr_mesh_group *group = kr_mesh_group(mesh, body->group[g], 1);
        for (size_t k = 0; group && k < group->count; k++) {
            const double *p = mesh->point + 3 * mesh->edge[2 * group->member[k]];
            const double *q = mesh->point + 3 * mesh->edge[2 * group->member[k] + 1];
            const double middle[2] = {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2};
            most = fmax(most, fmax(off_curve(body, (int)g, p), off_curve(body, (int)g, middle)));
        }
    }
    return most;
}

struct kr_mesh *kr_plate_mesh(const struct kr_plate *plate, struct kr_plate_report *report) {
    double started = kr_child_clock(), dx = plate->spacing;
    struct kr_plate_body body = kr_plate_body_of(plate);
    *report = (struct kr_plate_report){.exact_area = kr_shape_area(&body.exact) * dx * dx};
    struct kr_mesh *mesh = plate->grid == KR_GRID_UNIFORM ? kr_uniform_mesh(plate, &body, report)
                           : plate->grid == KR_GRID_VORONOI
                               ? kr_voronoi_mesh(plate, &body, report)
                               : kr_near_boundary_mesh(plate, &body, report);
    report->conformity = conformity_of(mesh, &body);
    report->seconds = kr_child_clock() - started;
    kr_plate_body_free(&body);
    return mesh;
}

void kr_plate_report_free(struct kr_plate_report *report) {
    for (size_t r = 0; r < report->n_regions; r++)
        kr_free(report->region[r].name);
    report->region = kr_free(report->region);
    report->n_regions = 0;
}
