/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The node file; its layout is in docs/formats.md.
 */
#include "nodes.h"

#include "base/error.h"
#include "base/h5.h"
#include "base/memory.h"
#include "base/provenance.h"

#include <stdio.h>
#include <string.h>

static const char FORMAT[] = "kirsch nodes";
enum { VERSION = 1 };

static void write_sets(const struct kr_nodes *nodes, struct kr_h5 *file) {
    kr_h5_group(file, "/sets");
    for (size_t s = 0; s < nodes->n_sets; s++) {
        char *name = kr_text("/sets/%s", nodes->set[s].name);
        kr_h5_write_int64(file, name, nodes->set[s].count, 0, nodes->set[s].node);
        kr_h5_set_double(file, name, "measure", nodes->set[s].measure);
        kr_free(name);
    }
}

static void write_made_for(const struct kr_nodes *nodes, struct kr_h5 *file) {
    kr_h5_set_double(file, "/", "horizon", nodes->made_for.horizon);
    kr_h5_set_text(file, "/", "model", nodes->made_for.model);
    kr_h5_set_text(file, "/", "micromodulus",
                   *nodes->made_for.micromodulus ? nodes->made_for.micromodulus : "constant");
    kr_h5_set_text(file, "/", "partial_volume", nodes->made_for.partial_volume);
    kr_h5_set_text(file, "/", "surface_correction", nodes->made_for.surface_correction);
    kr_h5_set_text(file, "/", "deformation", nodes->made_for.deformation);
}

void kr_nodes_write(const struct kr_nodes *nodes, const char *path, const char *deck_text) {
    size_t dim = (size_t)nodes->dim;
    struct kr_h5 *file = kr_h5_create(path, FORMAT, VERSION);
    kr_h5_set_int64(file, "/", "dim", nodes->dim);
    kr_h5_set_double(file, "/", "spacing", nodes->spacing);
    kr_provenance_write(file, deck_text);
    write_made_for(nodes, file);
    kr_h5_write_double(file, "/nodes/position", nodes->n, dim, nodes->position);
    kr_h5_write_double(file, "/nodes/volume", nodes->n, 0, nodes->volume);
    kr_h5_write_double(file, "/nodes/surface_factor", nodes->n, 0, nodes->factor);
    kr_h5_write_int64(file, "/nodes/tag", nodes->n, 0, nodes->tag);
    if (nodes->axis_factor)
        kr_h5_write_double(file, "/nodes/axis_factor", nodes->n, dim, nodes->axis_factor);
    if (nodes->partition)
        kr_h5_write_int64(file, "/nodes/partition", nodes->n, 0, nodes->partition);
    if (nodes->n_points) {
        kr_h5_write_double(file, "/cells/point", nodes->n_points, dim, nodes->point);
        kr_h5_write_int64(file, "/cells/first", nodes->n + 1, 0, nodes->first);
        kr_h5_write_int64(file, "/cells/vertex", (size_t)nodes->first[nodes->n], 0, nodes->vertex);
    }
    write_sets(nodes, file);
    kr_h5_close(file);
}

static void read_sets(struct kr_nodes *nodes, struct kr_h5 *file) {
    size_t count, rows, columns;
    char **names = kr_h5_list(file, "/sets", &count);
    for (size_t s = 0; s < count; s++) {
        char *name = kr_text("/sets/%s", names[s]);
        kr_h5_shape(file, name, &rows, &columns);
        kr_nodes_add_set(nodes, names[s], rows, kr_h5_read_int64(file, name, rows, 0),
                         kr_h5_get_double(file, name, "measure"));
        kr_free(name);
        kr_free(names[s]);
    }
    kr_free(names);
}

static void read_word(struct kr_h5 *file, const char *name, char word[32]) {
    char *text = kr_h5_get_text(file, "/", name);
    snprintf(word, 32, "%s", text);
    kr_free(text);
}

static void read_cells(struct kr_nodes *nodes, struct kr_h5 *file, const char *path) {
    size_t columns, corners;
    if (!kr_h5_has(file, "/cells/point"))
        return;
    kr_h5_shape(file, "/cells/point", &nodes->n_points, &columns);
    nodes->point = kr_h5_read_double(file, "/cells/point", nodes->n_points, (size_t)nodes->dim);
    nodes->first = kr_h5_read_int64(file, "/cells/first", nodes->n + 1, 0);
    kr_h5_shape(file, "/cells/vertex", &corners, &columns);
    if (nodes->first[0] != 0 || nodes->first[nodes->n] != (int64_t)corners)
        kr_stop(KR_EXIT_INPUT, "%s: /cells/first ends at %lld, expected the %zu of /cells/vertex",
                path, (long long)nodes->first[nodes->n], corners);
    nodes->vertex = kr_h5_read_int64(file, "/cells/vertex", corners, 0);
}

/* Replace what kr_nodes_create made by what the file holds. */
static void read_arrays(struct kr_nodes *nodes, struct kr_h5 *file) {
    kr_free(nodes->position);
    kr_free(nodes->volume);
    kr_free(nodes->factor);
    kr_free(nodes->tag);
    nodes->position = kr_h5_read_double(file, "/nodes/position", nodes->n, (size_t)nodes->dim);
    nodes->volume = kr_h5_read_double(file, "/nodes/volume", nodes->n, 0);
    nodes->factor = kr_h5_read_double(file, "/nodes/surface_factor", nodes->n, 0);
    nodes->tag = kr_h5_read_int64(file, "/nodes/tag", nodes->n, 0);
    if (kr_h5_has(file, "/nodes/partition"))
        nodes->partition = kr_h5_read_int64(file, "/nodes/partition", nodes->n, 0);
}

/* How a bond's factor is made of its nodes' follows from the correction. */
static void read_pairing(struct kr_nodes *nodes, struct kr_h5 *file) {
    if (!strcmp(nodes->made_for.surface_correction, "volume"))
        nodes->pairing = KR_PAIRING_HARMONIC;
    if (strcmp(nodes->made_for.surface_correction, "force-density"))
        return;
    nodes->pairing = KR_PAIRING_ELLIPSE;
    nodes->axis_factor = kr_h5_read_double(file, "/nodes/axis_factor", nodes->n,
                                           (size_t)nodes->dim);
}

struct kr_nodes *kr_nodes_read(const char *path) {
    struct kr_h5 *file = kr_h5_open(path, FORMAT, VERSION);
    size_t n, columns;
    int64_t dim = kr_h5_get_int64(file, "/", "dim");
    kr_h5_shape(file, "/nodes/position", &n, &columns);
    if (dim != 2 && dim != 3)
        kr_stop(KR_EXIT_INPUT, "%s: found dim %lld, expected 2 or 3", path, (long long)dim);
    if (n > INT32_MAX)
        kr_stop(KR_EXIT_INPUT, "%s: found %zu nodes, expected at most %d", path, n, INT32_MAX);
    struct kr_nodes *nodes = kr_nodes_create((int)dim, n);
    read_arrays(nodes, file);
    nodes->spacing = kr_h5_get_double(file, "/", "spacing");
    nodes->made_for.horizon = kr_h5_get_double(file, "/", "horizon");
    read_word(file, "model", nodes->made_for.model);
    if (kr_h5_has_attribute(file, "/", "micromodulus"))
        read_word(file, "micromodulus", nodes->made_for.micromodulus);
    else /* files of before there was a choice */
        snprintf(nodes->made_for.micromodulus, sizeof nodes->made_for.micromodulus, "constant");
    read_word(file, "partial_volume", nodes->made_for.partial_volume);
    read_word(file, "surface_correction", nodes->made_for.surface_correction);
    read_word(file, "deformation", nodes->made_for.deformation);
    read_pairing(nodes, file);
    read_cells(nodes, file, path);
    read_sets(nodes, file);
    kr_h5_close(file);
    char *fault = kr_nodes_fault(nodes);
    if (fault)
        kr_stop(KR_EXIT_INPUT, "%s: %s; make it anew with kirsch-nodes", path, fault);
    return nodes;
}
