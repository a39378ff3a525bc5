/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Any file to nodes, nodes to files of others. See import.h.
 */
#include "import.h"

#include "base/error.h"
#include "base/memory.h"
#include "convert.h"
#include "foreign.h"
#include "inp.h"
#include "nodes_dat.h"
#include "pieces.h"
#include "points.h"
#include "repair.h"
#include "vtu.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

static int has_ending(const char *path, const char *ending) {
    size_t length = strlen(path), tail = strlen(ending);
    return length >= tail && !strcasecmp(path + length - tail, ending);
}

static void rename_set(struct kr_set *set, char *name, const char *why) {
    kr_warn("set '%s' is now '%s': %s", set->name, name, why);
    kr_free(set->name);
    set->name = name;
}

static int is_taken(const struct kr_nodes *nodes, const struct kr_set *set, const char *name) {
    for (size_t s = 0; s < nodes->n_sets; s++)
        if (&nodes->set[s] != set && !strcmp(nodes->set[s].name, name))
            return 1;
    return 0;
}

/** A name is part of a path in the node file, and of names of files. */
static void tidy_names(struct kr_nodes *nodes) {
    for (size_t s = 0; s < nodes->n_sets; s++)
        if (strchr(nodes->set[s].name, '/')) {
            char *name = kr_text_copy(nodes->set[s].name);
            for (char *slash = name; (slash = strchr(slash, '/'));)
                *slash = '_';
            rename_set(&nodes->set[s], name, "a name cannot hold a slash");
        }
    /* Cells keep a name that they share with a boundary. */
    for (int pass = 0; pass < 2; pass++)
        for (size_t s = nodes->n_sets; s-- > 0;) {
            struct kr_set *set = &nodes->set[s];
            if (!is_taken(nodes, set, set->name) || (pass == 0 && !(set->measure > 0)))
                continue;
            char *name = kr_text("%s%s", set->name, pass ? "_2" : "_boundary");
            rename_set(set, name, "there is another set of that name");
        }
}

static struct kr_nodes *import_points(const struct kr_import *import) {
    struct kr_nodes *nodes = kr_points_read(import->path, import->unit, import->thickness);
    for (size_t s = 0; s < import->n_sets; s++)
        kr_points_read_set(import->set[s], nodes);
    return nodes;
}

static struct kr_nodes *import_mesh(const struct kr_import *import, struct kr_mesh **mesh) {
    char *points;
    *mesh = kr_mesh_read(import->path, import->folder, import->spacing, &points);
    if (points) {
        struct kr_nodes *nodes = kr_points_read(points, import->unit, import->thickness);
        kr_free(points);
        return nodes;
    }
    kr_pieces_join(*mesh, import->path);
    for (size_t k = 0; k < 3 * (*mesh)->n_points; k++)
        (*mesh)->point[k] *= import->unit;
    kr_mesh_repair(*mesh, import->path, import->repair);
    return kr_convert(*mesh);
}

struct kr_nodes *kr_import(const struct kr_import *import, struct kr_mesh **mesh) {
    int is_text = has_ending(import->path, ".csv") || has_ending(import->path, ".txt");
    struct kr_nodes *nodes;
    *mesh = NULL;
    if (!is_text && import->n_sets)
        kr_stop(KR_EXIT_INPUT, "found the argument '%s'; expected one mesh at the most (files of "
                               "node sets go with points in .txt or .csv)",
                import->set[0]);
    if (is_text)
        nodes = import_points(import);
    else if (has_ending(import->path, ".dat") && import->unit == 1)
        nodes = kr_nodes_dat_read(import->path);
    else if (has_ending(import->path, ".dat"))
        kr_stop(KR_EXIT_INPUT, "%s: nodes.dat is in metres; --unit does not go with it", import->path);
    else
        nodes = import_mesh(import, mesh);
    tidy_names(nodes);
    return nodes;
}

/* ---- writing ---- */

static void write_peridigm(const struct kr_nodes *nodes, const char *stem, const char *nodes_file,
                           double thickness) {
    (void)nodes_file;
    kr_points_write_peridigm(nodes, stem, thickness);
    kr_say("  wrote %s.txt and %s_ns_*.txt", stem, stem);
}

static void write_csv(const struct kr_nodes *nodes, const char *stem, const char *nodes_file,
                      double thickness) {
    (void)nodes_file;
    kr_points_write_csv(nodes, stem, thickness);
    kr_say("  wrote %s.csv", stem);
}

static void write_dat(const struct kr_nodes *nodes, const char *stem, const char *nodes_file,
                      double thickness) {
    (void)nodes_file;
    (void)thickness;
    if (nodes->dim != 2)
        kr_stop(KR_EXIT_INPUT, "nodes.dat holds plane bodies only; take csv");
    const char *slash = strrchr(stem, '/');
    char *path = kr_text("%.*snodes.dat", slash ? (int)(slash - stem + 1) : 0, stem);
    kr_nodes_dat_write(nodes, path);
    kr_say("  wrote %s", path);
    kr_free(path);
}

static void write_vtu(const struct kr_nodes *nodes, const char *stem, const char *nodes_file,
                      double thickness) {
    char *path = kr_text("%s.vtu", stem);
    (void)nodes_file;
    (void)thickness;
    kr_vtu_write(nodes, path);
    kr_say("  wrote %s", path);
    kr_free(path);
}

static void write_inp(const struct kr_nodes *nodes, const char *stem, const char *nodes_file,
                      double thickness) {
    char *path = kr_text("%s.inp", stem);
    (void)nodes_file;
    (void)thickness;
    kr_inp_write(nodes, path);
    kr_say("  wrote %s", path);
    kr_free(path);
}

static void write_exodus(const struct kr_nodes *nodes, const char *stem, const char *nodes_file,
                         double thickness) {
    char *path = kr_text("%s.e", stem), *beside = kr_text("%s.e.tmp", stem);
    (void)nodes;
    (void)thickness;
    kr_python("to_exodus.py", nodes_file, beside, path);
    if (rename(beside, path))
        kr_stop(KR_EXIT_STORAGE, "%s cannot be written", path);
    kr_say("  wrote %s", path);
    kr_free(path);
    kr_free(beside);
}

static const struct {
    const char *name;
    void (*write)(const struct kr_nodes *, const char *, const char *, double);
} writers[] = {{"peridigm", write_peridigm},
               {"exodus", write_exodus},
               {"vtu", write_vtu},
               {"inp", write_inp},
               {"csv", write_csv},
               {"dat", write_dat}};

int kr_export_knows(const char *format) {
    for (size_t k = 0; k < sizeof writers / sizeof *writers; k++)
        if (!strcmp(format, writers[k].name))
            return 1;
    return 0;
}

void kr_export(const struct kr_nodes *nodes, const char *format, const char *stem,
               const char *nodes_file, double thickness) {
    for (size_t k = 0; k < sizeof writers / sizeof *writers; k++)
        if (!strcmp(format, writers[k].name))
            writers[k].write(nodes, stem, nodes_file, thickness);
}
