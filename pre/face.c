/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The faces of solids, sorted by counting into one short list a point: linear in their number.
 */
#include "face.h"

#include "base/memory.h"

static size_t lowest(size_t n, const size_t *vertex) {
    size_t low = vertex[0];
    for (size_t k = 1; k < n; k++)
        low = vertex[k] < low ? vertex[k] : low;
    return low;
}

size_t kr_faces_vertices(const struct kr_faces *faces, struct kr_face face, size_t *vertex) {
    const struct kr_mesh *mesh = faces->mesh;
    size_t from = mesh->first[face.cell];
    return kr_solid_face(mesh->first[face.cell + 1] - from, mesh->vertex + from, face.face, vertex);
}

/** Count the faces by their lowest vertex, or, in the second pass, put them in their places. */
static void pass_over(struct kr_faces *faces, size_t *filled) {
    const struct kr_mesh *mesh = faces->mesh;
    for (size_t c = 0; c < mesh->n_cells; c++) {
        size_t shapes = kr_solid_n_faces(mesh->first[c + 1] - mesh->first[c]);
        for (size_t f = 0; f < shapes; f++) {
            size_t vertex[KR_MOST_FACE];
            struct kr_face face = {c, f};
            size_t n = kr_faces_vertices(faces, face, vertex);
            if (n < 3)
                continue;
            size_t low = lowest(n, vertex);
            if (filled)
                faces->face[faces->first[low] + filled[low]++] = face;
            else
                faces->first[low + 1]++;
        }
    }
}

struct kr_faces *kr_faces_create(const struct kr_mesh *mesh) {
    struct kr_faces *faces = KR_NEW(struct kr_faces, 1);
    faces->mesh = mesh;
    faces->first = KR_NEW(size_t, mesh->n_points + 1);
    pass_over(faces, NULL);
    for (size_t p = 0; p < mesh->n_points; p++)
        faces->first[p + 1] += faces->first[p];
    faces->count = faces->first[mesh->n_points];
    faces->face = KR_NEW(struct kr_face, faces->count);
    size_t *filled = KR_NEW(size_t, mesh->n_points);
    pass_over(faces, filled);
    kr_free(filled);
    return faces;
}

/** 1 if two rings of vertices are the same, -1 if one is the other backwards, 0 if neither. */
static int compare(size_t n, const size_t *a, const size_t *b) {
    size_t shift = 0, forward = 1, backward = 1;
    while (shift < n && b[shift] != a[0])
        shift++;
    if (shift == n)
        return 0;
    for (size_t k = 1; k < n; k++) {
        forward += b[(shift + k) % n] == a[k];
        backward += b[(shift + n - k) % n] == a[k];
    }
    return forward == n ? 1 : backward == n ? -1 : 0;
}

struct kr_face_match kr_faces_match(const struct kr_faces *faces, size_t n, const size_t *vertex) {
    struct kr_face_match match = {0};
    size_t low = lowest(n, vertex), other[KR_MOST_FACE];
    for (size_t k = faces->first[low]; k < faces->first[low + 1]; k++) {
        if (kr_faces_vertices(faces, faces->face[k], other) != n)
            continue;
        int sense = compare(n, vertex, other);
        match.count += sense != 0;
        match.same += sense == 1;
        if (sense)
            match.cell = faces->face[k].cell;
    }
    return match;
}

void kr_faces_free(struct kr_faces *faces) {
    if (!faces)
        return;
    kr_free(faces->first);
    kr_free(faces->face);
    kr_free(faces);
}
