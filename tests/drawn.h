/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Damage drawn by hand for tests of the crack tree: a plate of 40 mm x 20 mm with nodes 0.1 mm apart,
 * on a lattice or shaken by up to 0.2 spacings, horizon 0.4 mm, steps of 0.02 us; cracks along
 * polylines. All places are given before the plate is turned.
 */
#ifndef KR_DRAWN_H
#define KR_DRAWN_H

#include "record.h"
#include "test.h"

enum { DRAWN_COLUMNS = 400, DRAWN_ROWS = 200, DRAWN_STEPS = 5000 };
#define DRAWN_SPACING 1e-4
#define DRAWN_STEP 2e-8

/** A kind of plate: nodes at random places or not, turned about the origin. */
struct drawn_kind {
    int shaken;
    double angle; /* rad */
};

/** A crack along the corners at[0..n-1] from `start` on with speed + acceleration * time; speed 0: a
 *  pre-crack. */
struct drawn_crack {
    int n;
    double at[64][2];
    double start, speed, acceleration;
};

static inline double drawn_shake(int shaken) {
    return shaken ? 0.2 * DRAWN_SPACING * (2.0 * rand() / RAND_MAX - 1) : 0;
}

/** A plate without damage. Its hole 1 (radius 0: none) has a rim one spacing wide. */
static inline struct kr_record *drawn_plate(struct drawn_kind kind, double hole_x, double hole_y,
                                            double radius) {
    const size_t most = DRAWN_COLUMNS * DRAWN_ROWS;
    struct kr_record *r = KR_NEW(struct kr_record, 1);
    *r = (struct kr_record){.dim = 2,
                            .position = KR_NEW(double, 2 * most),
                            .volume = KR_NEW(double, most),
                            .damage_time = KR_NEW(double, most),
                            .rim = KR_NEW(int, most)};
    srand(7);
    for (int k = 0; k < DRAWN_COLUMNS * DRAWN_ROWS; k++) {
        int column = k % DRAWN_COLUMNS, row = k / DRAWN_COLUMNS;
        double x = (column + 0.5) * DRAWN_SPACING + drawn_shake(kind.shaken);
        double y = (row + 0.5) * DRAWN_SPACING + drawn_shake(kind.shaken);
        double off = hypot(x - hole_x, y - hole_y);
        if (off < radius)
            continue;
        if (column == 0 || row == 0 || column == DRAWN_COLUMNS - 1 || row == DRAWN_ROWS - 1)
            r->rim[r->n] = KR_RIM_BOUNDARY;
        if (off < radius + DRAWN_SPACING && radius > 0)
            r->rim[r->n] = 1;
        r->position[2 * r->n] = x;
        r->position[2 * r->n + 1] = y;
        r->volume[r->n] = DRAWN_SPACING * DRAWN_SPACING;
        r->damage_time[r->n++] = INFINITY;
    }
    r->time_step = DRAWN_STEP;
    r->steps = DRAWN_STEPS;
    r->finished = 1;
    r->spacing = DRAWN_SPACING;
    r->horizon = 4 * DRAWN_SPACING;
    r->rayleigh_speed = 929;
    r->fracture_energy = 200;
    r->density = 1190;
    r->first_break = INFINITY;
    return r;
}

/** Arc length along a crack of the point nearest to x, and its distance. */
static inline double drawn_place(const struct drawn_crack *crack, const double *x, double *away) {
    double s = 0, before = 0;
    *away = INFINITY;
    for (int k = 0; k + 1 < crack->n; k++) {
        const double *a = crack->at[k], *b = crack->at[k + 1];
        double length = hypot(b[0] - a[0], b[1] - a[1]);
        double e[2] = {(b[0] - a[0]) / length, (b[1] - a[1]) / length};
        double along = (x[0] - a[0]) * e[0] + (x[1] - a[1]) * e[1];
        double part = fmin(fmax(along, 0), length);
        double off = hypot(a[0] + part * e[0] - x[0], a[1] + part * e[1] - x[1]);
        if ((k == 0 && along < 0) || (k + 2 == crack->n && along > length))
            off = fmax(off, 2 * DRAWN_SPACING); /* ends are cut off square */
        if (off < *away) {
            *away = off;
            s = before + part;
        }
        before += length;
    }
    return s;
}

/** The point of a crack at an arc length. */
static inline void drawn_point(const struct drawn_crack *crack, double s, double x[2]) {
    x[0] = x[1] = NAN;
    for (int k = 0; k + 1 < crack->n; k++) {
        const double *a = crack->at[k], *b = crack->at[k + 1];
        double length = hypot(b[0] - a[0], b[1] - a[1]);
        if (s <= length || k + 2 == crack->n) {
            x[0] = a[0] + (b[0] - a[0]) * s / length;
            x[1] = a[1] + (b[1] - a[1]) * s / length;
            return;
        }
        s -= length;
    }
}

static inline double drawn_length(const struct drawn_crack *crack) {
    double length = 0;
    for (int k = 0; k + 1 < crack->n; k++)
        length += hypot(crack->at[k + 1][0] - crack->at[k][0],
                        crack->at[k + 1][1] - crack->at[k][1]);
    return length;
}

/** Time at which the crack is at an arc length. */
static inline double drawn_time(const struct drawn_crack *crack, double s) {
    const double v = crack->speed, a = crack->acceleration;
    return crack->start + (a != 0 ? (sqrt(v * v + 2 * a * s) - v) / a : s / v);
}

static inline double drawn_speed(const struct drawn_crack *crack, double s) {
    return sqrt(crack->speed * crack->speed + 2 * crack->acceleration * s);
}

/** Damage the nodes within one spacing, each at a whole step. */
static inline void drawn_add(struct kr_record *r, const struct drawn_crack *crack) {
    for (size_t i = 0; i < r->n; i++) {
        double away, s = drawn_place(crack, r->position + 2 * i, &away), time = -1;
        if (away > DRAWN_SPACING)
            continue;
        if (crack->speed > 0) {
            time = DRAWN_STEP * ceil(drawn_time(crack, s) / DRAWN_STEP);
            r->first_break = fmin(r->first_break, time);
        }
        r->damage_time[i] = fmin(r->damage_time[i], time);
    }
}

/** Turn the finished plate; `back` for a point of the result. */
static inline void drawn_turn(struct kr_record *r, double angle) {
    for (size_t i = 0; i < r->n; i++) {
        double x = r->position[2 * i], y = r->position[2 * i + 1];
        r->position[2 * i] = cos(angle) * x - sin(angle) * y;
        r->position[2 * i + 1] = sin(angle) * x + cos(angle) * y;
    }
}

static inline void drawn_back(const double x[2], double angle, double y[2]) {
    y[0] = cos(angle) * x[0] + sin(angle) * x[1];
    y[1] = cos(angle) * x[1] - sin(angle) * x[0];
}

#endif
