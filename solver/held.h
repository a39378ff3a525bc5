/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Which pieces a body has, and what holds them.
 */
#ifndef KR_HELD_H
#define KR_HELD_H

#include "boundary.h"

/** The first way in which a piece of the body can move although all is at rest: "moving along x", "turning about an axis
 *  along z"; NULL if there is none. Pieces are joined by living bonds; single nodes, which stay where
 *  they are, do not count. node: one of the piece. */
const char *kr_held_free_motion(const struct kr_bonds *bonds, const unsigned char *fixed,
                                size_t *node);

/** Whether the body has come apart: a piece that a force pulls has no support, or no piece joins two
 *  supports (that share no node) any more. */
int kr_held_apart(const struct kr_bonds *bonds, const struct kr_boundary *boundary);

#endif
