/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The skeleton of the damage: which nodes follow each other without a fork.
 *
 *   (1) The length from the source (front.h) cuts each crack into bands one horizon wide; the
 *       connected pieces of a band are the nodes of a graph (its Reeb graph, as in Singh, Memoli and
 *       Carlsson, Eurographics Symp. Point-Based Graphics, 2007).
 *   (2) Each piece follows the piece that its earliest node was reached from: a tree.
 *   (3) Of the pieces that follow one, the one that leads farthest goes on; the others do if they
 *       lead on for three horizons or more. What does not is roughness and goes to its forerunner.
 *   (4) A chain is a run of pieces without a fork. The piece around a source is shared out to the
 *       chains that begin there, by distance.
 */
#ifndef KR_CHAINS_H
#define KR_CHAINS_H

#include "front.h"

struct kr_chain {
    size_t source;
    size_t parent;      /* chain it forks from; NONE: it begins at the source */
    size_t n_children;
    size_t count, *node; /* its nodes, by length from the source */
    size_t end_count, *end; /* the last horizon of them */
};

struct kr_chains {
    size_t count, room;
    struct kr_chain *item; /* parents stand before children */
    size_t *of;            /* (front's n) chain of a node; NONE: pre-crack or speck, or of a source
                              from which nothing grew */
};

void kr_chains_find(const struct kr_front *front, struct kr_chains *chains);
void kr_chains_clear(struct kr_chains *chains);

#endif
