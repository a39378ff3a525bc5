/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Files that are whole or not there. See file.h.
 */
#include "file.h"

#include "base/error.h"
#include "base/memory.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

struct kr_file kr_file_begin(char *path) {
    struct kr_file file = {path, kr_text("%s.tmp", path), NULL};
    file.to = fopen(file.beside, "wb");
    if (!file.to)
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s", file.beside, strerror(errno));
    return file;
}

void kr_file_end(struct kr_file *file) {
    int failed = ferror(file->to) || fflush(file->to) || fsync(fileno(file->to));
    if (fclose(file->to) || failed || rename(file->beside, file->path)) {
        int why = errno;
        unlink(file->beside);
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s; free some space and run again",
                file->path, strerror(why));
    }
    kr_free(file->path);
    kr_free(file->beside);
}
