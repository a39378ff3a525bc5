/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Clipping convex polyhedra.
 */
#include "poly.h"

#include "base/error.h"

#include <math.h>
#include <string.h>

/* A function so near zero is zero there: what cutting the same edge twice leaves. */
static const double ON = 1e-9;

void kr_poly_begin(struct kr_poly *poly, int is_mirrored, const int label[4]) {
    static const unsigned char corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    poly->n = poly->n_faces = 4;
    memset(poly->weight, 0, 4 * sizeof *poly->weight);
    for (size_t k = 0; k < 4; k++) {
        poly->weight[k][k] = 1;
        poly->face[k].label = label[k];
        poly->face[k].n = 3;
        for (size_t c = 0; c < 3; c++)
            poly->face[k].corner[c] = corners[k][is_mirrored ? 2 - c : c];
    }
}

/** A polyhedron being clipped. */
struct clipping {
    const struct kr_poly *from;
    struct kr_poly *to;
    double value[KR_POLY_VERTICES];
    unsigned char moved[KR_POLY_VERTICES];            /* new number of an old vertex plus 1 */
    unsigned char cut[KR_POLY_VERTICES][3];           /* old ends of an edge, new vertex */
    size_t n_cuts;
    unsigned char is_on[KR_POLY_VERTICES];            /* (new vertices) whether in the plane */
    unsigned char after[KR_POLY_VERTICES];            /* on the new face: the next plus 1 */
};

static unsigned char keep(struct clipping *c, size_t v) {
    if (!c->moved[v]) {
        memcpy(c->to->weight[c->to->n], c->from->weight[v], sizeof c->from->weight[v]);
        c->is_on[c->to->n] = c->value[v] == 0;
        c->moved[v] = (unsigned char)++c->to->n;
    }
    return (unsigned char)(c->moved[v] - 1);
}

/** The vertex on an edge that the plane cuts, from its positive end so that all agree. */
static unsigned char cut(struct clipping *c, size_t v, size_t w) {
    size_t p = c->value[v] > 0 ? v : w, q = p == v ? w : v;
    for (size_t k = 0; k < c->n_cuts; k++)
        if (c->cut[k][0] == p && c->cut[k][1] == q)
            return c->cut[k][2];
    kr_assert(c->to->n < KR_POLY_VERTICES);
    double t = c->value[p] / (c->value[p] - c->value[q]);
    for (int k = 0; k < 4; k++)
        c->to->weight[c->to->n][k] =
            c->from->weight[p][k] + t * (c->from->weight[q][k] - c->from->weight[p][k]);
    c->is_on[c->to->n] = 1;
    c->cut[c->n_cuts][0] = (unsigned char)p;
    c->cut[c->n_cuts][1] = (unsigned char)q;
    return c->cut[c->n_cuts++][2] = (unsigned char)c->to->n++;
}

static void clip_face(struct clipping *c, const struct kr_poly_face *old) {
    struct kr_poly_face *new = &c->to->face[c->to->n_faces];
    int has_positive = 0;
    for (size_t k = 0; k < old->n; k++)
        has_positive |= c->value[old->corner[k]] > 0;
    if (!has_positive)
        return;
    new->label = old->label;
    new->n = 0;
    for (size_t k = 0; k < old->n; k++) {
        size_t v = old->corner[k], w = old->corner[k + 1 < old->n ? k + 1 : 0];
        kr_assert(new->n + 2 < KR_POLY_CORNERS);
        if (c->value[v] >= 0)
            new->corner[new->n++] = keep(c, v);
        if ((c->value[v] > 0 && c->value[w] < 0) || (c->value[v] < 0 && c->value[w] > 0))
            new->corner[new->n++] = cut(c, v, w);
    }
    for (size_t k = 0; k < new->n; k++) {
        unsigned char u = new->corner[k], v = new->corner[k + 1 < new->n ? k + 1 : 0];
        if (c->is_on[u] && c->is_on[v])
            c->after[v] = (unsigned char)(u + 1);
    }
    c->to->n_faces++;
}

/** The face in the plane, along the edges that the others have there. */
static void close_up(struct clipping *c, int label) {
    struct kr_poly_face *new = &c->to->face[c->to->n_faces];
    size_t start = 0, v;
    while (start < c->to->n && !c->after[start])
        start++;
    if (start == c->to->n)
        return;
    new->label = label;
    new->n = 0;
    v = start;
    do {
        kr_assert(new->n < KR_POLY_CORNERS && c->after[v]);
        new->corner[new->n++] = (unsigned char)v;
        v = c->after[v] - 1u;
    } while (v != start);
    c->to->n_faces += new->n > 2;
}

void kr_poly_clip(struct kr_poly *poly, const double value[4], int label) {
    struct clipping c = {.n_cuts = 0};
    struct kr_poly old;
    int has_positive = 0, has_negative = 0;
    for (size_t v = 0; v < poly->n; v++) {
        const double *w = poly->weight[v];
        double sum = w[0] * value[0] + w[1] * value[1] + w[2] * value[2] + w[3] * value[3];
        c.value[v] = fabs(sum) < ON ? 0 : sum;
        has_positive |= c.value[v] > 0;
        has_negative |= c.value[v] < 0;
    }
    if (!has_positive) {
        poly->n = poly->n_faces = 0;
        return;
    }
    if (!has_negative) {
        for (size_t f = 0; f < poly->n_faces; f++) {
            size_t zeros = 0;
            for (size_t k = 0; k < poly->face[f].n; k++)
                zeros += c.value[poly->face[f].corner[k]] == 0;
            if (zeros == poly->face[f].n)
                poly->face[f].label = label;
        }
        return;
    }
    kr_assert(poly->n_faces < KR_POLY_FACES);
    old = *poly;
    c.from = &old;
    c.to = poly;
    poly->n = poly->n_faces = 0;
    for (size_t f = 0; f < old.n_faces; f++)
        clip_face(&c, &old.face[f]);
    close_up(&c, label);
}

void kr_poly_cut(const struct kr_poly *poly, const size_t *number, struct kr_poly_pieces *pieces) {
    unsigned char first = 0;
    pieces->n_tetrahedra = pieces->n_triangles = 0;
    for (unsigned char v = 1; v < poly->n; v++)
        first = number[v] < number[first] ? v : first;
    for (size_t f = 0; f < poly->n_faces; f++) {
        const struct kr_poly_face *face = &poly->face[f];
        size_t pivot = 0;
        for (size_t k = 1; k < face->n; k++)
            pivot = number[face->corner[k]] < number[face->corner[pivot]] ? k : pivot;
        int has_first = face->corner[pivot] == first;
        for (size_t k = 1; k + 1 < face->n; k++) {
            const unsigned char p[3] = {face->corner[pivot], face->corner[(pivot + k) % face->n],
                                        face->corner[(pivot + k + 1) % face->n]};
            pieces->label[pieces->n_triangles] = face->label;
            memcpy(pieces->triangle[pieces->n_triangles++], p, sizeof p);
            if (!has_first)
                memcpy(pieces->tetrahedron[pieces->n_tetrahedra++],
                       (const unsigned char[4]){p[0], p[2], p[1], first}, 4);
        }
    }
}

/* From corner 0 to corner 7 along the axes in the order a, b, c: the first face lies in the high side
 * of a, the last in the low side of c. */
#define KUHN(a, b, c, mirrored)                                                                    \
    {{0, 1 << (a), 1 << (a) | 1 << (b), 7}, 2 * (a) + 1, 2 * (c), mirrored}
const struct kr_kuhn kr_kuhn[6] = {KUHN(0, 1, 2, 0), KUHN(1, 2, 0, 0), KUHN(2, 0, 1, 0),
                                   KUHN(0, 2, 1, 1), KUHN(2, 1, 0, 1), KUHN(1, 0, 2, 1)};
