/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Node sets for tests, made without a mesh: a lattice, and a lattice with a hole that cells of
 * unequal size surround, as near-boundary meshes have them.
 */
#ifndef KR_PLATES_H
#define KR_PLATES_H

#include "body.h"
#include "cell.h"
#include "nodes.h"
#include "surface.h"

#include <math.h>
#include <string.h>

/* PMMA of the plates paper, table 3. Its horizon there is 0.16 mm. */
enum { KR_PMMA_DENSITY = 1190, KR_PMMA_FRACTURE_ENERGY = 200 };
static const double KR_PMMA_MODULUS = 3.24e9;

static inline struct kr_material kr_pmma(int model, double horizon) {
    return kr_material_make(kr_laws[0], model, KR_PMMA_MODULUS, KR_PMMA_DENSITY,
                            KR_PMMA_FRACTURE_ENERGY, horizon);
}

/** Even numbers in (low, high) from a seed: splitmix64 (Vigna), the same on every machine. */
static inline double kr_random(uint64_t *seed, double low, double high) {
    uint64_t z = (*seed += UINT64_C(0x9E3779B97F4A7C15));
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return low + (high - low) * ((double)((z ^ (z >> 31)) >> 11) + 0.5) / 9007199254740992.0;
}

/** Centres of columns x rows square cells; the lower left corner of the first is at (0, 0). */
static inline struct kr_nodes *kr_plate_lattice(size_t columns, size_t rows, double spacing) {
    struct kr_nodes *nodes = kr_nodes_create(2, columns * rows);
    nodes->spacing = spacing;
    for (size_t i = 0; i < nodes->n; i++) {
        nodes->position[2 * i] = ((double)(i % columns) + 0.5) * spacing;
        nodes->position[2 * i + 1] = ((double)(i / columns) + 0.5) * spacing;
        nodes->volume[i] = spacing * spacing;
    }
    return nodes;
}

/** A lattice without the nodes nearer than `radius` to its middle; those up to twice as far are
 * moved by up to `disorder` spacings a component and hold 1 -+ `disorder` of a cell's area. tag:
 * place in the lattice, from 1. */
static inline struct kr_nodes *kr_plate_porous(size_t columns, size_t rows, double spacing,
                                               double radius, double disorder, uint64_t seed) {
    struct kr_nodes *nodes = kr_plate_lattice(columns, rows, spacing);
    const double middle[2] = {0.5 * (double)columns * spacing, 0.5 * (double)rows * spacing};
    size_t kept = 0;
    for (size_t i = 0; i < columns * rows; i++) {
        double x = nodes->position[2 * i], y = nodes->position[2 * i + 1];
        double distance = hypot(x - middle[0], y - middle[1]);
        double jitter = distance < 2 * radius ? disorder * spacing : 0;
        double dx = kr_random(&seed, -jitter, jitter), dy = kr_random(&seed, -jitter, jitter);
        double share = kr_random(&seed, 1 - disorder, 1 + disorder);
        if (distance < radius)
            continue;
        nodes->position[2 * kept] = x + dx;
        nodes->position[2 * kept + 1] = y + dy;
        nodes->volume[kept] = jitter > 0 ? share * spacing * spacing : spacing * spacing;
        nodes->tag[kept++] = (int64_t)i + 1;
    }
    nodes->n = kept;
    return nodes;
}

/** Nodes of quadrilateral cells that leave no gaps: a lattice without the cells nearer than `radius` to
 * its middle, whose corners are moved by up to `disorder` spacings a component where they are up to
 * twice as far. Nodes at the centroids; in rows of the lattice. */
static inline struct kr_nodes *kr_plate_cells(size_t columns, size_t rows, double spacing,
                                              double radius, double disorder, uint64_t seed) {
    struct kr_nodes *nodes = kr_nodes_create(2, columns * rows);
    const double middle[2] = {0.5 * (double)columns * spacing, 0.5 * (double)rows * spacing};
    size_t kept = 0, across = columns + 1;
    nodes->spacing = spacing;
    nodes->n_points = across * (rows + 1);
    nodes->point = KR_NEW(double, 2 * nodes->n_points);
    nodes->first = KR_NEW(int64_t, nodes->n + 1);
    nodes->vertex = KR_NEW(int64_t, 4 * nodes->n);
    for (size_t p = 0; p < nodes->n_points; p++) {
        double x = (double)(p % across) * spacing, y = (double)(p / across) * spacing;
        double away = hypot(x - middle[0], y - middle[1]);
        double jitter = away < 2 * radius ? disorder * spacing : 0;
        nodes->point[2 * p] = x + kr_random(&seed, -jitter, jitter);
        nodes->point[2 * p + 1] = y + kr_random(&seed, -jitter, jitter);
    }
    for (size_t i = 0; i < columns * rows; i++) {
        size_t low = i / columns * across + i % columns;
        const size_t corner[4] = {low, low + 1, low + 1 + across, low + across};
        double point[8];
        for (size_t k = 0; k < 4; k++) {
            memcpy(point + 2 * k, nodes->point + 2 * corner[k], 2 * sizeof *point);
            nodes->vertex[4 * kept + k] = (int64_t)corner[k];
        }
        nodes->volume[kept] = kr_cell_polygon(4, point, nodes->position + 2 * kept);
        const double *x = nodes->position + 2 * kept;
        if (hypot(x[0] - middle[0], x[1] - middle[1]) >= radius) {
            kept++;
            nodes->first[kept] = 4 * (int64_t)kept;
        }
    }
    nodes->n = kept;
    return nodes;
}

/** Centres of columns x rows x layers cubes; a corner of the first is at (0, 0, 0). */
static inline struct kr_nodes *kr_block_lattice(size_t columns, size_t rows, size_t layers,
                                                double spacing) {
    struct kr_nodes *nodes = kr_nodes_create(3, columns * rows * layers);
    nodes->spacing = spacing;
    for (size_t i = 0; i < nodes->n; i++) {
        const size_t place[3] = {i % columns, i / columns % rows, i / columns / rows};
        for (size_t d = 0; d < 3; d++)
            nodes->position[3 * i + d] = ((double)place[d] + 0.5) * spacing;
        nodes->volume[i] = spacing * spacing * spacing;
    }
    return nodes;
}

/** A block of cubes; those in its upper half are moved by up to 0.2 spacings and hold 0.6 to 1.4 of
 * a cube's volume. */
static inline struct kr_nodes *kr_plate_block(size_t columns, size_t rows, size_t layers,
                                              double spacing, uint64_t seed) {
    struct kr_nodes *nodes = kr_nodes_create(3, columns * rows * layers);
    nodes->spacing = spacing;
    for (size_t i = 0; i < nodes->n; i++) {
        size_t place[3] = {i % columns, i / columns % rows, i / columns / rows};
        double jitter = 2 * place[2] >= layers ? 0.2 * spacing : 0;
        for (size_t d = 0; d < 3; d++)
            nodes->position[3 * i + d] =
                ((double)place[d] + 0.5) * spacing + kr_random(&seed, -jitter, jitter);
        double share = jitter > 0 ? kr_random(&seed, 0.6, 1.4) : 1;
        nodes->volume[i] = share * pow(spacing, 3);
    }
    return nodes;
}

/** Nodes of hexahedra that leave no gaps: cubes, but in the upper half their corners are moved by up to
 * `disorder` spacings a component, so that faces are bent. Nodes at the centroids, in rows. */
static inline struct kr_nodes *kr_plate_bricks(size_t columns, size_t rows, size_t layers,
                                               double spacing, double disorder, uint64_t seed) {
    static const size_t up[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                    {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    struct kr_nodes *nodes = kr_nodes_create(3, columns * rows * layers);
    size_t across = columns + 1, deep = across * (rows + 1);
    nodes->spacing = spacing;
    nodes->n_points = deep * (layers + 1);
    nodes->point = KR_NEW(double, 3 * nodes->n_points);
    nodes->first = KR_NEW(int64_t, nodes->n + 1);
    nodes->vertex = KR_NEW(int64_t, 8 * nodes->n);
    for (size_t p = 0; p < nodes->n_points; p++) {
        const size_t place[3] = {p % across, p / across % (rows + 1), p / deep};
        const size_t most[3] = {columns, rows, layers};
        for (size_t d = 0; d < 3; d++) {
            int inside = place[d] > 0 && place[d] < most[d] && 2 * place[2] > layers;
            double jitter = inside ? disorder * spacing : 0;
            nodes->point[3 * p + d] =
                (double)place[d] * spacing + kr_random(&seed, -jitter, jitter);
        }
    }
    for (size_t i = 0; i < nodes->n; i++) {
        const size_t at[3] = {i % columns, i / columns % rows, i / columns / rows};
        double point[24];
        for (size_t k = 0; k < 8; k++) {
            size_t p = (at[2] + up[k][2]) * deep + (at[1] + up[k][1]) * across + at[0] + up[k][0];
            nodes->vertex[8 * i + k] = (int64_t)p;
            memcpy(point + 3 * k, nodes->point + 3 * p, 3 * sizeof *point);
        }
        nodes->first[i + 1] = 8 * (int64_t)(i + 1);
        nodes->volume[i] = kr_cell_solid(8, point, nodes->position + 3 * i);
    }
    return nodes;
}

/** Factors as the surface correction may give, but random. */
static inline void kr_plate_random_factors(struct kr_nodes *nodes, uint64_t seed) {
    for (size_t i = 0; i < nodes->n; i++)
        nodes->factor[i] = kr_random(&seed, 0.8, 1.5);
}

/** Move every node of a body by up to `size` [m] a component. */
static inline void kr_plate_shake(struct kr_body *body, double size, uint64_t seed) {
    for (int d = 0; d < body->dim; d++)
        for (size_t i = 0; i < body->n; i++)
            body->u[d][i] = kr_random(&seed, -size, size);
}

/** Node of a lattice nearest to its middle, from below. */
static inline size_t kr_plate_middle(size_t columns, size_t rows) {
    return (rows - 1) / 2 * columns + (columns - 1) / 2;
}

#endif
