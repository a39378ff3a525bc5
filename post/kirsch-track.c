/* SPDX-License-Identifier: BSD-3-Clause
 *
 * kirsch-track: where, how fast and into how many branches the cracks of a run went.
 */
#include "base/error.h"
#include "base/memory.h"
#include "case.h"
#include "report.h"

static const char usage[] =
    "kirsch-track case.yaml\n"
    "\n"
    "Reads run.h5 in the case's folder; follows the crack tip in each box of the deck "
    "(`track.boxes`;\n"
    "without any, in the whole plate along +x) and counts the branches. Writes tips.csv and\n"
    "summary.csv there.";

static void stop_on_unknown(const struct kr_case_arguments *arguments) {
    if (arguments->n_left)
        kr_stop(KR_EXIT_INPUT, "unknown argument `%s`; see kirsch-track --help",
                arguments->left[0]);
}

static void explain(const struct kr_case *c) {
    kr_say("would follow the tip in %s, over a window of %lld steps",
           c->boxes.count ? "the deck's boxes" : "the whole plate along +x", (long long)c->window);
}

/** Follow the tip in each box, or in the whole plate where the deck gives none. */
static void follow_all(const struct kr_case *c, const struct kr_record *record,
                       struct kr_report *report) {
    const struct kr_case_box whole = kr_track_whole(record), *box = c->boxes.item;
    size_t count = c->boxes.count ? c->boxes.count : 1;
    struct kr_track *track = KR_NEW(struct kr_track, count);
    for (size_t k = 0; k < count; k++)
        kr_track_follow(record, c->boxes.count ? box + k : &whole, c->window, track + k);
    *report = (struct kr_report){record, c->window, count, track, kr_branches_count(record)};
}

static void free_tracks(struct kr_report *report) {
    for (size_t k = 0; k < report->n_tracks; k++)
        kr_track_clear(report->track + k);
    kr_free(report->track);
}

static void track_run(const struct kr_case *c) {
    char *run = kr_case_file(c, "run.h5"), *tips = kr_case_file(c, "tips.csv");
    char *summary = kr_case_file(c, "summary.csv");
    struct kr_record *record = kr_record_read(run);
    struct kr_report report;
    if (!record->finished)
        kr_warn("%s is not finished: this is the crack after %lld steps", run,
                (long long)record->steps);
    follow_all(c, record, &report);
    kr_report_tips(&report, tips);
    kr_report_summary(&report, summary);
    kr_report_say(&report);
    kr_free(run);
    kr_free(tips);
    kr_free(summary);
    free_tracks(&report);
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
        track_run(&c);
    kr_deck_close(deck);
    kr_free(arguments.set);
    kr_free(arguments.left);
    return KR_EXIT_OK;
}
