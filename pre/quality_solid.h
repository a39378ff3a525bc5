/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What a user wants to know of a mesh of solids; the counterpart of quality.h.
 */
#ifndef KR_QUALITY_SOLID_H
#define KR_QUALITY_SOLID_H

#include "block.h"

enum kr_cell_kind { KR_CELLS_ALL, KR_CELLS_LATTICE, KR_CELLS_OTHER };

struct kr_quality_solid {
    size_t n_cells, n_tetrahedra;
    double volume;            /* m^3: sum over the cells, compensated */
    double least, mean, most; /* volume of a cell over the spacing cubed */
    double shift;             /* largest distance of a centroid from its lattice place, spacings */
    double variation;         /* standard deviation of the volumes over their mean */
};

/** Quality of all cells, of the cubes of the lattice, or of the others. */
struct kr_quality_solid kr_quality_solid_of(const struct kr_mesh *mesh, enum kr_cell_kind kind,
                                            double spacing);

/** Print the report of a solid's mesh on stdout. */
void kr_quality_solid_print(const struct kr_mesh *mesh, const struct kr_block *block,
                            const struct kr_block_report *report);

#endif
