/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tables. See table.h.
 */
#include "table.h"

#include "base/memory.h"
#include "base/unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct line {
    double t, value;
};

struct kr_table {
    size_t count, room;
    struct line *line;
};

enum { LONGEST = 4096 };

/* Field k of a line, without blanks around it, cut off with a 0; NULL if there are fewer. */
static char *field_of(char *text, int k) {
    for (; k > 0; k--) {
        text += strcspn(text, ",");
        if (*text++ != ',')
            return NULL;
    }
    text += strspn(text, " \t");
    size_t length = strcspn(text, ",\r\n");
    while (length && strchr(" \t", text[length - 1]))
        length--;
    text[length] = 0;
    return text;
}

static int column_named(const char *header, const char *name) {
    char copy[LONGEST], *field;
    for (int k = 1;; k++) {
        strcpy(copy, header);
        if (!(field = field_of(copy, k)))
            return 0;
        if (!name || !strcmp(field, name))
            return k;
    }
}

/* Seconds that a time of 1 stands for; 0 where the first column is no "time [unit]". */
static double unit_of(const char *header) {
    char copy[LONGEST], unit[32] = "", *field;
    strcpy(copy, header);
    field = field_of(copy, 0);
    if (sscanf(field, "time [%31[^]]]", unit) != 1)
        return 0;
    return kr_unit_factor(unit, "s");
}

static int number_of(const char *line, int k, double *value) {
    char copy[LONGEST], *field;
    strcpy(copy, line);
    field = field_of(copy, k);
    const char *end = field ? kr_unit_number(field, value) : NULL;
    return end && !*end;
}

/* A sentence about the first fault, NULL if all was read. */
static char *read_lines(struct kr_table *table, FILE *file, const char *column) {
    char line[LONGEST], header[LONGEST] = "";
    double scale, t, value;
    if (!fgets(header, sizeof header, file) || !(scale = unit_of(header)))
        return kr_text("line 1: expected the names of the columns, such as 'time [s],factor'");
    int k = column_named(header, column);
    if (!k)
        return kr_text("line 1: there is no column '%.40s'", column ? column : "(the second)");
    for (int number = 2; fgets(line, sizeof line, file); number++) {
        if (!line[strspn(line, " \t\r\n")])
            continue;
        if (!number_of(line, 0, &t) || !number_of(line, k, &value))
            return kr_text("line %d: expected numbers, a time and a factor", number);
        if (table->count && !(scale * t > table->line[table->count - 1].t))
            return kr_text("line %d: the time must be after that of the line before", number);
        KR_GROW(table->line, table->count, table->room);
        table->line[table->count++] = (struct line){scale * t, value};
    }
    return table->count < 2 ? kr_text("expected two lines of numbers or more") : NULL;
}

struct kr_table *kr_table_read(struct kr_deck *deck, const void *field, const char *path,
                               const char *column) {
    struct kr_table *table = KR_NEW(struct kr_table, 1);
    FILE *file = fopen(path, "r");
    if (!file) {
        kr_deck_fault(deck, field, "%s cannot be read; expected a CSV file with a header such as "
                                   "'time [s],factor'", path);
        kr_table_free(table);
        return NULL;
    }
    char *fault = read_lines(table, file, column);
    fclose(file);
    if (fault) {
        kr_deck_fault(deck, field, "%s: %s", path, fault);
        kr_free(fault);
        kr_table_free(table);
        return NULL;
    }
    return table;
}

void kr_table_free(struct kr_table *table) {
    if (!table)
        return;
    kr_free(table->line);
    kr_free(table);
}

double kr_table_value(const struct kr_table *table, double t, int repeats) {
    const struct line *line = table->line;
    size_t low = 0, high = table->count - 1;
    double first = line[0].t, period = line[high].t - first;
    if (repeats && t > line[high].t)
        t -= period * floor((t - first) / period);
    if (t <= first)
        return line[0].value;
    if (t >= line[high].t)
        return line[high].value;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (line[middle].t <= t)
            low = middle;
        else
            high = middle;
    }
    double share = (t - line[low].t) / (line[high].t - line[low].t);
    return line[low].value + share * (line[high].value - line[low].value);
}
