/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Surface corrections that need one sum over each family and no iteration; theory.md (11a), (11b).
 *
 *   volume         lambda_i = V0/V_i, V_i what there is of the family, the node's own cell
 *                  included; a bond takes the harmonic mean, 2 V0/(V_i + V_j)
 *                  (Bobaru et al. 2016)
 *   force density  lambda_i along each axis = S0/S_i, S_i the sum of what the bonds pull along that
 *                  axis under uniaxial strain along it; a bond takes the ellipse over the means of
 *                  both ends (in 3D the ellipsoid) (Oterkus 2010; Madenci, Oterkus 2014)
 *
 * The literature sums the force density over one half of the family, the fuller one; S_i sums both
 * halves as absolute values, which is the same where both are full and half of it at a straight
 * edge.
 */
#include "surface.h"

#include "base/error.h"
#include "base/memory.h"
#include "bonds.h"
#include "weight.h"

#include <math.h>

static const double STRAIN = 1e-4;

/* What a bond of unit weight pulls along an axis per volume squared [N/m^6], strained along it. */
static double pull_along(const struct kr_material *m, int dim, const double *xi, int axis) {
    double square = 0;
    for (int d = 0; d < dim; d++)
        square += xi[d] * xi[d];
    double e = STRAIN * (2 + STRAIN) * xi[axis] * xi[axis] / square;
    double length = sqrt(square);
    return kr_material_micromodulus(m, length) * m->law->force(e / (1 + sqrt(1 + e))) *
           fabs(xi[axis]) / length;
}

double kr_surface_full_volume(int dim, double horizon) {
    return dim == 2 ? M_PI * horizon * horizon : 4 * M_PI / 3 * horizon * horizon * horizon;
}

static double pull(const struct kr_material *m, const double xi[3], const void *dim) {
    return pull_along(m, *(const int *)dim, xi, 0);
}

double kr_surface_full_pull(const struct kr_material *m, int dim, int partial_volume) {
    return kr_surface_full_sum(m, dim, partial_volume, pull, &dim);
}

/* S of the nodes of one slice along all axes: (n x dim). */
static void sum_pulls(const struct kr_bonds *b, size_t slice, double *pull) {
    struct kr_bond_walk walk = kr_bonds_walk(b, slice);
    struct kr_bond bond;
    size_t dim = (size_t)b->dim;
    while (kr_bonds_next(b, &walk, &bond))
        for (size_t d = 0; d < dim; d++)
            pull[bond.i * dim + d] +=
                bond.weight * b->volume[bond.j] * pull_along(&b->material, b->dim, bond.xi, (int)d);
}

/* The factors along the axes of one node from its sums; their mean is its factor. */
static void set_axes(struct kr_nodes *nodes, size_t i, double reference) {
    size_t dim = (size_t)nodes->dim;
    double sum = 0;
    for (size_t d = 0; d < dim; d++) {
        double *factor = &nodes->axis_factor[i * dim + d];
        if (!(*factor > 0))
            kr_stop(KR_EXIT_NUMBERS,
                    "the surface factor of node %zu at (%g, %g, %g) m: no bond pulls along %c; take "
                    "surface_correction: volume or none, or remove the node",
                    i, nodes->position[i * dim], nodes->position[i * dim + 1],
                    dim == 3 ? nodes->position[i * dim + 2] : 0, "xyz"[d]);
        *factor = reference / *factor;
        sum += *factor;
    }
    nodes->factor[i] = sum / (double)dim;
}

/* Families with their own weights, without factors. */
static struct kr_bonds *plain_bonds(struct kr_nodes *nodes, const struct kr_material *material,
                                    int partial_volume) {
    kr_surface_clear(nodes);
    kr_surface_say_begun(nodes);
    return kr_bonds_create(nodes, material, partial_volume);
}

struct kr_surface_report kr_surface_volume(struct kr_nodes *nodes,
                                           const struct kr_material *material, int partial_volume) {
    struct kr_surface_report report = {.reference =
                                           kr_surface_full_volume(nodes->dim, material->horizon)};
    struct kr_bonds *bonds = plain_bonds(nodes, material, partial_volume);
    for (size_t i = 0; i < nodes->n; i++)
        nodes->factor[i] = report.reference / (bonds->family_volume[i] + nodes->volume[i]);
    nodes->pairing = KR_PAIRING_HARMONIC;
    kr_bonds_free(bonds);
    kr_surface_extremes(nodes, &report);
    return report;
}

struct kr_surface_report kr_surface_force_density(struct kr_nodes *nodes,
                                                  const struct kr_material *material,
                                                  int partial_volume) {
    struct kr_surface_report report = {.reference =
                                           kr_surface_full_pull(material, nodes->dim,
                                                                partial_volume)};
    struct kr_bonds *bonds = plain_bonds(nodes, material, partial_volume);
    nodes->axis_factor = KR_NEW(double, nodes->n *(size_t)nodes->dim);
#pragma omp parallel for schedule(dynamic, 256)
    for (size_t slice = 0; slice < bonds->n_slices; slice++)
        sum_pulls(bonds, slice, nodes->axis_factor);
    for (size_t i = 0; i < nodes->n; i++)
        set_axes(nodes, i, report.reference);
    nodes->pairing = KR_PAIRING_ELLIPSE;
    kr_bonds_free(bonds);
    kr_surface_extremes(nodes, &report);
    return report;
}
