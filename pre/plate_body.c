/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From the description of a plate to its curves.
 */
#include "plate_body.h"

#include "base/error.h"
#include "base/memory.h"
#include "outline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/** Groups of the sides, of the outline, of the holes. Takes the outline's names. */
static void name_groups(struct kr_plate_body *body, struct kr_layers *outline, size_t n_holes) {
    static const char *const side[KR_OUTLINE_SIDES] = {"left", "right", "bottom", "top"};
    size_t n = KR_OUTLINE_SIDES;
    body->first_hole = KR_OUTLINE_SIDES + (int)outline->n_names;
    body->n_holes = n_holes + (size_t)outline->n_inner;
    body->n_groups = (size_t)body->first_hole + body->n_holes;
    body->group = KR_NEW(char *, body->n_groups);
    for (size_t k = 0; k < n; k++)
        body->group[k] = kr_text_copy(side[k]);
    for (size_t k = 0; k < outline->n_names; k++)
        body->group[n++] = kr_text_copy(outline->name[k]);
    for (size_t h = 0; h < body->n_holes; h++)
        body->group[n++] = kr_text("hole_%zu", h + 1);
}

/** The curves of all holes, those that the outline has itself last; they stay its own. */
static void make_holes(const struct kr_plate *plate, struct kr_layers *outline,
                       struct kr_plate_body *body) {
    body->hole = KR_NEW(struct kr_curve, body->n_holes);
    for (size_t h = 0; h < plate->n_holes; h++) {
        int group = body->first_hole + (int)h;
        body->hole[h] = kr_curve_of_hole(&plate->hole[h], body->lattice.spacing, group,
                                         body->group[group]);
    }
    for (size_t l = 0, h = plate->n_holes; l < outline->n_layers; l++)
        for (size_t c = 0; c < outline->layer[l].shape.n_curves; c++) {
            struct kr_curve *curve = &outline->layer[l].shape.curve[c];
            if (curve->piece[0].group >= 0)
                continue;
            for (size_t k = 0; k < curve->n; k++)
                curve->piece[k].group = body->first_hole + (int)h;
            body->hole[h++] = *curve;
        }
}

/** Outline and holes, in the order in which they are joined and cut; the layers' curves stay those
 *  of outline and body. */
static struct kr_layer *all_layers(const struct kr_plate_body *body,
                                   const struct kr_layers *outline, size_t n_holes) {
    struct kr_layer *layer = KR_NEW(struct kr_layer, outline->n_layers + n_holes);
    memcpy(layer, outline->layer, outline->n_layers * sizeof *layer);
    for (size_t h = 0; h < n_holes; h++)
        layer[outline->n_layers + h] = (struct kr_layer){{1, &body->hole[h]}, 1};
    return layer;
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/** Where the height y of a row's centres meets a curve, ascending; returns how many. */
static size_t meet_row(const struct kr_curve *curve, double y, double *x) {
    size_t n = 0;
    for (size_t k = 0; k < curve->n; k++)
        n += (size_t)kr_piece_crossings(&curve->piece[k], y, x + n);
    qsort(x, n, sizeof *x, ascending);
    return n;
}

/** What becomes of cells whose centre lies inside a curve: those of value `from` (or, where `from`
 *  is ANY, all) get `to`; TOGGLE turns 0 and `to` into each other. */
enum { ANY = -1, TOGGLE = -2 };
static void mark(const struct kr_curve *curve, const struct kr_lattice *lattice, int32_t from,
                 int32_t to, int32_t *holder) {
    double box[4], *x = KR_NEW(double, 2 * curve->n);
    kr_curve_box(curve, box);
    size_t begin = box[1] > 0 ? (size_t)box[1] : 0;
    for (size_t j = begin; j < lattice->rows && (double)j <= box[3]; j++) {
        size_t n = meet_row(curve, (double)j + 0.5, x);
        for (size_t k = 0; k + 1 < n; k += 2)
            for (double i = fmax(ceil(x[k] - 0.5), 0);
                 i + 0.5 < x[k + 1] && i < (double)lattice->columns; i++) {
                int32_t *of = &holder[kr_lattice_cell(lattice, (size_t)i, j)];
                if (from == TOGGLE)
                    *of = *of ? 0 : to;
                else if (*of == from || from == ANY)
                    *of = to;
            }
    }
    kr_free(x);
}

/** A layer of several curves: what an odd number of them hold is joined or cut. */
static void mark_layer(const struct kr_layer *layer, const struct kr_lattice *lattice,
                       int32_t *holder) {
    size_t cells = lattice->columns * lattice->rows;
    int32_t *odd = KR_NEW(int32_t, cells), *last = KR_NEW(int32_t, cells);
    for (size_t k = 0; k < layer->shape.n_curves; k++) {
        const struct kr_curve *curve = &layer->shape.curve[k];
        mark(curve, lattice, TOGGLE, 1, odd);
        mark(curve, lattice, ANY, 1 + curve->piece[0].group, last);
    }
    for (size_t c = 0; c < cells; c++)
        if (!layer->is_cut && odd[c])
            holder[c] = 0;
        else if (last[c] && (layer->is_cut ? odd[c] && !holder[c] : holder[c] != 0))
            holder[c] = last[c];
    kr_free(odd);
    kr_free(last);
}

static int32_t *holders(const struct kr_lattice *lattice, size_t n, const struct kr_layer *layer) {
    size_t cells = lattice->columns * lattice->rows;
    int32_t *holder = KR_NEW(int32_t, cells);
    for (size_t c = 0; c < cells; c++) /* all lies beyond the outline at first */
        holder[c] = 1 + KR_OUTLINE_SIDES;
    for (size_t l = 0; l < n; l++) {
        const struct kr_curve *curve = layer[l].shape.curve;
        if (layer[l].shape.n_curves > 1)
            mark_layer(&layer[l], lattice, holder);
        else if (layer[l].is_cut)
            mark(curve, lattice, 0, 1 + curve->piece[0].group, holder);
        else
            mark(curve, lattice, ANY, 0, holder);
    }
    return holder;
}

/** Every hole must bound the body somewhere. */
static void check_holes(const struct kr_plate_body *body) {
    unsigned char *seen = KR_NEW(unsigned char, body->n_groups);
    for (size_t c = 0; c < body->exact.n_curves; c++)
        for (size_t k = 0; k < body->exact.curve[c].n; k++)
            seen[body->exact.curve[c].piece[k].group] = 1;
    for (size_t g = (size_t)body->first_hole; g < body->n_groups; g++)
        if (!seen[g])
            kr_stop(KR_EXIT_INPUT,
                    "%s lies outside the plate or wholly within other holes: remove it",
                    body->group[g]);
    kr_free(seen);
}

static void check_pieces(const struct kr_shape *body) {
    size_t n = 0;
    for (size_t c = 0; c < body->n_curves; c++)
        n += kr_curve_area(&body->curve[c]) > 0;
    if (n == 0)
        kr_stop(KR_EXIT_INPUT, "the holes leave nothing of the plate");
    if (n > 1)
        kr_warn("outline and holes leave the plate in %zu pieces that do not hang together", n);
}

struct kr_plate_body kr_plate_body_of(const struct kr_plate *plate) {
    struct kr_plate_body body = {
        .lattice = kr_lattice_fit(plate->width, plate->height, plate->spacing)};
    double columns = (double)body.lattice.columns, rows = (double)body.lattice.rows;
    struct kr_layers outline = kr_layers_of(&plate->outline, plate->width, plate->height,
                                              plate->spacing, plate->gmsh.helper);
    name_groups(&body, &outline, plate->n_holes);
    make_holes(plate, &outline, &body);
    struct kr_layer *layer = all_layers(&body, &outline, plate->n_holes);
    body.exact = kr_shape_cut(outline.n_layers + plate->n_holes, layer);
    kr_layers_name_sides(&body.exact, columns, rows, body.first_hole);
    check_holes(&body);
    check_pieces(&body.exact);
    body.holder = holders(&body.lattice, outline.n_layers + plate->n_holes, layer);
    kr_free(layer);
    /* The inner edges of faces now belong to body.hole. */
    for (size_t l = 0; l < outline.n_layers; l++)
        for (size_t c = 0; c < outline.layer[l].shape.n_curves; c++)
            if (outline.layer[l].shape.curve[c].piece[0].group >= body.first_hole)
                outline.layer[l].shape.curve[c] = (struct kr_curve){0, NULL};
    kr_layers_free(&outline);
    return body;
}

void kr_plate_body_free(struct kr_plate_body *body) {
    for (size_t h = 0; h < body->n_holes; h++)
        kr_curve_free(&body->hole[h]);
    for (size_t g = 0; g < body->n_groups; g++)
        kr_free(body->group[g]);
    kr_free(body->hole);
    kr_free(body->group);
    kr_free(body->holder);
    kr_shape_free(&body->exact);
}
