/* SPDX-License-Identifier: BSD-3-Clause
 *
 * kirsch-solve: nodes -> results.
 */
#include "base/error.h"
#include "base/expression.h"
#include "base/memory.h"
#include "run.h"

#include <string.h>

static const char usage[] =
    "kirsch-solve case.yaml\n"
    "\n"
    "Solves a case. Reads plate.nodes.h5 in the case's folder; writes run.h5, run.xdmf (for ParaView)\n"
    "and history.csv there.\n"
    "\n"
    "  --resume           go on from the last checkpoint, as if the run had never stopped";

/* Returns whether to resume; stops on arguments that are not known. */
static int take_own_arguments(const struct kr_case_arguments *arguments) {
    int resume = 0;
    for (size_t k = 0; k < arguments->n_left; k++) {
        if (strcmp(arguments->left[k], "--resume"))
            kr_stop(KR_EXIT_INPUT, "unknown argument '%s'; see kirsch-solve --help",
                    arguments->left[k]);
        resume = 1;
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
