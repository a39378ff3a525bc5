/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What is asked of families once they are there: single bonds, damage, which slices are whole. How they
 * are found: bonds_make.c.
 */
#include "bonds.h"

#include "base/memory.h"

#include <string.h>

/* ---- arrays ---- */

double *kr_bonds_padded(size_t n) {
    size_t whole = (n + KR_LANES - 1) / KR_LANES * KR_LANES;
    return KR_NEW(double, whole + 2 * KR_PAIR) + KR_PAIR;
}

void kr_bonds_padded_free(double *array) {
    if (array)
        kr_free(array - KR_PAIR);
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
    kr_free(b->list);
    kr_free(b->first_inverse);
    kr_free(b->first_weight);
    kr_free(b->offset);
    kr_free(b->kind);
    kr_free(b->living);
    kr_free(b->inverse);
    kr_free(b->weight);
    kr_free(b->kinds);
    kr_free(b->geometry);
    kr_free(b->geometry32);
    kr_free(b->block);
    kr_free(b);
}

static int is_twin(const struct kr_bonds *b, size_t slice) {
    if (!b->lattice[slice])
        return 0;
    for (size_t r = b->first[slice]; r < b->first[slice + 2]; r++)
        if (b->living[r] != (1 << KR_LANES) - 1)
            return 0;
    return 1;
}

void kr_bonds_find_twins(struct kr_bonds *b) {
#pragma omp parallel for schedule(static)
    for (size_t k = 0; k < b->n_slices / 2; k++)
        b->twin[k] = (unsigned char)is_twin(b, 2 * k);
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
    size_t listed = b->list[walk->slice] + walk->row - b->first[walk->slice];
    size_t j = (size_t)((long)i + b->offset[listed]);
    *bond = (struct kr_bond){.row = walk->row, .lane = walk->lane, .i = i, .j = j, .weight = 1};
    if (b->lattice[walk->slice]) {
        const struct kr_bond_kind *kind = &b->kinds[b->kind[listed]];
        memcpy(bond->xi, kind->xi, sizeof bond->xi);
        bond->length = kind->length;
        bond->weight = kind->weight;
        return;
    }
    size_t tuple = b->first_inverse[walk->slice] + walk->row - b->first[walk->slice];
    for (int d = 0; d < b->dim; d++)
        bond->xi[d] = b->x[d][j] - b->x[d][i];
    bond->length = 1 / (double)b->inverse[KR_LANES * tuple + (size_t)walk->lane];
    if (b->kind[listed])
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
        walk->weight += !b->lattice[walk->slice] &&
                        b->kind[b->list[walk->slice] + walk->row - b->first[walk->slice]];
    }
    return 0;
}

double kr_bonds_clear(struct kr_bonds *b, size_t i, size_t j) {
    const size_t slice = i / KR_LANES, count = b->first[slice + 1] - b->first[slice];
    const uint8_t bit = (uint8_t)(1u << (i % KR_LANES));
    const int32_t *offset = b->offset + b->list[slice];
    const uint16_t *kind = b->kind + b->list[slice];
    uint8_t *living = b->living + b->first[slice];
    size_t weight = b->first_weight[slice];
    for (size_t r = 0; r < count; r++) {
        const int stored = !b->lattice[slice] && kind[r];
        if (offset[r] == (long)j - (long)i && living[r] & bit) {
            living[r] &= (uint8_t)~bit;
            b->twin[slice / 2] = 0;
            return b->lattice[slice] ? b->kinds[kind[r]].weight
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
    size_t lattice = 0;
    for (size_t s = 0; s < b->n_slices; s++)
        lattice += b->lattice[s];
    size_t node_arrays = (size_t)b->dim + 4;
    return (struct kr_bonds_size){
        .bytes = b->n_rows + 6 * b->n_listed +
                 KR_LANES * sizeof(float) *
                     (b->first_inverse[b->n_slices] + b->first_weight[b->n_slices]) +
                 b->n_slices * 33 + b->n * (node_arrays * sizeof(double) + 1),
        .lane_fill = (double)b->count / (KR_LANES * (double)b->n_rows),
        .lattice_share = (double)lattice / (double)b->n_slices,
    };
}
