/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What tracking found, as the tables of docs/formats.md and on the terminal.
 */
#ifndef KR_REPORT_H
#define KR_REPORT_H

#include "fragments.h"
#include "sheet.h"
#include "track.h"
#include "tree.h"

struct kr_report {
    const struct kr_record *record;
    int64_t window; /* steps */
    size_t n_tracks;
    struct kr_track *track; /* (n_tracks) one a box of the deck */
    const struct kr_tree *tree;
    const struct kr_fragments *fragments;
    const struct kr_sheet *sheet; /* of a solid; NULL of a plate */
};

/** Write the files; each appears whole or not at all. Stop (exit 3) where they cannot be written.
 */
void kr_report_boxes(const struct kr_report *report, const char *path);
void kr_report_tips(const struct kr_report *report, const char *path);
void kr_report_branches(const struct kr_report *report, const char *path);
void kr_report_damage(const struct kr_report *report, const char *path);
void kr_report_events(const struct kr_report *report, const char *path);
void kr_report_summary(const struct kr_report *report, const char *path);

/** Print the part about tips and branches. */
void kr_report_say(const struct kr_report *report);

#endif
