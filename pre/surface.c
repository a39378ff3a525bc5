/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Surface correction by the energy method. The energies come from the solver's own loop, so that the
 * factors fit just the weights and the geometry that the solver will use.
 *
 * The paper's iteration lambda_i <- lambda_i W0/W_i ends where W_i = W0 in all nodes. As W is linear
 * in lambda, and V_i dW_i/dlambda_j symmetric, that is a linear system with a positive matrix:
 * conjugate gradients reach the same factors in some 20 iterations instead of some 800.
 */
#include "surface.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/progress.h"
#include "body.h"
#include "weight.h"

#include <math.h>

/* FINE: spacings in the horizon of the full family that all factors refer to. */
enum { MOST_ITERATIONS = 5000, FINE = 25 };
static const double STRAIN = 1e-4, TOLERANCE = 1e-7;

/* Strain along d of a deformation whose axis is `axis`. Across a uniaxial stress the model shrinks by 1/4
 * in a solid, by 1/3 in plane stress (nu) and in plane strain (nu/(1 - nu)). */
static double strain_along(int dim, int deformation, int axis, int d) {
    if (d >= dim)
        return 0;
    if (d == axis || deformation == KR_ISOTROPIC)
        return STRAIN;
    return deformation >= KR_STRESS_X ? -STRAIN / (dim + 1) : 0;
}

/* Strains of the deformations along the axes, and how many there are to take the mean over. */
static int strains_of(int dim, int deformation, double strain[3][3]) {
    static const int axis_of[] = {[KR_UNIAXIAL_Y] = 1, [KR_UNIAXIAL_X] = 0, [KR_UNIAXIAL_Z] = 2,
                                  [KR_STRESS_X] = 0,   [KR_STRESS_Y] = 1,   [KR_STRESS_Z] = 2,
                                  [KR_STRESS_OVER_AXES] = 0};
    int all = deformation == KR_MEAN_OVER_AXES || deformation == KR_STRESS_OVER_AXES;
    int count = all ? dim : 1;
    for (int k = 0; k < count; k++)
        for (int d = 0; d < 3; d++)
            strain[k][d] = strain_along(dim, deformation, all ? k : axis_of[deformation], d);
    return count;
}

static double bond_energy(const struct kr_material *m, const double xi[3], const double strain[3]) {
    double q = 0, square = 0;
    for (int d = 0; d < 3; d++) {
        double eta = strain[d] * xi[d];
        q += eta * (2 * xi[d] + eta);
        square += xi[d] * xi[d];
    }
    double e = q / square;
    return kr_material_micromodulus(m, sqrt(square)) * sqrt(square) * m->law->energy(e / (1 + sqrt(1 + e)));
}

/* What one bond of the fine lattice holds, its volume not counted: the mean over the strains. */
struct strained {
    int count;
    double strain[3][3];
};

static double held(const struct kr_material *m, const double xi[3], const void *context) {
    const struct strained *s = context;
    double sum = 0;
    for (int k = 0; k < s->count; k++)
        sum += bond_energy(m, xi, s->strain[k]);
    return 0.5 * sum / s->count;
}

double kr_surface_full_sum(const struct kr_material *m, int dim, int partial_volume,
                           double (*term)(const struct kr_material *, const double xi[3],
                                          const void *context),
                           const void *context) {
    const int side = 2 * FINE + 3, depth = dim == 3 ? side : 1;
    double spacing = m->horizon / FINE, sum = 0;
    for (int k = 0; k < side * side * depth; k++) {
        int a = k / (side * depth) - FINE - 1, b = k / depth % side - FINE - 1;
        int c = dim == 3 ? k % depth - FINE - 1 : 0;
        const double xi[3] = {a * spacing, b * spacing, c * spacing};
        double phi = a || b || c ? kr_weight_lattice(partial_volume, dim, xi, m->horizon, spacing) : 0;
        if (phi > 0)
            sum += phi * term(m, xi, context) * pow(spacing, dim);
    }
    return sum;
}

double kr_surface_reference(const struct kr_material *m, int dim, int partial_volume,
                            int deformation) {
    struct strained strained;
    strained.count = strains_of(dim, deformation, strained.strain);
    return kr_surface_full_sum(m, dim, partial_volume, held, &strained);
}

/* The body whose energies are wanted, and the deformations. */
struct problem {
    struct kr_body *body;
    int count;
    double strain[3][3];
    double *diagonal; /* of the system: about V_i W_i(1)/2 */
    struct kr_progress progress;
};

/* out_i = V_i W_i for the factors lambda, mean over the deformations. Linear in lambda. */
static void apply(const struct problem *p, const double *lambda, double *out) {
    struct kr_body *body = p->body;
    for (size_t i = 0; i < body->n; i++) {
        body->bonds->factor[i] = lambda[i];
        out[i] = 0;
    }
    for (int k = 0; k < p->count; k++) {
        for (int d = 0; d < body->dim; d++)
            for (size_t i = 0; i < body->n; i++)
                body->u[d][i] = p->strain[k][d] * body->bonds->x[d][i];
        kr_body_energy(body);
        for (size_t i = 0; i < body->n; i++)
            out[i] += body->energy[i] * body->bonds->volume[i] / p->count;
    }
}

struct dot {
    const double *a, *b;
};

static double product(const void *context, size_t i) {
    const struct dot *d = context;
    return d->a[i] * d->b[i];
}

static double dot(size_t n, const double *a, const double *b) {
    struct dot d = {a, b};
    return kr_body_sum(n, product, &d);
}

/* Keep the largest |W_i/W0 - 1| in the report, and where it last was a number. */
static void keep_worst(struct kr_surface_report *report, size_t i, double off) {
    if (fabs(off) <= report->residual)
        return;
    report->residual = isnan(off) ? INFINITY : fabs(off);
    if (isfinite(off))
        report->worst_at = i;
}

/* From the residual r_i = V_i (W0 - W_i). */
static void find_worst(const struct problem *p, const double *residual,
                       struct kr_surface_report *report) {
    report->residual = 0;
    for (size_t i = 0; i < p->body->n; i++)
        keep_worst(report, i, residual[i] / (p->body->bonds->volume[i] * report->reference));
}

/* Conjugate gradients with the diagonal as preconditioner. */
static void solve(struct problem *p, double *lambda, struct kr_surface_report *report) {
    size_t n = p->body->n;
    double *residual = KR_NEW(double, n), *search = KR_NEW(double, n), *scaled = KR_NEW(double, n);
    double *image = KR_NEW(double, n), before = 0;
    apply(p, lambda, image);
    for (size_t i = 0; i < n; i++) {
        p->diagonal[i] = 0.5 * image[i];
        residual[i] = p->body->bonds->volume[i] * report->reference - image[i];
    }
    for (;; report->iterations++) {
        find_worst(p, residual, report);
        if (!(report->residual > TOLERANCE) || !isfinite(report->residual) ||
            report->iterations == MOST_ITERATIONS)
            break;
        kr_progress_note(&p->progress, "iteration %d, off by %.1e", report->iterations,
                         report->residual);
        for (size_t i = 0; i < n; i++)
            scaled[i] = residual[i] / p->diagonal[i];
        double now = dot(n, residual, scaled);
        for (size_t i = 0; i < n; i++)
            search[i] = scaled[i] + (before > 0 ? now / before : 0) * search[i];
        before = now;
        apply(p, search, image);
        double length = now / dot(n, search, image);
        for (size_t i = 0; i < n; i++) {
            lambda[i] += length * search[i];
            residual[i] -= length * image[i];
        }
    }
    kr_free(residual);
    kr_free(search);
    kr_free(scaled);
    kr_free(image);
}

/* The paper's iteration, for weights that are not symmetric. */
static void repeat(struct problem *p, double *lambda, struct kr_surface_report *report) {
    size_t n = p->body->n;
    const double *volume = p->body->bonds->volume;
    double *image = KR_NEW(double, n);
    for (;; report->iterations++) {
        report->residual = 0;
        apply(p, lambda, image);
        for (size_t i = 0; i < n; i++)
            keep_worst(report, i, image[i] / (volume[i] * report->reference) - 1);
        if (!(report->residual > TOLERANCE) || report->iterations == MOST_ITERATIONS)
            break;
        kr_progress_note(&p->progress, "iteration %d, off by %.1e", report->iterations,
                         report->residual);
        for (size_t i = 0; i < n; i++)
            lambda[i] *= volume[i] * report->reference / image[i];
    }
    kr_free(image);
}

void kr_surface_extremes(const struct kr_nodes *nodes, struct kr_surface_report *report) {
    for (size_t i = 0; i < nodes->n; i++) {
        if (nodes->factor[i] < nodes->factor[report->least_at])
            report->least_at = i;
        if (nodes->factor[i] > nodes->factor[report->most_at])
            report->most_at = i;
    }
    report->least = nodes->factor[report->least_at];
    report->most = nodes->factor[report->most_at];
}

static double height_of(const struct kr_bonds *b, size_t i) {
    return b->dim == 3 ? b->x[2][i] : 0;
}

/* Against both refusals. */
#define CURE                                                                                       \
    "Take away a piece of few nodes, make a wall a few spacings thick, or take "                   \
    "nodes.surface_deformation: isotropic or nodes.surface_correction: force-density"

/* A node's factor may be negative, but no bond's mean of two: such a bond would push apart what it
 * holds. Only nodes with a factor below zero can have one. */
static void refuse_pushing(const struct kr_bonds *b) {
    for (size_t i = 0; i < b->n; i++) {
        if (b->factor[i] > 0)
            continue;
        struct kr_bond_walk walk = kr_bonds_walk(b, i / KR_LANES);
        struct kr_bond bond;
        while (kr_bonds_next(b, &walk, &bond))
            if (bond.i == i && b->factor[i] + b->factor[bond.j] <= 0)
                kr_stop(KR_EXIT_NUMBERS,
                        "the surface factors %.3g and %.3g of the nodes at (%g, %g, %g) and (%g, "
                        "%g, %g) m make their bond push: no positive factors give this place its energy. " CURE,
                        b->factor[i], b->factor[bond.j], b->x[0][i], b->x[1][i], height_of(b, i),
                        b->x[0][bond.j], b->x[1][bond.j], height_of(b, bond.j));
    }
}

struct kr_surface_report kr_surface_correct(struct kr_nodes *nodes,
                                            const struct kr_material *material, int partial_volume,
                                            int deformation) {
    struct kr_surface_report report = {.reference = kr_surface_reference(
                                           material, nodes->dim, partial_volume, deformation)};
    struct kr_material whole = *material;
    whole.critical_stretch = INFINITY;
    kr_surface_clear(nodes);
    struct kr_progress begun = kr_progress_begin("surface factors", 0, 0);
    kr_surface_say_begun(nodes);
    struct kr_bonds *bonds = kr_bonds_create(nodes, &whole, partial_volume);
    struct problem problem = {.body = kr_body_create(bonds), .diagonal = KR_NEW(double, nodes->n)};
    problem.progress = begun;
    problem.count = strains_of(nodes->dim, deformation, problem.strain);
    (partial_volume == KR_PARTIAL_VOLUME_HHB_ONE_SIDED ? repeat : solve)(&problem, nodes->factor,
                                                                         &report);
    kr_progress_wipe(&problem.progress);
    if (!(report.residual <= TOLERANCE))
        kr_stop(KR_EXIT_NUMBERS,
                "the surface factors did not converge: off by %.2g after %d iterations, most at the "
                "node at (%g, %g, %g) m. Has it few neighbours, on a chip or a thin wall? " CURE,
                report.residual, report.iterations, bonds->x[0][report.worst_at],
                bonds->x[1][report.worst_at], height_of(bonds, report.worst_at));
    kr_surface_extremes(nodes, &report);
    for (size_t i = 0; i < nodes->n; i++)
        bonds->factor[i] = nodes->factor[i];
    refuse_pushing(bonds);
    kr_body_free(problem.body);
    kr_bonds_free(bonds);
    kr_free(problem.diagonal);
    return report;
}

void kr_surface_say_begun(const struct kr_nodes *nodes) {
    if (nodes->n >= 100000)
        kr_say("  surface factors: finding the families of %zu nodes", nodes->n);
}

void kr_surface_clear(struct kr_nodes *nodes) {
    for (size_t i = 0; i < nodes->n; i++)
        nodes->factor[i] = 1;
    nodes->axis_factor = kr_free(nodes->axis_factor);
    nodes->pairing = KR_PAIRING_MEAN;
}

struct kr_surface_report kr_surface_make(struct kr_nodes *nodes, const struct kr_material *material,
                                         int correction, int partial_volume, int deformation) {
    if (correction == KR_SURFACE_ENERGY)
        return kr_surface_correct(nodes, material, partial_volume, deformation);
    if (correction == KR_SURFACE_VOLUME)
        return kr_surface_volume(nodes, material, partial_volume);
    if (correction == KR_SURFACE_FORCE_DENSITY)
        return kr_surface_force_density(nodes, material, partial_volume);
    kr_surface_clear(nodes);
    return (struct kr_surface_report){.least = 1, .most = 1};
}
