/* SPDX-License-Identifier: BSD-3-Clause
 *
 * kirsch-bench: how fast the loop over bonds is. Whole steps (bonds tested, forces, kick and drift)
 * on node sets made here, the best of several short runs; one line a figure into a CSV file. With
 * --growth: how that depends on nodes, m and threads.
 *
 * A directed bond update is a bond seen from one of its two ends.
 */
#include "base/error.h"
#include "base/memory.h"
#include "body.h"

#include <errno.h>
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

/* The plane set: the plates paper's plate, 1250 x 625 nodes at m = 4. The solid one: the block of
 * cases/bench/lammps_pmb.in, 60^3 nodes at m = 3.015. */
enum { COLUMNS = 1250, ROWS = 625, PATCHES = 8, EDGE = 60 };
static const double SPACING = 0.04e-3;

enum where { JITTER_PATCHES, JITTER_ALL, LATTICE, BLOCK };

/* One measurement. */
struct set {
    enum where where;
    int threads, mixed;
    int columns, rows;     /* of a plate; 0: COLUMNS, ROWS */
    double m;              /* horizon over spacing; 0: 4, of the block 3.015 */
    double rate;           /* out: directed bond updates a second */
    double bytes_per_node; /* out: in the loop, without the node file's content */
    double peak_per_node;  /* out: at the most so far in this process, with it */
    int terms;             /* out: of the loop's polynomial */
    double bytes;          /* out: moved per directed bond */
};

/* A number in [-1, 1] that depends on k alone. */
static double noise(uint64_t k) {
    k = (k + 1) * UINT64_C(0x9E3779B97F4A7C15);
    k = (k ^ (k >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    k = (k ^ (k >> 27)) * UINT64_C(0x94D049BB133111EB);
    return (double)((k ^ (k >> 31)) >> 11) * 0x1p-52 - 1;
}

/* Whether a node lies in one of the patches, rings around eight places, that stand for the boxes
 * around pores: about a tenth of the plate. */
static int in_patch(double x, double y) {
    for (int p = 0; p < PATCHES; p++) {
        double cx = COLUMNS * SPACING * (p % 4 + 0.5) / 4, cy = ROWS * SPACING * (p / 4 + 0.5) / 2;
        if (hypot(x - cx, y - cy) < 2.2e-3)
            return 1;
    }
    return 0;
}

static struct kr_nodes *make_block(void) {
    struct kr_nodes *nodes = kr_nodes_create(3, (size_t)EDGE * EDGE * EDGE);
    nodes->spacing = SPACING;
    for (size_t i = 0; i < nodes->n; i++) {
        nodes->position[3 * i] = SPACING * (double)(i % EDGE);
        nodes->position[3 * i + 1] = SPACING * (double)(i / EDGE % EDGE);
        nodes->position[3 * i + 2] = SPACING * (double)(i / EDGE / EDGE);
        nodes->volume[i] = SPACING * SPACING * SPACING;
        nodes->factor[i] = 1 + 0.01 * noise(7 * i);
    }
    return nodes;
}

static struct kr_nodes *make_plate(const struct set *set) {
    const size_t columns = set->columns ? (size_t)set->columns : COLUMNS;
    struct kr_nodes *nodes = kr_nodes_create(2, columns * (set->rows ? (size_t)set->rows : ROWS));
    nodes->spacing = SPACING;
    for (size_t i = 0; i < nodes->n; i++) {
        double *x = nodes->position + 2 * i;
        x[0] = SPACING * ((double)(i % columns) + 0.5);
        x[1] = SPACING * ((double)(i / columns) + 0.5);
        nodes->volume[i] = SPACING * SPACING;
        if (set->where == JITTER_ALL || (set->where == JITTER_PATCHES && in_patch(x[0], x[1]))) {
            x[0] += 0.2 * SPACING * noise(3 * i);
            x[1] += 0.2 * SPACING * noise(3 * i + 1);
            nodes->volume[i] *= 1 + 0.15 * noise(3 * i + 2);
        }
        nodes->factor[i] = 1 + 0.01 * noise(7 * i);
    }
    return nodes;
}

static struct kr_body *make_body(const struct kr_nodes *nodes, const struct set *set) {
    const int solid = set->where == BLOCK;
    omp_set_num_threads(set->threads);
    struct kr_material pmma =
        kr_material_make(kr_law_named("pmb"), solid ? KR_SOLID : KR_PLANE_STRESS, 3.24e9, 1190, 200,
                         (set->m > 0 ? set->m : solid ? 3.015 : 4) * SPACING);
    struct kr_bonds *bonds = kr_bonds_create(
        nodes, &pmma, solid ? KR_PARTIAL_VOLUME_NONE : KR_PARTIAL_VOLUME_HHB);
    struct kr_body *body = kr_body_create(bonds);
    if (set->mixed)
        kr_body_mix(body);
    for (size_t i = 0; i < body->n; i++)
        for (int d = 0; d < body->dim; d++)
            body->u[d][i] = 1e-4 * SPACING * noise(3 * i + (size_t)d);
    return body;
}

/* Seconds: processor time of one thread, which others on the machine lengthen less, else wall time. */
static double clock_of(int threads) {
    struct timespec now;
    clock_gettime(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Directed bond updates a second: the best of several runs of some steps. */
static double rate_of(struct kr_body *body, int threads) {
    enum { RUNS = 7, STEPS = 8 };
    double best = INFINITY;
    for (int run = 0; run < RUNS; run++) {
        double begun = clock_of(threads);
        for (int step = 0; step < STEPS; step++) {
            kr_body_force(body, 1);
            kr_body_advance(body, 1e-9, 1e-9);
        }
        best = fmin(best, clock_of(threads) - begun);
    }
    return (double)body->bonds->count * STEPS / best;
}

static void put(FILE *file, const char *name, double value, const char *unit) {
    fprintf(file, "%s,%.6g,%s\n", name, value, unit);
    kr_say("  %-30s %10.4g %s", name, value, unit);
}

/* Bytes a step moves, per directed bond, if each array comes from memory once: what the families
 * hold; u read and force written (a written line is read first) by the loop; u, v and force read, u
 * and v written by kick and drift. */
static double bytes_of(const struct kr_body *body) {
    const double numbers = body->dim * (1 + 2 + 3 + 2);
    return ((double)kr_bonds_size(body->bonds).bytes + numbers * 8 * (double)body->n) /
           (double)body->bonds->count;
}

static void measure(struct set *set) {
    struct kr_nodes *nodes = set->where == BLOCK ? make_block() : make_plate(set);
    size_t before = kr_memory_bytes();
    struct kr_body *body = make_body(nodes, set);
    struct kr_bonds *bonds = body->bonds;
    set->rate = rate_of(body, set->threads);
    set->bytes_per_node = (double)(kr_memory_bytes() - before) / (double)nodes->n;
    set->peak_per_node = (double)kr_memory_peak() / (double)nodes->n;
    set->terms = bonds->fit.pull.terms;
    set->bytes = bytes_of(body);
    kr_body_free(body);
    kr_bonds_free(bonds);
    kr_nodes_free(nodes);
}

/* Multiply-adds a second of so many threads at once. */
static double multiply_adds_of(const struct kr_kernel *kernel, int threads) {
    enum { RUNS = 15, COUNT = 40000000 };
    double best = INFINITY, sum = 0;
    for (int run = 0; run < RUNS; run++) {
        double begun = clock_of(threads);
#pragma omp parallel for schedule(static, 1) num_threads(threads) reduction(+ : sum)
        for (int k = 0; k < threads; k++)
            sum += kernel->multiply_adds(COUNT);
        best = fmin(best, clock_of(threads) - begun);
    }
    kr_assert(sum > 0); /* it was done */
    return (double)threads * COUNT / best;
}

/* Bytes a second that a = b + 2 c moves on one core; what is written is read first. */
static double triad_of(void) {
    enum { RUNS = 7, COUNT = 8000000 };
    double *a = KR_NEW(double, COUNT), *b = KR_NEW(double, COUNT), *c = KR_NEW(double, COUNT);
    double best = INFINITY;
    for (int run = 0; run < RUNS; run++) {
        for (size_t i = 0; i < COUNT; i++)
            b[i] = c[i] = run;
        double begun = clock_of(1);
        for (size_t i = 0; i < COUNT; i++)
            a[i] = b[i] + 2 * c[i];
        best = fmin(best, clock_of(1) - begun);
        kr_assert(a[COUNT / 2] == 3 * run);
    }
    kr_free(a);
    kr_free(b);
    kr_free(c);
    return 4.0 * sizeof(double) * COUNT / best;
}

/* The most a core could do of a lattice set, and the share that it did of this set and of a lattice
 * alone. A lattice bond of the plane takes 7 multiplications or multiply-adds and one for each term
 * of the polynomial; docs/performance.md. */
static void put_share(FILE *file, const struct set *set, const struct set *lattice) {
    double adds = multiply_adds_of(kr_kernel_best(), 1), triad = triad_of();
    double limit = fmin(adds / (7 + set->terms), triad / set->bytes);
    put(file, "multiply_adds_double_1", adds, "1/s");
    put(file, "triad_1", triad, "B/s");
    put(file, "bytes_per_bond_2d", set->bytes, "B");
    put(file, "limit_2d", limit, "1/s");
    put(file, "share_of_limit_2d", set->rate / limit, "1");
    put(file, "share_of_limit_2d_lattice", lattice->rate / limit, "1");
}

/* The processor time of LAMMPS' loop by its log [s]; NAN where it cannot be read. */
static double lammps_time(const char *path) {
    FILE *log = fopen(path, "r");
    char line[512];
    double seconds = NAN, percent = 100;
    while (log && fgets(line, sizeof line, log)) {
        sscanf(line, "Loop time of %lf", &seconds);
        sscanf(line, "%lf%% CPU use", &percent);
    }
    if (log)
        fclose(log);
    return seconds * percent / 100;
}

static struct set measure_and_put(FILE *file, const char *name, enum where where, int threads,
                                  int mixed) {
    struct set set = {.where = where, .threads = threads, .mixed = mixed};
    measure(&set);
    put(file, name, set.rate, "1/s");
    return set;
}

static void measure_all(FILE *file, const char *log) {
    const int two = omp_get_num_procs() > 1;
    struct set plane = measure_and_put(file, "pmb_2d_double_1", JITTER_PATCHES, 1, 0);
    put(file, "memory_per_node_2d_B", plane.bytes_per_node, "B");
    put(file, "memory_peak_per_node_2d_B", plane.peak_per_node, "B");
    struct set lattice = measure_and_put(file, "pmb_2d_lattice_double_1", LATTICE, 1, 0);
    put_share(file, &plane, &lattice);
    if (two) {
        struct set both = measure_and_put(file, "pmb_2d_double_2", JITTER_PATCHES, 2, 0);
        put(file, "pmb_2d_threads_2_over_1", both.rate / plane.rate, "1");
        put(file, "multiply_adds_threads_2_over_1",
            multiply_adds_of(kr_kernel_best(), 2) / multiply_adds_of(kr_kernel_best(), 1), "1");
    }
    measure_and_put(file, "pmb_2d_mixed_1", JITTER_PATCHES, 1, 1);
    measure_and_put(file, "pmb_2d_general_double_1", JITTER_ALL, 1, 0);
    struct set solid = measure_and_put(file, "pmb_3d_double_1", BLOCK, 1, 0);
    if (two)
        measure_and_put(file, "pmb_3d_double_2", BLOCK, 2, 0);
    measure_and_put(file, "pmb_3d_mixed_1", BLOCK, 1, 1);
    /* Bonds and steps of cases/bench/lammps_pmb.in. */
    double lammps = 24866488.0 * 200 / lammps_time(log);
    if (isfinite(lammps)) {
        put(file, "lammps_3d_double_1", lammps, "1/s");
        put(file, "pmb_3d_over_lammps", solid.rate / lammps, "1");
    } else {
        kr_say("  no log of LAMMPS at %s: no comparison with it", log);
    }
}

static void put_growth(struct set set) {
    measure(&set);
    kr_say("  %5d x %-4d  m %-4g  %d threads  %7.3g updates/s  %6.1f B a node",
           set.columns ? set.columns : COLUMNS, set.rows ? set.rows : ROWS, set.m > 0 ? set.m : 4,
           set.threads, set.rate, set.bytes_per_node);
}

/* How the cost grows with nodes, m and threads: one line a measurement. */
static void measure_growth(void) {
    const int threads = omp_get_num_procs();
    for (int shift = 4; shift >= -1; shift--)
        put_growth((struct set){.threads = 1,
                                .columns = shift < 0 ? 2 * COLUMNS : COLUMNS >> shift,
                                .rows = shift < 0 ? 2 * ROWS : ROWS >> shift});
    for (int m = 2; m <= 8; m += 2)
        put_growth((struct set){.threads = 1, .columns = COLUMNS / 2, .rows = ROWS / 2, .m = m});
    for (int k = 1; k <= threads; k *= 2)
        put_growth((struct set){.threads = k});
}

int main(int argc, char **argv) {
    kr_error_program("kirsch-bench");
    if (argc == 2 && !strcmp(argv[1], "--growth")) {
        measure_growth();
        return KR_EXIT_OK;
    }
    if (argc != 3)
        kr_stop(KR_EXIT_INPUT, "expected the CSV file to write and the log of LAMMPS to read, or "
                               "--growth");
    FILE *file = fopen(argv[1], "w");
    if (!file)
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s", argv[1], strerror(errno));
    fprintf(file, "name,value,unit\n");
    kr_say("loop '%s', plate of %d x %d nodes, block of %d^3", kr_kernel_best()->name, COLUMNS, ROWS,
           EDGE);
    measure_all(file, argv[2]);
    if (fclose(file))
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s", argv[1], strerror(errno));
    return KR_EXIT_OK;
}
