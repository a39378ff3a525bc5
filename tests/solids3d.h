/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What must hold of every mesh of solids, for the tests named mesh3d_*.
 */
#ifndef KR_SOLIDS3D_H
#define KR_SOLIDS3D_H

#include "block.h"
#include "cell.h"
#include "face.h"
#include "mesh.h"
#include "pieces.h"
#include "test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MM 1e-3

/** Sum of the cells' volumes [mm^3]; each is positive. */
static inline double kr_test_volume(const struct kr_mesh *mesh) {
    long double sum = 0;
    for (size_t c = 0; c < mesh->n_cells; c++) {
        double place[3], volume = kr_mesh_cell_volume(mesh, c, place);
        assert_true(volume > 0);
        sum += volume;
    }
    return (double)sum * 1e9;
}

/** Area [mm^2] of a group of faces; with `flux`, also of its faces' vectors out of the body times
 *  their middles: a third of the sum over all groups is the volume. Groups tile the boundary. */
static inline double kr_test_area(const struct kr_mesh *mesh, const char *name, double *flux) {
    const struct kr_mesh_group *group = kr_mesh_group(mesh, name, 2);
    double area = 0;
    if (!group)
        fail_msg("there is no group '%s'", name);
    for (size_t k = 0; k < group->count; k++) {
        double point[3 * KR_MOST_FACE], middle[3];
        size_t from = mesh->face_first[group->member[k]];
        size_t n = mesh->face_first[group->member[k] + 1] - from;
        for (size_t v = 0; v < n; v++)
            memcpy(point + 3 * v, mesh->point + 3 * mesh->face[from + v], 3 * sizeof *point);
        area += kr_cell_face(n, point, middle);
        for (size_t v = 0; v < n; v++) {
            const double *p = point + 3 * v, *q = point + 3 * (v + 1 < n ? v + 1 : 0);
            *flux += (middle[0] * (p[1] * q[2] - p[2] * q[1]) + middle[1] * (p[2] * q[0] - p[0] * q[2]) +
                      middle[2] * (p[0] * q[1] - p[1] * q[0])) / 6;
        }
    }
    return area * 1e6;
}

/** The whole structure holds; cells fill just what the named faces bound: with the check that no
 *  two cells lie on one side of a face, none overlap. The mesh survives cutting and joining. */
static inline void kr_test_solid(struct kr_mesh *mesh) {
    size_t grouped = 0, cells = mesh->n_cells, corners = mesh->first[cells];
    double volume = kr_test_volume(mesh), flux = 0;
    char *fault = kr_mesh_fault(mesh);
    if (fault)
        fail_msg("%s", fault);
    for (size_t g = 0; g < mesh->n_groups; g++)
        if (mesh->group[g].dim == 2) {
            grouped += mesh->group[g].count;
            kr_test_area(mesh, mesh->group[g].name, &flux);
        }
    assert_int_equal(grouped, mesh->n_faces);
    kr_check_near(flux * 1e9 / volume, 1, 1e-11); /* rounding of a hundred thousand faces */
    kr_pieces_cut(mesh);
    kr_pieces_join(mesh, "a mesh");
    assert_int_equal(mesh->n_cells, cells);
    assert_int_equal(mesh->first[cells], corners);
    kr_check_near(kr_test_volume(mesh) / volume, 1, 1e-13);
}

static inline struct kr_gmsh_options kr_test_gmsh(void) {
    static char helper[1024];
    const char *build = getenv("BUILD");
    snprintf(helper, sizeof helper, "%s/kirsch-gmsh", build ? build : "build");
    return (struct kr_gmsh_options){.helper = helper};
}

/** Two meshes are the same to the last bit. */
static inline void kr_test_same(const struct kr_mesh *a, const struct kr_mesh *b) {
    assert_int_equal(a->n_points, b->n_points);
    assert_int_equal(a->n_cells, b->n_cells);
    assert_int_equal(a->n_faces, b->n_faces);
    assert_memory_equal(a->point, b->point, 3 * a->n_points * sizeof(double));
    assert_memory_equal(a->vertex, b->vertex, a->first[a->n_cells] * sizeof(size_t));
    assert_memory_equal(a->face, b->face, a->face_first[a->n_faces] * sizeof(size_t));
}

#endif
