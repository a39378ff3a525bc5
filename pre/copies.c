/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Cells that stand twice. See copies.h.
 */
#include "copies.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

static int ascending(const void *a, const void *b) {
    size_t p = *(const size_t *)a, q = *(const size_t *)b;
    return (p > q) - (p < q);
}

static size_t lowest(const struct kr_mesh *mesh, const size_t *size, size_t c) {
    const size_t *v = mesh->vertex + mesh->first[c];
    size_t low = v[0];
    for (size_t k = 1; k < size[c]; k++)
        low = v[k] < low ? v[k] : low;
    return low;
}

static int same_vertices(const struct kr_mesh *mesh, const size_t *size, size_t p, size_t q) {
    size_t a[64], b[64], n = size[p];
    if (n != size[q])
        return 0;
    if (n > 64) /* a polyhedron: given twice it is given alike */
        return !memcmp(mesh->vertex + mesh->first[p], mesh->vertex + mesh->first[q],
                       n * sizeof *a);
    memcpy(a, mesh->vertex + mesh->first[p], n * sizeof *a);
    memcpy(b, mesh->vertex + mesh->first[q], n * sizeof *b);
    qsort(a, n, sizeof *a, ascending);
    qsort(b, n, sizeof *b, ascending);
    return !memcmp(a, b, n * sizeof *a);
}

/** Looked for among the cells before with the same lowest vertex, by a chain for each vertex. */
unsigned char *kr_mesh_copies(const struct kr_mesh *mesh, const size_t *size, const unsigned char *is_gone) {
    unsigned char *is_copy = KR_NEW(unsigned char, mesh->n_cells);
    size_t *head = KR_NEW(size_t, mesh->n_points), *next = KR_NEW(size_t, mesh->n_cells);
    for (size_t c = 0; c < mesh->n_cells; c++) {
        if (is_gone[c])
            continue;
        size_t *chain = &head[lowest(mesh, size, c)], other = *chain;
        while (other && !same_vertices(mesh, size, c, other - 1))
            other = next[other - 1];
        if (other) {
            is_copy[c] = 1;
            continue;
        }
        next[c] = *chain;
        *chain = c + 1;
    }
    kr_free(head);
    kr_free(next);
    return is_copy;
}
