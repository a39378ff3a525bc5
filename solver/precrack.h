/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Cracks that are there from the beginning: lines in a plate; polygons, discs and surfaces of
 * triangles in a solid. They cut every bond that meets them; touching counts.
 */
#ifndef KR_PRECRACK_H
#define KR_PRECRACK_H

#include "bonds.h"

struct kr_precrack; /* Opaque. */

/** The crack of a deck. `path`: its file, NULL where it has none. Stops (exit 2) where the file cannot
 *  be read. */
struct kr_precrack *kr_precrack_create(const struct kr_case_crack *from, const char *path);
void kr_precrack_free(struct kr_precrack *crack);

/** Whether a bond from p to q [m] (2 components in a plate, 3 in a solid) meets the crack. */
int kr_precrack_meets(const struct kr_precrack *crack, const double *p, const double *q);

/** Cut the bonds that meet the crack.
 *  count: whether they count in the damage (plates paper eq. 10) or leave the family at once.
 *  Returns the number of pairs cut. */
size_t kr_precrack_cut(const struct kr_precrack *crack, struct kr_bonds *bonds, int count);

/** Cut along a straight line from a to b [m] in a plate. */
size_t kr_precrack_cut_line(struct kr_bonds *bonds, const double a[2], const double b[2], int count);

#endif
