/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tables; see table.h.
 */
#include "table.h"

#include <math.h>

#include "base/memory.h"

struct kr_table kr_table_begin(const char *path, const char *columns) {
    struct kr_file whole = kr_file_begin(kr_text_copy(path));
    fprintf(whole.to, "%s\n", columns);
    return (struct kr_table){whole.to, whole};
}

void kr_table_finish(struct kr_table *table) {
    kr_file_end(&table->whole);
}

void kr_table_put(struct kr_table *table, double value) {
    if (isnan(value))
        fprintf(table->file, ",");
    else
        fprintf(table->file, ",%.9g", value);
}
