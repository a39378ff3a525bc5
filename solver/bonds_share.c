/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Lists of rows that stand in memory once. A body on a lattice has some dozens of different ones: one of the bulk, others
 * near its edges. The list of a slice is looked up by a hash of what it holds, in an open table.
 */
#include "bonds_make.h"

#include "base/memory.h"

#include <string.h>

enum { EMPTY = 0 };

/* By FNV-1a over whole rows. */
static uint64_t hash_of(const struct kr_bonds *b, size_t list, size_t count) {
    uint64_t hash = UINT64_C(14695981039346656037);
    for (size_t r = list; r < list + count; r++) {
        hash = (hash ^ (uint32_t)b->offset[r]) * UINT64_C(1099511628211);
        hash = (hash ^ b->kind[r]) * UINT64_C(1099511628211);
    }
    return hash ^ hash >> 32;
}

static size_t count_of(const struct kr_bonds *b, size_t slice) {
    return b->first[slice + 1] - b->first[slice];
}

/* Whether the rows of the slice, at `at`, are those that another slice has. */
static int same_list(const struct kr_bonds *b, size_t slice, size_t at, size_t other) {
    const size_t count = count_of(b, slice), list = b->list[other];
    return count_of(b, other) == count &&
           !memcmp(b->offset + at, b->offset + list, count * sizeof *b->offset) &&
           !memcmp(b->kind + at, b->kind + list, count * sizeof *b->kind);
}

/* Only lattice slices are looked up: lists of others hardly ever agree. */
void kr_bonds_share_lists(struct kr_bonds *b) {
    size_t room = 1, to = 0;
    while (room < 2 * b->n_slices)
        room *= 2;
    uint32_t *table = KR_NEW(uint32_t, room); /* slice + 1, or EMPTY */
    for (size_t slice = 0; slice < b->n_slices; slice++) {
        const size_t at = b->first[slice], count = count_of(b, slice);
        size_t spot = b->lattice[slice] ? hash_of(b, at, count) % room : room;
        while (spot < room && table[spot] != EMPTY && !same_list(b, slice, at, table[spot] - 1))
            spot = (spot + 1) % room;
        if (spot < room && table[spot] != EMPTY) {
            b->list[slice] = b->list[table[spot] - 1];
            continue;
        }
        memmove(b->offset + to, b->offset + at, count * sizeof *b->offset);
        memmove(b->kind + to, b->kind + at, count * sizeof *b->kind);
        b->list[slice] = to;
        to += count;
        if (spot < room)
            table[spot] = (uint32_t)slice + 1;
    }
    kr_free(table);
    b->n_listed = to;
    b->offset = kr_realloc(b->offset, to, sizeof *b->offset);
    b->kind = kr_realloc(b->kind, to, sizeof *b->kind);
}
