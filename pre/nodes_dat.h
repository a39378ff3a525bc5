/* SPDX-License-Identifier: BSD-3-Clause
 *
 * nodes.dat, the file that the ANSYS script of the plates paper (appendix 4) writes: a line a node,
 * `id area x y`, in metres.
 */
#ifndef KR_NODES_DAT_H
#define KR_NODES_DAT_H

#include "nodes.h"

/** Read; the nodes have no cells, one set (`plate`, all of them), and stand in rows. Stops (exit 2)
 *  with file, line, what was found and expected. */
struct kr_nodes *kr_nodes_dat_read(const char *path);

/** Write with 17 digits, so that reading gives the same bits. The file appears whole or not at all. */
void kr_nodes_dat_write(const struct kr_nodes *nodes, const char *path);

#endif
