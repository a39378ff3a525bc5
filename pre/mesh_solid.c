/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The check of a mesh of solids. See mesh.h.
 */
#include "mesh.h"

#include "base/memory.h"
#include "cell.h"
#include "face.h"

#include <math.h>
#include <string.h>

/** Where a cell is, for messages: its first vertex. */
#define PLACE(mesh, point_)                                                                        \
    (mesh)->point[3 * (point_)], (mesh)->point[3 * (point_) + 1], (mesh)->point[3 * (point_) + 2]

static char *shapes_fault(const struct kr_mesh *mesh) {
    if (mesh->n_cells == 0)
        return kr_text("the mesh has no cells");
    for (size_t c = 0; c < mesh->n_cells; c++) {
        size_t from = mesh->first[c], n = mesh->first[c + 1] - from;
        if (mesh->first[c + 1] < from || !kr_solid_n_faces(n))
            return kr_text("cell %lld has %zu vertices, and no solid has so many",
                           (long long)mesh->cell_tag[c], n);
        for (size_t k = from; k < from + n; k++)
            if (mesh->vertex[k] >= mesh->n_points)
                return kr_text("cell %lld has a vertex %zu, but there are %zu points",
                               (long long)mesh->cell_tag[c], mesh->vertex[k], mesh->n_points);
    }
    for (size_t f = 0; f < mesh->n_faces; f++)
        for (size_t k = mesh->face_first[f]; k < mesh->face_first[f + 1]; k++)
            if (mesh->face[k] >= mesh->n_points)
                return kr_text("boundary face %zu has a vertex %zu, but there are %zu points", f,
                               mesh->face[k], mesh->n_points);
    return NULL;
}

double kr_mesh_cell_volume(const struct kr_mesh *mesh, size_t cell, double centroid[3]) {
    double few[3 * 20] = {0};
    size_t from = mesh->first[cell], n = mesh->first[cell + 1] - from;
    double *point = n <= 20 ? few : KR_NEW(double, 3 * n);
    for (size_t k = 0; k < n; k++)
        memcpy(point + 3 * k, mesh->point + 3 * mesh->vertex[from + k], 3 * sizeof *point);
    double volume = kr_cell_solid(n, point, centroid);
    if (n > 20)
        kr_free(point);
    return volume;
}

/** Largest distance of a cell's vertices from its first one. */
static double extent_of(const struct kr_mesh *mesh, size_t cell) {
    const double *first = mesh->point + 3 * mesh->vertex[mesh->first[cell]];
    double extent = 0;
    for (size_t k = mesh->first[cell]; k < mesh->first[cell + 1]; k++) {
        const double *p = mesh->point + 3 * mesh->vertex[k];
        extent = fmax(extent, hypot(hypot(p[0] - first[0], p[1] - first[1]), p[2] - first[2]));
    }
    return extent;
}

static char *volumes_fault(const struct kr_mesh *mesh) {
    for (size_t c = 0; c < mesh->n_cells; c++) {
        double centroid[3], volume = kr_mesh_cell_volume(mesh, c, centroid);
        /* 1e-12: what rounding leaves of a flat cell. */
        double least = 1e-12 * pow(extent_of(mesh, c), 3);
        if (volume > least)
            continue;
        return kr_text("cell %lld at (%g, %g, %g) m %s", (long long)mesh->cell_tag[c], centroid[0],
                       centroid[1], centroid[2],
                       volume < -least ? "is inside out: its volume is negative"
                                       : "has no volume: it is flat");
    }
    return NULL;
}

/** No face with more than two cells, and those two on either side of it. */
static char *neighbours_fault(const struct kr_mesh *mesh, const struct kr_faces *faces) {
    size_t vertex[KR_MOST_FACE];
    for (size_t k = 0; k < faces->count; k++) {
        size_t n = kr_faces_vertices(faces, faces->face[k], vertex);
        struct kr_face_match match = kr_faces_match(faces, n, vertex);
        if (match.same > 1 || match.count > 2)
            return kr_text("cells %lld and %lld overlap: %s their common face at (%g, %g, %g) m",
                           (long long)mesh->cell_tag[faces->face[k].cell],
                           (long long)mesh->cell_tag[match.cell],
                           match.same > 1 ? "they lie on the same side of"
                                          : "there are more than two cells at",
                           PLACE(mesh, vertex[0]));
    }
    return NULL;
}

static char *boundary_fault(const struct kr_mesh *mesh, const struct kr_faces *faces) {
    for (size_t f = 0; f < mesh->n_faces; f++) {
        const size_t *vertex = mesh->face + mesh->face_first[f];
        size_t n = mesh->face_first[f + 1] - mesh->face_first[f];
        size_t cells = n ? kr_faces_match(faces, n, vertex).count : 0;
        if (cells != 1)
            return kr_text("the boundary face with a corner at (%g, %g, %g) m is one of %zu cells, "
                           "and should be of just one",
                           PLACE(mesh, vertex[0]), cells);
    }
    return NULL;
}

char *kr_mesh_solid_fault(const struct kr_mesh *mesh) {
    char *fault = shapes_fault(mesh);
    if (!fault)
        fault = volumes_fault(mesh);
    if (fault)
        return fault;
    struct kr_faces *faces = kr_faces_create(mesh);
    fault = neighbours_fault(mesh, faces);
    if (!fault)
        fault = boundary_fault(mesh, faces);
    kr_faces_free(faces);
    return fault;
}
