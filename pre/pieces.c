/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Cutting cells into triangles and joining them. Cells are rewritten in order, so members of groups
 * stay ascending.
 */
#include "pieces.h"

#include "base/error.h"
#include "base/memory.h"
#include "element.h"

#include <math.h>
#include <string.h>

/** New arrays of cells in the making, and where each old cell went. */
struct rewriting {
    const struct kr_mesh *mesh;
    size_t n, n_vertices, first_room, vertex_room, tag_room;
    size_t *first, *vertex;
    int64_t *tag;
    size_t *begin; /* (old cells + 1) new cells of an old one */
};

static struct rewriting begin(const struct kr_mesh *mesh) {
    struct rewriting new = {.mesh = mesh};
    new.begin = KR_NEW(size_t, mesh->n_cells + 1);
    KR_GROW(new.first, 0, new.first_room);
    return new;
}

static void add_cell(struct rewriting *new, size_t n, const size_t *vertex, int64_t tag) {
    for (size_t k = 0; k < n; k++) {
        KR_GROW(new->vertex, new->n_vertices, new->vertex_room);
        new->vertex[new->n_vertices++] = vertex[k];
    }
    KR_GROW(new->tag, new->n, new->tag_room);
    new->tag[new->n++] = tag;
    KR_GROW(new->first, new->n, new->first_room);
    new->first[new->n] = new->n_vertices;
}

/** Members of a group of cells become the cells that they went into. */
static void renumber(const struct rewriting *new, struct kr_mesh_group *group) {
    size_t n = 0, room = 0, *member = NULL;
    for (size_t k = 0; k < group->count; k++)
        for (size_t c = new->begin[group->member[k]]; c < new->begin[group->member[k] + 1]; c++) {
            KR_GROW(member, n, room);
            member[n++] = c;
        }
    kr_free(group->member);
    group->member = member ? member : KR_NEW(size_t, 0);
    group->count = n;
}

static void finish(struct rewriting *new, struct kr_mesh *mesh) {
    new->begin[mesh->n_cells] = new->n;
    for (size_t g = 0; g < mesh->n_groups; g++)
        if (mesh->group[g].dim == mesh->dim)
            renumber(new, &mesh->group[g]);
    kr_free(mesh->first);
    kr_free(mesh->vertex);
    kr_free(mesh->cell_tag);
    kr_free(new->begin);
    mesh->n_cells = new->n;
    mesh->first = new->first;
    mesh->vertex = new->vertex;
    mesh->cell_tag = new->tag;
}

/* ---- cutting ---- */

static double twice_area(const double *p, const double *q, const double *r) {
    return (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]);
}

/** How good a triangle corner k of a polygon would make: its area over its longest side squared;
 *  not above 0 if it is none, or if another corner lies in it or on its sides. */
static double ear(const struct kr_mesh *mesh, size_t n, const size_t *v, size_t k) {
    const double *p = mesh->point + 3 * v[(k + n - 1) % n], *q = mesh->point + 3 * v[k];
    const double *r = mesh->point + 3 * v[(k + 1) % n];
    double area = twice_area(p, q, r), longest = 0;
    const double *corner[3] = {p, q, r};
    for (int c = 0; c < 3; c++) {
        const double *a = corner[c], *b = corner[(c + 1) % 3];
        longest = fmax(longest, (b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]));
    }
    for (size_t l = 0; l < n; l++) {
        const double *o = mesh->point + 3 * v[l];
        if (o == p || o == q || o == r)
            continue;
        double least = 1e-9 * longest; /* rounding of a corner that lies on a side */
        if (twice_area(p, q, o) > -least && twice_area(q, r, o) > -least &&
            twice_area(r, p, o) > -least)
            return -1;
    }
    return area / longest;
}

/** The corner whose triangle is best. */
static size_t best_ear(const struct kr_mesh *mesh, size_t n, const size_t *v) {
    double most = -2;
    size_t best = 0;
    for (size_t k = 0; k < n; k++) {
        double good = ear(mesh, n, v, k);
        if (good > most) {
            most = good;
            best = k;
        }
    }
    return best;
}

void kr_pieces_triangles(const struct kr_mesh *mesh, size_t n, size_t *v, size_t *triangle) {
    for (; n > 3; n--) {
        size_t k = best_ear(mesh, n, v);
        *triangle++ = v[(k + n - 1) % n];
        *triangle++ = v[k];
        *triangle++ = v[(k + 1) % n];
        memmove(v + k, v + k + 1, (n - k - 1) * sizeof *v);
    }
    memcpy(triangle, v, 3 * sizeof *v);
}

static void cut_cell(struct rewriting *new, size_t n, size_t *v, int64_t *tag) {
    size_t *triangle = KR_NEW(size_t, 3 * (n - 2));
    kr_pieces_triangles(new->mesh, n, v, triangle);
    for (size_t k = 0; k < n - 2; k++)
        add_cell(new, 3, triangle + 3 * k, ++*tag);
    kr_free(triangle);
}

static void cut_solid(struct rewriting *new, size_t n, const size_t *v, int64_t *tag) {
    for (size_t k = 0; k < n; k += 4)
        add_cell(new, 4, v + k, ++*tag);
}

/** Whether a file has no kind of its own for a cell of n vertices. */
static int is_cut(const struct kr_mesh *mesh, size_t n) {
    return mesh->dim == 2 ? n > 4 : kr_solid_is_pieces(n);
}

static int has_polygons(const struct kr_mesh *mesh) {
    for (size_t c = 0; c < mesh->n_cells; c++)
        if (is_cut(mesh, mesh->first[c + 1] - mesh->first[c]))
            return 1;
    return 0;
}

static int free_tag(const struct kr_mesh *mesh) {
    int most = 0;
    for (size_t g = 0; g < mesh->n_groups; g++)
        most = mesh->group[g].tag > most ? mesh->group[g].tag : most;
    return most + 1;
}

void kr_pieces_cut(struct kr_mesh *mesh) {
    size_t n_pieces = 0, room = 0, *piece = NULL, *vertex = NULL;
    int64_t tag = 0;
    if (!has_polygons(mesh))
        return;
    struct rewriting new = begin(mesh);
    for (size_t c = 0; c < mesh->n_cells; c++) {
        size_t n = mesh->first[c + 1] - mesh->first[c];
        new.begin[c] = new.n;
        if (!is_cut(mesh, n)) {
            add_cell(&new, n, mesh->vertex + mesh->first[c], ++tag);
            continue;
        }
        vertex = kr_realloc(vertex, n, sizeof *vertex);
        memcpy(vertex, mesh->vertex + mesh->first[c], n * sizeof *vertex);
        tag++; /* the gap */
        if (mesh->dim == 2)
            cut_cell(&new, n, vertex, &tag);
        else
            cut_solid(&new, n, vertex, &tag);
        for (size_t k = new.begin[c]; k < new.n; k++) {
            KR_GROW(piece, n_pieces, room);
            piece[n_pieces++] = k;
        }
    }
    finish(&new, mesh);
    kr_free(vertex);
    mesh->group = kr_realloc(mesh->group, mesh->n_groups + 1, sizeof *mesh->group);
    mesh->group[mesh->n_groups] = (struct kr_mesh_group){
        kr_text_copy(KR_PIECES_GROUP), mesh->dim, free_tag(mesh), n_pieces, piece};
    mesh->n_groups++;
}

/* ---- joining ---- */

/** The ring around the cells from c up to, not with, `end`; its length, 0 if they bound none. */
static size_t ring_around(const struct kr_mesh *mesh, size_t c, size_t end, size_t *ring) {
    const size_t begins = mesh->first[c], n = mesh->first[end] - begins;
    size_t *from = KR_NEW(size_t, n), *to = KR_NEW(size_t, n), left = 0, length = 0;
    for (; c < end; c++)
        for (size_t k = mesh->first[c]; k < mesh->first[c + 1]; k++) {
            size_t a = mesh->vertex[k];
            size_t b = mesh->vertex[k + 1 < mesh->first[c + 1] ? k + 1 : mesh->first[c]], l = 0;
            while (l < left && (from[l] != b || to[l] != a))
                l++;
            if (l < left) { /* walked both ways: inside */
                from[l] = from[--left];
                to[l] = to[left];
            } else {
                from[left] = a;
                to[left++] = b;
            }
        }
    for (size_t at = 0, k; length < left; at = k) {
        ring[length++] = from[at];
        for (k = 0; k < left && from[k] != to[at]; k++)
            ;
        if (k == left || k == 0)
            break;
    }
    length = length == left ? length : 0;
    kr_free(from);
    kr_free(to);
    return length;
}

static void drop_group(struct kr_mesh *mesh, const struct kr_mesh_group *group) {
    size_t g = (size_t)(group - mesh->group);
    kr_free(mesh->group[g].name);
    kr_free(mesh->group[g].member);
    memmove(mesh->group + g, mesh->group + g + 1,
            (mesh->n_groups - g - 1) * sizeof *mesh->group);
    mesh->n_groups--;
}

/** The vertices of the solids from c up to, not with, `end`, one after the other; 0 unless they are
 *  the tetrahedra of a polyhedron. */
static size_t solids_of(const struct kr_mesh *mesh, size_t c, size_t end, size_t *vertex) {
    size_t n = mesh->first[end] - mesh->first[c];
    for (size_t k = c; k < end && end > c + 1; k++)
        if (mesh->first[k + 1] - mesh->first[k] != 4)
            return 0;
    memcpy(vertex, mesh->vertex + mesh->first[c], n * sizeof *vertex);
    return end == c + 1 || kr_solid_is_pieces(n) ? n : 0;
}

void kr_pieces_join(struct kr_mesh *mesh, const char *path) {
    const struct kr_mesh_group *group = kr_mesh_group(mesh, KR_PIECES_GROUP, mesh->dim);
    size_t k = 0, *ring = NULL;
    if (!group)
        return;
    struct rewriting new = begin(mesh);
    for (size_t c = 0, end; c < mesh->n_cells; c = end) {
        end = c + 1;
        if (k < group->count && group->member[k] == c) {
            while (++k < group->count && group->member[k] == end &&
                   mesh->cell_tag[end] == mesh->cell_tag[end - 1] + 1)
                end++;
        }
        ring = kr_realloc(ring, mesh->first[end] - mesh->first[c], sizeof *ring);
        size_t n = mesh->dim == 2 ? ring_around(mesh, c, end, ring) : solids_of(mesh, c, end, ring);
        if (!n)
            kr_stop(KR_EXIT_INPUT, "%s: the pieces %lld to %lld %s", path,
                    (long long)mesh->cell_tag[c], (long long)mesh->cell_tag[end - 1],
                    mesh->dim == 2 ? "bound no simple polygon" : "are not six tetrahedra or more");
        new.begin[c] = new.n;
        for (size_t old = c + 1; old < end; old++)
            new.begin[old] = new.n + 1; /* gone into the first */
        add_cell(&new, n, ring, mesh->cell_tag[c]);
    }
    finish(&new, mesh);
    kr_free(ring);
    drop_group(mesh, kr_mesh_group(mesh, KR_PIECES_GROUP, mesh->dim));
}
