/* SPDX-License-Identifier: BSD-3-Clause
 *
 * STL files. The two kinds are told apart by their size, for the header of a binary file may begin
 * with "solid", too. The format: M. Burns, Automated Fabrication (1993), section 6.5.
 */
#include "base/stl.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/unit.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HEADER = 84, RECORD = 50 };

static uint32_t word_at(const unsigned char *from) {
    return from[0] | (uint32_t)from[1] << 8 | (uint32_t)from[2] << 16 | (uint32_t)from[3] << 24;
}

static double float_at(const unsigned char *from) {
    uint32_t word = word_at(from);
    float value;
    memcpy(&value, &word, sizeof value);
    return value;
}

/* The whole file with a zero behind it, owned by the caller. */
static unsigned char *slurp(const char *path, size_t *length) {
    FILE *file = fopen(path, "rb");
    if (!file || fseek(file, 0, SEEK_END))
        kr_stop(KR_EXIT_INPUT, "%s cannot be read: %s", path, strerror(errno));
    long size = ftell(file);
    rewind(file);
    unsigned char *bytes = KR_NEW(unsigned char, (size_t)(size < 0 ? 0 : size) + 1);
    *length = size < 0 ? 0 : fread(bytes, 1, (size_t)size, file);
    if (size < 0 || *length != (size_t)size)
        kr_stop(KR_EXIT_INPUT, "%s cannot be read to its end: %s", path, strerror(errno));
    fclose(file);
    return bytes;
}

static double *read_binary(const unsigned char *bytes, size_t count) {
    double *corner = KR_NEW(double, 9 * count);
    for (size_t t = 0; t < count; t++)
        for (size_t k = 0; k < 9; k++) /* behind the three numbers of the normal */
            corner[9 * t + k] = float_at(bytes + HEADER + RECORD * t + 12 + 4 * k);
    return corner;
}

/* The three numbers behind "vertex"; what else stands in the file says nothing. */
static void read_vertex(const char *path, const char *text, size_t line, double corner[3]) {
    for (int d = 0; d < 3; d++) {
        text += strspn(text, " \t");
        const char *end = kr_unit_number(text, &corner[d]);
        if (!end)
            kr_stop(KR_EXIT_INPUT, "%s:%zu: found '%.*s', expected the three coordinates of a vertex",
                    path, line, (int)strcspn(text, "\r\n"), text);
        text = end;
    }
}

static double *read_text(const char *path, const char *text, size_t *count) {
    double *corner = NULL;
    size_t corners = 0, room = 0;
    for (size_t line = 1; *text; line++) {
        text += strspn(text, " \t");
        if (!strncasecmp(text, "vertex", 6)) {
            if (3 * corners + 3 > room)
                corner = kr_realloc(corner, room = 6 * corners + 900, sizeof *corner);
            read_vertex(path, text + 6, line, corner + 3 * corners++);
        }
        text += strcspn(text, "\n");
        text += *text == '\n';
    }
    if (corners % 3)
        kr_stop(KR_EXIT_INPUT, "%s: found %zu vertices, expected three a triangle; the file is cut",
                path, corners);
    *count = corners / 3;
    return corner;
}

double *kr_stl_read(const char *path, double unit, size_t *count) {
    size_t length;
    unsigned char *bytes = slurp(path, &length);
    double *corner = NULL;
    *count = length >= HEADER ? word_at(bytes + 80) : 0;
    if (length >= HEADER && length == HEADER + RECORD * *count)
        corner = read_binary(bytes, *count);
    else if (!strncasecmp((const char *)bytes, "solid", 5))
        corner = read_text(path, (const char *)bytes, count);
    else
        kr_stop(KR_EXIT_INPUT,
                "%s: neither an ASCII STL file, which begins with 'solid', nor a whole binary one: "
                "it has %zu bytes", path, length);
    if (!*count)
        kr_stop(KR_EXIT_INPUT, "%s: no triangle in it", path);
    for (size_t k = 0; k < 9 * *count; k++) {
        if (!isfinite(corner[k]))
            kr_stop(KR_EXIT_INPUT, "%s: triangle %zu has the coordinate %g; expected a finite number",
                    path, k / 9 + 1, corner[k]);
        corner[k] *= unit;
    }
    kr_free(bytes);
    return corner;
}
