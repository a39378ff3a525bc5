/* SPDX-License-Identifier: BSD-3-Clause
 *
 * gmsh fills regions in space with tetrahedra, each in a child process of kirsch-gmsh-solid; the
 * counterpart of gmsh.h. Nothing that a child says is believed.
 *
 * A request, lengths in spacings:
 *    solid algorithm 1 optimize 1 size 1.6 shells S
 *    shell points N triangles M, N lines x y z, M lines of three places among them: the outer shell
 *                                first; seen from outside the region counter-clockwise
 * The reply:
 *    points N and N lines x y z: new ones, behind those of all shells
 *    cells M and M lines of four places; end
 */
#ifndef KR_GMSH_SOLID_H
#define KR_GMSH_SOLID_H

#include "gmsh.h"

struct kr_solid_region {
    /* asked */
    size_t n_shell_points; /* the first points */
    size_t n_triangles;
    size_t (*triangle)[3];
    const char *name;
    /* got; before, the lattice's tetrahedra that the shells were taken from */
    size_t n_points;
    double (*point)[3]; /* spacings */
    size_t n_cells;
    size_t (*cell)[4];
    const char *method; /* words for the report */
    double seconds;
};

/** Fill regions, several at once; the result of each depends on its own request only. Where an
 *  attempt fails, a warning says why and the next method is tried; stops where all have failed. */
void kr_solid_fill(size_t n_regions, struct kr_solid_region *region,
                   const struct kr_gmsh_options *options);

/** Volume that the triangles enclose. */
double kr_solid_region_volume(const struct kr_solid_region *region);

void kr_solid_region_free(struct kr_solid_region *region);

#endif
