/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A seal: one line behind the data of a file, with the hash (FNV-1a, provenance.h) of all bytes
 * before it. HDF5 does not mind bytes behind its end. It finds damage, not malice.
 */
#ifndef KR_SEAL_H
#define KR_SEAL_H

/** Put a seal behind a finished file and bring it to the disk. Where that fails the file is removed
 *  and the program stops (exit 3). */
void kr_seal(const char *path);

/** Whether the file can be read and ends with the seal of what stands before it. */
int kr_seal_holds(const char *path);

#endif
