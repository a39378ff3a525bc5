/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What tracking found, on the terminal.
 */
#include <math.h>

#include "base/error.h"
#include "report.h"
#include "total.h"

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
    const struct kr_total total = kr_total_of(tree);
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
               total.top_speed, total.top_error, total.top_speed / rayleigh,
               2e3 * kr_path_window(report->record));
}

/** Share of the mass that the heaviest fragment has, in percent. */
static double heaviest(const struct kr_fragments *fragments) {
    double mass = 0;
    for (size_t f = 0; f < fragments->count; f++)
        mass += fragments->item[f].mass;
    return 100 * fragments->item[0].mass / mass;
}

static void say_sheet(const struct kr_report *report) {
    const double rayleigh = report->record->rayleigh_speed;
    double speed = kr_sheet_mean_speed(report->sheet);
    if (!report->tree->damaged)
        kr_say("  cracks         none: no damage past the threshold");
    else
        kr_say("  crack area     %.4g mm^2; over time in area.csv",
               1e6 * kr_sheet_area(report->sheet, INFINITY));
    if (isfinite(speed))
        kr_say("  crack front    %.0f m/s in the mean, %.2f of Rayleigh's %.0f m/s; curves and speeds in "
               "front.csv", speed, speed / rayleigh, rayleigh);
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
    else if (report->sheet)
        say_sheet(report);
    else
        kr_say("  branches       not to be counted: %.0f %% of all nodes are damaged",
               100.0 * (double)tree->damaged / (double)record->n);
}
