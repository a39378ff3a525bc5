/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The plate that a grid is made for: outline and holes as exact curves, the lattice under them, the
 * boundaries' names, and which square's centre is gone.
 */
#ifndef KR_PLATE_BODY_H
#define KR_PLATE_BODY_H

#include "lattice.h"
#include "plate.h"
#include "shape.h"

#include <stdint.h>

struct kr_plate_body {
    struct kr_lattice lattice;
    struct kr_shape exact; /* spacings; the body on the left of every curve */
    size_t n_groups;
    char **group;     /* names: left, right, bottom, top; what the outline adds; hole_1, ... */
    int first_hole;   /* group of hole_1 */
    size_t n_holes;   /* the plate's, then the inner edges of CAD faces */
    struct kr_curve *hole;
    int32_t *holder;  /* (lattice cells) 0: the cell's centre is in the body; else 1 + the group of
                         what holds it: a hole, or a part of the outline where it lies beyond */
};

/** Stops (exit 2) where the lattice does not fit the frame or a shape makes no curve. */
struct kr_plate_body kr_plate_body_of(const struct kr_plate *plate);

void kr_plate_body_free(struct kr_plate_body *body);

#endif
