/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The uniform grid of a solid. A face of the staircase belongs to the boundary that took the cube
 * behind it; on the block's sides, to the side.
 */
#include "cut_cells.h"

#include "base/memory.h"
#include "solid_builder.h"

#include <math.h>
#include <stdint.h>

/** For each cell 0 where its centre lies in the body, else 1 + the boundary that holds it. */
static int32_t *holders(const struct kr_block_body *body) {
    int32_t *holder = KR_NEW(int32_t, body->n[0] * body->n[1] * body->n[2]);
    for (size_t c = body->n_cutters; c-- > 0;) { /* the first void of the deck has the last word */
        const struct kr_cutter *cutter = &body->cutter[c];
        struct kr_field field = kr_field_of(body, cutter, 0.5, 0);
        for (long k = (long)fmax((double)field.low[2], 0); k <= field.high[2] && k < (long)body->n[2]; k++)
            for (long j = (long)fmax((double)field.low[1], 0); j <= field.high[1] && j < (long)body->n[1]; j++)
                for (long i = (long)fmax((double)field.low[0], 0);
                     i <= field.high[0] && i < (long)body->n[0]; i++) {
                    const double centre[3] = {(double)i + 0.5, (double)j + 0.5, (double)k + 0.5};
                    if (kr_field_at(&field, i, j, k) <= 0)
                        holder[kr_block_cell(body, (size_t)i, (size_t)j, (size_t)k)] =
                            1 + kr_cutter_group(cutter, centre);
                }
        kr_free(field.value);
    }
    return holder;
}

static void add_sides(struct kr_solid_builder *builder, const int32_t *holder, const size_t at[3]) {
    const struct kr_block_body *body = builder->body;
    for (int s = 0; s < 6; s++) {
        size_t to[3] = {at[0], at[1], at[2]};
        to[s / 2] += s % 2 ? 1 : (size_t)-1;
        int32_t behind = to[s / 2] >= body->n[s / 2] /* 0 less one is large */
                             ? 1 + body->side[s]
                             : holder[kr_block_cell(body, to[0], to[1], to[2])];
        if (behind)
            kr_solid_builder_side(builder, at[0], at[1], at[2], s, behind - 1);
    }
}

struct kr_mesh *kr_cubes_mesh(const struct kr_block_body *body) {
    struct kr_solid_builder builder = kr_solid_builder_begin(body);
    int32_t *holder = holders(body);
    size_t at[3];
    for (at[2] = 0; at[2] < body->n[2]; at[2]++)
        for (at[1] = 0; at[1] < body->n[1]; at[1]++)
            for (at[0] = 0; at[0] < body->n[0]; at[0]++)
                if (!holder[kr_block_cell(body, at[0], at[1], at[2])]) {
                    kr_solid_builder_cube(&builder, at[0], at[1], at[2]);
                    add_sides(&builder, holder, at);
                }
    kr_free(holder);
    return kr_solid_builder_end(&builder);
}
