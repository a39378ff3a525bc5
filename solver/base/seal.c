/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Seals. See seal.h.
 */
#include "base/seal.h"

#include "base/error.h"
#include "base/provenance.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { LENGTH = 29 }; /* "kirsch seal ", 16 digits, end of line */

static void print_seal(char seal[LENGTH + 1], uint64_t hash) {
    snprintf(seal, LENGTH + 1, "kirsch seal %016" PRIx64 "\n", hash);
}

/* Hash of the first `bytes` bytes from where the file stands; short files set *is_short. */
static uint64_t hash_of(FILE *file, off_t bytes, int *is_short) {
    char block[1 << 16];
    uint64_t hash = KR_HASH_BEGIN;
    while (bytes > 0) {
        size_t want = bytes < (off_t)sizeof block ? (size_t)bytes : sizeof block;
        size_t got = fread(block, 1, want, file);
        hash = kr_hash(hash, block, got);
        bytes -= (off_t)got;
        if (got < want)
            break;
    }
    *is_short = bytes > 0;
    return hash;
}

/* Bytes of an open file, which then stands at its beginning; -1 if it has none. */
static off_t size_of(FILE *file) {
    off_t size = fseeko(file, 0, SEEK_END) ? -1 : ftello(file);
    rewind(file);
    return size;
}

void kr_seal(const char *path) {
    char seal[LENGTH + 1];
    int failed = 1, is_short;
    FILE *file = fopen(path, "r+b");
    if (file) {
        print_seal(seal, hash_of(file, size_of(file), &is_short));
        failed = is_short || fseeko(file, 0, SEEK_END) || fwrite(seal, 1, LENGTH, file) != LENGTH ||
                 fflush(file) || fsync(fileno(file));
        failed |= fclose(file) != 0;
    }
    if (failed) {
        int reason = errno;
        remove(path);
        kr_stop(KR_EXIT_STORAGE, "cannot write %s: %s", path, strerror(reason));
    }
}

int kr_seal_holds(const char *path) {
    char found[LENGTH + 1] = "", wanted[LENGTH + 1];
    FILE *file = fopen(path, "rb");
    if (!file)
        return 0;
    int is_short = 1;
    off_t size = size_of(file);
    if (size > LENGTH) {
        print_seal(wanted, hash_of(file, size - LENGTH, &is_short));
        is_short |= fread(found, 1, LENGTH, file) != LENGTH;
    }
    fclose(file);
    return !is_short && !memcmp(found, wanted, LENGTH);
}
