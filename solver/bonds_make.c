/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Building the families in the layout of bonds.h.
 *
 * Two passes over the pairs of slices, each parallel: the first counts rows, the second fills them. A
 * slice's rows are merged from the sorted families of its eight nodes, so no list of all bonds ever
 * stands in memory.
 */
#include "bonds_make.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <omp.h>
#include <string.h>

enum { MOST_NEAR = 4096, MOST_ROWS = MOST_NEAR * KR_LANES };

/* How much before the critical stretch a slice takes the exact loop: what rounding may do to e. */
static const double EARLY = 1e-12, EARLY_MIXED = 1e-5;

/* A row while it is being built. */
struct row {
    int offset, kind;
    uint8_t mask;
    double inverse[KR_LANES], weight[KR_LANES];
};

static void allocate_nodes(struct kr_bonds *b, const struct kr_nodes *nodes) {
    for (int d = 0; d < b->dim; d++)
        b->x[d] = kr_bonds_padded(b->n);
    b->volume = kr_bonds_padded(b->n);
    b->factor = kr_bonds_padded(b->n);
    b->family_volume = KR_NEW(double, b->n);
    b->lost_volume = KR_NEW(double, b->n);
    b->no_fail = KR_NEW(unsigned char, b->n);
    for (size_t i = 0; i < b->n; i++) {
        for (int d = 0; d < b->dim; d++)
            b->x[d][i] = nodes->position[i * (size_t)b->dim + (size_t)d];
        b->volume[i] = nodes->volume[i];
        b->factor[i] = nodes->factor[i];
    }
    b->lattice = KR_NEW(unsigned char, b->n_slices);
    b->twin = KR_NEW(unsigned char, (b->n_slices + 1) / 2);
    b->first = KR_NEW(size_t, b->n_slices + 1);
    b->list = KR_NEW(size_t, b->n_slices);
    b->first_inverse = KR_NEW(size_t, b->n_slices + 1);
    b->first_weight = KR_NEW(size_t, b->n_slices + 1);
}

/* ---- slices ---- */

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
static int compare_rows(const struct row *row, int offset, int kind) {
    return row->offset != offset ? (row->offset > offset) - (row->offset < offset)
                                 : (row->kind > kind) - (row->kind < kind);
}

/* Merge the bond of lane `lane` with this offset and kind into the sorted rows, from place `at` on;
 * returns its place. */
static size_t merge_bond(struct row *rows, size_t *n_rows, size_t at, int offset, int kind, int lane,
                         double length, double weight) {
    while (at < *n_rows && compare_rows(&rows[at], offset, kind) < 0)
        at++;
    if (at == *n_rows || compare_rows(&rows[at], offset, kind) > 0) {
        memmove(rows + at + 1, rows + at, (*n_rows - at) * sizeof *rows);
        rows[at] = (struct row){.offset = offset, .kind = kind};
        (*n_rows)++;
    }
    rows[at].mask |= (uint8_t)(1u << lane);
    rows[at].inverse[lane] = 1 / length;
    rows[at].weight[lane] = weight;
    return at;
}

/* Whether all nodes of a slice and all that they see are lattice nodes, and no bond among them has
 * a surface factor other than the mean of its ends'. */
static int is_lattice(const struct kr_builder *w, size_t begin, size_t end, int near[][MOST_NEAR],
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

/* Room of one thread, for the two slices of a pair. */
struct scratch {
    int near[2][KR_LANES][MOST_NEAR];
    size_t n_near[2][KR_LANES];
    struct row row[2][MOST_ROWS];
    size_t n_rows[2];
    int lattice;
};

static size_t end_of(const struct kr_bonds *b, size_t slice) {
    return (slice + 1) * KR_LANES < b->n ? (slice + 1) * KR_LANES : b->n;
}

static void find_near(const struct kr_builder *w, size_t slice, struct scratch *s) {
    for (size_t i = slice * KR_LANES, lane = 0; i < end_of(w->bonds, slice); i++, lane++) {
        size_t n = kr_search_near(w->search, i, s->near[slice % 2][lane], MOST_NEAR);
        if (n > MOST_NEAR)
            kr_stop(KR_EXIT_INPUT,
                    "node %zu has more than %d neighbours; expected a horizon of a few spacings", i,
                    MOST_NEAR);
        s->n_near[slice % 2][lane] = n;
    }
}

static void make_rows(const struct kr_builder *w, size_t slice, struct scratch *s) {
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
static void insert_row(struct row *rows, size_t *n_rows, size_t at, const struct row *like) {
    memmove(rows + at + 1, rows + at, (*n_rows - at) * sizeof *rows);
    rows[at] = (struct row){.offset = like->offset, .kind = like->kind};
    (*n_rows)++;
}

static void join_rows(struct scratch *s) {
    struct row *a = s->row[0], *b = s->row[1];
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

/* Find the rows of a pair of slices, of the lattice if both may be. */
static void make_pair(const struct kr_builder *w, size_t pair, struct scratch *s) {
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

/* A general row stores weights if any of its bonds is only partly inside the horizon, or carries
 * what its surface factor differs from the mean of its ends'. */
static int is_rim(const struct row *row) {
    for (int lane = 0; lane < KR_LANES; lane++)
        if (row->mask >> lane & 1 && (float)row->weight[lane] != 1)
            return 1;
    return 0;
}

static void count_slice(struct kr_bonds *b, size_t slice, const struct scratch *s) {
    const size_t n_rows = s->n_rows[slice % 2];
    size_t rims = 0;
    for (size_t r = 0; r < n_rows && !s->lattice; r++)
        rims += (size_t)is_rim(&s->row[slice % 2][r]);
    b->lattice[slice] = (unsigned char)s->lattice;
    b->first[slice + 1] = n_rows;
    b->first_inverse[slice + 1] = s->lattice ? 0 : n_rows;
    b->first_weight[slice + 1] = rims;
}

/* Row `to` of the bonds; `tuple` and `rim_tuple` are the places of its lengths and weights. */
static void store_general_row(struct kr_bonds *b, const struct row *row, int rim, size_t to,
                              size_t tuple, size_t rim_tuple) {
    b->kind[to] = (uint16_t)rim;
    /* Lanes without a bond are masked, but must not make NaNs: any length will do. */
    for (int lane = 0; lane < KR_LANES; lane++)
        b->inverse[KR_LANES * tuple + (size_t)lane] =
            (float)(row->mask >> lane & 1 ? row->inverse[lane] : 1 / b->material.horizon);
    for (int lane = 0; lane < KR_LANES && rim; lane++)
        b->weight[KR_LANES * rim_tuple + (size_t)lane] = (float)row->weight[lane];
}

static void store_row(struct kr_bonds *b, const struct row *row, size_t slice, size_t to) {
    b->offset[to] = row->offset;
    b->living[to] = row->mask;
    for (int lane = 0; lane < KR_LANES; lane++)
        if (row->mask >> lane & 1) {
            size_t i = slice * KR_LANES + (size_t)lane;
            size_t j = (size_t)((long)i + row->offset);
            b->family_volume[i] += (float)row->weight[lane] * b->volume[j];
        }
}

/* General slices: first the rows without weights, then those with. */
static void fill_slice(struct kr_bonds *b, size_t slice, const struct scratch *s) {
    const struct row *row = s->row[slice % 2];
    const size_t n_rows = s->n_rows[slice % 2];
    size_t to = b->first[slice], tuple = b->first_inverse[slice], rim_tuple = b->first_weight[slice];
    for (size_t r = 0; r < n_rows && s->lattice; r++) {
        b->kind[to] = (uint16_t)row[r].kind;
        store_row(b, &row[r], slice, to++);
    }
    for (int rim = 0; rim <= 1 && !s->lattice; rim++)
        for (size_t r = 0; r < n_rows; r++)
            if (is_rim(&row[r]) == rim) {
                store_general_row(b, &row[r], rim, to, tuple++, rim_tuple);
                store_row(b, &row[r], slice, to++);
                rim_tuple += (size_t)rim;
            }
}

static void for_all_slices(const struct kr_builder *w,
                           void (*work)(struct kr_bonds *, size_t, const struct scratch *)) {
    const size_t n = w->bonds->n_slices;
#pragma omp parallel
    {
        struct scratch *s = KR_NEW(struct scratch, 1);
#pragma omp for schedule(dynamic, 128)
        for (size_t pair = 0; pair < (n + 1) / 2; pair++) {
            make_pair(w, pair, s);
            for (size_t slice = 2 * pair; slice < 2 * pair + 2 && slice < n; slice++)
                work(w->bonds, slice, s);
        }
        kr_free(s);
    }
}

/* ---- all of it ---- */

static void sum_up(size_t *first, size_t n) {
    for (size_t k = 0; k < n; k++)
        first[k + 1] += first[k];
}

static void allocate_rows(struct kr_bonds *b) {
    sum_up(b->first, b->n_slices);
    sum_up(b->first_inverse, b->n_slices);
    sum_up(b->first_weight, b->n_slices);
    b->n_rows = b->first[b->n_slices];
    b->offset = KR_NEW(int32_t, b->n_rows);
    b->kind = KR_NEW(uint16_t, b->n_rows);
    b->living = KR_NEW(uint8_t, b->n_rows);
    b->inverse = KR_NEW(float, KR_LANES *b->first_inverse[b->n_slices]);
    b->weight = KR_NEW(float, KR_LANES *b->first_weight[b->n_slices]);
}

/* Time of a slice: rows of general ones take over twice as long (make bench: general, block). */
static size_t cost_of(const struct kr_bonds *b, size_t slice) {
    return (b->first[slice + 1] - b->first[slice]) * (b->lattice[slice] ? 2 : 5);
}

/* Cut the slices into one block a thread, of about equal costs; pairs stay together. */
static void make_blocks(struct kr_bonds *b) {
    size_t all = 0, done = 0, slice = 0;
    for (size_t s = 0; s < b->n_slices; s++)
        all += cost_of(b, s);
    b->n_blocks = omp_get_max_threads();
    b->block = KR_NEW(size_t, (size_t)b->n_blocks + 1);
    for (int k = 0; k < b->n_blocks; k++) {
        for (; slice + 2 <= b->n_slices && done < all / (size_t)b->n_blocks * (size_t)k; slice += 2)
            done += cost_of(b, slice) + cost_of(b, slice + 1);
        b->block[k] = slice;
    }
    b->block[b->n_blocks] = b->n_slices;
}

static void count_living(struct kr_bonds *b) {
    b->count = 0;
    for (size_t r = 0; r < b->n_rows; r++)
        b->count += (size_t)__builtin_popcount(b->living[r]);
}

struct kr_bonds *kr_bonds_create(const struct kr_nodes *nodes, const struct kr_material *material,
                                 int partial_volume) {
    struct kr_bonds *b = KR_NEW(struct kr_bonds, 1);
    *b = (struct kr_bonds){.dim = nodes->dim, .n = nodes->n, .material = *material};
    b->n_slices = (nodes->n + KR_LANES - 1) / KR_LANES;
    allocate_nodes(b, nodes);
    b->fit = kr_fit_make(material, KR_FIT_DOUBLE, EARLY);
    b->fit_mixed = kr_fit_make(material, KR_FIT_MIXED, EARLY_MIXED);

    struct kr_builder w = {.nodes = nodes, .bonds = b};
    w.weights = kr_weights_create(nodes, material->horizon, partial_volume);
    double reach = w.weights->reach;
    w.search = kr_search_create(nodes->dim, nodes->n, nodes->position, reach);
    kr_builder_find_lattice(&w);
    w.reach_in_cells = (int)ceil(reach / w.size_of_lattice);
    kr_builder_make_kinds(&w);
    kr_weights_keep(w.weights, w.search, w.on_lattice);

    for_all_slices(&w, count_slice);
    allocate_rows(b);
    for_all_slices(&w, fill_slice);

    kr_search_free(w.search);
    kr_weights_free(w.weights);
    kr_free(w.on_lattice);
    kr_free(w.place);
    kr_bonds_share_lists(b);
    count_living(b);
    kr_bonds_find_twins(b);
    make_blocks(b);
    return b;
}

