/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Checked, counted allocation. Every array has one owner, who frees it; a test ends by checking
 * that kr_memory_outstanding() is zero. Nothing is allocated inside the time loop.
 * The environment's KIRSCH_FAIL_ALLOCATION=N makes the N-th allocation of a program fail, for tests.
 */
#ifndef KR_MEMORY_H
#define KR_MEMORY_H

#include <stddef.h>

/** Zeroed memory for count items of size bytes, on a 64-byte boundary. Stops (exit 6) where there
 *  is none or where count * size overflows. count 0 gives a valid pointer. */
void *kr_alloc(size_t count, size_t size);

/** As kr_alloc, but not zeroed: for large arrays that are written whole before they are read. */
void *kr_alloc_raw(size_t count, size_t size);

/** Change an array to count items; new bytes are zeroed. array NULL allocates. */
void *kr_realloc(void *array, size_t count, size_t size);

/** Free an array of kr_alloc; NULL is allowed. Returns NULL: `a = kr_free(a);`. */
void *kr_free(void *array);

/** Copy of a string, owned by the caller. */
char *kr_text_copy(const char *text);

/** A string made as by printf, owned by the caller. */
char *kr_text(const char *format, ...) __attribute__((format(printf, 1, 2)));

/** Number of arrays not yet freed. */
size_t kr_memory_outstanding(void);

/** Bytes allocated now, and the most there ever were. */
size_t kr_memory_bytes(void);
size_t kr_memory_peak(void);

/** An array of `count` items of `type`. */
#define KR_NEW(type, count) ((type *)kr_alloc((count), sizeof(type)))

#define KR_NEW_RAW(type, count) ((type *)kr_alloc_raw((count), sizeof(type)))

/** Make room for one more item in a growing array: doubles when full. */
#define KR_GROW(array, count, room)                                                                \
    do {                                                                                           \
        if ((count) == (room)) {                                                                   \
            (room) = (room) ? 2 * (room) : 16;                                                     \
            (array) = kr_realloc((array), (room), sizeof *(array));                                \
        }                                                                                          \
    } while (0)

#endif
