/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Files that are whole or not there, files that grow, folders. See file.h.
 */
#include "base/file.h"

#include "base/error.h"
#include "base/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* What was left there by a run that was killed goes first, so that a link is removed and not followed. */
struct kr_file kr_file_begin(char *path) {
    struct kr_file file = {path, kr_text("%s.tmp", path), NULL};
    unlink(file.beside);
    int descriptor = open(file.beside, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    file.to = descriptor < 0 ? NULL : fdopen(descriptor, "wb");
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

FILE *kr_file_grow(const char *path, long bytes) {
    int descriptor = open(path, O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno == ELOOP)
        kr_stop(KR_EXIT_STORAGE, "%s is a link, and results are not written through links; remove it",
                path);
    off_t size = descriptor < 0 ? 0 : lseek(descriptor, 0, SEEK_END);
    if (descriptor >= 0 && (bytes < 0 || size < bytes))
        kr_stop(KR_EXIT_STORAGE, "%s has %lld bytes, and the checkpoint was made when it had %ld; bring it back, or "
                                 "run without --resume", path, (long long)size, bytes);
    FILE *file = descriptor < 0 || ftruncate(descriptor, bytes) ? NULL : fdopen(descriptor, "r+");
    if (!file || fseek(file, bytes, SEEK_SET))
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s", path, strerror(errno));
    return file;
}

long kr_file_settle(FILE *file, const char *path) {
    if (fflush(file) || fsync(fileno(file)))
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s; free some space and run again", path, strerror(errno));
    return ftell(file);
}

static void make(const char *path) {
    if (mkdir(path, 0777) && errno != EEXIST)
        kr_stop(KR_EXIT_STORAGE, "the folder %s cannot be made: %s", path, strerror(errno));
}

void kr_folder_make(const char *path) {
    char *part = kr_text_copy(path);
    for (char *slash = part + 1;; slash++) {
        slash += strcspn(slash, "/");
        int last = !*slash;
        *slash = 0;
        make(part);
        if (last)
            break;
        *slash = '/';
    }
    struct stat about;
    if (stat(path, &about) || !S_ISDIR(about.st_mode))
        kr_stop(KR_EXIT_STORAGE, "%s, where results are to go, is no folder", path);
    kr_free(part);
}

void kr_folder_make_within(const char *path) {
    struct stat about;
    make(path);
    if (lstat(path, &about) || !S_ISDIR(about.st_mode))
        kr_stop(KR_EXIT_STORAGE,
                "%s is no folder or a link to one, and results are not written through links; remove it",
                path);
}
