/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From the description of a plate to its curves.
 */
#include "plate_body.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void name_groups(struct kr_plate_body *body, int is_frame, size_t n_holes) {
    static const char *const side[] = {"left", "right", "bottom", "top"};
    body->first_hole = is_frame ? 4 : 1;
    body->n_groups = (size_t)body->first_hole + n_holes;
    body->group = KR_NEW(char *, body->n_groups);
    for (int k = 0; k < body->first_hole; k++)
        body->group[k] = kr_text_copy(is_frame ? side[k] : "outline");
    for (size_t h = 0; h < n_holes; h++)
        body->group[(size_t)body->first_hole + h] = kr_text("hole_%zu", h + 1);
}

/** Curves of the outline, each counter-clockwise. */
static struct kr_shape outline_of(const struct kr_plate *plate, const struct kr_lattice *lattice) {
    const struct kr_case_outline *o = &plate->outline;
    struct kr_shape shape = {1, KR_NEW(struct kr_curve, 2)};
    struct kr_case_hole as = {.shape = KR_HOLE_CIRCLE, .radius = o->radius};
    int has_centre = o->centre[0] != 0 || o->centre[1] != 0;
    as.centre[0] = has_centre ? o->centre[0] : plate->width / 2;
    as.centre[1] = has_centre ? o->centre[1] : plate->height / 2;
    if (o->shape == KR_OUTLINE_RECTANGLE) {
        shape.curve[0] = kr_curve_frame((double)lattice->columns, (double)lattice->rows);
        return shape;
    }
    if (o->shape == KR_OUTLINE_POLYGON) {
        as = (struct kr_case_hole){.shape = KR_HOLE_POLYGON};
        as.points = o->points;
        as.corner_radius = o->corner_radius;
    }
    shape.curve[0] = kr_curve_of_hole(&as, lattice->spacing, 0, "the outline");
    if (o->shape == KR_OUTLINE_RING) {
        as.radius = o->inner_radius;
        shape.curve[shape.n_curves++] =
            kr_curve_of_hole(&as, lattice->spacing, 0, "the ring's inner edge");
    }
    return shape;
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

/** Give `to` to the cells of value `from` whose centre lies inside a curve. */
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
                if (*of == from)
                    *of = to;
            }
    }
    kr_free(x);
}

static int32_t *holders(const struct kr_plate_body *body, const struct kr_shape *outline,
                        size_t n_holes) {
    size_t cells = body->lattice.columns * body->lattice.rows;
    int32_t *holder = KR_NEW(int32_t, cells);
    if (body->first_hole == 1) { /* group 0 is the outline: all lies beyond it but its inside */
        for (size_t c = 0; c < cells; c++)
            holder[c] = 1;
        mark(&outline->curve[0], &body->lattice, 1, 0, holder);
        if (outline->n_curves == 2)
            mark(&outline->curve[1], &body->lattice, 0, 1, holder);
    }
    for (size_t h = 0; h < n_holes; h++)
        mark(&body->hole[h], &body->lattice, 0, body->first_hole + (int32_t)h + 1, holder);
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

struct kr_plate_body kr_plate_body_of(const struct kr_plate *plate) {
    struct kr_plate_body body = {
        .lattice = kr_lattice_fit(plate->width, plate->height, plate->spacing)};
    name_groups(&body, plate->outline.shape == KR_OUTLINE_RECTANGLE, plate->n_holes);
    struct kr_shape outline = outline_of(plate, &body.lattice);
    body.hole = KR_NEW(struct kr_curve, plate->n_holes);
    for (size_t h = 0; h < plate->n_holes; h++) {
        int group = body.first_hole + (int)h;
        body.hole[h] = kr_curve_of_hole(&plate->hole[h], body.lattice.spacing, group,
                                        body.group[group]);
    }
    body.exact = kr_shape_cut(&outline, plate->n_holes, body.hole);
    check_holes(&body);
    body.holder = holders(&body, &outline, plate->n_holes);
    kr_shape_free(&outline);
    return body;
}

void kr_plate_body_free(struct kr_plate_body *body) {
    for (size_t h = 0; h + (size_t)body->first_hole < body->n_groups; h++)
        kr_curve_free(&body->hole[h]);
    for (size_t g = 0; g < body->n_groups; g++)
        kr_free(body->group[g]);
    kr_free(body->hole);
    kr_free(body->group);
    kr_free(body->holder);
    kr_shape_free(&body->exact);
}
