/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The cells of the nodes in XDMF's mixed topology. See topology.h.
 */
#include "topology.h"

#include "base/error.h"
#include "base/memory.h"

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

static void put_polyhedron(struct words *w, int64_t n, const int64_t *vertex) {
    int64_t faces = 0;
    put(w, POLYHEDRON);
    put(w, 0);
    size_t where = w->count - 1;
    for (int64_t k = 0; k < n; k++)
        for (int f = 0; f < 4; f++) {
            if (is_inside(n, vertex, k, face_of[f]))
                continue;
            put(w, 3);
            for (int c = 0; c < 3; c++)
                put(w, vertex[4 * k + face_of[f][c]]);
            faces++;
        }
    w->word[where] = faces;
}

static void put_solid(struct words *w, int64_t n, const int64_t *vertex) {
    static const struct {
        int64_t corners, with_middles, number;
    } solid[] = {{4, 10, 6}, {5, 13, 7}, {6, 15, 8}, {8, 20, 9}};
    for (size_t k = 0; k < sizeof solid / sizeof *solid; k++)
        if (n == solid[k].corners || n == solid[k].with_middles) {
            put(w, solid[k].number);
            put_corners(w, solid[k].corners, vertex);
            return;
        }
    kr_assert(n % 4 == 0);
    put_polyhedron(w, n / 4, vertex);
}

int64_t *kr_topology_make(const struct kr_nodes *nodes, size_t *count) {
    struct words w = {0};
    for (size_t i = 0; i < nodes->n; i++) {
        const int64_t *vertex = nodes->vertex + nodes->first[i];
        int64_t n = nodes->first[i + 1] - nodes->first[i];
        if (nodes->dim == 2)
            put_polygon(&w, n, vertex);
        else
            put_solid(&w, n, vertex);
    }
    *count = w.count;
    return w.word;
}
