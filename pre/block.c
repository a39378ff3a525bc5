/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A solid from its description, on the grid that it names.
 */
#include "block.h"

#include "base/child.h"
#include "base/error.h"
#include "base/memory.h"
#include "extrude.h"

#include <math.h>

static struct kr_mesh *extruded(const struct kr_block *block, struct kr_block_report *report) {
    struct kr_plate_report flat;
    struct kr_mesh *plane = kr_plate_mesh(&block->plate, &flat);
    size_t layers = (size_t)nearbyint(block->depth / block->plate.spacing);
    struct kr_mesh *solid = kr_mesh_extrude(plane, block->depth, layers);
    report->exact_volume = flat.exact_area * block->depth;
    report->filled_volume = flat.polygonal_area * block->depth;
    report->conformity = flat.conformity;
    report->n_regions = flat.n_regions;
    report->region = flat.region;
    kr_mesh_free(plane);
    return solid;
}

struct kr_mesh *kr_block_mesh(const struct kr_block *block, struct kr_block_report *report) {
    double started = kr_child_clock();
    *report = (struct kr_block_report){.seconds = 0};
    struct kr_mesh *mesh = extruded(block, report);
    char *fault = kr_mesh_fault(mesh);
    if (fault)
        kr_stop(KR_EXIT_LIBRARY, "the mesh that was made is faulty: %s", fault);
    report->seconds = kr_child_clock() - started;
    return mesh;
}

void kr_block_report_free(struct kr_block_report *report) {
    for (size_t r = 0; r < report->n_regions; r++)
        kr_free(report->region[r].name);
    report->region = kr_free(report->region);
    report->n_regions = 0;
}
