/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Finding and mending faults of a mesh. See repair.h.
 */
#include "repair.h"

#include "base/error.h"
#include "base/memory.h"
#include "cell.h"
#include "copies.h"
#include "corners.h"
#include "face.h"
#include "side.h"

#include <math.h>
#include <string.h>

enum kind { REPEATED, FLAT, INVERTED, DUPLICATE, INNER, KINDS };

static const struct {
    const char *is, *mended;
} words[KINDS] = {
    [REPEATED] = {"a vertex twice", "the repetition was dropped"},
    [FLAT] = {"no area or volume", "dropped"},
    [INVERTED] = {"corners in a wrong order (inverted)", "their corners were put in order"},
    [DUPLICATE] = {"the same vertices as another cell", "the later one was dropped"},
    [INNER] = {"a place that is not on the boundary of just one cell", "dropped"},
};

enum { SHOWN = 3 };

struct repair {
    struct kr_mesh *mesh;
    int mend;
    size_t count[KINDS];
    char *shown[KINDS];
    size_t *size;           /* (n_cells) vertices that a cell has left */
    unsigned char *is_gone; /* (n_cells) */
};

static char *place_of(const struct kr_mesh *mesh, const double *at) {
    return mesh->dim == 2 ? kr_text("(%g, %g) m", at[0], at[1])
                          : kr_text("(%g, %g, %g) m", at[0], at[1], at[2]);
}

static void note(struct repair *r, enum kind kind, const char *item, long long tag, const double *at) {
    const struct kr_mesh *mesh = r->mesh;
    if (++r->count[kind] > SHOWN)
        return;
    char *place = place_of(mesh, at);
    char *more = kr_text("%s%s%s %lld at %s", r->shown[kind] ? r->shown[kind] : "",
                         r->shown[kind] ? ", " : "", item, tag, place);
    kr_free(place);
    kr_free(r->shown[kind]);
    r->shown[kind] = more;
}

static void note_cell(struct repair *r, enum kind kind, size_t cell) {
    note(r, kind, "cell", (long long)r->mesh->cell_tag[cell],
         r->mesh->point + 3 * r->mesh->vertex[r->mesh->first[cell]]);
}

/* ---- single cells ---- */

static size_t without_repeats(size_t n, size_t *vertex) {
    size_t kept = 0;
    for (size_t k = 0; k < n; k++) {
        size_t l = 0;
        while (l < kept && vertex[l] != vertex[k])
            l++;
        if (l == kept)
            vertex[kept++] = vertex[k];
    }
    return kept;
}

static double polygon(const struct kr_mesh *mesh, size_t n, const size_t *vertex, double *corner,
                      double *extent) {
    double centroid[2];
    *extent = 0;
    for (size_t k = 0; k < n; k++) {
        memcpy(corner + 2 * k, mesh->point + 3 * vertex[k], 2 * sizeof *corner);
        *extent = fmax(*extent, hypot(corner[2 * k] - corner[0], corner[2 * k + 1] - corner[1]));
    }
    return kr_cell_polygon(n, corner, centroid);
}

static void swap(size_t *a, size_t *b) {
    size_t kept = *a;
    *a = *b;
    *b = kept;
}

static void check_polygon(struct repair *r, size_t c) {
    enum { MOST = 64 };
    struct kr_mesh *mesh = r->mesh;
    size_t n = r->size[c], own[MOST];
    double corner[2 * MOST], extent = 0;
    memcpy(own, mesh->vertex + mesh->first[c], n * sizeof *own);
    n = without_repeats(n, own);
    if (n < r->size[c])
        note_cell(r, REPEATED, c);
    double area = n < 3 ? 0 : polygon(mesh, n, own, corner, &extent);
    /* 1e-12: what rounding leaves of a flat cell. A twisted quadrilateral may have area 0, too. */
    int is_twisted = n == 4 && !kr_cell_is_sound(4, corner) && kr_corners_untwist(mesh->point, own);
    if (is_twisted) {
        note_cell(r, INVERTED, c);
        area = polygon(mesh, n, own, corner, &extent);
    }
    if (n < 3 || fabs(area) <= 1e-12 * extent * extent) {
        note_cell(r, FLAT, c);
        r->is_gone[c] = 1;
    } else if (area < 0) {
        note_cell(r, INVERTED, c);
        for (size_t k = 0; k < n / 2; k++)
            swap(&own[k], &own[n - 1 - k]);
    }
    if (r->mend) {
        memcpy(mesh->vertex + mesh->first[c], own, n * sizeof *own);
        r->size[c] = n;
    }
}

static void check_solid(struct repair *r, size_t c) {
    struct kr_mesh *mesh = r->mesh;
    const double *first = mesh->point + 3 * mesh->vertex[mesh->first[c]];
    double centroid[3], extent = 0, volume = kr_mesh_cell_volume(mesh, c, centroid);
    for (size_t k = mesh->first[c]; k < mesh->first[c + 1]; k++) {
        const double *p = mesh->point + 3 * mesh->vertex[k];
        extent = fmax(extent, hypot(hypot(p[0] - first[0], p[1] - first[1]), p[2] - first[2]));
    }
    if (fabs(volume) <= 1e-12 * extent * extent * extent) {
        note_cell(r, FLAT, c);
        r->is_gone[c] = 1;
    } else if (volume < 0) {
        note_cell(r, INVERTED, c);
        if (r->mend)
            kr_corners_turn(r->size[c], mesh->vertex + mesh->first[c]);
    }
}

static void check_duplicates(struct repair *r) {
    unsigned char *is_copy = kr_mesh_copies(r->mesh, r->size, r->is_gone);
    for (size_t c = 0; c < r->mesh->n_cells; c++)
        if (is_copy[c]) {
            note_cell(r, DUPLICATE, c);
            r->is_gone[c] = 1;
        }
    kr_free(is_copy);
}

/* ---- facets and points ---- */

static void check_facets(struct repair *r) {
    struct kr_mesh *mesh = r->mesh;
    size_t n = mesh->dim == 2 ? mesh->n_edges : mesh->n_faces;
    unsigned char *is_gone = KR_NEW(unsigned char, n);
    struct kr_sides *sides = NULL;
    struct kr_faces *faces = NULL;
    if (mesh->dim == 2)
        sides = kr_sides_create(mesh->n_points, mesh->n_cells, mesh->first, mesh->vertex);
    else
        faces = kr_faces_create(mesh);
    for (size_t f = 0; f < n; f++) {
        const size_t *v = mesh->dim == 2 ? mesh->edge + 2 * f : mesh->face + mesh->face_first[f];
        size_t cells = sides ? kr_sides_find(sides, v[0], v[1], NULL) +
                                   kr_sides_find(sides, v[1], v[0], NULL)
                             : kr_faces_match(faces, mesh->face_first[f + 1] - mesh->face_first[f], v)
                                   .count;
        if (cells == 1)
            continue;
        note(r, INNER, "facet", (long long)f + 1, mesh->point + 3 * v[0]);
        is_gone[f] = 1;
    }
    kr_sides_free(sides);
    kr_faces_free(faces);
    if (r->mend && r->count[INNER])
        kr_mesh_drop_facets(mesh, is_gone);
    kr_free(is_gone);
}

static void check_orphans(struct kr_mesh *mesh, const char *path, int mend) {
    unsigned char *is_gone = KR_NEW(unsigned char, mesh->n_points);
    size_t orphans = 0, which = 0;
    memset(is_gone, 1, mesh->n_points);
    for (size_t k = 0; k < mesh->first[mesh->n_cells]; k++)
        is_gone[mesh->vertex[k]] = 0;
    for (size_t k = 0; k < 2 * mesh->n_edges; k++)
        is_gone[mesh->edge[k]] = 0;
    for (size_t k = 0; mesh->n_faces && k < mesh->face_first[mesh->n_faces]; k++)
        is_gone[mesh->face[k]] = 0;
    for (size_t p = mesh->n_points; p-- > 0;)
        if (is_gone[p]) {
            which = p;
            orphans++;
        }
    if (orphans)
        kr_warn("%s: %zu points belong to no cell, the first is point %lld at (%g, %g, %g) m; %s",
                path, orphans, (long long)kr_mesh_point_tag(mesh, which), mesh->point[3 * which],
                mesh->point[3 * which + 1], mesh->point[3 * which + 2],
                mend ? "dropped" : "they count for nothing");
    if (orphans && mend)
        kr_mesh_drop_points(mesh, is_gone);
    kr_free(is_gone);
}

/* ---- all together ---- */

/** Whether indices and coordinates are such that cells can be looked at at all. */
static void stop_if_broken(const struct kr_mesh *mesh, const char *path) {
    for (size_t c = 0; c < mesh->n_cells; c++)
        if (mesh->dim == 2 ? mesh->first[c + 1] - mesh->first[c] > 64
                           : !kr_solid_n_faces(mesh->first[c + 1] - mesh->first[c]))
            kr_stop(KR_EXIT_INPUT, "%s: cell %lld has %zu vertices", path,
                    (long long)mesh->cell_tag[c], mesh->first[c + 1] - mesh->first[c]);
}

static void stop_at_overlap(const struct kr_mesh *mesh, const char *path) {
    size_t cell[2];
    double common;
    if (!(mesh->dim == 2 ? kr_mesh_overlap(mesh, cell, &common)
                         : kr_mesh_solids_overlap(mesh, cell, &common)))
        return;
    const double *at = mesh->point + 3 * mesh->vertex[mesh->first[cell[0]]];
    char *place = place_of(mesh, at);
    kr_stop(KR_EXIT_INPUT, "%s: cells %lld and %lld overlap by %g m^%d at %s", path,
            (long long)mesh->cell_tag[cell[0]], (long long)mesh->cell_tag[cell[1]], common,
            mesh->dim, place);
}

static size_t report(struct repair *r, const char *path) {
    size_t total = 0;
    for (int k = 0; k < KINDS; k++) {
        if (r->count[k])
            kr_warn("%s: %zu %s with %s: %s%s%s%s", path, r->count[k],
                    k == INNER ? "boundary facets" : "cells", words[k].is, r->shown[k],
                    r->count[k] > SHOWN ? ", ..." : "", r->mend ? "; " : "",
                    r->mend ? words[k].mended : "");
        total += r->count[k];
        kr_free(r->shown[k]);
    }
    return total;
}

void kr_mesh_repair(struct kr_mesh *mesh, const char *path, int mend) {
    struct repair r = {.mesh = mesh, .mend = mend};
    stop_if_broken(mesh, path);
    r.size = KR_NEW(size_t, mesh->n_cells);
    r.is_gone = KR_NEW(unsigned char, mesh->n_cells);
    for (size_t c = 0; c < mesh->n_cells; c++) {
        r.size[c] = mesh->first[c + 1] - mesh->first[c];
        if (mesh->dim == 2)
            check_polygon(&r, c);
        else
            check_solid(&r, c);
    }
    check_duplicates(&r);
    if (mend)
        kr_mesh_drop_cells(mesh, r.size, r.is_gone);
    kr_free(r.size);
    kr_free(r.is_gone);
    check_facets(&r);
    size_t faults = report(&r, path);
    if (faults && !mend)
        kr_stop(KR_EXIT_INPUT, "%s: %zu faults, named above; mend the mesh, or let "
                               "kirsch-nodes --repair drop or turn what it can",
                path, faults);
    check_orphans(mesh, path, mend);
    char *fault = kr_mesh_fault(mesh);
    if (fault)
        kr_stop(KR_EXIT_INPUT, "%s: %s", path, fault);
    stop_at_overlap(mesh, path);
}
