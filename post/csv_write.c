/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tables are written; see csv_write.h.
 */
#include "csv_write.h"

#include <math.h>

#include "base/memory.h"

struct kr_csv_writer kr_csv_begin(const char *path, const char *columns) {
    struct kr_file whole = kr_file_begin(kr_text_copy(path));
    fprintf(whole.to, "%s\n", columns);
    return (struct kr_csv_writer){whole.to, whole};
}

void kr_csv_finish(struct kr_csv_writer *table) {
    kr_file_end(&table->whole);
}

void kr_csv_put(struct kr_csv_writer *table, double value) {
    if (isnan(value))
        fprintf(table->file, ",");
    else
        fprintf(table->file, ",%.9g", value);
}
