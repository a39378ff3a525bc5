/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Checked, counted allocation. The size stands in a 64-byte header before the array, so that the
 * count of bytes is exact and the array itself is aligned for any vector width. The counters are
 * atomic, for set-up work may allocate in parallel regions.
 */
#include "base/memory.h"

#include "base/error.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { HEADER = 64, HUGE_PAGE = 2 << 20, LARGE = 4 << 20 };

static _Atomic size_t outstanding, bytes_now, bytes_peak;

static size_t *header_of(void *array) {
    return (size_t *)((char *)array - HEADER);
}

/* For tests: KIRSCH_FAIL_ALLOCATION=N lets the N-th allocation of the program fail. */
static int is_to_fail(void) {
    static _Atomic long wanted = -1, count; /* -1: not asked yet; 0: none */
    if (wanted < 0) {
        const char *text = getenv("KIRSCH_FAIL_ALLOCATION");
        long n = text ? atol(text) : 0;
        wanted = n > 0 ? n : 0;
    }
    return wanted > 0 && ++count == wanted;
}

/* A large array on pages of 2 MiB where the system has them on request: 512 times fewer pages are to be made,
 * and found again by loops that read dozens of arrays at once. Arrays that all begin at the same place of
 * their pages would meet in the same lines of the caches, so each begins elsewhere. Returns where the
 * header goes; what lies before it is noted there. */
static size_t *large_block(size_t room) {
    static _Atomic unsigned turn;
    size_t shift = turn++ % 61 * 65 * HEADER;
    char *block = aligned_alloc(HUGE_PAGE, (room + shift + HUGE_PAGE - 1) / HUGE_PAGE * HUGE_PAGE);
    if (!block)
        return NULL;
    madvise(block, room + shift, MADV_HUGEPAGE); /* a wish: small pages do as well */
    size_t *header = (size_t *)(block + shift);
    header[1] = shift;
    return header;
}

static size_t *small_block(size_t room) {
    size_t *header = aligned_alloc(HEADER, room);
    if (header)
        header[1] = 0;
    return header;
}

/* Each thread clears its share of a large array, and by this first touch has it near, where memory belongs to
 * processors: loops over nodes and slices give a thread about the same share. */
static void clear(char *array, size_t size) {
    enum { PART = 1 << 20 };
    const size_t parts = size / PART;
    if (size < LARGE) {
        memset(array, 0, size);
        return;
    }
#pragma omp parallel for schedule(static)
    for (size_t k = 0; k < parts; k++)
        memset(array + k * PART, 0, k + 1 < parts ? PART : size - k * PART);
}

/* An array as it comes, and with it the bytes up to its last line of the cache. */
static char *take(size_t count, size_t size, size_t *room_for) {
    if (size && count > (SIZE_MAX / 2 - 2 * HEADER) / size)
        kr_stop(KR_EXIT_MEMORY, "%zu items of %zu bytes are more than any machine can hold", count,
                size);
    size_t bytes = count * size;
    /* Of nothing, too, there is a byte: what points behind a block does not keep it, in the eyes of a leak sanitizer. */
    size_t room = ((bytes ? bytes : 1) + 2 * HEADER - 1) / HEADER * HEADER;
    size_t *header = is_to_fail() ? NULL : room < LARGE ? small_block(room) : large_block(room);
    if (!header)
        kr_stop(KR_EXIT_MEMORY,
                "out of memory: %.1f MiB more wanted with %.1f MiB in use; a coarser spacing or a "
                "larger machine is needed",
                (double)bytes / 1048576, (double)bytes_now / 1048576);
    header[0] = bytes;
    outstanding++;
    bytes_now += bytes;
    if (bytes_now > bytes_peak)
        bytes_peak = bytes_now;
    *room_for = room - HEADER;
    return (char *)header + HEADER;
}

void *kr_alloc(size_t count, size_t size) {
    size_t room;
    char *array = take(count, size, &room);
    clear(array, room);
    return array;
}

void *kr_alloc_raw(size_t count, size_t size) {
    size_t room;
    return take(count, size, &room);
}

void *kr_realloc(void *array, size_t count, size_t size) {
    size_t room, kept = array ? *header_of(array) : 0;
    char *larger = take(count, size, &room);
    if (kept > count * size)
        kept = count * size;
    if (kept)
        memcpy(larger, array, kept);
    clear(larger + kept, room - kept);
    kr_free(array);
    return larger;
}

void *kr_free(void *array) {
    if (array) {
        size_t *header = header_of(array);
        outstanding--;
        bytes_now -= *header;
        free((char *)header - header[1]);
    }
    return NULL;
}

char *kr_text_copy(const char *text) {
    size_t length = strlen(text) + 1;
    return memcpy(kr_alloc(length, 1), text, length);
}

char *kr_text(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    kr_assert(length >= 0);
    char *text = kr_alloc((size_t)length + 1, 1);
    va_start(arguments, format);
    vsnprintf(text, (size_t)length + 1, format, arguments);
    va_end(arguments);
    return text;
}

size_t kr_memory_outstanding(void) {
    return outstanding;
}

size_t kr_memory_bytes(void) {
    return bytes_now;
}

size_t kr_memory_peak(void) {
    return bytes_peak;
}
