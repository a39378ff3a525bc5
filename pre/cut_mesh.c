/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Cubes, cut and whole, into the mesh: hexahedra, tetrahedra and polyhedra, and their boundary by groups.
 */
#include "cutting.h"

#include "base/memory.h"

#include <string.h>

/** Boundary that a triangle or a side of a cube belongs to; -1 inside the body. */
static int group_of(const struct kr_cutting *cutting, const size_t at[3], int label, const size_t *p) {
    const struct kr_block_body *body = cutting->body;
    if (label >= 0) {
        double middle[3];
        const double *x = cutting->builder.mesh->point;
        int side = kr_block_side(body, x + 3 * p[0], x + 3 * p[1], x + 3 * p[2]);
        if (side >= 0)
            return body->side[side];
        for (int d = 0; d < 3; d++)
            middle[d] = (x[3 * p[0] + d] + x[3 * p[1] + d] + x[3 * p[2] + d]) / 3;
        return kr_cutter_group(&body->cutter[label], middle);
    }
    size_t cell = kr_cut_behind(body, at, KR_CUT_SIDE - label);
    if (!cell)
        return body->side[KR_CUT_SIDE - label];
    return cutting->state[cell - 1] < 0 ? KR_CUT_GONE - cutting->state[cell - 1] : -1;
}

static void take_whole(struct kr_cutting *cutting, const size_t at[3]) {
    kr_solid_builder_cube(&cutting->builder, at[0], at[1], at[2]);
    for (int s = 0; s < 6; s++) {
        int group = group_of(cutting, at, KR_CUT_SIDE - s, NULL);
        if (group >= 0)
            kr_solid_builder_side(&cutting->builder, at[0], at[1], at[2], s, group);
    }
}

static size_t end_of(const struct kr_cutting *cutting, size_t c, int triangles) {
    if (c + 1 == cutting->n_cubes)
        return triangles ? cutting->n_triangles : cutting->n_tetrahedra;
    return triangles ? cutting->cube[c + 1].triangles : cutting->cube[c + 1].tetrahedra;
}

/** Whether a cube can be a hexahedron: whole, alone, and no surface along any of its sides. */
static int is_plain(const struct kr_cutting *cutting, size_t c) {
    const struct kr_cut_cube *cube = &cutting->cube[c];
    if (!cube->is_whole || cube->joined != cube->volume || cube->root != c)
        return 0;
    for (size_t t = cube->triangles; t < end_of(cutting, c, 1); t++)
        if (cutting->triangle[t].label >= 0)
            return 0;
    return 1;
}

/** Cut a tetrahedron in four about its middle, until there are enough to tell a polyhedron. */
static size_t divide(struct kr_cutting *cutting, size_t n, size_t *vertex) {
    for (size_t k = 0; n < 24; k += 4) {
        const double *x = cutting->builder.mesh->point;
        size_t old[4];
        double middle[3];
        memcpy(old, vertex + k, sizeof old);
        for (int d = 0; d < 3; d++)
            middle[d] = (x[3 * old[0] + d] + x[3 * old[1] + d] + x[3 * old[2] + d] + x[3 * old[3] + d]) / 4;
        size_t centre = kr_solid_builder_point(&cutting->builder, middle);
        for (size_t c = 0; c < 4; c++) {
            size_t *to = c ? vertex + n : vertex + k;
            memcpy(to, old, sizeof old);
            to[c] = centre;
            n += c ? 4 : 0;
        }
    }
    return n;
}

/** A root with all that is joined to it. */
static void take_cluster(struct kr_cutting *cutting, size_t n, const size_t *member) {
    size_t vertices = 0, count = 0;
    for (size_t m = 0; m < n; m++)
        count += 4 * (end_of(cutting, member[m], 0) - cutting->cube[member[m]].tetrahedra);
    size_t *vertex = KR_NEW(size_t, count + 48);
    for (size_t m = 0; m < n; m++) {
        const struct kr_cut_cube *cube = &cutting->cube[member[m]];
        for (size_t t = cube->tetrahedra; t < end_of(cutting, member[m], 0); t++, vertices += 4)
            memcpy(vertex + vertices, cutting->tetrahedron[t], 4 * sizeof *vertex);
        for (size_t t = cube->triangles; t < end_of(cutting, member[m], 1); t++) {
            const struct kr_cut_triangle *triangle = &cutting->triangle[t];
            int group = group_of(cutting, cube->at, triangle->label, triangle->point);
            if (group >= 0)
                kr_solid_builder_face(&cutting->builder, 3, triangle->point, group);
        }
    }
    if (vertices != 4)
        vertices = divide(cutting, vertices, vertex);
    kr_solid_builder_cell(&cutting->builder, vertices, vertex);
    kr_free(vertex);
}

/** By the cubes of each cluster, in chains by their root. */
void kr_cut_take(struct kr_cutting *cutting) {
    const size_t *n = cutting->body->n;
    size_t *next = KR_NEW(size_t, cutting->n_cubes), *last = KR_NEW(size_t, cutting->n_cubes);
    size_t *member = KR_NEW(size_t, cutting->n_cubes);
    for (size_t c = 0; c < cutting->n_cubes; c++)
        last[c] = c;
    for (size_t c = 0; c < cutting->n_cubes; c++) {
        size_t root = kr_cut_root(cutting, c);
        if (root != c) {
            next[last[root]] = c + 1;
            last[root] = c;
        }
    }
    for (size_t cell = 0; cell < n[0] * n[1] * n[2]; cell++) {
        int32_t state = cutting->state[cell];
        const size_t at[3] = {cell % n[0], cell / n[0] % n[1], cell / n[0] / n[1]};
        size_t c = state > 0 ? (size_t)state - 1 : 0, members = 0;
        if (state < 0 || (state > 0 && cutting->cube[c].root != c))
            continue;
        if (state == KR_CUT_WHOLE || is_plain(cutting, c)) {
            take_whole(cutting, at);
            continue;
        }
        for (size_t m = c + 1; m; m = next[m - 1])
            member[members++] = m - 1;
        take_cluster(cutting, members, member);
    }
    kr_free(next);
    kr_free(last);
    kr_free(member);
}
