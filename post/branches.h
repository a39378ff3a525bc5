/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Count the branches of a crack, without boxes.
 *
 * The rule, in lengths of the horizon delta:
 *
 *   (1) Damaged nodes are joined where they lie within max(1.6 spacings, delta/2): each connected
 *       heap is a crack. Its start is the pre-crack in it (all of it), else its earliest node.
 *
 *   (2) Breadth-first distance from the start cuts the crack into bands about delta wide; the
 *       connected pieces of a band are linked to the pieces of the band before. A piece with no
 *       piece behind it is an end.
 *
 *   (3) An end less than 3 delta beyond the last fork is roughness, not a branch: the shortest is
 *       pruned first, until none is left. So isolated specks vanish as well, and so does an end
 *       where two branches meet again: it closes a loop.
 *
 *   (4) A crack that enters a hole has an end there, and a new crack begins on the other side: it
 *       is its continuation where the straight line between the two crosses less than 3 delta of
 *       material, and the earlier end is then not counted. A second crack out of the same hole
 *       counts as one more branch.
 *
 * branches = ends - ends that are continued: 1 for a crack without branches, 2 after one
 * bifurcation, also where the crack ran through holes; 0 where nothing grew.
 */
#ifndef KR_BRANCHES_H
#define KR_BRANCHES_H

#include "record.h"

struct kr_branches {
    int countable;   /* 0: more than half of the nodes are damaged, so that there are no lines */
    size_t branches; /* ends, without those that are continued */
    size_t cracks;   /* that continue no other */
    size_t damaged;  /* nodes past the threshold */
};

struct kr_branches kr_branches_count(const struct kr_record *record);

#endif
