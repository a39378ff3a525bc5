/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What all branches of a tree did together.
 */
#ifndef KR_TOTAL_H
#define KR_TOTAL_H

#include "tree.h"

struct kr_total {
    double length, energy;        /* m, J/m */
    double mean_speed;            /* m/s: over the time of running of all tips; NaN: none ran */
    double top_speed, top_error;  /* m/s; NaN: no branch is long enough */
    double first_branching;       /* s; infinite: none */
    double arrival;               /* s: of the last tip; NaN: there is none */
};

struct kr_total kr_total_of(const struct kr_tree *tree);

#endif
