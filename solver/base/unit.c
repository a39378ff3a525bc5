/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Quantities by udunits2. Its database is an XML file of some thousand units, read once. Two kinds
 * of unit that it knows are refused here, because a bare factor cannot stand for them: those with
 * an offset (degree Celsius) and logarithmic ones (dB).
 */
#include "base/unit.h"

#include "base/error.h"
#include "base/memory.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <udunits2.h>

static ut_system *units;

/* The quantities that decks hold; others fall back to the bare unit. */
static const struct {
    const char *unit, *noun, *common;
} quantities[] = {
    {"m", "a length", "mm"},
    {"s", "a time", "us"},
    {"Pa", "a stress", "MPa"},
    {"m/s", "a velocity", "m/s"},
    {"kg/m^3", "a density", "kg/m^3"},
    {"J/m^2", "an energy per area", "J/m^2"},
    {"N/m^3", "a force per volume", "N/m^3"},
    {"rad", "an angle", "deg"},
    {"1", "a pure number", ""},
};

enum { QUANTITIES = sizeof quantities / sizeof *quantities };

const char *kr_unit_noun(const char *unit) {
    for (int i = 0; i < QUANTITIES; i++)
        if (!strcmp(quantities[i].unit, unit))
            return quantities[i].noun;
    return "a quantity";
}

const char *kr_unit_common(const char *unit) {
    for (int i = 0; i < QUANTITIES; i++)
        if (!strcmp(quantities[i].unit, unit))
            return quantities[i].common;
    return unit;
}

/* A unit begins with a letter (or a byte of the UTF-8 micro sign): udunits2 would also take
   "2 mm" as a unit of two millimetres, so that "0.1 2 mm" would pass. NULL if it is none. */
static ut_unit *parse(const char *text) {
    if (!isalpha((unsigned char)*text) && (unsigned char)*text < 0x80 && strcmp(text, "1"))
        return NULL;
    if (!units) {
        ut_set_error_message_handler(ut_ignore);
        units = ut_read_xml(NULL);
        if (!units)
            kr_stop(KR_EXIT_LIBRARY, "the unit database of udunits2 cannot be read; is the "
                                     "package libudunits2-data installed?");
        /* udunits2 knows the degree by its whole name only. */
        ut_unit *degree = ut_parse(units, "degree", UT_UTF8);
        ut_map_name_to_unit("deg", UT_UTF8, degree);
        ut_free(degree);
    }
    char *copy = ut_trim(kr_text_copy(text), UT_UTF8);
    ut_unit *unit = ut_parse(units, copy, UT_UTF8);
    kr_free(copy);
    return unit;
}

/* Slope of a conversion through the origin; 0 for any other kind. */
static double slope(cv_converter *converter) {
    double one = cv_convert_double(converter, 1), two = cv_convert_double(converter, 2);
    int straight = isfinite(one) && fabs(two - 2 * one) <= 1e-12 * fabs(two);
    return straight ? one : 0;
}

double kr_unit_factor(const char *text, const char *unit) {
    double factor = 0;
    ut_unit *from = parse(text), *to = parse(unit);
    if (from && to && ut_are_convertible(from, to)) {
        cv_converter *converter = ut_get_converter(from, to);
        if (converter)
            factor = slope(converter);
        cv_free(converter);
    }
    ut_free(from);
    ut_free(to);
    return factor;
}

const char *kr_unit_number(const char *text, double *value) {
    const char *first = text + (*text == '-' || *text == '+');
    char *end;
    if (!isdigit((unsigned char)*first) && *first != '.')
        return NULL;
    if (first[0] == '0' && (first[1] == 'x' || first[1] == 'X'))
        return NULL;
    *value = strtod(text, &end);
    return end == text || !isfinite(*value) ? NULL : end;
}

int kr_unit_beyond(const char *text) {
    int before = 0;
    for (char *end; *text; before = (unsigned char)end[-1], text = end) {
        end = (char *)text + 1;
        if (!isdigit((unsigned char)*text) || isalnum(before) || before == '_')
            continue;
        errno = 0;
        strtod(text, &end);
        if (errno == ERANGE)
            return 1;
    }
    return 0;
}

char *kr_unit_beyond_said(const char *text, const char *unit) {
    const char *common = kr_unit_common(unit);
    return kr_text("found '%.60s', expected %s between 2.2e-308 and 1.8e308 in SI units, "
                   "such as '1%s%s'", text, kr_unit_noun(unit), *common ? " " : "", common);
}

/* 0.16 mm and 160 um are the same length, but 0.16 * 0.001 and 160 * 1e-6 differ in the last bit.
   Fifteen digits hold all that a converted decimal can say, and make both 0.00016. */
static double settle(double value) {
    char *text = kr_text("%.14e", value);
    double settled = strtod(text, NULL);
    kr_free(text);
    return settled;
}

static char *explain(const char *text, const char *number_end, const char *unit) {
    const char *noun = kr_unit_noun(unit), *common = kr_unit_common(unit);
    int length = number_end ? (int)(number_end - text) : 1;
    const char *number = number_end ? text : "1";
    const char *rest = number_end ? number_end + strspn(number_end, " \t\n") : "";
    if (!strcmp(unit, "1"))
        return kr_text("found '%.60s', expected a pure number, without a unit", text);
    if (!*rest)
        return kr_text("found '%.60s', expected %s with its unit, such as '%.*s %s'", text, noun,
                       length, number, common);
    if (strchr("*+-/(^", *rest))
        return kr_text("found '%.60s', a formula; expected %s, such as '%.*s %s'. Only loads and initial "
                       "fields may be formulas; sets are fixed when the nodes are made, and no load can move "
                       "to other nodes", text, noun, length, number, common);
    ut_unit *known = parse(rest);
    ut_free(known);
    return kr_text("found '%.60s', whose unit '%.30s' is %s; expected %s, such as '%.*s %s'", text,
                   rest, known ? "of another kind" : "unknown", noun, length, number, common);
}

static int read_trimmed(const char *text, const char *unit, double *value, char **why) {
    double number = 0;
    const char *end = kr_unit_number(text, &number);
    if (kr_unit_beyond(text)) {
        *why = kr_unit_beyond_said(text, unit);
        return 0;
    }
    int pure = !strcmp(unit, "1");
    const char *rest = end ? end + strspn(end, " \t\n") : "";
    if (end && pure && !*rest) {
        *value = number;
        return 1;
    }
    double factor = end && !pure && *rest ? kr_unit_factor(rest, unit) : 0;
    if (factor == 0 || (number != 0 && !isnormal(number * factor))) {
        *why = factor == 0 ? explain(text, end, unit) : kr_unit_beyond_said(text, unit);
        return 0;
    }
    *value = factor == 1 ? number : settle(number * factor);
    return 1;
}

int kr_unit_read(const char *text, const char *unit, double *value, char **why) {
    char *copy = kr_text_copy(text);
    size_t length = strlen(copy);
    while (length && isspace((unsigned char)copy[length - 1]))
        copy[--length] = 0;
    int done = read_trimmed(copy + strspn(copy, " \t\n"), unit, value, why);
    kr_free(copy);
    return done;
}

void kr_unit_close(void) {
    if (units)
        ut_free_system(units);
    units = NULL;
}
