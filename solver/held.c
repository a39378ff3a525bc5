/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Pieces and supports. The rigid motions of a piece, m of them (3 in the plane, 6 in space), have
 * at each prescribed component a row of coefficients r; the sum of r r^T has a direction without stiffness
 * where a motion is left free. Elimination in the order translations, rotations names it.
 */
#include "held.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

enum { MOTIONS = 6 };

static int32_t root_of(int32_t *parent, int32_t i) {
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

/* piece[i]: the lowest node of i's piece. Owned by the caller. */
static int32_t *pieces_of(const struct kr_bonds *b) {
    int32_t *parent = KR_NEW(int32_t, b->n);
    for (size_t i = 0; i < b->n; i++)
        parent[i] = (int32_t)i;
    for (size_t slice = 0; slice < b->n_slices; slice++) {
        struct kr_bond_walk walk = kr_bonds_walk(b, slice);
        struct kr_bond bond;
        while (kr_bonds_next(b, &walk, &bond)) {
            int32_t i = root_of(parent, (int32_t)bond.i), j = root_of(parent, (int32_t)bond.j);
            parent[i > j ? i : j] = i > j ? j : i;
        }
    }
    for (size_t i = 0; i < b->n; i++)
        parent[i] = root_of(parent, (int32_t)i);
    return parent;
}

/* What the rigid motions move component d of a node by: translations, then turns about axes along z, x
 * and y through the origin `about`, lengths in units of `size`. */
static int row_of(const struct kr_bonds *b, size_t i, int d, const double about[3], double size,
                  double row[MOTIONS]) {
    double x[3] = {0};
    for (int e = 0; e < b->dim; e++)
        x[e] = (b->x[e][i] - about[e]) / size;
    memset(row, 0, MOTIONS * sizeof *row);
    row[d] = 1;
    if (b->dim == 2) {
        row[2] = d == 0 ? -x[1] : x[0];
        return 3;
    }
    row[3] = d == 0 ? -x[1] : d == 1 ? x[0] : 0;
    row[4] = d == 1 ? -x[2] : d == 2 ? x[1] : 0;
    row[5] = d == 2 ? -x[0] : d == 0 ? x[2] : 0;
    return 6;
}

/* Place of the first pivot that is rounding; -1: none. */
static int loose_pivot(int m, double a[MOTIONS][MOTIONS]) {
    double scale[MOTIONS];
    for (int k = 0; k < m; k++)
        scale[k] = a[k][k];
    for (int k = 0; k < m; k++) {
        if (!(a[k][k] > 1e-10 * fmax(scale[k], 1e-6 * scale[0])))
            return k;
        for (int i = k + 1; i < m; i++)
            for (int j = k + 1; j < m; j++)
                a[i][j] -= a[i][k] * a[k][j] / a[k][k];
    }
    return -1;
}

const char *kr_held_free_motion(const struct kr_bonds *b, const unsigned char *fixed,
                                size_t *node) {
    static const char *const in_plane[] = {"moving along x", "moving along y", "turning in its plane"};
    static const char *const in_space[] = {"moving along x",
                                           "moving along y",
                                           "moving along z",
                                           "turning about an axis along z",
                                           "turning about an axis along x",
                                           "turning about an axis along y"};
    int32_t *piece = pieces_of(b);
    double(*gram)[MOTIONS][MOTIONS] = kr_alloc(b->n, sizeof *gram);
    size_t *count = KR_NEW(size_t, b->n);
    const char *found = NULL;
    int m = b->dim == 2 ? 3 : 6;
    for (size_t i = 0; i < b->n; i++) {
        const double about[3] = {b->x[0][piece[i]], b->x[1][piece[i]],
                                 b->dim == 3 ? b->x[2][piece[i]] : 0};
        count[piece[i]]++;
        for (int d = 0; d < b->dim; d++) {
            double row[MOTIONS];
            if (!(fixed[i] >> d & 1))
                continue;
            row_of(b, i, d, about, b->material.horizon, row);
            for (int k = 0; k < m; k++)
                for (int l = 0; l < m; l++)
                    gram[piece[i]][k][l] += row[k] * row[l];
        }
    }
    for (size_t i = 0; i < b->n && !found; i++) {
        int loose = piece[i] == (int32_t)i && count[i] > 1 ? loose_pivot(m, gram[i]) : -1;
        *node = i;
        if (loose >= 0)
            found = b->dim == 2 ? in_plane[loose] : in_space[loose];
    }
    kr_free(gram);
    kr_free(count);
    kr_free(piece);
    return found;
}

/* Whether some piece holds nodes of both sets, or they share nodes: both are then held together. */
static int is_joined(const int32_t *piece, const struct kr_set *a, const struct kr_set *b,
                     unsigned char *mark) {
    int joined = 0;
    for (size_t m = 0; m < a->count; m++)
        mark[piece[a->node[m]]] = 1;
    for (size_t m = 0; m < b->count && !joined; m++)
        joined = mark[piece[b->node[m]]];
    for (size_t m = 0; m < a->count; m++)
        mark[piece[a->node[m]]] = 0;
    return joined;
}

static int share_nodes(const struct kr_set *a, const struct kr_set *b, unsigned char *mark) {
    int shared = 0;
    for (size_t m = 0; m < a->count; m++)
        mark[a->node[m]] = 1;
    for (size_t m = 0; m < b->count && !shared; m++)
        shared = mark[b->node[m]];
    for (size_t m = 0; m < a->count; m++)
        mark[a->node[m]] = 0;
    return shared;
}

/* Whether every node of the set lies in a piece that some support holds. */
static int is_supported(const int32_t *piece, const struct kr_boundary *boundary,
                        const struct kr_set *set, unsigned char *mark) {
    int supported = 1;
    for (int value = 1; value >= 0; value--) {
        for (size_t k = 0; k < kr_boundary_count(boundary); k++) {
            const struct kr_set *support = kr_boundary_nodes(boundary, k);
            for (size_t m = 0; m < support->count && kr_boundary_moves(boundary, k); m++)
                mark[piece[support->node[m]]] = (unsigned char)value;
        }
        for (size_t m = 0; m < set->count && value; m++)
            supported &= mark[piece[set->node[m]]];
    }
    return supported;
}

int kr_held_apart(const struct kr_bonds *b, const struct kr_boundary *boundary) {
    int32_t *piece = pieces_of(b);
    unsigned char *mark = KR_NEW(unsigned char, b->n);
    int apart = 0;
    for (size_t k = 0; k < kr_boundary_count(boundary) && !apart; k++) {
        const struct kr_set *set = kr_boundary_nodes(boundary, k);
        if (!kr_boundary_moves(boundary, k))
            apart = !is_supported(piece, boundary, set, mark);
        for (size_t l = 0; l < k && kr_boundary_moves(boundary, k) && !apart; l++) {
            const struct kr_set *other = kr_boundary_nodes(boundary, l);
            apart = kr_boundary_moves(boundary, l) && !share_nodes(set, other, mark) &&
                    !is_joined(piece, set, other, mark);
        }
    }
    kr_free(mark);
    kr_free(piece);
    return apart;
}
