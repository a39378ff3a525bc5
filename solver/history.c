/* SPDX-License-Identifier: BSD-3-Clause
 *
 * history.csv: a column a load and component. Stages share the columns of a set; a stage that does not
 * load a set leaves its columns empty.
 */
#include "history.h"

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

/* The `which`-th load on a set, from 0. */
struct column {
    const char *set;
    size_t which;
};

struct kr_history {
    FILE *file;
    char *path;
    int dim;
    size_t stages;
    struct kr_boundary *const *boundary; /* (stages) not owned */
    size_t count, room;
    struct column *column;
    const struct kr_probes *probes; /* not owned */
};

static void check_written(struct kr_history *h) {
    if (fflush(h->file) || ferror(h->file))
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s; free some space and run again",
                h->path, strerror(errno));
}

/* Load k among those on its set. */
static struct column column_of(const struct kr_boundary *boundary, size_t k) {
    struct column column = {kr_boundary_set(boundary, k), 0};
    for (size_t m = 0; m < k; m++)
        column.which += !strcmp(kr_boundary_set(boundary, m), column.set);
    return column;
}

static int is_same(struct column a, struct column b) {
    return a.which == b.which && !strcmp(a.set, b.set);
}

static void find_columns(struct kr_history *h) {
    for (size_t stage = 0; stage < h->stages; stage++)
        for (size_t k = 0; k < kr_boundary_count(h->boundary[stage]); k++) {
            struct column column = column_of(h->boundary[stage], k);
            int known = 0;
            for (size_t m = 0; m < h->count && !known; m++)
                known = is_same(h->column[m], column);
            if (known)
                continue;
            KR_GROW(h->column, h->count, h->room);
            h->column[h->count++] = column;
        }
}

long kr_history_bytes(const struct kr_history *h) {
    return kr_file_settle(h->file, h->path);
}

static void write_header(struct kr_history *h) {
    static const char *const name[] = {"kinetic", "strain", "fracture", "external_work", "balance"};
    fprintf(h->file, "step,time [s]");
    for (size_t k = 0; k < sizeof name / sizeof *name; k++)
        fprintf(h->file, ",%s [%s]", name[k], kr_ledger_unit(h->dim));
    fprintf(h->file, ",broken_bonds");
    for (size_t k = 0; k < h->count; k++) {
        char again[32] = "";
        if (h->column[k].which)
            snprintf(again, sizeof again, " (%zu)", h->column[k].which + 1);
        for (int d = 0; d < h->dim; d++)
            fprintf(h->file, ",reaction_%c %s%s [%s]", "xyz"[d], h->column[k].set, again,
                    h->dim == 2 ? "N/m" : "N");
    }
    kr_probes_header(h->probes, h->file);
    fprintf(h->file, h->stages > 1 ? ",stage,stage_time [s]\n" : "\n");
}

struct kr_history *kr_history_open(const char *path, struct kr_boundary *const *boundary,
                                   size_t stages, int dim, const struct kr_probes *probes,
                                   long bytes) {
    struct kr_history *h = KR_NEW(struct kr_history, 1);
    *h = (struct kr_history){
        .path = kr_text_copy(path), .dim = dim, .stages = stages, .boundary = boundary, .probes = probes};
    find_columns(h);
    h->file = kr_file_grow(path, bytes);
    if (bytes == 0)
        write_header(h);
    check_written(h);
    return h;
}

static void write_reaction(struct kr_history *h, const struct kr_boundary *boundary,
                           struct column column) {
    for (size_t k = 0; k < kr_boundary_count(boundary); k++)
        if (is_same(column_of(boundary, k), column)) {
            for (int d = 0; d < h->dim; d++)
                fprintf(h->file, ",%.9g", kr_boundary_reaction(boundary, k, d));
            return;
        }
    for (int d = 0; d < h->dim; d++)
        fprintf(h->file, ",");
}

void kr_history_write(struct kr_history *h, const struct kr_body *body,
                      const struct kr_ledger *ledger, const struct kr_crack *crack, struct kr_history_time at) {
    fprintf(h->file, "%ld,%.9g,%.12g,%.12g,%.12g,%.12g,%.6g,%zu", at.step, at.time, ledger->kinetic,
            ledger->strain, ledger->fracture, ledger->external, ledger->balance, crack->count);
    for (size_t k = 0; k < h->count; k++)
        write_reaction(h, h->boundary[at.stage], h->column[k]);
    kr_probes_write(h->probes, body, ledger->v, h->file);
    if (h->stages > 1)
        fprintf(h->file, ",%zu,%.12g", at.stage + 1, at.stage_time);
    fprintf(h->file, "\n");
    check_written(h);
}

void kr_history_close(struct kr_history *h) {
    if (fclose(h->file))
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s", h->path, strerror(errno));
    kr_free(h->path);
    kr_free(h->column);
    kr_free(h);
}
