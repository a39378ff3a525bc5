/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Checks of the stages of a case.
 */
#include "case_check.h"

const struct kr_deck_list *kr_case_loads(const struct kr_case *c,
                                         const struct kr_case_stage *stage) {
    return stage && stage->loads.given ? &stage->loads : &c->loads;
}

static int is_supported(const struct kr_deck_list *list) {
    const struct kr_case_load *loads = list->item;
    for (size_t k = 0; k < list->count; k++)
        if (loads[k].displacement[0].text || loads[k].velocity[0].text)
            return 1;
    return 0;
}

static void check_static(struct kr_deck *deck, const struct kr_case *c,
                         const struct kr_case_stage *stage) {
    if (kr_deck_given(deck, &stage->end_time))
        kr_deck_fault(deck, &stage->end_time,
                      "a static stage ends with its load steps; give `steps: [{count: 10, size: 1 s}]`");
    if (kr_deck_given(deck, &stage->damping))
        kr_deck_fault(deck, &stage->damping, "nothing moves in a static stage; leave it out");
    if (!is_supported(kr_case_loads(c, stage)))
        kr_deck_fault(deck, stage, "nothing holds the body in this static stage; prescribe a "
                                   "displacement of some set, such as [free, 0 mm]");
}

static void check_moving(struct kr_deck *deck, const struct kr_case_stage *stage) {
    if (!(stage->end_time > 0))
        kr_deck_fault(deck, &stage->end_time, "missing; expected a time in us");
    if (stage->steps.given)
        kr_deck_fault(deck, &stage->steps, "load steps belong to a static stage; give `end_time`");
    if (kr_deck_given(deck, &stage->least_step))
        kr_deck_fault(deck, &stage->least_step, "load steps belong to a static stage; leave it out");
    if (stage->kind == KR_STAGE_RELAXATION && kr_deck_given(deck, &stage->damping))
        kr_deck_fault(deck, &stage->damping,
                      "a relaxation stage finds its damping itself; leave it out");
    if (stage->kind == KR_STAGE_DYNAMIC && kr_deck_given(deck, &stage->tolerance))
        kr_deck_fault(deck, &stage->tolerance, "a dynamic stage ends at end_time; leave it out");
}

void kr_case_check_stages(struct kr_deck *deck, const struct kr_case *c) {
    const struct kr_case_stage *stages = c->stages.item;
    if (c->stages.count && kr_deck_given(deck, &c->end_time))
        kr_deck_fault(deck, &c->end_time, "with `stages` each has an end of its own; leave it out");
    if (!c->stages.count && !(c->end_time > 0) && !kr_deck_faults(deck))
        kr_deck_fault(deck, &c->end_time, "missing; expected a time in us, or `stages`");
    for (size_t k = 0; k < c->stages.count; k++)
        if (stages[k].kind == KR_STAGE_STATIC)
            check_static(deck, c, &stages[k]);
        else
            check_moving(deck, &stages[k]);
}
