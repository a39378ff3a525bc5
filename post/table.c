/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tables; see table.h.
 */
#include "table.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "base/memory.h"

struct kr_table kr_table_begin(const char *path, const char *columns) {
    struct kr_table table = {NULL, kr_text_copy(path), kr_text("%s.tmp", path)};
    table.file = fopen(table.beside, "w");
    if (!table.file)
        kr_stop(KR_EXIT_STORAGE, "cannot create %s: %s", table.beside, strerror(errno));
    fprintf(table.file, "%s\n", columns);
    return table;
}

void kr_table_finish(struct kr_table *table) {
    int failed = fflush(table->file) != 0 || ferror(table->file) || fsync(fileno(table->file));
    failed |= fclose(table->file) != 0;
    if (failed || rename(table->beside, table->path) != 0) {
        int reason = errno;
        unlink(table->beside);
        kr_stop(KR_EXIT_STORAGE, "cannot write %s: %s", table->path, strerror(reason));
    }
    kr_free(table->path);
    kr_free(table->beside);
}

void kr_table_put(struct kr_table *table, double value) {
    if (isnan(value))
        fprintf(table->file, ",");
    else
        fprintf(table->file, ",%.9g", value);
}
