/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The mesh: points, cells, boundary edges and named groups of them. It knows no mechanics and no
 * file format; read_*.c and write_*.c do.
 */
#ifndef KR_MESH_H
#define KR_MESH_H

#include <stddef.h>
#include <stdint.h>

/** A named group of cells (dim 2) or of boundary edges (dim 1). */
struct kr_mesh_group {
    char *name;
    int dim;
    int tag; /* physical tag in the file */
    size_t count;
    size_t *member; /* (count) indices of cells or edges, ascending */
};

struct kr_mesh {
    size_t n_points;
    double *point; /* (n_points x 3) m */
    size_t n_cells;
    size_t *first;     /* (n_cells + 1) where the vertices of a cell begin in `vertex` */
    size_t *vertex;    /* indices of points, counter-clockwise */
    int64_t *cell_tag; /* (n_cells) number of the cell in its file */
    size_t n_edges;
    size_t *edge; /* (n_edges x 2) indices of points */
    size_t n_groups;
    struct kr_mesh_group *group;
};

/** An empty mesh. */
struct kr_mesh *kr_mesh_create(void);
void kr_mesh_free(struct kr_mesh *mesh);

/** The group of this name and dimension, NULL if there is none. */
const struct kr_mesh_group *kr_mesh_group(const struct kr_mesh *mesh, const char *name, int dim);

/** Check the whole structure: indices in range, cells with three vertices or more, positive areas,
 *  no two cells of the same vertices, every edge the side of just one cell. Returns NULL, or a
 *  sentence naming tag and place of the first fault, owned by the caller. */
char *kr_mesh_fault(const struct kr_mesh *mesh);

/** Read gmsh's MSH 4.1 (ASCII or binary): triangles and quadrilaterals in 2D, lines, physical
 *  names. Stops (exit 2) with file, line or byte, what was found and expected. */
struct kr_mesh *kr_mesh_read_msh(const char *path);

/** Write MSH 4.1 binary with the groups as physical names. The file appears whole or not at all. */
void kr_mesh_write_msh(const struct kr_mesh *mesh, const char *path);

#endif
