/* SPDX-License-Identifier: BSD-3-Clause
 *
 * kirsch-track: where, how fast and into how many branches the cracks of a run went.
 */
#include <unistd.h>

#include "base/error.h"
#include "base/memory.h"
#include "case.h"
#include "report.h"
#include "sheet.h"

static const char usage[] =
    "kirsch-track case.yaml\n"
    "\n"
    "Reads run.h5 and plate.nodes.h5 in the case's folder and finds the cracks of the run: where\n"
    "and when each began, how fast it ran, where it branched, merged, met a hole or stopped.\n"
    "Writes there\n"
    "\n"
    "  tips.csv, branches.csv, events.csv   the tree of cracks of a plate\n"
    "  damage.csv       whose each damaged node is: of a branch, or of a speck\n"
    "  boxes.csv        tips in the boxes of the deck (track.boxes)\n"
    "  front.csv        of a solid: the front of the crack as a curve per time, with its speed\n"
    "  area.csv         of a solid: the area of the crack over time\n"
    "  fragments.csv    the pieces that hang together, with mass, momentum and extent\n"
    "  summary.csv      all together";

static void stop_on_unknown(const struct kr_case_arguments *arguments) {
    if (arguments->n_left)
        kr_stop(KR_EXIT_INPUT, "unknown argument `%s`; see kirsch-track --help",
                arguments->left[0]);
}

static void explain(const struct kr_case *c) {
    kr_say("would find the cracks of %s/run.h5", c->folder);
    if (c->boxes.count)
        kr_say("would follow the tip in %zu boxes, over a window of %lld steps", c->boxes.count,
               (long long)c->window);
}

/** The nodes' sets tell where holes and boundaries are. */
static void read_rims(const struct kr_case *c, struct kr_record *record) {
    char *path = kr_case_file(c, "plate.nodes.h5");
    if (access(path, R_OK) == 0)
        kr_record_read_rims(record, path);
    else
        kr_warn("%s is missing: cracks that meet a hole or a boundary are not told from those "
                "that stop",
                path);
    kr_free(path);
}

/** Follow the tip in each box of the deck. */
static struct kr_track *follow_boxes(const struct kr_case *c, const struct kr_record *record) {
    const struct kr_case_box *box = c->boxes.item;
    struct kr_track *track = KR_NEW(struct kr_track, c->boxes.count);
    for (size_t k = 0; k < c->boxes.count; k++)
        kr_track_follow(record, box + k, c->window, track + k);
    return track;
}

static void free_tracks(struct kr_report *report) {
    for (size_t k = 0; k < report->n_tracks; k++)
        kr_track_clear(report->track + k);
    kr_free(report->track);
}

static void write_table(const struct kr_case *c, const struct kr_report *report, const char *name,
                        void (*write)(const struct kr_report *, const char *)) {
    char *path = kr_case_file(c, name);
    write(report, path);
    kr_free(path);
}

/** The pre-cracks of the deck. */
static struct kr_precrack **cracks_of(struct kr_deck *deck, const struct kr_case *c) {
    const struct kr_case_crack *from = c->cracks.item;
    struct kr_precrack **crack = KR_NEW(struct kr_precrack *, c->cracks.count);
    for (size_t k = 0; k < c->cracks.count; k++) {
        char *path = from[k].file ? kr_deck_beside(deck, from[k].file) : NULL;
        crack[k] = kr_precrack_create(&from[k], path);
        kr_free(path);
    }
    return crack;
}

/** Find and write the pieces of the body. */
static struct kr_fragments break_up(struct kr_deck *deck, const struct kr_case *c,
                                    const struct kr_record *record, const char *run) {
    struct kr_precrack **crack = cracks_of(deck, c);
    double *velocity = kr_fragments_velocity(run, record->n);
    char *path = kr_case_file(c, "fragments.csv");
    struct kr_fragments fragments;
    if (!velocity)
        kr_warn("%s holds no output with velocities: fragments have no momentum", run);
    kr_fragments_find(record, c, crack, velocity, &fragments);
    kr_fragments_write(&fragments, record->dim, path);
    for (size_t k = 0; k < c->cracks.count; k++)
        kr_precrack_free(crack[k]);
    kr_free(crack);
    kr_free(velocity);
    kr_free(path);
    return fragments;
}

/** What only solids have. */
static struct kr_sheet *lay_sheets(const struct kr_case *c, const struct kr_record *record) {
    char *front = kr_case_file(c, "front.csv"), *area = kr_case_file(c, "area.csv");
    struct kr_sheet *sheet = kr_sheet_create(record);
    if (c->boxes.count)
        kr_warn("track.boxes are for plates: the front of a solid is found without");
    kr_sheet_write_front(sheet, front);
    kr_sheet_write_area(sheet, area);
    kr_free(front);
    kr_free(area);
    return sheet;
}

static void track_run(struct kr_deck *deck, const struct kr_case *c) {
    char *run = kr_case_file(c, "run.h5");
    struct kr_record *record = kr_record_read(run);
    struct kr_fragments fragments;
    struct kr_tree *tree;
    struct kr_sheet *sheet;
    struct kr_report report;
    if (!record->finished)
        kr_warn("%s is not finished: this is the crack after %lld steps", run,
                (long long)record->steps);
    read_rims(c, record);
    fragments = break_up(deck, c, record, run);
    tree = kr_tree_grow(record);
    sheet = record->dim == 3 ? lay_sheets(c, record) : NULL;
    report = (struct kr_report){record, c->window, sheet ? 0 : c->boxes.count,
                                sheet ? NULL : follow_boxes(c, record), tree, &fragments, sheet};
    write_table(c, &report, "tips.csv", kr_report_tips);
    write_table(c, &report, "branches.csv", kr_report_branches);
    write_table(c, &report, "events.csv", kr_report_events);
    if (tree->countable)
        write_table(c, &report, "damage.csv", kr_report_damage);
    if (report.n_tracks)
        write_table(c, &report, "boxes.csv", kr_report_boxes);
    write_table(c, &report, "summary.csv", kr_report_summary);
    kr_report_say(&report);
    kr_free(run);
    free_tracks(&report);
    kr_sheet_free(sheet);
    kr_tree_free(tree);
    kr_fragments_clear(&fragments);
    kr_record_free(record);
}

int main(int argc, char **argv) {
    struct kr_case_arguments arguments;
    struct kr_deck *deck;
    struct kr_case c;
    kr_case_arguments(argc, argv, usage, &arguments);
    stop_on_unknown(&arguments);
    deck = kr_case_open(&arguments, &c);
    if (arguments.explain)
        explain(&c);
    else
        track_run(deck, &c);
    kr_deck_close(deck);
    kr_free(arguments.set);
    kr_free(arguments.left);
    return KR_EXIT_OK;
}
