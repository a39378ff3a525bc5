/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What the files of boundary.h share: a load, and its values at one time.
 */
#ifndef KR_BOUNDARY_PRIVATE_H
#define KR_BOUNDARY_PRIVATE_H

#include "base/expression.h"
#include "boundary.h"
#include "table.h"

enum kr_load_kind { BODY_FORCE, VELOCITY, DISPLACEMENT };

/* One component of one load. */
struct kr_load_part {
    struct kr_expression *expression; /* NULL: free */
    double factor;                    /* to SI, and from traction to body force */
};

struct kr_load {
    const struct kr_set *set;
    enum kr_load_kind kind;
    double ramp;
    struct kr_table *table; /* NULL: none */
    int repeats;
    struct kr_load_part part[3];
    double reaction[3];
};

struct kr_boundary {
    int dim;
    const struct kr_nodes *nodes; /* not owned */
    size_t count;
    struct kr_load *load;
};

/** A component's value for the nodes of its set, one after the other at one time. */
struct kr_load_value {
    const struct kr_boundary *boundary;
    const struct kr_load *load;
    const struct kr_load_part *part;
    double t, ramp, everywhere;
    int varies;
};

/** Stops (exit 4), naming set and place, where a value is not finite. */
struct kr_load_value kr_load_value_begin(const struct kr_boundary *boundary,
                                         const struct kr_load *load, int d, double t);
double kr_load_value_of(const struct kr_load_value *value, int64_t node);

#endif
