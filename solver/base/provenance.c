/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Where a file came from. No dates: equal runs give equal files.
 */
#include "base/provenance.h"

#include "base/memory.h"

#include <inttypes.h>
#include <string.h>
#include <sys/utsname.h>

const char *kr_version(void) {
    return KR_VERSION;
}

uint64_t kr_hash(uint64_t hash, const void *data, size_t bytes) {
    const unsigned char *byte = data;
    for (size_t k = 0; k < bytes; k++)
        hash = (hash ^ byte[k]) * UINT64_C(1099511628211);
    return hash;
}

void kr_provenance_write(struct kr_h5 *file, const char *deck_text) {
    struct utsname machine;
    char *text = kr_text("kirsch %s", kr_version());
    kr_h5_set_text(file, "/", "program", text);
    kr_free(text);
    if (uname(&machine) == 0) {
        text = kr_text("%s %s %s", machine.sysname, machine.machine, machine.nodename);
        kr_h5_set_text(file, "/", "machine", text);
        kr_free(text);
    }
    kr_h5_set_text(file, "/", "deck", deck_text);
    text = kr_text("%016" PRIx64, kr_hash(KR_HASH_BEGIN, deck_text, strlen(deck_text)));
    kr_h5_set_text(file, "/", "deck_hash", text);
    kr_free(text);
}
