/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Solids that overlap, also where they share no face.
 *
 * Not all pairs need be looked at. How many cells cover a place is the winding number of all faces
 * that belong to one cell alone, for those of two cancel. Where it falls from two or more, such a
 * face is crossed, and the cell behind it is covered by another one. So one of two that overlap
 * is always found among the cells with a face of their own, the skin. These are put into a grid
 * of bins, into all that they touch, and every cell looks into its bins.
 */
#include "repair.h"

#include "base/memory.h"
#include "common_solid.h"
#include "face.h"

#include <math.h>
#include <string.h>

struct skin {
    const struct kr_mesh *mesh;
    struct kr_box *box; /* (n_cells) */
    size_t count, *cell;
    double origin[3], size; /* of a bin */
    size_t bins[3];
    size_t *first, *member; /* cells of the skin in each bin */
};

struct range {
    size_t from[3], to[3];
};

static struct kr_box box_of(const struct kr_mesh *mesh, size_t cell) {
    struct kr_box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t k = mesh->first[cell]; k < mesh->first[cell + 1]; k++)
        for (int d = 0; d < 3; d++) {
            double x = mesh->point[3 * mesh->vertex[k] + (size_t)d];
            box.lower[d] = fmin(box.lower[d], x);
            box.upper[d] = fmax(box.upper[d], x);
        }
    return box;
}

/* Cells with a face that is theirs alone. */
static void find_skin(struct skin *skin) {
    const struct kr_mesh *mesh = skin->mesh;
    struct kr_faces *faces = kr_faces_create(mesh);
    unsigned char *is_skin = KR_NEW(unsigned char, mesh->n_cells);
    size_t vertex[KR_MOST_FACE];
    for (size_t k = 0; k < faces->count; k++) {
        size_t n = kr_faces_vertices(faces, faces->face[k], vertex);
        if (!is_skin[faces->face[k].cell] && kr_faces_match(faces, n, vertex).count == 1)
            is_skin[faces->face[k].cell] = 1;
    }
    skin->cell = KR_NEW(size_t, mesh->n_cells);
    for (size_t c = 0; c < mesh->n_cells; c++)
        if (is_skin[c])
            skin->cell[skin->count++] = c;
    kr_free(is_skin);
    kr_faces_free(faces);
}

/* Bins of the mean size of the skin's cells, but not many more of them than cells. */
static void measure_bins(struct skin *skin) {
    double upper[3] = {-INFINITY, -INFINITY, -INFINITY}, room = 1;
    for (int d = 0; d < 3; d++)
        skin->origin[d] = INFINITY;
    for (size_t c = 0; c < skin->mesh->n_cells; c++)
        for (int d = 0; d < 3; d++) {
            skin->origin[d] = fmin(skin->origin[d], skin->box[c].lower[d]);
            upper[d] = fmax(upper[d], skin->box[c].upper[d]);
        }
    for (size_t k = 0; k < skin->count; k++)
        for (int d = 0; d < 3; d++) {
            const struct kr_box *box = &skin->box[skin->cell[k]];
            skin->size += (box->upper[d] - box->lower[d]) / (3 * (double)skin->count);
        }
    for (int d = 0; d < 3; d++)
        room *= upper[d] - skin->origin[d];
    skin->size = fmax(skin->size, cbrt(room / (double)skin->mesh->n_cells));
    for (int d = 0; d < 3; d++)
        skin->bins[d] = (size_t)((upper[d] - skin->origin[d]) / skin->size) + 1;
}

static struct range range_of(const struct skin *skin, const struct kr_box *box) {
    struct range range;
    for (int d = 0; d < 3; d++) {
        range.from[d] = (size_t)((box->lower[d] - skin->origin[d]) / skin->size);
        range.to[d] = (size_t)((box->upper[d] - skin->origin[d]) / skin->size) + 1;
        range.to[d] = range.to[d] < skin->bins[d] ? range.to[d] : skin->bins[d];
    }
    return range;
}

#define EACH_BIN(skin, range, bin)                                                                 \
    for (size_t z_ = (range).from[2]; z_ < (range).to[2]; z_++)                                    \
        for (size_t y_ = (range).from[1]; y_ < (range).to[1]; y_++)                                \
            for (size_t bin = ((skin)->bins[1] * z_ + y_) * (skin)->bins[0] + (range).from[0],     \
                        end_ = bin + (range).to[0] - (range).from[0];                              \
                 bin < end_; bin++)

static void fill_bins(struct skin *skin) {
    size_t bins = skin->bins[0] * skin->bins[1] * skin->bins[2];
    skin->first = KR_NEW(size_t, bins + 2); /* begins one late, and is right when filled */
    for (size_t k = 0; k < skin->count; k++) {
        struct range range = range_of(skin, &skin->box[skin->cell[k]]);
        EACH_BIN(skin, range, bin)
            skin->first[bin + 2]++;
    }
    for (size_t bin = 0; bin <= bins; bin++)
        skin->first[bin + 1] += skin->first[bin];
    skin->member = KR_NEW(size_t, skin->first[bins + 1]);
    for (size_t k = 0; k < skin->count; k++) {
        struct range range = range_of(skin, &skin->box[skin->cell[k]]);
        EACH_BIN(skin, range, bin)
            skin->member[skin->first[bin + 1]++] = skin->cell[k];
    }
}

/* Whether the boxes have more in common than 1e-6 of the smaller one in each direction. */
static int may_overlap(const struct kr_box *a, const struct kr_box *b) {
    for (int d = 0; d < 3; d++) {
        double margin = 1e-6 * fmin(a->upper[d] - a->lower[d], b->upper[d] - b->lower[d]);
        if (a->lower[d] >= b->upper[d] - margin || b->lower[d] >= a->upper[d] - margin)
            return 0;
    }
    return 1;
}

struct pair {
    size_t cell[2];
    double common;
};

static int is_before(const size_t a[2], const size_t b[2]) {
    return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
}

/* Keep the lowest pair of a cell and one of the skin that overlap. `cut`: memory for two. */
static void look_around(const struct skin *skin, size_t c, struct kr_cut_cell cut[2],
                        struct pair *lowest) {
    struct range range = range_of(skin, &skin->box[c]);
    int is_cut = 0;
    EACH_BIN(skin, range, bin)
        for (size_t k = skin->first[bin]; k < skin->first[bin + 1]; k++) {
            size_t other = skin->member[k], pair[2] = {c < other ? c : other, c < other ? other : c};
            if (other == c || !is_before(pair, lowest->cell) ||
                !may_overlap(&skin->box[c], &skin->box[other]))
                continue;
            if (!is_cut++)
                kr_cut_cell(skin->mesh, c, &cut[0]);
            kr_cut_cell(skin->mesh, other, &cut[1]);
            double common = kr_cut_cells_common(&cut[0], &cut[1]);
            if (common > 1e-6 * fmin(cut[0].volume, cut[1].volume)) {
                memcpy(lowest->cell, pair, sizeof pair);
                lowest->common = common;
            }
        }
}

static struct pair lowest_pair(const struct skin *skin) {
    const size_t n = skin->mesh->n_cells;
    struct pair lowest = {{n, n}, 0};
#pragma omp parallel
    {
        struct kr_cut_cell cut[2] = {{0}, {0}};
        struct pair own = {{n, n}, 0};
#pragma omp for schedule(dynamic, 1024)
        for (size_t c = 0; c < n; c++)
            look_around(skin, c, cut, &own);
#pragma omp critical
        if (is_before(own.cell, lowest.cell))
            lowest = own;
        kr_cut_cell_free(&cut[0]);
        kr_cut_cell_free(&cut[1]);
    }
    return lowest;
}

int kr_mesh_solids_overlap(const struct kr_mesh *mesh, size_t cell[2], double *volume) {
    struct skin skin = {.mesh = mesh, .box = KR_NEW(struct kr_box, mesh->n_cells)};
    for (size_t c = 0; c < mesh->n_cells; c++)
        skin.box[c] = box_of(mesh, c);
    find_skin(&skin);
    measure_bins(&skin);
    fill_bins(&skin);
    struct pair lowest = lowest_pair(&skin);
    memcpy(cell, lowest.cell, sizeof lowest.cell);
    *volume = lowest.common;
    kr_free(skin.box);
    kr_free(skin.cell);
    kr_free(skin.first);
    kr_free(skin.member);
    return cell[0] < mesh->n_cells;
}
