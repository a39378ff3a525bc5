/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The outline in whole nanometres. Products of two lengths fill 64 bits, sums of such products 128.
 */
#include "pore_room.h"

#include "base/memory.h"
#include "outline.h"

#include <math.h>

/* Curves are made in millimetres, whatever the spacing of the grid: a finer grid has the same
   pores. */
static const double UNIT = 1e-3, NANOMETRES_A_UNIT = 1e6;

__extension__ typedef __int128 wide;

static int64_t in_nanometres(double units) {
    return llround(units * NANOMETRES_A_UNIT);
}

/** Chords of a piece: the sagitta of an ellipse's arc is at most (longer half axis) angle^2/8. */
static size_t chords_of(const struct kr_piece *piece) {
    if (!piece->is_arc)
        return 1;
    double axis = hypot(hypot(piece->a[0], piece->a[1]), hypot(piece->b[0], piece->b[1]));
    return 1 + (size_t)(fabs(piece->t1 - piece->t0) * sqrt(axis * UNIT / (8 * KR_ROOM_OFF)));
}

static void add_sides(struct kr_room *room, size_t *space, const struct kr_piece *piece) {
    size_t chords = chords_of(piece);
    int64_t from[2] = {in_nanometres(piece->from[0]), in_nanometres(piece->from[1])};
    for (size_t k = 1; k <= chords; k++) {
        double at[2] = {piece->to[0], piece->to[1]};
        if (k < chords)
            kr_piece_at(piece, (double)k / (double)chords, at, NULL);
        KR_GROW(room->side, room->n, *space);
        int64_t *side = room->side[room->n++];
        for (int d = 0; d < 2; d++) {
            side[d] = from[d];
            side[2 + d] = from[d] = in_nanometres(at[d]);
        }
    }
}

struct kr_room kr_room_of(const struct kr_case *c) {
    struct kr_room room = {.area = c->width * c->height};
    size_t space = 0;
    if (kr_case_is_rectangle(&c->outline))
        return room;
    struct kr_layers layers = kr_layers_of(&c->outline, c->width, c->height, UNIT, NULL);
    struct kr_shape body = kr_shape_cut(layers.n_layers, layers.layer);
    room.area = kr_shape_area(&body) * UNIT * UNIT;
    for (size_t k = 0; k < body.n_curves; k++)
        for (size_t p = 0; p < body.curve[k].n; p++)
            add_sides(&room, &space, &body.curve[k].piece[p]);
    kr_shape_free(&body);
    kr_layers_free(&layers);
    return room;
}

/** Least whole number whose square is not below one of up to 124 bits. */
static int64_t root_up(wide square) {
    int64_t root = (int64_t)sqrtl((long double)square);
    while ((wide)root * root >= square && root > 0)
        root--;
    while ((wide)root * root < square)
        root++;
    return root;
}

static int is_far(const int64_t *side, int64_t x, int64_t y, int64_t distance) {
    int64_t px = x - side[0], py = y - side[1], qx = side[2] - side[0], qy = side[3] - side[1];
    wide along = (wide)px * qx + (wide)py * qy, length = (wide)qx * qx + (wide)qy * qy;
    wide least = (wide)distance * distance;
    if (along <= 0)
        return (wide)px * px + (wide)py * py >= least;
    if (along >= length) {
        px = x - side[2];
        py = y - side[3];
        return (wide)px * px + (wide)py * py >= least;
    }
    wide cross = (wide)qx * py - (wide)qy * px;
    return (cross < 0 ? -cross : cross) >= (wide)distance * root_up(length);
}

int kr_room_has(const struct kr_room *room, int64_t x, int64_t y, int64_t distance) {
    int inside = 0;
    for (size_t k = 0; k < room->n; k++) {
        const int64_t *s = room->side[k];
        if (!is_far(s, x, y, distance))
            return 0;
        if ((s[1] > y) == (s[3] > y))
            continue;
        /* Whether the side passes to the right: x < x_side, times the height of the side. */
        wide left = (wide)(x - s[0]) * (s[3] - s[1]), right = (wide)(s[2] - s[0]) * (y - s[1]);
        inside ^= s[3] > s[1] ? left < right : left > right;
    }
    return inside || room->n == 0;
}

void kr_room_free(struct kr_room *room) {
    kr_free(room->side);
    *room = (struct kr_room){0};
}
