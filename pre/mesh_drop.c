/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Taking cells and facets out of a mesh, and out of its groups.
 */
#include "base/memory.h"
#include "mesh.h"

#include <string.h>

static void renumber_groups(struct kr_mesh *mesh, int dim, const unsigned char *is_gone,
                            const size_t *now_at) {
    for (size_t g = 0; g < mesh->n_groups; g++) {
        struct kr_mesh_group *group = &mesh->group[g];
        size_t kept = 0;
        if (group->dim != dim)
            continue;
        for (size_t k = 0; k < group->count; k++)
            if (!is_gone[group->member[k]])
                group->member[kept++] = now_at[group->member[k]];
        group->count = kept;
    }
}

void kr_mesh_drop_cells(struct kr_mesh *mesh, const size_t *size, const unsigned char *is_gone) {
    size_t *now_at = KR_NEW(size_t, mesh->n_cells), kept = 0, end = 0;
    for (size_t c = 0; c < mesh->n_cells; c++) {
        size_t from = mesh->first[c];
        if (is_gone[c])
            continue;
        now_at[c] = kept;
        memmove(mesh->vertex + end, mesh->vertex + from, size[c] * sizeof *mesh->vertex);
        mesh->cell_tag[kept] = mesh->cell_tag[c];
        mesh->first[kept++] = end;
        end += size[c];
    }
    mesh->n_cells = kept;
    mesh->first[kept] = end;
    renumber_groups(mesh, mesh->dim, is_gone, now_at);
    kr_free(now_at);
}

void kr_mesh_drop_facets(struct kr_mesh *mesh, const unsigned char *is_gone) {
    size_t n = mesh->dim == 2 ? mesh->n_edges : mesh->n_faces, kept = 0, end = 0;
    size_t *now_at = KR_NEW(size_t, n);
    for (size_t f = 0; f < n; f++) {
        size_t from = mesh->dim == 2 ? 2 * f : mesh->face_first[f];
        size_t count = mesh->dim == 2 ? 2 : mesh->face_first[f + 1] - from;
        if (is_gone[f])
            continue;
        now_at[f] = kept;
        memmove((mesh->dim == 2 ? mesh->edge : mesh->face) + end,
                (mesh->dim == 2 ? mesh->edge : mesh->face) + from, count * sizeof *mesh->edge);
        if (mesh->dim == 3)
            mesh->face_first[kept] = end;
        kept++;
        end += count;
    }
    if (mesh->dim == 3 && n)
        mesh->face_first[kept] = end;
    *(mesh->dim == 2 ? &mesh->n_edges : &mesh->n_faces) = kept;
    renumber_groups(mesh, mesh->dim - 1, is_gone, now_at);
    kr_free(now_at);
}
