/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The outline of a plate as layers of exact curves, in spacings: the rectangle of width by height,
 * one shape, or parts joined and taken away in turn.
 *
 * Groups: 0 to 3 are the sides of the frame (left, right, bottom, top); further ones are named
 * `outline` or as a part says. Inner edges of the faces of a CAD file are holes: their groups are
 * -1, -2, ... here, for whoever knows the number of the other holes.
 */
#ifndef KR_OUTLINE_H
#define KR_OUTLINE_H

#include "shape.h"

enum { KR_OUTLINE_SIDES = 4 };

struct kr_layers {
    size_t n_layers;
    struct kr_layer *layer;
    size_t n_names; /* groups behind the sides */
    char **name;
    int n_inner; /* inner edges of CAD faces */
};

/** The outline of a plate of width by height [m], `helper` as for kr_cad_read. Stops (exit 2) where
 *  a shape makes no curve. */
struct kr_layers kr_layers_of(const struct kr_case_outline *outline, double width, double height,
                                double spacing, const char *helper);

/** Give the straight edges on the frame to its sides; stop (exit 2) where the body reaches beyond
 *  the frame, `columns` by `rows` spacings. `n_groups` are the frame's and the outline's own. */
void kr_layers_name_sides(struct kr_shape *body, double columns, double rows, int n_groups);

void kr_layers_free(struct kr_layers *outline);

#endif
