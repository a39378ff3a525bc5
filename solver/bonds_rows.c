/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Rows of a pair of slices. See bonds_rows.h.
 */
#include "bonds_rows.h"

#include "base/error.h"

#include <math.h>
#include <string.h>

/* Weight and length of the bond i-j; the same bits for j-i, unless the weights are one-sided. Two
 * nodes of the lattice have their kind's weight wherever they are: rounding decides nothing. */
static double weigh(const struct kr_builder *w, size_t i, size_t j, double *length) {
    const struct kr_bonds *b = w->bonds;
    double square = 0;
    for (int d = 0; d < b->dim; d++)
        square += (b->x[d][j] - b->x[d][i]) * (b->x[d][j] - b->x[d][i]);
    *length = sqrt(square);
    double phi = w->on_lattice[i] && w->on_lattice[j]
                     ? b->kinds[kr_builder_kind(w, i, j)].weight
                     : kr_weights_phi(w->weights, i, j, *length);
    return phi > 0 && w->nodes->pairing ? phi * kr_weights_pairing(w->weights, i, j) : phi;
}

/* In the order of offsets, then of kinds. */
static int compare_rows(const struct kr_row *row, int offset, int kind) {
    return row->offset != offset ? (row->offset > offset) - (row->offset < offset)
                                 : (row->kind > kind) - (row->kind < kind);
}

/* Merge the bond of lane `lane` with this offset and kind into the sorted rows, from place `at` on;
 * returns its place. */
static size_t merge_bond(struct kr_row *rows, size_t *n_rows, size_t at, int offset, int kind, int lane,
                         double length, double weight) {
    while (at < *n_rows && compare_rows(&rows[at], offset, kind) < 0)
        at++;
    if (at == *n_rows || compare_rows(&rows[at], offset, kind) > 0) {
        memmove(rows + at + 1, rows + at, (*n_rows - at) * sizeof *rows);
        rows[at] = (struct kr_row){.offset = offset, .kind = kind};
        (*n_rows)++;
    }
    rows[at].mask |= (uint8_t)(1u << lane);
    rows[at].inverse[lane] = 1 / length;
    rows[at].weight[lane] = weight;
    return at;
}

/* Whether all nodes of a slice and all that they see are lattice nodes, and no bond among them has
 * a surface factor other than the mean of its ends'. */
static int is_lattice(const struct kr_builder *w, size_t begin, size_t end, int near[][KR_ROWS_NEAR],
                      const size_t *n_near) {
    for (size_t i = begin; i < end; i++) {
        if (!w->on_lattice[i])
            return 0;
        for (size_t k = 0; k < n_near[i - begin]; k++)
            if (!w->on_lattice[near[i - begin][k]] ||
                (w->nodes->pairing &&
                 kr_weights_pairing(w->weights, i, (size_t)near[i - begin][k]) != 1))
                return 0;
    }
    return 1;
}

static size_t end_of(const struct kr_bonds *b, size_t slice) {
    return (slice + 1) * KR_LANES < b->n ? (slice + 1) * KR_LANES : b->n;
}

static void find_near(const struct kr_builder *w, size_t slice, struct kr_rows *s) {
    for (size_t i = slice * KR_LANES, lane = 0; i < end_of(w->bonds, slice); i++, lane++) {
        size_t n = kr_search_near(w->search, i, s->near[slice % 2][lane], KR_ROWS_NEAR);
        if (n > KR_ROWS_NEAR)
            kr_stop(KR_EXIT_INPUT,
                    "node %zu has more than %d neighbours; expected a horizon of a few spacings", i,
                    KR_ROWS_NEAR);
        s->n_near[slice % 2][lane] = n;
    }
}

static void make_rows(const struct kr_builder *w, size_t slice, struct kr_rows *s) {
    size_t *n_rows = &s->n_rows[slice % 2];
    *n_rows = 0;
    for (size_t i = slice * KR_LANES; i < end_of(w->bonds, slice); i++) {
        size_t at = 0, bonds = 0, lane = i % KR_LANES;
        for (size_t k = 0; k < s->n_near[slice % 2][lane]; k++) {
            size_t j = (size_t)s->near[slice % 2][lane][k];
            double length, weight = weigh(w, i, j, &length);
            if (weight <= 0)
                continue;
            at = merge_bond(s->row[slice % 2], n_rows, at, (int)((long)j - (long)i),
                            s->lattice ? kr_builder_kind(w, i, j) : 0, (int)lane, length, weight);
            bonds++;
        }
        if (!bonds)
            kr_stop(KR_EXIT_INPUT,
                    "node %zu at (%g, %g) m has no neighbour within the horizon %g m; expected a "
                    "horizon of a few spacings, or remove the node",
                    i, w->bonds->x[0][i], w->bonds->x[1][i], w->bonds->material.horizon);
    }
}

/* Give the other slice of a pair a row without bonds where it lacks one. */
static void insert_row(struct kr_row *rows, size_t *n_rows, size_t at, const struct kr_row *like) {
    memmove(rows + at + 1, rows + at, (*n_rows - at) * sizeof *rows);
    rows[at] = (struct kr_row){.offset = like->offset, .kind = like->kind};
    (*n_rows)++;
}

static void join_rows(struct kr_rows *s) {
    struct kr_row *a = s->row[0], *b = s->row[1];
    for (size_t at = 0; at < s->n_rows[0] || at < s->n_rows[1]; at++) {
        int order = at >= s->n_rows[0]   ? 1
                    : at >= s->n_rows[1] ? -1
                                         : compare_rows(&a[at], b[at].offset, b[at].kind);
        if (order < 0)
            insert_row(b, &s->n_rows[1], at, &a[at]);
        else if (order > 0)
            insert_row(a, &s->n_rows[0], at, &b[at]);
    }
}

void kr_rows_make(const struct kr_builder *w, size_t pair, struct kr_rows *s) {
    const size_t first = 2 * pair, n = w->bonds->n_slices;
    s->lattice = first + 1 < n;
    for (size_t slice = first; slice < first + 2 && slice < n; slice++) {
        find_near(w, slice, s);
        s->lattice = s->lattice && is_lattice(w, slice * KR_LANES, end_of(w->bonds, slice),
                                              s->near[slice % 2], s->n_near[slice % 2]);
    }
    for (size_t slice = first; slice < first + 2 && slice < n; slice++)
        make_rows(w, slice, s);
    if (s->lattice)
        join_rows(s);
}
