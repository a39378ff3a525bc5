/* SPDX-License-Identifier: BSD-3-Clause
 *
 * One region's request written, and its reply read and checked cell by cell. gmsh.c runs the
 * children; this knows the text that passes between.
 */
#ifndef KR_FILL_H
#define KR_FILL_H

#include "gmsh.h"

#include <stdio.h>

/** A way to ask gmsh, best first in kr_fill_methods. */
struct kr_fill_method {
    const char *words;
    int algorithm, recombination; /* Mesh.Algorithm, Mesh.RecombinationAlgorithm */
    double size;                  /* Mesh.CharacteristicLength, in spacings */
};

extern const struct kr_fill_method kr_fill_methods[];
extern const size_t kr_fill_n_methods;

/* The best method whose time grows no faster than the number of cells. */
enum { KR_FILL_LINEAR = 2 };

/** Write the request for a region. */
void kr_fill_ask(const struct kr_gmsh_region *region, const struct kr_fill_method *method,
                 FILE *file);

/** Read a reply into the region and check it whole: the points asked for stand where they were
 *  asked for, the cells' boundary is the loops and nothing else, no two cells overlap, all areas
 *  are positive and their sum is that of the loops to 1e-10. Returns NULL, or what is wrong, owned
 *  by the caller; then the region is as empty as before. */
char *kr_fill_read(struct kr_gmsh_region *region, FILE *file);

#endif
