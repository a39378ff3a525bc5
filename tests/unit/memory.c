/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Allocation: zeroed, aligned, counted, and stopping where there is none.
 */
#include "test.h"

static void memory_is_zeroed_and_aligned(void **state) {
    (void)state;
    for (size_t round = 0; round < 200; round++) {
        size_t count = round / 2; /* each size twice: the second may get the first one's block */
        unsigned char *array = kr_alloc(count, 3);
        assert_int_equal((uintptr_t)array % 64, 0);
        for (size_t i = 0; i < 3 * count; i++)
            assert_int_equal(array[i], 0);
        memset(array, 0xa5, 3 * count);
        kr_free(array);
    }
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void memory_counts_arrays_and_bytes(void **state) {
    (void)state;
    size_t before = kr_memory_bytes();
    double *a = KR_NEW(double, 37);
    char *b = kr_text_copy("pores");
    assert_int_equal(kr_memory_outstanding(), 2);
    assert_int_equal(kr_memory_bytes() - before, 37 * sizeof(double) + 6);
    assert_null(kr_free(a));
    assert_int_equal(kr_memory_outstanding(), 1);
    kr_free(b);
    assert_int_equal(kr_memory_outstanding(), 0);
    assert_int_equal(kr_memory_bytes(), before);
    assert_true(kr_memory_peak() >= 37 * sizeof(double) + 6);
    assert_null(kr_free(NULL));
}

static void memory_realloc_keeps_and_zeroes(void **state) {
    (void)state;
    int *array = KR_NEW(int, 5);
    for (int i = 0; i < 5; i++)
        array[i] = 11 + i;
    array = kr_realloc(array, 83, sizeof *array);
    for (int i = 0; i < 83; i++)
        assert_int_equal(array[i], i < 5 ? 11 + i : 0);
    array = kr_realloc(array, 2, sizeof *array);
    assert_int_equal(array[1], 12);
    kr_free(array);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void memory_grow_appends(void **state) {
    (void)state;
    int64_t *array = NULL;
    size_t count = 0, room = 0;
    for (int64_t i = 0; i < 1000; i++) {
        KR_GROW(array, count, room);
        array[count++] = i * i;
    }
    for (int64_t i = 0; i < 1000; i++)
        assert_int_equal(array[i], i * i);
    kr_free(array);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void memory_text_is_as_printed(void **state) {
    (void)state;
    char *text = kr_text("%s has %d holes of %g mm", "plate", 17, 2.25);
    assert_string_equal(text, "plate has 17 holes of 2.25 mm");
    kr_free(text);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void want_overflow(void *argument) {
    (void)argument;
    kr_alloc(SIZE_MAX / 4, 8);
}

static void want_too_much(void *argument) {
    (void)argument;
    kr_alloc((size_t)1 << 59, 1);
}

static void memory_stops_where_a_size_overflows(void **state) {
    (void)state;
    kr_check_stops(want_overflow, NULL, 6, "more than any machine can hold");
}

static void memory_stops_where_there_is_none(void **state) {
    (void)state;
    setenv("ASAN_OPTIONS", "allocator_may_return_null=1", 1);
    kr_check_stops(want_too_much, NULL, 6, "out of memory");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_is_zeroed_and_aligned),
        cmocka_unit_test(memory_counts_arrays_and_bytes),
        cmocka_unit_test(memory_realloc_keeps_and_zeroes),
        cmocka_unit_test(memory_grow_appends),
        cmocka_unit_test(memory_text_is_as_printed),
        cmocka_unit_test(memory_stops_where_a_size_overflows),
        cmocka_unit_test(memory_stops_where_there_is_none),
    };
    kr_run_tests(tests);
}
