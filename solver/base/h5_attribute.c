/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Attributes of the HDF5 wrapper. Texts are stored with variable length: those of fixed length may
 * not exceed 64 KiB, and a deck's resolved text may.
 */

#include "base/h5_private.h"
#include "base/memory.h"

#include <setjmp.h>
#include <signal.h>

static hid_t text_type(void) {
    hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

/* ---- writing ----------------------------------------------------------------------------- */

static void set_attribute(struct kr_h5 *file, const char *object, const char *name, hid_t type,
                          const void *value) {
    hid_t on, space, attribute;
    herr_t failed;
    kr_h5_quiet();
    on = H5Oopen(file->id, object, H5P_DEFAULT);
    if (on >= 0 && H5Aexists(on, name) > 0)
        H5Adelete(on, name);
    space = H5Screate(H5S_SCALAR);
    attribute = on < 0 ? -1 : H5Acreate2(on, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    failed = attribute < 0 ? -1 : H5Awrite(attribute, type, value);
    H5Sclose(space);
    if (attribute < 0 || H5Aclose(attribute) < 0 || H5Oclose(on) < 0 || failed < 0)
        kr_h5_fail_write(file, kr_text("attribute `%s` of %s", name, object));
}

void kr_h5_set_double(struct kr_h5 *file, const char *object, const char *name, double value) {
    set_attribute(file, object, name, H5T_NATIVE_DOUBLE, &value);
}

void kr_h5_set_int64(struct kr_h5 *file, const char *object, const char *name, int64_t value) {
    set_attribute(file, object, name, H5T_NATIVE_INT64, &value);
}

void kr_h5_set_text(struct kr_h5 *file, const char *object, const char *name, const char *value) {
    hid_t type = text_type();
    set_attribute(file, object, name, type, &value);
    H5Tclose(type);
}

/* ---- reading ----------------------------------------------------------------------------- */

int kr_h5_has_attribute(const struct kr_h5 *file, const char *object, const char *name) {
    return kr_h5_has(file, object) && H5Aexists_by_name(file->id, object, name, H5P_DEFAULT) > 0;
}

_Noreturn static void fail_attribute(const struct kr_h5 *file, const char *object, const char *name,
                                     const char *why) {
    kr_h5_fail_read(file, kr_text("attribute `%s` of %s", name, object), why);
}

/** Open an attribute that is one value of this class. */
static hid_t open_attribute(const struct kr_h5 *file, const char *object, const char *name,
                            H5T_class_t wanted) {
    hid_t attribute, space, type;
    int right;
    kr_h5_quiet();
    if (!kr_h5_has_attribute(file, object, name))
        fail_attribute(file, object, name, "there is none");
    attribute = H5Aopen_by_name(file->id, object, name, H5P_DEFAULT, H5P_DEFAULT);
    if (attribute < 0)
        fail_attribute(file, object, name, "the file is damaged");
    space = H5Aget_space(attribute);
    type = H5Aget_type(attribute);
    right = H5Sget_simple_extent_npoints(space) == 1 &&
            (H5Tget_class(type) == wanted ||
             (wanted == H5T_FLOAT && H5Tget_class(type) == H5T_INTEGER));
    H5Tclose(type);
    H5Sclose(space);
    if (!right)
        fail_attribute(file, object, name,
                       wanted == H5T_STRING ? "it is no text" : "it is no number of that kind");
    return attribute;
}

double kr_h5_get_double(const struct kr_h5 *file, const char *object, const char *name) {
    hid_t attribute = open_attribute(file, object, name, H5T_FLOAT);
    double value = 0;
    if (H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) < 0)
        fail_attribute(file, object, name, "the file is damaged");
    H5Aclose(attribute);
    return value;
}

int64_t kr_h5_get_int64(const struct kr_h5 *file, const char *object, const char *name) {
    hid_t attribute = open_attribute(file, object, name, H5T_INTEGER);
    int64_t value = 0;
    if (H5Aread(attribute, H5T_NATIVE_INT64, &value) < 0)
        fail_attribute(file, object, name, "the file is damaged");
    H5Aclose(attribute);
    return value;
}

static sigjmp_buf fallen;

static void fall(int number) {
    (void)number;
    siglongjmp(fallen, 1);
}

/** Read a text of any length; 0 where that fails. HDF5 1.10 follows the place of such a text in a damaged file to where
 *  there is no memory; whoever reads it stops then, so nothing is left to be put right. */
static int read_guarded(hid_t attribute, hid_t type, char **text) {
    struct sigaction before, guard = {.sa_handler = fall};
    volatile int done = 0;
    sigaction(SIGSEGV, &guard, &before);
    if (!sigsetjmp(fallen, 1))
        done = H5Aread(attribute, type, text) >= 0;
    sigaction(SIGSEGV, &before, NULL);
    return done;
}

/** A text of any length, as we write them. */
static char *read_variable(hid_t attribute, hid_t type) {
    char *text = NULL, *copy;
    if (!read_guarded(attribute, type, &text) || !text)
        return NULL;
    copy = kr_text_copy(text);
    H5free_memory(text);
    return copy;
}

/** A text of fixed length, as other programs write them: padded, perhaps without a final 0. */
static char *read_fixed(hid_t attribute, hid_t type) {
    char *text = kr_alloc(H5Tget_size(type) + 1, 1);
    if (H5Aread(attribute, type, text) >= 0)
        return text;
    return kr_free(text);
}

char *kr_h5_get_text(const struct kr_h5 *file, const char *object, const char *name) {
    hid_t attribute = open_attribute(file, object, name, H5T_STRING);
    hid_t type = H5Aget_type(attribute);
    char *text =
        H5Tis_variable_str(type) > 0 ? read_variable(attribute, type) : read_fixed(attribute, type);
    if (!text)
        fail_attribute(file, object, name, "the file is damaged");
    H5Tclose(type);
    H5Aclose(attribute);
    return text;
}
