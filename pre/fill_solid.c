/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Requests to gmsh for tetrahedra, and checks of its replies: every cell's volume is positive, the cells'
 * outer faces are the triangles asked for and nothing else, and the volumes add up.
 */
#include "fill_solid.h"

#include "base/memory.h"
#include "cell.h"
#include "face.h"

#include <math.h>
#include <string.h>

/* Mesh.Algorithm3D is 1, Delaunay. Of the others in Debian's gmsh 4.8, 4 needs Netgen, which is absent, 9
 * crashes, and 10 (HXT) differs from run to run. So the second method leaves out what moves and swaps
 * cells afterwards (Mesh.Optimize). The largest length of an edge, in spacings, is that of which cells
 * have one cube in the mean. */
const struct kr_solid_method kr_solid_methods[KR_SOLID_METHODS] = {
    {"Delaunay", 1, 1},
    {"Delaunay, not optimized", 1, 0},
};

double kr_solid_region_volume(const struct kr_solid_region *r) {
    double volume = 0;
    for (size_t t = 0; t < r->n_triangles; t++)
        volume += kr_cell_tetrahedron(r->point[0], r->point[r->triangle[t][0]], r->point[r->triangle[t][1]],
                           r->point[r->triangle[t][2]]);
    return volume;
}

/* ---- shells ---- */

static size_t root_of(size_t *parent, size_t p) {
    while (parent[p] != p)
        p = parent[p] = parent[parent[p]];
    return p;
}

/** Number of each point's shell, the one of the largest volume being 0; how many there are. */
static size_t shells_of(const struct kr_solid_region *r, size_t *shell) {
    size_t n = r->n_shell_points, count = 0, first = 0;
    size_t *parent = KR_NEW(size_t, n), *number = KR_NEW(size_t, n);
    double *volume = KR_NEW(double, n);
    for (size_t p = 0; p < n; p++)
        parent[p] = p;
    for (size_t t = 0; t < r->n_triangles; t++)
        for (int k = 1; k < 3; k++)
            parent[root_of(parent, r->triangle[t][k])] = root_of(parent, r->triangle[t][0]);
    for (size_t p = 0; p < n; p++) {
        size_t root = root_of(parent, p);
        if (!number[root])
            number[root] = ++count;
        shell[p] = number[root] - 1;
    }
    for (size_t t = 0; t < r->n_triangles; t++)
        volume[shell[r->triangle[t][0]]] +=
            kr_cell_tetrahedron(r->point[0], r->point[r->triangle[t][0]], r->point[r->triangle[t][1]],
                        r->point[r->triangle[t][2]]);
    for (size_t s = 0; s < count; s++)
        first = volume[s] > volume[first] ? s : first;
    for (size_t p = 0; p < n; p++)
        shell[p] = shell[p] == first ? 0 : shell[p] == 0 ? first : shell[p];
    kr_free(parent);
    kr_free(number);
    kr_free(volume);
    return count;
}

void kr_solid_ask(const struct kr_solid_region *r, size_t method, FILE *file, size_t *sent) {
    size_t *shell = KR_NEW(size_t, r->n_shell_points), *local = KR_NEW(size_t, r->n_shell_points);
    size_t shells = shells_of(r, shell), total = 0;
    fprintf(file, "solid algorithm %d optimize %d size 1.6 shells %zu\n", kr_solid_methods[method].algorithm,
            kr_solid_methods[method].optimize, shells);
    for (size_t s = 0; s < shells; s++) {
        size_t points = 0, triangles = 0;
        for (size_t p = 0; p < r->n_shell_points; p++)
            if (shell[p] == s) {
                local[p] = points++;
                sent[total++] = p;
            }
        for (size_t t = 0; t < r->n_triangles; t++)
            triangles += shell[r->triangle[t][0]] == s;
        fprintf(file, "shell points %zu triangles %zu\n", points, triangles);
        for (size_t p = total - points; p < total; p++)
            fprintf(file, "%.17g %.17g %.17g\n", r->point[sent[p]][0], r->point[sent[p]][1],
                    r->point[sent[p]][2]);
        for (size_t t = 0; t < r->n_triangles; t++)
            if (shell[r->triangle[t][0]] == s)
                fprintf(file, "%zu %zu %zu\n", local[r->triangle[t][0]], local[r->triangle[t][1]],
                        local[r->triangle[t][2]]);
    }
    kr_free(shell);
    kr_free(local);
}

/* ---- the reply ---- */

/** Read a reply into a copy of the region with the same shells. */
static int parse(struct kr_solid_region *got, const size_t *sent, FILE *file) {
    size_t n, m, limit;
    fseek(file, 0, SEEK_END);
    limit = (size_t)ftell(file) / 2; /* an item takes two characters or more */
    rewind(file);
    if (fscanf(file, " points %zu", &n) != 1 || n > limit)
        return 0;
    got->n_points = got->n_shell_points + n;
    got->point = kr_realloc(got->point, got->n_points, sizeof *got->point);
    for (size_t k = 3 * got->n_shell_points; k < 3 * got->n_points; k++)
        if (fscanf(file, "%lf", &got->point[k / 3][k % 3]) != 1)
            return 0;
    if (fscanf(file, " cells %zu", &m) != 1 || m > limit || !m)
        return 0;
    got->n_cells = m;
    got->cell = kr_alloc(m, sizeof *got->cell);
    for (size_t k = 0; k < 4 * m; k++) {
        size_t *at = &got->cell[k / 4][k % 4];
        if (fscanf(file, "%zu", at) != 1 || *at >= got->n_points)
            return 0;
        *at = *at < got->n_shell_points ? sent[*at] : *at;
    }
    char end[4] = "";
    return fscanf(file, " %3s", end) == 1 && !strcmp(end, "end");
}

static char *volumes_fault(struct kr_solid_region *got) {
    double sum = 0, wanted = kr_solid_region_volume(got);
    for (size_t c = 0; c < got->n_cells; c++) {
        size_t *v = got->cell[c];
        double volume = kr_cell_tetrahedron(got->point[v[0]], got->point[v[1]], got->point[v[2]], got->point[v[3]]);
        if (volume < 0) { /* gmsh does not always keep to its own order */
            size_t kept = v[0];
            v[0] = v[1];
            v[1] = kept;
            volume = -volume;
        }
        if (!(volume > 1e-10))
            return kr_text("a cell at (%g, %g, %g) is flat", got->point[v[0]][0], got->point[v[0]][1],
                           got->point[v[0]][2]);
        sum += volume;
    }
    if (!(fabs(sum - wanted) <= 1e-9 * wanted))
        return kr_text("the cells' volumes sum to %.12g instead of %.12g spacings cubed", sum, wanted);
    return NULL;
}

/** Every triangle asked for is the face of just one cell; every other face is that of two. */
static char *boundary_fault(const struct kr_solid_region *got) {
    struct kr_mesh mesh = {.dim = 3, .n_points = got->n_points, .n_cells = got->n_cells};
    char *fault = NULL;
    size_t outer = 0;
    mesh.first = KR_NEW(size_t, got->n_cells + 1);
    for (size_t c = 0; c <= got->n_cells; c++)
        mesh.first[c] = 4 * c;
    mesh.vertex = (size_t *)got->cell;
    struct kr_faces *faces = kr_faces_create(&mesh);
    for (size_t f = 0; f < faces->count && !fault; f++) {
        size_t vertex[KR_MOST_FACE], n = kr_faces_vertices(faces, faces->face[f], vertex);
        struct kr_face_match match = kr_faces_match(faces, n, vertex);
        if (match.count > 2 || match.same > 1)
            fault = kr_text("cells overlap at (%g, %g, %g)", got->point[vertex[0]][0],
                            got->point[vertex[0]][1], got->point[vertex[0]][2]);
        outer += match.count == 1;
    }
    for (size_t t = 0; t < got->n_triangles && !fault; t++)
        if (kr_faces_match(faces, 3, got->triangle[t]).count != 1)
            fault = kr_text("a triangle of the boundary at (%g, %g, %g) is no face of one cell",
                            got->point[got->triangle[t][0]][0], got->point[got->triangle[t][0]][1],
                            got->point[got->triangle[t][0]][2]);
    if (!fault && outer != got->n_triangles)
        fault = kr_text("the cells have %zu outer faces, the boundary %zu", outer, got->n_triangles);
    kr_faces_free(faces);
    kr_free(mesh.first);
    return fault;
}

char *kr_solid_take(struct kr_solid_region *r, const size_t *sent, FILE *file) {
    struct kr_solid_region got = *r;
    got.point = kr_alloc(r->n_shell_points, sizeof *got.point);
    memcpy(got.point, r->point, r->n_shell_points * sizeof *r->point);
    got.cell = NULL;
    char *fault = parse(&got, sent, file) ? NULL : kr_text("its reply ends early");
    if (!fault)
        fault = volumes_fault(&got);
    if (!fault)
        fault = boundary_fault(&got);
    kr_free(fault ? got.point : r->point);
    kr_free(fault ? got.cell : r->cell);
    if (!fault)
        *r = got;
    return fault;
}
