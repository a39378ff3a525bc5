/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Writing VTU: an XML head that says where each array begins in the block of bytes behind it; each
 * array is led by its length in 8 bytes.
 */
#include "vtu.h"

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"

#include <stdio.h>
#include <string.h>

struct writer {
    FILE *to;
    uint64_t offset;
    int is_head; /* the first pass writes the head, the second the bytes */
};

/** One array; in the first pass its description. */
static void put(struct writer *w, const char *type, const char *name, int components, size_t bytes,
                const void *data) {
    uint64_t length = bytes;
    if (w->is_head) {
        fprintf(w->to, "<DataArray type=\"%s\" Name=\"", type);
        for (const char *c = name; *c; c++)
            fprintf(w->to, *c == '<' ? "&lt;" : *c == '&' ? "&amp;" : *c == '"' ? "&quot;" : "%c", *c);
        fprintf(w->to, "\" NumberOfComponents=\"%d\" format=\"appended\" offset=\"%llu\"/>\n",
                components, (unsigned long long)w->offset);
        w->offset += sizeof length + bytes;
    } else {
        fwrite(&length, sizeof length, 1, w->to);
        fwrite(data, 1, bytes, w->to);
    }
}

static void say(const struct writer *w, const char *text) {
    if (w->is_head)
        fputs(text, w->to);
}

/** VTK's number for a cell with so many vertices. */
static unsigned char type_of(int dim, int64_t vertices) {
    static const unsigned char solid[21] = {[4] = 10, [5] = 14, [6] = 13, [8] = 12,
                                            [10] = 24, [13] = 27, [15] = 26, [20] = 25};
    if (vertices == 1)
        return 1;
    if (dim == 2)
        return vertices == 3 ? 5 : vertices == 4 ? 9 : 7;
    if (vertices > 20)
        return 41; /* a polyhedron in tetrahedra: VTK's convex set of points */
    return solid[vertices];
}

static void put_points(struct writer *w, const struct kr_nodes *nodes) {
    size_t n = nodes->n_points ? nodes->n_points : nodes->n, dim = (size_t)nodes->dim;
    const double *from = nodes->n_points ? nodes->point : nodes->position;
    double *point = KR_NEW(double, 3 * n);
    for (size_t p = 0; p < n; p++)
        memcpy(point + 3 * p, from + dim * p, dim * sizeof *point);
    say(w, "<Points>\n");
    put(w, "Float64", "Points", 3, 3 * n * sizeof *point, point);
    say(w, "</Points>\n");
    kr_free(point);
}

/** Vertices of all cells in the order of VTK. In its linear wedge the normal of the first triangle
 *  points outwards: the mirror image of everybody else's. */
static int64_t *vertices_of(const struct kr_nodes *nodes) {
    static const unsigned char order[6] = {0, 2, 1, 3, 5, 4};
    size_t n = nodes->n_points ? (size_t)nodes->first[nodes->n] : nodes->n;
    int64_t *vertex = KR_NEW(int64_t, n);
    for (size_t k = 0; k < n; k++)
        vertex[k] = nodes->n_points ? nodes->vertex[k] : (int64_t)k;
    for (size_t i = 0; nodes->n_points && nodes->dim == 3 && i < nodes->n; i++)
        if (nodes->first[i + 1] - nodes->first[i] == 6)
            for (int k = 0; k < 6; k++)
                vertex[nodes->first[i] + k] = nodes->vertex[nodes->first[i] + order[k]];
    return vertex;
}

static void put_cells(struct writer *w, const struct kr_nodes *nodes) {
    int64_t *end = KR_NEW(int64_t, nodes->n), *vertex = vertices_of(nodes);
    unsigned char *type = KR_NEW(unsigned char, nodes->n);
    for (size_t i = 0; i < nodes->n; i++) {
        end[i] = nodes->n_points ? nodes->first[i + 1] : (int64_t)i + 1;
        type[i] = type_of(nodes->dim, end[i] - (i ? end[i - 1] : 0));
    }
    say(w, "<Cells>\n");
    put(w, "Int64", "connectivity", 1, (size_t)(nodes->n ? end[nodes->n - 1] : 0) * sizeof *vertex,
        vertex);
    put(w, "Int64", "offsets", 1, nodes->n * sizeof *end, end);
    put(w, "UInt8", "types", 1, nodes->n, type);
    say(w, "</Cells>\n");
    kr_free(end);
    kr_free(vertex);
    kr_free(type);
}

static void put_data(struct writer *w, const struct kr_nodes *nodes) {
    say(w, "<CellData>\n");
    put(w, "Float64", "Volume", 1, nodes->n * sizeof *nodes->volume, nodes->volume);
    put(w, "Int64", "Tag", 1, nodes->n * sizeof *nodes->tag, nodes->tag);
    put(w, "Float64", "Surface_Correction_Factor", 1, nodes->n * sizeof *nodes->factor,
        nodes->factor);
    for (size_t s = 0; s < nodes->n_sets; s++) {
        unsigned char *is_in = KR_NEW(unsigned char, nodes->n);
        for (size_t k = 0; k < nodes->set[s].count; k++)
            is_in[nodes->set[s].node[k]] = 1;
        put(w, "UInt8", nodes->set[s].name, 1, nodes->n, is_in);
        kr_free(is_in);
    }
    say(w, "</CellData>\n");
}

void kr_vtu_write(const struct kr_nodes *nodes, const char *path) {
    struct kr_file file = kr_file_begin(kr_text_copy(path));
    struct writer w = {.to = file.to, .is_head = 1};
    fprintf(w.to,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
            "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
            "<Piece NumberOfPoints=\"%zu\" NumberOfCells=\"%zu\">\n",
            nodes->n_points ? nodes->n_points : nodes->n, nodes->n);
    for (w.is_head = 1; w.is_head >= 0; w.is_head--) {
        put_points(&w, nodes);
        put_cells(&w, nodes);
        put_data(&w, nodes);
        say(&w, "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
    }
    fprintf(w.to, "\n</AppendedData>\n</VTKFile>\n");
    kr_file_end(&file);
}
