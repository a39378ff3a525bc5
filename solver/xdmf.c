/* SPDX-License-Identifier: BSD-3-Clause
 *
 * XDMF 2, the version that ParaView 5.11 reads best: one temporal collection, the mesh referred to
 * by each time, fields as cell data.
 */
#include "xdmf.h"

#include "base/file.h"
#include "base/memory.h"
#include "quantity.h"

#include <stdio.h>

static void write_field(FILE *file, const struct kr_nodes *nodes, long step, int field, int wide) {
    const struct kr_quantity_kind *kind = &kr_quantities[field];
    char columns[16] = "";
    if (kind->components > 1)
        snprintf(columns, sizeof columns, " %d", kind->components);
    fprintf(file,
            "    <Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"Cell\">\n"
            "     <DataItem Dimensions=\"%zu%s\" NumberType=\"Float\" Precision=\"%d\" "
            "Format=\"HDF\">run/%06ld.h5:/%s</DataItem>\n    </Attribute>\n",
            kind->name, kind->xdmf, nodes->n, columns, wide ? 8 : 4, step, kind->name);
}

static void write_step(FILE *file, const struct kr_nodes *nodes, size_t corners,
                       struct kr_xdmf_fields fields, struct kr_xdmf_step step) {
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
    for (size_t f = 0; f < fields.n; f++)
        write_field(file, nodes, step.step, fields.field[f], fields.wide);
    fprintf(file, "   </Grid>\n");
}

void kr_xdmf_write(const char *path, const struct kr_nodes *nodes, size_t corners,
                   struct kr_xdmf_fields fields, size_t n_steps, const struct kr_xdmf_step *step) {
    struct kr_file whole = kr_file_begin(kr_text_copy(path));
    FILE *file = whole.to;
    fprintf(file, "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n <Domain>\n"
                  "  <Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
    for (size_t k = 0; k < n_steps; k++)
        write_step(file, nodes, corners, fields, step[k]);
    fprintf(file, "  </Grid>\n </Domain>\n</Xdmf>\n");
    kr_file_end(&whole);
}
