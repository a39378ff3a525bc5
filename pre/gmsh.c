/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Regions in the plane, filled by a crew of children, the largest region first.
 */
#include "gmsh.h"

#include "base/child.h"
#include "base/memory.h"
#include "crew.h"
#include "fill.h"

static const char *words_of(size_t method) {
    return kr_fill_methods[method].words;
}

static void ask(void *regions, size_t region, size_t method, FILE *to) {
    kr_fill_ask((const struct kr_gmsh_region *)regions + region, &kr_fill_methods[method], to);
}

static char *take(void *regions, size_t region, FILE *from) {
    return kr_fill_read((struct kr_gmsh_region *)regions + region, from);
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
    if (n_regions == 0)
        return;
    char *program = options->helper ? kr_text_copy(options->helper) : kr_child_beside("kirsch-gmsh");
    struct kr_crew crew = {.program = program, .children = options->children, .seconds = options->seconds,
                           .n_methods = kr_fill_n_methods, .first = options->first, .method_words = words_of,
                           .regions = region, .ask = ask, .take = take};
    struct kr_crew_job *job = KR_NEW(struct kr_crew_job, n_regions);
    size_t *order = by_area(n_regions, region);
    for (size_t r = 0; r < n_regions; r++)
        job[r].name = region[r].name;
    kr_crew_work(&crew, n_regions, job, order);
    for (size_t r = 0; r < n_regions; r++) {
        region[r].method = words_of(job[r].method);
        region[r].seconds += job[r].seconds;
    }
    kr_free(order);
    kr_free(job);
    kr_free(program);
}
