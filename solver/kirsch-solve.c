/* SPDX-License-Identifier: BSD-3-Clause
 *
 * kirsch-solve: nodes -> results.
 */
#include "base/error.h"
#include "base/expression.h"
#include "base/memory.h"
#include "interrupt.h"
#include "run.h"

#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "kirsch-solve case.yaml\n"
    "\n"
    "Solves a case. Reads plate.nodes.h5 in the case's folder; writes run.h5, run.xdmf (for ParaView)\n"
    "and history.csv there.\n"
    "\n"
    "  --resume           go on from the last checkpoint, as if the run had never stopped\n"
    "  --max-walltime S   after so many seconds write a checkpoint and stop (exit 7)";

static void limit_time(const char *text) {
    char *end;
    double seconds = text ? strtod(text, &end) : 0;
    if (!text || end == text || *end || !(seconds >= 1 && seconds < 1e9))
        kr_stop(KR_EXIT_INPUT, "--max-walltime is '%s', expected seconds, 1 or more, such as 3600",
                text ? text : "");
    kr_interrupt_after((unsigned)seconds);
}

/* Returns whether to resume; stops on arguments that are not known. */
static int take_own_arguments(const struct kr_case_arguments *arguments) {
    int resume = 0;
    for (size_t k = 0; k < arguments->n_left; k++) {
        if (!strcmp(arguments->left[k], "--max-walltime"))
            limit_time(++k < arguments->n_left ? arguments->left[k] : NULL);
        else if (!strcmp(arguments->left[k], "--resume"))
            resume = 1;
        else
            kr_stop(KR_EXIT_INPUT, "unknown argument '%s'; see kirsch-solve --help",
                    arguments->left[k]);
    }
    return resume;
}

int main(int argc, char **argv) {
    struct kr_case_arguments arguments;
    struct kr_case c;
    kr_error_program("kirsch-solve");
    kr_case_arguments(argc, argv, usage, &arguments);
    int resume = take_own_arguments(&arguments);
    struct kr_deck *deck = kr_case_open(&arguments, &c);
    struct kr_run *run = kr_run_create(deck, &c);
    if (arguments.explain) {
        kr_run_explain(run);
    } else {
        char *deck_text = kr_deck_resolved(deck, NULL);
        kr_run_solve(run, deck_text, resume);
        kr_free(deck_text);
    }
    kr_run_free(run);
    kr_deck_close(deck);
    kr_free(arguments.set);
    kr_free(arguments.left);
    return KR_EXIT_OK;
}
