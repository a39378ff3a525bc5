/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From the description of a solid to its surfaces.
 */
#include "block_body.h"

#include "base/error.h"
#include "base/memory.h"
#include "cgal_surface.h"
#include "outline.h"
#include "stl_surface.h"

#include <math.h>
#include <string.h>

static void add_group(struct kr_block_body *body, char *name) {
    body->group = kr_realloc(body->group, body->n_groups + 1, sizeof *body->group);
    body->group[body->n_groups++] = name;
}

/** Whether any edge of the plate is called so: a disc has no left side. */
static int has_group(const struct kr_plate_body *flat, int group) {
    for (size_t c = 0; c < flat->exact.n_curves; c++)
        for (size_t k = 0; k < flat->exact.curve[c].n; k++)
            if (flat->exact.curve[c].piece[k].group == group)
                return 1;
    return 0;
}

static void name_groups(struct kr_block_body *body, const struct kr_block *block) {
    const struct kr_plate_body *flat = &body->flat;
    for (size_t g = 0; g < flat->n_groups; g++)
        add_group(body, kr_text_copy(flat->group[g]));
    for (int d = 0; d < 4; d++)
        body->side[d] = has_group(flat, d) || flat->first_hole == KR_OUTLINE_SIDES ? d : KR_OUTLINE_SIDES;
    body->side[4] = (int)body->n_groups;
    body->side[5] = (int)body->n_groups + 1;
    add_group(body, kr_text_copy("front"));
    add_group(body, kr_text_copy("back"));
    body->first_void = (int)body->n_groups;
    for (size_t k = 0; k < block->n_voids; k++)
        add_group(body, kr_text("void_%zu", k + 1));
    if (block->body)
        add_group(body, kr_text_copy("outline"));
}

static struct kr_surface_mesh *surface_of(const struct kr_block_body *body, const char *file,
                                          double unit, const double centre[3]) {
    double origin[3];
    for (int d = 0; d < 3; d++)
        origin[d] = centre[d] / body->spacing;
    return kr_stl_surface(file, unit / body->spacing, origin);
}

static void add_void(struct kr_block_body *body, const struct kr_case_void *hollow) {
    struct kr_cutter *cutter = &body->cutter[body->n_cutters];
    static const enum kr_cutter_kind kind[] = {KR_CUTTER_SPHERE, KR_CUTTER_ELLIPSOID,
                                               KR_CUTTER_CYLINDER, KR_CUTTER_STL};
    double dx = body->spacing, length = hypot(hypot(hollow->axis[0], hollow->axis[1]), hollow->axis[2]);
    double least = INFINITY;
    *cutter = (struct kr_cutter){.kind = kind[hollow->shape], .radius = hollow->radius / dx,
                                 .half = hollow->length / dx / 2, .axis = {0, 0, 1}};
    for (int d = 0; d < 3; d++) {
        cutter->centre[d] = hollow->centre[d] / dx;
        cutter->radii[d] = hollow->radii[d] / dx;
        if (length > 0)
            cutter->axis[d] = hollow->axis[d] / length;
        least = fmin(least, cutter->radii[d]);
    }
    cutter->group = body->first_void + (int)body->n_cutters;
    if (hollow->shape == KR_VOID_SPHERE || hollow->shape == KR_VOID_CYLINDER)
        least = cutter->radius;
    if (hollow->shape == KR_VOID_CYLINDER)
        least = fmin(least, cutter->half);
    if (hollow->shape == KR_VOID_STL)
        cutter->surface = surface_of(body, hollow->file, hollow->unit, hollow->centre);
    else if (least < 1)
        kr_stop(KR_EXIT_INPUT,
                "%s is smaller than the grid can show: half its least width is %.3g spacings, and 1 is "
                "needed; take a finer spacing",
                body->group[cutter->group], least);
    body->n_cutters++;
}

static void add_stl_body(struct kr_block_body *body, const struct kr_case_stl *stl) {
    struct kr_cutter *cutter = &body->cutter[body->n_cutters++];
    double box[6];
    *cutter = (struct kr_cutter){.kind = KR_CUTTER_STL, .is_body = 1,
                                 .group = (int)body->n_groups - 1};
    cutter->surface = surface_of(body, stl->file, stl->unit, stl->centre);
    kr_surface_mesh_box(cutter->surface, box);
    for (int d = 0; d < 3; d++)
        if (box[d] < -1e-6 || box[3 + d] > (double)body->n[d] + 1e-6)
            kr_stop(KR_EXIT_INPUT,
                    "%s: the body reaches from %.9g mm to %.9g mm along %c, and must lie between 0 and "
                    "%.9g mm; see geometry.body.centre and unit",
                    stl->file, 1e3 * body->spacing * box[d], 1e3 * body->spacing * box[3 + d],
                    "xyz"[d], 1e3 * body->spacing * (double)body->n[d]);
}

/** Whether the plate is more than a rectangle: then its curves cut, too. */
static int has_curves(const struct kr_plate_body *flat) {
    return flat->n_groups > KR_OUTLINE_SIDES;
}

struct kr_block_body *kr_block_body_of(const struct kr_block *block) {
    struct kr_block_body *body = KR_NEW(struct kr_block_body, 1);
    body->spacing = block->plate.spacing;
    body->flat = kr_plate_body_of(&block->plate);
    body->n[0] = body->flat.lattice.columns;
    body->n[1] = body->flat.lattice.rows;
    body->n[2] = (size_t)nearbyint(block->depth / body->spacing);
    name_groups(body, block);
    body->cutter = KR_NEW(struct kr_cutter, block->n_voids + 1);
    for (size_t k = 0; k < block->n_voids; k++)
        add_void(body, &block->hollow[k]);
    if (block->body)
        add_stl_body(body, block->body);
    else if (has_curves(&body->flat))
        body->cutter[body->n_cutters++] =
            (struct kr_cutter){.kind = KR_CUTTER_PLATE, .plate = &body->flat};
    return body;
}

void kr_block_body_free(struct kr_block_body *body) {
    for (size_t k = 0; k < body->n_cutters; k++)
        kr_surface_mesh_free(body->cutter[k].surface);
    for (size_t g = 0; g < body->n_groups; g++)
        kr_free(body->group[g]);
    kr_free(body->group);
    kr_free(body->cutter);
    kr_plate_body_free(&body->flat);
    kr_free(body);
}

/** Whether a void lies inside the block, and apart from another by the boxes around them, or, where
 *  both are spheres, by the distance of their centres. */
static int is_inside(const struct kr_block_body *body, const struct kr_cutter *cutter) {
    double box[6];
    kr_cutter_box(cutter, box);
    for (int d = 0; d < 3; d++)
        if (box[d] < 0 || box[3 + d] > (double)body->n[d])
            return 0;
    return 1;
}

static int are_apart(const struct kr_cutter *a, const struct kr_cutter *b) {
    double p[6], q[6], away = 0;
    kr_cutter_box(a, p);
    kr_cutter_box(b, q);
    for (int d = 0; d < 3; d++) {
        away = hypot(away, a->centre[d] - b->centre[d]);
        if (p[d] > q[3 + d] || q[d] > p[3 + d])
            return 1;
    }
    return a->kind == KR_CUTTER_SPHERE && b->kind == KR_CUTTER_SPHERE && away >= a->radius + b->radius;
}

double kr_block_body_volume(const struct kr_block_body *body) {
    double cube = body->spacing * body->spacing * body->spacing;
    double volume = kr_shape_area(&body->flat.exact) * (double)body->n[2];
    size_t voids = body->n_cutters;
    for (size_t k = 0; k < body->n_cutters; k++) {
        const struct kr_cutter *cutter = &body->cutter[k];
        if (cutter->kind == KR_CUTTER_PLATE || cutter->is_body)
            voids = k; /* they stand behind the voids */
        if (cutter->is_body)
            volume = kr_cutter_volume(cutter);
    }
    if (voids < body->n_cutters && voids > 0)
        return 0;
    for (size_t k = 0; k < voids; k++) {
        for (size_t l = 0; l < k; l++)
            if (!are_apart(&body->cutter[k], &body->cutter[l]))
                return 0;
        if (!is_inside(body, &body->cutter[k]))
            return 0;
        volume -= kr_cutter_volume(&body->cutter[k]);
    }
    return volume * cube;
}

int kr_block_side(const struct kr_block_body *body, const double *p, const double *q, const double *r) {
    for (int s = 0; s < 6; s++) {
        double at = s % 2 ? (double)body->n[s / 2] : 0;
        if (p[s / 2] == at && q[s / 2] == at && r[s / 2] == at)
            return s;
    }
    return -1;
}
