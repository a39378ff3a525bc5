/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Cracks of a solid as sheets: what each damaged node tells of the sheet that it belongs to, from
 * the spread of damage (front.h). Nothing is assumed about where a crack lies or which way it runs.
 *
 *   plane      of a node: through the mean of the damaged nodes within 1.5 horizons, normal to the
 *              direction in which these scatter least (least eigenvector of their second moments)
 *   width      of the damage, w = delta sum_D k V / sum_B k g V over the damaged nodes D and all
 *              nodes B, k = (1 - (r/delta)^2)^2 in the plane and g = 1 - d/delta across: B tells
 *              how much of the disc lies in the body. Where the front cuts D off (its mean is
 *              farther than delta/10 from that of B), the mean w of nodes nearby where it does not,
 *              else of all such
 *   area       of a node: V/w, w at least V^(1/3). Damage beside a crack makes w larger, and the
 *              area no larger
 *   time       T = a + b.u + u.Q u over the damage of the same crack within W = 2 delta, u in the
 *              plane, weights (1 - (u/W)^2)^2: there the front passed at a, with the speed 1/|b|
 *              along b/|b|; its error as in path.h, damage within a horizon counting as one. A front
 *              with a radius R seems faster by 0.05 (W/R)^2: what the cone T = r/v leaves of the
 *              second order
 */
#ifndef KR_SHEET_H
#define KR_SHEET_H

#include "front.h"

/** Of a damaged node; one of the pre-crack has an area of 0 and no time. Specks count, too:
 * ligaments between voids may be shorter than three horizons. */
struct kr_patch {
    double x[3], normal[3]; /* m: nearest point of the plane; of length 1 */
    double width;           /* m: w */
    double area;            /* m^2 */
    double time;            /* s; NaN where the fit has too few nodes */
    double along[3];        /* of length 1: where the front went */
    double speed, error;    /* m/s; NaN where the fit has too few nodes */
};

struct kr_sheet {
    struct kr_front *front;
    struct kr_patch *patch; /* (front->n) */
};

/** A point of a front. */
struct kr_sheet_point {
    size_t curve; /* from 1: a front may be in pieces */
    size_t patch; /* of the node that tells of it */
    double x[3];  /* m */
};

/** Find the sheets of a record in 3D, which must outlive them. */
struct kr_sheet *kr_sheet_create(const struct kr_record *record);
void kr_sheet_free(struct kr_sheet *sheet);

/** When the front came to a node [s]: its arrival, in a speck the time of its damage. */
double kr_sheet_when(const struct kr_sheet *sheet, size_t i);

/** Steps of kr_sheet_create: planes, widths and areas; times and speeds. */
void kr_sheet_lay(struct kr_sheet *sheet);
void kr_sheet_time(struct kr_sheet *sheet);

/** Area [m^2] that the front has run over up to a time. */
double kr_sheet_area(const struct kr_sheet *sheet, double time);

/** Mean speed [m/s] of the front: the area over the sum of area/speed, so that what broke at once
 *  counts little; NaN where nowhere is a speed. */
double kr_sheet_mean_speed(const struct kr_sheet *sheet);

/** The front at a time: the points that patches say it passed then, about a spacing apart, in order
 * along each curve. Parts that stand have none. Owned by the caller. */
struct kr_sheet_point *kr_sheet_front(const struct kr_sheet *sheet, double time, size_t *count);

/** Write front.csv at some 60 times, whole numbers of steps apart, and area.csv, at most 200 lines.
 * Stop (exit 3) where they cannot be written. */
void kr_sheet_write_front(const struct kr_sheet *sheet, const char *path);
void kr_sheet_write_area(const struct kr_sheet *sheet, const char *path);

#endif
