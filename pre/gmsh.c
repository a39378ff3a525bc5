/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The children that fill the regions: several at once, the largest region first, each region by
 * one method after the other until its mesh passes every check.
 */
#include "gmsh.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/child.h"
#include "fill.h"

#include <unistd.h>

enum { LONGEST = 300 };

/** A child at work on a region by a method. */
struct attempt {
    size_t region, method;
    struct kr_child child;
};

/** Everything that is going on. */
struct work {
    struct kr_gmsh_region *region;
    const char *helper;
    unsigned seconds;
    size_t running, first;   /* first: the method that each region begins with */
    struct attempt *attempt; /* one a child */
};

static void start(struct work *work, size_t r, size_t method) {
    struct attempt *attempt = &work->attempt[work->running++];
    *attempt = (struct attempt){.region = r, .method = method};
    kr_child_prepare(&attempt->child);
    kr_fill_ask(&work->region[r], &kr_fill_methods[method], attempt->child.in);
    kr_child_start(&attempt->child, work->helper, work->seconds);
}

/** What is wrong with an attempt that ended, owned by the caller; NULL if nothing. */
static char *judge(struct work *work, struct attempt *attempt, int status) {
    struct kr_child *child = &attempt->child;
    char *trouble = kr_child_trouble(status, work->seconds);
    char *line = kr_child_line(child, "Error");
    if (!line)
        line = kr_child_line(child, "Warning");
    if (trouble || line) {
        char *both = kr_text("%s%s%s%s", trouble ? trouble : "", trouble && line ? "; " : "",
                             line ? "it said: " : "", line ? line : "");
        kr_free(trouble);
        kr_free(line);
        return both;
    }
    return kr_fill_read(&work->region[attempt->region], child->out);
}

/** Wait for one child; take its mesh, or start the region's next method. */
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

    struct kr_gmsh_region *region = &work->region[done.region];
    char *trouble = judge(work, &done, status);
    region->seconds += kr_child_clock() - done.child.started;
    kr_child_close(&done.child);
    if (!trouble) {
        region->method = kr_fill_methods[done.method].words;
        return;
    }
    size_t next = (done.method + 1) % kr_fill_n_methods;
    if (next == work->first)
        kr_stop(KR_EXIT_LIBRARY,
                "gmsh cannot fill the region %s by any of %zu methods; the last, %s, failed: %s. "
                "Another spacing or padding may help, or the voronoi grid",
                region->name, kr_fill_n_methods, kr_fill_methods[done.method].words, trouble);
    kr_warn("region %s: gmsh's %s failed: %s; trying %s", region->name,
            kr_fill_methods[done.method].words, trouble, kr_fill_methods[next].words);
    kr_free(trouble);
    start(work, done.region, next);
}

/** The regions by falling area, equal ones in order: the longest work begins first. */
static size_t *by_area(size_t n, const struct kr_gmsh_region *region) {
    size_t *order = KR_NEW(size_t, n);
    for (size_t r = 0; r < n; r++) {
        size_t k = r;
        double area = kr_gmsh_twice_area(&region[r]);
        for (; k > 0 && kr_gmsh_twice_area(&region[order[k - 1]]) < area; k--)
            order[k] = order[k - 1];
        order[k] = r;
    }
    return order;
}

void kr_gmsh_fill(size_t n_regions, struct kr_gmsh_region *region,
                  const struct kr_gmsh_options *options) {
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    size_t children = options->children > 0 ? (size_t)options->children
                      : processors > 0      ? (size_t)processors
                                            : 1;
    if (n_regions == 0)
        return;
    char *helper = options->helper ? kr_text_copy(options->helper) : kr_child_beside("kirsch-gmsh");
    struct work work = {region, helper, options->seconds ? options->seconds : LONGEST, 0,
                        options->first, KR_NEW(struct attempt, children)};
    size_t *order = by_area(n_regions, region), started = 0;
    while (started < n_regions || work.running) {
        if (started < n_regions && work.running < children)
            start(&work, order[started++], options->first);
        else
            finish_one(&work);
    }
    kr_free(order);
    kr_free(work.attempt);
    kr_free(helper);
}
