/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A table as a CSV file that appears whole or not at all.
 */
#ifndef KR_CSV_WRITE_H
#define KR_CSV_WRITE_H

#include "base/file.h"

struct kr_csv_writer {
    FILE *file; /* to print to */
    struct kr_file whole;
};

/** Begin a table beside its place, with a line of column names; stops (exit 3) where it cannot. */
struct kr_csv_writer kr_csv_begin(const char *path, const char *columns);

/** Give it its name; stops (exit 3) where it could not be written. */
void kr_csv_finish(struct kr_csv_writer *table);

/** A comma, and the number unless it is not one. */
void kr_csv_put(struct kr_csv_writer *table, double value);

#endif
