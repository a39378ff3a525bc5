/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From the deck's outline to layers of curves.
 */
#include "outline.h"

#include "base/error.h"
#include "base/memory.h"
#include "cad.h"

#include <math.h>
#include <string.h>

/** What all parts need. */
struct making {
    struct kr_layers *out;
    double width, height, spacing; /* m */
    const char *helper;
};

static struct kr_layer *add_layer(struct kr_layers *out, size_t n_curves, int is_cut) {
    out->layer = kr_realloc(out->layer, out->n_layers + 1, sizeof *out->layer);
    struct kr_layer *layer = &out->layer[out->n_layers++];
    *layer = (struct kr_layer){{n_curves, KR_NEW(struct kr_curve, n_curves)}, is_cut};
    return layer;
}

/** Group of a name; a new one where it is not yet there. */
static int group_named(struct kr_layers *out, const char *name) {
    if (!name || !*name)
        name = "outline";
    for (size_t k = 0; k < out->n_names; k++)
        if (!strcmp(out->name[k], name))
            return KR_OUTLINE_SIDES + (int)k;
    out->name = kr_realloc(out->name, out->n_names + 1, sizeof *out->name);
    out->name[out->n_names++] = kr_text_copy(name);
    return KR_OUTLINE_SIDES + (int)out->n_names - 1;
}

/** A length in spacings; whole where it misses that by rounding alone. */
static double in_spacings(double length, double spacing) {
    double x = length / spacing;
    return fabs(x - nearbyint(x)) < KR_SHAPE_SAME ? nearbyint(x) : x;
}

/** The whole frame; its sides keep their groups. */
static void add_frame(const struct making *m, const struct kr_case_outline *part) {
    struct kr_layer *layer = add_layer(m->out, 1, part->operation == KR_DIFFERENCE);
    layer->shape.curve[0] =
        kr_curve_frame(in_spacings(m->width, m->spacing), in_spacings(m->height, m->spacing));
}

static void set_group(struct kr_curve *curve, int group) {
    for (size_t k = 0; k < curve->n; k++)
        curve->piece[k].group = group;
}

static void add_faces(const struct making *m, const struct kr_case_outline *part, int group) {
    const struct kr_cad_place place = {
        {part->centre[0], part->centre[1]}, part->angle, m->spacing};
    struct kr_shape *face;
    size_t n = kr_cad_read(part->file, m->helper, &place, &face);
    for (size_t f = 0; f < n; f++) {
        struct kr_layer *layer =
            add_layer(m->out, face[f].n_curves, part->operation == KR_DIFFERENCE);
        for (size_t c = 0; c < face[f].n_curves; c++) {
            layer->shape.curve[c] = face[f].curve[c];
            set_group(&face[f].curve[c], c ? -++m->out->n_inner : group);
        }
        kr_free(face[f].curve);
    }
    kr_free(face);
}

/** The shape of a part as a hole of the same shape would be. */
static struct kr_case_hole hole_like(const struct making *m, const struct kr_case_outline *part) {
    struct kr_case_hole as = {.corner_radius = part->corner_radius, .angle = part->angle};
    int is_polygon = part->shape == KR_OUTLINE_POLYGON;
    int is_given = part->has_centre || part->centre[0] != 0 || part->centre[1] != 0 || is_polygon;
    as.shape = is_polygon                              ? KR_HOLE_POLYGON
               : part->shape == KR_OUTLINE_RECTANGLE ? KR_HOLE_RECTANGLE
                                                       : KR_HOLE_CIRCLE;
    as.centre[0] = is_given ? part->centre[0] : m->width / 2;
    as.centre[1] = is_given ? part->centre[1] : m->height / 2;
    as.radius = part->radius;
    as.points = part->points;
    as.size[0] = part->size[0] > 0 ? part->size[0] : m->width;
    as.size[1] = part->size[1] > 0 ? part->size[1] : m->height;
    return as;
}

static void add_part(const struct making *m, const struct kr_case_outline *part) {
    int is_frame = part->shape == KR_OUTLINE_RECTANGLE && !(part->size[0] > 0) &&
                   !(part->corner_radius > 0);
    if (is_frame) {
        add_frame(m, part);
        return;
    }
    int group = group_named(m->out, part->name), is_ring = part->shape == KR_OUTLINE_RING;
    if (part->shape == KR_OUTLINE_CAD) {
        add_faces(m, part, group);
        return;
    }
    struct kr_case_hole as = hole_like(m, part);
    struct kr_layer *layer = add_layer(m->out, is_ring ? 2 : 1, part->operation == KR_DIFFERENCE);
    layer->shape.curve[0] =
        kr_curve_of_hole(&as, m->spacing, group, m->out->name[group - KR_OUTLINE_SIDES]);
    if (is_ring) {
        as.radius = part->inner_radius;
        layer->shape.curve[1] = kr_curve_of_hole(&as, m->spacing, group, "the ring's inner edge");
    }
}

struct kr_layers kr_layers_of(const struct kr_case_outline *outline, double width, double height,
                                double spacing, const char *helper) {
    struct kr_layers out = {0};
    const struct making m = {&out, width, height, spacing, helper};
    const struct kr_case_outline *part = outline->parts.item;
    for (size_t k = 0; k < outline->parts.count; k++)
        add_part(&m, &part[k]);
    if (!outline->parts.count)
        add_part(&m, outline);
    return out;
}

/** The side of the frame that a straight piece lies on; -1 if none. */
static int side_of(const struct kr_piece *p, double columns, double rows) {
    const double line[4] = {0, columns, 0, rows};
    for (int k = 0; k < 4 && !p->is_arc; k++)
        if (p->from[k / 2] == line[k] && p->to[k / 2] == line[k])
            return k;
    return -1;
}

void kr_layers_name_sides(struct kr_shape *body, double columns, double rows, int n_groups) {
    const double most[2] = {columns, rows};
    for (size_t c = 0; c < body->n_curves; c++) {
        double box[4];
        kr_curve_box(&body->curve[c], box);
        for (int d = 0; d < 2; d++)
            if (box[d] < -KR_SHAPE_SAME || box[2 + d] > most[d] + KR_SHAPE_SAME)
                kr_stop(KR_EXIT_INPUT,
                        "the outline reaches from %.9g to %.9g spacings in %s, beyond the frame of "
                        "0 to %.9g: raise geometry.%s or move the outline by its centre",
                        box[d], box[2 + d], d ? "y" : "x", most[d], d ? "height" : "width");
        for (size_t k = 0; k < body->curve[c].n; k++) {
            struct kr_piece *piece = &body->curve[c].piece[k];
            int side = side_of(piece, columns, rows);
            if (side >= 0 && piece->group < n_groups)
                piece->group = side;
        }
    }
}

void kr_layers_free(struct kr_layers *outline) {
    for (size_t l = 0; l < outline->n_layers; l++)
        kr_shape_free(&outline->layer[l].shape);
    for (size_t k = 0; k < outline->n_names; k++)
        kr_free(outline->name[k]);
    kr_free(outline->layer);
    kr_free(outline->name);
    *outline = (struct kr_layers){0};
}
