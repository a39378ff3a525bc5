/* SPDX-License-Identifier: BSD-3-Clause
 *
 * kirsch-pores: random pores for a plate, or those of a file.
 */
#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "pores.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char usage[] =
    "kirsch-pores case.yaml\n"
    "\n"
    "Places the random pores of the deck's geometry.pores, or takes those of its file, and writes\n"
    "pores.txt into the case's folder. The same seed gives the same pores everywhere.";

/** "30 pores, seed 3, radius ...": the rules, for the first line of the file. */
static char *rules_of(const struct kr_case *c) {
    const struct kr_case_pores *p = &c->pores;
    char word[32];
    if (p->file && *p->file)
        return kr_text("# x y radius [m]; from %s\n",
                       strrchr(p->file, '/') ? strrchr(p->file, '/') + 1 : p->file);
    kr_case_word(KR_DISTRIBUTION_WORDS, p->distribution, word);
    char *sizes = p->distribution == KR_UNIFORM
                      ? kr_text("%s", "")
                  : p->distribution == KR_BY_AREA
                      ? kr_text(" %s", word)
                      : kr_text(" %s of mean %g m, deviation %g m", word, p->mean, p->deviation);
    char *rules =
        kr_text("# x y %s%s [m]; seed %lld, radius %g to %g m%s, %g diameters from the edges, gap %g "
                "m\n",
                p->shape == KR_PORE_SPHERE ? "z " : "",
                p->shape == KR_PORE_ELLIPSE ? "long short, degrees" : "radius", (long long)p->seed,
                p->radius[0], p->radius[1], sizes, p->edge_diameters, p->gap);
    kr_free(sizes);
    return rules;
}

/** z: where it is a sphere; NULL where it goes through. */
static void write_hole(FILE *file, const struct kr_case_hole *hole, const double *z) {
    fprintf(file, "%.9f %.9f ", hole->centre[0], hole->centre[1]);
    if (z)
        fprintf(file, "%.9f ", *z);
    if (hole->shape == KR_HOLE_CIRCLE)
        fprintf(file, "%.9f\n", hole->radius);
    else
        fprintf(file, "%.9f %.9f %.3f\n", hole->radii[0], hole->radii[1],
                hole->angle * 180 / M_PI);
}

static void write_pores(const struct kr_case *c, const struct kr_case_hole *hole, const double *z,
                        size_t n, const char *path) {
    struct kr_file file = kr_file_begin(kr_text_copy(path));
    char *rules = rules_of(c);
    fputs(rules, file.to);
    for (size_t k = 0; k < n; k++)
        write_hole(file.to, &hole[k], c->pores.shape == KR_PORE_SPHERE ? &z[k] : NULL);
    kr_file_end(&file);
    kr_free(rules);
}

/** What to relax, in the order of what helps most. */
static const char *cure_of(const struct kr_case *c) {
    const struct kr_case_pores *p = &c->pores;
    if (2 * (2 * p->edge_diameters * p->radius[0]) > fmin(c->width, c->height))
        return "edge_diameters alone keeps even the smallest pore from the plate: lower it";
    return "ask for fewer or smaller pores, a smaller gap or edge_diameters, another seed, or allow "
           "more attempts";
}

static void stop_short(struct kr_deck *deck, const struct kr_case *c, const struct kr_pores *got) {
    double porosity = 100 * got->area / got->outline;
    if (c->pores.count)
        kr_stop(KR_EXIT_INPUT,
                "%s: only %zu of %zu pores found a place in %lld throws (porosity %.1f %%); %s",
                kr_deck_where(deck, &c->pores.count), got->placed, got->wanted,
                (long long)got->throws, porosity, cure_of(c));
    kr_stop(KR_EXIT_INPUT,
            "%s: only %zu of %zu pores found a place in %lld throws: a porosity of %.2f %% instead "
            "of %.2f %%; %s",
            kr_deck_where(deck, &c->pores.porosity), got->placed, got->wanted,
            (long long)got->throws, porosity, 100 * c->pores.porosity, cure_of(c));
}

static void make_pores(struct kr_deck *deck, const struct kr_case *c, const char *path) {
    struct kr_pores pores = kr_pores_throw(c);
    if (pores.placed < pores.wanted)
        stop_short(deck, c, &pores);
    if (c->pores.porosity > 0 && !pores.wanted)
        kr_stop(KR_EXIT_INPUT,
                "%s: %g %% of the outline is less than half of one pore of the least radius",
                kr_deck_where(deck, &c->pores.porosity), 100 * c->pores.porosity);
    write_pores(c, pores.hole, pores.z, pores.placed, path);
    double share = pores.area / pores.outline;
    if (c->pores.shape == KR_PORE_SPHERE) {
        share = 0;
        for (size_t k = 0; k < pores.placed; k++)
            share += 4 * M_PI / 3 * pow(pores.hole[k].radius, 3) / (pores.outline * c->depth);
    }
    kr_say("  %zu pores in %lld throws, porosity %.2f %%", pores.placed, (long long)pores.throws,
           100 * share);
    kr_pores_free(&pores);
}

static void take_pores(const struct kr_case *c, const char *path) {
    size_t n;
    struct kr_case_hole *hole = kr_case_read_pores(c, c->pores.file, &n);
    if (!n)
        kr_stop(KR_EXIT_INPUT, "%s holds no pores", c->pores.file);
    write_pores(c, hole, NULL, n, path);
    kr_say("  %zu pores from %s", n, c->pores.file);
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
    if (!kr_case_has_pores(&c))
        kr_stop(KR_EXIT_INPUT,
                "%s asks for no pores; expected geometry.pores with count, porosity or file",
                arguments.deck);
    char *path = kr_case_file(&c, "pores.txt");
    int from_file = c.pores.file && *c.pores.file;
    if (arguments.explain && from_file)
        kr_say("would take the pores of %s into %s", c.pores.file, path);
    else if (arguments.explain)
        kr_say("would throw %lld pores, at most %lld throws, seed %lld", (long long)c.pores.count,
               (long long)c.pores.attempts, (long long)c.pores.seed);
    else if (from_file)
        take_pores(&c, path);
    else
        make_pores(deck, &c, path);
    if (!arguments.explain)
        kr_say("  wrote %s", path);
    kr_free(path);
    kr_deck_close(deck);
    kr_free(arguments.set);
    kr_free(arguments.left);
    return KR_EXIT_OK;
}
