/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Arrays of the HDF5 wrapper. Times of creation are not stored: equal results give equal files.
 */

#include "base/h5_private.h"
#include "base/memory.h"

/* 2^16 numbers a chunk: 256 KiB of float32, large enough to compress well, small enough for the
 * library's cache of 1 MiB. */
enum { CHUNK = 1 << 16 };

/** What is to be written: numbers in memory of type `memory`, stored as `stored`. */
struct array {
    const char *name;
    hsize_t size[2]; /* rows, columns */
    int rank;
    hid_t memory, stored;
    const void *data;
};

static struct array array_of(const char *name, size_t rows, size_t columns, const void *data,
                             hid_t memory, hid_t stored) {
    struct array array = {name, {rows, columns}, columns ? 2 : 1, memory, stored, data};
    return array;
}

/** How a new array is laid out: chunks if it is packed, else in one piece. */
static hid_t layout(const struct array *array, int packed) {
    hid_t list = H5Pcreate(H5P_DATASET_CREATE);
    hsize_t chunk[2] = {array->size[0], array->size[1]};
    hsize_t most = array->rank == 2 && CHUNK / chunk[1] ? CHUNK / chunk[1] : CHUNK;
    H5Pset_obj_track_times(list, 0);
    if (!packed || array->size[0] == 0)
        return list;
    if (chunk[0] > most)
        chunk[0] = most;
    H5Pset_chunk(list, array->rank, chunk);
    H5Pset_shuffle(list);
    H5Pset_deflate(list, 1);
    return list;
}

static hid_t create_array(struct kr_h5 *file, const struct array *array) {
    hid_t space = H5Screate_simple(array->rank, array->size, NULL);
    hid_t links = kr_h5_links();
    hid_t list = layout(array, file->packed);
    hid_t set = H5Dcreate2(file->id, array->name, array->stored, space, links, list, H5P_DEFAULT);
    H5Pclose(list);
    H5Pclose(links);
    H5Sclose(space);
    if (set < 0)
        kr_h5_fail_write(file, array->name);
    return set;
}

/** Rows and columns of an open array; 0 if its rank is neither 1 nor 2. */
static int shape_of(hid_t set, hsize_t size[2]) {
    hid_t space = H5Dget_space(set);
    int rank = H5Sget_simple_extent_ndims(space);
    size[0] = size[1] = 0;
    if (rank == 1 || rank == 2)
        H5Sget_simple_extent_dims(space, size, NULL);
    H5Sclose(space);
    return rank == 1 || rank == 2 ? rank : 0;
}

/** Open the array if it has this shape and type already; else remove it. Negative if there is none
 *  now. */
static hid_t open_same(struct kr_h5 *file, const struct array *array) {
    hsize_t size[2];
    hid_t set, type;
    int same;
    if (!kr_h5_has(file, array->name))
        return -1;
    set = H5Dopen2(file->id, array->name, H5P_DEFAULT);
    type = set < 0 ? -1 : H5Dget_type(set);
    same = set >= 0 && shape_of(set, size) == array->rank && size[0] == array->size[0] &&
           (array->rank == 1 || size[1] == array->size[1]) && H5Tequal(type, array->stored) > 0;
    if (type >= 0)
        H5Tclose(type);
    if (same)
        return set;
    if (set >= 0)
        H5Dclose(set);
    kr_h5_remove(file, array->name);
    return -1;
}

static void write_array(struct kr_h5 *file, const struct array *array) {
    hid_t set;
    herr_t failed = 0;
    kr_h5_quiet();
    set = open_same(file, array);
    if (set < 0)
        set = create_array(file, array);
    if (array->size[0])
        failed = H5Dwrite(set, array->memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, array->data);
    if (H5Dclose(set) < 0 || failed < 0)
        kr_h5_fail_write(file, array->name);
}

void kr_h5_write_double(struct kr_h5 *file, const char *name, size_t rows, size_t columns,
                        const double *data) {
    struct array array = array_of(name, rows, columns, data, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE);
    write_array(file, &array);
}

void kr_h5_write_float(struct kr_h5 *file, const char *name, size_t rows, size_t columns,
                       const double *data) {
    struct array array = array_of(name, rows, columns, data, H5T_NATIVE_DOUBLE, H5T_IEEE_F32LE);
    write_array(file, &array);
}

void kr_h5_write_int32(struct kr_h5 *file, const char *name, size_t rows, size_t columns,
                       const int32_t *data) {
    struct array array = array_of(name, rows, columns, data, H5T_NATIVE_INT32, H5T_STD_I32LE);
    write_array(file, &array);
}

void kr_h5_write_int64(struct kr_h5 *file, const char *name, size_t rows, size_t columns,
                       const int64_t *data) {
    struct array array = array_of(name, rows, columns, data, H5T_NATIVE_INT64, H5T_STD_I64LE);
    write_array(file, &array);
}

/* ---- reading ----------------------------------------------------------------------------- */

/* A damaged file may tell of more numbers than any machine holds. Deflate packs to a thousandth at best. */
static int has_room(hid_t set, const hsize_t size[2]) {
    hid_t file = H5Iget_file_id(set), stored = H5Dget_type(set);
    hsize_t bytes = 0;
    double wanted = (double)size[0] * (double)(size[1] ? size[1] : 1) * (double)H5Tget_size(stored);
    H5Fget_filesize(file, &bytes);
    H5Tclose(stored);
    H5Fclose(file);
    return wanted <= 1100.0 * (double)bytes;
}

static hid_t open_to_read(const struct kr_h5 *file, const char *name, hsize_t size[2]) {
    hid_t set = -1;
    if (!kr_h5_has(file, name))
        kr_h5_fail_read(file, name, "there is no such array");
    set = H5Dopen2(file->id, name, H5P_DEFAULT);
    if (set < 0)
        kr_h5_fail_read(file, name, "it is no array, or damaged");
    if (!shape_of(set, size))
        kr_h5_fail_read(file, name, "it has neither one nor two dimensions");
    if (!has_room(set, size))
        kr_h5_fail_read(file, name, "it tells of more numbers than the file can hold: it is damaged; make it again");
    return set;
}

void kr_h5_shape(const struct kr_h5 *file, const char *name, size_t *rows, size_t *columns) {
    hsize_t size[2];
    hid_t set;
    kr_h5_quiet();
    set = open_to_read(file, name, size);
    H5Dclose(set);
    *rows = size[0];
    *columns = size[1];
}

/** Whether numbers of the stored type go into the type in memory without harm. */
static int fits(hid_t set, hid_t memory) {
    hid_t stored = H5Dget_type(set);
    H5T_class_t kind = H5Tget_class(stored);
    int fit = kind == H5Tget_class(memory) && H5Tget_size(stored) <= H5Tget_size(memory);
    if (kind == H5T_INTEGER && H5Tget_class(memory) == H5T_FLOAT)
        fit = H5Tget_size(stored) <= 4; /* whole numbers of 32 bits are exact in a double */
    H5Tclose(stored);
    return fit;
}

static void *read_array(const struct kr_h5 *file, const char *name, size_t rows, size_t columns,
                        hid_t memory) {
    hsize_t size[2];
    hid_t set;
    void *data;
    kr_h5_quiet();
    set = open_to_read(file, name, size);
    if (size[0] != rows || size[1] != columns)
        kr_h5_fail_read(file, name,
                        kr_text("its shape is %zu x %zu; expected %zu x %zu", (size_t)size[0],
                                (size_t)size[1], rows, columns));
    if (!fits(set, memory))
        kr_h5_fail_read(file, name, "its numbers are of another type than expected");
    data = kr_alloc(rows * (columns ? columns : 1), H5Tget_size(memory));
    if (rows && H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
        kr_h5_fail_read(file, name, "the file is cut short or damaged; make it again");
    H5Dclose(set);
    return data;
}

double *kr_h5_read_double(const struct kr_h5 *file, const char *name, size_t rows, size_t columns) {
    return read_array(file, name, rows, columns, H5T_NATIVE_DOUBLE);
}

int32_t *kr_h5_read_int32(const struct kr_h5 *file, const char *name, size_t rows, size_t columns) {
    return read_array(file, name, rows, columns, H5T_NATIVE_INT32);
}

int64_t *kr_h5_read_int64(const struct kr_h5 *file, const char *name, size_t rows, size_t columns) {
    return read_array(file, name, rows, columns, H5T_NATIVE_INT64);
}
