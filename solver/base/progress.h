/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Progress of long work: one line rewritten each second on a terminal, a plain line each tenth of
 * the way elsewhere.
 */
#ifndef KR_PROGRESS_H
#define KR_PROGRESS_H

struct kr_progress {
    const char *what;   /* "steps" */
    double first, total, begun, shown; /* amounts of work; seconds */
    int tenth, terminal;
};

/** Seconds of wall time since some fixed moment. */
double kr_progress_clock(void);

/** Begin work that is `done` of `total` already. */
struct kr_progress kr_progress_begin(const char *what, double done, double total);

/** Say how far it is, if it is time to; the format adds what the work itself has to say. */
void kr_progress_show(struct kr_progress *progress, double done, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/** For work whose amount is not known (begun with a total of 0): silent for 2 s, then a line rewritten
 *  each second on a terminal, a plain line each 10 s elsewhere. */
void kr_progress_note(struct kr_progress *progress, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/** Wipe the line of kr_progress_note off the terminal: its work is done. */
void kr_progress_wipe(struct kr_progress *progress);

/** A last line: time, and `amount` of `unit` a second. */
void kr_progress_end(struct kr_progress *progress, double amount, const char *unit);

#endif
