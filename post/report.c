/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Write and print what tracking found. A value that does not exist (the speed of a crack that never
 * grew) leaves its line out of the summary, and its field in tips.csv empty.
 */
#include "report.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "base/memory.h"

/* ---- files ------------------------------------------------------------------------------- */

/** A text file that grows beside its place. */
struct output {
    FILE *file;
    const char *path;
    char *beside;
};

static struct output begin(const char *path) {
    struct output output = {NULL, path, kr_text("%s.tmp", path)};
    output.file = fopen(output.beside, "w");
    if (!output.file)
        kr_stop(KR_EXIT_STORAGE, "cannot create %s: %s", output.beside, strerror(errno));
    return output;
}

static void finish(struct output *output) {
    int failed = fflush(output->file) != 0 || ferror(output->file) || fsync(fileno(output->file));
    failed |= fclose(output->file) != 0;
    if (failed || rename(output->beside, output->path) != 0) {
        int reason = errno;
        unlink(output->beside);
        kr_stop(KR_EXIT_STORAGE, "cannot write %s: %s", output->path, strerror(reason));
    }
    kr_free(output->beside);
}

static void put_tip(FILE *file, const struct kr_record *record, const struct kr_tip *tip,
                    size_t box) {
    const double *x = record->position + 2 * tip->node;
    fprintf(file, "%.9g,%zu,%.9g,%.9g,", (double)tip->step * record->time_step, box + 1, x[0],
            x[1]);
    if (isnan(tip->speed))
        fprintf(file, ",\n");
    else
        fprintf(file, "%.6g,%.6g\n", tip->speed, tip->speed / record->rayleigh_speed);
}

void kr_report_tips(const struct kr_report *report, const char *path) {
    struct output output = begin(path);
    fprintf(output.file, "time [s],box,x [m],y [m],speed [m/s],speed_over_rayleigh\n");
    for (size_t box = 0; box < report->n_tracks; box++)
        for (size_t k = 0; k < report->track[box].count; k++)
            put_tip(output.file, report->record, report->track[box].tip + k, box);
    finish(&output);
}

/* ---- summary ----------------------------------------------------------------------------- */

static void put(FILE *file, const char *name, double value, const char *unit) {
    if (isfinite(value))
        fprintf(file, "%s,%.9g,%s\n", name, value, unit);
}

/** Results of one box; with more than one box their names end in its number. */
static void put_track(FILE *file, const struct kr_report *report, size_t box) {
    const struct kr_record *record = report->record;
    const struct kr_track *track = report->track + box;
    const double *x;
    char suffix[32] = "";
    char name[96];
    if (!track->count)
        return;
    x = record->position + 2 * track->tip[track->count - 1].node;
    if (report->n_tracks > 1)
        snprintf(suffix, sizeof suffix, "_box_%zu", box + 1);
#define ROW(label, value, unit)                                                                    \
    (snprintf(name, sizeof name, label "%s", suffix), put(file, name, value, unit))
    ROW("tip_x", x[0], "m");
    ROW("tip_y", x[1], "m");
    ROW("arrival", (double)track->arrival * record->time_step, "s");
    ROW("mean_speed", track->mean_speed, "m/s");
    ROW("mean_speed_over_rayleigh", track->mean_speed / record->rayleigh_speed, "1");
    ROW("top_speed", track->top_speed, "m/s");
    ROW("top_speed_over_rayleigh", track->top_speed / record->rayleigh_speed, "1");
#undef ROW
}

/** Energies at the last output; the balance as a share of the work, 0 before there is any. */
static void put_energies(FILE *file, const struct kr_record *record) {
    double work = record->external_work;
    double rest = work - record->kinetic_energy - record->strain_energy - record->fracture_work;
    put(file, "external_work", work, "J/m");
    put(file, "kinetic_energy", record->kinetic_energy, "J/m");
    put(file, "strain_energy", record->strain_energy, "J/m");
    put(file, "fracture_work", record->fracture_work, "J/m");
    put(file, "energy_balance", work != 0 ? rest / fabs(work) : 0, "1");
}

void kr_report_summary(const struct kr_report *report, const char *path) {
    const struct kr_record *record = report->record;
    struct output output = begin(path);
    FILE *file = output.file;
    fprintf(file, "name,value,unit\n");
    put(file, "nodes", (double)record->n, "1");
    put(file, "bonds", (double)record->bonds, "1");
    put(file, "steps", (double)record->steps, "1");
    put(file, "time_step", record->time_step, "s");
    put(file, "end_time", (double)record->steps * record->time_step, "s");
    put(file, "finished", record->finished, "1");
    put(file, "rayleigh_speed", record->rayleigh_speed, "m/s");
    put(file, "broken_bonds", (double)record->broken, "1");
    put(file, "damaged_nodes", (double)report->branches.damaged, "1");
    put(file, "first_growth", record->first_break, "s");
    put_energies(file, record);
    for (size_t box = 0; box < report->n_tracks; box++)
        put_track(file, report, box);
    if (report->branches.countable) {
        put(file, "cracks", (double)report->branches.cracks, "1");
        put(file, "branches", (double)report->branches.branches, "1");
    }
    finish(&output);
}

/* ---- terminal ---------------------------------------------------------------------------- */

/** A tip that stands on nodes moves by whole spacings: what one of them makes in a window. */
static double resolution(const struct kr_report *report) {
    const struct kr_record *record = report->record;
    return record->spacing / ((double)report->window * record->time_step);
}

static void say_track(const struct kr_report *report, size_t box) {
    const struct kr_record *record = report->record;
    const struct kr_track *track = report->track + box;
    const double rayleigh = record->rayleigh_speed;
    if (report->n_tracks > 1)
        kr_say("box %zu", box + 1);
    if (!track->count) {
        kr_say("  tip            none: no damage past the threshold");
        return;
    }
    const double *x = record->position + 2 * track->tip[track->count - 1].node;
    kr_say("  tip            x %.3f mm, y %.3f mm, since %.2f us", x[0] * 1e3, x[1] * 1e3,
           (double)track->arrival * record->time_step * 1e6);
    if (isnan(track->mean_speed))
        kr_say("  tip speed      none: the tip did not move");
    else
        kr_say("  mean speed     %.0f m/s, %.2f of Rayleigh's %.0f m/s", track->mean_speed,
               track->mean_speed / rayleigh, rayleigh);
    if (!isnan(track->mean_speed) && !isnan(track->top_speed))
        kr_say("  top speed      %.0f m/s, %.2f of it; resolved to %.0f m/s", track->top_speed,
               track->top_speed / rayleigh, resolution(report));
}

void kr_report_say(const struct kr_report *report) {
    const struct kr_record *record = report->record;
    const struct kr_branches *branches = &report->branches;
    if (isinf(record->first_break))
        kr_say("  first growth   none: no bond broke");
    else
        kr_say("  first growth   %.2f us", record->first_break * 1e6);
    for (size_t box = 0; box < report->n_tracks; box++)
        say_track(report, box);
    if (branches->countable)
        kr_say("  branches       %zu, of %zu crack%s", branches->branches, branches->cracks,
               branches->cracks == 1 ? "" : "s");
    else
        kr_say("  branches       not to be counted: %.0f %% of all nodes are damaged",
               100.0 * (double)branches->damaged / (double)record->n);
}
