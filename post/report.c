/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Write and print what tracking found. A value that does not exist (the speed of a crack that never
 * grew) leaves its line out of the summary, and its field in tips.csv empty.
 */
#include "report.h"

#include <math.h>
#include <stdio.h>

#include "base/error.h"
#include "table.h"

static const double PI = 3.14159265358979323846;

/* ---- tables ------------------------------------------------------------------------------ */

static void put_box_tip(FILE *file, const struct kr_record *record, const struct kr_tip *tip,
                        size_t box) {
    const double *x = record->position + 2 * tip->node;
    fprintf(file, "%.9g,%zu,%.9g,%.9g,", (double)tip->step * record->time_step, box + 1, x[0],
            x[1]);
    if (isnan(tip->speed))
        fprintf(file, ",\n");
    else
        fprintf(file, "%.6g,%.6g\n", tip->speed, tip->speed / record->rayleigh_speed);
}

void kr_report_boxes(const struct kr_report *report, const char *path) {
    struct kr_table table =
        kr_table_begin(path, "time [s],box,x [m],y [m],speed [m/s],speed_over_rayleigh");
    for (size_t box = 0; box < report->n_tracks; box++)
        for (size_t k = 0; k < report->track[box].count; k++)
            put_box_tip(table.file, report->record, report->track[box].tip + k, box);
    kr_table_finish(&table);
}

static void put_tip(struct kr_table *table, double rayleigh, size_t branch, double distance,
                    const struct kr_move *move) {
    fprintf(table->file, "%.9g,%zu,%.9g,%.9g,%.9g", move->time, branch, move->x[0], move->x[1],
            distance);
    kr_table_put(table, move->speed);
    kr_table_put(table, move->error);
    kr_table_put(table, move->speed / rayleigh);
    kr_table_put(table, move->angle * 180 / PI);
    kr_table_put(table, move->front_energy);
    fprintf(table->file, "\n");
}

void kr_report_tips(const struct kr_report *report, const char *path) {
    const struct kr_tree *tree = report->tree;
    struct kr_table table = kr_table_begin(
        path, "time [s],branch,x [m],y [m],distance [m],speed [m/s],speed_error [m/s],"
              "speed_over_rayleigh,angle [deg],front_energy [J/m^2]");
    for (size_t b = 0; b < tree->count; b++) {
        double before = 0;
        for (size_t k = 0; k < tree->branch[b].n_legs; k++) {
            const struct kr_leg *leg = tree->legs.item + tree->branch[b].leg[k];
            for (size_t m = 0; m < leg->path.count; m++)
                put_tip(&table, report->record->rayleigh_speed, b + 1,
                        before + leg->path.move[m].s - leg->begin_s, leg->path.move + m);
            before += leg->end_s - leg->begin_s;
        }
    }
    kr_table_finish(&table);
}

void kr_report_branches(const struct kr_report *report, const char *path) {
    const struct kr_tree *tree = report->tree;
    struct kr_table table = kr_table_begin(
        path, "branch,parent,start,end,start_time [s],end_time [s],start_x [m],start_y [m],"
              "end_x [m],end_y [m],length [m],mean_speed [m/s],top_speed [m/s],trapped [s],"
              "energy [J/m],pores,top_speed_error [m/s]");
    for (size_t b = 0; b < tree->count; b++) {
        const struct kr_branch *branch = tree->branch + b;
        const double value[] = {branch->first_time, branch->last_time, branch->from[0],
                                branch->from[1],    branch->to[0],     branch->to[1],
                                branch->length,     branch->mean_speed, branch->top_speed,
                                branch->trapped,    branch->energy};
        fprintf(table.file, "%zu,%zu,%s,%s", b + 1, branch->parent, kr_tree_start(branch->start),
                kr_tree_end(branch->end));
        for (size_t k = 0; k < sizeof value / sizeof value[0]; k++)
            kr_table_put(&table, value[k]);
        fprintf(table.file, ",");
        for (size_t k = 0; k < branch->n_holes; k++)
            fprintf(table.file, "%s%d", k ? ";" : "", branch->hole[k]);
        kr_table_put(&table, branch->top_error);
        fprintf(table.file, "\n");
    }
    kr_table_finish(&table);
}

/** A comma, and the number unless it is 0. */
static void put_number(FILE *file, size_t number) {
    fprintf(file, ",");
    if (number)
        fprintf(file, "%zu", number);
}

void kr_report_events(const struct kr_report *report, const char *path) {
    const struct kr_tree *tree = report->tree;
    struct kr_table table = kr_table_begin(path, "time [s],kind,branch,x [m],y [m],hole,other");
    for (size_t k = 0; k < tree->n_events; k++) {
        const struct kr_event *event = tree->event + k;
        fprintf(table.file, "%.9g,%s", event->time, kr_tree_event(event->kind));
        put_number(table.file, event->branch);
        kr_table_put(&table, event->x[0]);
        kr_table_put(&table, event->x[1]);
        put_number(table.file, (size_t)event->hole);
        put_number(table.file, event->other);
        fprintf(table.file, "\n");
    }
    kr_table_finish(&table);
}

/* ---- summary ----------------------------------------------------------------------------- */

/** All branches together. */
struct total {
    double length, energy;        /* m, J/m */
    double mean_speed, top_speed, top_error; /* m/s: mean over the time of running of all tips */
    double first_branching;       /* s; infinite: none */
    double arrival;               /* s: of the last tip */
};

static struct total total_of(const struct kr_tree *tree) {
    struct total total = {0, 0, NAN, NAN, NAN, INFINITY, tree->count ? 0 : NAN};
    double time = 0;
    for (size_t b = 0; b < tree->count; b++) {
        const struct kr_branch *branch = tree->branch + b;
        total.length += branch->length;
        total.energy += branch->energy;
        time += branch->last_time - branch->first_time - branch->trapped;
        if (isnan(total.top_speed) || branch->top_speed > total.top_speed) {
            total.top_speed = branch->top_speed;
            total.top_error = branch->top_error;
        }
        total.arrival = fmax(total.arrival, branch->last_time);
        if (branch->start == KR_START_FORK)
            total.first_branching = fmin(total.first_branching, branch->first_time);
    }
    if (time > 0)
        total.mean_speed = total.length / time;
    return total;
}

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
    put(file, "external_work", work, "J/m");
    put(file, "kinetic_energy", record->kinetic_energy, "J/m");
    put(file, "strain_energy", record->strain_energy, "J/m");
    put(file, "fracture_work", record->fracture_work, "J/m");
    put(file, "energy_balance", work != 0 ? rest / fabs(work) : 0, "1");
}

static void put_tree(FILE *file, const struct kr_report *report) {
    const struct kr_tree *tree = report->tree;
    const double rayleigh = report->record->rayleigh_speed;
    const struct total total = total_of(tree);
    put(file, "cracks", (double)kr_tree_cracks(tree), "1");
    put(file, "branches", (double)kr_tree_tips(tree), "1");
    put(file, "specks", (double)tree->specks, "1");
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

void kr_report_summary(const struct kr_report *report, const char *path) {
    const struct kr_record *record = report->record;
    struct kr_table table = kr_table_begin(path, "name,value,unit");
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
    kr_table_finish(&table);
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
    kr_say("  box %zu", box + 1);
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

static void say_tree(const struct kr_report *report) {
    const struct kr_tree *tree = report->tree;
    const struct total total = total_of(tree);
    const double rayleigh = report->record->rayleigh_speed;
    size_t tips = kr_tree_tips(tree), cracks = kr_tree_cracks(tree);
    if (!tree->damaged)
        kr_say("  cracks         none: no damage past the threshold");
    else if (!tree->count)
        kr_say("  cracks         none grew by three horizons");
    if (!tree->count)
        return;
    kr_say("  branches       %zu, of %zu crack%s; %.2f mm in all", tips, cracks,
           cracks == 1 ? "" : "s", 1e3 * total.length);
    if (isfinite(total.first_branching))
        kr_say("  first fork     %.2f us", 1e6 * total.first_branching);
    if (isfinite(total.mean_speed))
        kr_say("  mean speed     %.0f m/s, %.2f of Rayleigh's %.0f m/s", total.mean_speed,
               total.mean_speed / rayleigh, rayleigh);
    if (isfinite(total.top_speed))
        kr_say("  top speed      %.0f +- %.0f m/s, %.2f of it, over %.2f mm of path",
               total.top_speed, total.top_error, total.top_speed / rayleigh, 2e3 * kr_path_window(report->record));
}

/** Share of the mass that the heaviest fragment has, in percent. */
static double heaviest(const struct kr_fragments *fragments) {
    double mass = 0;
    for (size_t f = 0; f < fragments->count; f++)
        mass += fragments->item[f].mass;
    return 100 * fragments->item[0].mass / mass;
}

void kr_report_say(const struct kr_report *report) {
    const struct kr_record *record = report->record;
    const struct kr_tree *tree = report->tree;
    if (isinf(record->first_break))
        kr_say("  first growth   none: no bond broke");
    else
        kr_say("  first growth   %.2f us", record->first_break * 1e6);
    if (report->fragments->count > 1)
        kr_say("  fragments      %zu; the heaviest has %.1f %% of the mass",
               report->fragments->count, heaviest(report->fragments));
    for (size_t box = 0; box < report->n_tracks; box++)
        say_track(report, box);
    if (tree->countable)
        say_tree(report);
    else if (record->dim == 3)
        kr_say("  crack front    through the thickness: front.csv; its area over time: area.csv");
    else
        kr_say("  branches       not to be counted: %.0f %% of all nodes are damaged",
               100.0 * (double)tree->damaged / (double)record->n);
}
