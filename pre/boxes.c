/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Marking the cells of boxes and repairing corner contacts.
 */
#include "boxes.h"

#include <math.h>

/** Lattice line at or outward of x, kept on the lattice. A box that ends on a line to 1e-6
 *  spacings is meant to end there. */
static size_t snap(double x, int outward, size_t most) {
    double line = outward > 0 ? ceil(x - 1e-6) : floor(x + 1e-6);
    return line <= 0 ? 0 : line >= (double)most ? most : (size_t)line;
}

void kr_boxes_mark(const struct kr_lattice *lattice, size_t n, const double (*box)[4],
                   double padding, unsigned char *marked) {
    for (size_t b = 0; b < n; b++) {
        size_t left = snap(box[b][0] - padding, -1, lattice->columns);
        size_t bottom = snap(box[b][1] - padding, -1, lattice->rows);
        size_t right = snap(box[b][2] + padding, 1, lattice->columns);
        size_t top = snap(box[b][3] + padding, 1, lattice->rows);
        for (size_t j = bottom; j < top; j++)
            for (size_t i = left; i < right; i++)
                marked[kr_lattice_cell(lattice, i, j)] = 1;
    }
}

static size_t repair_corners(const struct kr_lattice *lattice, unsigned char *marked) {
    size_t repaired = 0;
    for (size_t j = 1; j < lattice->rows; j++)
        for (size_t i = 1; i < lattice->columns; i++) {
            unsigned char *below = marked + kr_lattice_cell(lattice, i - 1, j - 1);
            unsigned char *above = below + lattice->columns;
            if (below[0] == above[1] && below[1] == above[0] && below[0] != below[1]) {
                below[0] = below[1] = 1;
                repaired++;
            }
        }
    return repaired;
}

void kr_boxes_join_corners(const struct kr_lattice *lattice, unsigned char *marked) {
    /* A new cell may make a new contact. */
    while (repair_corners(lattice, marked))
        ;
}
