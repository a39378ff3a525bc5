/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Expressions in x, y, z [m] and t [s], by muParser. They see these four names and constants
 * (pi, e) and nothing else. One expression must not be evaluated by two threads at once.
 */
#ifndef KR_EXPRESSION_H
#define KR_EXPRESSION_H

struct kr_expression; /* Opaque. Implemented in expression.c. */

/** Compile an expression. Returns NULL and a sentence in `why` (owned by the caller) if it is
 *  not one. */
struct kr_expression *kr_expression_create(const char *text, char **why);

/** Value at (x, y, z) [m] and t [s]. May be NaN or infinite: the caller checks. */
double kr_expression_value(struct kr_expression *expression, double x, double y, double z,
                           double t);

/** Whether the value depends on place (x, y, z); if not, one evaluation serves all nodes. */
int kr_expression_varies_in_space(const struct kr_expression *expression);

/** Whether the value depends on t. */
int kr_expression_varies_in_time(const struct kr_expression *expression);

void kr_expression_free(struct kr_expression *expression);

#endif
