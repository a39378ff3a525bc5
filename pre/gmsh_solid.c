/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Children that fill regions with tetrahedra. See gmsh_solid.h.
 */
#include "fill_solid.h"

#include "base/child.h"
#include "base/error.h"
#include "base/memory.h"

#include <string.h>
#include <unistd.h>

enum { LONGEST = 300 };

/* The one warning that is no failure, gmsh's last: slivers are left. Cells are checked one by one, their least
 * volume stands in the report, and without moving and swapping there would be more. */
static const char ILL_SHAPED[] = "ill-shaped tets are still in the mesh";

struct attempt {
    size_t region, method, *sent;
    struct kr_child child;
};

struct work {
    struct kr_solid_region *region;
    char *helper;
    unsigned seconds;
    size_t running;
    struct attempt *attempt;
};

static void start(struct work *work, size_t region, size_t method) {
    struct attempt *attempt = &work->attempt[work->running++];
    *attempt = (struct attempt){.region = region, .method = method};
    attempt->sent = KR_NEW(size_t, work->region[region].n_shell_points);
    kr_child_prepare(&attempt->child);
    kr_solid_ask(&work->region[region], method, attempt->child.in, attempt->sent);
    kr_child_start(&attempt->child, work->helper, work->seconds);
}

/** What is wrong with an ended attempt, owned by the caller; NULL: nothing, and its mesh is taken. */
static char *judge(struct work *work, struct attempt *attempt, int status) {
    char *trouble = kr_child_trouble(status, work->seconds);
    char *line = kr_child_line(&attempt->child, "Error"), *both;
    if (!line)
        line = kr_child_line(&attempt->child, "Warning");
    if (line && strstr(line, ILL_SHAPED))
        line = kr_free(line);
    if (!trouble && !line)
        return kr_solid_take(&work->region[attempt->region], attempt->sent, attempt->child.out);
    both = trouble && line ? kr_text("%s; it said: %s", trouble, line)
           : trouble       ? kr_text_copy(trouble)
                           : kr_text("it said: %s", line);
    kr_free(trouble);
    kr_free(line);
    return both;
}

/** Wait for one child and take its mesh, or go on with the next method. */
static void finish_one(struct work *work) {
    int status;
    pid_t pid = kr_child_wait(&status);
    size_t k = 0;
    while (k < work->running && work->attempt[k].child.pid != pid)
        k++;
    if (k == work->running)
        return; /* a child of somebody else */
    struct attempt done = work->attempt[k];
    struct kr_solid_region *r = &work->region[done.region];
    work->attempt[k] = work->attempt[--work->running];
    char *trouble = judge(work, &done, status);
    r->seconds += kr_child_clock() - done.child.started;
    kr_child_close(&done.child);
    kr_free(done.sent);
    if (!trouble) {
        r->method = kr_solid_methods[done.method].name;
        return;
    }
    if (done.method + 1 == KR_SOLID_METHODS)
        kr_stop(KR_EXIT_LIBRARY,
                "gmsh cannot fill the region %s by any of %d methods; the last, %s, failed: %s. "
                "Another spacing or padding may help, or the voronoi grid",
                r->name, KR_SOLID_METHODS, kr_solid_methods[done.method].name, trouble);
    kr_warn("region %s: %s failed: %s; trying %s", r->name, kr_solid_methods[done.method].name, trouble,
            kr_solid_methods[done.method + 1].name);
    kr_free(trouble);
    start(work, done.region, done.method + 1);
}

void kr_solid_fill(size_t n_regions, struct kr_solid_region *region,
                   const struct kr_gmsh_options *options) {
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    size_t children = options->children > 0 ? (size_t)options->children
                      : processors > 0      ? (size_t)processors
                                            : 1;
    char *helper = options->helper ? kr_text("%s-solid", options->helper)
                                   : kr_child_beside("kirsch-gmsh-solid");
    struct work work = {region, helper, options->seconds ? options->seconds : LONGEST, 0,
                        KR_NEW(struct attempt, children)};
    size_t started = 0;
    while (started < n_regions || work.running) {
        if (started < n_regions && work.running < children)
            start(&work, started++, 0);
        else
            finish_one(&work);
    }
    kr_free(work.attempt);
    kr_free(helper);
}

void kr_solid_region_free(struct kr_solid_region *region) {
    kr_free(region->triangle);
    kr_free(region->point);
    kr_free(region->cell);
    kr_free((char *)region->name);
}
