/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The cells of the nodes in XDMF's mixed topology. See topology.h.
 */
#include "topology.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

enum { POLYGON = 3, POLYHEDRON = 16 };

struct words {
    size_t count, room;
    int64_t *word;
};

static void put(struct words *w, int64_t word) {
    KR_GROW(w->word, w->count, w->room);
    w->word[w->count++] = word;
}

static void put_corners(struct words *w, int64_t n, const int64_t *vertex) {
    for (int64_t k = 0; k < n; k++)
        put(w, vertex[k]);
}

static void put_polygon(struct words *w, int64_t n, const int64_t *vertex) {
    put(w, n == 3 ? 4 : n == 4 ? 5 : POLYGON);
    if (n > 4)
        put(w, n);
    put_corners(w, n, vertex);
}

/* The faces of a tetrahedron, seen from outside. */
static const int face_of[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

static int has(const int64_t *tetrahedron, int64_t vertex) {
    return tetrahedron[0] == vertex || tetrahedron[1] == vertex || tetrahedron[2] == vertex ||
           tetrahedron[3] == vertex;
}

/* Whether a face of tetrahedron k is a face of another one of the same cell. */
static int is_inside(int64_t n, const int64_t *vertex, int64_t k, const int *face) {
    const int64_t *own = vertex + 4 * k;
    for (int64_t m = 0; m < n; m++)
        if (m != k && has(vertex + 4 * m, own[face[0]]) && has(vertex + 4 * m, own[face[1]]) &&
            has(vertex + 4 * m, own[face[2]]))
            return 1;
    return 0;
}

/* The outer triangles of n tetrahedra that fill a cell; returns how many. */
static size_t outer_triangles(int64_t n, const int64_t *vertex, int64_t (*triangle)[3]) {
    size_t count = 0;
    for (int64_t k = 0; k < n; k++)
        for (int f = 0; f < 4; f++) {
            if (is_inside(n, vertex, k, face_of[f]))
                continue;
            for (int c = 0; c < 3; c++)
                triangle[count][c] = vertex[4 * k + face_of[f][c]];
            count++;
        }
    return count;
}

static double square_between(const struct kr_nodes *nodes, int64_t p, int64_t q) {
    double square = 0;
    for (int d = 0; d < 3; d++) {
        double way = nodes->point[3 * p + d] - nodes->point[3 * q + d];
        square += way * way;
    }
    return square;
}

/* Whether two triangles are the halves of a rectangle; then its corners. A rectangle's halves share their
 * longest side, the diagonal, and the two diagonals have one middle. Neighbours decide alike, for they
 * have the same two triangles. */
static int is_rectangle(const struct kr_nodes *nodes, const int64_t a[3], const int64_t b[3],
                        int64_t corner[4]) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int64_t p = a[i], q = a[(i + 1) % 3], r = a[(i + 2) % 3], s = b[(j + 2) % 3];
            if (b[j] != q || b[(j + 1) % 3] != p)
                continue;
            double diagonal = square_between(nodes, p, q), off = 0;
            for (int d = 0; d < 3; d++)
                off += fabs(nodes->point[3 * p + d] + nodes->point[3 * q + d] -
                            nodes->point[3 * r + d] - nodes->point[3 * s + d]);
            if (off * off > 1e-18 * diagonal || square_between(nodes, r, s) > diagonal * (1 + 1e-9))
                return 0;
            memcpy(corner, (const int64_t[]){p, s, q, r}, 4 * sizeof *corner);
            return 1;
        }
    return 0;
}

/* Halves of rectangles are put together: cubes beside this cell have whole faces, and a viewer shows a face
 * as outside where no other cell has the same. */
static void put_polyhedron(struct words *w, const struct kr_nodes *nodes, int64_t n, const int64_t *vertex) {
    int64_t(*triangle)[3] = kr_alloc((size_t)(4 * n), sizeof *triangle), corner[4];
    size_t count = outer_triangles(n, vertex, triangle), where = w->count + 1;
    unsigned char *done = KR_NEW(unsigned char, count + 1);
    put(w, POLYHEDRON);
    put(w, 0);
    for (size_t a = 0; a < count; a++) {
        size_t b = a + 1;
        if (done[a])
            continue;
        while (b < count && (done[b] || !is_rectangle(nodes, triangle[a], triangle[b], corner)))
            b++;
        put(w, b < count ? 4 : 3);
        put_corners(w, b < count ? 4 : 3, b < count ? corner : triangle[a]);
        done[b] = 1;
        w->word[where]++;
    }
    kr_free(done);
    kr_free(triangle);
}

/* ParaView takes XDMF's corners as VTK's, and in VTK's wedge the normal of the first triangle points outwards:
 * the mirror image of everybody else's. As it comes, ParaView would show it inside out. */
static void put_wedge(struct words *w, const int64_t *vertex) {
    put_corners(w, 6, (const int64_t[]){vertex[0], vertex[2], vertex[1], vertex[3], vertex[5], vertex[4]});
}

static void put_solid(struct words *w, const struct kr_nodes *nodes, int64_t n, const int64_t *vertex) {
    static const struct {
        int64_t corners, with_middles, number;
    } solid[] = {{4, 10, 6}, {5, 13, 7}, {6, 15, 8}, {8, 20, 9}};
    for (size_t k = 0; k < sizeof solid / sizeof *solid; k++)
        if (n == solid[k].corners || n == solid[k].with_middles) {
            put(w, solid[k].number);
            if (solid[k].corners == 6)
                put_wedge(w, vertex);
            else
                put_corners(w, solid[k].corners, vertex);
            return;
        }
    kr_assert(n % 4 == 0);
    put_polyhedron(w, nodes, n / 4, vertex);
}

int64_t *kr_topology_make(const struct kr_nodes *nodes, size_t *count) {
    struct words w = {0};
    for (size_t i = 0; i < nodes->n; i++) {
        const int64_t *vertex = nodes->vertex + nodes->first[i];
        int64_t n = nodes->first[i + 1] - nodes->first[i];
        if (nodes->dim == 2)
            put_polygon(&w, n, vertex);
        else
            put_solid(&w, nodes, n, vertex);
    }
    *count = w.count;
    return w.word;
}
