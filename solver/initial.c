/* SPDX-License-Identifier: BSD-3-Clause
 *
 * How a run begins. See initial.h.
 */
#include "initial.h"

#include "base/error.h"
#include "base/expression.h"

#include <math.h>

static void set_field(const struct kr_deck_formula *formula, const char *name,
                      const struct kr_nodes *nodes, double *field) {
    char *why = NULL;
    struct kr_expression *expression = kr_expression_create(formula->text, &why);
    kr_assert(expression); /* the deck has checked it */
    for (size_t i = 0; i < nodes->n; i++) {
        const double *x = nodes->position + i * (size_t)nodes->dim;
        double z = nodes->dim == 3 ? x[2] : 0;
        field[i] = formula->factor * kr_expression_value(expression, x[0], x[1], z, 0);
        if (!isfinite(field[i]))
            kr_stop(KR_EXIT_NUMBERS,
                    "the initial %s is %g at (%g, %g, %g) m; expected a finite number: look for a "
                    "division by zero or a root of a negative number",
                    name, field[i], x[0], x[1], z);
    }
    kr_expression_free(expression);
}

void kr_initial_set(const struct kr_case *c, const struct kr_nodes *nodes, struct kr_body *body) {
    for (int d = 0; d < body->dim; d++) {
        if (c->initial_displacement[d].text)
            set_field(&c->initial_displacement[d], "displacement", nodes, body->u[d]);
        if (c->initial_velocity[d].text)
            set_field(&c->initial_velocity[d], "velocity", nodes, body->v[d]);
    }
}
