/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The HDF5 wrapper: round trips, growing arrays, and each way in which a file can be wrong.
 */
#include "test.h"
#include "folder.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "base/error.h"
#include "base/h5.h"

static char path[64];

static int set_up(void **state) {
    if (make_folder(state))
        return -1;
    snprintf(path, sizeof path, "%s/a.h5", folder);
    return 0;
}

static const double numbers[6] = {0.1, -2.5e-9, 3.25e12, 1 / 3.0, INFINITY, -1};

static void test_round_trip(void **state) {
    const int32_t narrow[4] = {1, -2, INT32_MAX, INT32_MIN};
    const int64_t wide[3] = {1, INT64_MAX, INT64_MIN};
    size_t rows, columns;
    struct kr_h5 *file = kr_h5_create(path, "kirsch test", 3);
    (void)state;
    kr_h5_write_double(file, "/a/b/double", 3, 2, numbers);
    kr_h5_write_int32(file, "/narrow", 2, 2, narrow);
    kr_h5_write_int64(file, "/wide", 3, 0, wide);
    kr_h5_write_double(file, "/none", 0, 2, NULL);
    kr_h5_pack(file, 1);
    kr_h5_write_float(file, "/single", 6, 0, numbers);
    kr_h5_write_float(file, "/empty", 0, 0, NULL);
    kr_h5_close(file);

    file = kr_h5_open(path, "kirsch test", 3);
    double *d = kr_h5_read_double(file, "/a/b/double", 3, 2);
    double *s = kr_h5_read_double(file, "/single", 6, 0);
    int32_t *n = kr_h5_read_int32(file, "/narrow", 2, 2);
    int64_t *n_wide = kr_h5_read_int64(file, "/narrow", 2, 2);
    int64_t *w = kr_h5_read_int64(file, "/wide", 3, 0);
    assert_memory_equal(d, numbers, sizeof numbers);
    assert_memory_equal(n, narrow, sizeof narrow);
    assert_memory_equal(w, wide, sizeof wide);
    for (int i = 0; i < 6; i++)
        assert_true(s[i] == (double)(float)numbers[i]);
    for (int i = 0; i < 4; i++)
        assert_int_equal(n_wide[i], narrow[i]);
    kr_h5_shape(file, "/none", &rows, &columns);
    assert_int_equal(rows, 0);
    assert_int_equal(columns, 2);
    kr_h5_shape(file, "/single", &rows, &columns);
    assert_int_equal(rows, 6);
    assert_int_equal(columns, 0);
    kr_free(d);
    kr_free(s);
    kr_free(n);
    kr_free(n_wide);
    kr_free(w);
    kr_h5_close(file);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void test_attributes(void **state) {
    enum { LONG = 200000 }; /* beyond the 64 KiB of a plain attribute */
    char *text = malloc(LONG + 1);
    struct kr_h5 *file = kr_h5_create(path, "kirsch test", 1);
    (void)state;
    memset(text, 'x', LONG);
    text[LONG] = 0;
    kr_h5_set_text(file, "/", "deck", text);
    kr_h5_set_text(file, "/", "deck_hash", "");
    kr_h5_group(file, "/step/000012");
    kr_h5_set_double(file, "/step/000012", "time", 1.25e-7);
    kr_h5_set_int64(file, "/step/000012", "step", 11);
    kr_h5_set_int64(file, "/step/000012", "step", 12);
    kr_h5_close(file);

    file = kr_h5_open(path, "kirsch test", 1);
    char *long_text = kr_h5_get_text(file, "/", "deck");
    char *empty = kr_h5_get_text(file, "/", "deck_hash");
    assert_string_equal(long_text, text);
    assert_string_equal(empty, "");
    assert_true(kr_h5_get_double(file, "/step/000012", "time") == 1.25e-7);
    assert_int_equal(kr_h5_get_int64(file, "/step/000012", "step"), 12);
    assert_true(kr_h5_has_attribute(file, "/", "deck"));
    assert_false(kr_h5_has_attribute(file, "/", "duck"));
    assert_false(kr_h5_has_attribute(file, "/missing/group", "deck"));
    kr_free(long_text);
    kr_free(empty);
    kr_h5_close(file);
    free(text);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void test_names(void **state) {
    size_t count;
    struct kr_h5 *file = kr_h5_create(path, "kirsch test", 1);
    (void)state;
    kr_h5_write_double(file, "/sets/top", 1, 0, numbers);
    kr_h5_write_double(file, "/sets/left", 1, 0, numbers);
    kr_h5_write_double(file, "/sets/old", 1, 0, numbers);
    assert_true(kr_h5_has(file, "/"));
    assert_true(kr_h5_has(file, "/sets/old"));
    assert_false(kr_h5_has(file, "/sets/old/er"));
    assert_false(kr_h5_has(file, "/no/such/thing"));
    kr_h5_remove(file, "/sets/old");
    char **name = kr_h5_list(file, "/sets", &count);
    assert_int_equal(count, 2);
    assert_string_equal(name[0], "left");
    assert_string_equal(name[1], "top");
    kr_free(name[0]);
    kr_free(name[1]);
    kr_free(name);
    name = kr_h5_list(file, "/nothing", &count);
    assert_int_equal(count, 0);
    kr_free(name);
    kr_h5_discard(file);
    assert_int_equal(kr_memory_outstanding(), 0);
}

/** An array written again: in place where shape and type are the same, else anew. */
static void test_replaces(void **state) {
    struct kr_h5 *file = kr_h5_create(path, "kirsch run", 1);
    (void)state;
    kr_h5_write_double(file, "/x", 2, 0, numbers);
    kr_h5_write_double(file, "/x", 2, 0, numbers + 1); /* in place */
    kr_h5_write_double(file, "/y", 2, 0, numbers);
    kr_h5_write_double(file, "/y", 3, 2, numbers); /* anew */
    kr_h5_close(file);
    file = kr_h5_open(path, "kirsch run", 1);
    double *x = kr_h5_read_double(file, "/x", 2, 0), *y = kr_h5_read_double(file, "/y", 3, 2);
    assert_memory_equal(x, numbers + 1, 2 * sizeof *numbers);
    assert_memory_equal(y, numbers, sizeof numbers);
    kr_free(x);
    kr_free(y);
    kr_h5_close(file);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void test_equal_files_are_equal_bytes(void **state) {
    char *content[2];
    long size[2];
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct kr_h5 *file = kr_h5_create(path, "kirsch test", 1);
        kr_h5_pack(file, 1);
        kr_h5_write_float(file, "/a", 3, 2, numbers);
        kr_h5_write_double(file, "/b", 6, 0, numbers);
        kr_h5_close(file);
        FILE *in = fopen(path, "rb");
        fseek(in, 0, SEEK_END);
        size[k] = ftell(in);
        rewind(in);
        content[k] = malloc((size_t)size[k]);
        assert_int_equal(fread(content[k], 1, (size_t)size[k], in), size[k]);
        fclose(in);
        if (k == 0)
            sleep(1); /* a stored time would now differ */
    }
    assert_int_equal(size[0], size[1]);
    assert_memory_equal(content[0], content[1], (size_t)size[0]);
    free(content[0]);
    free(content[1]);
}

/* ---- what can be wrong --------------------------------------------------------------------- */

static void open_it(void *file) {
    kr_h5_open(file, "kirsch nodes", 2);
}

static void write_text(const char *text) {
    FILE *out = fopen(path, "w");
    fputs(text, out);
    fclose(out);
}

static void test_refuses_what_is_no_file_of_ours(void **state) {
    char missing[] = "/tmp/kirsch-no-such-file.h5";
    (void)state;
    kr_check_stops(open_it, missing, KR_EXIT_INPUT, "No such file");
    kr_check_stops(open_it, folder, KR_EXIT_INPUT, "it is a folder");
    write_text("");
    kr_check_stops(open_it, path, KR_EXIT_INPUT, "it is empty");
    write_text("x y radius\n");
    kr_check_stops(open_it, path, KR_EXIT_INPUT, "no HDF5 file");
    kr_h5_close(kr_h5_create(path, "kirsch run", 1));
    kr_check_stops(open_it, path, KR_EXIT_INPUT,
                   "of the kind \"kirsch run\"; expected \"kirsch nodes\"");
    kr_h5_close(kr_h5_create(path, "kirsch nodes", 3));
    kr_check_stops(open_it, path, KR_EXIT_INPUT, "version 3");
    kr_h5_close(kr_h5_create(path, "kirsch nodes", 1));
    kr_h5_close(kr_h5_open(path, "kirsch nodes", 2));
}

static void read_all(void *file) {
    struct kr_h5 *h5 = kr_h5_open(file, "kirsch nodes", 2);
    kr_free(kr_h5_read_double(h5, "/nodes/position", 3, 2));
    kr_h5_close(h5);
}

static void test_refuses_a_cut_file(void **state) {
    struct stat about;
    struct kr_h5 *file = kr_h5_create(path, "kirsch nodes", 2);
    (void)state;
    kr_h5_write_double(file, "/nodes/position", 3, 2, numbers);
    kr_h5_close(file);
    read_all(path);
    assert_int_equal(stat(path, &about), 0);
    for (off_t length = about.st_size - 1; length > 600; length = length * 2 / 3) {
        assert_int_equal(truncate(path, length), 0);
        kr_check_stops(read_all, path, KR_EXIT_INPUT, "cut short or damaged");
    }
}

enum misreading { SHAPE, RANK, KIND, WIDTH, ABSENT, NO_ATTRIBUTE, NOT_A_NUMBER, NOT_A_TEXT };

static void misread(void *what) {
    struct kr_h5 *h5 = kr_h5_open(path, "kirsch nodes", 2);
    switch (*(enum misreading *)what) {
    case SHAPE:
        kr_h5_read_double(h5, "/nodes/position", 4, 2);
        break;
    case RANK:
        kr_h5_read_double(h5, "/nodes/position", 6, 0);
        break;
    case KIND:
        kr_h5_read_int64(h5, "/nodes/position", 3, 2);
        break;
    case WIDTH:
        kr_h5_read_int32(h5, "/nodes/tag", 2, 0);
        break;
    case ABSENT:
        kr_h5_read_double(h5, "/nodes/volume", 3, 0);
        break;
    case NO_ATTRIBUTE:
        kr_h5_get_double(h5, "/", "spacing");
        break;
    case NOT_A_NUMBER:
        kr_h5_get_double(h5, "/", "format");
        break;
    case NOT_A_TEXT:
        kr_h5_get_text(h5, "/", "version");
        break;
    }
}

static void test_names_what_does_not_fit(void **state) {
    const int64_t tag[2] = {1, 2};
    const char *said[] = {"/nodes/position: its shape is 3 x 2; expected 4 x 2",
                          "its shape is 3 x 2; expected 6 x 0",
                          "/nodes/position: its numbers are of another type",
                          "/nodes/tag: its numbers are of another type",
                          "/nodes/volume: there is no such array",
                          "attribute `spacing` of /: there is none",
                          "attribute `format` of /: it is no number",
                          "attribute `version` of /: it is no text"};
    struct kr_h5 *file = kr_h5_create(path, "kirsch nodes", 2);
    (void)state;
    kr_h5_write_double(file, "/nodes/position", 3, 2, numbers);
    kr_h5_write_int64(file, "/nodes/tag", 2, 0, tag);
    kr_h5_close(file);
    for (enum misreading k = SHAPE; k <= NOT_A_TEXT; k++)
        kr_check_stops(misread, &k, KR_EXIT_INPUT, said[k]);
}

static void create_at(void *where) {
    kr_h5_create(where, "kirsch nodes", 1);
}

/** The disk is full from the first 64 KiB on. */
static void fill_disk(void *where) {
    const struct rlimit limit = {65536, 65536};
    double *much = kr_alloc(100000, sizeof *much);
    struct kr_h5 *file;
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &limit);
    file = kr_h5_create(where, "kirsch nodes", 1);
    kr_h5_write_double(file, "/much", 100000, 0, much);
    kr_h5_close(file);
}

static void test_says_what_cannot_be_written(void **state) {
    char nowhere[] = "/tmp/kirsch-no-such-folder/a.h5", beside[80];
    struct stat about;
    (void)state;
    kr_check_stops(create_at, nowhere, KR_EXIT_STORAGE, "No such file or directory");
    snprintf(beside, sizeof beside, "%s/locked", folder);
    mkdir(beside, 0500);
    if (access(beside, W_OK) != 0) { /* root may write anywhere */
        snprintf(beside, sizeof beside, "%s/locked/a.h5", folder);
        kr_check_stops(create_at, beside, KR_EXIT_STORAGE, "Permission denied");
    }
    kr_h5_close(kr_h5_create(path, "kirsch old", 1));
    kr_check_stops(fill_disk, path, KR_EXIT_STORAGE, "File too large");
    snprintf(beside, sizeof beside, "%s.tmp", path);
    assert_int_not_equal(stat(beside, &about), 0);
    kr_h5_close(kr_h5_open(path, "kirsch old", 1)); /* the older file is as it was */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_attributes),
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_replaces),
        cmocka_unit_test(test_equal_files_are_equal_bytes),
        cmocka_unit_test(test_refuses_what_is_no_file_of_ours),
        cmocka_unit_test(test_refuses_a_cut_file),
        cmocka_unit_test(test_names_what_does_not_fit),
        cmocka_unit_test(test_says_what_cannot_be_written),
    };
    char filter[256];
    const char *only = getenv("ONLY");
    snprintf(filter, sizeof filter, "*%s*", only ? only : "");
    cmocka_set_test_filter(filter);
    return cmocka_run_group_tests(tests, set_up, remove_folder);
}
