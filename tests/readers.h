/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Everything that reads a file that a user may bring, by the path of one: what the garbled corpus and the
 * fuzzer feed. Each takes the file or stops with a sentence.
 */
#ifndef KR_TEST_READERS_H
#define KR_TEST_READERS_H

#include "base/error.h"
#include "base/memory.h"
#include "base/stl.h"
#include "cad.h"
#include "case.h"
#include "fill.h"
#include "folder.h"
#include "import.h"
#include "mesh.h"

#include <stdio.h>

static void import_of(const char *path, int repair) {
    struct kr_mesh *mesh;
    struct kr_import import = {
        .path = path, .unit = 1, .repair = repair, .folder = folder, .spacing = 0.5};
    struct kr_nodes *nodes = kr_import(&import, &mesh);
    kr_nodes_free(nodes);
    kr_mesh_free(mesh);
}

static void read_nodes(const char *path) {
    import_of(path, 0);
}

static void mend_nodes(const char *path) {
    import_of(path, 1);
}

static void read_set(const char *path) {
    struct kr_mesh *mesh;
    const char *set[] = {path};
    struct kr_import import = {.path = "tests/corpus/peridigm.txt",
                               .unit = 1,
                               .folder = folder,
                               .n_sets = 1,
                               .set = set};
    kr_nodes_free(kr_import(&import, &mesh));
}

static void read_pores(const char *path) {
    struct kr_case c = {.width = 50e-3, .height = 25e-3};
    size_t n;
    kr_free(kr_case_read_pores(&c, path, &n));
}

static void read_curves(const char *path) {
    FILE *file = fopen(path, "r");
    struct kr_shape *face;
    const struct kr_cad_place place = {{0, 0}, 0, 2e-4};
    size_t n = kr_cad_parse(file, path, &place, &face);
    for (size_t f = 0; f < n; f++)
        kr_shape_free(&face[f]);
    kr_free(face);
    fclose(file);
}

/** A fault is told, not stopped at: gmsh.c then tries another method. */
static void read_reply(const char *path) {
    FILE *file = fopen(path, "r");
    double corner[] = {0, 0, 2, 0, 2, 1, 0, 1};
    size_t segments[] = {2, 1, 2, 1}, first[] = {0, 4};
    struct kr_gmsh_region region = {1, first, corner, segments, "two squares"};
    char *fault = kr_fill_read(&region, file);
    fclose(file);
    if (fault)
        kr_stop(KR_EXIT_INPUT, "%s: %s", path, fault);
}

static void read_stl(const char *path) {
    size_t n;
    kr_free(kr_stl_read(path, 1e-3, &n));
}

#endif
