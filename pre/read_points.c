/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Reading nodes from text. See points.h; node sets are in read_point_sets.c.
 */
#include "points.h"

#include "base/error.h"
#include "base/memory.h"
#include "convert.h"
#include "point_lines.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum column { ID, X, Y, Z, VOLUME, BLOCK, COLUMNS, UNKNOWN = COLUMNS };
enum { MOST_COLUMNS = 64 };

struct table {
    struct kr_point_lines lines;
    size_t n_columns;
    enum column column[MOST_COLUMNS];
    int has[COLUMNS + 1];
    size_t count, room;
    double (*row)[COLUMNS];
    /* Columns that are not known: sets, where they hold 0 and 1 alone. */
    size_t n_extra;
    char *extra_name[MOST_COLUMNS];
    int is_no_set[MOST_COLUMNS];
    unsigned char *extra; /* (count x n_extra) */
};

static enum column column_of(const char *name) {
    static const struct {
        const char *name;
        enum column column;
    } known[] = {{"id", ID},         {"global_id", ID},  {"x", X},          {"y", Y},
                 {"z", Z},           {"volume", VOLUME}, {"vol", VOLUME},   {"area", VOLUME},
                 {"block_id", BLOCK}, {"block", BLOCK}};
    for (size_t k = 0; k < sizeof known / sizeof *known; k++)
        if (!strcasecmp(name, known[k].name))
            return known[k].column;
    return UNKNOWN;
}

static void add_column(struct table *table, enum column column) {
    if (table->n_columns == MOST_COLUMNS)
        kr_stop(KR_EXIT_INPUT, "%s:%zu: more than %d columns", table->lines.path, table->lines.number,
                MOST_COLUMNS);
    if (column != UNKNOWN && table->has[column])
        kr_stop(KR_EXIT_INPUT, "%s:%zu: two columns have the same meaning", table->lines.path,
                table->lines.number);
    table->has[column] = 1;
    table->column[table->n_columns++] = column;
}

/** The line with the names of the columns. */
static void read_names(struct table *table, char *line) {
    char *rest = NULL;
    for (char *word = strtok_r(line, KR_POINT_BETWEEN, &rest); word; word = strtok_r(NULL, KR_POINT_BETWEEN, &rest)) {
        if (word[0] == '[' || word[0] == '(' || !strcasecmp(word, "header:"))
            continue; /* a unit */
        word[strcspn(word, "[(")] = 0;
        enum column column = column_of(word);
        add_column(table, column);
        if (column == UNKNOWN)
            table->extra_name[table->n_extra++] = kr_text_copy(word);
    }
    if (!table->has[X] || !table->has[Y] || !table->has[VOLUME])
        kr_stop(KR_EXIT_INPUT, "%s:%zu: expected columns named x, y and volume at the least",
                table->lines.path, table->lines.number);
}

/** Columns of a file without names. */
static void assume_columns(struct table *table) {
    static const enum column peridigm[] = {X, Y, Z, VOLUME, BLOCK};
    for (size_t k = 0; k < sizeof peridigm / sizeof *peridigm; k++)
        add_column(table, peridigm[k]);
}

static const char *const what[] = {"a node number", "x",  "y", "z", "a volume", "a block number",
                                   "a number"};

static double read_number(const struct table *table, char **at, enum column column) {
    char *from = *at + strspn(*at, KR_POINT_BETWEEN), *end;
    double value = strtod(from, &end);
    if (end == from || !isfinite(value) || (*end && !strchr(KR_POINT_BETWEEN, *end)))
        kr_stop(KR_EXIT_INPUT, "%s:%zu: expected %s, found '%.*s'", table->lines.path, table->lines.number,
                what[column], (int)strcspn(from, KR_POINT_BETWEEN), from);
    *at = end;
    return value;
}

/** What stands in a column that is not known: a word of any kind. */
static void read_extra(struct table *table, char **at, size_t k) {
    char *from = *at + strspn(*at, KR_POINT_BETWEEN);
    size_t length = strcspn(from, KR_POINT_BETWEEN);
    int is_flag = length == 1 && (*from == '0' || *from == '1');
    table->is_no_set[k] |= !is_flag;
    table->extra[(table->count - 1) * table->n_extra + k] = is_flag && *from == '1';
    *at = from + length;
}

static void read_row(struct table *table, char *line) {
    size_t room = table->room, extra = 0;
    KR_GROW(table->row, table->count, table->room);
    if (table->room > room)
        table->extra = kr_realloc(table->extra, table->room * table->n_extra, 1);
    double *row = table->row[table->count++];
    char *at = line;
    for (size_t k = 0; k < table->n_columns; k++) {
        if (table->column[k] == UNKNOWN)
            read_extra(table, &at, extra++);
        else
            row[table->column[k]] = read_number(table, &at, table->column[k]);
    }
    at += strspn(at, KR_POINT_BETWEEN);
    if (*at)
        kr_stop(KR_EXIT_INPUT, "%s:%zu: found '%.40s' behind the last of %zu columns", table->lines.path,
                table->lines.number, at, table->n_columns);
    if (!(row[VOLUME] > 0))
        kr_stop(KR_EXIT_INPUT, "%s:%zu: the volume is %g; expected a positive one", table->lines.path,
                table->lines.number, row[VOLUME]);
}

/** Whether a line begins with a name, not a number. "nan" and "inf" are neither. */
static struct table read_table(const char *path) {
    struct table table = {.lines = kr_point_lines_open(path)};
    char *line;
    while ((line = kr_point_lines_next(&table.lines))) {
        if (!table.n_columns && kr_point_lines_is_names(line)) {
            read_names(&table, line);
            continue;
        }
        if (!table.n_columns)
            assume_columns(&table);
        read_row(&table, line);
    }
    kr_point_lines_close(&table.lines);
    if (!table.count)
        kr_stop(KR_EXIT_INPUT, "%s: no nodes found; expected lines of `x y z volume block`",
                path);
    return table;
}

/* ---- nodes ---- */

static int is_plane(const struct table *table) {
    for (size_t i = 1; table->has[Z] && i < table->count; i++)
        if (table->row[i][Z] != table->row[0][Z])
            return 0;
    return 1;
}

static int64_t whole(const struct table *table, size_t i, enum column column) {
    double value = table->row[i][column];
    if (value != round(value) || fabs(value) > 9e15)
        kr_stop(KR_EXIT_INPUT, "%s: row %zu has %g for %s; expected a whole number", table->lines.path,
                i + 1, value, what[column]);
    return (int64_t)value;
}

static void add_blocks(const struct table *table, struct kr_nodes *nodes) {
    int64_t *all = KR_NEW(int64_t, nodes->n), *block = KR_NEW(int64_t, nodes->n);
    for (size_t i = 0; i < nodes->n; i++) {
        all[i] = (int64_t)i;
        block[i] = table->has[BLOCK] ? whole(table, i, BLOCK) : 1;
    }
    kr_nodes_add_set(nodes, nodes->dim == 2 ? "plate" : "body", nodes->n, all, 0);
    for (size_t i = 0; table->has[BLOCK] && i < nodes->n; i++) {
        char *name = kr_text("block_%lld", (long long)block[i]);
        if (!kr_nodes_set(nodes, name)) {
            int64_t *node = KR_NEW(int64_t, nodes->n);
            size_t count = 0;
            for (size_t k = i; k < nodes->n; k++)
                if (block[k] == block[i])
                    node[count++] = (int64_t)k;
            kr_nodes_add_set(nodes, name, count, kr_realloc(node, count, sizeof *node), 0);
        }
        kr_free(name);
    }
    kr_free(block);
}

/** Sets from the columns that are not known; free what was kept of them. */
static void add_extra(struct table *table, struct kr_nodes *nodes) {
    for (size_t e = 0; e < table->n_extra; e++) {
        if (table->is_no_set[e]) {
            kr_warn("%s: the column '%s' is not used: it holds more than 0 and 1", table->lines.path,
                    table->extra_name[e]);
        } else if (!kr_nodes_set(nodes, table->extra_name[e])) {
            int64_t *node = KR_NEW(int64_t, nodes->n);
            size_t count = 0;
            for (size_t i = 0; i < nodes->n; i++)
                if (table->extra[i * table->n_extra + e])
                    node[count++] = (int64_t)i;
            kr_nodes_add_set(nodes, table->extra_name[e], count,
                             kr_realloc(node, count, sizeof *node), 0);
        }
        kr_free(table->extra_name[e]);
    }
    kr_free(table->extra);
}

struct kr_nodes *kr_points_read(const char *path, double unit, double thickness) {
    struct table table = read_table(path);
    int dim = is_plane(&table) ? 2 : 3;
    double volume = unit * unit;
    if (dim == 3 || thickness > 0)
        volume *= dim == 3 ? unit : unit / thickness;
    struct kr_nodes *nodes = kr_nodes_create(dim, table.count);
    for (size_t i = 0; i < table.count; i++) {
        nodes->tag[i] = table.has[ID] ? whole(&table, i, ID) : (int64_t)i + 1;
        nodes->volume[i] = table.row[i][VOLUME] * volume;
        for (int d = 0; d < dim; d++)
            nodes->position[(size_t)dim * i + (size_t)d] = table.row[i][X + d] * unit;
    }
    add_blocks(&table, nodes);
    add_extra(&table, nodes);
    kr_free(table.row);
    kr_convert_spacing(nodes);
    kr_convert_order(nodes);
    char *fault = kr_nodes_fault(nodes);
    if (fault)
        kr_stop(KR_EXIT_INPUT, "%s: %s", path, fault);
    return nodes;
}
