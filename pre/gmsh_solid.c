/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Regions in space, filled by a crew of children. See gmsh_solid.h.
 */
#include "fill_solid.h"

#include "base/child.h"
#include "base/memory.h"
#include "crew.h"

/* The one warning that is no failure, gmsh's last: slivers are left. Cells are checked one by one, their least
 * volume stands in the report, and without moving and swapping there would be more. */
static const char ILL_SHAPED[] = "ill-shaped tets are still in the mesh";

/** The regions, and for each the order in which its points were sent. */
struct sent {
    struct kr_solid_region *region;
    size_t **sent;
};

static const char *words_of(size_t method) {
    return kr_solid_methods[method].name;
}

static void ask(void *regions, size_t region, size_t method, FILE *to) {
    struct sent *all = regions;
    kr_solid_ask(&all->region[region], method, to, all->sent[region]);
}

static char *take(void *regions, size_t region, FILE *from) {
    struct sent *all = regions;
    return kr_solid_take(&all->region[region], all->sent[region], from);
}

void kr_solid_fill(size_t n_regions, struct kr_solid_region *region,
                   const struct kr_gmsh_options *options) {
    if (n_regions == 0)
        return;
    char *program = options->helper ? kr_text("%s-solid", options->helper) : kr_child_beside("kirsch-gmsh-solid");
    struct sent all = {region, KR_NEW(size_t *, n_regions)};
    struct kr_crew crew = {.program = program, .children = options->children, .seconds = options->seconds,
                           .harmless = ILL_SHAPED, .n_methods = KR_SOLID_METHODS, .method_words = words_of,
                           .regions = &all, .ask = ask, .take = take};
    struct kr_crew_job *job = KR_NEW(struct kr_crew_job, n_regions);
    for (size_t r = 0; r < n_regions; r++) {
        job[r].name = region[r].name;
        all.sent[r] = KR_NEW(size_t, region[r].n_shell_points);
    }
    kr_crew_work(&crew, n_regions, job, NULL);
    for (size_t r = 0; r < n_regions; r++) {
        region[r].method = words_of(job[r].method);
        region[r].seconds += job[r].seconds;
        kr_free(all.sent[r]);
    }
    kr_free(all.sent);
    kr_free(job);
    kr_free(program);
}

void kr_solid_region_free(struct kr_solid_region *region) {
    kr_free(region->triangle);
    kr_free(region->point);
    kr_free(region->cell);
    kr_free((char *)region->name);
}
