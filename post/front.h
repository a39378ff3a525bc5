/* SPDX-License-Identifier: BSD-3-Clause
 *
 * How damage spread: the damaged nodes as a graph, from where each was reached, and when.
 *
 *   (1) Damaged nodes are neighbours within r = max(1.6 spacings, horizon/2).
 *   (2) Nodes are added in the order of their damage times. One without an earlier neighbour is a
 *       birth; one that joins two heaps is a meeting, in which the heap that reaches less than three
 *       horizons from its birth is taken up by the other: it was roughness, damage that ran ahead.
 *       What is left are the sources: each pre-crack, and each birth from which three horizons grew.
 *       A heap without source is a speck. (The merge tree of the sublevel sets {T <= t}, pruned by
 *       length; Carr, Snoeyink, Axen, Comput. Geom. 24, 2003, for the tree.)
 *   (3) arrival = the least time by which a node can be reached from the sources through damaged
 *       nodes, min over paths of max T: without the dents of (2), never falling away from a source.
 *   (4) length = the shortest way from the source along which the arrival never falls.
 *
 * Only distances between nodes and times enter: turning the body changes nothing.
 */
#ifndef KR_FRONT_H
#define KR_FRONT_H

#include "record.h"

#define KR_FRONT_NONE SIZE_MAX
enum { KR_FRONT_SHORTEST = 3 }; /* horizons: what is shorter is roughness */

/* Distances on a lattice are just such multiples of the horizon. What is within it by rounding
 * alone is within, and all lengths are compared with this slack, so that a turned or mirrored body
 * has the same neighbours. */
#define KR_FRONT_SLACK 1e-9

struct kr_source {
    size_t birth;    /* node of the front; of a pre-crack one of its nodes */
    int is_precrack;
};

/** All indices below count the damaged nodes, 0 to n - 1. */
struct kr_front {
    const struct kr_record *record; /* not owned */
    double reach;    /* m: r */
    size_t n;
    size_t *node;    /* (n) of the record */
    double *x;       /* (n x 3) m; z = 0 in 2D */
    double *time;    /* (n) s: T, -1 in the pre-crack */
    size_t *first;   /* (n + 1) neighbours of i: near[first[i]] to near[first[i + 1] - 1] */
    int *near;
    size_t *rank; /* (n) place in the order of the times. Of equal times the one whose surroundings
                     broke sooner comes first, so that mirrored damage has mirrored ranks: least sum
                     over neighbours of (T_j - T_i)/distance. */
    size_t n_sources, sources_room;
    struct kr_source *source;
    size_t *source_of; /* (n); NONE: in a speck */
    double *arrival;   /* (n) s */
    double *length;    /* (n) m */
    double *leads;     /* (n) m: greatest length that was reached by way of it */
    size_t *parent;    /* (n) the node before on the shortest way; NONE at a source */
};

/** Follow the damage of a record, which must outlive the front. */
struct kr_front *kr_front_create(const struct kr_record *record);
void kr_front_free(struct kr_front *front);

/** Steps (3) and (4), for kr_front_create. */
void kr_front_spread(struct kr_front *front);

double kr_front_distance(const struct kr_front *front, size_t i, size_t j);

/** The distance in whole 1/2^30 of about a horizon: sums of such are exact, so that of two ways of
 * equal length neither is shorter by rounding. */
double kr_front_step(const struct kr_front *front, size_t i, size_t j);

#endif
