/* SPDX-License-Identifier: BSD-3-Clause
 *
 * All partial volumes with all surface corrections on one grid: how far families, energies and
 * forces under uniform strain are from the classical plate's. Prints rows of a Markdown table.
 *
 * And a crack: the energy at s0 of the bonds that cross a unit of length, against G0.
 *
 *    strain     classical energy, plane stress
 *    uniaxial   E s^2/(2 (1 - nu^2))
 *    biaxial    E s^2/(1 - nu)
 *    shear      E s^2/(4 (1 + nu))              gamma = s
 */
#include "base/error.h"
#include "base/memory.h"
#include "body.h"
#include "surface.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char usage[] =
    "corrections [--set KEY=VALUE]... --output FOLDER case.yaml: print the rows of the table for "
    "the\n"
    "nodes in FOLDER; --grids: print the words of all grids. `make corrections` calls it.\n";

/* Small enough that the law is linear to 1e-6. */
static const double STRAIN = 1e-6;

enum { BULK, HOLE, EDGE, ZONES };
enum { UNIAXIAL, BIAXIAL, SHEAR, STRAINS };
static const double gradient[STRAINS][2][2] = {
    {{1, 0}, {0, 0}}, {{1, 0}, {0, 1}}, {{0, 0.5}, {0.5, 0}}};

/* What is told of one combination. */
struct figures {
    double area;                   /* rms of family area/(pi delta^2) - 1 in the bulk */
    double energy[STRAINS][ZONES]; /* rms of W/W_classical - 1 */
    double all;                    /* rms of these */
    double crack;                  /* energy of a straight crack between two rows, over G0, - 1 */
    double ghost; /* rms force under biaxial strain where the family is whole, over E s/delta */
    double drift; /* net force of a random displacement over the sum of all forces' sizes */
    double bonds; /* a node */
};

/* Distance of a node from the rim of the nearest hole and from the plate's edge. */
static void distances(const struct kr_case *c, const double *x, double *hole, double *edge) {
    const struct kr_case_hole *holes = c->holes.item;
    *hole = INFINITY;
    *edge = fmin(fmin(x[0], c->width - x[0]), fmin(x[1], c->height - x[1]));
    for (size_t k = 0; k < c->holes.count; k++) {
        double away = hypot(x[0] - holes[k].centre[0], x[1] - holes[k].centre[1]);
        *hole = fmin(*hole, away - holes[k].radius);
    }
}

/* The zone of a node, ZONES between them: within delta of hole or edge, or 2 delta away from both.
 */
static int zone_of(const struct kr_case *c, const double *x) {
    double hole, edge;
    distances(c, x, &hole, &edge);
    if (fmin(hole, edge) > 2 * c->horizon)
        return BULK;
    return hole < c->horizon ? HOLE : edge < c->horizon ? EDGE : ZONES;
}

static double classical(const struct kr_material *m, int strain) {
    const double nu = m->poissons_ratio;
    const double over[STRAINS] = {2 * (1 - nu * nu), 1 - nu, 4 * (1 + nu)};
    return m->youngs_modulus * STRAIN * STRAIN / over[strain];
}

static void strain_body(struct kr_body *body, int strain) {
    for (int d = 0; d < 2; d++)
        for (size_t i = 0; i < body->n; i++)
            body->u[d][i] = STRAIN * (gradient[strain][d][0] * body->bonds->x[0][i] +
                                      gradient[strain][d][1] * body->bonds->x[1][i]);
}

static void measure_energy(const struct kr_case *c, struct kr_body *body, int strain,
                           double rms[ZONES]) {
    const struct kr_bonds *b = body->bonds;
    double sum[ZONES + 1] = {0}, volume[ZONES + 1] = {0};
    strain_body(body, strain);
    kr_body_energy(body);
    for (size_t i = 0; i < body->n; i++) {
        const double x[2] = {b->x[0][i], b->x[1][i]};
        double off = body->energy[i] / classical(&b->material, strain) - 1;
        int zone = zone_of(c, x);
        sum[zone] += off * off * b->volume[i];
        volume[zone] += b->volume[i];
    }
    for (int zone = 0; zone < ZONES; zone++)
        rms[zone] = sqrt(sum[zone] / volume[zone]);
}

static double measure_area(const struct kr_case *c, const struct kr_bonds *b) {
    double sum = 0, volume = 0;
    for (size_t i = 0; i < b->n; i++) {
        const double x[2] = {b->x[0][i], b->x[1][i]};
        double off = (b->family_volume[i] + b->volume[i]) / (M_PI * c->horizon * c->horizon) - 1;
        if (zone_of(c, x) == BULK) {
            sum += off * off * b->volume[i];
            volume += b->volume[i];
        }
    }
    return sqrt(sum / volume);
}

/* Where the family is whole, a uniform strain should pull at no node. */
static double measure_ghost(const struct kr_case *c, struct kr_body *body) {
    const struct kr_bonds *b = body->bonds;
    double sum = 0, volume = 0, scale = b->material.youngs_modulus * STRAIN / c->horizon;
    strain_body(body, BIAXIAL);
    kr_body_force(body, 0);
    for (size_t i = 0; i < body->n; i++) {
        const double x[2] = {b->x[0][i], b->x[1][i]};
        double hole, edge;
        distances(c, x, &hole, &edge);
        if (fmin(hole, edge) < c->horizon * 1.2) /* the rim cell's half is outside, too */
            continue;
        sum += (body->force[0][i] * body->force[0][i] + body->force[1][i] * body->force[1][i]) *
               b->volume[i];
        volume += b->volume[i];
    }
    return sqrt(sum / volume) / scale;
}

static double measure_drift(struct kr_body *body) {
    double net[2] = {0}, all = 0;
    uint64_t state = 1;
    for (int d = 0; d < 2; d++)
        for (size_t i = 0; i < body->n; i++) {
            state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
            body->u[d][i] = 1e-12 * ((double)(state >> 33) / 4294967296.0 - 0.25); /* m */
        }
    kr_body_force(body, 0);
    for (int d = 0; d < 2; d++)
        for (size_t i = 0; i < body->n; i++) {
            net[d] += body->bonds->volume[i] * body->force[d][i];
            all += body->bonds->volume[i] * fabs(body->force[d][i]);
        }
    return hypot(net[0], net[1]) / all;
}

/* The crack runs from left to right half way between the lower edge and the hole, through the
 * lattice, between two rows of nodes. */
static double measure_crack(const struct kr_case *c, const struct kr_bonds *b) {
    const struct kr_case_hole *hole = c->holes.item;
    const struct kr_material *m = &b->material;
    double y = c->spacing * round((hole->centre[1] - hole->radius) / 2 / c->spacing);
    double from = 0.1 * c->width, to = 0.9 * c->width, sum = 0;
    for (size_t slice = 0; slice < b->n_slices; slice++) {
        struct kr_bond_walk walk = kr_bonds_walk(b, slice);
        struct kr_bond bond;
        while (kr_bonds_next(b, &walk, &bond)) {
            double below = y - b->x[1][bond.i], above = bond.xi[1] - below;
            double x = b->x[0][bond.i] + bond.xi[0] * below / bond.xi[1];
            if (below > 0 && above > 0 && x > from && x <= to)
                sum += kr_exact_pair_energy(b, &bond, m->critical_stretch);
        }
    }
    return sum / (m->fracture_energy * (to - from)) - 1;
}

static struct figures measure(const struct kr_case *c, struct kr_nodes *nodes, int partial_volume,
                              int correction) {
    struct figures f = {0};
    struct kr_material material = kr_material_of(c);
    kr_surface_make(nodes, &material, correction, partial_volume, KR_MEAN_OVER_AXES);
    struct kr_bonds *bonds = kr_bonds_create(nodes, &material, partial_volume);
    struct kr_body *body = kr_body_create(bonds);
    f.bonds = (double)bonds->count / (double)bonds->n;
    f.area = measure_area(c, bonds);
    for (int strain = 0; strain < STRAINS; strain++) {
        measure_energy(c, body, strain, f.energy[strain]);
        for (int zone = 0; zone < ZONES; zone++)
            f.all += f.energy[strain][zone] * f.energy[strain][zone] / (STRAINS * ZONES);
    }
    f.all = sqrt(f.all);
    f.crack = measure_crack(c, bonds);
    f.ghost = measure_ghost(c, body);
    f.drift = measure_drift(body);
    kr_body_free(body);
    kr_bonds_free(bonds);
    return f;
}

static void print_row(int partial_volume, int correction, const struct figures *f) {
    char weight[32], factor[32];
    kr_case_word(KR_PARTIAL_VOLUME_WORDS, partial_volume, weight);
    kr_case_word(KR_SURFACE_WORDS, correction, factor);
    printf("| %s | %s |", weight, factor);
    if (correction == KR_SURFACE_NONE)
        printf(" %.3f |", 100 * f->area);
    else
        printf(" |");
    for (int zone = 0; zone < ZONES; zone++)
        for (int strain = 0; strain < STRAINS; strain++)
            printf(" %.2f |", 100 * f->energy[strain][zone]);
    printf(" %.2f | %+.2f | %.2f | %.0e | %.1f |\n", 100 * f->all, 100 * f->crack, 100 * f->ghost,
           f->drift, f->bonds);
    fflush(stdout);
}

int main(int argc, char **argv) {
    static const int volumes[] = {KR_PARTIAL_VOLUME_NONE, KR_PARTIAL_VOLUME_HHB_ONE_SIDED,
                                  KR_PARTIAL_VOLUME_HHB, KR_PARTIAL_VOLUME_EXACT,
                                  KR_PARTIAL_VOLUME_EXACT_CENTROID};
    static const int corrections[] = {KR_SURFACE_NONE, KR_SURFACE_VOLUME, KR_SURFACE_FORCE_DENSITY,
                                      KR_SURFACE_ENERGY};
    struct kr_case_arguments arguments;
    struct kr_case c;
    if (argc == 2 && !strcmp(argv[1], "--grids"))
        return puts(KR_GRID_WORDS) < 0;
    kr_case_arguments(argc, argv, usage, &arguments);
    struct kr_deck *deck = kr_case_open(&arguments, &c);
    char *path = kr_case_file(&c, "plate.nodes.h5");
    struct kr_nodes *nodes = kr_nodes_read(path);
    for (size_t v = 0; v < sizeof volumes / sizeof volumes[0]; v++)
        for (size_t k = 0; k < sizeof corrections / sizeof corrections[0]; k++) {
            struct figures f = measure(&c, nodes, volumes[v], corrections[k]);
            print_row(volumes[v], corrections[k], &f);
        }
    kr_nodes_free(nodes);
    kr_free(path);
    kr_deck_close(deck);
    kr_free(arguments.set);
    kr_free(arguments.left);
    return KR_EXIT_OK;
}
