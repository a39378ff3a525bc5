/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The square lattice that a plate is cut into. Its points are k * spacing from whole numbers k, so
 * cells that share a point share it to the last bit.
 */
#ifndef KR_LATTICE_H
#define KR_LATTICE_H

#include <stddef.h>

struct kr_lattice {
    size_t columns, rows; /* cells along x and y */
    double spacing;       /* m */
};

/** The lattice of a plate with a corner at (0, 0).
 *
 *  in  width, height, spacing   [m]
 *
 *  Stops (exit 2) unless both sides are multiples of the spacing to 1e-9, and names the nearest
 *  that do. Programs with a deck have said so before, by its line (kr_case_check_fit).
 */
struct kr_lattice kr_lattice_fit(double width, double height, double spacing);

/** Number of the point (i, j), 0 <= i <= columns, 0 <= j <= rows: row by row. */
static inline size_t kr_lattice_point(const struct kr_lattice *lattice, size_t i, size_t j) {
    return j * (lattice->columns + 1) + i;
}

/** Number of the cell with its lower left point at (i, j): row by row. */
static inline size_t kr_lattice_cell(const struct kr_lattice *lattice, size_t i, size_t j) {
    return j * lattice->columns + i;
}

#endif
