/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Nodes without cells, from text: Peridigm's and PeriLab's discretisations and CSV; and node sets,
 * lists of numbers in files of their own.
 *
 * Columns are named by the first line: `x,y,volume` or PeriLab's `header: x y block_id volume`.
 * Without names they are Peridigm's `x y z volume block`. Commas, semicolons and blanks separate; `#` begins a comment; a unit in brackets behind a name is
 * passed over. Known names, whatever their case: id, x, y, z, volume (or area, vol), block_id (or
 * block). Any other column that holds 0 and 1 alone is a set; what else there is, is named in a
 * warning.
 *
 * A body is plane where there is no z or all z are equal. Its volumes are divided by the thickness;
 * thickness 0: they are areas. Block b becomes the set `block_b`; all nodes are the set `body` (`plate` in 2D).
 */
#ifndef KR_POINTS_H
#define KR_POINTS_H

#include "nodes.h"

/** Read nodes, in rows. `unit` [m] is the file's unit of length, the thickness is in m. Stops (exit 2) with
 *  file, line, what was found and expected. */
struct kr_nodes *kr_points_read(const char *path, double unit, double thickness);

/** Add the set in a file of node numbers (from 1 in the order of the file, or its ids), called after
 *  the file: left.txt, nodelist_left.txt, ns_left.txt. */
void kr_points_read_set(const char *path, struct kr_nodes *nodes);

/** Write all digits, each file whole or not at all.
 *   peridigm  STEM.txt: `x y z volume block`, and STEM_ns_NAME.txt a set: node numbers from 1
 *   csv       STEM.csv: `id,x,y,z,volume,block_id`, then a column of 0 and 1 a set
 *  In 2D volumes are multiplied by the thickness [m], where it is not 0; a `block_N` set gives the block, else it is 1.
 */
void kr_points_write_peridigm(const struct kr_nodes *nodes, const char *stem, double thickness);
void kr_points_write_csv(const struct kr_nodes *nodes, const char *stem, double thickness);

#endif
