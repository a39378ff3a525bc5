/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Welded cells and squares into a mesh. See weld_mesh.h.
 */
#include "weld_mesh.h"

#include "base/memory.h"
#include "builder.h"
#include "region.h"

#include <stdlib.h>

/** Place in the mesh of a welded point; `known` holds it plus 1 for points off the lattice. */
static size_t take_point(struct kr_builder *builder, const struct kr_weld *weld, size_t *known,
                         size_t point) {
    size_t wide = weld->lattice.columns + 1, n_lattice = wide * (weld->lattice.rows + 1);
    double p[2];
    if (point < n_lattice)
        return kr_builder_lattice_point(builder, point % wide, point / wide);
    size_t *number = &known[point - n_lattice];
    kr_weld_place(weld, point, p);
    if (!*number)
        *number = 1 + kr_builder_point(builder, p[0] * weld->lattice.spacing,
                                       p[1] * weld->lattice.spacing);
    return *number - 1;
}

static void take_tiles(struct kr_builder *builder, const struct kr_weld *weld, size_t *known) {
    size_t *point = NULL, room = 0;
    for (size_t t = 0; t < weld->n_tiles; t++) {
        const struct kr_tile *tile = &weld->tile[t];
        if (tile->n > room)
            point = kr_realloc(point, room = 2 * tile->n, sizeof *point);
        for (size_t k = 0; k < tile->n; k++)
            point[k] = take_point(builder, weld, known, tile->point[k]);
        if (tile->n)
            kr_builder_cell(builder, tile->n, point);
    }
    kr_free(point);
}

/** A side of a tile that lies on a side of the body. */
struct rim {
    int group;
    size_t side, from, to;
    double share; /* of the side, where it begins */
};

static int by_side(const void *a, const void *b) {
    const struct rim *p = a, *q = b;
    if (p->group != q->group)
        return p->group < q->group ? -1 : 1;
    if (p->side != q->side)
        return p->side < q->side ? -1 : 1;
    return (p->share > q->share) - (p->share < q->share);
}

static double share_of(const struct kr_weld *weld, size_t side, size_t point) {
    const double *p = weld->polygon->point + 2 * side;
    const double *q = weld->polygon->point + 2 * weld->polygon->next[side];
    double at[2], x = q[0] - p[0], y = q[1] - p[1];
    kr_weld_place(weld, point, at);
    return ((at[0] - p[0]) * x + (at[1] - p[1]) * y) / (x * x + y * y);
}

/** Rims of the tiles, and of the squares where the body's sides lie on the lattice. */
static struct rim *rims_of(const struct kr_weld *weld, size_t *n) {
    const struct kr_lattice *lattice = &weld->lattice;
    unsigned char *covered = KR_NEW(unsigned char, weld->polygon->n);
    struct rim *rim = NULL;
    size_t room = 0;
    *n = 0;
    for (size_t t = 0; t < weld->n_tiles; t++)
        for (size_t k = 0; k < weld->tile[t].n; k++) {
            const struct kr_tile *tile = &weld->tile[t];
            if (tile->side[k] < 0)
                continue;
            size_t side = (size_t)tile->side[k];
            covered[side] = 1;
            KR_GROW(rim, *n, room);
            rim[(*n)++] = (struct rim){weld->polygon->group[side], side, tile->point[k],
                                       tile->point[k + 1 < tile->n ? k + 1 : 0],
                                       share_of(weld, side, tile->point[k])};
        }
    for (size_t s = 0; s < weld->polygon->n; s++)
        if (!covered[s]) {
            KR_GROW(rim, *n, room);
            rim[(*n)++] = (struct rim){weld->polygon->group[s], s,
                                       kr_region_corner(lattice, weld->polygon, s),
                                       kr_region_corner(lattice, weld->polygon, weld->polygon->next[s]),
                                       0};
        }
    kr_free(covered);
    if (*n)
        qsort(rim, *n, sizeof *rim, by_side);
    return rim;
}

static void take_rims(struct kr_builder *builder, const struct kr_plate_body *body, const struct kr_weld *weld,
                      size_t *known) {
    size_t n, k = 0;
    struct rim *rim = rims_of(weld, &n);
    for (size_t g = 0; g < body->n_groups; g++) {
        for (; k < n && rim[k].group == (int)g; k++)
            kr_builder_edge(builder, take_point(builder, weld, known, rim[k].from),
                            take_point(builder, weld, known, rim[k].to));
        kr_builder_group_edges(builder, body->group[g]);
    }
    kr_free(rim);
}

struct kr_mesh *kr_weld_mesh(const struct kr_weld *weld, const struct kr_plate_body *body, const unsigned char *is_other,
                             size_t *n_squares) {
    const struct kr_lattice *lattice = &weld->lattice;
    struct kr_builder builder = kr_builder_begin(lattice);
    size_t n_lattice = (lattice->columns + 1) * (lattice->rows + 1);
    size_t *known = KR_NEW(size_t, weld->n_points - n_lattice);
    for (size_t c = 0; c < lattice->columns * lattice->rows; c++)
        if (!is_other[c] && !body->holder[c])
            kr_builder_square(&builder, c % lattice->columns, c / lattice->columns);
    *n_squares = builder.mesh->n_cells;
    take_tiles(&builder, weld, known);
    take_rims(&builder, body, weld, known);
    kr_free(known);
    return kr_builder_end(&builder);
}
