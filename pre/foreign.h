/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Meshes in any format: the reader is chosen by the file's ending and its first bytes.
 *
 *    MSH 2.2, 4.1           read here (read_msh*.c)
 *    STEP, IGES, BREP       meshed by gmsh in the child kirsch-gmsh, then read as MSH
 *    all others             made MSH by to_msh.py (Python with meshio) in a child, then read
 */
#ifndef KR_FOREIGN_H
#define KR_FOREIGN_H

#include "base/child.h"
#include "mesh.h"

/* Where the child leaves the mesh of a body of CAD. */
#define KR_GMSH_BODY KR_CHILD_FOLDER "/body.part.msh"

/** Read a mesh.
 *
 *  in   folder   where a converted mesh is left, as NAME.converted.msh or .csv
 *  in   spacing  m: length of a cell, for geometry that has yet to be meshed; 0: none is known
 *
 *  out  points   NULL; or, where the file holds points with volumes and no cells, the path of a table of
 *                them (read_points.c), owned by the caller; there is no mesh then
 *
 *  Notes of what was lost or changed on the way are passed on as warnings. Stops (exit 2) where the
 *  file cannot be read, (exit 5) where a program is missing, and says what to install.
 */
struct kr_mesh *kr_mesh_read(const char *path, const char *folder, double spacing, char **points);

/** Run /usr/bin/python3 on one of our scripts with two arguments. Lines that begin with "Note: "
 *  become warnings; one with "Error: " stops (exit 2) behind the path `about`, and so does a module of
 *  Python that is missing (exit 5, with the package to install). */
void kr_python(const char *script, const char *from, const char *to, const char *about);

#endif
