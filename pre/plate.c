/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A plate from its description, on the grid that it names.
 */
#include "plate.h"

#include "base/child.h"
#include "base/memory.h"
#include "plate_body.h"

#include "near_boundary.h"
#include "uniform.h"
#include "voronoi.h"

struct kr_mesh *kr_plate_mesh(const struct kr_plate *plate, struct kr_plate_report *report) {
    double started = kr_child_clock(), dx = plate->spacing;
    struct kr_plate_body body = kr_plate_body_of(plate);
    *report = (struct kr_plate_report){.exact_area = kr_shape_area(&body.exact) * dx * dx};
    struct kr_mesh *mesh = plate->grid == KR_GRID_UNIFORM ? kr_uniform_mesh(plate, &body, report)
                           : plate->grid == KR_GRID_VORONOI
                               ? kr_voronoi_mesh(plate, &body, report)
                               : kr_near_boundary_mesh(plate, &body, report);
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
