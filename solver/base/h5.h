/* SPDX-License-Identifier: BSD-3-Clause
 *
 * HDF5 files, with care: every failure is one sentence that names the file and the dataset.
 *
 * Two ways to hold a file:
 *   kr_h5_open     to read a finished file
 *   kr_h5_create   to write one that appears whole or not at all: it grows as PATH.tmp and takes its
 *                  name in kr_h5_close, after all of it has reached the disk
 *
 * Names are paths in the file, "/step/000120/Damage"; groups on the way are made. Arrays have rows
 * and columns; columns 0 is an array of rank 1. Reading converts between widths (float32 to
 * double), never between numbers with and without a fraction.
 *
 * Stops: exit 2 where a file to read is not as it should be; exit 3 where one cannot
 * be written (what was written as PATH.tmp is then removed).
 */
#ifndef KR_H5_H
#define KR_H5_H

#include <stddef.h>
#include <stdint.h>

struct kr_h5; /* Opaque. Implemented in h5.c. */

/** Open a file to read. `format` and `version` must be those of its root attributes; a file written
 *  by a later version is refused. */
struct kr_h5 *kr_h5_open(const char *path, const char *format, int64_t version);

/** Begin a file that appears under its name when it is closed. Sets the two attributes. */
struct kr_h5 *kr_h5_create(const char *path, const char *format, int64_t version);

/** Close; a file of kr_h5_create is synced and takes its name. NULL is allowed. */
void kr_h5_close(struct kr_h5 *file);

/** Close a file of kr_h5_create without keeping it. */
void kr_h5_discard(struct kr_h5 *file);

const char *kr_h5_path(const struct kr_h5 *file);

/** From now on, compress the arrays written (1: shuffle and deflate at level 1) or do not (0, as it
 *  is at first). Worth it for fields of float32, hardly for coordinates. */
void kr_h5_pack(struct kr_h5 *file, int packed);

/** Make a group (to hang attributes on); one that exists is kept. */
void kr_h5_group(struct kr_h5 *file, const char *name);

/** Make the name stand for the root of another HDF5 file; its path is taken from this file's folder,
 *  and it need not be there yet. */
void kr_h5_link(struct kr_h5 *file, const char *name, const char *other);

/** Whether there is a group or array of this name. */
int kr_h5_has(const struct kr_h5 *file, const char *name);

/** Remove a group with all that is in it, or an array. The space is not given back. */
void kr_h5_remove(struct kr_h5 *file, const char *name);

/** Names in a group, sorted; the list and each name are owned by the caller. A missing group is an
 *  empty one. */
char **kr_h5_list(const struct kr_h5 *file, const char *group, size_t *count);

/** Write an array (rows x columns, row by row). One that exists is replaced; in place where shape
 *  and type are the same. `float`: stored as float32. */
void kr_h5_write_double(struct kr_h5 *file, const char *name, size_t rows, size_t columns,
                        const double *data);
void kr_h5_write_float(struct kr_h5 *file, const char *name, size_t rows, size_t columns,
                       const double *data);
void kr_h5_write_int32(struct kr_h5 *file, const char *name, size_t rows, size_t columns,
                       const int32_t *data);
void kr_h5_write_int64(struct kr_h5 *file, const char *name, size_t rows, size_t columns,
                       const int64_t *data);

/** Shape of an array; columns 0 if it has rank 1. Stops where there is none. */
void kr_h5_shape(const struct kr_h5 *file, const char *name, size_t *rows, size_t *columns);

/** Read an array of just this shape; owned by the caller (kr_free). */
double *kr_h5_read_double(const struct kr_h5 *file, const char *name, size_t rows, size_t columns);
int32_t *kr_h5_read_int32(const struct kr_h5 *file, const char *name, size_t rows, size_t columns);
int64_t *kr_h5_read_int64(const struct kr_h5 *file, const char *name, size_t rows, size_t columns);

/** Attributes of the group or array `object` ("/": the file); one that exists is replaced. */
void kr_h5_set_double(struct kr_h5 *file, const char *object, const char *name, double value);
void kr_h5_set_int64(struct kr_h5 *file, const char *object, const char *name, int64_t value);
void kr_h5_set_text(struct kr_h5 *file, const char *object, const char *name, const char *value);

/** Whether the object is there and has the attribute. */
int kr_h5_has_attribute(const struct kr_h5 *file, const char *object, const char *name);

/** Read an attribute; the text is owned by the caller (kr_free). */
double kr_h5_get_double(const struct kr_h5 *file, const char *object, const char *name);
int64_t kr_h5_get_int64(const struct kr_h5 *file, const char *object, const char *name);
char *kr_h5_get_text(const struct kr_h5 *file, const char *object, const char *name);

#endif
