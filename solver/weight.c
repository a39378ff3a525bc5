/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Weights that hang on more than two sizes: cells cut by the horizon, and surface factors that are
 * not simply averaged. See weight.h.
 */
#include "weight.h"

#include "base/memory.h"

enum { MOST_KEPT = 100000000 }; /* 0.8 GB of weights */

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
    if (!is_exact(partial_volume))
        return w;
    w->shares = kr_shares_create(nodes, horizon);
    w->reach = 0;
    for (size_t i = 0; i < nodes->n; i++)
        w->reach = fmax(w->reach, horizon + w->shares->radius[i]);
    return w;
}

void kr_weights_free(struct kr_weights *w) {
    kr_shares_free(w->shares);
    kr_free(w->size);
    kr_free(w->first_kept);
    kr_free(w->kept_with);
    kr_free(w->kept);
    kr_free(w);
}

/* ---- exact shares ---- */

/* The bond's weight from what each end sees of the other: the mean of both, (10a); with the
 * centroids of the parts, the mean moment over the bond's length, (10b). Sums and differences of
 * two numbers: the same bits from both ends. */
static double weight_of(int partial_volume, const struct kr_share *there, const struct kr_share *back,
                        double distance) {
    double phi = 0.5 * (there->part + back->part), moment[3];
    if (phi < LEAST || (there->part == 1 && back->part == 1))
        return phi < LEAST ? 0 : 1;
    if (partial_volume == KR_PARTIAL_VOLUME_EXACT)
        return phi;
    for (int d = 0; d < 3; d++)
        moment[d] = there->moment[d] - back->moment[d];
    return 0.5 * kr_share_length(3, moment) / distance;
}

double kr_weights_share(const struct kr_weights *w, size_t i, size_t j) {
    return kr_shares_of(w->shares, i, j).part;
}

/* Of bonds that no cell's radius decides. */
static double phi_at_rim(const struct kr_weights *w, size_t i, size_t j, double distance) {
    struct kr_share there = kr_shares_of(w->shares, i, j), back = kr_shares_of(w->shares, j, i);
    return weight_of(w->partial_volume, &there, &back, distance);
}

/* 1 if the horizon of either end holds the other cell, 0 if it misses it, -1 where it may cut it. */
static int phi_by_radius(const struct kr_weights *w, size_t i, size_t j, double distance) {
    double larger = fmax(w->shares->radius[i], w->shares->radius[j]);
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
                      const unsigned char *on_lattice, size_t i, struct kr_found *found, int fill) {
    const struct kr_nodes *nodes = w->nodes;
    size_t count = 0, dim = (size_t)nodes->dim;
    kr_search_find(search, i, found);
    for (size_t k = 0; k < found->count; k++) {
        size_t j = (size_t)found->near[k];
        double xi[3] = {0};
        if (j < i || (on_lattice[i] && on_lattice[j]))
            continue;
        for (size_t d = 0; d < dim; d++)
            xi[d] = nodes->position[dim * j + d] - nodes->position[dim * i + d];
        double distance = kr_share_length(nodes->dim, xi);
        if (phi_by_radius(w, i, j, distance) >= 0)
            continue;
        if (fill) {
            w->kept_with[w->first_kept[i] + count] = found->near[k];
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
        struct kr_found found = {0};
#pragma omp for schedule(dynamic, 256)
        for (size_t i = 0; i < w->nodes->n; i++) {
            if (fill && w->first_kept[i] == w->first_kept[i + 1])
                continue;
            size_t count = keep_of(w, search, on_lattice, i, &found, fill);
            if (!fill)
                w->first_kept[i + 1] = count;
        }
        kr_free(found.near);
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
    double place[3];
    fold(dim, xi, place);
    double distance = kr_share_length(dim, place);
    if (!is_exact(partial_volume))
        return kr_weight(partial_volume, distance, horizon, spacing, spacing);
    struct kr_share there = kr_share_of_lattice(dim, place, horizon, spacing);
    struct kr_share back = {there.part, {-there.moment[0], -there.moment[1], -there.moment[2]}};
    return weight_of(partial_volume, &there, &back, distance);
}

int kr_weights_is_square(const struct kr_weights *w, size_t i, double spacing) {
    return !w->shares || kr_shares_is_square(w->shares, i, spacing);
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
