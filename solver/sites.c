/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Where cracks begin. Cells two horizons wide remember whether a bond has broken in them; a bond whose
 * cell and the cells around it remember none begins a site.
 */
#include "sites.h"

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

struct kr_sites {
    const struct kr_bonds *bonds; /* not owned */
    FILE *file;
    char *path;
    double low[3], width;
    int64_t cells[3];
    unsigned char *broken;
    size_t count;
};

static void lay_cells(struct kr_sites *s) {
    const struct kr_bonds *b = s->bonds;
    size_t all = 1;
    s->width = 2 * b->material.horizon;
    for (int d = 0; d < 3; d++) {
        double high = 0;
        s->cells[d] = 1;
        for (size_t i = 0; i < b->n && d < b->dim; i++) {
            s->low[d] = i ? fmin(s->low[d], b->x[d][i]) : b->x[d][i];
            high = i ? fmax(high, b->x[d][i]) : b->x[d][i];
        }
        if (d < b->dim)
            s->cells[d] = (int64_t)floor((high - s->low[d]) / s->width) + 1;
        all *= (size_t)s->cells[d];
    }
    s->broken = KR_NEW(unsigned char, all);
}

/* The cell of a bond's middle, and the middle. */
static void middle_of(const struct kr_sites *s, const int32_t *pair, int64_t cell[3], double x[3]) {
    for (int d = 0; d < 3; d++) {
        cell[d] = 0;
        if (d >= s->bonds->dim)
            continue;
        x[d] = 0.5 * (s->bonds->x[d][pair[0]] + s->bonds->x[d][pair[1]]);
        cell[d] = (int64_t)floor((x[d] - s->low[d]) / s->width);
    }
}

static unsigned char *at(const struct kr_sites *s, int64_t i, int64_t j, int64_t k) {
    static unsigned char outside;
    outside = 0;
    if (i < 0 || j < 0 || k < 0 || i >= s->cells[0] || j >= s->cells[1] || k >= s->cells[2])
        return &outside;
    return &s->broken[(k * s->cells[1] + j) * s->cells[0] + i];
}

/* Whether a bond in this cell is the first around; it is remembered. */
static int is_new(struct kr_sites *s, const int64_t cell[3]) {
    int known = 0;
    for (int64_t i = -1; i <= 1; i++)
        for (int64_t j = -1; j <= 1; j++)
            for (int64_t k = -1; k <= 1; k++)
                known |= *at(s, cell[0] + i, cell[1] + j, cell[2] + k);
    *at(s, cell[0], cell[1], cell[2]) = 1;
    return !known;
}

static void check_written(struct kr_sites *s) {
    if (fflush(s->file) || ferror(s->file))
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s; free some space and run again",
                s->path, strerror(errno));
}

struct kr_sites *kr_sites_create(const struct kr_case *c, const struct kr_bonds *bonds,
                                 const struct kr_crack *crack, long bytes) {
    struct kr_sites *s = KR_NEW(struct kr_sites, 1);
    *s = (struct kr_sites){.bonds = bonds, .path = kr_case_file(c, "sites.csv")};
    lay_cells(s);
    for (size_t k = 0; k < crack->count; k++) {
        int64_t cell[3];
        double x[3];
        middle_of(s, crack->pair + 2 * k, cell, x);
        s->count += (size_t)is_new(s, cell);
    }
    s->file = kr_file_grow(s->path, bytes);
    if (bytes == 0)
        fprintf(s->file, "site,stage,step,time [s],stage_time [s],x [m],y [m]%s\n",
                bonds->dim == 3 ? ",z [m]" : "");
    check_written(s);
    return s;
}

void kr_sites_free(struct kr_sites *s) {
    if (fclose(s->file))
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s", s->path, strerror(errno));
    kr_free(s->path);
    kr_free(s->broken);
    kr_free(s);
}

void kr_sites_note(struct kr_sites *s, const struct kr_crack *crack, size_t from,
                   struct kr_history_time when) {
    for (size_t k = from; k < crack->count; k++) {
        int64_t cell[3];
        double x[3];
        middle_of(s, crack->pair + 2 * k, cell, x);
        if (!is_new(s, cell))
            continue;
        fprintf(s->file, "%zu,%zu,%ld,%.9g,%.12g", ++s->count, when.stage + 1, when.step, when.time,
                when.stage_time);
        for (int d = 0; d < s->bonds->dim; d++)
            fprintf(s->file, ",%.9g", x[d]);
        fprintf(s->file, "\n");
    }
    check_written(s);
}

long kr_sites_bytes(const struct kr_sites *s) {
    return kr_file_settle(s->file, s->path);
}
