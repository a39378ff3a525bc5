/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Boxes in space. The lattice of doubled spacing decides what is filled and where the surface lies
 * (coarse.h), gmsh fills it (fill_solid.h), and all else is cubes.
 */
#include "boxes_solid.h"

#include "base/error.h"
#include "base/memory.h"
#include "coarse.h"
#include "solid_builder.h"

#include <math.h>

/** What a region is about: "around void_3", "around 5 surfaces", "the body". */
static char *name_of(const struct kr_block_body *body, const struct kr_solid_region *r, const int *group,
                     int is_free) {
    size_t seen = 0, last = 0, *is_seen = KR_NEW(size_t, body->n_groups);
    for (size_t t = 0; t < r->n_triangles; t++)
        if (group[t] >= 0 && !is_seen[group[t]]++) {
            int is_side = 0;
            for (int s = 0; s < 6; s++)
                is_side |= body->side[s] == group[t];
            seen += !is_side;
            last = is_side ? last : (size_t)group[t];
        }
    kr_free(is_seen);
    return is_free     ? kr_text("the whole body")
           : seen == 1 ? kr_text("around %s", body->group[last])
                       : kr_text("around %zu surfaces", seen);
}

static int is_marked(const struct kr_coarse *coarse, const size_t at[3]) {
    return coarse->marked[(at[2] / 2 * coarse->n[1] + at[1] / 2) * coarse->n[0] + at[0] / 2];
}

/** Whether a cube of the lattice, not marked, lies in the body: no surface comes near it. */
static int is_body(const struct kr_coarse *coarse, const size_t at[3]) {
    const double centre[3] = {(double)at[0] + 0.5, (double)at[1] + 0.5, (double)at[2] + 0.5};
    size_t cutter;
    return kr_coarse_value(coarse->body, centre, &cutter) > 0;
}

static void add_cubes(struct kr_solid_builder *builder, const struct kr_coarse *coarse) {
    const struct kr_block_body *body = coarse->body;
    size_t at[3];
    for (at[2] = 0; at[2] < body->n[2]; at[2]++)
        for (at[1] = 0; at[1] < body->n[1]; at[1]++)
            for (at[0] = 0; at[0] < body->n[0]; at[0]++) {
                if (is_marked(coarse, at) || !is_body(coarse, at))
                    continue;
                kr_solid_builder_cube(builder, at[0], at[1], at[2]);
                for (int s = 0; s < 6; s++)
                    if (at[s / 2] == (s % 2 ? body->n[s / 2] - 1 : 0))
                        kr_solid_builder_side(builder, at[0], at[1], at[2], s, body->side[s]);
            }
}

static size_t take_point(struct kr_solid_builder *builder, const double p[3]) {
    size_t at[3], is_whole = 1;
    for (int d = 0; d < 3; d++) {
        is_whole &= p[d] >= 0 && p[d] <= (double)builder->body->n[d] && p[d] == floor(p[d]);
        at[d] = (size_t)fmax(p[d], 0);
    }
    return is_whole ? kr_solid_builder_lattice_point(builder, at[0], at[1], at[2])
                    : kr_solid_builder_point(builder, p);
}

static void take_region(struct kr_solid_builder *builder, const struct kr_solid_region *r,
                        const int *group) {
    size_t *number = KR_NEW(size_t, r->n_points), vertex[4];
    unsigned char *is_used = KR_NEW(unsigned char, r->n_points);
    for (size_t k = 0; k < 4 * r->n_cells; k++)
        is_used[r->cell[k / 4][k % 4]] = 1;
    for (size_t p = 0; p < r->n_points; p++)
        number[p] = is_used[p] ? take_point(builder, r->point[p]) : 0;
    for (size_t c = 0; c < r->n_cells; c++) {
        for (int k = 0; k < 4; k++)
            vertex[k] = number[r->cell[c][k]];
        kr_solid_builder_cell(builder, 4, vertex);
    }
    for (size_t t = 0; t < r->n_triangles; t++) {
        if (group[t] < 0)
            continue;
        for (int k = 0; k < 3; k++)
            vertex[k] = number[r->triangle[t][k]];
        kr_solid_builder_face(builder, 3, vertex, group[t]);
    }
    kr_free(number);
    kr_free(is_used);
}

static void note_region(struct kr_plate_region *note, const struct kr_solid_region *r) {
    *note = (struct kr_plate_region){.name = kr_text_copy(r->name), .n_cells = r->n_cells,
                                     .n_triangles = r->n_cells, .seconds = r->seconds,
                                     .method = r->method};
}

struct kr_mesh *kr_boxes_solid_mesh(const struct kr_block *block, const struct kr_block_body *body,
                                    struct kr_block_report *report) {
    double padding = block->plate.padding / body->spacing;
    int is_free = block->plate.grid == KR_GRID_FREE;
    if (!is_free && padding < 2 * (1 - 1e-9))
        kr_stop(KR_EXIT_INPUT, "a padding of %.9g mm is below two spacings of %.9g mm: tetrahedra need a "
                               "layer between the voids and the cubes",
                1e3 * block->plate.padding, 1e3 * body->spacing);
    struct kr_coarse coarse = kr_coarse_of(body, is_free ? -1 : padding);
    size_t n = coarse.n_regions;
    struct kr_solid_region *region = KR_NEW(struct kr_solid_region, n);
    int **group = KR_NEW(int *, n);
    kr_coarse_warp(&coarse);
    for (size_t r = 0; r < n; r++) {
        region[r] = kr_coarse_region(&coarse, r + 1, &group[r]);
        region[r].name = name_of(body, &region[r], group[r], is_free);
    }
    kr_solid_fill(n, region, &block->plate.gmsh);
    struct kr_solid_builder builder = kr_solid_builder_begin(body);
    add_cubes(&builder, &coarse);
    report->region = KR_NEW(struct kr_plate_region, n);
    report->n_regions = n;
    for (size_t r = 0; r < n; r++) {
        take_region(&builder, &region[r], group[r]);
        note_region(&report->region[r], &region[r]);
        kr_solid_region_free(&region[r]);
        kr_free(group[r]);
    }
    kr_free(region);
    kr_free(group);
    kr_coarse_free(&coarse);
    return kr_solid_builder_end(&builder);
}
