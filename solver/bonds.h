/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Bonds: the families of all nodes, their weights, which bonds still live, and the damage.
 *
 * The layout is made for the loop over all bonds (kernel.c). Eight consecutive nodes form a slice,
 * one node a SIMD lane. A slice has rows: a row holds, for each lane i, the bond to node
 * j = i + offset, if bit i of its mask is set. Nodes stand in rows of the plate, so neighbours of
 * consecutive nodes are consecutive too, and a row's eight neighbours are one contiguous load.
 *
 *   slice of nodes    16 17 18 19 20 21 22 23
 *   row, offset +501  517 518 ...         524      mask 11111111
 *   row, offset +1    17 18 ...            24      mask 01111111   (23 is the plate's edge)
 *
 * Slices come in two classes. `lattice`: all bonds join lattice nodes of equal volume, so that a
 * row's bond vector and weight come from a small table (its `kind`). General: bond vectors come from
 * the positions, 1/|xi| is stored, and rows at the rim of the horizon store their weights.
 *
 * Lattice slices come by pairs, 2k and 2k + 1, with the same rows: a bond that only one of them has
 * is a cleared bit in the other. Their lists of rows (offset, kind) stand in memory once, however
 * many pairs have the same: the bulk of a plate has one. Pairs whose lanes all live are twins, which
 * the fast loop does without looking at masks.
 *
 * Lengths and weights are rounded to float32 in both classes, the same from both ends. A bond's e is
 * eta.(2 xi + eta)/|xi|^2 whatever |xi| is: force stays the energy's gradient and rest stays rest.
 *
 * Each node sums its own family in the order of the rows: the same bits for any number of threads.
 */
#ifndef KR_BONDS_H
#define KR_BONDS_H

#include "fit.h"
#include "material/material.h"
#include "nodes.h"

#include <stddef.h>
#include <stdint.h>

enum { KR_LANES = 8, KR_PAIR = 2 * KR_LANES };

/** What the fast loop wants of a kind of lattice bonds. A conical micromodulus' share is in `pull`. */
struct kr_bond_geometry {
    double xi[3]; /* m */
    double to_t;  /* scale/|xi|^2, for the argument of the polynomials (fit.h) */
    double pull;  /* phi V/|xi|^3: times c/2 (lambda_i + lambda_j) pull(t) q (xi + eta) */
};

/** The same for mixed precision. */
struct kr_bond_geometry32 {
    float xi[3], to_t, pull;
};

/** A kind of lattice bonds: all with the same vector. */
struct kr_bond_kind {
    double xi[3];  /* m */
    double length; /* |xi|, m */
    double weight; /* phi */
};

struct kr_bonds {
    int dim;
    size_t n, n_slices, n_rows, n_listed;
    size_t count;              /* living bonds at the start, each pair counted from both ends */
    struct kr_material material;
    struct kr_fit fit, fit_mixed; /* outside of their range a slice takes the exact loop */

    /* per node; padded arrays of kr_bonds_padded */
    double *x[3];    /* m */
    double *volume;  /* m^2; 3D: m^3 */
    double *factor;  /* lambda */
    double *family_volume, *lost_volume; /* as `volume`: of the whole family, and behind broken bonds */
    unsigned char *no_fail;              /* bonds of this node never break */

    /* per slice */
    unsigned char *lattice;
    unsigned char *twin;   /* ((n_slices + 1) / 2) of each pair of slices; 0 once a bond breaks */
    size_t *first;         /* (n_slices + 1) of its rows in `living` */
    size_t *list;          /* (n_slices) of its rows in `offset` and `kind` */
    size_t *first_inverse; /* (n_slices + 1) of its 8-tuples in `inverse` */
    size_t *first_weight;  /* (n_slices + 1) of its 8-tuples in `weight` */

    uint8_t *living; /* (n_rows) masks */

    /* per listed row, (n_listed) */
    int32_t *offset;
    uint16_t *kind; /* lattice: place in `kinds`; general: 1 in the slice's last rows, which store
                       weights, else 0 */

    float *inverse; /* 1/|xi| [1/m], 8 a general row */
    float *weight;  /* phi, 8 a general row of kind 1 */
    size_t n_kinds;
    struct kr_bond_kind *kinds;
    struct kr_bond_geometry *geometry;
    struct kr_bond_geometry32 *geometry32;

    int n_blocks;          /* equal shares of the work, one a thread */
    size_t *block;         /* (n_blocks + 1) first slice of each */
};

/** One bond as seen from node i. */
struct kr_bond {
    size_t row;    /* where its bit is in `living` */
    int lane;
    size_t i, j;
    double xi[3];  /* m */
    double length; /* m */
    double weight; /* phi, times what the surface factor differs from (lambda_i + lambda_j)/2 */
};

/** Find all families.
 *
 *  in  nodes      not kept
 *  in  material   its horizon [m] is the reach
 *  in  partial_volume  enum kr_partial_volume
 *  Stops (exit 2) if a node has no neighbour at all, naming it.
 */
struct kr_bonds *kr_bonds_create(const struct kr_nodes *nodes, const struct kr_material *material,
                                 int partial_volume);
void kr_bonds_free(struct kr_bonds *bonds);

/** An array of n doubles with room for a pair of slices before and behind, all zero, so that rows may
 *  load past both ends. Free with kr_bonds_padded_free. */
double *kr_bonds_padded(size_t n);
void kr_bonds_padded_free(double *array);

/** Damage of a node, 0 to 1: 1 - sum of mu phi V over sum of phi V; theory.md (9), paper eq. 10. */
double kr_bonds_damage(const struct kr_bonds *bonds, size_t i);

/** Find out anew which slices are twins, after bits of `living` were written. */
void kr_bonds_find_twins(struct kr_bonds *bonds);

/** Clear one bond at the end of node i if it lives; returns its weight phi, 0 if it did not live. */
double kr_bonds_clear(struct kr_bonds *bonds, size_t i, size_t j);

/** Visit the living bonds of a slice, row by row: start with kr_bonds_walk, then until it returns 0.
 *  `bond` is filled anew each time. */
struct kr_bond_walk {
    size_t slice, row, weight;
    int lane;
};
struct kr_bond_walk kr_bonds_walk(const struct kr_bonds *bonds, size_t slice);
int kr_bonds_next(const struct kr_bonds *bonds, struct kr_bond_walk *walk, struct kr_bond *bond);

/** Bytes held, share of filled lanes and of lattice slices, for reports. */
struct kr_bonds_size {
    size_t bytes;
    double lane_fill, lattice_share;
};
struct kr_bonds_size kr_bonds_size(const struct kr_bonds *bonds);

#endif
