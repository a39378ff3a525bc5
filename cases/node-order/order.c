/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What the order of the nodes does to the loop over bonds: rows, as kirsch-nodes gives them, against the
 * parts of METIS (kirsch-nodes --partition), reverse Cuthill-McKee, two curves that fill space, and none.
 *
 * The solver stores eight nodes that follow each other as a slice, and bonds to nodes that follow each
 * other as one row of it (docs/architecture.md). So an order also decides how full these rows are.
 */
#include "base/error.h"
#include "base/memory.h"
#include "body.h"
#include "search.h"
#include "weight.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const char usage[] =
    "order --output FOLDER case.yaml: time the loop over bonds for the nodes in FOLDER in several\n"
    "orders; prints rows of a table. `make node-order` calls it.\n";

struct key {
    uint64_t major, minor;
    size_t node;
};

static int by_key(const void *a, const void *b) {
    const struct key *p = a, *q = b;
    if (p->major != q->major)
        return p->major < q->major ? -1 : 1;
    return (p->minor > q->minor) - (p->minor < q->minor);
}

/* ---- orders: a key for each node ---- */

static uint64_t row_of(const struct kr_nodes *nodes, size_t i) {
    (void)nodes;
    return i;
}

static uint64_t part_of(const struct kr_nodes *nodes, size_t i) {
    return (uint64_t)nodes->partition[i];
}

static uint64_t random_of(const struct kr_nodes *nodes, size_t i) {
    (void)nodes;
    uint64_t x = (i + 1) * UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ (x >> 31)) * UINT64_C(0xbf58476d1ce4e5b9);
    return x ^ (x >> 29);
}

/* Column and row, of 2^16 each over the largest extent; plane bodies only. */
static void place_of(const struct kr_nodes *nodes, size_t i, uint32_t at[2]) {
    static double lower[2], scale;
    const size_t dim = (size_t)nodes->dim;
    if (i == 0) {
        double upper[2] = {-INFINITY, -INFINITY};
        lower[0] = lower[1] = INFINITY;
        for (size_t k = 0; k < nodes->n; k++)
            for (size_t d = 0; d < 2; d++) {
                lower[d] = fmin(lower[d], nodes->position[dim * k + d]);
                upper[d] = fmax(upper[d], nodes->position[dim * k + d]);
            }
        scale = 65535 / fmax(upper[0] - lower[0], upper[1] - lower[1]);
    }
    for (size_t d = 0; d < 2; d++)
        at[d] = (uint32_t)(scale * (nodes->position[dim * i + d] - lower[d]));
}

/* Morton's curve: the bits of column and row in turn. */
static uint64_t morton_of(const struct kr_nodes *nodes, size_t i) {
    uint32_t at[2];
    uint64_t key = 0;
    place_of(nodes, i, at);
    for (int bit = 15; bit >= 0; bit--)
        key = key << 2 | (uint64_t)(at[1] >> bit & 1) << 1 | (at[0] >> bit & 1);
    return key;
}

/* Hilbert's curve: a quarter at a time, turned as it is entered. */
static uint64_t hilbert_of(const struct kr_nodes *nodes, size_t i) {
    uint32_t at[2];
    uint64_t key = 0;
    place_of(nodes, i, at);
    for (uint32_t side = 1u << 15; side; side >>= 1) {
        uint32_t x = (at[0] & side) != 0, y = (at[1] & side) != 0;
        key = key << 2 | ((3 * x) ^ y);
        if (y == 0) {
            if (x)
                for (int d = 0; d < 2; d++)
                    at[d] = (side - 1) & ~at[d];
            uint32_t kept = at[0];
            at[0] = at[1];
            at[1] = kept;
        }
    }
    return key;
}

/* Reverse Cuthill-McKee over the bonds, from the first node on; `rank` (n). */
static void cuthill_mckee(const struct kr_nodes *nodes, double horizon, uint64_t *rank) {
    enum { ROOM = 4096 };
    struct kr_search *search = kr_search_create(nodes->dim, nodes->n, nodes->position, horizon);
    int *queue = KR_NEW(int, nodes->n), *near = KR_NEW(int, ROOM);
    size_t *degree = KR_NEW(size_t, nodes->n), end = 0;
    struct key *waiting = KR_NEW(struct key, ROOM);
    memset(rank, 0xff, nodes->n * sizeof *rank);
    for (size_t i = 0; i < nodes->n; i++)
        degree[i] = kr_search_near(search, i, near, ROOM);
    for (size_t seed = 0, at = 0; seed < nodes->n; seed++) {
        if (rank[seed] != UINT64_MAX)
            continue;
        rank[seed] = nodes->n - 1 - end;
        queue[end++] = (int)seed;
        for (; at < end; at++) {
            size_t count = kr_search_near(search, (size_t)queue[at], near, ROOM), new = 0;
            kr_assert(count <= ROOM);
            for (size_t k = 0; k < count; k++)
                if (rank[near[k]] == UINT64_MAX)
                    waiting[new++] = (struct key){degree[near[k]], (uint64_t)near[k], (size_t)near[k]};
            qsort(waiting, new, sizeof *waiting, by_key);
            for (size_t k = 0; k < new; k++) {
                rank[waiting[k].node] = nodes->n - 1 - end;
                queue[end++] = (int)waiting[k].node;
            }
        }
    }
    kr_free(queue);
    kr_free(near);
    kr_free(degree);
    kr_free(waiting);
    kr_search_free(search);
}

/* ---- measuring ---- */

static double cpu_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Seconds of processor time of one evaluation of all forces: the best of several. */
static double seconds_of(struct kr_body *body) {
    enum { RUNS = 9, EACH = 3 };
    double best = INFINITY;
    for (int run = 0; run < RUNS; run++) {
        double begun = cpu_seconds();
        for (int k = 0; k < EACH; k++)
            kr_body_force(body, 0);
        best = fmin(best, (cpu_seconds() - begun) / EACH);
    }
    return best;
}

static double measure(const struct kr_case *c, const char *path, const char *name, struct key *key,
                      double rows) {
    struct kr_material material = kr_material_of(c);
    struct kr_nodes *nodes = kr_nodes_read(path);
    size_t *order = KR_NEW(size_t, nodes->n);
    nodes->partition = kr_free(nodes->partition); /* families do not ask for it */
    qsort(key, nodes->n, sizeof *key, by_key);
    for (size_t i = 0; i < nodes->n; i++)
        order[i] = key[i].node;
    kr_nodes_reorder(nodes, order);
    struct kr_bonds *bonds = kr_bonds_create(nodes, &material, c->partial_volume);
    struct kr_body *body = kr_body_create(bonds);
    struct kr_bonds_size size = kr_bonds_size(bonds);
    for (int d = 0; d < body->dim; d++)
        for (size_t i = 0; i < body->n; i++)
            body->u[d][i] = 1e-5 * bonds->x[d][i];
    double each = seconds_of(body) / (double)bonds->count;
    rows = rows > 0 ? rows : each;
    printf("| %s | %.2f | %.2f | %.0f %% | %.0f %% | %.1f |\n", name, 1e9 * each, each / rows,
           100 * size.lane_fill, 100 * size.lattice_share,
           (double)size.bytes / (double)bonds->count);
    fflush(stdout);
    kr_body_free(body);
    kr_bonds_free(bonds);
    kr_nodes_free(nodes);
    kr_free(order);
    return rows;
}

static void measure_all(const struct kr_case *c, const struct kr_nodes *nodes, const char *path) {
    static const struct {
        const char *name;
        uint64_t (*key)(const struct kr_nodes *, size_t);
    } order[] = {{"rows", row_of},        {"METIS, rows in each part", part_of}, {"Morton", morton_of},
                 {"Hilbert", hilbert_of}, {"reverse Cuthill-McKee", NULL},       {"random", random_of}};
    struct key *key = KR_NEW(struct key, nodes->n);
    uint64_t *rank = KR_NEW(uint64_t, nodes->n);
    double rows = 0;
    cuthill_mckee(nodes, c->horizon, rank);
    for (size_t k = 0; k < sizeof order / sizeof *order; k++) {
        for (size_t i = 0; i < nodes->n; i++)
            key[i] = (struct key){order[k].key ? order[k].key(nodes, i) : rank[i], i, i};
        rows = measure(c, path, order[k].name, key, rows);
    }
    kr_free(key);
    kr_free(rank);
}

int main(int argc, char **argv) {
    struct kr_case_arguments arguments;
    struct kr_case c;
    kr_case_arguments(argc, argv, usage, &arguments);
    struct kr_deck *deck = kr_case_open(&arguments, &c);
    char *path = kr_case_file(&c, "plate.nodes.h5");
    struct kr_nodes *nodes = kr_nodes_read(path);
    c.partial_volume = kr_weights_choose(deck, &c, nodes);
    if (!nodes->partition)
        kr_stop(KR_EXIT_INPUT, "%s has no parts; make it with kirsch-nodes --partition 64", path);
    measure_all(&c, nodes, path);
    kr_nodes_free(nodes);
    kr_free(path);
    kr_deck_close(deck);
    kr_free(arguments.set);
    kr_free(arguments.left);
    return KR_EXIT_OK;
}
