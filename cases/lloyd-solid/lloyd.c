/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What Lloyd's steps would gain in space: a sphere of 6 spacings in a cube of 28, over three places of
 * its centre, on the grids of solids and on Voronoi cells around seeds that begin at the centroids of the
 * cut cells and are moved to the centroids of their own cells, again and again, where they lie within the
 * horizon of the sphere. These cells are summed over 8^3 samples a cube, which is enough to measure
 * them and no way to mesh. Prints a table in Markdown: sizes of cells near the sphere, then what the
 * solver makes of them under uniform strain.
 *
 *    strain       classical energy, nu = 1/4
 *    uniaxial     0.6 E s^2
 *    isotropic    3 E s^2
 *    shear        0.2 E s^2        gamma = s
 *
 * Q. Du, V. Faber, M. Gunzburger: Centroidal Voronoi tessellations. SIAM Review 41 (1999) 637-676.
 */
#include "base/child.h"
#include "base/error.h"
#include "base/memory.h"
#include "block.h"
#include "body.h"
#include "convert.h"
#include "surface.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CELLS = 28, FINE = 8, PLACES = 3, ZONES = 2, STRAINS = 3, ISOTROPIC = 1, TERMS = 5 };
static const double SPACING = 1e-4, RADIUS = 6, HORIZON = 3; /* m; spacings */
static const double STRAIN = 1e-6;                           /* the law is linear to 1e-6 there */
static const double gradient[STRAINS][3][3] = {
    {{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 0}, {0, 0, 0}, {0, 0, 0}}};
static const double classical[STRAINS] = {0.6, 3, 0.2};

struct figures {
    double least, most, scatter;           /* volumes of cells within a horizon of the sphere */
    double rim, along;                     /* there: scatter of the energy, force along the surface */
    double energy[STRAINS], ghost;         /* beyond, where families are whole: rms errors */
    double seconds;
};

/* ---- Voronoi cells by samples ---- */

static size_t bin_of(const double *p) {
    size_t at[3];
    for (int d = 0; d < 3; d++)
        at[d] = (size_t)fmin(fmax(floor(p[d]), 0), CELLS - 1);
    return (at[2] * CELLS + at[1]) * CELLS + at[0];
}

struct bins {
    size_t first[CELLS * CELLS * CELLS + 1], *seed;
};

static void sort_seeds(struct bins *bins, size_t n, double (*seed)[3]) {
    memset(bins->first, 0, sizeof bins->first);
    for (size_t s = 0; s < n; s++)
        bins->first[bin_of(seed[s]) + 1]++;
    for (size_t b = 0; b < CELLS * CELLS * CELLS; b++)
        bins->first[b + 1] += bins->first[b];
    for (size_t s = n; s-- > 0;) /* the lowest seed comes first again */
        bins->seed[--bins->first[bin_of(seed[s]) + 1]] = s;
    for (size_t b = 0; b < CELLS * CELLS * CELLS; b++) /* `first` was moved by one place */
        bins->first[b] = bins->first[b + 1];
    bins->first[CELLS * CELLS * CELLS] = n;
}

/* Seeds two cubes away may be the nearest beside a sphere, where cubes are joined. */
static size_t nearest(const struct bins *bins, double (*seed)[3], const double *p) {
    double least = INFINITY;
    size_t best = 0;
    long at[3];
    for (int d = 0; d < 3; d++)
        at[d] = (long)floor(p[d]);
    for (long k = at[2] - 2; k <= at[2] + 2; k++)
        for (long j = at[1] - 2; j <= at[1] + 2; j++)
            for (long i = at[0] - 2; i <= at[0] + 2; i++) {
                if (i < 0 || j < 0 || k < 0 || i >= CELLS || j >= CELLS || k >= CELLS)
                    continue;
                size_t b = (size_t)((k * CELLS + j) * CELLS + i);
                for (size_t s = bins->first[b]; s < bins->first[b + 1]; s++) {
                    const double *q = seed[bins->seed[s]];
                    double x = q[0] - p[0], y = q[1] - p[1], z = q[2] - p[2];
                    double away = x * x + y * y + z * z;
                    if (away < least) {
                        least = away;
                        best = bins->seed[s];
                    }
                }
            }
    return best;
}

static double away_from(const double *centre, const double *p) {
    return hypot(hypot(p[0] - centre[0], p[1] - centre[1]), p[2] - centre[2]) - RADIUS;
}

/** Volumes and moments of the cells of seeds, by the samples in a cube of the lattice. */
static void sample_cube(const struct bins *bins, double (*seed)[3], const double *centre,
                        const double corner[3], double (*sum)[4]) {
    for (int k = 0; k < FINE * FINE * FINE; k++) {
        const int at[3] = {k % FINE, k / FINE % FINE, k / FINE / FINE};
        double p[3];
        for (int d = 0; d < 3; d++)
            p[d] = corner[d] + (at[d] + 0.5) / FINE;
        if (away_from(centre, p) < 0)
            continue;
        double *to = sum[nearest(bins, seed, p)];
        to[3] += 1;
        for (int d = 0; d < 3; d++)
            to[d] += p[d];
    }
}

/** One of Lloyd's steps: seeds go to the centroids of their cells, volumes [spacings cubed] are told.
 *  `moves` 0: the seeds stay. */
static void step(size_t n, double (*seed)[3], double *volume, const double *centre, int moves) {
    struct bins *bins = KR_NEW(struct bins, 1);
    double(*sum)[4] = kr_alloc(n, sizeof *sum);
    const double band = HORIZON + 2;
    bins->seed = KR_NEW(size_t, n);
    memset(sum, 0, n * sizeof *sum);
    sort_seeds(bins, n, seed);
    for (int c = 0; c < CELLS * CELLS * CELLS; c++) {
        const double corner[3] = {c % CELLS, c / CELLS % CELLS, c / CELLS / CELLS};
        const double middle[3] = {corner[0] + 0.5, corner[1] + 0.5, corner[2] + 0.5};
        if (fabs(away_from(centre, middle)) < band + 1)
            sample_cube(bins, seed, centre, corner, sum);
    }
    for (size_t s = 0; s < n; s++) {
        if (away_from(centre, seed[s]) > HORIZON + 1 || sum[s][3] == 0)
            continue;
        volume[s] = sum[s][3] / (FINE * FINE * FINE);
        if (!moves || away_from(centre, seed[s]) > HORIZON)
            continue;
        for (int d = 0; d < 3; d++)
            seed[s][d] = sum[s][d] / sum[s][3];
    }
    kr_free(sum);
    kr_free(bins->seed);
    kr_free(bins);
}

/** Even the nodes of cut cells out. */
static void relax(struct kr_nodes *nodes, const double *centre, int steps) {
    double(*seed)[3] = kr_alloc(nodes->n, sizeof *seed), *volume = KR_NEW(double, nodes->n);
    for (size_t i = 0; i < nodes->n; i++) {
        volume[i] = nodes->volume[i] / pow(SPACING, 3);
        for (size_t d = 0; d < 3; d++)
            seed[i][d] = nodes->position[3 * i + d] / SPACING;
    }
    for (int s = 0; s < steps; s++)
        step(nodes->n, seed, volume, centre, 1);
    step(nodes->n, seed, volume, centre, 0);
    for (size_t i = 0; i < nodes->n; i++) {
        nodes->volume[i] = volume[i] * pow(SPACING, 3);
        for (size_t d = 0; d < 3; d++)
            nodes->position[3 * i + d] = seed[i][d] * SPACING;
    }
    kr_free(seed);
    kr_free(volume);
}

/* ---- what the solver makes of nodes ---- */

static struct kr_nodes *nodes_of(const double *centre, enum kr_grid grid, char *helper, double *seconds) {
    struct kr_case_void hollow = {.radius = RADIUS * SPACING};
    struct kr_block block = {.plate = {.width = CELLS * SPACING, .height = CELLS * SPACING,
                                       .spacing = SPACING, .padding = HORIZON * SPACING, .grid = grid,
                                       .gmsh = {helper, 0, 0}},
                             .depth = CELLS * SPACING, .n_voids = 1, .hollow = &hollow};
    struct kr_block_report report;
    for (int d = 0; d < 3; d++)
        hollow.centre[d] = centre[d] * SPACING;
    struct kr_mesh *mesh = kr_block_mesh(&block, &report);
    struct kr_nodes *nodes = kr_convert(mesh);
    nodes->spacing = SPACING;
    *seconds = report.seconds;
    kr_block_report_free(&report);
    kr_mesh_free(mesh);
    return nodes;
}

/** The zone of a node; ZONES: in neither. The outer one has whole families, off the lattice or not. */
static int zone_of(const struct kr_bonds *b, size_t i, const double *centre) {
    const double p[3] = {b->x[0][i] / SPACING, b->x[1][i] / SPACING, b->x[2][i] / SPACING};
    double away = away_from(centre, p);
    return away < HORIZON ? 0 : away > 1.2 * HORIZON && away < 1.6 * HORIZON ? 1 : ZONES;
}

static void strain_body(struct kr_body *body, int strain) {
    for (int d = 0; d < 3; d++)
        for (size_t i = 0; i < body->n; i++) {
            body->u[d][i] = 0;
            for (int e = 0; e < 3; e++)
                body->u[d][i] += STRAIN * gradient[strain][d][e] * body->bonds->x[e][i];
        }
}

/** Coefficients of the polynomial in t nearest to given moments  sum v t^k y,  sum v t^k. */
static void fit(double *y, const double *t) {
    double a[TERMS][TERMS];
    for (int r = 0; r < TERMS; r++)
        for (int c = 0; c < TERMS; c++)
            a[r][c] = t[r + c];
    for (int k = 0; k < TERMS; k++) /* a Gram matrix: no pivots are needed */
        for (int r = k + 1; r < TERMS; r++) {
            double factor = a[r][k] / a[k][k];
            for (int c = k; c < TERMS; c++)
                a[r][c] -= factor * a[k][c];
            y[r] -= factor * y[k];
        }
    for (int r = TERMS; r-- > 0;) {
        for (int c = r + 1; c < TERMS; c++)
            y[r] -= a[r][c] * y[c];
        y[r] /= a[r][r];
    }
}

static double value_at(const double *coefficient, double t) {
    double sum = 0;
    for (int k = TERMS; k-- > 0;)
        sum = sum * t + coefficient[k];
    return sum;
}

/** Under isotropic strain all depends on the distance from the sphere alone: what the energy scatters
 *  about a quartic in it, and forces along the surface, are the grid's doing. */
static void measure_rim(const struct kr_body *body, const double *centre, double W, double pull,
                        struct figures *f) {
    const struct kr_bonds *b = body->bonds;
    double y[TERMS] = {0}, t[2 * TERMS] = {0}, squares = 0, along = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < b->n; i++) {
            double q[3], out = 0, all = 0;
            if (zone_of(b, i, centre) != 0)
                continue;
            for (int d = 0; d < 3; d++)
                q[d] = b->x[d][i] / SPACING - centre[d];
            double r = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]), at = (r - RADIUS) / HORIZON;
            for (int k = 0; k < 2 * TERMS && !pass; k++) {
                t[k] += b->volume[i] * pow(at, k);
                if (k < TERMS)
                    y[k] += b->volume[i] * pow(at, k) * body->energy[i] / W;
            }
            for (int d = 0; d < 3; d++) {
                out += body->force[d][i] * q[d] / r;
                all += body->force[d][i] * body->force[d][i];
            }
            squares += pass ? b->volume[i] * pow(body->energy[i] / W - value_at(y, at), 2) : 0;
            along += pass ? b->volume[i] * (all - out * out) : 0;
        }
        if (!pass)
            fit(y, t);
    }
    f->rim += sqrt(squares / t[0]) / PLACES;
    f->along += sqrt(fmax(along, 0) / t[0]) / pull / PLACES;
}

static void measure_strain(struct kr_body *body, const double *centre, int strain, struct figures *f) {
    const struct kr_bonds *b = body->bonds;
    double W = classical[strain] * b->material.youngs_modulus * STRAIN * STRAIN;
    double pull = b->material.youngs_modulus * STRAIN / (HORIZON * SPACING);
    double sum = 0, ghost = 0, volume = 0;
    strain_body(body, strain);
    kr_body_energy(body);
    kr_body_force(body, 0);
    if (strain == ISOTROPIC)
        measure_rim(body, centre, W, pull, f);
    for (size_t i = 0; i < b->n; i++) {
        if (zone_of(b, i, centre) != 1)
            continue;
        sum += b->volume[i] * pow(body->energy[i] / W - 1, 2);
        volume += b->volume[i];
        for (int d = 0; d < 3; d++)
            ghost += b->volume[i] * pow(body->force[d][i] / pull, 2);
    }
    f->energy[strain] += sqrt(sum / volume) / PLACES;
    if (strain == ISOTROPIC)
        f->ghost += sqrt(ghost / volume) / PLACES;
}

static void measure_volumes(const struct kr_bonds *b, const double *centre, struct figures *f) {
    double sum = 0, squares = 0, count = 0;
    for (size_t i = 0; i < b->n; i++) {
        double share = b->volume[i] / pow(SPACING, 3);
        if (zone_of(b, i, centre) != 0)
            continue;
        f->least = fmin(f->least, share);
        f->most = fmax(f->most, share);
        sum += share;
        squares += share * share;
        count++;
    }
    f->scatter += sqrt(fmax(squares / count - pow(sum / count, 2), 0)) / (sum / count) / PLACES;
}

/** Add what a grid, or `lloyd` steps from the cut cells, gives with the sphere at one place. */
static void measure(const double *centre, enum kr_grid grid, int lloyd, char *helper, struct figures *f) {
    double seconds;
    struct kr_nodes *nodes = nodes_of(centre, grid, helper, &seconds);
    double began = kr_child_clock();
    if (lloyd >= 0)
        relax(nodes, centre, lloyd);
    f->seconds += (seconds + (lloyd >= 0 ? kr_child_clock() - began : 0)) / PLACES;
    struct kr_material material = kr_material_make(kr_laws[0], KR_SOLID, 3e9, 1190, 200, HORIZON * SPACING);
    kr_surface_make(nodes, &material, KR_SURFACE_ENERGY, KR_PARTIAL_VOLUME_HHB, KR_MEAN_OVER_AXES);
    struct kr_bonds *bonds = kr_bonds_create(nodes, &material, KR_PARTIAL_VOLUME_HHB);
    struct kr_body *body = kr_body_create(bonds);
    measure_volumes(bonds, centre, f);
    for (int strain = 0; strain < STRAINS; strain++)
        measure_strain(body, centre, strain, f);
    kr_body_free(body);
    kr_bonds_free(bonds);
    kr_nodes_free(nodes);
}

static void print_row(const char *name, enum kr_grid grid, int lloyd, char *helper) {
    struct figures f = {.least = INFINITY};
    for (int k = 0; k < PLACES; k++) {
        double centre[3];
        for (int d = 0; d < 3; d++) /* multiples of the golden ratio's powers: spread over a cube */
            centre[d] = CELLS / 2 + fmod((k + 1) * pow(0.8191725134, d + 1), 1);
        measure(centre, grid, lloyd, helper, &f);
    }
    printf("| %s | %.2f | %.2f | %.3f |", name, f.least, f.most, f.scatter);
    printf(" %.2f | %.2f |", 100 * f.rim, 100 * f.along);
    for (int strain = 0; strain < STRAINS; strain++)
        printf(" %.2f |", 100 * f.energy[strain]);
    printf(" %.2f |", 100 * f.ghost);
    printf(" %.2f |\n", f.seconds);
    fflush(stdout);
}

int main(int argc, char **argv) {
    kr_error_program("lloyd");
    if (argc != 2)
        kr_stop(KR_EXIT_INPUT, "lloyd KIRSCH-GMSH: `make lloyd-solid` calls it");
    puts("| cells | least | most | scatter | rim: energy | force along | beyond: uniaxial | isotropic |"
         " shear | force | s |\n|---|---|---|---|---|---|---|---|---|---|---|");
    print_row("`uniform`", KR_GRID_UNIFORM, -1, argv[1]);
    print_row("`near-boundary`", KR_GRID_NEAR_BOUNDARY, -1, argv[1]);
    print_row("`voronoi`: cut cubes", KR_GRID_VORONOI, -1, argv[1]);
    print_row("Voronoi cells of their centroids", KR_GRID_VORONOI, 0, argv[1]);
    print_row("after 1 of Lloyd's steps", KR_GRID_VORONOI, 1, argv[1]);
    print_row("after 5", KR_GRID_VORONOI, 5, argv[1]);
    return 0;
}
