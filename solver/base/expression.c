/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Expressions by muParser, through its C interface. Two things that muParser would take are
 * refused: an assignment (x = 2 would write to the place of x) and a list of several values.
 */
#include "base/expression.h"

#include "base/error.h"
#include "base/memory.h"

#include <ctype.h>
#include <muParserDLL.h>
#include <string.h>

struct kr_expression {
    muParserHandle_t parser;
    double x, y, z, t;
    int in_space, in_time;
};

/* Without a handler muParser prints; the state is asked for with mupError instead. */
static void note_error(muParserHandle_t parser) {
    (void)parser;
}

static int has_assignment(const char *text) {
    for (const char *c = text; (c = strchr(c, '=')); c++) {
        if (c[1] == '=')
            c++;
        else if (c == text || !strchr("<>!", c[-1]))
            return 1;
    }
    return 0;
}

/* Fill in which variables the compiled expression uses. */
static void find_variables(struct kr_expression *expression) {
    int count = mupGetExprVarNum(expression->parser);
    for (int i = 0; i < count; i++) {
        const muChar_t *name = NULL;
        muFloat_t *place = NULL;
        mupGetExprVar(expression->parser, (unsigned)i, &name, &place);
        if (place == &expression->t)
            expression->in_time = 1;
        else
            expression->in_space = 1;
    }
}

/* muParser's sentence, as a part of ours. */
static char *message_of(muParserHandle_t parser) {
    char *message = kr_text_copy(mupGetErrorMsg(parser));
    size_t length = strlen(message);
    *message = (char)tolower((unsigned char)*message);
    if (length && message[length - 1] == '.')
        message[length - 1] = 0;
    return message;
}

/* Compile; a sentence about what is wrong, NULL if nothing is. */
static char *compile(struct kr_expression *expression, const char *text) {
    int values = 0;
    if (!text[strspn(text, " \t\n")])
        return kr_text_copy("the expression is empty");
    if (has_assignment(text))
        return kr_text_copy("'=' assigns, which an expression may not; '==' compares");
    mupSetExpr(expression->parser, text);
    if (!mupError(expression->parser))
        mupEvalMulti(expression->parser, &values); /* compiles: muParser does it at first use */
    if (mupError(expression->parser))
        return message_of(expression->parser);
    if (values != 1)
        return kr_text("%d values separated by commas, where one is wanted", values);
    find_variables(expression);
    return NULL;
}

struct kr_expression *kr_expression_create(const char *text, char **why) {
    struct kr_expression *expression = KR_NEW(struct kr_expression, 1);
    muParserHandle_t parser = mupCreate(muBASETYPE_FLOAT);
    kr_assert(parser);
    expression->parser = parser;
    mupSetErrorHandler(parser, note_error);
    mupDefineVar(parser, "x", &expression->x);
    mupDefineVar(parser, "y", &expression->y);
    mupDefineVar(parser, "z", &expression->z);
    mupDefineVar(parser, "t", &expression->t);
    mupDefineConst(parser, "pi", 3.141592653589793);
    mupDefineConst(parser, "e", 2.718281828459045);
    char *fault = compile(expression, text);
    if (!fault)
        return expression;
    *why = fault;
    kr_expression_free(expression);
    return NULL;
}

double kr_expression_value(struct kr_expression *expression, double x, double y, double z,
                           double t) {
    expression->x = x;
    expression->y = y;
    expression->z = z;
    expression->t = t;
    return mupEval(expression->parser);
}

int kr_expression_varies_in_space(const struct kr_expression *expression) {
    return expression->in_space;
}

int kr_expression_varies_in_time(const struct kr_expression *expression) {
    return expression->in_time;
}

void kr_expression_free(struct kr_expression *expression) {
    if (!expression)
        return;
    mupRelease(expression->parser);
    kr_free(expression);
}
