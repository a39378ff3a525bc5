/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Building the families in the layout of bonds.h.
 *
 * Two passes over the pairs of slices, each parallel: the first counts rows (bonds_rows.h), the second fills
 * them, so no list of all bonds ever stands in memory.
 */
#include "bonds_rows.h"

#include "base/memory.h"

#include <math.h>
#include <omp.h>

/* How much before the critical stretch a slice takes the exact loop: what rounding may do to e. */
static const double EARLY = 1e-12, EARLY_MIXED = 1e-5;

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

/* A general row stores weights if any of its bonds is only partly inside the horizon, or carries
 * what its surface factor differs from the mean of its ends'. */
static int is_rim(const struct kr_row *row) {
    for (int lane = 0; lane < KR_LANES; lane++)
        if (row->mask >> lane & 1 && (float)row->weight[lane] != 1)
            return 1;
    return 0;
}

static void count_slice(struct kr_bonds *b, size_t slice, const struct kr_rows *s) {
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
static void store_general_row(struct kr_bonds *b, const struct kr_row *row, int rim, size_t to,
                              size_t tuple, size_t rim_tuple) {
    b->kind[to] = (uint16_t)rim;
    /* Lanes without a bond are masked, but must not make NaNs: any length will do. */
    for (int lane = 0; lane < KR_LANES; lane++)
        b->inverse[KR_LANES * tuple + (size_t)lane] =
            (float)(row->mask >> lane & 1 ? row->inverse[lane] : 1 / b->material.horizon);
    for (int lane = 0; lane < KR_LANES && rim; lane++)
        b->weight[KR_LANES * rim_tuple + (size_t)lane] = (float)row->weight[lane];
}

static void store_row(struct kr_bonds *b, const struct kr_row *row, size_t slice, size_t to) {
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
static void fill_slice(struct kr_bonds *b, size_t slice, const struct kr_rows *s) {
    const struct kr_row *row = s->row[slice % 2];
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
                           void (*work)(struct kr_bonds *, size_t, const struct kr_rows *)) {
    const size_t n = w->bonds->n_slices;
#pragma omp parallel
    {
        struct kr_rows *s = KR_NEW(struct kr_rows, 1);
#pragma omp for schedule(dynamic, 128)
        for (size_t pair = 0; pair < (n + 1) / 2; pair++) {
            kr_rows_make(w, pair, s);
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

