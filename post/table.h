/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A table in a CSV file (RFC 4180): the first line names the columns, fields with commas stand in
 * quotes, `#` begins a line that is a comment, blanks around a field do not count.
 */
#ifndef KR_TABLE_H
#define KR_TABLE_H

#include <stddef.h>

/** No such column. */
#define KR_TABLE_NONE ((size_t)-1)

struct kr_table {
    size_t n_columns, n_rows;
    char **name;  /* (n_columns) with the unit, "time [s]" */
    char **cell;  /* (n_rows x n_columns) "" where a field is empty */
    size_t *line; /* (n_rows) of the file, from 1 */
};

/** Read a table; stops (exit 2) where the file cannot be read, has no header, a quote does not end,
 *  or a row has more or fewer fields than the header. Owned by the caller. */
struct kr_table *kr_table_read(const char *path);
void kr_table_free(struct kr_table *table);

/** Number of the column of this name, its unit left out ("time"); KR_TABLE_NONE if none. */
size_t kr_table_column(const struct kr_table *table, const char *name);

const char *kr_table_cell(const struct kr_table *table, size_t row, size_t column);

#endif
