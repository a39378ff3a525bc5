/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Writing Abaqus' keywords (CalculiX 2.20 manual, chapter 7). See inp.h.
 */
#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "inp.h"

#include <stdio.h>

enum { MOST_CORNERS = 20 };

static const char *const plane[MOST_CORNERS + 1] = {[3] = "CPS3", [4] = "CPS4"};
static const char *const solid[MOST_CORNERS + 1] = {[4] = "C3D4",   [6] = "C3D6",   [8] = "C3D8",
                                                    [10] = "C3D10", [15] = "C3D15", [20] = "C3D20"};

static int64_t corners_of(const struct kr_nodes *nodes, int64_t i) {
    return nodes->first[i + 1] - nodes->first[i];
}

/* Whether a cell becomes triangles about its centroid. */
static int is_fan(const struct kr_nodes *nodes, int64_t i) {
    return nodes->dim == 2 && corners_of(nodes, i) > 4;
}

static const char *type_of(const struct kr_nodes *nodes, int64_t i) {
    int64_t corners = corners_of(nodes, i);
    if (is_fan(nodes, i) || corners > MOST_CORNERS)
        return NULL;
    return (nodes->dim == 2 ? plane : solid)[corners];
}

static void check(const struct kr_nodes *nodes, const char *path) {
    if (!nodes->n_points)
        kr_stop(KR_EXIT_INPUT, "%s: found nodes without cells, expected cells, which become elements; "
                               "begin with a mesh", path);
    for (int64_t i = 0; i < (int64_t)nodes->n; i++)
        if (!is_fan(nodes, i) && !type_of(nodes, i))
            kr_stop(KR_EXIT_INPUT, "%s: found cell %lld with %lld corners, expected a kind of solid "
                                   "that CalculiX has (4, 6, 8, 10, 15 or 20 corners); mesh with "
                                   "tetrahedra or hexahedra", path,
                    (long long)nodes->tag[i], (long long)corners_of(nodes, i));
}

/* CalculiX reads 20 characters of a number, which hold 13 digits with sign and exponent. */
static void put_point(FILE *to, size_t number, int dim, const double *x) {
    fprintf(to, "%zu, %.13g, %.13g, %.13g\n", number, x[0], x[1], dim == 3 ? x[2] : 0);
}

/* Corners, then the middles of fans. */
static void put_points(FILE *to, const struct kr_nodes *nodes) {
    size_t dim = (size_t)nodes->dim, number = nodes->n_points;
    fprintf(to, "*NODE\n");
    for (size_t p = 0; p < nodes->n_points; p++)
        put_point(to, p + 1, nodes->dim, nodes->point + dim * p);
    for (int64_t i = 0; i < (int64_t)nodes->n; i++)
        if (is_fan(nodes, i))
            put_point(to, ++number, nodes->dim, nodes->position + dim * (size_t)i);
}

static void put_cells(FILE *to, const struct kr_nodes *nodes, const char *type) {
    int begun = 0;
    for (int64_t i = 0; i < (int64_t)nodes->n; i++) {
        if (type_of(nodes, i) != type)
            continue;
        if (!begun++)
            fprintf(to, "*ELEMENT, TYPE=%s, ELSET=cells\n", type);
        fprintf(to, "%lld", (long long)i + 1);
        for (int64_t v = nodes->first[i], k = 1; v < nodes->first[i + 1]; v++, k++)
            fprintf(to, k % 15 ? ", %lld" : ",\n%lld", (long long)nodes->vertex[v] + 1);
        fputc('\n', to);
    }
}

static void put_fans(FILE *to, const struct kr_nodes *nodes) {
    size_t middle = nodes->n_points, number = nodes->n;
    for (int64_t i = 0; i < (int64_t)nodes->n; i++) {
        if (!is_fan(nodes, i))
            continue;
        if (middle == nodes->n_points)
            fprintf(to, "*ELEMENT, TYPE=CPS3, ELSET=cells\n");
        const int64_t *vertex = nodes->vertex + nodes->first[i];
        int64_t corners = corners_of(nodes, i);
        middle++;
        for (int64_t k = 0; k < corners; k++)
            fprintf(to, "%zu, %zu, %lld, %lld\n", ++number, middle, (long long)vertex[k] + 1,
                    (long long)vertex[(k + 1) % corners] + 1);
    }
}

/* Marks of all corners (and middles of fans) of a set's cells, of its whole cells and of the triangles. */
struct marks {
    unsigned char *point, *element;
    size_t n_points, n_elements;
};

static struct marks mark_set(const struct kr_nodes *nodes, const struct kr_set *set) {
    struct marks m = {.n_points = nodes->n_points, .n_elements = nodes->n};
    for (int64_t i = 0; i < (int64_t)nodes->n; i++)
        if (is_fan(nodes, i)) {
            m.n_points++;
            m.n_elements += (size_t)corners_of(nodes, i);
        }
    m.point = KR_NEW(unsigned char, m.n_points);
    m.element = KR_NEW(unsigned char, m.n_elements);
    size_t member = 0, middle = nodes->n_points, triangle = nodes->n;
    for (int64_t i = 0; i < (int64_t)nodes->n; i++) {
        int is_in = member < set->count && set->node[member] == i;
        member += (size_t)is_in;
        for (int64_t v = nodes->first[i]; is_in && v < nodes->first[i + 1]; v++)
            m.point[nodes->vertex[v]] = 1;
        if (!is_fan(nodes, i)) {
            m.element[i] = (unsigned char)is_in;
            continue;
        }
        m.point[middle++] = (unsigned char)is_in;
        for (int64_t k = 0; k < corners_of(nodes, i); k++)
            m.element[triangle++] = (unsigned char)is_in;
    }
    return m;
}

static void put_marked(FILE *to, const char *keyword, const char *name, size_t n,
                       const unsigned char *mark) {
    fprintf(to, "*%s, %s=%s\n", keyword, keyword, name);
    for (size_t k = 0; k < n; k++)
        if (mark[k])
            fprintf(to, "%zu,\n", k + 1);
}

void kr_inp_write(const struct kr_nodes *nodes, const char *path) {
    check(nodes, path);
    struct kr_file file = kr_file_begin(kr_text_copy(path));
    fprintf(file.to, "** Corners, elements and sets of a body; lengths in m.\n");
    put_points(file.to, nodes);
    for (int k = 0; k <= MOST_CORNERS; k++)
        if ((nodes->dim == 2 ? plane : solid)[k])
            put_cells(file.to, nodes, (nodes->dim == 2 ? plane : solid)[k]);
    put_fans(file.to, nodes);
    for (size_t s = 0; s < nodes->n_sets; s++) {
        struct marks m = mark_set(nodes, &nodes->set[s]);
        put_marked(file.to, "ELSET", nodes->set[s].name, m.n_elements, m.element);
        put_marked(file.to, "NSET", nodes->set[s].name, m.n_points, m.point);
        kr_free(m.point);
        kr_free(m.element);
    }
    kr_file_end(&file);
}
