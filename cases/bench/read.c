/* SPDX-License-Identifier: BSD-3-Clause
 *
 * How fast are meshes read? Times the reader of gmsh's files: processor time, best of several; and beside it, in
 * turn, a bare parser of MSH 4.1 binary and 2.2 ASCII that checks nothing, sorts nothing and knows no groups: the
 * least there is to do.
 */
#include "base/error.h"
#include "base/memory.h"
#include "base/scan.h"
#include "mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { RUNS = 7 };

static double cpu_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static long long take(const char **at, size_t bytes) {
    long long value = 0;
    memcpy(&value, *at, bytes);
    *at += bytes;
    return value;
}

static const char *section(const struct kr_scan *file, const char *name) {
    const char *found = memmem(file->data, file->size, name, strlen(name));
    return found ? found + strlen(name) : file->data + file->size;
}

/** Quadrilaterals of MSH 4.1 binary: points and corners as they stand. */
static size_t bare_binary(const struct kr_scan *file) {
    const char *at = section(file, "\n$Nodes\n");
    size_t blocks = (size_t)take(&at, 8), n = (size_t)take(&at, 8), cells = 0, done = 0;
    double *point = KR_NEW_RAW(double, 3 * n);
    at += 16;
    while (blocks-- > 0) {
        at += 12;
        size_t count = (size_t)take(&at, 8);
        memcpy(point + 3 * done, at + 8 * count, 24 * count);
        at += 32 * count;
        done += count;
    }
    at = section(file, "\n$Elements\n");
    blocks = (size_t)take(&at, 8);
    size_t *corner = KR_NEW_RAW(size_t, 4 * (size_t)take(&at, 8));
    at += 16;
    while (blocks-- > 0) {
        at += 8;
        size_t nodes = take(&at, 4) == 3 ? 4 : 2, count = (size_t)take(&at, 8);
        for (size_t k = 0; k < count; k++, at += 8 * (nodes + 1))
            memcpy(corner + 4 * (cells + k), at + 8, 8 * nodes);
        cells = nodes == 4 ? cells + count : cells;
    }
    kr_free(point);
    kr_free(corner);
    return cells;
}

/** The same of MSH 2.2 ASCII. */
static size_t bare_text(const struct kr_scan *file) {
    char *at = (char *)(uintptr_t)section(file, "\n$Nodes\n");
    size_t n = strtoul(at, &at, 10), cells = 0;
    double *point = KR_NEW_RAW(double, 3 * n);
    for (size_t k = 0; k < n; k++) {
        strtoul(at, &at, 10);
        for (int d = 0; d < 3; d++)
            point[3 * k + (size_t)d] = strtod(at, &at);
    }
    at = (char *)(uintptr_t)section(file, "\n$Elements\n");
    n = strtoul(at, &at, 10);
    size_t *corner = KR_NEW_RAW(size_t, 4 * n);
    for (size_t k = 0; k < n; k++) {
        strtoul(at, &at, 10);
        size_t nodes = strtoul(at, &at, 10) == 3 ? 4 : 2;
        for (size_t tags = strtoul(at, &at, 10); tags > 0; tags--)
            strtoul(at, &at, 10);
        for (size_t c = 0; c < nodes; c++)
            corner[4 * cells + c] = strtoul(at, &at, 10);
        cells += nodes == 4;
    }
    kr_free(point);
    kr_free(corner);
    return cells;
}

static size_t read_bare(const char *path) {
    struct kr_scan file = kr_scan_open(path);
    int is_binary = strstr(file.data, "4.1 1") != NULL;
    size_t cells = is_binary ? bare_binary(&file) : bare_text(&file);
    kr_scan_close(&file);
    return cells;
}

int main(int argc, char **argv) {
    for (int k = 1; k < argc; k++) {
        double best = INFINITY, bare = INFINITY;
        size_t cells = 0;
        int has_bare = !strcmp(argv[k], "binary41.msh") || !strcmp(argv[k], "ascii22.msh");
        for (int run = 0; run < RUNS; run++) {
            double begun = cpu_seconds();
            struct kr_mesh *mesh = kr_mesh_read_msh(argv[k]);
            best = fmin(best, cpu_seconds() - begun);
            cells = mesh->n_cells;
            kr_mesh_free(mesh);
            begun = cpu_seconds();
            if (has_bare && read_bare(argv[k]) != cells)
                kr_stop(KR_EXIT_INPUT, "%s: the bare parser finds other cells", argv[k]);
            bare = fmin(bare, cpu_seconds() - begun);
        }
        if (has_bare)
            kr_say("  %-28s %8zu cells in %.3f s; a bare parser %.3f s, %.2f times as long", argv[k], cells, best,
                   bare, best / bare);
        else
            kr_say("  %-28s %8zu cells in %.3f s", argv[k], cells, best);
    }
    return KR_EXIT_OK;
}
