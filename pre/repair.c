/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Finding and mending faults of a mesh. See repair.h.
 */
#include "repair.h"

#include "base/error.h"
#include "base/memory.h"
#include "cell.h"
#include "face.h"
#include "side.h"

#include <math.h>
#include <stdlib.h>
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

/** Put the corners of a quadrilateral that crosses itself in an order that does not; 0 if none. */
static int untwist(const struct kr_mesh *mesh, size_t *vertex) {
    static const int order[5][3] = {{1, 3, 2}, {2, 1, 3}, {2, 3, 1}, {3, 1, 2}, {3, 2, 1}};
    double corner[8], extent;
    for (size_t k = 0; k < 5; k++) {
        size_t tried[4] = {vertex[0], vertex[order[k][0]], vertex[order[k][1]], vertex[order[k][2]]};
        polygon(mesh, 4, tried, corner, &extent);
        if (kr_cell_is_sound(4, corner)) {
            memcpy(vertex, tried, sizeof tried);
            return 1;
        }
    }
    return 0;
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
    int is_twisted = n == 4 && !kr_cell_is_sound(4, corner) && untwist(mesh, own);
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

/** Turn a solid inside out: its mirror image in the order of corners. */
static void turn(size_t n, size_t *vertex) {
    if (kr_solid_is_pieces(n)) {
        for (size_t k = 0; k < n; k += 4)
            turn(4, vertex + k);
        return;
    }
    static const unsigned char order[][8] = {
        [4] = {0, 2, 1, 3}, [5] = {0, 3, 2, 1, 4}, [6] = {3, 4, 5, 0, 1, 2}, [8] = {4, 5, 6, 7, 0, 1, 2, 3}};
    const struct kr_solid *solid = kr_solid(n);
    const unsigned char *to = order[solid->corners];
    size_t old[20];
    memcpy(old, vertex, n * sizeof *old);
    for (size_t k = 0; k < solid->corners; k++)
        vertex[k] = old[to[k]];
    for (size_t e = 0; n > solid->corners && e < solid->n_edges; e++) {
        unsigned char a = to[solid->edge[e][0]], b = to[solid->edge[e][1]];
        size_t k = 0;
        while (!(solid->edge[k][0] == a && solid->edge[k][1] == b) &&
               !(solid->edge[k][0] == b && solid->edge[k][1] == a))
            k++;
        vertex[solid->corners + e] = old[solid->corners + k];
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
            turn(r->size[c], mesh->vertex + mesh->first[c]);
    }
}

/* ---- cells that stand twice ---- */

static int ascending(const void *a, const void *b) {
    size_t p = *(const size_t *)a, q = *(const size_t *)b;
    return (p > q) - (p < q);
}

static size_t lowest(const struct repair *r, size_t c) {
    const size_t *v = r->mesh->vertex + r->mesh->first[c];
    size_t low = v[0];
    for (size_t k = 1; k < r->size[c]; k++)
        low = v[k] < low ? v[k] : low;
    return low;
}

static int same_vertices(const struct repair *r, size_t p, size_t q) {
    size_t a[64], b[64], n = r->size[p];
    if (n != r->size[q])
        return 0;
    if (n > 64) /* a polyhedron: given twice it is given alike */
        return !memcmp(r->mesh->vertex + r->mesh->first[p], r->mesh->vertex + r->mesh->first[q],
                       n * sizeof *a);
    memcpy(a, r->mesh->vertex + r->mesh->first[p], n * sizeof *a);
    memcpy(b, r->mesh->vertex + r->mesh->first[q], n * sizeof *b);
    qsort(a, n, sizeof *a, ascending);
    qsort(b, n, sizeof *b, ascending);
    return !memcmp(a, b, n * sizeof *a);
}

/** Among the cells before c with the same lowest vertex, by a chain for each vertex. */
static void check_duplicates(struct repair *r) {
    const struct kr_mesh *mesh = r->mesh;
    size_t *head = KR_NEW(size_t, mesh->n_points), *next = KR_NEW(size_t, mesh->n_cells);
    for (size_t c = 0; c < mesh->n_cells; c++) {
        if (r->is_gone[c])
            continue;
        size_t *chain = &head[lowest(r, c)], other = *chain;
        while (other && !same_vertices(r, c, other - 1))
            other = next[other - 1];
        if (other) {
            note_cell(r, DUPLICATE, c);
            r->is_gone[c] = 1;
            continue;
        }
        next[c] = *chain;
        *chain = c + 1;
    }
    kr_free(head);
    kr_free(next);
}

/* ---- taking out ---- */

static void renumber_groups(struct kr_mesh *mesh, int dim, const unsigned char *is_gone,
                            const size_t *now_at) {
    for (size_t g = 0; g < mesh->n_groups; g++) {
        struct kr_mesh_group *group = &mesh->group[g];
        size_t kept = 0;
        if (group->dim != dim)
            continue;
        for (size_t k = 0; k < group->count; k++)
            if (!is_gone[group->member[k]])
                group->member[kept++] = now_at[group->member[k]];
        group->count = kept;
    }
}

static void drop_cells(struct repair *r) {
    struct kr_mesh *mesh = r->mesh;
    size_t *now_at = KR_NEW(size_t, mesh->n_cells), kept = 0, end = 0;
    for (size_t c = 0; c < mesh->n_cells; c++) {
        size_t from = mesh->first[c];
        if (r->is_gone[c])
            continue;
        now_at[c] = kept;
        memmove(mesh->vertex + end, mesh->vertex + from, r->size[c] * sizeof *mesh->vertex);
        mesh->cell_tag[kept] = mesh->cell_tag[c];
        mesh->first[kept++] = end;
        end += r->size[c];
    }
    mesh->n_cells = kept;
    mesh->first[kept] = end;
    renumber_groups(mesh, mesh->dim, r->is_gone, now_at);
    kr_free(now_at);
}

static void drop_facets(struct kr_mesh *mesh, const unsigned char *is_gone) {
    size_t n = mesh->dim == 2 ? mesh->n_edges : mesh->n_faces, kept = 0, end = 0;
    size_t *now_at = KR_NEW(size_t, n);
    for (size_t f = 0; f < n; f++) {
        size_t from = mesh->dim == 2 ? 2 * f : mesh->face_first[f];
        size_t count = mesh->dim == 2 ? 2 : mesh->face_first[f + 1] - from;
        if (is_gone[f])
            continue;
        now_at[f] = kept;
        memmove((mesh->dim == 2 ? mesh->edge : mesh->face) + end,
                (mesh->dim == 2 ? mesh->edge : mesh->face) + from, count * sizeof *mesh->edge);
        if (mesh->dim == 3)
            mesh->face_first[kept] = end;
        kept++;
        end += count;
    }
    if (mesh->dim == 3 && n)
        mesh->face_first[kept] = end;
    *(mesh->dim == 2 ? &mesh->n_edges : &mesh->n_faces) = kept;
    renumber_groups(mesh, mesh->dim - 1, is_gone, now_at);
    kr_free(now_at);
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
        drop_facets(mesh, is_gone);
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
        drop_cells(&r);
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
