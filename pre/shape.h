/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Plane shapes with exact edges: closed curves of straight pieces and arcs of ellipses. Circles,
 * ellipses, slots, polygons with or without rounded corners, discs and rings are all made of
 * these two; so are the outlines that are left when holes cut each other or the edge.
 *
 * A curve has what it bounds on its left. All lengths are in spacings of the lattice, its points
 * at whole numbers: absolute tolerances then mean the same for every plate.
 */
#ifndef KR_SHAPE_H
#define KR_SHAPE_H

#include "case.h"

#include <stddef.h>

/** A straight piece, or the arc  centre + a cos t + b sin t,  t from t0 to t1 (either way). */
struct kr_piece {
    double from[2], to[2]; /* its ends; those of neighbours are equal to the last bit */
    int is_arc;
    double centre[2], a[2], b[2], t0, t1;
    int group; /* boundary that it belongs to */
};

struct kr_curve {
    size_t n;
    struct kr_piece *piece;
};

struct kr_shape {
    size_t n_curves;
    struct kr_curve *curve;
};

/* Places nearer than this are one: far above the rounding of lengths below 1e5 spacings, far below
 * anything that somebody means. */
#define KR_SHAPE_SAME 1e-8

/** Curve of a hole of the deck, counter-clockwise, all pieces of one group. Stops (exit 2) where
 *  the description makes none: `name` begins the sentence. */
struct kr_curve kr_curve_of_hole(const struct kr_case_hole *hole, double spacing, int group,
                                 const char *name);

/** A rectangle from (0, 0) to (width, height), spacings; its sides are the groups 0 (left),
 *  1 (right), 2 (bottom) and 3 (top). */
struct kr_curve kr_curve_frame(double width, double height);

/** Point at share u (0 to 1) of a piece's parameter, and the direction there (not normalised). */
void kr_piece_at(const struct kr_piece *piece, double u, double point[2], double direction[2]);

double kr_piece_length(const struct kr_piece *piece);

/** The piece walked the other way. */
struct kr_piece kr_piece_reversed(const struct kr_piece *piece);

/** The part of a piece between the shares u0 < u1, with the ends given. */
struct kr_piece kr_piece_part(const struct kr_piece *piece, double u0, double u1,
                              const double from[2], const double to[2]);

/** Distance of a point from a piece. */
double kr_piece_distance(const struct kr_piece *piece, const double point[2]);

/** Lower left and upper right corner of the box around a piece or a curve. */
void kr_piece_box(const struct kr_piece *piece, double box[4]);
void kr_curve_box(const struct kr_curve *curve, double box[4]);

/** Exact area, positive where the curve goes round counter-clockwise. */
double kr_curve_area(const struct kr_curve *curve);
double kr_shape_area(const struct kr_shape *shape);

/** Places where a horizontal line meets a piece: at most two, written to x. A piece holds its lower
 *  end and not its upper one, so that a closed curve is met an even number of times. */
int kr_piece_crossings(const struct kr_piece *piece, double y, double x[2]);

/** Whether a point lies inside a closed curve; either on its edge. */
int kr_curve_holds(const struct kr_curve *curve, const double point[2]);

void kr_curve_reverse(struct kr_curve *curve);
void kr_curve_free(struct kr_curve *curve);
void kr_shape_free(struct kr_shape *shape);

/** What a body is made of: what an odd number of its curves hold, joined to the layers before it or
 *  taken away from them. */
struct kr_layer {
    struct kr_shape shape; /* each curve counter-clockwise */
    int is_cut;            /* taken away */
};

/** The body that layers make in turn; they may overlap, touch along edges and cut each other. Every
 *  curve has the body on its left. Edges that two layers share are of the group of the first. */
struct kr_shape kr_shape_cut(size_t n, const struct kr_layer *layer);

/** Where two pieces meet: shares of both (u in the first, v in the second) and the points, at most
 *  16. Where they run along each other, the ends of that stretch. Used by kr_shape_cut. */
struct kr_meeting {
    double u, v, point[2];
};
int kr_pieces_meet(const struct kr_piece *p, const struct kr_piece *q, struct kr_meeting at[16]);

#endif
