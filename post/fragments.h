/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Fragments: what hangs together by living bonds. Bonds are found anew from places and volumes
 * (theory.md (10)), without those in the crack record and without those that a pre-crack cuts.
 */
#ifndef KR_FRAGMENTS_H
#define KR_FRAGMENTS_H

#include "case.h"
#include "precrack.h"
#include "record.h"

struct kr_fragment {
    size_t first, count; /* its lowest node; its number of nodes */
    double mass;         /* kg/m, in 3D kg */
    double centre[3];    /* m, at rest */
    double momentum[3];  /* kg/s, in 3D kg m/s; NaN: the run has no output with velocities */
    double extent;       /* m: largest distance between two of its nodes, at rest */
};

struct kr_fragments {
    size_t count;
    struct kr_fragment *item; /* (count) the heaviest first */
    size_t *of;               /* (n) fragment of a node, as an index of `item` */
};

/** Find the fragments. `crack`: the pre-cracks of the deck, as many as it has; `velocity` (n x 3, m/s) may
 *  be NULL. */
void kr_fragments_find(const struct kr_record *record, const struct kr_case *c,
                       struct kr_precrack *const *crack, const double *velocity,
                       struct kr_fragments *fragments);
void kr_fragments_clear(struct kr_fragments *fragments);

/** Velocities (n x 3) of the last output of a run, owned by the caller; NULL: there is none. */
double *kr_fragments_velocity(const char *run, size_t n);

/** Write fragments.csv; it appears whole or not at all. Stops (exit 3) where it cannot. */
void kr_fragments_write(const struct kr_fragments *fragments, int dim, const char *path);

#endif
