/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Parts of the bond graph, as machines with separate memories want them: about equal work, few
 * bonds between parts. Only the program that makes them is linked with METIS.
 */
#ifndef KR_PARTITION_H
#define KR_PARTITION_H

#include "nodes.h"

struct kr_partition_report {
    size_t bonds, cut;  /* pairs in all, and between two parts */
    double balance;     /* the heaviest part over the mean, by bonds of its nodes; 1 is perfect */
    size_t least, most; /* nodes of the smallest and of the largest part */
    double seconds;
};

/** Divide the nodes into parts: METIS k-way on the bond graph, each node weighing as many bonds as
 * it has. The same parts each time.
 *
 *  in   horizon         m
 *  in   partial_volume  enum kr_partial_volume
 *  in   parts           1 or more, at most the number of nodes
 *  out  nodes->partition
 *  Stops (exit 2) where the graph is too large for METIS's indices, (exit 5) where METIS fails.
 */
struct kr_partition_report kr_partition_make(struct kr_nodes *nodes, double horizon,
                                             int partial_volume, int parts);

#endif
