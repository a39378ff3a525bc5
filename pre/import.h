/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From a file to nodes, whatever the file is; and from nodes to the files of others.
 *
 *    .dat           nodes.dat of the plates paper        .csv .txt   points with volumes (points.h)
 *    all others     a mesh (foreign.h), checked and mended (repair.h), then converted (convert.h)
 */
#ifndef KR_IMPORT_H
#define KR_IMPORT_H

#include "mesh.h"
#include "nodes.h"

struct kr_import {
    const char *path;
    double unit;      /* m: the file's unit of length */
    double thickness; /* m: of plane points with volumes; 0: the volumes are areas */
    int repair;
    const char *folder; /* for what is converted on the way */
    double spacing;     /* m: for geometry without a mesh; 0: not known */
    size_t n_sets;      /* files of node numbers, for points alone */
    const char *const *set;
};

/** Read nodes; `mesh` is the mesh they came from (kr_mesh_free), NULL for points. Names of sets are
 *  made unique and fit for files, with a warning for each that had to be changed. Stops (exit 2). */
struct kr_nodes *kr_import(const struct kr_import *import, struct kr_mesh **mesh);

/** Whether there is a writer of this name: "peridigm exodus vtu csv dat". */
int kr_export_knows(const char *format);

/** Write STEM.txt and its node sets, STEM.e, STEM.vtu, STEM.csv or STEM.dat, and say so. `nodes_file`
 *  is the file that the nodes were written to. Stops (exit 3; exit 2 where a format cannot hold
 *  them). */
void kr_export(const struct kr_nodes *nodes, const char *format, const char *stem,
               const char *nodes_file, double thickness);

#endif
