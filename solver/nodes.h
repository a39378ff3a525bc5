/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Peridynamic nodes: places, volumes, surface factors, sets and the cells they stand for; the node
 * file (HDF5, layout in docs/formats.md). Bodies in 2D have unit thickness, so that a volume is
 * an area in m^2.
 */
#ifndef KR_NODES_H
#define KR_NODES_H

#include <stddef.h>
#include <stdint.h>

/** A named set of nodes. */
struct kr_set {
    char *name;
    size_t count;
    int64_t *node;   /* (count) ascending */
    double measure;  /* length [m] or, in 3D, area [m^2] of the boundary it belongs to; 0: of none */
};

/** What the surface factors were made for. kirsch-solve refuses others. Texts are deck words. */
struct kr_nodes_made_for {
    double horizon;              /* m; 0: no factors */
    char model[32];              /* "plane-stress" */
    char partial_volume[32];     /* "hhb" */
    char surface_correction[32]; /* "energy" */
    char deformation[32];        /* "uniaxial-y" */
    char micromodulus[32];       /* "constant", which empty stands for, too */
};

/** How the factor of a bond is made of its two nodes': their mean, their harmonic mean, or an ellipse
 *  over the means of the factors along the axes; theory.md (11). Goes with surface_correction. */
enum kr_pairing { KR_PAIRING_MEAN, KR_PAIRING_HARMONIC, KR_PAIRING_ELLIPSE };

struct kr_nodes {
    int dim;
    size_t n;
    double spacing;      /* m: of the lattice, or the side of a square or cube of median volume */
    double *position;    /* (n x dim) m */
    double *volume;      /* (n) m^2; 3D: m^3 */
    double *factor;      /* (n) surface factor lambda, 1 where there is no correction */
    int pairing;         /* enum kr_pairing */
    double *axis_factor; /* (n x dim) factors along the axes; NULL without KR_PAIRING_ELLIPSE */
    int64_t *partition;  /* (n) part of the bond graph, from 0; NULL if there is none */
    int64_t *tag;        /* (n) number of the cell in the mesh */
    size_t n_points;     /* the cells' corners; 0 if the nodes came without cells */
    double *point;       /* (n_points x dim) m */
    int64_t *first;      /* (n + 1) where the corners of a node's cell begin in `vertex` */
    int64_t *vertex;     /* polygons counter-clockwise; solids as in docs/formats.md */
    size_t n_sets;
    struct kr_set *set;
    struct kr_nodes_made_for made_for;
};

struct kr_nodes *kr_nodes_create(int dim, size_t n);
void kr_nodes_free(struct kr_nodes *nodes);

/** The set of this name, NULL if there is none. */
const struct kr_set *kr_nodes_set(const struct kr_nodes *nodes, const char *name);

/** Add a set; takes over `node` (ascending). Returns it; the pointer lives until the next call. */
struct kr_set *kr_nodes_add_set(struct kr_nodes *nodes, const char *name, size_t count,
                                int64_t *node, double measure);

/** Put the nodes (and cells and sets with them) into a new order: new node k is old order[k]. */
void kr_nodes_reorder(struct kr_nodes *nodes, const size_t *order);

/** Check the whole structure: finite numbers, positive volumes, sets in range and ascending, no two
 *  nodes at one place. Returns NULL or a sentence about the first fault, owned by the caller. */
char *kr_nodes_fault(const struct kr_nodes *nodes);

/** Write the node file, with the deck's resolved text as provenance. The file appears whole or not
 *  at all. Stops (exit 3) where it cannot be written. */
void kr_nodes_write(const struct kr_nodes *nodes, const char *path, const char *deck_text);

/** Read a node file. Stops (exit 2) where it is missing, cut, or no node file. */
struct kr_nodes *kr_nodes_read(const char *path);

#endif
