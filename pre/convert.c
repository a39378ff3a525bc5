/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Cells to nodes. See convert.h.
 */
#include "convert.h"

#include "base/error.h"
#include "base/memory.h"
#include "cell.h"
#include "face.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- nodes ---- */

static void convert_polygon(const struct kr_mesh *mesh, size_t cell, struct kr_nodes *nodes) {
    enum { MOST_CORNERS = 64 };
    double corner[2 * MOST_CORNERS];
    size_t corners = mesh->first[cell + 1] - mesh->first[cell];
    kr_assert(corners <= MOST_CORNERS);
    for (size_t k = 0; k < corners; k++)
        for (size_t d = 0; d < 2; d++)
            corner[2 * k + d] = mesh->point[3 * mesh->vertex[mesh->first[cell] + k] + d];
    nodes->volume[cell] = kr_cell_polygon(corners, corner, nodes->position + 2 * cell);
}

static void convert_cell(const struct kr_mesh *mesh, size_t cell, struct kr_nodes *nodes) {
    if (mesh->dim == 2)
        convert_polygon(mesh, cell, nodes);
    else
        nodes->volume[cell] = kr_mesh_cell_volume(mesh, cell, nodes->position + 3 * cell);
    nodes->tag[cell] = mesh->cell_tag[cell];
}

static void convert_corners(const struct kr_mesh *mesh, struct kr_nodes *nodes) {
    size_t corners = mesh->first[mesh->n_cells], dim = (size_t)mesh->dim;
    nodes->n_points = mesh->n_points;
    nodes->point = KR_NEW(double, dim * mesh->n_points);
    for (size_t p = 0; p < mesh->n_points; p++)
        for (size_t d = 0; d < dim; d++)
            nodes->point[dim * p + d] = mesh->point[3 * p + d];
    nodes->first = KR_NEW(int64_t, mesh->n_cells + 1);
    nodes->vertex = KR_NEW(int64_t, corners);
    for (size_t i = 0; i <= mesh->n_cells; i++)
        nodes->first[i] = (int64_t)mesh->first[i];
    for (size_t k = 0; k < corners; k++)
        nodes->vertex[k] = (int64_t)mesh->vertex[k];
}

/* ---- boundaries ---- */

/* The sides of a mesh's cells: for each point the cells around it, to find the cell of an edge. */
struct around {
    size_t *first; /* (n_points + 1) */
    size_t *cell;
};

static struct around around_points(const struct kr_mesh *mesh) {
    struct around a = {KR_NEW(size_t, mesh->n_points + 1),
                       KR_NEW(size_t, mesh->first[mesh->n_cells])};
    size_t *next = KR_NEW(size_t, mesh->n_points);
    for (size_t k = 0; k < mesh->first[mesh->n_cells]; k++)
        a.first[mesh->vertex[k] + 1]++;
    for (size_t p = 0; p < mesh->n_points; p++)
        next[p] = a.first[p + 1] += a.first[p];
    for (size_t p = 0; p < mesh->n_points; p++)
        next[p] = a.first[p];
    for (size_t c = 0; c < mesh->n_cells; c++)
        for (size_t k = mesh->first[c]; k < mesh->first[c + 1]; k++)
            a.cell[next[mesh->vertex[k]]++] = c;
    kr_free(next);
    return a;
}

static int has_corner(const struct kr_mesh *mesh, size_t cell, size_t point) {
    for (size_t k = mesh->first[cell]; k < mesh->first[cell + 1]; k++)
        if (mesh->vertex[k] == point)
            return 1;
    return 0;
}

/* The cell that has this edge as a side; the mesh has been checked, so there is one. */
static size_t cell_of_edge(const struct kr_mesh *mesh, const struct around *a, size_t edge) {
    size_t p = mesh->edge[2 * edge], q = mesh->edge[2 * edge + 1];
    for (size_t k = a->first[p]; k < a->first[p + 1]; k++)
        if (has_corner(mesh, a->cell[k], q))
            return a->cell[k];
    kr_assert(!"an edge is the side of a cell");
    return 0;
}

static double length_of_edge(const struct kr_mesh *mesh, size_t edge) {
    const double *p = mesh->point + 3 * mesh->edge[2 * edge];
    const double *q = mesh->point + 3 * mesh->edge[2 * edge + 1];
    return hypot(q[0] - p[0], q[1] - p[1]);
}

static int ascending(const void *p, const void *q) {
    int64_t a = *(const int64_t *)p, b = *(const int64_t *)q;
    return (a > b) - (a < b);
}

static size_t sort_and_unique(int64_t *a, size_t n) {
    size_t kept = 0;
    qsort(a, n, sizeof *a, ascending);
    for (size_t k = 0; k < n; k++)
        if (!kept || a[k] != a[kept - 1])
            a[kept++] = a[k];
    return kept;
}

/* Edges and faces of the boundary, and the cells behind them. */
struct boundary {
    const struct kr_mesh *mesh;
    struct around around;   /* 2D */
    struct kr_faces *faces; /* 3D */
};

static size_t cell_of_face(const struct boundary *boundary, size_t face) {
    const size_t *first = boundary->mesh->face_first + face;
    struct kr_face_match match =
        kr_faces_match(boundary->faces, first[1] - first[0], boundary->mesh->face + first[0]);
    kr_assert(match.count > 0); /* the mesh has been checked */
    return match.cell;
}

static double area_of_face(const struct kr_mesh *mesh, size_t face) {
    double point[3 * KR_MOST_FACE], middle[3];
    size_t from = mesh->face_first[face], n = mesh->face_first[face + 1] - from;
    for (size_t k = 0; k < n; k++)
        memcpy(point + 3 * k, mesh->point + 3 * mesh->face[from + k], 3 * sizeof *point);
    return kr_cell_face(n, point, middle);
}

static void convert_group(const struct boundary *boundary, const struct kr_mesh_group *group,
                          struct kr_nodes *nodes) {
    const struct kr_mesh *mesh = boundary->mesh;
    int64_t *node = KR_NEW(int64_t, group->count);
    double measure = 0;
    for (size_t k = 0; k < group->count; k++) {
        size_t member = group->member[k], cell = member;
        if (group->dim == 1) {
            cell = cell_of_edge(mesh, &boundary->around, member);
            measure += length_of_edge(mesh, member);
        } else if (group->dim < mesh->dim) {
            cell = cell_of_face(boundary, member);
            measure += area_of_face(mesh, member);
        }
        node[k] = (int64_t)cell;
    }
    kr_nodes_add_set(nodes, group->name, sort_and_unique(node, group->count), node, measure);
}

static void convert_groups(const struct kr_mesh *mesh, struct kr_nodes *nodes) {
    struct boundary boundary = {.mesh = mesh};
    if (mesh->dim == 2)
        boundary.around = around_points(mesh);
    else
        boundary.faces = kr_faces_create(mesh);
    for (size_t g = 0; g < mesh->n_groups; g++)
        convert_group(&boundary, &mesh->group[g], nodes);
    kr_free(boundary.around.first);
    kr_free(boundary.around.cell);
    kr_faces_free(boundary.faces);
}

/* ---- order ---- */

struct place {
    long layer, row;
    double x;
    size_t node;
};

static int by_row(const void *p, const void *q) {
    const struct place *a = p, *b = q;
    if (a->layer != b->layer)
        return a->layer < b->layer ? -1 : 1;
    if (a->row != b->row)
        return a->row < b->row ? -1 : 1;
    if (a->x != b->x)
        return a->x < b->x ? -1 : 1;
    return (a->node > b->node) - (a->node < b->node);
}

/* In which step of the spacing a node stands, seen along an axis. */
static long step_of(const struct kr_nodes *nodes, size_t node, size_t axis, double lowest) {
    /* Half a spacing below: lattice rows then lie in the middle of their steps. */
    double step = (nodes->position[(size_t)nodes->dim * node + axis] - lowest) / nodes->spacing;
    return (long)(fmin(step, 1e15) + 0.5);
}

void kr_convert_order(struct kr_nodes *nodes) {
    double lowest[3] = {INFINITY, INFINITY, INFINITY};
    size_t dim = (size_t)nodes->dim;
    for (size_t k = 0; k < dim * nodes->n; k++)
        lowest[k % dim] = fmin(lowest[k % dim], nodes->position[k]);
    struct place *place = KR_NEW(struct place, nodes->n);
    for (size_t i = 0; i < nodes->n; i++)
        place[i] = (struct place){dim == 3 ? step_of(nodes, i, 2, lowest[2]) : 0,
                                  step_of(nodes, i, 1, lowest[1]), nodes->position[dim * i], i};
    qsort(place, nodes->n, sizeof *place, by_row);
    size_t *order = KR_NEW(size_t, nodes->n);
    for (size_t i = 0; i < nodes->n; i++)
        order[i] = place[i].node;
    kr_nodes_reorder(nodes, order);
    kr_free(order);
    kr_free(place);
}

static int by_value(const void *p, const void *q) {
    double a = *(const double *)p, b = *(const double *)q;
    return (a > b) - (a < b);
}

void kr_convert_spacing(struct kr_nodes *nodes) {
    double *volume = KR_NEW(double, nodes->n);
    memcpy(volume, nodes->volume, nodes->n * sizeof *volume);
    qsort(volume, nodes->n, sizeof *volume, by_value);
    nodes->spacing =
        nodes->dim == 2 ? sqrt(volume[nodes->n / 2]) : cbrt(volume[nodes->n / 2]);
    kr_free(volume);
}

struct kr_nodes *kr_convert(const struct kr_mesh *mesh) {
    if (!mesh->n_cells)
        kr_stop(KR_EXIT_INPUT, "the mesh has no cells; expected polygons or solids");
    struct kr_nodes *nodes = kr_nodes_create(mesh->dim, mesh->n_cells);
    for (size_t cell = 0; cell < mesh->n_cells; cell++)
        convert_cell(mesh, cell, nodes);
    convert_corners(mesh, nodes);
    convert_groups(mesh, nodes);
    kr_convert_spacing(nodes);
    kr_convert_order(nodes);
    return nodes;
}
