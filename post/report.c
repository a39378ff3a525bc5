/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The tables of what tracking found. A value that does not exist (the speed of a tip that jumps)
 * leaves its field empty.
 */
#include "report.h"

#include <math.h>
#include <stdio.h>

#include "csv_write.h"

static const double PI = 3.14159265358979323846;

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
    struct kr_csv_writer table =
        kr_csv_begin(path, "time [s],box,x [m],y [m],speed [m/s],speed_over_rayleigh");
    for (size_t box = 0; box < report->n_tracks; box++)
        for (size_t k = 0; k < report->track[box].count; k++)
            put_box_tip(table.file, report->record, report->track[box].tip + k, box);
    kr_csv_finish(&table);
}

static void put_tip(struct kr_csv_writer *table, double rayleigh, size_t branch, double distance,
                    const struct kr_move *move) {
    fprintf(table->file, "%.9g,%zu,%.9g,%.9g,%.9g", move->time, branch, move->x[0], move->x[1],
            distance);
    kr_csv_put(table, move->speed);
    kr_csv_put(table, move->error);
    kr_csv_put(table, move->speed / rayleigh);
    kr_csv_put(table, move->angle * 180 / PI);
    kr_csv_put(table, move->front_energy);
    fprintf(table->file, "\n");
}

void kr_report_tips(const struct kr_report *report, const char *path) {
    const struct kr_tree *tree = report->tree;
    struct kr_csv_writer table = kr_csv_begin(
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
    kr_csv_finish(&table);
}

void kr_report_branches(const struct kr_report *report, const char *path) {
    const struct kr_tree *tree = report->tree;
    struct kr_csv_writer table = kr_csv_begin(
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
            kr_csv_put(&table, value[k]);
        fprintf(table.file, ",");
        for (size_t k = 0; k < branch->n_holes; k++)
            fprintf(table.file, "%s%d", k ? ";" : "", branch->hole[k]);
        kr_csv_put(&table, branch->top_error);
        fprintf(table.file, "\n");
    }
    kr_csv_finish(&table);
}

/** A comma, and the number unless it is 0. */
static void put_number(FILE *file, size_t number) {
    fprintf(file, ",");
    if (number)
        fprintf(file, "%zu", number);
}

void kr_report_events(const struct kr_report *report, const char *path) {
    const struct kr_tree *tree = report->tree;
    struct kr_csv_writer table = kr_csv_begin(path, "time [s],kind,branch,x [m],y [m],hole,other");
    for (size_t k = 0; k < tree->n_events; k++) {
        const struct kr_event *event = tree->event + k;
        fprintf(table.file, "%.9g,%s", event->time, kr_tree_event(event->kind));
        put_number(table.file, event->branch);
        kr_csv_put(&table, event->x[0]);
        kr_csv_put(&table, event->x[1]);
        put_number(table.file, (size_t)event->hole);
        put_number(table.file, event->other);
        fprintf(table.file, "\n");
    }
    kr_csv_finish(&table);
}

void kr_report_damage(const struct kr_report *report, const char *path) {
    const struct kr_tree *tree = report->tree;
    const struct kr_front *front = tree->front;
    struct kr_csv_writer table = kr_csv_begin(path, "node,time [s],x [m],y [m],branch,speck");
    for (size_t i = 0; front && i < front->n; i++) {
        fprintf(table.file, "%zu", front->node[i]);
        kr_csv_put(&table, front->time[i]);
        kr_csv_put(&table, front->x[3 * i]);
        kr_csv_put(&table, front->x[3 * i + 1]);
        put_number(table.file, tree->owners.branch[i]);
        put_number(table.file, tree->owners.speck[i]);
        fprintf(table.file, "\n");
    }
    kr_csv_finish(&table);
}
