/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Surface correction by the energy method. The energies come from the solver's own loop, so that the
 * factors fit just the weights and the geometry that the solver will use.
 */
#include "surface.h"

#include "base/error.h"
#include "base/memory.h"
#include "body.h"
#include "weight.h"

#include <math.h>

enum { MOST_ITERATIONS = 1000, FINE = 25 };
static const double STRAIN = 1e-4, TOLERANCE = 1e-7;

/* Strains of the deformations, and how many there are to take the mean over. */
static int strains_of(int deformation, double strain[2][2]) {
    double x = deformation == KR_UNIAXIAL_Y ? 0 : STRAIN;
    double y = deformation == KR_UNIAXIAL_Y || deformation == KR_ISOTROPIC ? STRAIN : 0;
    strain[0][0] = x;
    strain[0][1] = y;
    strain[1][0] = 0;
    strain[1][1] = STRAIN;
    return deformation == KR_MEAN_OVER_AXES ? 2 : 1;
}

static double bond_energy(const struct kr_material *m, const double xi[2], const double strain[2]) {
    double q = 0, square = 0;
    for (int d = 0; d < 2; d++) {
        double eta = strain[d] * xi[d];
        q += eta * (2 * xi[d] + eta);
        square += xi[d] * xi[d];
    }
    double e = q / square;
    return m->micromodulus * sqrt(square) * m->law->energy(e / (1 + sqrt(1 + e)));
}

double kr_surface_reference(const struct kr_material *m, int partial_volume, int deformation) {
    double strain[2][2], spacing = m->horizon / FINE, sum = 0;
    int count = strains_of(deformation, strain);
    for (int k = 0; k < count; k++)
        for (int a = -FINE - 1; a <= FINE + 1; a++)
            for (int b = -FINE - 1; b <= FINE + 1; b++) {
                double xi[2] = {a * spacing, b * spacing};
                if (!a && !b)
                    continue;
                double phi = kr_weight(partial_volume, hypot(xi[0], xi[1]), m->horizon, spacing,
                                       spacing);
                if (phi > 0)
                    sum += 0.5 * phi * bond_energy(m, xi, strain[k]) * spacing * spacing;
            }
    return sum / count;
}

/* Energies of all nodes, mean over the deformations, into `energy`. */
static void measure(struct kr_body *body, int count, double strain[2][2], double *energy) {
    for (size_t i = 0; i < body->n; i++)
        energy[i] = 0;
    for (int k = 0; k < count; k++) {
        for (int d = 0; d < 2; d++)
            for (size_t i = 0; i < body->n; i++)
                body->u[d][i] = strain[k][d] * body->bonds->x[d][i];
        kr_body_energy(body);
        for (size_t i = 0; i < body->n; i++)
            energy[i] += body->energy[i] / count;
    }
}

static double update(struct kr_body *body, const double *energy, double reference) {
    double worst = 0;
    for (size_t i = 0; i < body->n; i++) {
        double ratio = reference / energy[i];
        body->bonds->factor[i] *= ratio;
        worst = fmax(worst, fabs(ratio - 1));
    }
    return worst;
}

static void report_extremes(const struct kr_nodes *nodes, struct kr_surface_report *report) {
    for (size_t i = 0; i < nodes->n; i++) {
        if (nodes->factor[i] < nodes->factor[report->least_at])
            report->least_at = i;
        if (nodes->factor[i] > nodes->factor[report->most_at])
            report->most_at = i;
    }
    report->least = nodes->factor[report->least_at];
    report->most = nodes->factor[report->most_at];
}

struct kr_surface_report kr_surface_correct(struct kr_nodes *nodes,
                                            const struct kr_material *material, int partial_volume,
                                            int deformation) {
    struct kr_surface_report report = {.reference = kr_surface_reference(material, partial_volume,
                                                                         deformation)};
    struct kr_material whole = *material;
    whole.critical_stretch = INFINITY;
    struct kr_bonds *bonds = kr_bonds_create(nodes, &whole, partial_volume);
    struct kr_body *body = kr_body_create(bonds);
    double strain[2][2], *energy = KR_NEW(double, nodes->n);
    int count = strains_of(deformation, strain);
    do {
        measure(body, count, strain, energy);
        report.residual = update(body, energy, report.reference);
    } while (report.residual > TOLERANCE && ++report.iterations < MOST_ITERATIONS);
    if (report.residual > TOLERANCE)
        kr_stop(KR_EXIT_NUMBERS,
                "the surface factors did not converge: off by %.2g after %d iterations; look for "
                "nodes with few neighbours, or take surface_correction: none",
                report.residual, report.iterations);
    for (size_t i = 0; i < nodes->n; i++)
        nodes->factor[i] = bonds->factor[i];
    report_extremes(nodes, &report);
    kr_body_free(body);
    kr_bonds_free(bonds);
    kr_free(energy);
    return report;
}
