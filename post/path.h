/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The path of a tip as a curve, its way along it in time, and its speed.
 *
 *   centre line  c(l), l the length from the source (front.h): a straight line fitted to the nodes
 *                within one horizon of l, weights (1 - (d/horizon)^3)^3; its value at l
 *                (Cleveland, J. Am. Stat. Assoc. 74, 1979)
 *   place        s of a node: arc length of the nearest point of the centre line
 *   tip          F(t) = max s of the nodes with arrival <= t; a move is a time at which it grows
 *   speed        T(s) = a + b (s - s0) + q (s - s0)^2 fitted to the moves within three horizons of s0:
 *                v(s0) = 1/b, with the standard error of b over b^2. Where b is below a third of the
 *                mean slope (a stop within the window) the straight line is fitted instead. Moves
 *                within a horizon share bonds and are late or early together: residuals count as
 *                one a horizon, not as one a move.
 */
#ifndef KR_PATH_H
#define KR_PATH_H

#include "front.h"

struct kr_move {
    double time;         /* s */
    double s;            /* m, from the begin of the path */
    double x[2];         /* m */
    double angle;        /* rad */
    double speed, error; /* m/s; NaN where the fit has too few moves */
    double front_energy; /* J/m^2; NaN: unknown */
    int is_alone;        /* one tip's doing (kr_legs_tell_alone); others have no speed and no part in
                            that of others */
};

struct kr_path {
    size_t n;         /* corners of the centre line */
    double *x;        /* (n x 2) m */
    double *s;        /* (n) m: arc length */
    double *length;   /* (n) m: l */
    size_t count;
    struct kr_move *move; /* (count) in the order of time and of s */
};

/** Lay the centre line through nodes (sorted by length, at least one) of a front in 2D. `anchor`, if
 *  given, is the point where the path begins instead. */
void kr_path_lay(const struct kr_front *front, size_t count, const size_t *node,
                 const double *anchor, struct kr_path *path);

/** Arc length [m] of the point of the centre line nearest to a node, at least 0; beyond the last
 *  corner the last piece goes on straight. `away`, if given, gets the distance [m]. */
double kr_path_place(const struct kr_front *front, const struct kr_path *path, size_t node,
                     double *away);

/** Arc length [m] of the point of the centre line, from the arc length `from` on, that is nearest to x;
 *  `away` gets the distance [m]. */
double kr_path_nearest(const struct kr_path *path, double from, const double x[2], double *away);

/** The point [m] at an arc length. */
void kr_path_point(const struct kr_path *path, double s, double x[2]);

/** Find the moves and their speeds from the nodes that lie beside the path; alone (front's n): which
 *  nodes tell of this tip alone. */
void kr_path_follow(const struct kr_front *front, size_t count, const size_t *node,
                    const char *alone, struct kr_path *path);

void kr_path_clear(struct kr_path *path);

/** Half of the length of path that a speed is fitted over [m]. */
double kr_path_window(const struct kr_record *record);

#endif
