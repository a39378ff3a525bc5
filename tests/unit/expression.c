/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Expressions: values, what they depend on, and what is refused.
 */
#include "test.h"

#include "base/expression.h"

/* At (x, y, z, t) = (0.3, -1.7, 2.9, 5e-5). The tolerance is a few roundings of the largest. */
static const struct {
    const char *text;
    double value;
    int in_space, in_time;
} good[] = {
    {"6", 6, 0, 0},
    {"-0.3*min(t/200e-6, 1)", -0.075, 0, 1},
    {"x + 10*y - 100*z", -306.7, 1, 0},
    {"x*t", 1.5e-5, 1, 1},
    {"pi", 3.14159265358979323846, 0, 0},
    {"e^2", 7.38905609893065022723, 0, 0},
    {"t < 1e-4 ? 2 : 3", 2, 0, 1},
    {"(y == -1.7) + (x >= 0.4)", 1, 1, 0},
    {"max(sin(pi/6), exp(0)*sqrt(0.09))", 0.5, 0, 0},
    {"2e-3", 0.002, 0, 0},
};

static void expression_has_value_and_dependence(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        char *why = NULL;
        struct kr_expression *expression = kr_expression_create(good[i].text, &why);
        if (!expression)
            fail_msg("'%s': %s", good[i].text, why);
        kr_check_near(kr_expression_value(expression, 0.3, -1.7, 2.9, 5e-5), good[i].value,
                      4e-16 * fabs(good[i].value) + 1e-30);
        assert_int_equal(kr_expression_varies_in_space(expression), good[i].in_space);
        assert_int_equal(kr_expression_varies_in_time(expression), good[i].in_time);
        kr_expression_free(expression);
    }
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void expression_follows_its_variables(void **state) {
    (void)state;
    char *why = NULL;
    struct kr_expression *p = kr_expression_create("x + t", &why);
    struct kr_expression *q = kr_expression_create("x - t", &why);
    for (int i = 0; i < 5; i++) {
        kr_check_near(kr_expression_value(p, 1.5 * i, 0, 0, 0.25), 1.5 * i + 0.25, 0);
        kr_check_near(kr_expression_value(q, 1.5 * i, 0, 0, 0.25), 1.5 * i - 0.25, 0);
    }
    kr_expression_free(p);
    kr_expression_free(q);
    kr_expression_free(NULL);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void expression_leaves_infinite_values_to_the_caller(void **state) {
    (void)state;
    char *why = NULL;
    struct kr_expression *expression = kr_expression_create("1/t", &why);
    assert_true(isinf(kr_expression_value(expression, 0, 0, 0, 0)));
    kr_check_near(kr_expression_value(expression, 0, 0, 0, 4), 0.25, 0);
    kr_expression_free(expression);
}

static const struct {
    const char *text, *why;
} bad[] = {
    {"", "the expression is empty"},
    {" ", "the expression is empty"},
    {"2*q", "unexpected token \"q\" found at position 2"},
    {"6 m", "unexpected token \"m\" found at position 2"},
    {"sin(", "unexpected end of expression at position 5"},
    {"x = 2", "'=' assigns, which an expression may not; '==' compares"},
    {"1, 2", "2 values separated by commas, where one is wanted"},
    {"system(1)", "unexpected token \"system\" found at position 0"},
};

static void expression_says_what_is_wrong_and_where(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char *why = NULL;
        assert_null(kr_expression_create(bad[i].text, &why));
        assert_string_equal(why, bad[i].why);
        kr_free(why);
    }
    assert_int_equal(kr_memory_outstanding(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(expression_has_value_and_dependence),
        cmocka_unit_test(expression_follows_its_variables),
        cmocka_unit_test(expression_leaves_infinite_values_to_the_caller),
        cmocka_unit_test(expression_says_what_is_wrong_and_where),
    };
    kr_run_tests(tests);
}
