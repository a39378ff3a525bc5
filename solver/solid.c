/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Shapes of solid cells. See solid.h; the order of vertices is that of VTK's file formats.
 */
#include "solid.h"

#include <math.h>
#include <string.h>

static const struct kr_solid solids[] = {
    {"tetrahedron", 4, 6, 4,
     {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
     {3, 3, 3, 3},
     {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}},
    {"pyramid", 5, 8, 5,
     {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
     {4, 3, 3, 3, 3},
     {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}},
    {"wedge", 6, 9, 5,
     {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
     {3, 3, 4, 4, 4},
     {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}},
    {"hexahedron", 8, 12, 6,
     {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}},
     {4, 4, 4, 4, 4, 4},
     {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
};

const struct kr_solid *kr_solid(size_t vertices) {
    for (size_t k = 0; k < sizeof solids / sizeof *solids; k++)
        if (vertices == solids[k].corners || vertices == solids[k].corners + solids[k].n_edges)
            return &solids[k];
    return NULL;
}

size_t kr_solid_n_faces(size_t vertices) {
    const struct kr_solid *solid = kr_solid(vertices);
    return solid ? solid->n_faces : kr_solid_is_pieces(vertices) ? vertices : 0;
}

/** The vertex in the middle of the edge between two corners. */
static size_t middle_of(const struct kr_solid *solid, const size_t *cell, int a, int b) {
    size_t k = 0;
    while (!(solid->edge[k][0] == a && solid->edge[k][1] == b) &&
           !(solid->edge[k][0] == b && solid->edge[k][1] == a))
        k++;
    return cell[solid->corners + k];
}

size_t kr_solid_face(size_t n, const size_t *cell, size_t face, size_t *vertex) {
    if (kr_solid_is_pieces(n))
        return kr_solid_face(4, cell + 4 * (face / 4), face % 4, vertex);
    const struct kr_solid *solid = kr_solid(n);
    const unsigned char *corner = solid->face[face];
    size_t corners = solid->face_corners[face], count = 0;
    for (size_t k = 0; k < corners; k++) {
        int next = corner[k + 1 < corners ? k + 1 : 0];
        vertex[count++] = cell[corner[k]];
        if (n > solid->corners)
            vertex[count++] = middle_of(solid, cell, corner[k], next);
    }
    size_t kept = 0;
    for (size_t k = 0; k < count; k++)
        if (!kept || vertex[k] != vertex[kept - 1])
            vertex[kept++] = vertex[k];
    while (kept > 1 && vertex[kept - 1] == vertex[0])
        kept--;
    return kept;
}

/** Whether two triangles have the same corners. Those of two tetrahedra of one polyhedron then look in
 *  opposite senses. */
static int is_same(const int64_t *a, const int64_t *b) {
    for (int k = 0; k < 3; k++)
        if (a[k] != b[0] && a[k] != b[1] && a[k] != b[2])
            return 0;
    return 1;
}

size_t kr_solid_outside(size_t n, const int64_t *cell, unsigned short *triangle) {
    size_t count = 0;
    for (size_t f = 0; f < n; f++) {
        unsigned short *side = triangle + 3 * count;
        for (int k = 0; k < 3; k++)
            side[k] = (unsigned short)(f / 4 * 4 + solids[0].face[f % 4][k]);
        const int64_t here[3] = {cell[side[0]], cell[side[1]], cell[side[2]]};
        size_t other = 0;
        for (; other < count; other++) {
            const unsigned short *t = triangle + 3 * other;
            if (is_same(here, (const int64_t[]){cell[t[0]], cell[t[1]], cell[t[2]]}))
                break;
        }
        if (other == count)
            count++;
        else /* it lies within */
            memmove(triangle + 3 * other, triangle + 3 * --count, 3 * sizeof *triangle);
    }
    return count;
}

/** Weights of corners and of the middles of edges in the middle of a face. */
static void shares(size_t n, double *corner, double *middle) {
    *corner = n == 6 ? -1.0 / 9 : n == 8 ? -1.0 / 4 : 1 / (double)n;
    *middle = n == 6 ? 4.0 / 9 : n == 8 ? 1.0 / 2 : 1 / (double)n;
}

void kr_solid_middle(size_t n, const double *point, double middle[3]) {
    double weight[2];
    shares(n, &weight[0], &weight[1]);
    for (int d = 0; d < 3; d++) {
        /* About the first vertex: the weights add up to 1, and nothing is lost far from 0. */
        double sum = 0;
        for (size_t k = 1; k < n; k++)
            sum += weight[k % 2] * (point[3 * k + (size_t)d] - point[d]);
        middle[d] = point[d] + sum;
    }
}

double kr_solid_radius(size_t n, const double *point, double vertices) {
    size_t number[KR_MOST_SOLID], vertex[KR_MOST_FACE];
    double face[3 * KR_MOST_FACE], middle[3];
    if (n <= 8 || kr_solid_is_pieces(n))
        return vertices; /* a mean of corners is never farther than they are */
    for (size_t k = 0; k < n; k++)
        number[k] = k;
    for (size_t f = 0; f < kr_solid(n)->n_faces; f++) {
        size_t corners = kr_solid_face(n, number, f, vertex);
        for (size_t k = 0; k < corners; k++)
            memcpy(face + 3 * k, point + 3 * vertex[k], 3 * sizeof *face);
        kr_solid_middle(corners, face, middle);
        vertices = fmax(vertices, hypot(hypot(middle[0], middle[1]), middle[2]));
    }
    return vertices;
}
