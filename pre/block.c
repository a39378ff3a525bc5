/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A solid from its description, on the grid that it names.
 */
#include "block.h"

#include "base/child.h"
#include "base/error.h"
#include "base/memory.h"
#include "block_body.h"
#include "boxes_solid.h"
#include "cell.h"
#include "cut_cells.h"
#include "extrude.h"
#include "outline.h"

#include <math.h>
#include <string.h>

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

/** Volume that the boundary faces enclose: a third of the flux of the place through them. */
static double enclosed(const struct kr_mesh *mesh) {
    double six = 0, lost = 0;
    for (size_t f = 0; f < mesh->n_faces; f++) {
        double point[3 * 4], middle[3];
        size_t from = mesh->face_first[f], n = mesh->face_first[f + 1] - from;
        for (size_t k = 0; k < n; k++)
            memcpy(point + 3 * k, mesh->point + 3 * mesh->face[from + k], 3 * sizeof *point);
        kr_cell_face(n, point, middle);
        for (size_t k = 0; k < n; k++) {
            const double *p = point + 3 * k, *q = point + 3 * (k + 1 < n ? k + 1 : 0);
            double add = middle[0] * (p[1] * q[2] - p[2] * q[1]) +
                         middle[1] * (p[2] * q[0] - p[0] * q[2]) +
                         middle[2] * (p[0] * q[1] - p[1] * q[0]);
            double sum = six + add;
            lost += fabs(six) >= fabs(add) ? (six - sum) + add : (add - sum) + six;
            six = sum;
        }
    }
    return (six + lost) / 6;
}

/** Distance of a place [spacings] from the nearest surface. */
static double off_surfaces(const struct kr_block_body *body, const double p[3]) {
    double least = INFINITY;
    for (size_t c = 0; c < body->n_cutters; c++)
        least = fmin(least, fabs(kr_cutter_at(&body->cutter[c], p, NULL)));
    return least;
}

/** The largest of a face's corners and middle. */
static double face_off(const struct kr_mesh *mesh, const struct kr_block_body *body, size_t face) {
    size_t from = mesh->face_first[face], n = mesh->face_first[face + 1] - from;
    double middle[3] = {0}, most = 0;
    for (size_t v = 0; v < n; v++) {
        double corner[3];
        for (int d = 0; d < 3; d++) {
            corner[d] = mesh->point[3 * mesh->face[from + v] + (size_t)d] / body->spacing;
            middle[d] += corner[d] / (double)n;
        }
        most = fmax(most, off_surfaces(body, corner));
    }
    return fmax(most, off_surfaces(body, middle));
}

/** Largest distance of the faces of voids, holes and outlines from the nearest surface. Where two surfaces meet,
 *  a facet may lie between them: it belongs to one and is held against both. */
static double conformity_of(const struct kr_mesh *mesh, const struct kr_block_body *body) {
    double most = 0;
    for (int g = KR_OUTLINE_SIDES; g < (int)body->n_groups; g++) {
        const struct kr_mesh_group *group = kr_mesh_group(mesh, body->group[g], 2);
        if (g == body->side[4] || g == body->side[5])
            continue;
        for (size_t k = 0; group && k < group->count; k++)
            most = fmax(most, face_off(mesh, body, group->member[k]));
    }
    return most * body->spacing;
}

/** A solid whose lattice is cut by surfaces. */
static struct kr_mesh *cut(const struct kr_block *block, struct kr_block_report *report) {
    struct kr_block_body *body = kr_block_body_of(block);
    struct kr_mesh *mesh = block->plate.grid == KR_GRID_UNIFORM   ? kr_cubes_mesh(body)
                           : block->plate.grid == KR_GRID_VORONOI ? kr_cut_cells_mesh(body)
                                                                  : kr_boxes_solid_mesh(block, body, report);
    report->exact_volume = kr_block_body_volume(body);
    report->filled_volume = enclosed(mesh);
    report->conformity = conformity_of(mesh, body);
    kr_block_body_free(body);
    return mesh;
}

struct kr_mesh *kr_block_mesh(const struct kr_block *block, struct kr_block_report *report) {
    double started = kr_child_clock();
    *report = (struct kr_block_report){.seconds = 0};
    struct kr_mesh *mesh =
        block->n_voids || block->body ? cut(block, report) : extruded(block, report);
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
