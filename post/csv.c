/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tables: one pass over the text. A line is cut in place into fields, then copied.
 */
#include "csv.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"

/* Fields of one line. */
struct fields {
    char **text;
    size_t count, room;
};

static int is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/* A field in quotes, from behind the first: taken out in place. Returns what follows the last
   quote; NULL if there is none in this line. */
static char *unquote(char *from, char **end) {
    char *to = from;
    for (; *from; from++) {
        if (*from == '"' && from[1] != '"') {
            *end = to;
            return from + 1;
        }
        from += *from == '"';
        *to++ = *from;
    }
    return NULL;
}

/* Cut a line into fields; 0 where a quote does not end. */
static int cut(char *line, struct fields *fields) {
    for (char *at = line;; at++) {
        char *begin = at + strspn(at, " \t"), *end;
        if (*begin == '"') {
            at = unquote(++begin, &end);
            if (!at)
                return 0;
            at += strcspn(at, ",");
        } else {
            at = end = begin + strcspn(begin, ",");
            while (end > begin && is_blank(end[-1]))
                end--;
        }
        KR_GROW(fields->text, fields->count, fields->room);
        fields->text[fields->count++] = kr_text("%.*s", (int)(end - begin), begin);
        if (!*at)
            return 1;
    }
}

static int is_comment(const char *line) {
    line += strspn(line, " \t\r\n");
    return !*line || *line == '#';
}

/* Put the fields of a line behind the rows; they then belong to the table. */
static void add_row(struct kr_csv *table, const struct fields *fields, size_t line) {
    size_t n = table->n_columns;
    table->cell = kr_realloc(table->cell, (table->n_rows + 1) * n, sizeof(char *));
    table->line = kr_realloc(table->line, table->n_rows + 1, sizeof(size_t));
    memcpy(table->cell + table->n_rows * n, fields->text, n * sizeof(char *));
    table->line[table->n_rows++] = line;
}

static void take_line(struct kr_csv *table, char *text, const char *path, size_t line) {
    struct fields fields = {0};
    if (!cut(text, &fields))
        kr_stop(KR_EXIT_INPUT, "%s:%zu: a quote does not end in its line", path, line);
    if (!table->name) {
        table->name = fields.text;
        table->n_columns = fields.count;
        return;
    }
    if (fields.count != table->n_columns)
        kr_stop(KR_EXIT_INPUT,
                "%s:%zu: found %zu fields, expected %zu as in the header; a value with commas, like "
                "\"[0.5 mm, 1 mm]\", needs quotes",
                path, line, fields.count, table->n_columns);
    add_row(table, &fields, line);
    kr_free(fields.text);
}

struct kr_csv *kr_csv_read(const char *path) {
    struct kr_csv *table = KR_NEW(struct kr_csv, 1);
    FILE *file = fopen(path, "r");
    char *text = NULL;
    size_t room = 0;
    if (!file)
        kr_stop(KR_EXIT_INPUT, "%s cannot be read: %s", path, strerror(errno));
    for (size_t line = 1; getline(&text, &room, file) >= 0; line++)
        if (!is_comment(text))
            take_line(table, text, path, line);
    if (ferror(file))
        kr_stop(KR_EXIT_INPUT, "%s cannot be read to its end: %s", path, strerror(errno));
    fclose(file);
    free(text);
    if (!table->name)
        kr_stop(KR_EXIT_INPUT, "%s is empty; expected a line with the names of the columns", path);
    return table;
}

void kr_csv_free(struct kr_csv *table) {
    if (!table)
        return;
    for (size_t k = 0; k < table->n_columns; k++)
        kr_free(table->name[k]);
    for (size_t k = 0; k < table->n_rows * table->n_columns; k++)
        kr_free(table->cell[k]);
    kr_free(table->name);
    kr_free(table->cell);
    kr_free(table->line);
    kr_free(table);
}

size_t kr_csv_column(const struct kr_csv *table, const char *name) {
    size_t length = strlen(name);
    for (size_t k = 0; k < table->n_columns; k++)
        if (!strncmp(table->name[k], name, length) &&
            (!table->name[k][length] || !strncmp(table->name[k] + length, " [", 2)))
            return k;
    return KR_CSV_NONE;
}

const char *kr_csv_cell(const struct kr_csv *table, size_t row, size_t column) {
    return table->cell[row * table->n_columns + column];
}
