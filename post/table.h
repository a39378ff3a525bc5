/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A text file that appears whole or not at all.
 */
#ifndef KR_TABLE_H
#define KR_TABLE_H

#include "base/file.h"

struct kr_table {
    FILE *file; /* to print to */
    struct kr_file whole;
};

/** Begin a table beside its place, with a line of column names; stops (exit 3) where it cannot. */
struct kr_table kr_table_begin(const char *path, const char *columns);

/** Give it its name; stops (exit 3) where it could not be written. */
void kr_table_finish(struct kr_table *table);

/** A comma, and the number unless it is not one. */
void kr_table_put(struct kr_table *table, double value);

#endif
