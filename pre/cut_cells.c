/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Cubes cut by surfaces. See cut_cells.h.
 *
 * A cube in the making is a range in one list of tetrahedra and one of outer triangles; those on its
 * six sides become boundary only where no cell lies behind the side.
 */
#include "cut_cells.h"

#include "base/error.h"
#include "base/memory.h"
#include "poly.h"
#include "solid_builder.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Labels of triangles: a surface is its place among the cutters. */
enum { INNER = -1, FIRST_SIDE = -2 }; /* side s is FIRST_SIDE - s */

/* A cell of less than this share of a cube is joined to a neighbour: smaller ones raise the scatter of
 * volumes, larger limits that of the joined cells. */
static const double LEAST = 0.5;

struct triangle {
    size_t point[3];
    int label;
};

/** A cube that a surface cuts, or that a sliver joins. */
struct cube {
    size_t at[3];
    size_t tetrahedra, triangles; /* where they begin; the next cube's are behind */
    double volume, side[6];       /* spacings cubed and squared */
    size_t root;                  /* cube that it is joined to, itself if to none */
    double joined;                /* volume of all that is joined to a root */
    int is_whole;
};

/* What a lattice cell is, in `state`: whole, behind a surface (GONE less 1 + its group), or cut. */
enum { WHOLE = 0, GONE = -1 };

struct cutting {
    const struct kr_block_body *body;
    struct kr_field *field; /* (cutters) */
    struct kr_solid_builder builder;
    int32_t *state; /* (lattice cells) place among the cubes plus 1 where cut */
    size_t n_cubes, cubes_room, n_tetrahedra, tetrahedra_room, n_triangles, triangles_room;
    struct cube *cube;
    size_t (*tetrahedron)[4];
    struct triangle *triangle;
};

/* ---- one cube ---- */

/** Values of a cutter at the corners of a cube (corner c: bits of x, y, z); whether any is not
 *  positive, whether any is. */
static void values_of(const struct kr_field *field, const size_t at[3], double value[8], int *any) {
    any[0] = any[1] = 0;
    for (size_t c = 0; c < 8; c++) {
        value[c] = kr_field_at(field, (long)(at[0] + (c & 1)), (long)(at[1] + (c >> 1 & 1)),
                               (long)(at[2] + (c >> 2)));
        any[value[c] > 0] = 1;
    }
}

static double volume_of(const double *a, const double *b, const double *c, const double *d) {
    double u[3], v[3], w[3];
    for (int k = 0; k < 3; k++) {
        u[k] = b[k] - a[k];
        v[k] = c[k] - a[k];
        w[k] = d[k] - a[k];
    }
    return (u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
            u[2] * (v[0] * w[1] - v[1] * w[0])) / 6;
}

static double area_of(const double *a, const double *b, const double *c) {
    double u[3], v[3];
    for (int k = 0; k < 3; k++) {
        u[k] = b[k] - a[k];
        v[k] = c[k] - a[k];
    }
    return hypot(hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2]),
                 u[0] * v[1] - u[1] * v[0]) / 2;
}

/** Points of the mesh for the vertices of what is left of a tetrahedron with these corners. */
static void place_vertices(struct cutting *cutting, const struct kr_poly *poly,
                           const size_t corner[4][3], size_t *point) {
    for (size_t v = 0; v < poly->n; v++) {
        const double *w = poly->weight[v];
        double place[3];
        for (int d = 0; d < 3; d++)
            place[d] = w[0] * (double)corner[0][d] + w[1] * (double)corner[1][d] +
                       w[2] * (double)corner[2][d] + w[3] * (double)corner[3][d];
        size_t k = 0;
        while (k < 4 && w[k] != 1)
            k++;
        point[v] = k < 4 ? kr_solid_builder_lattice_point(&cutting->builder, corner[k][0],
                                                          corner[k][1], corner[k][2])
                         : kr_solid_builder_point(&cutting->builder, place);
    }
}

static void add_triangle(struct cutting *cutting, struct cube *cube, const size_t p[3], int label) {
    const double *x = cutting->builder.mesh->point;
    KR_GROW(cutting->triangle, cutting->n_triangles, cutting->triangles_room);
    cutting->triangle[cutting->n_triangles++] = (struct triangle){{p[0], p[1], p[2]}, label};
    if (label <= FIRST_SIDE)
        cube->side[FIRST_SIDE - label] += area_of(x + 3 * p[0], x + 3 * p[1], x + 3 * p[2]);
}

static void add_pieces(struct cutting *cutting, struct cube *cube, const struct kr_poly *poly,
                       const size_t *point) {
    struct kr_poly_pieces pieces;
    const double *x = cutting->builder.mesh->point;
    kr_poly_cut(poly, point, &pieces);
    for (size_t k = 0; k < pieces.n_triangles; k++) {
        const unsigned char *v = pieces.triangle[k];
        if (pieces.label[k] != INNER)
            add_triangle(cutting, cube, (const size_t[3]){point[v[0]], point[v[1]], point[v[2]]},
                         pieces.label[k]);
    }
    for (size_t k = 0; k < pieces.n_tetrahedra; k++) {
        KR_GROW(cutting->tetrahedron, cutting->n_tetrahedra, cutting->tetrahedra_room);
        size_t *t = cutting->tetrahedron[cutting->n_tetrahedra++];
        for (int c = 0; c < 4; c++)
            t[c] = point[pieces.tetrahedron[k][c]];
        cube->volume += volume_of(x + 3 * t[0], x + 3 * t[1], x + 3 * t[2], x + 3 * t[3]);
    }
}

static void cut_tetrahedron(struct cutting *cutting, struct cube *cube, const struct kr_kuhn *kuhn,
                            const double (*value)[8], size_t n_cutters, const size_t *cutter) {
    struct kr_poly poly;
    size_t corner[4][3], point[KR_POLY_VERTICES];
    const int label[4] = {FIRST_SIDE - kuhn->side_of_first, INNER, INNER,
                          FIRST_SIDE - kuhn->side_of_last};
    for (size_t k = 0; k < 4; k++)
        for (int d = 0; d < 3; d++)
            corner[k][d] = cube->at[d] + (kuhn->corner[k] >> d & 1u);
    kr_poly_begin(&poly, kuhn->is_mirrored, label);
    for (size_t c = 0; c < n_cutters && poly.n; c++) {
        double f[4];
        for (int k = 0; k < 4; k++)
            f[k] = value[c][kuhn->corner[k]];
        kr_poly_clip(&poly, f, (int)cutter[c]);
    }
    cube->is_whole &= poly.n == 4 && poly.weight[0][0] == 1 && poly.weight[1][1] == 1 &&
                      poly.weight[2][2] == 1 && poly.weight[3][3] == 1;
    place_vertices(cutting, &poly, (const size_t(*)[3])corner, point);
    add_pieces(cutting, cube, &poly, point);
}

/** Cut a cube by some surfaces and add what is left; returns its place, or -1 if nothing is. */
static long cut_cube(struct cutting *cutting, const size_t at[3], size_t n_cutters,
                     const size_t *cutter, const double (*value)[8]) {
    struct cube cube = {.at = {at[0], at[1], at[2]}, .tetrahedra = cutting->n_tetrahedra,
                        .triangles = cutting->n_triangles, .root = cutting->n_cubes, .is_whole = 1};
    for (int t = 0; t < 6; t++)
        cut_tetrahedron(cutting, &cube, &kr_kuhn[t], value, n_cutters, cutter);
    if (cutting->n_tetrahedra == cube.tetrahedra)
        return -1;
    cube.joined = cube.volume;
    KR_GROW(cutting->cube, cutting->n_cubes, cutting->cubes_room);
    cutting->cube[cutting->n_cubes] = cube;
    return (long)cutting->n_cubes++;
}

/* ---- all cubes ---- */

static int32_t gone_by(const struct cutting *cutting, size_t cutter, const size_t at[3]) {
    const double centre[3] = {(double)at[0] + 0.5, (double)at[1] + 0.5, (double)at[2] + 0.5};
    return GONE - kr_cutter_group(&cutting->body->cutter[cutter], centre);
}

static int32_t state_of(struct cutting *cutting, const size_t at[3]) {
    double value[KR_POLY_PLANES][8];
    size_t cutter[KR_POLY_PLANES], n = 0;
    for (size_t c = 0; c < cutting->body->n_cutters; c++) {
        int any[2];
        const struct kr_field *f = &cutting->field[c];
        int is_near = 1;
        for (int d = 0; d < 3; d++)
            is_near &= (long)at[d] >= f->low[d] - 1 && (long)at[d] <= f->high[d];
        if (!is_near)
            continue;
        if (n == KR_POLY_PLANES)
            kr_stop(KR_EXIT_INPUT, "more than %d surfaces meet at (%.9g, %.9g, %.9g) mm; take a finer "
                                   "spacing", KR_POLY_PLANES - 1,
                    1e3 * cutting->body->spacing * (double)at[0],
                    1e3 * cutting->body->spacing * (double)at[1],
                    1e3 * cutting->body->spacing * (double)at[2]);
        values_of(f, at, value[n], any);
        if (!any[1])
            return gone_by(cutting, c, at);
        cutter[n] = c;
        n += (size_t)any[0];
    }
    if (!n)
        return WHOLE;
    long place = cut_cube(cutting, at, n, cutter, (const double(*)[8])value);
    return place < 0 ? gone_by(cutting, cutter[0], at) : (int32_t)place + 1;
}

static int32_t *states(struct cutting *cutting) {
    const size_t *n = cutting->body->n;
    int32_t *state = KR_NEW(int32_t, n[0] * n[1] * n[2]);
    size_t at[3];
    for (at[2] = 0; at[2] < n[2]; at[2]++)
        for (at[1] = 0; at[1] < n[1]; at[1]++)
            for (at[0] = 0; at[0] < n[0]; at[0]++)
                state[kr_block_cell(cutting->body, at[0], at[1], at[2])] = state_of(cutting, at);
    return state;
}

/* ---- joining slivers ---- */

/** Lattice cell behind a side; its number plus 1, 0 beyond the block. */
static size_t behind(const struct kr_block_body *body, const size_t at[3], int side) {
    size_t to[3] = {at[0], at[1], at[2]};
    to[side / 2] += side % 2 ? 1 : (size_t)-1;
    return to[side / 2] < body->n[side / 2] ? 1 + kr_block_cell(body, to[0], to[1], to[2]) : 0;
}

/** The cube of a lattice cell; a whole one is divided only when a sliver is to join it. */
static size_t cube_of(struct cutting *cutting, size_t cell) {
    const size_t *n = cutting->body->n;
    if (cutting->state[cell] == WHOLE) {
        const size_t at[3] = {cell % n[0], cell / n[0] % n[1], cell / n[0] / n[1]};
        cutting->state[cell] = (int32_t)cut_cube(cutting, at, 0, NULL, NULL) + 1;
    }
    return (size_t)cutting->state[cell] - 1;
}

static size_t root_of(const struct cutting *cutting, size_t cube) {
    while (cutting->cube[cube].root != cube)
        cube = cutting->cube[cube].root;
    return cube;
}

/** The side over which a cube shares most with a cell that it is not joined to; large enough ones come
 *  first. -1: there is none. */
static int best_side(const struct cutting *cutting, size_t c) {
    const struct cube *cube = &cutting->cube[c];
    double most = 0;
    int best = -1;
    for (int s = 0; s < 6; s++) {
        size_t cell = behind(cutting->body, cube->at, s);
        int32_t state = cell ? cutting->state[cell - 1] : GONE;
        if (state < 0 || cube->side[s] <= 0)
            continue;
        size_t root = state > 0 ? root_of(cutting, (size_t)state - 1) : SIZE_MAX;
        if (root == root_of(cutting, c))
            continue;
        int is_large = state == WHOLE || cutting->cube[root].joined >= LEAST;
        double share = cube->side[s] + (is_large ? 2 : 0); /* an area is 1 at most */
        if (share > most) {
            most = share;
            best = s;
        }
    }
    return best;
}

static void join_slivers(struct cutting *cutting) {
    int joined = 1;
    while (joined) {
        joined = 0;
        for (size_t c = 0; c < cutting->n_cubes; c++) {
            size_t root = root_of(cutting, c);
            int side = cutting->cube[root].joined < LEAST ? best_side(cutting, c) : -1;
            if (side < 0)
                continue;
            size_t to = root_of(
                cutting, cube_of(cutting, behind(cutting->body, cutting->cube[c].at, side) - 1));
            cutting->cube[root].root = to;
            cutting->cube[to].joined += cutting->cube[root].joined;
            joined = 1;
        }
    }
}

/* ---- into the mesh ---- */

/** Boundary that a triangle or a side of a cube belongs to; -1 inside the body. */
static int group_of(const struct cutting *cutting, const size_t at[3], int label, const size_t *p) {
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
    size_t cell = behind(body, at, FIRST_SIDE - label);
    if (!cell)
        return body->side[FIRST_SIDE - label];
    return cutting->state[cell - 1] < 0 ? GONE - cutting->state[cell - 1] : -1;
}

static void take_whole(struct cutting *cutting, const size_t at[3]) {
    kr_solid_builder_cube(&cutting->builder, at[0], at[1], at[2]);
    for (int s = 0; s < 6; s++) {
        int group = group_of(cutting, at, FIRST_SIDE - s, NULL);
        if (group >= 0)
            kr_solid_builder_side(&cutting->builder, at[0], at[1], at[2], s, group);
    }
}

static size_t end_of(const struct cutting *cutting, size_t c, int triangles) {
    if (c + 1 == cutting->n_cubes)
        return triangles ? cutting->n_triangles : cutting->n_tetrahedra;
    return triangles ? cutting->cube[c + 1].triangles : cutting->cube[c + 1].tetrahedra;
}

/** Whether a cube can be a hexahedron: whole, alone, and no surface along any of its sides. */
static int is_plain(const struct cutting *cutting, size_t c) {
    const struct cube *cube = &cutting->cube[c];
    if (!cube->is_whole || cube->joined != cube->volume || cube->root != c)
        return 0;
    for (size_t t = cube->triangles; t < end_of(cutting, c, 1); t++)
        if (cutting->triangle[t].label >= 0)
            return 0;
    return 1;
}

/** Cut a tetrahedron in four about its middle, until there are enough to tell a polyhedron. */
static size_t divide(struct cutting *cutting, size_t n, size_t *vertex) {
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
static void take_cluster(struct cutting *cutting, size_t n, const size_t *member) {
    size_t vertices = 0, count = 0;
    for (size_t m = 0; m < n; m++)
        count += 4 * (end_of(cutting, member[m], 0) - cutting->cube[member[m]].tetrahedra);
    size_t *vertex = KR_NEW(size_t, count + 48);
    for (size_t m = 0; m < n; m++) {
        const struct cube *cube = &cutting->cube[member[m]];
        for (size_t t = cube->tetrahedra; t < end_of(cutting, member[m], 0); t++, vertices += 4)
            memcpy(vertex + vertices, cutting->tetrahedron[t], 4 * sizeof *vertex);
        for (size_t t = cube->triangles; t < end_of(cutting, member[m], 1); t++) {
            const struct triangle *triangle = &cutting->triangle[t];
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

/** Cubes of each cluster, in chains by their root. */
static void take_cells(struct cutting *cutting) {
    const size_t *n = cutting->body->n;
    size_t *next = KR_NEW(size_t, cutting->n_cubes), *last = KR_NEW(size_t, cutting->n_cubes);
    size_t *member = KR_NEW(size_t, cutting->n_cubes);
    for (size_t c = 0; c < cutting->n_cubes; c++)
        last[c] = c;
    for (size_t c = 0; c < cutting->n_cubes; c++) {
        size_t root = root_of(cutting, c);
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
        if (state == WHOLE || is_plain(cutting, c)) {
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

struct kr_mesh *kr_cut_cells_mesh(const struct kr_block_body *body) {
    struct cutting cutting = {.body = body, .builder = kr_solid_builder_begin(body)};
    cutting.field = KR_NEW(struct kr_field, body->n_cutters);
    for (size_t c = 0; c < body->n_cutters; c++)
        cutting.field[c] = kr_field_of(body, &body->cutter[c], 0, 1);
    cutting.state = states(&cutting);
    for (size_t c = 0; c < body->n_cutters; c++)
        kr_free(cutting.field[c].value);
    kr_free(cutting.field);
    join_slivers(&cutting);
    take_cells(&cutting);
    kr_free(cutting.state);
    kr_free(cutting.cube);
    kr_free(cutting.tetrahedron);
    kr_free(cutting.triangle);
    return kr_solid_builder_end(&cutting.builder);
}
