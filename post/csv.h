/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A table in a CSV file (RFC 4180): the first line names the columns, fields with commas stand in
 * quotes, `#` begins a line that is a comment, blanks around a field do not count.
 */
#ifndef KR_CSV_H
#define KR_CSV_H

#include <stddef.h>

/** No such column. */
#define KR_CSV_NONE ((size_t)-1)

struct kr_csv {
    size_t n_columns, n_rows;
    char **name;  /* (n_columns) with the unit, "time [s]" */
    char **cell;  /* (n_rows x n_columns) "" where a field is empty */
    size_t *line; /* (n_rows) of the file, from 1 */
};

/** Read a table; stops (exit 2) where the file cannot be read, has no header, a quote does not end,
 *  or a row has more or fewer fields than the header. Owned by the caller. */
struct kr_csv *kr_csv_read(const char *path);
void kr_csv_free(struct kr_csv *table);

/** Number of the column of this name, its unit left out ("time"); KR_CSV_NONE if none. */
size_t kr_csv_column(const struct kr_csv *table, const char *name);

const char *kr_csv_cell(const struct kr_csv *table, size_t row, size_t column);

#endif
