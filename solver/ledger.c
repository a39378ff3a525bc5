/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The energy ledger. Velocities live half a step before the forces; at the time of the forces they
 * are v + dt/2 f/rho, or what is prescribed, and with these all terms are of second order in dt.
 */
#include "ledger.h"

#include "base/error.h"
#include "base/memory.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

const char *kr_ledger_unit(int dim) {
    return dim == 2 ? "J/m" : "J";
}

struct kr_ledger *kr_ledger_create(const struct kr_body *body) {
    struct kr_ledger *ledger = KR_NEW(struct kr_ledger, 1);
    *ledger = (struct kr_ledger){.n = body->n, .dim = body->dim};
    for (int d = 0; d < body->dim; d++)
        ledger->v[d] = kr_bonds_padded(body->n);
    return ledger;
}

void kr_ledger_free(struct kr_ledger *ledger) {
    for (int d = 0; d < ledger->dim; d++)
        kr_bonds_padded_free(ledger->v[d]);
    kr_free(ledger);
}

void kr_ledger_step(struct kr_ledger *ledger, struct kr_boundary *boundary,
                    const struct kr_body *body, double t, double dt) {
    double power = kr_boundary_power(boundary, body, t, dt, 0);
    ledger->external += 0.5 * dt * (ledger->power + power);
    ledger->most_external = fmax(ledger->most_external, fabs(ledger->external));
    ledger->power = power;
}

struct motion {
    const struct kr_ledger *ledger;
    const struct kr_bonds *bonds;
};

static double kinetic_of_node(const void *context, size_t i) {
    const struct motion *m = context;
    double square = 0;
    for (int d = 0; d < m->ledger->dim; d++)
        square += m->ledger->v[d][i] * m->ledger->v[d][i];
    return 0.5 * m->bonds->material.density * m->bonds->volume[i] * square;
}

void kr_ledger_update(struct kr_ledger *ledger, struct kr_boundary *boundary, struct kr_body *body,
                      const struct kr_crack *crack, double t, double dt, int first) {
    const double half = first ? 0 : 0.5 * dt / body->bonds->material.density;
    for (int d = 0; d < body->dim; d++) {
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < body->n; i++)
            ledger->v[d][i] = body->v[d][i] + half * body->force[d][i];
    }
    kr_boundary_velocity(boundary, body, t, dt, first, ledger->v);
    struct motion motion = {ledger, body->bonds};
    ledger->kinetic = kr_body_sum(body->n, kinetic_of_node, &motion);
    ledger->strain = kr_body_energy(body);
    ledger->fracture = crack->energy;
    ledger->balance = ledger->external - ledger->kinetic - ledger->strain - ledger->fracture;
}

void kr_ledger_begin(struct kr_ledger *ledger, struct kr_boundary *boundary, struct kr_body *body,
                     const struct kr_crack *crack, double dt) {
    kr_ledger_update(ledger, boundary, body, crack, 0, dt, 1);
    ledger->external = ledger->kinetic + ledger->strain + ledger->fracture;
    ledger->most_external = fabs(ledger->external);
    ledger->power = kr_boundary_power(boundary, body, 0, dt, 1);
}

/* ---- history.csv ---- */

struct kr_history {
    FILE *file;
    char *path;
    int dim;
};

static void check_written(struct kr_history *h) {
    if (fflush(h->file) || ferror(h->file))
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s; free some space and run again",
                h->path, strerror(errno));
}

/* Loads on the same set that come before load k: their columns must differ in name. */
static size_t loads_before(const struct kr_boundary *boundary, size_t k) {
    size_t before = 0;
    for (size_t m = 0; m < k; m++)
        before += !strcmp(kr_boundary_set(boundary, m), kr_boundary_set(boundary, k));
    return before;
}

long kr_history_bytes(const struct kr_history *h) {
    return ftell(h->file);
}

struct kr_history *kr_history_open(const char *path, const struct kr_boundary *boundary, int dim,
                                   long bytes) {
    struct kr_history *h = KR_NEW(struct kr_history, 1);
    *h = (struct kr_history){.path = kr_text_copy(path), .dim = dim};
    if (bytes > 0 && truncate(path, bytes))
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be cut back to %ld bytes: %s", path, bytes,
                strerror(errno));
    h->file = fopen(path, bytes > 0 ? "r+" : "w");
    if (!h->file || fseek(h->file, bytes, SEEK_SET))
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s", path, strerror(errno));
    if (bytes > 0)
        return h;
    static const char *const name[] = {"kinetic", "strain", "fracture", "external_work", "balance"};
    fprintf(h->file, "step,time [s]");
    for (size_t k = 0; k < sizeof name / sizeof *name; k++)
        fprintf(h->file, ",%s [%s]", name[k], kr_ledger_unit(dim));
    fprintf(h->file, ",broken_bonds");
    for (size_t k = 0; k < kr_boundary_count(boundary); k++) {
        char again[32] = "";
        size_t before = loads_before(boundary, k);
        if (before)
            snprintf(again, sizeof again, " (%zu)", before + 1);
        for (int d = 0; d < dim; d++)
            fprintf(h->file, ",reaction_%c %s%s [%s]", "xyz"[d], kr_boundary_set(boundary, k), again,
                    dim == 2 ? "N/m" : "N");
    }
    fprintf(h->file, "\n");
    check_written(h);
    return h;
}

void kr_history_write(struct kr_history *h, const struct kr_ledger *ledger,
                      const struct kr_boundary *boundary, const struct kr_crack *crack, long step,
                      double t) {
    fprintf(h->file, "%ld,%.9g,%.12g,%.12g,%.12g,%.12g,%.6g,%zu", step, t, ledger->kinetic,
            ledger->strain, ledger->fracture, ledger->external, ledger->balance, crack->count);
    for (size_t k = 0; k < kr_boundary_count(boundary); k++)
        for (int d = 0; d < h->dim; d++)
            fprintf(h->file, ",%.9g", kr_boundary_reaction(boundary, k, d));
    fprintf(h->file, "\n");
    check_written(h);
}

void kr_history_close(struct kr_history *h) {
    if (fclose(h->file))
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s", h->path, strerror(errno));
    kr_free(h->path);
    kr_free(h);
}
