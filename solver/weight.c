/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Weights that hang on more than two sizes: cells cut by the horizon, and surface factors that are
 * not simply averaged. See weight.h.
 */
#include "weight.h"

#include "base/error.h"
#include "base/memory.h"
#include "disc.h"

#include <string.h>

enum { MOST_CORNERS = 64 };

/* Shares below this are rounding of cells that the circle only touches. */
static const double LEAST = 1e-12;

static int is_exact(int partial_volume) {
    return partial_volume == KR_PARTIAL_VOLUME_EXACT ||
           partial_volume == KR_PARTIAL_VOLUME_EXACT_CENTROID;
}

int kr_weights_choose(struct kr_deck *deck, const struct kr_case *c, const struct kr_nodes *nodes) {
    int have_cells = nodes->dim == 2 && nodes->n_points > 0;
    if (have_cells || !is_exact(c->partial_volume))
        return c->partial_volume;
    if (kr_deck_given(deck, &c->partial_volume))
        kr_deck_fault(deck, &c->partial_volume,
                      "exact shares need the cells of a mesh in the plane, and these nodes have "
                      "none; take hhb");
    return KR_PARTIAL_VOLUME_HHB;
}

static size_t corners_of(const struct kr_nodes *nodes, size_t i) {
    return (size_t)(nodes->first[i + 1] - nodes->first[i]);
}

static const double *corner_of(const struct kr_nodes *nodes, size_t i, size_t k) {
    return nodes->point + 2 * nodes->vertex[(size_t)nodes->first[i] + k];
}

static double radius_of(const struct kr_nodes *nodes, size_t i) {
    double radius = 0;
    for (size_t k = 0; k < corners_of(nodes, i); k++) {
        const double *corner = corner_of(nodes, i, k);
        radius = fmax(radius, hypot(corner[0] - nodes->position[2 * i],
                                    corner[1] - nodes->position[2 * i + 1]));
    }
    return radius;
}

static void measure_cells(struct kr_weights *w) {
    const struct kr_nodes *nodes = w->nodes;
    if (nodes->dim != 2)
        kr_stop(KR_EXIT_INPUT, "exact partial volumes are made in 2D only; take "
                               "nodes.partial_volume: hhb");
    if (!nodes->n_points)
        kr_stop(KR_EXIT_INPUT, "exact partial volumes need the cells of the nodes, and these came "
                               "without; take nodes.partial_volume: hhb, or make the nodes from a "
                               "mesh");
    w->radius = KR_NEW(double, nodes->n);
    w->reach = 0;
    for (size_t i = 0; i < nodes->n; i++) {
        if (corners_of(nodes, i) > MOST_CORNERS)
            kr_stop(KR_EXIT_INPUT, "the cell of node %zu has %zu corners; expected at most %d", i,
                    corners_of(nodes, i), MOST_CORNERS);
        w->radius[i] = radius_of(nodes, i);
        w->reach = fmax(w->reach, w->horizon + w->radius[i]);
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
    return w;
}

void kr_weights_free(struct kr_weights *w) {
    kr_free(w->size);
    kr_free(w->radius);
    kr_free(w);
}

/* ---- cells cut by the horizon ---- */

/* The part of cell j inside the horizon of i, over V_j: the share, and its moment about i. */
static struct kr_disc_part part_of(const struct kr_weights *w, size_t i, size_t j) {
    const struct kr_nodes *nodes = w->nodes;
    const double *here = nodes->position + 2 * i, *there = nodes->position + 2 * j;
    double xi[2] = {there[0] - here[0], there[1] - here[1]}, distance = hypot(xi[0], xi[1]);
    double corner[2 * MOST_CORNERS];
    size_t n = corners_of(nodes, j);
    if (distance + w->radius[j] <= w->horizon)
        return (struct kr_disc_part){1, {xi[0], xi[1]}};
    if (distance - w->radius[j] >= w->horizon)
        return (struct kr_disc_part){0};
    for (size_t k = 0; k < n; k++)
        for (size_t d = 0; d < 2; d++)
            corner[2 * k + d] = corner_of(nodes, j, k)[d] - here[d];
    struct kr_disc_part part = kr_disc_polygon(n, corner, w->horizon);
    part.area /= nodes->volume[j];
    for (int d = 0; d < 2; d++)
        part.moment[d] /= nodes->volume[j];
    return part;
}

/* The bond's weight from what each end sees of the other: the mean of both, (10a); with the
 * centroids of the parts, the mean moment over the bond's length, (10b). Sums and differences of
 * two numbers: the same bits from both ends. */
static double weight_of(int partial_volume, const struct kr_disc_part *there,
                        const struct kr_disc_part *back, double distance) {
    double phi = 0.5 * (there->area + back->area);
    if (phi < LEAST || (there->area == 1 && back->area == 1))
        return phi < LEAST ? 0 : 1;
    if (partial_volume == KR_PARTIAL_VOLUME_EXACT)
        return phi;
    return 0.5 * hypot(there->moment[0] - back->moment[0], there->moment[1] - back->moment[1]) /
           distance;
}

double kr_weights_share(const struct kr_weights *w, size_t i, size_t j) {
    return part_of(w, i, j).area;
}

double kr_weights_phi(const struct kr_weights *w, size_t i, size_t j, double distance) {
    if (!is_exact(w->partial_volume))
        return kr_weight(w->partial_volume, distance, w->horizon, w->size[i], w->size[j]);
    double larger = fmax(w->radius[i], w->radius[j]);
    if (distance + larger <= w->horizon)
        return 1;
    if (distance - larger >= w->horizon)
        return 0;
    struct kr_disc_part there = part_of(w, i, j), back = part_of(w, j, i);
    return weight_of(w->partial_volume, &there, &back, distance);
}

double kr_weight_lattice(int partial_volume, int dim, const double *xi, double horizon,
                         double spacing) {
    double distance = dim == 2 ? hypot(xi[0], xi[1]) : hypot(hypot(xi[0], xi[1]), xi[2]);
    if (!is_exact(partial_volume))
        return kr_weight(partial_volume, distance, horizon, spacing, spacing);
    /* All eight images of a bond get the same bits. */
    double across = fabs(xi[0]), up = fabs(xi[1]);
    const double place[2] = {fmax(across, up), fmin(across, up)};
    struct kr_disc_part there = {1, {place[0], place[1]}};
    if (distance + spacing * sqrt(0.5) > horizon) {
        there = kr_disc_square(place, spacing, horizon);
        there.area /= spacing * spacing;
        for (int d = 0; d < 2; d++)
            there.moment[d] /= spacing * spacing;
    }
    struct kr_disc_part back = {there.area, {-there.moment[0], -there.moment[1]}};
    return weight_of(partial_volume, &there, &back, distance);
}

/* The area is known to be spacing^2: if no corner is outside of the square, the cell is the square.
 */
int kr_weights_is_square(const struct kr_weights *w, size_t i, double spacing) {
    if (!w->radius)
        return 1;
    for (size_t k = 0; k < corners_of(w->nodes, i); k++)
        for (size_t d = 0; d < 2; d++)
            if (fabs(corner_of(w->nodes, i, k)[d] - w->nodes->position[2 * i + d]) >
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
