/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Children at work on regions. See crew.h.
 */
#include "crew.h"

#include "base/child.h"
#include "base/error.h"
#include "base/memory.h"

#include <string.h>
#include <unistd.h>

enum { LONGEST = 300 };

/** A child at work on a region by a method. */
struct attempt {
    size_t region, method;
    struct kr_child child;
};

/** Everything that is going on. */
struct work {
    const struct kr_crew *crew;
    struct kr_crew_job *job;
    unsigned seconds;
    size_t running;
    struct attempt *attempt; /* one a child */
};

static void start(struct work *work, size_t region, size_t method) {
    struct attempt *attempt = &work->attempt[work->running++];
    *attempt = (struct attempt){.region = region, .method = method};
    kr_child_prepare(&attempt->child);
    work->crew->ask(work->crew->regions, region, method, attempt->child.in);
    kr_child_start(&attempt->child, work->crew->program, work->seconds);
}

/** The first line by which the child says that something is wrong, owned by the caller; NULL: none. */
static char *said(const struct kr_crew *crew, struct kr_child *child) {
    char *line = kr_child_line(child, "Error");
    if (!line)
        line = kr_child_line(child, "Warning");
    if (line && crew->harmless && strstr(line, crew->harmless))
        line = kr_free(line);
    return line;
}

/** What is wrong with an attempt that ended, owned by the caller; NULL: nothing, and its reply is taken. */
static char *judge(struct work *work, struct attempt *attempt, int status) {
    char *trouble = kr_child_trouble(status, work->seconds), *line = said(work->crew, &attempt->child);
    if (!trouble && !line)
        return work->crew->take(work->crew->regions, attempt->region, attempt->child.out);
    char *both = kr_text("%s%s%s%s", trouble ? trouble : "", trouble && line ? "; " : "",
                         line ? "it said: " : "", line ? line : "");
    kr_free(trouble);
    kr_free(line);
    return both;
}

/** Start the method that follows a failed one. */
static void go_on(struct work *work, const struct attempt *failed, const char *trouble) {
    const struct kr_crew *crew = work->crew;
    const char *name = work->job[failed->region].name, *words = crew->method_words(failed->method);
    size_t next = (failed->method + 1) % crew->n_methods;
    if (next == crew->first)
        kr_stop(KR_EXIT_LIBRARY,
                "gmsh cannot fill the region %s by any of %zu methods; the last, %s, failed: %s. "
                "Another spacing or padding may help, or the voronoi grid",
                name, crew->n_methods, words, trouble);
    kr_warn("region %s: gmsh's %s failed: %s; trying %s", name, words, trouble, crew->method_words(next));
    start(work, failed->region, next);
}

/** Wait for one child; take its reply, or start the region's next method. */
static void finish_one(struct work *work) {
    int status;
    pid_t pid = kr_child_wait(&status);
    size_t k = 0;
    while (k < work->running && work->attempt[k].child.pid != pid)
        k++;
    if (k == work->running)
        return; /* a child of somebody else */
    struct attempt done = work->attempt[k];
    work->attempt[k] = work->attempt[--work->running];

    struct kr_crew_job *job = &work->job[done.region];
    char *trouble = judge(work, &done, status);
    job->seconds += kr_child_clock() - done.child.started;
    kr_child_close(&done.child);
    if (trouble)
        go_on(work, &done, trouble);
    else
        job->method = done.method;
    kr_free(trouble);
}

void kr_crew_work(const struct kr_crew *crew, size_t n_jobs, struct kr_crew_job *job, const size_t *order) {
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    size_t children = crew->children > 0 ? (size_t)crew->children : processors > 0 ? (size_t)processors : 1;
    struct work work = {crew, job, crew->seconds ? crew->seconds : LONGEST, 0, KR_NEW(struct attempt, children)};
    size_t started = 0;
    while (started < n_jobs || work.running) {
        if (started < n_jobs && work.running < children) {
            start(&work, order ? order[started] : started, crew->first);
            started++;
        } else {
            finish_one(&work);
        }
    }
    kr_free(work.attempt);
}
