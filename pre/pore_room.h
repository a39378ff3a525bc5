/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Where pores may lie: the outline as a polygon of whole nanometres. Arcs are cut into chords that
 * are off by at most KR_ROOM_OFF; from there on only integers decide.
 *
 * The corners on arcs depend on the C library's sine and cosine, to the last bit of a double; the
 * rounding to nanometres takes that away but one time in a million millions.
 */
#ifndef KR_PORE_ROOM_H
#define KR_PORE_ROOM_H

#include "case.h"

#define KR_ROOM_OFF 1e-7 /* m */

struct kr_room {
    size_t n;          /* sides; 0: the whole rectangle of width by height */
    int64_t (*side)[4]; /* nm: from, to; the outline on the left */
    double area;       /* m^2: of the exact outline */
};

/** The room of a case. Stops (exit 2) where the outline makes no curve. */
struct kr_room kr_room_of(const struct kr_case *c);

/** Whether a place lies within the outline, `distance` or more from every edge; all in nm. */
int kr_room_has(const struct kr_room *room, int64_t x, int64_t y, int64_t distance);

void kr_room_free(struct kr_room *room);

#endif
