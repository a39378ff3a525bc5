/* SPDX-License-Identifier: BSD-3-Clause
 *
 * STL files. A binary one has 80 bytes of any text, a count of 4 bytes, and 50 bytes a triangle; it
 * is told by its length, for its text may well begin with "solid" as an ASCII file does.
 * The format: M. Burns, Automated Fabrication (1993), section 6.5.
 */
#include "base/stl.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/scan.h"

#include <math.h>
#include <stdint.h>
#include <string.h>
#include <strings.h>

enum { HEAD = 84, RECORD = 50 };

struct reading {
    struct kr_scan scan;
    size_t n, room;
    double (*triangle)[9];
};

static void add_triangle(struct reading *r, const double corner[9]) {
    KR_GROW(r->triangle, r->n, r->room);
    memcpy(r->triangle[r->n++], corner, 9 * sizeof *corner);
}

static void read_binary(struct reading *r, size_t count) {
    for (size_t t = 0; t < count; t++) {
        const char *at = r->scan.data + HEAD + RECORD * t + 12; /* behind the normal */
        float value[9];
        double corner[9];
        memcpy(value, at, sizeof value);
        for (int k = 0; k < 9; k++) {
            corner[k] = (double)value[k];
            if (!isfinite(corner[k]))
                kr_stop(KR_EXIT_INPUT, "%s: triangle %zu (byte %zu) has a corner that is not a number",
                        r->scan.path, t + 1, HEAD + RECORD * t);
        }
        add_triangle(r, corner);
    }
}

static void expect(struct reading *r, const char *word, const char *wanted) {
    if (strcasecmp(word, wanted))
        kr_scan_bad(&r->scan, "found '%.20s', expected '%s'", word, wanted);
}

static void next(struct reading *r, char word[64], const char *wanted) {
    if (!kr_scan_word(&r->scan, word, 64))
        kr_scan_bad(&r->scan, "the file ends, expected '%s'", wanted);
    expect(r, word, wanted);
}

static void read_facet(struct reading *r) {
    char word[64];
    double corner[9];
    next(r, word, "normal");
    for (int d = 0; d < 3; d++) /* not used, and some programs write nan for it */
        if (!kr_scan_word(&r->scan, word, sizeof word))
            kr_scan_bad(&r->scan, "the file ends, expected a normal");
    next(r, word, "outer");
    next(r, word, "loop");
    for (int k = 0; k < 9; k++) {
        if (k % 3 == 0)
            next(r, word, "vertex");
        corner[k] = kr_scan_double(&r->scan, "a coordinate of a vertex");
        if (!isfinite(corner[k]))
            kr_scan_bad(&r->scan, "a coordinate of a vertex is no finite number");
    }
    next(r, word, "endloop");
    next(r, word, "endfacet");
    add_triangle(r, corner);
}

/** The name of a solid may be any text: what follows up to the end of the line. */
static void skip_line(struct kr_scan *scan) {
    while (scan->at < scan->size && scan->data[scan->at] != '\n')
        scan->at++;
}

static void read_ascii(struct reading *r) {
    char word[64];
    int is_open = 0;
    while (kr_scan_word(&r->scan, word, sizeof word)) {
        if (!strcasecmp(word, "solid") && !is_open) {
            skip_line(&r->scan);
            is_open = 1;
        } else if (!strcasecmp(word, "endsolid") && is_open) {
            skip_line(&r->scan);
            is_open = 0;
        } else {
            expect(r, word, is_open ? "facet" : "solid");
            read_facet(r);
        }
    }
    if (is_open)
        kr_scan_bad(&r->scan, "the file ends, expected 'facet' or 'endsolid'");
}

static void read_file(struct reading *r) {
    uint32_t count = 0;
    if (r->scan.size >= HEAD)
        memcpy(&count, r->scan.data + HEAD - sizeof count, sizeof count);
    size_t wanted = HEAD + RECORD * (size_t)count;
    int is_ascii = r->scan.size > 5 && !strncasecmp(r->scan.data, "solid", 5) &&
                   !memchr(r->scan.data, 0, r->scan.size);
    if (r->scan.size >= HEAD && r->scan.size == wanted)
        read_binary(r, count);
    else if (is_ascii)
        read_ascii(r);
    else
        kr_stop(KR_EXIT_INPUT,
                "%s: neither an ASCII STL file, which begins with 'solid', nor a binary one: %zu bytes, "
                "and its count of %lu triangles needs %zu",
                r->scan.path, r->scan.size, (unsigned long)count, wanted);
}

double *kr_stl_read(const char *path, double unit, size_t *count) {
    struct reading r = {.scan = kr_scan_open(path)};
    read_file(&r);
    if (!r.n)
        kr_stop(KR_EXIT_INPUT, "%s: no triangle in it", path);
    for (size_t k = 0; k < 9 * r.n; k++)
        r.triangle[k / 9][k % 9] *= unit;
    kr_scan_close(&r.scan);
    *count = r.n;
    return (double *)r.triangle;
}
