/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Fragments by union-find over the living bonds; see fragments.h. Only a bond between two nodes that
 * do not yet hang together is looked up among the broken ones.
 */
#include "fragments.h"

#include <math.h>
#include <stdlib.h>

#include "base/h5.h"
#include "base/memory.h"
#include "search.h"
#include "csv_write.h"
#include "weight.h"

/* Directions in which a fragment's outermost nodes are sought. The largest distance is then short
 * by a part of at most 1 - cos(pi/180) in 2D, about 1 % in 3D. */
enum { DIRECTIONS = 90, DIRECTIONS_3D = 300 };
static const double PI = 3.14159265358979323846;

/* ---- bonds ------------------------------------------------------------------------------- */

struct bonds {
    const struct kr_record *record;
    struct kr_precrack *const *crack; /* (n_cracks) */
    size_t n_cracks;
    int partial_volume;
    double *size;     /* (n) m */
    uint64_t *broken; /* sorted: lower node times 2^32 plus higher node */
    size_t *up;       /* (n) union-find */
};

static uint64_t key_of(size_t i, size_t j) {
    return i < j ? ((uint64_t)i << 32 | j) : ((uint64_t)j << 32 | i);
}

static int by_key(const void *left, const void *right) {
    uint64_t a = *(const uint64_t *)left, b = *(const uint64_t *)right;
    return a < b ? -1 : a > b;
}

static const double *place(const struct kr_record *record, size_t i) {
    return record->position + (size_t)record->dim * i;
}

static int is_cut(const struct bonds *bonds, size_t i, size_t j) {
    for (size_t k = 0; k < bonds->n_cracks; k++)
        if (kr_precrack_meets(bonds->crack[k], place(bonds->record, i < j ? i : j),
                              place(bonds->record, i < j ? j : i)))
            return 1;
    return 0;
}

static int is_living(const struct bonds *bonds, size_t i, size_t j) {
    const double *a = place(bonds->record, i), *b = place(bonds->record, j);
    uint64_t key = key_of(i, j);
    double square = 0;
    for (int d = 0; d < bonds->record->dim; d++)
        square += (a[d] - b[d]) * (a[d] - b[d]);
    return kr_weight(bonds->partial_volume, sqrt(square), bonds->record->horizon, bonds->size[i],
                     bonds->size[j]) > 0 &&
           !bsearch(&key, bonds->broken, bonds->record->broken, sizeof key, by_key) &&
           !is_cut(bonds, i, j);
}

static size_t root_of(size_t *up, size_t i) {
    while (up[i] != i)
        i = up[i] = up[up[i]];
    return i;
}

/** Join node i to what it has living bonds to; the lowest node is the root. */
static void join_node(struct bonds *bonds, size_t i, const int *near, size_t count) {
    for (size_t k = 0; k < count; k++) {
        size_t j = (size_t)near[k], a = root_of(bonds->up, i), b;
        if (j < i || a == (b = root_of(bonds->up, j)) || !is_living(bonds, i, j))
            continue;
        bonds->up[a > b ? a : b] = a > b ? b : a;
    }
}

static void join_all(struct bonds *bonds) {
    const struct kr_record *record = bonds->record;
    double largest = 0, reach;
    struct kr_found found = {0};
    struct kr_search *search;
    for (size_t i = 0; i < record->n; i++)
        largest = fmax(largest, bonds->size[i]);
    reach = kr_weight_reach(bonds->partial_volume, record->horizon, largest);
    search = kr_search_create(record->dim, record->n, record->position, reach);
    for (size_t i = 0; i < record->n; i++) {
        kr_search_find(search, i, &found);
        join_node(bonds, i, found.near, found.count);
    }
    kr_search_free(search);
    kr_free(found.near);
}

static struct bonds bonds_of(const struct kr_record *record, const struct kr_case *c,
                             struct kr_precrack *const *crack) {
    struct bonds bonds = {record, crack, c->cracks.count, c->partial_volume};
    if (bonds.partial_volume == KR_PARTIAL_VOLUME_EXACT ||
        bonds.partial_volume == KR_PARTIAL_VOLUME_EXACT_CENTROID)
        bonds.partial_volume = KR_PARTIAL_VOLUME_HHB; /* the same bonds but for slivers */
    bonds.size = KR_NEW(double, record->n);
    bonds.up = KR_NEW(size_t, record->n);
    bonds.broken = KR_NEW(uint64_t, record->broken);
    for (size_t i = 0; i < record->n; i++) {
        bonds.size[i] = pow(record->volume[i], 1.0 / record->dim);
        bonds.up[i] = i;
    }
    for (size_t k = 0; k < record->broken; k++)
        bonds.broken[k] =
            key_of((size_t)record->bond[2 * k], (size_t)record->bond[2 * k + 1]);
    if (record->broken)
        qsort(bonds.broken, record->broken, sizeof *bonds.broken, by_key);
    return bonds;
}

/* ---- measures ---------------------------------------------------------------------------- */

static void direction(int dim, int k, double e[3]) {
    double z = dim == 2 ? 0 : (2 * k + 1.0) / DIRECTIONS_3D - 1;
    double angle = dim == 2 ? PI * k / DIRECTIONS : PI * (3 - sqrt(5)) * k; /* golden spiral */
    e[0] = sqrt(1 - z * z) * cos(angle);
    e[1] = sqrt(1 - z * z) * sin(angle);
    e[2] = z;
}

/** Distance of the outermost nodes from each other, direction by direction. */
static double extent_of(const struct kr_record *record, const size_t *node, size_t count) {
    int most = record->dim == 2 ? DIRECTIONS : DIRECTIONS_3D;
    double largest = 0;
    for (int k = 0; k < most && count > 1; k++) {
        double e[3], low = INFINITY, high = -INFINITY, square = 0;
        size_t lowest = node[0], highest = node[0];
        direction(record->dim, k, e);
        for (size_t m = 0; m < count; m++) {
            const double *x = place(record, node[m]);
            double along = x[0] * e[0] + x[1] * e[1] + (record->dim == 3 ? x[2] * e[2] : 0);
            lowest = along < low ? node[m] : lowest;
            highest = along > high ? node[m] : highest;
            low = fmin(low, along);
            high = fmax(high, along);
        }
        for (int d = 0; d < record->dim; d++)
            square += pow(place(record, highest)[d] - place(record, lowest)[d], 2);
        largest = fmax(largest, sqrt(square));
    }
    return largest;
}

static void add_node(const struct kr_record *record, const double *velocity, size_t i,
                     struct kr_fragment *fragment) {
    double mass = record->density * record->volume[i];
    fragment->count++;
    fragment->mass += mass;
    for (int d = 0; d < record->dim; d++)
        fragment->centre[d] += mass * place(record, i)[d];
    for (size_t d = 0; d < 3; d++)
        fragment->momentum[d] += velocity ? mass * velocity[3 * i + d] : NAN;
}

static void measure_extents(const struct kr_record *record, struct kr_fragments *fragments) {
    size_t *begin = KR_NEW(size_t, fragments->count + 2), *node = KR_NEW(size_t, record->n);
    for (size_t i = 0; i < record->n; i++)
        begin[fragments->of[i] + 2]++;
    for (size_t f = 2; f < fragments->count + 2; f++)
        begin[f] += begin[f - 1];
    for (size_t i = 0; i < record->n; i++)
        node[begin[fragments->of[i] + 1]++] = i;
    for (size_t f = 0; f < fragments->count; f++)
        fragments->item[f].extent =
            extent_of(record, node + begin[f], begin[f + 1] - begin[f]);
    kr_free(begin);
    kr_free(node);
}

static int heavier(const void *left, const void *right) {
    const struct kr_fragment *a = left, *b = right;
    if (a->mass != b->mass)
        return a->mass > b->mass ? -1 : 1;
    return a->first < b->first ? -1 : a->first > b->first;
}

/** Sort the fragments and let the nodes follow; `up` holds the root of each node. */
static void order(const struct kr_record *record, size_t *up, struct kr_fragments *fragments) {
    size_t *rank = KR_NEW(size_t, record->n);
    qsort(fragments->item, fragments->count, sizeof *fragments->item, heavier);
    for (size_t f = 0; f < fragments->count; f++)
        rank[fragments->item[f].first] = f;
    for (size_t i = 0; i < record->n; i++)
        fragments->of[i] = rank[root_of(up, i)];
    kr_free(rank);
}

void kr_fragments_find(const struct kr_record *record, const struct kr_case *c,
                       struct kr_precrack *const *crack, const double *velocity,
                       struct kr_fragments *fragments) {
    struct bonds bonds = bonds_of(record, c, crack);
    size_t room = 0;
    *fragments = (struct kr_fragments){.of = KR_NEW(size_t, record->n)};
    join_all(&bonds);
    for (size_t i = 0; i < record->n; i++) { /* roots are the lowest nodes, so they come first */
        size_t root = root_of(bonds.up, i);
        if (root == i) {
            KR_GROW(fragments->item, fragments->count, room);
            fragments->item[fragments->count] = (struct kr_fragment){.first = i};
            fragments->of[i] = fragments->count++;
        }
        fragments->of[i] = fragments->of[root];
        add_node(record, velocity, i, fragments->item + fragments->of[i]);
    }
    for (size_t f = 0; f < fragments->count; f++)
        for (int d = 0; d < record->dim; d++)
            fragments->item[f].centre[d] /= fragments->item[f].mass;
    order(record, bonds.up, fragments);
    measure_extents(record, fragments);
    kr_free(bonds.size);
    kr_free(bonds.broken);
    kr_free(bonds.up);
}

void kr_fragments_clear(struct kr_fragments *fragments) {
    kr_free(fragments->item);
    kr_free(fragments->of);
    *fragments = (struct kr_fragments){0};
}

/* ---- files ------------------------------------------------------------------------------- */

double *kr_fragments_velocity(const char *run, size_t n) {
    struct kr_h5 *file = kr_h5_open(run, "kirsch run", 1);
    size_t count;
    char **name = kr_h5_list(file, "/step", &count);
    double *velocity = NULL;
    for (size_t k = count; k-- > 0;) {
        char *path = kr_text("/step/%s/Velocity", name[k]);
        if (!velocity && kr_h5_has(file, path))
            velocity = kr_h5_read_double(file, path, n, 3);
        kr_free(path);
        kr_free(name[k]);
    }
    kr_free(name);
    kr_h5_close(file);
    return velocity;
}

void kr_fragments_write(const struct kr_fragments *fragments, int dim, const char *path) {
    struct kr_csv_writer table = kr_csv_begin(
        path, dim == 2 ? "fragment,nodes,mass [kg/m],x [m],y [m],z [m],momentum_x [kg/s],"
                         "momentum_y [kg/s],momentum_z [kg/s],extent [m]"
                       : "fragment,nodes,mass [kg],x [m],y [m],z [m],momentum_x [kg m/s],"
                         "momentum_y [kg m/s],momentum_z [kg m/s],extent [m]");
    for (size_t f = 0; f < fragments->count; f++) {
        const struct kr_fragment *one = fragments->item + f;
        fprintf(table.file, "%zu,%zu", f + 1, one->count);
        kr_csv_put(&table, one->mass);
        for (int d = 0; d < 3; d++)
            kr_csv_put(&table, one->centre[d]);
        for (int d = 0; d < 3; d++)
            kr_csv_put(&table, one->momentum[d]);
        kr_csv_put(&table, one->extent);
        fprintf(table.file, "\n");
    }
    kr_csv_finish(&table);
}
