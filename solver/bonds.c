/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Building the families in the layout of bonds.h, and what is asked of single bonds.
 *
 * Two passes over the slices, each parallel: the first counts rows, the second fills them. A slice's
 * rows are merged from the sorted families of its eight nodes, so no list of all bonds ever stands
 * in memory.
 */
#include "bonds.h"

#include "base/error.h"
#include "base/memory.h"
#include "search.h"
#include "weight.h"

#include <math.h>
#include <omp.h>
#include <string.h>

enum { MOST_NEAR = 4096, MOST_ROWS = MOST_NEAR * KR_LANES };

/* A row while it is being built. */
struct row {
    int offset, kind;
    uint8_t mask;
    double inverse[KR_LANES], weight[KR_LANES];
};

/* What building needs to know; one for all threads, read only. */
struct builder {
    const struct kr_nodes *nodes;
    struct kr_bonds *bonds;
    struct kr_search *search;
    struct kr_weights *weights;
    double size_of_lattice, origin[3], cell_volume;
    int reach_in_cells;
    unsigned char *on_lattice; /* (n) */
    int32_t *place; /* (n x dim) column, row, layer of those on the lattice */
};

/* ---- arrays ---- */

double *kr_bonds_padded(size_t n) {
    size_t whole = (n + KR_LANES - 1) / KR_LANES * KR_LANES;
    return KR_NEW(double, whole + 2 * KR_LANES) + KR_LANES;
}

void kr_bonds_padded_free(double *array) {
    if (array)
        kr_free(array - KR_LANES);
}

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
    b->first_inverse = KR_NEW(size_t, b->n_slices + 1);
    b->first_weight = KR_NEW(size_t, b->n_slices + 1);
}

void kr_bonds_free(struct kr_bonds *b) {
    for (int d = 0; d < b->dim; d++)
        kr_bonds_padded_free(b->x[d]);
    kr_bonds_padded_free(b->volume);
    kr_bonds_padded_free(b->factor);
    kr_free(b->family_volume);
    kr_free(b->lost_volume);
    kr_free(b->no_fail);
    kr_free(b->lattice);
    kr_free(b->twin);
    kr_free(b->first);
    kr_free(b->first_inverse);
    kr_free(b->first_weight);
    kr_free(b->offset);
    kr_free(b->kind);
    kr_free(b->living);
    kr_free(b->inverse);
    kr_free(b->weight);
    kr_free(b->kinds);
    kr_free(b->block);
    kr_free(b);
}

/* ---- the lattice ---- */

/* Which nodes stand on the lattice that the first node of just one cell's volume stands on. Where
 * there is none, nothing is lost but speed. */
static void find_lattice(struct builder *w) {
    const struct kr_nodes *nodes = w->nodes;
    size_t dim = (size_t)nodes->dim, origin = nodes->n;
    const double same = 1e-9;
    w->size_of_lattice = nodes->spacing;
    w->cell_volume = pow(nodes->spacing, nodes->dim);
    w->on_lattice = KR_NEW(unsigned char, nodes->n);
    w->place = KR_NEW(int32_t, nodes->n *dim);
    for (size_t i = 0; i < nodes->n; i++) {
        if (fabs(nodes->volume[i] / w->cell_volume - 1) > same)
            continue;
        if (origin == nodes->n)
            origin = i;
        int fits = 1;
        for (size_t d = 0; d < dim; d++) {
            double cells = (nodes->position[i * dim + d] - nodes->position[origin * dim + d]) /
                           nodes->spacing;
            fits &= fabs(cells - round(cells)) < same * (1 + fabs(cells)) && fabs(cells) < 1e9;
            w->place[i * dim + d] = fits ? (int32_t)lround(cells) : 0;
        }
        fits = fits && kr_weights_is_square(w->weights, i, nodes->spacing);
        w->on_lattice[i] = (unsigned char)fits;
    }
}

static int side_of(const struct builder *w) {
    return 2 * w->reach_in_cells + 1;
}

/* Table place of the bond from lattice node i to lattice node j. */
static int kind_of(const struct builder *w, size_t i, size_t j) {
    int place = 0;
    size_t dim = (size_t)w->nodes->dim;
    for (size_t d = dim; d-- > 0;)
        place = place * side_of(w) + w->place[j * dim + d] - w->place[i * dim + d] +
                w->reach_in_cells;
    return place;
}

static void make_kinds(struct builder *w) {
    struct kr_bonds *b = w->bonds;
    const struct kr_material *m = &b->material;
    int side = side_of(w);
    b->n_kinds = (size_t)(side * side * (b->dim == 3 ? side : 1));
    kr_assert(b->n_kinds <= UINT16_MAX);
    b->kinds = KR_NEW(struct kr_bond_kind, b->n_kinds);
    for (size_t k = 0; k < b->n_kinds; k++) {
        struct kr_bond_kind *kind = &b->kinds[k];
        struct kr_bond_geometry *g = &kind->geometry;
        size_t rest = k;
        double square = 0;
        for (int d = 0; d < b->dim; d++) {
            g->xi[d] = ((int)(rest % (size_t)side) - w->reach_in_cells) * w->size_of_lattice;
            square += g->xi[d] * g->xi[d];
            rest /= (size_t)side;
        }
        if (square == 0)
            continue;
        double inverse = (float)(1 / sqrt(square));
        kind->length = 1 / inverse;
        kind->weight = (float)kr_weight_lattice(w->weights->partial_volume, b->dim, g->xi,
                                                m->horizon, w->size_of_lattice);
        double share = kr_material_micromodulus(m, kind->length) / m->micromodulus;
        g->inverse_square = inverse * inverse;
        g->pull = share * kind->weight * w->cell_volume * inverse;
        g->store = 0.5 * share * kind->weight * w->cell_volume / inverse;
        kind->rounded = (struct kr_bond_geometry32){
            {(float)g->xi[0], (float)g->xi[1], (float)g->xi[2]},
            (float)g->inverse_square, (float)g->pull, (float)g->store};
    }
}

/* ---- slices ---- */

/* Weight and length of the bond i-j; the same bits for j-i, unless the weights are one-sided. Two
 * nodes of the lattice have their kind's weight wherever they are: rounding decides nothing. */
static double weigh(const struct builder *w, size_t i, size_t j, double *length) {
    const struct kr_bonds *b = w->bonds;
    double square = 0;
    for (int d = 0; d < b->dim; d++)
        square += (b->x[d][j] - b->x[d][i]) * (b->x[d][j] - b->x[d][i]);
    *length = sqrt(square);
    double phi = w->on_lattice[i] && w->on_lattice[j]
                     ? b->kinds[kind_of(w, i, j)].weight
                     : kr_weights_phi(w->weights, i, j, *length);
    return phi > 0 && w->nodes->pairing ? phi * kr_weights_pairing(w->weights, i, j) : phi;
}

/* Merge the bond of lane `lane` with this offset and kind into the sorted rows, from place `at` on;
 * returns its place. */
static size_t merge_bond(struct row *rows, size_t *n_rows, size_t at, int offset, int kind, int lane,
                         double length, double weight) {
    while (at < *n_rows && (rows[at].offset < offset ||
                            (rows[at].offset == offset && rows[at].kind < kind)))
        at++;
    if (at == *n_rows || rows[at].offset != offset || rows[at].kind != kind) {
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
static int is_lattice(const struct builder *w, size_t begin, size_t end, int near[][MOST_NEAR],
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

/* Room of one thread. */
struct scratch {
    int near[KR_LANES][MOST_NEAR];
    struct row row[MOST_ROWS];
};

/* Find the rows of one slice. Returns their number and sets the class. */
static size_t make_slice(const struct builder *w, size_t slice, struct scratch *s, int *lattice) {
    size_t begin = slice * KR_LANES, n_near[KR_LANES], n_rows = 0;
    size_t end = begin + KR_LANES < w->bonds->n ? begin + KR_LANES : w->bonds->n;
    for (size_t i = begin; i < end; i++) {
        n_near[i - begin] = kr_search_near(w->search, i, s->near[i - begin], MOST_NEAR);
        if (n_near[i - begin] > MOST_NEAR)
            kr_stop(KR_EXIT_INPUT,
                    "node %zu has more than %d neighbours; expected a horizon of a few spacings", i,
                    MOST_NEAR);
    }
    *lattice = is_lattice(w, begin, end, s->near, n_near);
    for (size_t i = begin; i < end; i++) {
        size_t at = 0, bonds = 0;
        for (size_t k = 0; k < n_near[i - begin]; k++) {
            size_t j = (size_t)s->near[i - begin][k];
            double length, weight = weigh(w, i, j, &length);
            if (weight <= 0)
                continue;
            int kind = *lattice ? kind_of(w, i, j) : 0;
            at = merge_bond(s->row, &n_rows, at, (int)((long)j - (long)i), kind, (int)(i - begin),
                            length, weight);
            bonds++;
        }
        if (!bonds)
            kr_stop(KR_EXIT_INPUT,
                    "node %zu at (%g, %g) m has no neighbour within the horizon %g m; expected a "
                    "horizon of a few spacings, or remove the node",
                    i, w->bonds->x[0][i], w->bonds->x[1][i], w->bonds->material.horizon);
    }
    return n_rows;
}

/* A general row stores weights if any of its bonds is only partly inside the horizon, or carries
 * what its surface factor differs from the mean of its ends'. */
static int is_rim(const struct row *row) {
    for (int lane = 0; lane < KR_LANES; lane++)
        if (row->mask >> lane & 1 && (float)row->weight[lane] != 1)
            return 1;
    return 0;
}

static void count_slice(const struct builder *w, size_t slice, struct scratch *s) {
    struct kr_bonds *b = w->bonds;
    int lattice;
    size_t n_rows = make_slice(w, slice, s, &lattice), rims = 0;
    b->lattice[slice] = (unsigned char)lattice;
    for (size_t r = 0; r < n_rows && !lattice; r++)
        rims += (size_t)is_rim(&s->row[r]);
    b->first[slice + 1] = n_rows;
    b->first_inverse[slice + 1] = lattice ? 0 : n_rows;
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
static void fill_slice(const struct builder *w, size_t slice, struct scratch *s) {
    struct kr_bonds *b = w->bonds;
    int lattice;
    size_t n_rows = make_slice(w, slice, s, &lattice), to = b->first[slice];
    size_t tuple = b->first_inverse[slice], rim_tuple = b->first_weight[slice];
    for (size_t r = 0; r < n_rows && lattice; r++) {
        b->kind[to] = (uint16_t)s->row[r].kind;
        store_row(b, &s->row[r], slice, to++);
    }
    for (int rim = 0; rim <= 1 && !lattice; rim++)
        for (size_t r = 0; r < n_rows; r++)
            if (is_rim(&s->row[r]) == rim) {
                store_general_row(b, &s->row[r], rim, to, tuple++, rim_tuple);
                store_row(b, &s->row[r], slice, to++);
                rim_tuple += (size_t)rim;
            }
}

static void for_all_slices(const struct builder *w,
                           void (*work)(const struct builder *, size_t, struct scratch *)) {
#pragma omp parallel
    {
        struct scratch *s = KR_NEW(struct scratch, 1);
#pragma omp for schedule(dynamic, 256)
        for (size_t slice = 0; slice < w->bonds->n_slices; slice++)
            work(w, slice, s);
        kr_free(s);
    }
}

static void sum_up(size_t *first, size_t n) {
    for (size_t k = 0; k < n; k++)
        first[k + 1] += first[k];
}

/* Cut the slices into one block a thread, of about equally many rows; twins stay together. */
static void make_blocks(struct kr_bonds *b) {
    b->n_blocks = omp_get_max_threads();
    b->block = KR_NEW(size_t, (size_t)b->n_blocks + 1);
    size_t slice = 0;
    for (int k = 0; k < b->n_blocks; k++) {
        size_t rows = b->n_rows / (size_t)b->n_blocks * (size_t)k;
        while (slice + 2 <= b->n_slices && b->first[slice] < rows)
            slice += 2;
        b->block[k] = slice;
    }
    b->block[b->n_blocks] = b->n_slices;
}

static int is_twin(const struct kr_bonds *b, size_t slice) {
    size_t mine = b->first[slice], other = b->first[slice + 1], rows = other - mine;
    if (!b->lattice[slice] || !b->lattice[slice + 1] || b->first[slice + 2] - other != rows)
        return 0;
    for (size_t r = 0; r < 2 * rows; r++)
        if (b->living[mine + r] != (1 << KR_LANES) - 1)
            return 0;
    return !memcmp(b->offset + mine, b->offset + other, rows * sizeof *b->offset) &&
           !memcmp(b->kind + mine, b->kind + other, rows * sizeof *b->kind);
}

void kr_bonds_find_twins(struct kr_bonds *b) {
#pragma omp parallel for schedule(static)
    for (size_t k = 0; k < b->n_slices / 2; k++)
        b->twin[k] = (unsigned char)is_twin(b, 2 * k);
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
    b->fit = kr_fit_make(material, KR_FIT_DOUBLE);
    b->fit_mixed = kr_fit_make(material, KR_FIT_MIXED);
    double s0 = material->critical_stretch;
    b->flag_below = -b->fit.range;
    b->flag_above = isfinite(s0) ? fmin(s0 * (2 + s0) * (1 - 1e-12), b->fit.range) : b->fit.range;

    struct builder w = {.nodes = nodes, .bonds = b};
    w.weights = kr_weights_create(nodes, material->horizon, partial_volume);
    double reach = w.weights->reach;
    w.search = kr_search_create(nodes->dim, nodes->n, nodes->position, reach);
    find_lattice(&w);
    w.reach_in_cells = (int)ceil(reach / w.size_of_lattice);
    make_kinds(&w);
    kr_weights_keep(w.weights, w.search, w.on_lattice);

    for_all_slices(&w, count_slice);
    sum_up(b->first, b->n_slices);
    sum_up(b->first_inverse, b->n_slices);
    sum_up(b->first_weight, b->n_slices);
    b->n_rows = b->first[b->n_slices];
    b->offset = KR_NEW(int32_t, b->n_rows);
    b->kind = KR_NEW(uint16_t, b->n_rows);
    b->living = KR_NEW(uint8_t, b->n_rows);
    b->inverse = KR_NEW(float, KR_LANES *b->first_inverse[b->n_slices]);
    b->weight = KR_NEW(float, KR_LANES *b->first_weight[b->n_slices]);
    for_all_slices(&w, fill_slice);

    kr_search_free(w.search);
    kr_weights_free(w.weights);
    kr_free(w.on_lattice);
    kr_free(w.place);
    count_living(b);
    kr_bonds_find_twins(b);
    make_blocks(b);
    return b;
}

/* ---- single bonds ---- */

struct kr_bond_walk kr_bonds_walk(const struct kr_bonds *b, size_t slice) {
    return (struct kr_bond_walk){.slice = slice,
                                 .row = b->first[slice],
                                 .weight = b->first_weight[slice],
                                 .lane = -1};
}

static void fill_bond(const struct kr_bonds *b, const struct kr_bond_walk *walk,
                      struct kr_bond *bond) {
    size_t i = walk->slice * KR_LANES + (size_t)walk->lane;
    size_t j = (size_t)((long)i + b->offset[walk->row]);
    *bond = (struct kr_bond){.row = walk->row, .lane = walk->lane, .i = i, .j = j, .weight = 1};
    if (b->lattice[walk->slice]) {
        const struct kr_bond_kind *kind = &b->kinds[b->kind[walk->row]];
        memcpy(bond->xi, kind->geometry.xi, sizeof bond->xi);
        bond->length = kind->length;
        bond->weight = kind->weight;
        return;
    }
    size_t tuple = b->first_inverse[walk->slice] + walk->row - b->first[walk->slice];
    for (int d = 0; d < b->dim; d++)
        bond->xi[d] = b->x[d][j] - b->x[d][i];
    bond->length = 1 / (double)b->inverse[KR_LANES * tuple + (size_t)walk->lane];
    if (b->kind[walk->row])
        bond->weight = b->weight[KR_LANES * walk->weight + (size_t)walk->lane];
}

int kr_bonds_next(const struct kr_bonds *b, struct kr_bond_walk *walk, struct kr_bond *bond) {
    for (; walk->row < b->first[walk->slice + 1]; walk->row++) {
        while (++walk->lane < KR_LANES)
            if (b->living[walk->row] >> walk->lane & 1) {
                fill_bond(b, walk, bond);
                return 1;
            }
        walk->lane = -1;
        walk->weight += !b->lattice[walk->slice] && b->kind[walk->row];
    }
    return 0;
}

double kr_bonds_clear(struct kr_bonds *b, size_t i, size_t j) {
    size_t slice = i / KR_LANES, weight = b->first_weight[slice];
    uint8_t bit = (uint8_t)(1u << (i % KR_LANES));
    int32_t offset = (int32_t)((long)j - (long)i);
    for (size_t r = b->first[slice]; r < b->first[slice + 1]; r++) {
        int stored = !b->lattice[slice] && b->kind[r];
        if (b->offset[r] == offset && b->living[r] & bit) {
            b->living[r] &= (uint8_t)~bit;
            b->twin[slice / 2] = 0;
            return b->lattice[slice] ? b->kinds[b->kind[r]].weight
                   : stored          ? b->weight[KR_LANES * weight + i % KR_LANES]
                                     : 1;
        }
        weight += (size_t)stored;
    }
    return 0;
}

double kr_bonds_damage(const struct kr_bonds *b, size_t i) {
    return b->family_volume[i] > 0 ? b->lost_volume[i] / b->family_volume[i] : 1;
}

struct kr_bonds_size kr_bonds_size(const struct kr_bonds *b) {
    size_t rows = b->n_rows, lattice = 0;
    for (size_t s = 0; s < b->n_slices; s++)
        lattice += b->lattice[s];
    size_t node_arrays = (size_t)b->dim + 4;
    return (struct kr_bonds_size){
        .bytes = rows * 7 + KR_LANES * sizeof(float) *
                                (b->first_inverse[b->n_slices] + b->first_weight[b->n_slices]) +
                 b->n_slices * 25 + b->n * (node_arrays * sizeof(double) + 1),
        .lane_fill = (double)b->count / (KR_LANES * (double)rows),
        .lattice_share = (double)lattice / (double)b->n_slices,
    };
}
