/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Seeds of Voronoi cells on a lattice: found by place, cells by halving.
 */
#ifndef KR_SEEDS_H
#define KR_SEEDS_H

#include "clip.h"
#include "lattice.h"

struct kr_seeds {
    struct kr_lattice lattice;
    size_t n, place_room, kind_room, home_room;
    double (*place)[2]; /* spacings */
    unsigned char *kind; /* enum kr_seed */
    size_t *home;        /* lattice cell that it comes from; none: a seed set later */
    long *first, *next; /* chains of seeds by the lattice cell they stand in */
    size_t next_room;
};

/** What becomes of a seed: it only bounds others' cells, has a cell, or also moves. */
enum kr_seed { KR_SEED_BOUNDS, KR_SEED_STAYS, KR_SEED_MOVES };

/* Home of seeds that were set later. */
#define KR_NO_HOME ((size_t)-1)

struct kr_seeds kr_seeds_begin(const struct kr_lattice *lattice);
void kr_seeds_add(struct kr_seeds *seeds, double x, double y, enum kr_seed kind, size_t home);

/** Sort the seeds by the cell they stand in; to be called when they have moved. */
void kr_seeds_sort(struct kr_seeds *seeds);

/** The Voronoi cell of a seed, within KR_SEEDS_REACH on each side of it. Sides on that limit are
 *  labelled KR_SIDE_FAR. */
#define KR_SEEDS_REACH 1.75
void kr_seeds_cell(const struct kr_seeds *seeds, size_t seed, struct kr_ring *cell,
                   struct kr_ring *spare);

void kr_seeds_end(struct kr_seeds *seeds);

#endif
