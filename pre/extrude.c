/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Prisms over the cells of a plane mesh. The side of a prism that is cut into tetrahedra has its
 * diagonal from the lower of its two points at the bottom to the higher one at the top, whichever
 * cell looks at it: so neighbours agree.
 */
#include "extrude.h"

#include "base/memory.h"
#include "pieces.h"
#include "side.h"

#include <string.h>

/** The solid in the making. */
struct extruding {
    const struct kr_mesh *plane;
    struct kr_mesh *solid;
    size_t n_layers;
    size_t *first;    /* (plane cells + 1) where a cell's vertices begin within a layer */
    size_t *triangle; /* of the polygons, in one list */
    size_t *cut;      /* (plane cells + 1) where a polygon's triangles begin, in triangles */
    struct kr_sides *sides;
    size_t n_face_vertices, face_room, first_room, groups_room;
};

static size_t corners_of(const struct kr_mesh *plane, size_t cell) {
    return plane->first[cell + 1] - plane->first[cell];
}

/** Triangles of the polygons, and the room that each cell takes. */
static void measure(struct extruding *e) {
    const struct kr_mesh *plane = e->plane;
    size_t total = 0, most = 0;
    e->first = KR_NEW(size_t, plane->n_cells + 1);
    e->cut = KR_NEW(size_t, plane->n_cells + 1);
    for (size_t c = 0; c < plane->n_cells; c++) {
        size_t n = corners_of(plane, c);
        e->cut[c + 1] = total += n > 4 ? n - 2 : 0;
        e->first[c + 1] = e->first[c] + (n > 4 ? 12 * (n - 2) : 2 * n);
        most = n > most ? n : most;
    }
    size_t *v = KR_NEW(size_t, most);
    e->triangle = KR_NEW(size_t, 3 * total);
    for (size_t c = 0; c < plane->n_cells; c++) {
        size_t n = corners_of(plane, c);
        memcpy(v, plane->vertex + plane->first[c], n * sizeof *v);
        if (n > 4)
            kr_pieces_triangles(plane, n, v, e->triangle + 3 * e->cut[c]);
    }
    kr_free(v);
}

static void lay_points(struct extruding *e, double depth) {
    size_t n = e->plane->n_points;
    e->solid->n_points = n * (e->n_layers + 1);
    e->solid->point = KR_NEW(double, 3 * e->solid->n_points);
    for (size_t l = 0; l <= e->n_layers; l++)
        for (size_t p = 0; p < n; p++) {
            double *to = e->solid->point + 3 * (l * n + p);
            memcpy(to, e->plane->point + 3 * p, 2 * sizeof *to);
            to[2] = (double)l * depth / (double)e->n_layers;
        }
}

/** The three tetrahedra of a prism over a triangle, counter-clockwise; `up` from bottom to top. */
static void cut_prism(const size_t *triangle, size_t up, size_t *vertex) {
    size_t s[3] = {triangle[0], triangle[1], triangle[2]}, swaps = 0;
    for (int a = 0; a < 2; a++)
        for (int b = 0; b < 2 - a; b++)
            if (s[b] > s[b + 1]) {
                size_t kept = s[b];
                s[b] = s[b + 1];
                s[b + 1] = kept;
                swaps++;
            }
    const size_t tetrahedra[3][4] = {{s[0], s[1], s[2], s[2] + up},
                                     {s[0], s[1], s[2] + up, s[1] + up},
                                     {s[0], s[1] + up, s[2] + up, s[0] + up}};
    for (size_t t = 0; t < 3; t++) {
        memcpy(vertex + 4 * t, tetrahedra[t], sizeof tetrahedra[t]);
        if (swaps % 2) {
            vertex[4 * t] = tetrahedra[t][1];
            vertex[4 * t + 1] = tetrahedra[t][0];
        }
    }
}

static void lay_cell(const struct extruding *e, size_t c, size_t layer, size_t *vertex) {
    size_t up = e->plane->n_points, base = layer * up, n = corners_of(e->plane, c);
    if (n <= 4) {
        for (size_t k = 0; k < n; k++) {
            vertex[k] = base + e->plane->vertex[e->plane->first[c] + k];
            vertex[n + k] = vertex[k] + up;
        }
        return;
    }
    for (size_t t = e->cut[c]; t < e->cut[c + 1]; t++, vertex += 12) {
        const size_t *flat = e->triangle + 3 * t;
        size_t triangle[3] = {base + flat[0], base + flat[1], base + flat[2]};
        cut_prism(triangle, up, vertex);
    }
}

static void lay_cells(struct extruding *e) {
    struct kr_mesh *solid = e->solid;
    size_t n = e->plane->n_cells, per_layer = e->first[n];
    solid->n_cells = n * e->n_layers;
    solid->first = kr_realloc(solid->first, solid->n_cells + 1, sizeof *solid->first);
    solid->vertex = KR_NEW(size_t, per_layer * e->n_layers);
    solid->cell_tag = KR_NEW(int64_t, solid->n_cells);
    for (size_t l = 0; l < e->n_layers; l++)
        for (size_t c = 0; c < n; c++) {
            size_t at = l * n + c, from = l * per_layer + e->first[c];
            lay_cell(e, c, l, solid->vertex + from);
            solid->first[at + 1] = l * per_layer + e->first[c + 1];
            solid->cell_tag[at] = (int64_t)at + 1;
        }
}

/* ---- boundary ---- */

static void add_face(struct extruding *e, size_t n, const size_t *point) {
    struct kr_mesh *solid = e->solid;
    KR_GROW(solid->face_first, solid->n_faces + 1, e->first_room);
    for (size_t k = 0; k < n; k++) {
        KR_GROW(solid->face, e->n_face_vertices, e->face_room);
        solid->face[e->n_face_vertices++] = point[k];
    }
    solid->face_first[++solid->n_faces] = e->n_face_vertices;
}

static void add_group(struct extruding *e, const char *name, int dim, size_t from, size_t to) {
    struct kr_mesh *solid = e->solid;
    KR_GROW(solid->group, solid->n_groups, e->groups_room);
    struct kr_mesh_group *group = &solid->group[solid->n_groups++];
    *group = (struct kr_mesh_group){kr_text_copy(name), dim, (int)solid->n_groups, to - from,
                                    KR_NEW(size_t, to - from)};
    for (size_t k = from; k < to; k++)
        group->member[k - from] = k;
}

/** Side of a prism over a boundary edge: a rectangle, or two triangles where the prism is cut. */
static void add_side(struct extruding *e, size_t edge, size_t layer) {
    size_t up = e->plane->n_points, a = e->plane->edge[2 * edge], b = e->plane->edge[2 * edge + 1];
    size_t cell = 0, base = layer * up;
    if (!kr_sides_find(e->sides, a, b, &cell))
        kr_sides_find(e->sides, b, a, &cell);
    const size_t corner[4] = {base + a, base + b, base + b + up, base + a + up};
    if (corners_of(e->plane, cell) <= 4) {
        add_face(e, 4, corner);
        return;
    }
    size_t s = a < b ? 0 : 1; /* where the diagonal begins, at the bottom */
    for (size_t k = 0; k < 2; k++, s += 2)
        add_face(e, 3, (const size_t[3]){corner[s % 4], corner[(s + 1) % 4], corner[(s + 2) % 4]});
}

/** One end of the solid; seen from outside, the cells of the front go round the other way. */
static void add_end(struct extruding *e, const char *name, int is_back) {
    const struct kr_mesh *plane = e->plane;
    size_t from = e->solid->n_faces, base = is_back ? e->n_layers * plane->n_points : 0;
    for (size_t c = 0; c < plane->n_cells; c++) {
        size_t n = corners_of(plane, c), polygons = n > 4 ? e->cut[c + 1] - e->cut[c] : 1;
        const size_t *v = n > 4 ? e->triangle + 3 * e->cut[c] : plane->vertex + plane->first[c];
        for (size_t t = 0, m = n > 4 ? 3 : n; t < polygons; t++, v += m) {
            size_t face[4];
            for (size_t k = 0; k < m; k++)
                face[k] = base + v[is_back ? k : m - 1 - k];
            add_face(e, m, face);
        }
    }
    add_group(e, name, 2, from, e->solid->n_faces);
}

static void lay_groups(struct extruding *e) {
    const struct kr_mesh *plane = e->plane;
    e->solid->face_first = KR_NEW(size_t, 1);
    e->first_room = 1;
    for (size_t g = 0; g < plane->n_groups; g++) {
        const struct kr_mesh_group *group = &plane->group[g];
        size_t from = e->solid->n_faces;
        if (group->dim != 1)
            continue;
        for (size_t l = 0; l < e->n_layers; l++)
            for (size_t k = 0; k < group->count; k++)
                add_side(e, group->member[k], l);
        add_group(e, group->name, 2, from, e->solid->n_faces);
    }
    add_end(e, "front", 0);
    add_end(e, "back", 1);
    add_group(e, "body", 3, 0, e->solid->n_cells);
}

struct kr_mesh *kr_mesh_extrude(const struct kr_mesh *plane, double depth, size_t n_layers) {
    struct extruding e = {.plane = plane, .solid = kr_mesh_create(), .n_layers = n_layers};
    e.solid->dim = 3;
    e.sides = kr_sides_create(plane->n_points, plane->n_cells, plane->first, plane->vertex);
    measure(&e);
    lay_points(&e, depth);
    lay_cells(&e);
    lay_groups(&e);
    kr_sides_free(e.sides);
    kr_free(e.first);
    kr_free(e.cut);
    kr_free(e.triangle);
    return e.solid;
}
