/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Cells cut by the horizon. See share.h.
 */
#include "share.h"

#include "base/error.h"
#include "base/memory.h"
#include "ball.h"
#include "disc.h"
#include "solid.h"

#include <math.h>

enum { MOST_CORNERS = 1024 };

static size_t corners_of(const struct kr_nodes *nodes, size_t i) {
    return (size_t)(nodes->first[i + 1] - nodes->first[i]);
}

static const double *corner_of(const struct kr_nodes *nodes, size_t i, size_t k) {
    return nodes->point + (size_t)nodes->dim * (size_t)nodes->vertex[(size_t)nodes->first[i] + k];
}

double kr_share_length(int dim, const double *vector) {
    return dim == 2 ? hypot(vector[0], vector[1])
                    : sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
}

/* The corners of cell j as seen from a place. */
static void seen_from(const struct kr_nodes *nodes, size_t j, const double *here, double *corner) {
    size_t dim = (size_t)nodes->dim, n = corners_of(nodes, j);
    for (size_t k = 0; k < n; k++)
        for (size_t d = 0; d < dim; d++)
            corner[dim * k + d] = corner_of(nodes, j, k)[d] - here[d];
}

/* Of the circle or sphere about the node that holds its cell. The middles of bent faces may lie
 * beyond the corners. */
static double radius_of(const struct kr_nodes *nodes, size_t i) {
    double corner[3 * MOST_CORNERS], radius = 0;
    size_t dim = (size_t)nodes->dim, n = corners_of(nodes, i);
    seen_from(nodes, i, nodes->position + dim * i, corner);
    for (size_t k = 0; k < n; k++)
        radius = fmax(radius, kr_share_length(nodes->dim, corner + dim * k));
    return dim == 3 ? kr_solid_radius(n, corner, radius) : radius;
}

static void check_corners(const struct kr_nodes *nodes, size_t i) {
    size_t n = corners_of(nodes, i);
    if (n > MOST_CORNERS || (nodes->dim == 3 && !kr_solid_n_faces(n)))
        kr_stop(KR_EXIT_INPUT, "the cell of node %zu has %zu corners; expected %s", i, n,
                nodes->dim == 2 ? "at most 1024"
                                : "those of a tetrahedron, pyramid, wedge, hexahedron or of at "
                                  "most 256 tetrahedra");
}

/* The outsides of the polyhedra, which have a third or so of the sides of their tetrahedra. */
static void find_outsides(struct kr_shares *s) {
    const struct kr_nodes *nodes = s->nodes;
    size_t sides = 0;
    for (size_t i = 0; i < nodes->n; i++)
        sides += kr_solid_is_pieces(corners_of(nodes, i)) ? corners_of(nodes, i) : 0;
    if (!sides)
        return;
    s->first_side = KR_NEW(size_t, nodes->n + 1);
    s->side = KR_NEW(unsigned short, 3 * sides);
    for (size_t i = 0; i < nodes->n; i++) {
        size_t n = corners_of(nodes, i), first = s->first_side[i];
        s->first_side[i + 1] = first;
        if (kr_solid_is_pieces(n))
            s->first_side[i + 1] +=
                kr_solid_outside(n, nodes->vertex + nodes->first[i], s->side + 3 * first);
    }
}

struct kr_shares *kr_shares_create(const struct kr_nodes *nodes, double horizon) {
    struct kr_shares *s = KR_NEW(struct kr_shares, 1);
    if (!nodes->n_points)
        kr_stop(KR_EXIT_INPUT, "exact partial volumes need the cells of the nodes, and these came "
                               "without; take nodes.partial_volume: hhb, or make the nodes from a "
                               "mesh");
    *s = (struct kr_shares){.nodes = nodes, .horizon = horizon, .radius = KR_NEW(double, nodes->n)};
    for (size_t i = 0; i < nodes->n; i++) {
        check_corners(nodes, i);
        s->radius[i] = radius_of(nodes, i);
    }
    if (nodes->dim == 3)
        find_outsides(s);
    return s;
}

void kr_shares_free(struct kr_shares *s) {
    if (!s)
        return;
    kr_free(s->radius);
    kr_free(s->first_side);
    kr_free(s->side);
    kr_free(s);
}

/* ---- cells cut by the horizon ---- */

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* 1 if a solid within the hull of its corners is all inside the sphere, -1 if all beyond the plane
 * that touches the sphere in the direction of xi; 0 if neither. */
static int side_of(size_t n, const double *corner, const double *xi, double length,
                   double horizon) {
    double farthest = 0, least = INFINITY;
    for (size_t k = 0; k < n; k++) {
        farthest = fmax(farthest, dot(corner + 3 * k, corner + 3 * k));
        least = fmin(least, dot(corner + 3 * k, xi));
    }
    return farthest <= horizon * horizon ? 1 : least >= horizon * length ? -1 : 0;
}

static struct kr_share over_area(struct kr_disc_part part, double area) {
    return (struct kr_share){part.area / area, {part.moment[0] / area, part.moment[1] / area, 0}};
}

static struct kr_share over_volume(struct kr_ball_part part, double volume) {
    return (struct kr_share){
        part.volume / volume,
        {part.moment[0] / volume, part.moment[1] / volume, part.moment[2] / volume}};
}

/* The part of cell j inside the sphere about the origin. */
static struct kr_ball_part ball_part(const struct kr_shares *s, size_t j, size_t n,
                                     const double *corner) {
    struct kr_ball_part sum = {0};
    double triangle[9];
    if (!kr_solid_is_pieces(n))
        return kr_ball_solid(n, corner, s->horizon);
    for (size_t k = s->first_side[j]; k < s->first_side[j + 1]; k++) {
        for (size_t c = 0; c < 9; c++)
            triangle[c] = corner[3 * (size_t)s->side[3 * k + c / 3] + c % 3];
        kr_ball_add_face(3, triangle, s->horizon, &sum);
    }
    return sum;
}

struct kr_share kr_shares_of(const struct kr_shares *s, size_t i, size_t j) {
    const struct kr_nodes *nodes = s->nodes;
    size_t dim = (size_t)nodes->dim, n = corners_of(nodes, j);
    const double *here = nodes->position + dim * i, *there = nodes->position + dim * j;
    double xi[3] = {there[0] - here[0], there[1] - here[1], dim == 3 ? there[2] - here[2] : 0};
    double distance = kr_share_length(nodes->dim, xi), corner[3 * MOST_CORNERS];
    const struct kr_share whole = {1, {xi[0], xi[1], xi[2]}};
    if (distance + s->radius[j] <= s->horizon)
        return whole;
    if (distance - s->radius[j] >= s->horizon)
        return (struct kr_share){0};
    seen_from(nodes, j, here, corner);
    /* Flat faces, or fans about the mean of four corners: no middles of edges. */
    int side = dim == 3 && (n <= 8 || kr_solid_is_pieces(n)) ? side_of(n, corner, xi, distance, s->horizon) : 0;
    if (side)
        return side > 0 ? whole : (struct kr_share){0};
    return dim == 2 ? over_area(kr_disc_polygon(n, corner, s->horizon), nodes->volume[j])
                    : over_volume(ball_part(s, j, n, corner), nodes->volume[j]);
}

struct kr_share kr_share_of_lattice(int dim, const double xi[3], double horizon, double spacing) {
    const double distance = kr_share_length(dim, xi), half_diagonal = 0.5 * sqrt(dim) * spacing;
    if (distance - half_diagonal >= horizon)
        return (struct kr_share){0};
    if (distance + half_diagonal <= horizon)
        return (struct kr_share){1, {xi[0], xi[1], xi[2]}};
    return dim == 2 ? over_area(kr_disc_square(xi, spacing, horizon), spacing * spacing)
                    : over_volume(kr_ball_cube(xi, spacing, horizon), pow(spacing, 3));
}

/* If no corner is outside of a square of the cell's area, the cell is the square. */
int kr_shares_is_square(const struct kr_shares *s, size_t i, double spacing) {
    size_t dim = (size_t)s->nodes->dim;
    for (size_t k = 0; k < corners_of(s->nodes, i); k++)
        for (size_t d = 0; d < dim; d++)
            if (fabs(corner_of(s->nodes, i, k)[d] - s->nodes->position[dim * i + d]) >
                0.5 * spacing * (1 + 1e-9))
                return 0;
    return 1;
}
