/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The uniform grid: the squares whose centres lie in the body. Used by plate.c only.
 */
#ifndef KR_UNIFORM_H
#define KR_UNIFORM_H

#include "plate_body.h"

/** Mesh a plate by squares alone. Stops (exit 2) where a hole holds the centre of no cell. */
struct kr_mesh *kr_uniform_mesh(const struct kr_plate *plate, const struct kr_plate_body *body,
                                struct kr_plate_report *report);

#endif
