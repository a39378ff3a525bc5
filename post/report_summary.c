/* SPDX-License-Identifier: BSD-3-Clause
 *
 * summary.csv. A value that does not exist (the speed of a crack that never grew) leaves its line
 * out.
 */
#include <math.h>
#include <stdio.h>

#include "report.h"
#include "csv_write.h"
#include "total.h"

static void put(FILE *file, const char *name, double value, const char *unit) {
    if (isfinite(value))
        fprintf(file, "%s,%.9g,%s\n", name, value, unit);
}

/** Results of one box; their names end in its number. */
static void put_track(FILE *file, const struct kr_report *report, size_t box) {
    const struct kr_record *record = report->record;
    const struct kr_track *track = report->track + box;
    const double *x;
    char suffix[32];
    char name[96];
    if (!track->count)
        return;
    x = record->position + 2 * track->tip[track->count - 1].node;
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
    const char *unit = record->dim == 3 ? "J" : "J/m";
    put(file, "external_work", work, unit);
    put(file, "kinetic_energy", record->kinetic_energy, unit);
    put(file, "strain_energy", record->strain_energy, unit);
    put(file, "fracture_work", record->fracture_work, unit);
    put(file, "energy_balance", work != 0 ? rest / fabs(work) : 0, "1");
}

static void put_tree(FILE *file, const struct kr_report *report) {
    const struct kr_tree *tree = report->tree;
    const double rayleigh = report->record->rayleigh_speed;
    const struct kr_total total = kr_total_of(tree);
    put(file, "cracks", (double)kr_tree_cracks(tree), "1");
    put(file, "branches", (double)kr_tree_tips(tree), "1");
    put(file, "specks", (double)tree->owners.n_specks, "1");
    put(file, "first_branching", total.first_branching, "s");
    put(file, "arrival", total.arrival, "s");
    put(file, "crack_length", total.length, "m");
    put(file, "mean_speed", total.mean_speed, "m/s");
    put(file, "mean_speed_over_rayleigh", total.mean_speed / rayleigh, "1");
    put(file, "top_speed", total.top_speed, "m/s");
    put(file, "top_speed_over_rayleigh", total.top_speed / rayleigh, "1");
    put(file, "top_speed_error", total.top_error, "m/s");
    put(file, "speed_window", 2 * kr_path_window(report->record), "m");
    put(file, "crack_energy", total.energy, "J/m");
    put(file, "scattered_energy", tree->legs.scattered, "J/m");
}

static void put_sheet(FILE *file, const struct kr_report *report) {
    double speed = kr_sheet_mean_speed(report->sheet);
    put(file, "crack_area", kr_sheet_area(report->sheet, INFINITY), "m^2");
    put(file, "mean_front_speed", speed, "m/s");
    put(file, "mean_front_speed_over_rayleigh", speed / report->record->rayleigh_speed, "1");
}

void kr_report_summary(const struct kr_report *report, const char *path) {
    const struct kr_record *record = report->record;
    struct kr_csv_writer table = kr_csv_begin(path, "name,value,unit");
    FILE *file = table.file;
    put(file, "nodes", (double)record->n, "1");
    put(file, "bonds", (double)record->bonds, "1");
    put(file, "steps", (double)record->steps, "1");
    put(file, "time_step", record->time_step, "s");
    put(file, "end_time", (double)record->steps * record->time_step, "s");
    put(file, "finished", record->finished, "1");
    put(file, "rayleigh_speed", record->rayleigh_speed, "m/s");
    put(file, "broken_bonds", (double)record->broken, "1");
    put(file, "fragments", (double)report->fragments->count, "1");
    put(file, "damaged_nodes", (double)report->tree->damaged, "1");
    put(file, "first_growth", record->first_break, "s");
    put_energies(file, record);
    for (size_t box = 0; box < report->n_tracks; box++)
        put_track(file, report, box);
    if (report->tree->countable)
        put_tree(file, report);
    if (report->sheet)
        put_sheet(file, report);
    kr_csv_finish(&table);
}
