/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Checks of random pores: what must be given with what, and what cannot be met whatever the throws.
 */
#include "case_check.h"

#include <math.h>

static void check_distribution(struct kr_deck *deck, const struct kr_case_pores *pores) {
    int by_mean = pores->distribution == KR_NORMAL || pores->distribution == KR_LOGNORMAL;
    const double *value[] = {&pores->mean, &pores->deviation};
    static const char *const name[] = {"mean", "deviation"};
    char word[32];
    if (pores->distribution < 0)
        return;
    kr_case_word(KR_DISTRIBUTION_WORDS, pores->distribution, word);
    for (int k = 0; k < 2; k++)
        if (by_mean && !kr_deck_given(deck, value[k]))
            kr_deck_fault(deck, value[k],
                          "missing; expected %s of the radius, such as '0.3 mm', for distribution "
                          "%s",
                          name[k], word);
        else if (!by_mean && kr_deck_given(deck, value[k]))
            kr_deck_fault(deck, value[k], "distribution %s has no %s", word, name[k]);
    if (pores->shape == KR_PORE_ELLIPSE && !kr_deck_given(deck, pores->aspect))
        kr_deck_fault(deck, pores->aspect,
                      "missing; expected least and largest ratio of the half axes, such as [1, 2], "
                      "for shape ellipse");
    else if (pores->shape != KR_PORE_ELLIPSE && kr_deck_given(deck, pores->aspect))
        kr_deck_fault(deck, pores->aspect, "shape %s has no aspect",
                      pores->shape == KR_PORE_SPHERE ? "sphere" : "circle");
    else if (pores->aspect[0] > pores->aspect[1])
        kr_deck_fault(deck, pores->aspect, "the least, %g, is more than the largest, %g",
                      pores->aspect[0], pores->aspect[1]);
}

void kr_case_check_pores(struct kr_deck *deck, const struct kr_case *c) {
    const struct kr_case_pores *pores = &c->pores;
    double least = pores->radius[0], most = pores->radius[1];
    int has_file = pores->file && *pores->file;
    if (pores->shape == KR_PORE_SPHERE && !(c->depth > 0))
        kr_deck_fault(deck, &pores->shape, "spheres need a solid; expected geometry.depth: 10 mm");
    else if (pores->shape == KR_PORE_SPHERE && (pores->porosity > 0 || has_file || c->voids.count))
        kr_deck_fault(deck, &pores->shape,
                      "random spheres go by a count, without a porosity, a file, or other voids");
    if ((pores->count > 0) + (pores->porosity > 0) + has_file > 1)
        kr_deck_fault(deck, has_file ? (const void *)&pores->file : &pores->porosity,
                      "pores are given by just one of count, porosity and file");
    if (has_file || (!pores->count && !(pores->porosity > 0)))
        return;
    if (!kr_deck_given(deck, pores->radius)) {
        kr_deck_fault(deck, pores->radius,
                      "missing; expected least and largest radius, such as [0.2 mm, 0.5 mm]");
        return;
    }
    check_distribution(deck, pores);
    if (least > most)
        kr_deck_fault(deck, pores->radius, "the least, %g m, is more than the largest, %g m", least,
                      most);
    else if (2 * most > fmin(c->width, c->height) && c->width > 0 && c->height > 0)
        kr_deck_fault(deck, &pores->radius[1],
                      "a pore of %g m in diameter does not fit into the plate", 2 * most);
    else if (pores->shape != KR_PORE_SPHERE &&
             (double)pores->count * M_PI * least * least > c->width * c->height)
        kr_deck_fault(deck, &pores->count,
                      "%lld pores of %g m in radius have more area than the plate",
                      (long long)pores->count, least);
    else if (pores->porosity * c->width * c->height > 1e6 * M_PI * most * most)
        kr_deck_fault(deck, &pores->porosity, "it takes more than a million pores of %g m", most);
}
