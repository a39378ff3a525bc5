/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Files and groups of the HDF5 wrapper (arrays: h5_array.c, attributes: h5_attribute.c).
 *
 * Three habits of the library are put right here, once:
 *   - it prints its own traces: switched off, each failure becomes one sentence of ours;
 *   - it closes files again at exit, and after a failed write tries for ever: switched off too,
 *     every file is closed by us;
 *   - it locks files, which forbids looking at a running run and fails on some network disks:
 *     off, unless the user's HDF5_USE_FILE_LOCKING says otherwise.
 */
#include "base/h5.h"

#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "base/h5_private.h"
#include "base/memory.h"

void kr_h5_quiet(void) {
    static int done;
    if (!done) {
        setenv("HDF5_USE_FILE_LOCKING", "FALSE", 0);
        H5dont_atexit();
        H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
        done = 1;
    }
    errno = 0; /* so that a reason found afterwards is that of the call that failed */
}

void kr_h5_fail_write(const struct kr_h5 *file, const char *name) {
    int reason = errno;
    H5Fclose(file->id);
    if (file->beside)
        unlink(file->beside);
    kr_stop(KR_EXIT_STORAGE, "cannot write %s%s%s: %s", file->path, *name ? ", " : "", name,
            reason ? strerror(reason) : "HDF5 refuses, without a reason of the system");
}

void kr_h5_fail_read(const struct kr_h5 *file, const char *name, const char *why) {
    kr_stop(KR_EXIT_INPUT, "%s: cannot read %s: %s", file->path, name, why);
}

static struct kr_h5 *new_file(const char *path, hid_t id, char *beside) {
    struct kr_h5 *file = kr_alloc(1, sizeof *file);
    file->id = id;
    file->path = kr_text_copy(path);
    file->beside = beside;
    return file;
}

static void free_file(struct kr_h5 *file) {
    kr_free(file->path);
    kr_free(file->beside);
    kr_free(file);
}

/* ---- opening ----------------------------------------------------------------------------- */

/** The reason why a file that HDF5 refuses cannot be read, or NULL if it looks like HDF5. */
static const char *plain_fault(const char *path) {
    struct stat about;
    if (stat(path, &about) != 0)
        return strerror(errno);
    if (S_ISDIR(about.st_mode))
        return "it is a folder";
    if (access(path, R_OK) != 0)
        return strerror(errno);
    if (about.st_size == 0)
        return "it is empty";
    if (H5Fis_hdf5(path) <= 0)
        return "it is no HDF5 file";
    return NULL;
}

static void check_format(const struct kr_h5 *file, const char *format, int64_t version) {
    char *found;
    int64_t found_version;
    if (!kr_h5_has_attribute(file, "/", "format"))
        kr_stop(KR_EXIT_INPUT,
                "%s is no file of Kirsch: it has no attribute `format`; expected "
                "\"%s\"",
                file->path, format);
    found = kr_h5_get_text(file, "/", "format");
    if (strcmp(found, format) != 0)
        kr_stop(KR_EXIT_INPUT, "%s is a file of the kind \"%s\"; expected \"%s\"", file->path,
                found, format);
    kr_free(found);
    found_version = kr_h5_get_int64(file, "/", "version");
    if (found_version < 1 || found_version > version)
        kr_stop(KR_EXIT_INPUT,
                "%s is written in version %lld of the format \"%s\"; this program "
                "reads up to version %lld",
                file->path, (long long)found_version, format, (long long)version);
}

struct kr_h5 *kr_h5_open(const char *path, const char *format, int64_t version) {
    struct kr_h5 *file;
    const char *fault;
    hid_t id;
    kr_h5_quiet();
    fault = plain_fault(path);
    if (fault)
        kr_stop(KR_EXIT_INPUT, "cannot open %s: %s", path, fault);
    id = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (id < 0)
        kr_stop(KR_EXIT_INPUT, "cannot open %s: it is cut short or damaged; make it again", path);
    file = new_file(path, id, NULL);
    check_format(file, format, version);
    return file;
}

/* ---- creating ---------------------------------------------------------------------------- */

struct kr_h5 *kr_h5_create(const char *path, const char *format, int64_t version) {
    struct kr_h5 *file;
    char *beside = kr_text("%s.tmp", path);
    hid_t id;
    kr_h5_quiet();
    unlink(beside); /* left by a run that was killed; a link there is not followed */
    errno = 0;
    id = H5Fcreate(beside, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    if (id < 0)
        kr_stop(KR_EXIT_STORAGE, "cannot create %s: %s", beside,
                errno ? strerror(errno) : "HDF5 refuses");
    file = new_file(path, id, beside);
    kr_h5_set_text(file, "/", "format", format);
    kr_h5_set_int64(file, "/", "version", version);
    return file;
}

/* ---- keeping ----------------------------------------------------------------------------- */

/** Bring a closed file, or a folder, to the disk. */
static int sync_path(const char *path) {
    int descriptor = open(path, O_RDONLY);
    int result;
    if (descriptor < 0)
        return -1;
    result = fsync(descriptor);
    close(descriptor);
    return result;
}

/** Give the finished file its name: the file is synced before, its folder after. */
static int settle(const struct kr_h5 *file) {
    char *copy = kr_text_copy(file->path);
    int failed = sync_path(file->beside) != 0 || rename(file->beside, file->path) != 0;
    if (!failed)
        sync_path(dirname(copy)); /* some file systems cannot sync a folder: no fault */
    kr_free(copy);
    return failed;
}

void kr_h5_close(struct kr_h5 *file) {
    if (!file)
        return;
    kr_h5_quiet();
    if (file->beside && H5Fflush(file->id, H5F_SCOPE_GLOBAL) < 0)
        kr_h5_fail_write(file, ""); /* a full disk is best told before HDF5 closes on it */
    if (H5Fclose(file->id) < 0 || (file->beside && settle(file))) {
        file->id = H5I_INVALID_HID;
        kr_h5_fail_write(file, "");
    }
    free_file(file);
}

void kr_h5_discard(struct kr_h5 *file) {
    H5Fclose(file->id);
    if (file->beside)
        unlink(file->beside);
    free_file(file);
}

const char *kr_h5_path(const struct kr_h5 *file) {
    return file->path;
}

void kr_h5_pack(struct kr_h5 *file, int packed) {
    file->packed = packed;
}

/* ---- groups ------------------------------------------------------------------------------ */

int kr_h5_has(const struct kr_h5 *file, const char *name) {
    char *path = kr_text_copy(name);
    int there = 1;
    kr_h5_quiet();
    /* HDF5 answers for the last link only, and fails where one before it is missing. */
    for (char *slash = path + 1; there && *path && slash; slash = slash ? slash + 1 : NULL) {
        slash = strchr(slash, '/');
        if (slash)
            *slash = 0;
        there = strcmp(path, "/") == 0 || H5Lexists(file->id, path, H5P_DEFAULT) > 0;
        if (slash)
            *slash = '/';
        else
            break;
    }
    kr_free(path);
    return there;
}

hid_t kr_h5_links(void) {
    hid_t list = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_create_intermediate_group(list, 1);
    return list;
}

void kr_h5_group(struct kr_h5 *file, const char *name) {
    hid_t links, group;
    if (kr_h5_has(file, name))
        return;
    links = kr_h5_links();
    group = H5Gcreate2(file->id, name, links, H5P_DEFAULT, H5P_DEFAULT);
    H5Pclose(links);
    if (group < 0)
        kr_h5_fail_write(file, name);
    H5Gclose(group);
}

void kr_h5_link(struct kr_h5 *file, const char *name, const char *other) {
    hid_t links = kr_h5_links();
    herr_t failed = H5Lcreate_external(other, "/", file->id, name, links, H5P_DEFAULT);
    H5Pclose(links);
    if (failed < 0)
        kr_h5_fail_write(file, name);
}

void kr_h5_remove(struct kr_h5 *file, const char *name) {
    if (kr_h5_has(file, name) && H5Ldelete(file->id, name, H5P_DEFAULT) < 0)
        kr_h5_fail_write(file, name);
}

struct name_list {
    size_t count, room;
    char **name;
};

static herr_t add_name(hid_t group, const char *name, const H5L_info_t *info, void *list) {
    struct name_list *names = list;
    (void)group;
    (void)info;
    KR_GROW(names->name, names->count, names->room);
    names->name[names->count++] = kr_text_copy(name);
    return 0;
}

char **kr_h5_list(const struct kr_h5 *file, const char *group, size_t *count) {
    struct name_list names = {0, 0, NULL};
    hsize_t from = 0;
    if (kr_h5_has(file, group)) {
        hid_t id = H5Gopen2(file->id, group, H5P_DEFAULT);
        if (id < 0 || H5Literate(id, H5_INDEX_NAME, H5_ITER_INC, &from, add_name, &names) < 0)
            kr_h5_fail_read(file, group, "it is no group, or damaged");
        H5Gclose(id);
    }
    *count = names.count;
    return names.name ? names.name : kr_alloc(0, sizeof *names.name);
}
