/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Progress of long work. See progress.h.
 */
#include "base/progress.h"

#include <stdarg.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

double kr_progress_clock(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

struct kr_progress kr_progress_begin(const char *what, double done, double total) {
    double now = kr_progress_clock();
    return (struct kr_progress){
        .what = what, .first = done, .total = total, .begun = now, .shown = now, .terminal = isatty(1)};
}

void kr_progress_show(struct kr_progress *p, double done, const char *format, ...) {
    double now = kr_progress_clock();
    int tenth = p->total > 0 ? (int)(10 * done / p->total) : 0;
    if (p->terminal ? now - p->shown < 1 : tenth <= p->tenth)
        return;
    p->shown = now;
    p->tenth = tenth;
    double rate = (done - p->first) / (now - p->begun), left = rate > 0 ? (p->total - done) / rate : 0;
    va_list arguments;
    printf("%s  %3.0f %%  %.0f of %.0f %s, ", p->terminal ? "\r\033[K" : "",
           100 * done / p->total, done, p->total, p->what);
    va_start(arguments, format);
    vprintf(format, arguments);
    va_end(arguments);
    printf(", %.0f/s, %.0f s left%s", rate, left, p->terminal ? "" : "\n");
    fflush(stdout);
}

void kr_progress_note(struct kr_progress *p, const char *format, ...) {
    double now = kr_progress_clock();
    int first = p->shown == p->begun;
    if (now - p->shown < (first ? 2 : p->terminal ? 1 : 10))
        return;
    p->shown = now;
    va_list arguments;
    printf("%s  %s, ", p->terminal ? "\r\033[K" : "", p->what);
    va_start(arguments, format);
    vprintf(format, arguments);
    va_end(arguments);
    printf(", %.0f s%s", now - p->begun, p->terminal ? "" : "\n");
    fflush(stdout);
}

void kr_progress_wipe(struct kr_progress *p) {
    if (p->terminal && p->shown != p->begun) {
        printf("\r\033[K");
        fflush(stdout);
    }
}

void kr_progress_end(struct kr_progress *p, double amount, const char *unit) {
    double seconds = kr_progress_clock() - p->begun;
    printf("%s  %.0f %s in %.1f s: %.3g %s a second\n", p->terminal ? "\r\033[K" : "",
           p->total - p->first, p->what, seconds, amount / (seconds > 0 ? seconds : 1e-9), unit);
    fflush(stdout);
}
