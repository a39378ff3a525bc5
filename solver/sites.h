/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Where cracks begin: sites.csv, a line a bond that broke where none had broken before.
 */
#ifndef KR_SITES_H
#define KR_SITES_H

#include "crack.h"
#include "history.h"

struct kr_sites; /* Opaque. Implemented in sites.c. */

/** Begin sites.csv; or, with bytes > 0, go on behind so many bytes of it, knowing what broke until
 *  then from the record. A site is new if no bond has broken within two horizons of it, cells of that
 *  width taken for the distance. */
struct kr_sites *kr_sites_create(const struct kr_case *c, const struct kr_bonds *bonds,
                                 const struct kr_crack *crack, long bytes);
void kr_sites_free(struct kr_sites *sites);

/** Look at the broken bonds from number `from` on. */
void kr_sites_note(struct kr_sites *sites, const struct kr_crack *crack, size_t from,
                   struct kr_history_time at);

/** How long the file is, all of it on the disk. */
long kr_sites_bytes(const struct kr_sites *sites);

#endif
