/* SPDX-License-Identifier: BSD-3-Clause
 *
 * XDMF 2, the version that ParaView 5.11 reads best: one temporal collection, the mesh referred to
 * by each time, fields as cell data.
 */
#include "xdmf.h"

#include "base/error.h"
#include "base/memory.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    int is_vector;
} fields[] = {
    {"Displacement", 1},
    {"Velocity", 1},
    {"Damage", 0},
    {"Stored_Elastic_Energy_Density", 0},
};

static void write_field(FILE *file, const struct kr_nodes *nodes, long step, size_t f) {
    fprintf(file, "    <Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"Cell\">\n",
            fields[f].name, fields[f].is_vector ? "Vector" : "Scalar");
    fprintf(file, "     <DataItem Dimensions=\"%zu%s\"", nodes->n, fields[f].is_vector ? " 3" : "");
    fprintf(file,
            " NumberType=\"Float\" Precision=\"4\" Format=\"HDF\">run/%06ld.h5:/%s</DataItem>\n"
            "    </Attribute>\n",
            step, fields[f].name);
}

static void write_step(FILE *file, const struct kr_nodes *nodes, size_t corners,
                       struct kr_xdmf_step step) {
    fprintf(file,
            "   <Grid Name=\"body\" GridType=\"Uniform\">\n"
            "    <Time Value=\"%.9g\"/>\n"
            "    <Topology TopologyType=\"Mixed\" NumberOfElements=\"%zu\">\n"
            "     <DataItem Dimensions=\"%zu\" NumberType=\"Int\" Precision=\"8\" "
            "Format=\"HDF\">run.h5:/mesh/topology</DataItem>\n"
            "    </Topology>\n"
            "    <Geometry GeometryType=\"%s\">\n"
            "     <DataItem Dimensions=\"%zu %d\" NumberType=\"Float\" Precision=\"8\" "
            "Format=\"HDF\">run.h5:/mesh/point</DataItem>\n"
            "    </Geometry>\n",
            step.time, nodes->n, corners, nodes->dim == 2 ? "XY" : "XYZ", nodes->n_points, nodes->dim);
    for (size_t f = 0; f < sizeof fields / sizeof fields[0]; f++)
        write_field(file, nodes, step.step, f);
    fprintf(file, "   </Grid>\n");
}

void kr_xdmf_write(const char *path, const struct kr_nodes *nodes, size_t corners, size_t n_steps,
                   const struct kr_xdmf_step *step) {
    char *beside = kr_text("%s.tmp", path);
    FILE *file = fopen(beside, "w");
    if (!file)
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s", beside, strerror(errno));
    fprintf(file, "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n <Domain>\n"
                  "  <Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
    for (size_t k = 0; k < n_steps; k++)
        write_step(file, nodes, corners, step[k]);
    fprintf(file, "  </Grid>\n </Domain>\n</Xdmf>\n");
    int failed = ferror(file) | fclose(file);
    if (failed || rename(beside, path))
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s; free some space and run again", path,
                strerror(errno));
    kr_free(beside);
}
