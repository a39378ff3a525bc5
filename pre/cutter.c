/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The functions of the surfaces.
 */
#include "cutter.h"

#include "cgal_surface.h"
#include "outline.h"

#include <math.h>

static double norm(const double q[3]) {
    return sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
}

static double at_ellipsoid(const struct kr_cutter *c, const double q[3], double *least) {
    double u[3], v[3], shortest = fmin(fmin(c->radii[0], c->radii[1]), c->radii[2]);
    for (int d = 0; d < 3; d++) {
        u[d] = q[d] / c->radii[d];
        v[d] = u[d] / c->radii[d];
    }
    double k0 = norm(u), k1 = norm(v);
    *least = shortest * fabs(k0 - 1); /* k0 grows by 1/shortest a length at most */
    return k1 > 0 ? k0 * (k0 - 1) / k1 : -shortest;
}

static double at_cylinder(const struct kr_cutter *c, const double q[3]) {
    double along = q[0] * c->axis[0] + q[1] * c->axis[1] + q[2] * c->axis[2], across[3];
    for (int d = 0; d < 3; d++)
        across[d] = q[d] - along * c->axis[d];
    double r = norm(across) - c->radius, z = fabs(along) - c->half;
    return r > 0 || z > 0 ? hypot(fmax(r, 0), fmax(z, 0)) : fmax(r, z);
}

/** Whether a piece of a plate's curves is a surface here, and no side of the lattice. */
static int counts(const struct kr_piece *piece) {
    return piece->group >= KR_OUTLINE_SIDES;
}

/** Distance from the nearest curve, and that curve's group. */
static double nearest_piece(const struct kr_plate_body *plate, const double p[3], int *group) {
    double least = INFINITY;
    for (size_t c = 0; c < plate->exact.n_curves; c++)
        for (size_t k = 0; k < plate->exact.curve[c].n; k++) {
            const struct kr_piece *piece = &plate->exact.curve[c].piece[k];
            double distance = counts(piece) ? kr_piece_distance(piece, p) : INFINITY;
            if (distance < least) {
                least = distance;
                *group = piece->group;
            }
        }
    return least;
}

/** Whether a place lies in the plate; one beyond the frame counts as the nearest one within. */
static int is_in_plate(const struct kr_plate_body *plate, const double p[3]) {
    const double inside = 1e-7; /* far above rounding, far below what anybody means */
    const double most[2] = {(double)plate->lattice.columns, (double)plate->lattice.rows};
    double place[2];
    int held = 0;
    for (int d = 0; d < 2; d++)
        place[d] = fmin(fmax(p[d], inside), most[d] - inside);
    for (size_t c = 0; c < plate->exact.n_curves; c++)
        held ^= kr_curve_holds(&plate->exact.curve[c], place);
    return held;
}

double kr_cutter_at(const struct kr_cutter *cutter, const double p[3], double *least) {
    double q[3], value = 0, bound = -1;
    int group;
    for (int d = 0; d < 3; d++)
        q[d] = p[d] - cutter->centre[d];
    switch (cutter->kind) {
    case KR_CUTTER_SPHERE:
        value = norm(q) - cutter->radius;
        break;
    case KR_CUTTER_ELLIPSOID:
        value = at_ellipsoid(cutter, q, &bound);
        break;
    case KR_CUTTER_CYLINDER:
        value = at_cylinder(cutter, q);
        break;
    case KR_CUTTER_STL:
        value = kr_surface_mesh_distance(cutter->surface, p) * (cutter->is_body ? -1 : 1);
        break;
    case KR_CUTTER_PLATE:
        value = nearest_piece(cutter->plate, p, &group) * (is_in_plate(cutter->plate, p) ? 1 : -1);
        break;
    }
    if (least)
        *least = bound >= 0 ? bound : fabs(value);
    return value;
}

int kr_cutter_group(const struct kr_cutter *cutter, const double p[3]) {
    int group = cutter->group;
    if (cutter->kind == KR_CUTTER_PLATE)
        nearest_piece(cutter->plate, p, &group);
    return group;
}

void kr_cutter_box(const struct kr_cutter *cutter, double box[6]) {
    if (cutter->kind == KR_CUTTER_STL && !cutter->is_body) {
        kr_surface_mesh_box(cutter->surface, box);
        return;
    }
    for (int d = 0; d < 3; d++) {
        double u = cutter->axis[d], reach = INFINITY;
        if (cutter->kind == KR_CUTTER_SPHERE)
            reach = cutter->radius;
        else if (cutter->kind == KR_CUTTER_ELLIPSOID)
            reach = cutter->radii[d];
        else if (cutter->kind == KR_CUTTER_CYLINDER)
            reach = cutter->half * fabs(u) + cutter->radius * sqrt(fmax(1 - u * u, 0));
        box[d] = cutter->centre[d] - reach;
        box[3 + d] = cutter->centre[d] + reach;
    }
}

double kr_cutter_volume(const struct kr_cutter *cutter) {
    const double *a = cutter->radii, r = cutter->radius;
    switch (cutter->kind) {
    case KR_CUTTER_SPHERE:
        return 4.0 / 3 * M_PI * r * r * r;
    case KR_CUTTER_ELLIPSOID:
        return 4.0 / 3 * M_PI * a[0] * a[1] * a[2];
    case KR_CUTTER_CYLINDER:
        return M_PI * r * r * 2 * cutter->half;
    case KR_CUTTER_STL:
        return kr_surface_mesh_volume(cutter->surface);
    case KR_CUTTER_PLATE:
        break;
    }
    return 0;
}
