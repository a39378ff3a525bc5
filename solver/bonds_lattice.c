/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The lattice: which nodes stand on it, and the table of the bonds between them. See bonds.h.
 */
#include "bonds_make.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/* Which nodes stand on the lattice that the first node of just one cell's volume stands on. Where
 * there is none, nothing is lost but speed. */
void kr_builder_find_lattice(struct kr_builder *w) {
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

static int side_of(const struct kr_builder *w) {
    return 2 * w->reach_in_cells + 1;
}

int kr_builder_kind(const struct kr_builder *w, size_t i, size_t j) {
    int place = 0;
    size_t dim = (size_t)w->nodes->dim;
    for (size_t d = dim; d-- > 0;)
        place = place * side_of(w) + w->place[j * dim + d] - w->place[i * dim + d] +
                w->reach_in_cells;
    return place;
}

static void make_geometry(struct kr_bonds *b, size_t k, double volume) {
    const struct kr_bond_kind *kind = &b->kinds[k];
    const double inverse = 1 / kind->length, square = inverse * inverse;
    const double share = kr_material_micromodulus(&b->material, kind->length) / b->material.micromodulus;
    struct kr_bond_geometry *g = &b->geometry[k];
    memcpy(g->xi, kind->xi, sizeof g->xi);
    g->to_t = square * b->fit.scale;
    g->pull = share * kind->weight * volume * inverse * square;
    b->geometry32[k] = (struct kr_bond_geometry32){
        {(float)g->xi[0], (float)g->xi[1], (float)g->xi[2]},
        (float)(square * b->fit_mixed.scale),
        (float)g->pull};
}

void kr_builder_make_kinds(struct kr_builder *w) {
    struct kr_bonds *b = w->bonds;
    int side = side_of(w);
    b->n_kinds = (size_t)(side * side * (b->dim == 3 ? side : 1));
    kr_assert(b->n_kinds <= UINT16_MAX);
    b->kinds = KR_NEW(struct kr_bond_kind, b->n_kinds);
    b->geometry = KR_NEW(struct kr_bond_geometry, b->n_kinds);
    b->geometry32 = KR_NEW(struct kr_bond_geometry32, b->n_kinds);
    for (size_t k = 0; k < b->n_kinds; k++) {
        struct kr_bond_kind *kind = &b->kinds[k];
        size_t rest = k;
        double square = 0;
        for (int d = 0; d < b->dim; d++) {
            kind->xi[d] = ((int)(rest % (size_t)side) - w->reach_in_cells) * w->size_of_lattice;
            square += kind->xi[d] * kind->xi[d];
            rest /= (size_t)side;
        }
        if (square == 0)
            continue;
        kind->length = 1 / (double)(float)(1 / sqrt(square));
        kind->weight = (float)kr_weight_lattice(w->weights->partial_volume, b->dim, kind->xi,
                                                b->material.horizon, w->size_of_lattice);
        make_geometry(b, k, w->cell_volume);
    }
}
