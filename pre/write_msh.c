/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Writing gmsh's MSH 4.1, binary (https://gmsh.info/doc/texinfo/gmsh.html, "MSH file format").
 *
 * In this format not the cells but the "entities" they lie on belong to physical groups. So the
 * cells are sorted into classes, one for each set of groups that occurs, and each class becomes an
 * entity; the same for edges, in 3D for faces.
 */
#include "mesh.h"

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "element.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* One above the greatest number of gmsh's for an element that is written here: a pyramid. */
enum { KINDS = 8 };

/** Classes of the items of one dimension. Class 0 is in no group; any other is in the group by
 *  which it was split from its parent, and in all groups of the parent. */
struct classes {
    int dim;
    size_t n_items, count, room;
    size_t *of_item;        /* (n_items) */
    size_t *parent, *group; /* (count) */
    size_t *size;           /* (count) items in it */
};

static size_t add_class(struct classes *classes, size_t parent, size_t group) {
    if (classes->count == classes->room) {
        classes->room = classes->room ? 2 * classes->room : 16;
        classes->parent = kr_realloc(classes->parent, classes->room, sizeof(size_t));
        classes->group = kr_realloc(classes->group, classes->room, sizeof(size_t));
        classes->size = kr_realloc(classes->size, classes->room, sizeof(size_t));
    }
    classes->parent[classes->count] = parent;
    classes->group[classes->count] = group;
    return classes->count++;
}

static struct classes classify(const struct kr_mesh *mesh, int dim) {
    struct classes classes = {.dim = dim,
                              .n_items = dim == mesh->dim ? mesh->n_cells
                                         : dim == 1       ? mesh->n_edges
                                                          : mesh->n_faces};
    classes.of_item = KR_NEW(size_t, classes.n_items);
    add_class(&classes, 0, 0);
    classes.size[0] = classes.n_items;
    for (size_t g = 0; g < mesh->n_groups; g++) {
        const struct kr_mesh_group *group = &mesh->group[g];
        if (group->dim != dim)
            continue;
        size_t before = classes.count;
        size_t *split = KR_NEW(size_t, before); /* class that this group splits from one; 0: none */
        for (size_t k = 0; k < group->count; k++) {
            size_t *of = &classes.of_item[group->member[k]];
            if (!split[*of])
                split[*of] = add_class(&classes, *of, g);
            classes.size[*of]--;
            *of = split[*of];
            classes.size[*of]++;
        }
        kr_free(split);
    }
    return classes;
}

static void free_classes(struct classes *classes) {
    kr_free(classes->of_item);
    kr_free(classes->parent);
    kr_free(classes->group);
    kr_free(classes->size);
}

static size_t entities_of(const struct classes *classes) {
    size_t n = 0;
    for (size_t k = 0; k < classes->count; k++)
        n += classes->size[k] > 0;
    return n;
}

/* Errors of these are asked for once, at the end. */
static void put_int(FILE *file, int value) {
    fwrite(&value, sizeof value, 1, file);
}

static void put_size(FILE *file, size_t value) {
    uint64_t wide = value;
    fwrite(&wide, sizeof wide, 1, file);
}

static void put_double(FILE *file, double value) {
    fwrite(&value, sizeof value, 1, file);
}

static void write_names(const struct kr_mesh *mesh, FILE *file) {
    fprintf(file, "$PhysicalNames\n%zu\n", mesh->n_groups);
    for (size_t g = 0; g < mesh->n_groups; g++)
        fprintf(file, "%d %d \"%s\"\n", mesh->group[g].dim, mesh->group[g].tag,
                mesh->group[g].name);
    fprintf(file, "$EndPhysicalNames\n");
}

static void write_entities_of(const struct kr_mesh *mesh, const struct classes *classes,
                              const double box[6], FILE *file) {
    for (size_t k = 0; k < classes->count; k++) {
        size_t groups = 0;
        if (!classes->size[k])
            continue;
        put_int(file, (int)k + 1);
        for (int d = 0; d < 6; d++)
            put_double(file, box[d]);
        for (size_t c = k; c; c = classes->parent[c])
            groups++;
        put_size(file, groups);
        for (size_t c = k; c; c = classes->parent[c])
            put_int(file, mesh->group[classes->group[c]].tag);
        put_size(file, 0); /* entities that bound it: none are named */
    }
}

static void write_entities(const struct kr_mesh *mesh, const struct classes *facets,
                           const struct classes *cells, FILE *file) {
    double box[6] = {INFINITY, INFINITY, INFINITY, -INFINITY, -INFINITY, -INFINITY};
    for (size_t k = 0; k < 3 * mesh->n_points; k++) {
        box[k % 3] = fmin(box[k % 3], mesh->point[k]);
        box[3 + k % 3] = fmax(box[3 + k % 3], mesh->point[k]);
    }
    fprintf(file, "$Entities\n");
    for (int dim = 0; dim <= 3; dim++)
        put_size(file, dim == facets->dim  ? entities_of(facets)
                       : dim == cells->dim ? entities_of(cells)
                                           : 0);
    write_entities_of(mesh, facets, box, file);
    write_entities_of(mesh, cells, box, file);
    fprintf(file, "\n$EndEntities\n");
}

static void write_nodes(const struct kr_mesh *mesh, const struct classes *cells, FILE *file) {
    size_t first = 0;
    while (first + 1 < cells->count && !cells->size[first])
        first++;
    fprintf(file, "$Nodes\n");
    put_size(file, 1);
    put_size(file, mesh->n_points);
    put_size(file, 1);
    put_size(file, mesh->n_points);
    put_int(file, mesh->dim);
    put_int(file, (int)first + 1);
    put_int(file, 0);
    put_size(file, mesh->n_points);
    for (size_t p = 0; p < mesh->n_points; p++)
        put_size(file, p + 1);
    for (size_t k = 0; k < 3 * mesh->n_points; k++)
        put_double(file, mesh->point[k]);
    fprintf(file, "\n$EndNodes\n");
}

/** Points of a cell, or of an edge or face; returns how many. */
static size_t points_of(const struct kr_mesh *mesh, int dim, size_t item, const size_t **point) {
    if (dim == mesh->dim) {
        *point = mesh->vertex + mesh->first[item];
        return mesh->first[item + 1] - mesh->first[item];
    }
    *point = dim == 1 ? mesh->edge + 2 * item : mesh->face + mesh->face_first[item];
    return dim == 1 ? 2 : mesh->face_first[item + 1] - mesh->face_first[item];
}

static int type_of(const struct kr_mesh *mesh, int dim, size_t item) {
    const size_t *point;
    size_t n = points_of(mesh, dim, item, &point);
    int type = kr_element_type(dim, n);
    if (!type || type >= KINDS)
        kr_stop(KR_EXIT_INPUT,
                "cell %lld has %zu corners; a .msh file holds triangles, quadrilaterals and solids "
                "of four to eight corners only",
                (long long)(dim == mesh->dim ? mesh->cell_tag[item] : 0), n);
    return type;
}

/** Write the blocks of one dimension, or only count them where file is NULL. The number of
 *  an edge or face follows those of the cells. */
static size_t write_blocks(const struct kr_mesh *mesh, const struct classes *classes,
                           size_t last_cell, FILE *file) {
    size_t blocks = 0, kinds = KINDS * classes->count;
    size_t *count = KR_NEW(size_t, kinds), *first = KR_NEW(size_t, kinds + 1);
    size_t *sorted = KR_NEW(size_t, classes->n_items);
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < classes->n_items; i++) {
            size_t kind =
                classes->of_item[i] * KINDS + (size_t)type_of(mesh, classes->dim, i);
            if (pass)
                sorted[first[kind] + count[kind]] = i;
            count[kind]++;
        }
        for (size_t k = 0; k < kinds && !pass; k++) {
            first[k + 1] = first[k] + count[k];
            count[k] = 0;
        }
    }
    for (size_t k = 0; k < kinds; k++) {
        if (!count[k])
            continue;
        blocks++;
        if (!file)
            continue;
        put_int(file, classes->dim);
        put_int(file, (int)(k / KINDS) + 1);
        put_int(file, (int)(k % KINDS));
        put_size(file, count[k]);
        for (size_t s = first[k]; s < first[k + 1]; s++) {
            size_t i = sorted[s];
            const size_t *v;
            size_t n = points_of(mesh, classes->dim, i, &v);
            put_size(file, classes->dim < mesh->dim ? last_cell + 1 + i : (size_t)mesh->cell_tag[i]);
            for (size_t c = 0; c < n; c++)
                put_size(file, v[c] + 1);
        }
    }
    kr_free(count);
    kr_free(first);
    kr_free(sorted);
    return blocks;
}

static void write_elements(const struct kr_mesh *mesh, const struct classes *facets,
                           const struct classes *cells, FILE *file) {
    int64_t least = INT64_MAX, most = 0;
    for (size_t c = 0; c < mesh->n_cells; c++) {
        least = mesh->cell_tag[c] < least ? mesh->cell_tag[c] : least;
        most = mesh->cell_tag[c] > most ? mesh->cell_tag[c] : most;
    }
    size_t last = (size_t)most;
    fprintf(file, "$Elements\n");
    put_size(file, write_blocks(mesh, facets, last, NULL) + write_blocks(mesh, cells, last, NULL));
    put_size(file, facets->n_items + mesh->n_cells);
    put_size(file, (size_t)least);
    put_size(file, last + facets->n_items);
    write_blocks(mesh, facets, last, file);
    write_blocks(mesh, cells, last, file);
    fprintf(file, "\n$EndElements\n");
}

void kr_mesh_write_msh(const struct kr_mesh *mesh, const char *path) {
    struct kr_file whole = kr_file_begin(kr_text_copy(path));
    FILE *file = whole.to;
    struct classes facets = classify(mesh, mesh->dim - 1), cells = classify(mesh, mesh->dim);
    fprintf(file, "$MeshFormat\n4.1 1 8\n");
    put_int(file, 1); /* tells a reader the order of bytes */
    fprintf(file, "\n$EndMeshFormat\n");
    write_names(mesh, file);
    write_entities(mesh, &facets, &cells, file);
    write_nodes(mesh, &cells, file);
    write_elements(mesh, &facets, &cells, file);
    kr_file_end(&whole);
    free_classes(&facets);
    free_classes(&cells);
}
