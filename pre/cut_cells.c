/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Which cubes are cut by surfaces, and which of them are joined. See cut_cells.h.
 */
#include "cut_cells.h"

#include "base/error.h"
#include "base/memory.h"
#include "cutting.h"
#include "poly.h"


/* A cell of less than this share of a cube is joined to a neighbour: smaller ones raise the scatter of
 * volumes, larger limits that of the joined cells. */
static const double LEAST = 0.5;

/** Values of a cutter at the corners of a cube (corner c: bits of x, y, z); whether any is not
 *  positive, whether any is. */
static void values_of(const struct kr_field *field, const size_t at[3], double value[8], int *any) {
    any[0] = any[1] = 0;
    for (size_t c = 0; c < 8; c++) {
        value[c] = kr_field_at(field, (long)(at[0] + (c & 1)), (long)(at[1] + (c >> 1 & 1)),
                               (long)(at[2] + (c >> 2)));
        any[value[c] > 0] = 1;
    }
}

static int32_t gone_by(const struct kr_cutting *cutting, size_t cutter, const size_t at[3]) {
    const double centre[3] = {(double)at[0] + 0.5, (double)at[1] + 0.5, (double)at[2] + 0.5};
    return KR_CUT_GONE - kr_cutter_group(&cutting->body->cutter[cutter], centre);
}

static int32_t state_of(struct kr_cutting *cutting, const size_t at[3]) {
    double value[KR_POLY_PLANES][8];
    size_t cutter[KR_POLY_PLANES], n = 0;
    for (size_t c = 0; c < cutting->body->n_cutters; c++) {
        int any[2];
        const struct kr_field *f = &cutting->field[c];
        int is_near = 1;
        for (int d = 0; d < 3; d++)
            is_near &= (long)at[d] >= f->low[d] - 1 && (long)at[d] <= f->high[d];
        if (!is_near)
            continue;
        if (n == KR_POLY_PLANES)
            kr_stop(KR_EXIT_INPUT, "more than %d surfaces meet at (%.9g, %.9g, %.9g) mm; take a finer "
                                   "spacing", KR_POLY_PLANES - 1,
                    1e3 * cutting->body->spacing * (double)at[0],
                    1e3 * cutting->body->spacing * (double)at[1],
                    1e3 * cutting->body->spacing * (double)at[2]);
        values_of(f, at, value[n], any);
        if (!any[1])
            return gone_by(cutting, c, at);
        cutter[n] = c;
        n += (size_t)any[0];
    }
    if (!n)
        return KR_CUT_WHOLE;
    long place = kr_cut_cube(cutting, at, n, cutter, (const double(*)[8])value);
    return place < 0 ? gone_by(cutting, cutter[0], at) : (int32_t)place + 1;
}

static int32_t *states(struct kr_cutting *cutting) {
    const size_t *n = cutting->body->n;
    int32_t *state = KR_NEW(int32_t, n[0] * n[1] * n[2]);
    size_t at[3];
    for (at[2] = 0; at[2] < n[2]; at[2]++)
        for (at[1] = 0; at[1] < n[1]; at[1]++)
            for (at[0] = 0; at[0] < n[0]; at[0]++)
                state[kr_block_cell(cutting->body, at[0], at[1], at[2])] = state_of(cutting, at);
    return state;
}

/** Lattice cell behind a side; its number plus 1, 0 beyond the block. */
size_t kr_cut_behind(const struct kr_block_body *body, const size_t at[3], int side) {
    size_t to[3] = {at[0], at[1], at[2]};
    to[side / 2] += side % 2 ? 1 : (size_t)-1;
    return to[side / 2] < body->n[side / 2] ? 1 + kr_block_cell(body, to[0], to[1], to[2]) : 0;
}

/** The cube of a lattice cell; a whole one is divided only when a sliver is to join it. */
static size_t cube_of(struct kr_cutting *cutting, size_t cell) {
    const size_t *n = cutting->body->n;
    if (cutting->state[cell] == KR_CUT_WHOLE) {
        const size_t at[3] = {cell % n[0], cell / n[0] % n[1], cell / n[0] / n[1]};
        cutting->state[cell] = (int32_t)kr_cut_cube(cutting, at, 0, NULL, NULL) + 1;
    }
    return (size_t)cutting->state[cell] - 1;
}

/** The side over which a cube shares most with a cell that it is not joined to; large enough ones come
 *  first. -1: there is none. */
static int best_side(const struct kr_cutting *cutting, size_t c) {
    const struct kr_cut_cube *cube = &cutting->cube[c];
    double most = 0;
    int best = -1;
    for (int s = 0; s < 6; s++) {
        size_t cell = kr_cut_behind(cutting->body, cube->at, s);
        int32_t state = cell ? cutting->state[cell - 1] : KR_CUT_GONE;
        if (state < 0 || cube->side[s] <= 0)
            continue;
        size_t root = state > 0 ? kr_cut_root(cutting, (size_t)state - 1) : SIZE_MAX;
        if (root == kr_cut_root(cutting, c))
            continue;
        int is_large = state == KR_CUT_WHOLE || cutting->cube[root].joined >= LEAST;
        double share = cube->side[s] + (is_large ? 2 : 0); /* an area is 1 at most */
        if (share > most) {
            most = share;
            best = s;
        }
    }
    return best;
}

static void join_slivers(struct kr_cutting *cutting) {
    int joined = 1;
    while (joined) {
        joined = 0;
        for (size_t c = 0; c < cutting->n_cubes; c++) {
            size_t root = kr_cut_root(cutting, c);
            int side = cutting->cube[root].joined < LEAST ? best_side(cutting, c) : -1;
            if (side < 0)
                continue;
            size_t to = kr_cut_root(
                cutting, cube_of(cutting, kr_cut_behind(cutting->body, cutting->cube[c].at, side) - 1));
            cutting->cube[root].root = to;
            cutting->cube[to].joined += cutting->cube[root].joined;
            joined = 1;
        }
    }
}

struct kr_mesh *kr_cut_cells_mesh(const struct kr_block_body *body) {
    struct kr_cutting cutting = {.body = body, .builder = kr_solid_builder_begin(body)};
    cutting.field = KR_NEW(struct kr_field, body->n_cutters);
    for (size_t c = 0; c < body->n_cutters; c++)
        cutting.field[c] = kr_field_of(body, &body->cutter[c], 0, 1);
    cutting.state = states(&cutting);
    for (size_t c = 0; c < body->n_cutters; c++)
        kr_free(cutting.field[c].value);
    kr_free(cutting.field);
    join_slivers(&cutting);
    kr_cut_take(&cutting);
    kr_free(cutting.state);
    kr_free(cutting.cube);
    kr_free(cutting.tetrahedron);
    kr_free(cutting.triangle);
    return kr_solid_builder_end(&cutting.builder);
}
