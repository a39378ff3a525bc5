/* SPDX-License-Identifier: BSD-3-Clause
 *
 * gmsh fills regions with quadrilaterals, each in a child process of the program kirsch-gmsh.
 * Nothing that a child says is believed: its status, its time, its log and every cell are checked.
 *
 * A request goes to the child's standard input, lengths in spacings:
 *    region algorithm 9 recombination 1 size 0.98 loops L
 *    loop N                      the outer one first, the region on its left; then the inner ones
 *    x y segments                N times: a corner, and the segments of the line that leaves it
 * The mesh comes from its standard output, what gmsh says from its standard error:
 *    nodes N, then N lines x y: first those on the loops, in the order of the request
 *    cells N, then N lines k i1 .. ik of places in that list; once for triangles, once for quads
 *    end
 * All three are files in memory: nothing blocks, and nothing is left behind whatever happens.
 */
#ifndef KR_GMSH_H
#define KR_GMSH_H

#include <stddef.h>

/** A region to be filled; all lengths in spacings, all arrays owned by the caller. */
struct kr_gmsh_region {
    /* asked */
    size_t n_loops;
    size_t *first;    /* (n_loops + 1) where the corners of a loop begin */
    double *corner;   /* (first[n_loops] x 2) */
    size_t *segments; /* (first[n_loops]) of the line that leaves a corner, equal in length */
    const char *name; /* for messages: "around hole_3" */

    /* got: the points on the loops come first, exactly where they were asked for, in order */
    size_t n_points, n_on_loops;
    double *point; /* (n_points x 2) */
    size_t n_cells;
    size_t *cell_first, *vertex; /* as in struct kr_mesh */
    const char *method;          /* words for the report */
    double seconds;              /* all attempts together */
};

struct kr_gmsh_options {
    const char *helper; /* path of kirsch-gmsh; NULL: beside this program */
    int children;       /* at once; 0: as many as there are processors */
    unsigned seconds;   /* longest processor time of one attempt; 0: 300 */
    size_t first;       /* method to begin with, of kr_fill_methods; behind the last comes the first */
};

/** Fill regions. The result of each depends on its own request only, not on the number of
 *  children. Where an attempt fails, a warning says why and the next method is tried; where all
 *  fail, it stops (exit 5) and names the region. */
void kr_gmsh_fill(size_t n_regions, struct kr_gmsh_region *region,
                  const struct kr_gmsh_options *options);

/** Twice the area that the loops bound, in spacings squared: exact up to rounding. */
double kr_gmsh_twice_area(const struct kr_gmsh_region *region);

/** Free the arrays of a region, not the region itself. */
void kr_gmsh_region_free(struct kr_gmsh_region *region);

#endif
