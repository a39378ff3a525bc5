/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The mesh's life and its whole-structure check. Every check of one kind is one function that
 * returns the sentence of the first fault it meets, or NULL.
 */
#include "mesh.h"

#include "base/memory.h"
#include "cell.h"
#include "side.h"

#include <math.h>
#include <string.h>

struct kr_mesh *kr_mesh_create(void) {
    struct kr_mesh *mesh = KR_NEW(struct kr_mesh, 1);
    mesh->dim = 2;
    mesh->first = KR_NEW(size_t, 1);
    return mesh;
}

void kr_mesh_free(struct kr_mesh *mesh) {
    if (!mesh)
        return;
    for (size_t g = 0; g < mesh->n_groups; g++) {
        kr_free(mesh->group[g].name);
        kr_free(mesh->group[g].member);
    }
    kr_free(mesh->group);
    kr_free(mesh->point);
    kr_free(mesh->first);
    kr_free(mesh->vertex);
    kr_free(mesh->cell_tag);
    kr_free(mesh->edge);
    kr_free(mesh->face_first);
    kr_free(mesh->face);
    kr_free(mesh->point_tag);
    kr_free(mesh);
}

const struct kr_mesh_group *kr_mesh_group(const struct kr_mesh *mesh, const char *name, int dim) {
    for (size_t g = 0; g < mesh->n_groups; g++)
        if (mesh->group[g].dim == dim && !strcmp(mesh->group[g].name, name))
            return &mesh->group[g];
    return NULL;
}

int64_t kr_mesh_point_tag(const struct kr_mesh *mesh, size_t point) {
    return mesh->point_tag ? mesh->point_tag[point] : (int64_t)point + 1;
}

static void renumber(const size_t *now_at, size_t count, size_t *index) {
    for (size_t k = 0; k < count; k++)
        index[k] = now_at[index[k]];
}

void kr_mesh_drop_points(struct kr_mesh *mesh, const unsigned char *is_gone) {
    size_t *now_at = KR_NEW(size_t, mesh->n_points), kept = 0;
    for (size_t p = 0; p < mesh->n_points; p++) {
        if (is_gone[p])
            continue;
        now_at[p] = kept;
        memmove(mesh->point + 3 * kept, mesh->point + 3 * p, 3 * sizeof *mesh->point);
        if (mesh->point_tag)
            mesh->point_tag[kept] = mesh->point_tag[p];
        kept++;
    }
    mesh->n_points = kept;
    renumber(now_at, mesh->first[mesh->n_cells], mesh->vertex);
    renumber(now_at, 2 * mesh->n_edges, mesh->edge);
    renumber(now_at, mesh->n_faces ? mesh->face_first[mesh->n_faces] : 0, mesh->face);
    for (size_t g = 0; g < mesh->n_groups; g++) {
        struct kr_mesh_group *group = &mesh->group[g];
        size_t n = 0;
        for (size_t k = 0; group->dim == 0 && k < group->count; k++)
            if (!is_gone[group->member[k]])
                group->member[n++] = now_at[group->member[k]];
        group->count = group->dim == 0 ? n : group->count;
    }
    kr_free(now_at);
}

static char *points_fault(const struct kr_mesh *mesh) {
    for (size_t p = 0; p < mesh->n_points; p++)
        for (int d = 0; d < 3; d++)
            if (!isfinite(mesh->point[3 * p + (size_t)d]))
                return kr_text("point %zu has no finite place", p);
    return NULL;
}

static char *indices_fault(const struct kr_mesh *mesh) {
    if (mesh->n_cells == 0)
        return kr_text("the mesh has no cells");
    for (size_t c = 0; c < mesh->n_cells; c++) {
        size_t from = mesh->first[c], to = mesh->first[c + 1];
        if (to < from || to - from < 3)
            return kr_text("cell %lld has fewer than three vertices", (long long)mesh->cell_tag[c]);
        for (size_t k = from; k < to; k++) {
            if (mesh->vertex[k] >= mesh->n_points)
                return kr_text("cell %lld has a vertex %zu, but there are %zu points",
                               (long long)mesh->cell_tag[c], mesh->vertex[k], mesh->n_points);
            for (size_t l = from; l < k; l++)
                if (mesh->vertex[k] == mesh->vertex[l])
                    return kr_text("cell %lld at (%g, %g) m has one vertex twice",
                                   (long long)mesh->cell_tag[c], mesh->point[3 * mesh->vertex[k]],
                                   mesh->point[3 * mesh->vertex[k] + 1]);
        }
    }
    for (size_t e = 0; e < 2 * mesh->n_edges; e++)
        if (mesh->edge[e] >= mesh->n_points)
            return kr_text("boundary edge %zu has an end %zu, but there are %zu points", e / 2,
                           mesh->edge[e], mesh->n_points);
    return NULL;
}

static char *areas_fault(const struct kr_mesh *mesh) {
    size_t room = 4;
    double *corner = KR_NEW(double, 2 * room), z = mesh->point[3 * mesh->vertex[0] + 2];
    char *fault = NULL;
    for (size_t c = 0; c < mesh->n_cells && !fault; c++) {
        const size_t *v = mesh->vertex + mesh->first[c], n = mesh->first[c + 1] - mesh->first[c];
        if (n > room) {
            room = n;
            corner = kr_realloc(corner, 2 * room, sizeof *corner);
        }
        for (size_t k = 0; k < n; k++) {
            memcpy(corner + 2 * k, mesh->point + 3 * v[k], 2 * sizeof *corner);
            /* An equality would refuse a plane that was turned and turned back. */
            double dz = fabs(mesh->point[3 * v[k] + 2] - z);
            if (dz > 1e-9 * (fabs(z) +
                             hypot(corner[2 * k] - corner[0], corner[2 * k + 1] - corner[1])) &&
                dz > 1e-12)
                fault =
                    kr_text("cell %lld at (%g, %g) m lies %g m out of the plane z = %g m",
                            (long long)mesh->cell_tag[c], corner[2 * k], corner[2 * k + 1], dz, z);
            if (fault)
                break;
        }
        if (!fault && !kr_cell_is_sound(n, corner))
            fault = kr_text("cell %lld at (%g, %g) m has no positive area: its corners do not go "
                            "round it counter-clockwise",
                            (long long)mesh->cell_tag[c], corner[0], corner[1]);
    }
    kr_free(corner);
    return fault;
}

/** No two cells on the same side of a side; this finds cells given twice, too. */
static char *overlap_fault(const struct kr_mesh *mesh, const struct kr_sides *sides) {
    for (size_t s = 0; s < sides->count; s++) {
        struct kr_side side = sides->side[s];
        size_t other;
        if (kr_sides_find(sides, side.from, side.to, &other) > 1)
            return kr_text("cells %lld and %lld overlap: they lie on the same side of their common "
                           "side at (%g, %g) m",
                           (long long)mesh->cell_tag[side.cell], (long long)mesh->cell_tag[other],
                           mesh->point[3 * side.from], mesh->point[3 * side.from + 1]);
    }
    return NULL;
}

static char *edges_fault(const struct kr_mesh *mesh, const struct kr_sides *sides) {
    for (size_t e = 0; e < mesh->n_edges; e++) {
        size_t a = mesh->edge[2 * e], b = mesh->edge[2 * e + 1];
        size_t cells = kr_sides_find(sides, a, b, NULL) + kr_sides_find(sides, b, a, NULL);
        if (cells != 1)
            return kr_text(
                "the boundary edge from (%g, %g) m to (%g, %g) m is a side of %zu cells, "
                "and should be of just one",
                mesh->point[3 * a], mesh->point[3 * a + 1], mesh->point[3 * b],
                mesh->point[3 * b + 1], cells);
    }
    return NULL;
}

static char *groups_fault(const struct kr_mesh *mesh) {
    for (size_t g = 0; g < mesh->n_groups; g++) {
        const struct kr_mesh_group *group = &mesh->group[g];
        size_t facets = mesh->dim == 2 ? mesh->n_edges : mesh->n_faces;
        size_t items = group->dim == mesh->dim ? mesh->n_cells : facets;
        if (!group->name || !group->name[0] || group->dim < mesh->dim - 1 || group->dim > mesh->dim)
            return kr_text("group %zu has no name or is neither of %s nor of cells", g,
                           mesh->dim == 2 ? "edges" : "faces");
        if (kr_mesh_group(mesh, group->name, group->dim) != group)
            return kr_text("two groups have the name '%s'", group->name);
        for (size_t k = 0; k < group->count; k++) {
            if (group->member[k] >= items)
                return kr_text("group '%s' has a member %zu, but there are only %zu", group->name,
                               group->member[k], items);
            if (k && group->member[k] <= group->member[k - 1])
                return kr_text("the members of group '%s' do not ascend", group->name);
        }
    }
    return NULL;
}

char *kr_mesh_fault(const struct kr_mesh *mesh) {
    char *fault = points_fault(mesh);
    if (mesh->dim == 3) {
        if (!fault)
            fault = kr_mesh_solid_fault(mesh);
        return fault ? fault : groups_fault(mesh);
    }
    if (!fault)
        fault = indices_fault(mesh);
    if (!fault)
        fault = areas_fault(mesh);
    if (!fault)
        fault = groups_fault(mesh);
    if (fault)
        return fault;
    struct kr_sides *sides =
        kr_sides_create(mesh->n_points, mesh->n_cells, mesh->first, mesh->vertex);
    fault = overlap_fault(mesh, sides);
    if (!fault)
        fault = edges_fault(mesh, sides);
    kr_sides_free(sides);
    return fault;
}
