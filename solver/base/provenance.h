/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Where a file came from: program and version, machine, deck and its hash.
 */
#ifndef KR_PROVENANCE_H
#define KR_PROVENANCE_H

#include "base/h5.h"

#include <stdint.h>

/** Set the root attributes `program`, `machine`, `deck` (the resolved text) and `deck_hash`. */
void kr_provenance_write(struct kr_h5 *file, const char *deck_text);

/** FNV-1a hash of a text, 64 bits; goes on from `hash`, or begins with KR_HASH_BEGIN. */
#define KR_HASH_BEGIN UINT64_C(14695981039346656037)
uint64_t kr_hash(uint64_t hash, const void *data, size_t bytes);

/** Version of the program, as git describes it. */
const char *kr_version(void);

#endif
