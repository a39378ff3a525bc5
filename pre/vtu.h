/* SPDX-License-Identifier: BSD-3-Clause
 *
 * VTK's unstructured grids, for ParaView and others.
 */
#ifndef KR_VTU_H
#define KR_VTU_H

#include "nodes.h"

/** Write the cells of nodes (or, where they came without, points) with cell data: Volume, Tag,
 *  Surface_Correction_Factor, and 0 or 1 for each set. Binary, appended; whole or not at all. */
void kr_vtu_write(const struct kr_nodes *nodes, const char *path);

#endif
