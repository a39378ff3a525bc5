/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The mesh: points, cells, boundary edges and named groups of them. It knows no mechanics and no
 * file format; read_*.c and write_*.c do.
 */
#ifndef KR_MESH_H
#define KR_MESH_H

#include <stddef.h>
#include <stdint.h>

/** A named group: of cells (its dim is the mesh's), or of the edges (dim 1, in 2D) or faces (dim 2,
 *  in 3D) of a boundary. */
struct kr_mesh_group {
    char *name;
    int dim;
    int tag; /* physical tag in the file */
    size_t count;
    size_t *member; /* (count) indices of cells, edges or faces, ascending */
};

struct kr_mesh {
    int dim; /* 2: polygons in a plane z = constant; 3: solids */
    size_t n_points;
    double *point;      /* (n_points x 3) m */
    int64_t *point_tag; /* (n_points) numbers in the file; NULL: place + 1 */
    size_t n_cells;
    size_t *first;     /* (n_cells + 1) where the vertices of a cell begin in `vertex` */
    size_t *vertex;    /* indices of points; polygons counter-clockwise, solids as in element.h */
    int64_t *cell_tag; /* (n_cells) number of the cell in its file */
    size_t n_edges;    /* 2D */
    size_t *edge;      /* (n_edges x 2) indices of points */
    size_t n_faces;    /* 3D */
    size_t *face_first; /* (n_faces + 1) where the vertices of a face begin in `face`; NULL: none */
    size_t *face;      /* indices of points, in their order round the face */
    size_t n_groups;
    struct kr_mesh_group *group;
};

/** An empty mesh. */
struct kr_mesh *kr_mesh_create(void);
void kr_mesh_free(struct kr_mesh *mesh);

/** The group of this name and dimension, NULL if there is none. */
const struct kr_mesh_group *kr_mesh_group(const struct kr_mesh *mesh, const char *name, int dim);

/** Number of a point in its file. */
int64_t kr_mesh_point_tag(const struct kr_mesh *mesh, size_t point);

/** Check the whole structure: indices in range, cells with three vertices or more, positive areas or
 *  volumes, no two cells of the same vertices, every edge or face that of just one cell. Returns
 *  NULL, or a sentence naming tag and place of the first fault, owned by the caller. */
char *kr_mesh_fault(const struct kr_mesh *mesh);

/** The part of kr_mesh_fault that knows solids: shapes, volumes, faces. */
char *kr_mesh_solid_fault(const struct kr_mesh *mesh);

/** Take out points (is_gone: n_points) that nothing refers to. */
void kr_mesh_drop_points(struct kr_mesh *mesh, const unsigned char *is_gone);

/** Take out cells (is_gone: n_cells), and of the others the vertices behind the first `size` (n_cells). */
void kr_mesh_drop_cells(struct kr_mesh *mesh, const size_t *size, const unsigned char *is_gone);

/** Take out boundary edges or faces (is_gone: one each). */
void kr_mesh_drop_facets(struct kr_mesh *mesh, const unsigned char *is_gone);

/** Volume [m^3] and centroid [m] of a solid cell. */
double kr_mesh_cell_volume(const struct kr_mesh *mesh, size_t cell, double centroid[3]);

/** Turn groups of points (dim 0) into groups of what a solver can use. Points that all lie on the
 *  boundary: the edges or faces between them. Else, or where there are none: the cells all of whose
 *  vertices are in the group. Where there are none either: the cells that touch one of the points.
 *  Warns of points that count for nothing in the first two. */
void kr_mesh_resolve_points(struct kr_mesh *mesh);

/** Read gmsh's MSH 2.2 or 4.1, ASCII or binary: all elements of element.h, physical names. Stops
 *  (exit 2) with file, line or byte, what was found and expected. */
struct kr_mesh *kr_mesh_read_msh(const char *path);

/** Write MSH 4.1 binary with the groups as physical names. The file appears whole or not at all. */
void kr_mesh_write_msh(const struct kr_mesh *mesh, const char *path);

#endif
