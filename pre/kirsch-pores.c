/* SPDX-License-Identifier: BSD-3-Clause
 *
 * kirsch-pores: random pores for a plate.
 */
#include "base/error.h"
#include "base/memory.h"
#include "pores.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char usage[] =
    "kirsch-pores case.yaml\n"
    "\n"
    "Places the random pores of the deck's geometry.pores and writes pores.txt into the case's\n"
    "folder. The same seed gives the same pores everywhere.";

static double porosity_of(const struct kr_case *c, const struct kr_case_hole *hole, size_t count) {
    double area = 0;
    for (size_t k = 0; k < count; k++)
        area += M_PI * hole[k].radius * hole[k].radius;
    return area / (c->width * c->height);
}

static void write_pores(const struct kr_case *c, const struct kr_case_hole *hole,
                        const char *path) {
    const struct kr_case_pores *p = &c->pores;
    char *beside = kr_text("%s.tmp", path);
    FILE *file = fopen(beside, "w");
    if (!file)
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s", beside, strerror(errno));
    fprintf(
        file,
        "# x y radius [m]; seed %lld, radius %g to %g m, %g diameters from the edges, gap %g m\n",
        (long long)p->seed, p->radius[0], p->radius[1], p->edge_diameters, p->gap);
    for (int64_t k = 0; k < p->count; k++)
        fprintf(file, "%.9f %.9f %.9f\n", hole[k].centre[0], hole[k].centre[1], hole[k].radius);
    int failed = ferror(file) | fclose(file);
    if (failed || rename(beside, path))
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s; free some space and run again", path,
                strerror(errno));
    kr_free(beside);
}

static void make_pores(struct kr_deck *deck, const struct kr_case *c) {
    struct kr_case_hole *hole = KR_NEW(struct kr_case_hole, (size_t)c->pores.count);
    int64_t throws;
    size_t placed = kr_pores_throw(c, hole, &throws);
    if (placed < (size_t)c->pores.count)
        kr_stop(
            KR_EXIT_INPUT,
            "%s: only %zu of %lld pores found a place in %lld throws (porosity %.1f %%); ask for "
            "fewer or smaller pores, a smaller gap or edge_diameters, another seed, or allow more "
            "attempts",
            kr_deck_where(deck, &c->pores.count), placed, (long long)c->pores.count,
            (long long)throws, 100 * porosity_of(c, hole, placed));
    char *path = kr_case_file(c, "pores.txt");
    write_pores(c, hole, path);
    kr_say("  %zu pores in %lld throws, porosity %.2f %%", placed, (long long)throws,
           100 * porosity_of(c, hole, placed));
    kr_say("  wrote %s", path);
    kr_free(path);
    kr_free(hole);
}

int main(int argc, char **argv) {
    struct kr_case_arguments arguments;
    struct kr_case c;
    kr_error_program("kirsch-pores");
    kr_case_arguments(argc, argv, usage, &arguments);
    if (arguments.n_left)
        kr_stop(KR_EXIT_INPUT, "unknown argument '%s'; see kirsch-pores --help", arguments.left[0]);
    struct kr_deck *deck = kr_case_open(&arguments, &c);
    if (!c.pores.count)
        kr_stop(KR_EXIT_INPUT, "%s asks for no pores; expected geometry.pores.count above 0",
                arguments.deck);
    if (arguments.explain)
        kr_say("would throw %lld pores, at most %lld throws, seed %lld", (long long)c.pores.count,
               (long long)c.pores.attempts, (long long)c.pores.seed);
    else
        make_pores(deck, &c);
    kr_deck_close(deck);
    kr_free(arguments.set);
    kr_free(arguments.left);
    return KR_EXIT_OK;
}
