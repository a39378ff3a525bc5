/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The apparent Young's modulus of a bar that is pulled along x: E' = F L/(A d), with d the growth of
 * the length L between two cross sections. Prints one row of a Markdown table for the nodes in FOLDER.
 *
 * The bar hangs free. F acts on its first and last layer of cells as a body force, so forces and
 * moments balance, and the linear equilibrium -J u = b (theory.md (8a)) is found by conjugate
 * gradients: from u = 0 they never leave the space without rigid motions.
 */
#include "base/error.h"
#include "base/memory.h"
#include "body.h"
#include "case.h"

#include <math.h>
#include <stdio.h>

static const char usage[] =
    "bar [--set KEY=VALUE]... --output FOLDER case.yaml: print a row of the table for the nodes in\n"
    "FOLDER. `make bar` calls it.\n";

static const double TOLERANCE = 1e-8;
enum { MOST_ITERATIONS = 5000 };

/* Vectors of three padded arrays. */
struct vector {
    double *d[3];
};

static struct vector vector_of(size_t n) {
    struct vector v;
    for (int d = 0; d < 3; d++)
        v.d[d] = kr_bonds_padded(n);
    return v;
}

static void vector_free(struct vector *v) {
    for (int d = 0; d < 3; d++)
        kr_bonds_padded_free(v->d[d]);
}

static double inner(size_t n, const struct vector *a, const struct vector *b) {
    double sum = 0;
    for (int d = 0; d < 3; d++)
        for (size_t i = 0; i < n; i++)
            sum += a->d[d][i] * b->d[d][i];
    return sum;
}

/* to = scale to + factor from */
static void combine(size_t n, struct vector *to, double scale, const struct vector *from,
                    double factor) {
    for (int d = 0; d < 3; d++)
        for (size_t i = 0; i < n; i++)
            to->d[d][i] = scale * to->d[d][i] + factor * from->d[d][i];
}

/* out = -V J v */
static void stiffness(struct kr_body *body, const struct vector *v, struct vector *out) {
    kr_body_product(body, v->d, out->d);
    for (int d = 0; d < 3; d++)
        for (size_t i = 0; i < body->n; i++)
            out->d[d][i] *= -body->bonds->volume[i];
}

/* Solve for u under the nodal forces r, which become what is left of them. */
static int solve(struct kr_body *body, struct vector *r, struct vector *u) {
    size_t n = body->n;
    struct vector p = vector_of(n), q = vector_of(n);
    double square = inner(n, r, r), first = square;
    int k = 0;
    combine(n, &p, 0, r, 1);
    for (; k < MOST_ITERATIONS && square > TOLERANCE * TOLERANCE * first; k++) {
        stiffness(body, &p, &q);
        double step = square / inner(n, &p, &q), before = square;
        combine(n, u, 1, &p, step);
        combine(n, r, 1, &q, -step);
        square = inner(n, r, r);
        combine(n, &p, square / before, r, 1);
    }
    vector_free(&p);
    vector_free(&q);
    return k;
}

/* Mean of u_x over the nodes whose x is within half a spacing of a place. */
static double section(const struct kr_bonds *b, const double *u, double place, double spacing) {
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < b->n; i++)
        if (fabs(b->x[0][i] - place) < 0.51 * spacing) {
            sum += u[i];
            count++;
        }
    return sum / (double)count;
}

/* E'/E over the length between x and width - x. */
static double modulus(const struct kr_case *c, const struct kr_bonds *b, const double *u, double x,
                      double stress) {
    double growth = section(b, u, c->width - x, c->spacing) - section(b, u, x, c->spacing);
    return stress * (c->width - 2 * x) / growth / b->material.youngs_modulus;
}

int main(int argc, char **argv) {
    struct kr_case_arguments arguments;
    struct kr_case c;
    kr_case_arguments(argc, argv, usage, &arguments);
    struct kr_deck *deck = kr_case_open(&arguments, &c);
    char *path = kr_case_file(&c, "plate.nodes.h5"), weight[32], factor[32], strain[32];
    struct kr_nodes *nodes = kr_nodes_read(path);
    struct kr_material material = kr_material_of(&c);
    struct kr_bonds *bonds = kr_bonds_create(nodes, &material, c.partial_volume);
    struct kr_body *body = kr_body_create(bonds);
    struct vector force = vector_of(nodes->n), u = vector_of(nodes->n);
    const double stress = 1;
    for (size_t i = 0; i < nodes->n; i++) {
        double x = bonds->x[0][i];
        int end = (x > c.width - c.spacing) - (x < c.spacing);
        force.d[0][i] = end * stress * bonds->volume[i] / c.spacing;
    }
    int iterations = solve(body, &force, &u);
    kr_case_word(KR_PARTIAL_VOLUME_WORDS, c.partial_volume, weight);
    kr_case_word(KR_SURFACE_WORDS, c.surface_correction, factor);
    kr_case_word(KR_DEFORMATION_WORDS, c.surface_deformation, strain);
    double least = INFINITY, most = 0;
    for (size_t i = 0; i < nodes->n; i++) {
        least = fmin(least, nodes->factor[i]);
        most = fmax(most, nodes->factor[i]);
    }
    printf("| %.3g | %s | %s | %s | %.3f | %.3f | %.2f to %.2f | %d |\n", c.horizon / c.spacing,
           weight, factor, c.surface_correction == KR_SURFACE_ENERGY ? strain : "",
           modulus(&c, bonds, u.d[0], 0.5 * c.spacing, stress),
           modulus(&c, bonds, u.d[0], 0.25 * c.width + 0.5 * c.spacing, stress), least, most, iterations);
    vector_free(&force);
    vector_free(&u);
    kr_body_free(body);
    kr_bonds_free(bonds);
    kr_nodes_free(nodes);
    kr_free(path);
    kr_deck_close(deck);
    kr_free(arguments.set);
    kr_free(arguments.left);
    return KR_EXIT_OK;
}
