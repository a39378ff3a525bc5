/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tables of elements: https://gmsh.info/doc/texinfo/gmsh.html, "Node ordering", and VTK's file
 * formats.
 */
#include "element.h"

static const struct kr_element elements[] = {
    [1] = {"line", 1, 2, 2, {0, 1}},
    [2] = {"triangle", 2, 3, 3, {0, 1, 2}},
    [3] = {"quadrilateral", 2, 4, 4, {0, 1, 2, 3}},
    [4] = {"tetrahedron", 3, 4, 4, {0, 1, 2, 3}},
    [5] = {"hexahedron", 3, 8, 8, {0, 1, 2, 3, 4, 5, 6, 7}},
    [6] = {"wedge", 3, 6, 6, {0, 1, 2, 3, 4, 5}},
    [7] = {"pyramid", 3, 5, 5, {0, 1, 2, 3, 4}},
    [8] = {"line of 3 nodes", 1, 3, 3, {0, 2, 1}},
    [9] = {"triangle of 6 nodes", 2, 6, 6, {0, 3, 1, 4, 2, 5}},
    [10] = {"quadrilateral of 9 nodes", 2, 9, 8, {0, 4, 1, 5, 2, 6, 3, 7}},
    [11] = {"tetrahedron of 10 nodes", 3, 10, 10, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
    [12] = {"hexahedron of 27 nodes", 3, 27, 20,
            {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15}},
    [13] = {"wedge of 18 nodes", 3, 18, 15, {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11}},
    [14] = {"pyramid of 14 nodes", 3, 14, 13, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}},
    [15] = {"point", 0, 1, 1, {0}},
    [16] = {"quadrilateral of 8 nodes", 2, 8, 8, {0, 4, 1, 5, 2, 6, 3, 7}},
    [17] = {"hexahedron of 20 nodes", 3, 20, 20,
            {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15}},
    [18] = {"wedge of 15 nodes", 3, 15, 15, {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11}},
    [19] = {"pyramid of 13 nodes", 3, 13, 13, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}},
};

const struct kr_element *kr_element(int type) {
    return type >= 1 && type < (int)(sizeof elements / sizeof *elements) ? &elements[type] : NULL;
}

int kr_element_type(int dim, size_t vertices) {
    /* A hexahedron of 20 nodes is found as such, not as one of 27 without its inner nodes. */
    for (int type = 1; type < (int)(sizeof elements / sizeof *elements); type++)
        if (elements[type].dim == dim && elements[type].nodes == vertices)
            return type;
    return 0;
}
