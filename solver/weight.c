/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Weights that hang on more than two sizes: cells cut by the horizon, and surface factors that are
 * not simply averaged. See weight.h.
 */
#include "weight.h"

#include "base/error.h"
#include "base/memory.h"
#include "ball.h"
#include "disc.h"
#include "solid.h"

#include <string.h>

/* MOST_NEAR as in bonds.c, which stops where a node has more; MOST_KEPT: 0.8 GB of weights. */
enum { MOST_CORNERS = 1024, MOST_NEAR = 4096, MOST_KEPT = 100000000 };

/* Shares below this are rounding of cells that the circle only touches. */
static const double LEAST = 1e-12;

static int is_exact(int partial_volume) {
    return partial_volume == KR_PARTIAL_VOLUME_EXACT ||
           partial_volume == KR_PARTIAL_VOLUME_EXACT_CENTROID;
}

int kr_weights_choose(struct kr_deck *deck, const struct kr_case *c, const struct kr_nodes *nodes) {
    if (nodes->n_points > 0 || !is_exact(c->partial_volume))
        return c->partial_volume;
    if (kr_deck_given(deck, &c->partial_volume))
        kr_deck_fault(deck, &c->partial_volume,
                      "exact shares need the cells of a mesh, and these nodes have none; take hhb");
    return KR_PARTIAL_VOLUME_HHB;
}

static size_t corners_of(const struct kr_nodes *nodes, size_t i) {
    return (size_t)(nodes->first[i + 1] - nodes->first[i]);
}

static const double *corner_of(const struct kr_nodes *nodes, size_t i, size_t k) {
    return nodes->point + (size_t)nodes->dim * (size_t)nodes->vertex[(size_t)nodes->first[i] + k];
}

static double length_of(int dim, const double *vector) {
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
        radius = fmax(radius, length_of(nodes->dim, corner + dim * k));
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

static void measure_cells(struct kr_weights *w) {
    const struct kr_nodes *nodes = w->nodes;
    if (!nodes->n_points)
        kr_stop(KR_EXIT_INPUT, "exact partial volumes need the cells of the nodes, and these came "
                               "without; take nodes.partial_volume: hhb, or make the nodes from a "
                               "mesh");
    w->radius = KR_NEW(double, nodes->n);
    w->reach = 0;
    for (size_t i = 0; i < nodes->n; i++) {
        check_corners(nodes, i);
        w->radius[i] = radius_of(nodes, i);
        w->reach = fmax(w->reach, w->horizon + w->radius[i]);
    }
}

/* The outsides of the polyhedra, which have a third or so of the sides of their tetrahedra. */
static void find_outsides(struct kr_weights *w) {
    const struct kr_nodes *nodes = w->nodes;
    size_t sides = 0;
    for (size_t i = 0; i < nodes->n; i++)
        sides += kr_solid_is_pieces(corners_of(nodes, i)) ? corners_of(nodes, i) : 0;
    if (!sides)
        return;
    w->first_side = KR_NEW(size_t, nodes->n + 1);
    w->side = KR_NEW(unsigned short, 3 * sides);
    for (size_t i = 0; i < nodes->n; i++) {
        size_t n = corners_of(nodes, i), first = w->first_side[i];
        w->first_side[i + 1] = first;
        if (kr_solid_is_pieces(n))
            w->first_side[i + 1] +=
                kr_solid_outside(n, nodes->vertex + nodes->first[i], w->side + 3 * first);
    }
}

struct kr_weights *kr_weights_create(const struct kr_nodes *nodes, double horizon,
                                     int partial_volume) {
    struct kr_weights *w = KR_NEW(struct kr_weights, 1);
    double largest = 0;
    *w = (struct kr_weights){.nodes = nodes, .partial_volume = partial_volume, .horizon = horizon};
    w->size = KR_NEW(double, nodes->n);
    for (size_t i = 0; i < nodes->n; i++) {
        w->size[i] = nodes->dim == 2 ? sqrt(nodes->volume[i]) : cbrt(nodes->volume[i]);
        largest = fmax(largest, w->size[i]);
    }
    w->reach = kr_weight_reach(partial_volume, horizon, largest);
    if (is_exact(partial_volume))
        measure_cells(w);
    if (is_exact(partial_volume) && nodes->dim == 3)
        find_outsides(w);
    return w;
}

void kr_weights_free(struct kr_weights *w) {
    kr_free(w->size);
    kr_free(w->radius);
    kr_free(w->first_side);
    kr_free(w->side);
    kr_free(w->first_kept);
    kr_free(w->kept_with);
    kr_free(w->kept);
    kr_free(w);
}

/* ---- cells cut by the horizon ---- */

/* A part of a cell over the cell's volume: the share, and its moment about the node that looks. */
struct part {
    double share, moment[3];
};

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

static struct part over_area(struct kr_disc_part part, double area) {
    return (struct part){part.area / area, {part.moment[0] / area, part.moment[1] / area, 0}};
}

static struct part over_volume(struct kr_ball_part part, double volume) {
    return (struct part){
        part.volume / volume,
        {part.moment[0] / volume, part.moment[1] / volume, part.moment[2] / volume}};
}

/* The part of cell j inside the sphere about the origin. */
static struct kr_ball_part ball_part(const struct kr_weights *w, size_t j, size_t n,
                                     const double *corner) {
    struct kr_ball_part sum = {0};
    double triangle[9];
    if (!kr_solid_is_pieces(n))
        return kr_ball_solid(n, corner, w->horizon);
    for (size_t k = w->first_side[j]; k < w->first_side[j + 1]; k++) {
        for (size_t c = 0; c < 9; c++)
            triangle[c] = corner[3 * (size_t)w->side[3 * k + c / 3] + c % 3];
        kr_ball_add_face(3, triangle, w->horizon, &sum);
    }
    return sum;
}

static struct part part_of(const struct kr_weights *w, size_t i, size_t j) {
    const struct kr_nodes *nodes = w->nodes;
    size_t dim = (size_t)nodes->dim, n = corners_of(nodes, j);
    const double *here = nodes->position + dim * i, *there = nodes->position + dim * j;
    double xi[3] = {there[0] - here[0], there[1] - here[1], dim == 3 ? there[2] - here[2] : 0};
    double distance = length_of(nodes->dim, xi), corner[3 * MOST_CORNERS];
    const struct part whole = {1, {xi[0], xi[1], xi[2]}};
    if (distance + w->radius[j] <= w->horizon)
        return whole;
    if (distance - w->radius[j] >= w->horizon)
        return (struct part){0};
    seen_from(nodes, j, here, corner);
    /* Flat faces, or fans about the mean of four corners: no middles of edges. */
    int side = dim == 3 && (n <= 8 || kr_solid_is_pieces(n)) ? side_of(n, corner, xi, distance, w->horizon) : 0;
    if (side)
        return side > 0 ? whole : (struct part){0};
    return dim == 2 ? over_area(kr_disc_polygon(n, corner, w->horizon), nodes->volume[j])
                    : over_volume(ball_part(w, j, n, corner), nodes->volume[j]);
}

/* The bond's weight from what each end sees of the other: the mean of both, (10a); with the
 * centroids of the parts, the mean moment over the bond's length, (10b). Sums and differences of
 * two numbers: the same bits from both ends. */
static double weight_of(int partial_volume, const struct part *there, const struct part *back,
                        double distance) {
    double phi = 0.5 * (there->share + back->share), moment[3];
    if (phi < LEAST || (there->share == 1 && back->share == 1))
        return phi < LEAST ? 0 : 1;
    if (partial_volume == KR_PARTIAL_VOLUME_EXACT)
        return phi;
    for (int d = 0; d < 3; d++)
        moment[d] = there->moment[d] - back->moment[d];
    return 0.5 * length_of(3, moment) / distance;
}

double kr_weights_share(const struct kr_weights *w, size_t i, size_t j) {
    return part_of(w, i, j).share;
}

/* Of bonds that no cell's radius decides. */
static double phi_at_rim(const struct kr_weights *w, size_t i, size_t j, double distance) {
    struct part there = part_of(w, i, j), back = part_of(w, j, i);
    return weight_of(w->partial_volume, &there, &back, distance);
}

/* 1 if the horizon of either end holds the other cell, 0 if it misses it, -1 where it may cut it. */
static int phi_by_radius(const struct kr_weights *w, size_t i, size_t j, double distance) {
    double larger = fmax(w->radius[i], w->radius[j]);
    return distance + larger <= w->horizon ? 1 : distance - larger >= w->horizon ? 0 : -1;
}

static const float *kept_at(const struct kr_weights *w, size_t i, size_t j) {
    size_t low = w->first_kept[i], high = w->first_kept[i + 1];
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if ((size_t)w->kept_with[middle] < j)
            low = middle + 1;
        else
            high = middle;
    }
    return low < w->first_kept[i + 1] && (size_t)w->kept_with[low] == j ? &w->kept[low] : NULL;
}

double kr_weights_phi(const struct kr_weights *w, size_t i, size_t j, double distance) {
    if (!is_exact(w->partial_volume))
        return kr_weight(w->partial_volume, distance, w->horizon, w->size[i], w->size[j]);
    int known = phi_by_radius(w, i, j, distance);
    if (known >= 0)
        return known;
    const float *kept = w->kept ? kept_at(w, i < j ? i : j, i < j ? j : i) : NULL;
    return kept ? *kept : phi_at_rim(w, i, j, distance);
}

/* The bonds from i to higher nodes that phi_by_radius does not decide: counts them, or fills them in. */
static size_t keep_of(struct kr_weights *w, const struct kr_search *search,
                      const unsigned char *on_lattice, size_t i, int *near, int fill) {
    const struct kr_nodes *nodes = w->nodes;
    size_t n = kr_search_near(search, i, near, MOST_NEAR), count = 0, dim = (size_t)nodes->dim;
    for (size_t k = 0; k < n && k < MOST_NEAR; k++) {
        size_t j = (size_t)near[k];
        double xi[3] = {0};
        if (j < i || (on_lattice[i] && on_lattice[j]))
            continue;
        for (size_t d = 0; d < dim; d++)
            xi[d] = nodes->position[dim * j + d] - nodes->position[dim * i + d];
        double distance = length_of(nodes->dim, xi);
        if (phi_by_radius(w, i, j, distance) >= 0)
            continue;
        if (fill) {
            w->kept_with[w->first_kept[i] + count] = near[k];
            w->kept[w->first_kept[i] + count] = (float)phi_at_rim(w, i, j, distance);
        }
        count++;
    }
    return count;
}

static void keep_all(struct kr_weights *w, const struct kr_search *search,
                     const unsigned char *on_lattice, int fill) {
#pragma omp parallel
    {
        int *near = KR_NEW(int, MOST_NEAR);
#pragma omp for schedule(dynamic, 256)
        for (size_t i = 0; i < w->nodes->n; i++) {
            if (fill && w->first_kept[i] == w->first_kept[i + 1])
                continue;
            size_t count = keep_of(w, search, on_lattice, i, near, fill);
            if (!fill)
                w->first_kept[i + 1] = count;
        }
        kr_free(near);
    }
}

void kr_weights_keep(struct kr_weights *w, const struct kr_search *search,
                     const unsigned char *on_lattice) {
    size_t n = w->nodes->n;
    if (!is_exact(w->partial_volume))
        return;
    w->first_kept = KR_NEW(size_t, n + 1);
    keep_all(w, search, on_lattice, 0);
    for (size_t i = 0; i < n; i++)
        w->first_kept[i + 1] += w->first_kept[i];
    if (w->first_kept[n] > MOST_KEPT)
        return;
    w->kept_with = KR_NEW(int, w->first_kept[n]);
    w->kept = KR_NEW(float, w->first_kept[n]);
    keep_all(w, search, on_lattice, 1);
}

/* The place in the first octant with x >= y >= z: all images of a bond get the same bits. */
static void fold(int dim, const double *xi, double place[3]) {
    for (int d = 0; d < 3; d++)
        place[d] = d < dim ? fabs(xi[d]) : 0;
    for (int d = 0; d < 3; d++) {
        int low = d == 1, high = low + 1; /* three exchanges of neighbours: 0-1, 1-2, 0-1 */
        double larger = fmax(place[low], place[high]);
        place[high] = fmin(place[low], place[high]);
        place[low] = larger;
    }
}

double kr_weight_lattice(int partial_volume, int dim, const double *xi, double horizon,
                         double spacing) {
    double half_diagonal = 0.5 * sqrt(dim) * spacing, place[3];
    fold(dim, xi, place);
    double distance = length_of(dim, place);
    if (!is_exact(partial_volume))
        return kr_weight(partial_volume, distance, horizon, spacing, spacing);
    if (distance - half_diagonal >= horizon)
        return 0;
    struct part there = {1, {place[0], place[1], place[2]}};
    if (distance + half_diagonal > horizon)
        there = dim == 2 ? over_area(kr_disc_square(place, spacing, horizon), spacing * spacing)
                         : over_volume(kr_ball_cube(place, spacing, horizon), pow(spacing, 3));
    struct part back = {there.share, {-there.moment[0], -there.moment[1], -there.moment[2]}};
    return weight_of(partial_volume, &there, &back, distance);
}

/* The volume is known to be that of the square (cube) of this side: if no corner is outside of it,
 * the cell is the square. */
int kr_weights_is_square(const struct kr_weights *w, size_t i, double spacing) {
    size_t dim = (size_t)w->nodes->dim;
    if (!w->radius)
        return 1;
    for (size_t k = 0; k < corners_of(w->nodes, i); k++)
        for (size_t d = 0; d < dim; d++)
            if (fabs(corner_of(w->nodes, i, k)[d] - w->nodes->position[dim * i + d]) >
                0.5 * spacing * (1 + 1e-9))
                return 0;
    return 1;
}

/* ---- surface factors ---- */

/* 1/sqrt(sum of (n_d/g_d)^2): the factor along the bond, from those along the axes. */
static double along_bond(const struct kr_nodes *nodes, size_t i, size_t j) {
    size_t dim = (size_t)nodes->dim;
    double sum = 0, square = 0;
    for (size_t d = 0; d < dim; d++) {
        double xi = nodes->position[j * dim + d] - nodes->position[i * dim + d];
        double factor = 0.5 * (nodes->axis_factor[i * dim + d] + nodes->axis_factor[j * dim + d]);
        sum += xi * xi / (factor * factor);
        square += xi * xi;
    }
    return sqrt(square / sum);
}

double kr_weights_pairing(const struct kr_weights *w, size_t i, size_t j) {
    const struct kr_nodes *nodes = w->nodes;
    double a = nodes->factor[i], b = nodes->factor[j], ratio = 1;
    if (nodes->pairing == KR_PAIRING_HARMONIC)
        ratio = 4 * a * b / ((a + b) * (a + b));
    else if (nodes->pairing == KR_PAIRING_ELLIPSE)
        ratio = along_bond(nodes, i, j) / (0.5 * (a + b));
    return fabs(ratio - 1) < 1e-12 ? 1 : ratio;
}
