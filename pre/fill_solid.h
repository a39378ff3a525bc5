/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What a child that makes tetrahedra is asked and what it answers; the words are those of gmsh_solid.h. Used by
 * gmsh_solid.c only.
 */
#ifndef KR_FILL_SOLID_H
#define KR_FILL_SOLID_H

#include "gmsh_solid.h"

#include <stdio.h>

enum { KR_SOLID_METHODS = 2 };

/** The ways in which a region is filled, the best first. */
extern const struct kr_solid_method {
    const char *name;
    int algorithm, optimize; /* gmsh's Mesh.Algorithm3D and Mesh.Optimize */
} kr_solid_methods[KR_SOLID_METHODS];

/** Write a request; `sent` (n_shell_points) gets the region's points in the order in which they go out. */
void kr_solid_ask(const struct kr_solid_region *region, size_t method, FILE *file, size_t *sent);

/** Take a reply that passes every check; else what is wrong, owned by the caller. */
char *kr_solid_take(struct kr_solid_region *region, const size_t *sent, FILE *file);

#endif
