/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What the three sources of the HDF5 wrapper share. No other file includes this, or hdf5.h.
 */
#ifndef KR_H5_PRIVATE_H
#define KR_H5_PRIVATE_H

#include <hdf5.h>

#include "base/h5.h"

struct kr_h5 {
    hid_t id;
    char *path;
    char *beside; /* where it grows until it is closed; NULL: it is read */
    int packed;
};

/** Put the library's habits right (see h5.c) and forget errno: begin of every public function that
 *  calls HDF5. */
void kr_h5_quiet(void);

/** Stop (exit 3; exit 2). `name` is the array or group at fault, "" for the file as a whole. */
_Noreturn void kr_h5_fail_write(const struct kr_h5 *file, const char *name);
_Noreturn void kr_h5_fail_read(const struct kr_h5 *file, const char *name, const char *why);

/** Properties of a new link that make the groups on the way to it; to be closed by the caller. */
hid_t kr_h5_links(void);

#endif
