/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Reading gmsh's MSH 4.1, ASCII and binary (https://gmsh.info/doc/texinfo/gmsh.html, "MSH file
 * format"): triangles, quadrilaterals and lines. Points and sections that are not needed are
 * passed over. Cells and edges are sorted by their numbers; lines in no physical group say nothing
 * and are dropped; cells that go round clockwise are turned.
 */
#include "mesh.h"

#include "base/error.h"
#include "base/memory.h"
#include "cell.h"
#include "scan.h"

#include <stdlib.h>
#include <string.h>

/** A curve (dim 1) or surface (dim 2) and the physical groups it belongs to. */
struct entity {
    int dim, tag;
    size_t n_groups;
    int *group;
};

struct name {
    int dim, tag;
    char *text;
};

/** A line, triangle or quadrilateral as it stands in the file. */
struct element {
    size_t tag;
    size_t entity; /* place + 1; 0: none is known */
    size_t n;
    size_t node[4]; /* numbers in the file, later places */
};

struct node {
    size_t tag, place;
};

struct reader {
    struct kr_scan scan;
    size_t n_entities, n_names, n_nodes, n_elements[3], room[3];
    int has_entities, has_nodes, has_elements;
    struct entity *entity;
    struct name *name;
    struct node *node; /* ascending by tag once all are read */
    double *point;
    struct element *element[3]; /* by dimension: 1 and 2 */
};

static void read_format(struct reader *reader) {
    struct kr_scan *scan = &reader->scan;
    char version[16];
    kr_scan_expect(scan, "$MeshFormat");
    kr_scan_word(scan, version, sizeof version);
    if (strcmp(version, "4.1"))
        kr_scan_bad(scan,
                    "the file is MSH version '%s', and 4.1 is needed: "
                    "gmsh FILE.msh -save -format msh41 -o NEW.msh makes it",
                    version);
    int is_binary = kr_scan_int(scan, "the file type, 0 or 1");
    int size = kr_scan_int(scan, "the size of numbers, 8");
    if (is_binary < 0 || is_binary > 1 || size != 8)
        kr_scan_bad(scan, "expected file type 0 or 1 and numbers of 8 bytes, found %d and %d",
                    is_binary, size);
    if (is_binary) {
        scan->at++; /* the end of the line */
        scan->is_binary = 1;
        if (kr_scan_int(scan, "the number 1") != 1)
            kr_scan_bad(scan, "the file was written by a machine with another order of bytes; save "
                              "it as ASCII there");
    }
    kr_scan_expect(scan, "$EndMeshFormat");
}

/** `what` names, in ASCII also in a binary file. */
static void read_names(struct reader *reader) {
    struct kr_scan *scan = &reader->scan;
    int is_binary = scan->is_binary;
    scan->is_binary = 0;
    size_t n = kr_scan_count(scan, 3, "the number of physical names");
    reader->name = KR_NEW(struct name, n);
    for (; reader->n_names < n; reader->n_names++) {
        struct name *name = &reader->name[reader->n_names];
        name->dim = kr_scan_int(scan, "the dimension of a physical name");
        name->tag = kr_scan_int(scan, "the number of a physical name");
        size_t from = scan->at + strspn(scan->data + scan->at, " \t");
        size_t length = scan->data[from] == '"' ? strcspn(scan->data + from + 1, "\"\n") : 0;
        if (!length || scan->data[from + 1 + length] != '"')
            kr_scan_bad(scan, "expected a physical name in quotes");
        name->text = kr_text("%.*s", (int)length, scan->data + from + 1);
        scan->at = from + length + 2;
    }
    scan->is_binary = is_binary;
}

/** One entity of a dimension; those of dimension 0 and 3 are passed over. */
static void read_entity(struct reader *reader, int dim) {
    struct kr_scan *scan = &reader->scan;
    struct entity entity = {dim, kr_scan_int(scan, "the number of an entity"), 0, NULL};
    for (int k = 0; k < (dim == 0 ? 3 : 6); k++)
        kr_scan_double(scan, "the box around an entity");
    entity.n_groups = kr_scan_count(scan, 1, "the number of an entity's physical groups");
    entity.group = KR_NEW(int, entity.n_groups);
    for (size_t k = 0; k < entity.n_groups; k++)
        entity.group[k] = abs(kr_scan_int(scan, "a physical group")); /* the sign is its sense */
    if (dim > 0) {
        size_t n = kr_scan_count(scan, 1, "the number of entities that bound one");
        for (size_t k = 0; k < n; k++)
            kr_scan_int(scan, "an entity that bounds one");
    }
    if (dim == 1 || dim == 2)
        reader->entity[reader->n_entities++] = entity;
    else
        kr_free(entity.group);
}

static void read_entities(struct reader *reader) {
    struct kr_scan *scan = &reader->scan;
    size_t n[4], total = 0;
    for (int dim = 0; dim < 4; dim++)
        total += n[dim] = kr_scan_count(scan, 5, "the number of entities");
    reader->entity = KR_NEW(struct entity, total);
    reader->has_entities = 1;
    for (int dim = 0; dim < 4; dim++)
        for (size_t k = 0; k < n[dim]; k++)
            read_entity(reader, dim);
}

static int by_tag(const void *a, const void *b) {
    size_t p = ((const struct node *)a)->tag, q = ((const struct node *)b)->tag;
    return (p > q) - (p < q);
}

static void sort_nodes(struct reader *reader) {
    qsort(reader->node, reader->n_nodes, sizeof *reader->node, by_tag);
    for (size_t k = 1; k < reader->n_nodes; k++)
        if (reader->node[k].tag == reader->node[k - 1].tag)
            kr_scan_bad(&reader->scan, "node %zu stands twice in the file", reader->node[k].tag);
}

static void read_nodes(struct reader *reader) {
    struct kr_scan *scan = &reader->scan;
    size_t blocks = kr_scan_count(scan, 4, "the number of blocks of nodes");
    size_t n = kr_scan_count(scan, 4, "the number of nodes");
    kr_scan_size(scan, "the least number of a node");
    kr_scan_size(scan, "the greatest number of a node");
    reader->node = KR_NEW(struct node, n);
    reader->point = KR_NEW(double, 3 * n);
    reader->has_nodes = 1;
    for (size_t b = 0; b < blocks; b++) {
        int dim = kr_scan_int(scan, "the dimension of a block");
        kr_scan_int(scan, "the entity of a block");
        int extra = kr_scan_int(scan, "whether nodes are parametric") ? dim : 0;
        size_t count = kr_scan_count(scan, 4, "the number of nodes of a block");
        size_t from = reader->n_nodes;
        if (count > n - from)
            kr_scan_bad(scan, "there are more nodes than the %zu that the section announced", n);
        for (size_t k = from; k < from + count; k++)
            reader->node[k] = (struct node){kr_scan_size(scan, "the number of a node"), k};
        for (size_t k = from; k < from + count; k++) {
            for (size_t d = 0; d < 3; d++)
                reader->point[3 * k + d] = kr_scan_double(scan, "a coordinate of a node");
            for (int d = 0; d < extra; d++)
                kr_scan_double(scan, "a parameter of a node");
        }
        reader->n_nodes += count;
    }
    if (reader->n_nodes != n)
        kr_scan_bad(scan, "expected %zu nodes, found %zu", n, reader->n_nodes);
    sort_nodes(reader);
}

/** Corners of a type of element; stops for one that this reader does not know. */
static size_t corners_of(const struct kr_scan *scan, int type) {
    switch (type) {
    case 1:
        return 2;
    case 2:
        return 3;
    case 3:
        return 4;
    case 15:
        return 1;
    case 4:
    case 5:
    case 6:
    case 7:
        kr_scan_bad(scan,
                    "elements of type %d are solids; a plane mesh of triangles and "
                    "quadrilaterals is expected",
                    type);
    default:
        kr_scan_bad(scan,
                    "elements of type %d are not read: triangles (2), quadrilaterals (3) and "
                    "lines (1) are; save the mesh with order 1",
                    type);
    }
}

static size_t find_entity(const struct reader *reader, int dim, int tag) {
    for (size_t k = 0; k < reader->n_entities; k++)
        if (reader->entity[k].dim == dim && reader->entity[k].tag == tag)
            return k + 1;
    if (reader->has_entities)
        kr_scan_bad(&reader->scan, "elements lie on %s %d, which $Entities does not name",
                    dim == 1 ? "curve" : "surface", tag);
    return 0;
}

static void read_block(struct reader *reader, size_t *left) {
    struct kr_scan *scan = &reader->scan;
    int dim = kr_scan_int(scan, "the dimension of a block");
    int tag = kr_scan_int(scan, "the entity of a block");
    int type = kr_scan_int(scan, "the type of elements");
    size_t corners = corners_of(scan, type);
    size_t count = kr_scan_count(scan, corners + 1, "the number of elements of a block");
    if (count > *left)
        kr_scan_bad(scan, "there are more elements than the section announced");
    *left -= count;
    if (dim != (corners == 1 ? 0 : corners == 2 ? 1 : 2))
        kr_scan_bad(scan, "elements of type %d cannot lie on an entity of dimension %d", type, dim);
    size_t entity = dim > 0 ? find_entity(reader, dim, tag) : 0;
    for (size_t k = 0; k < count; k++) {
        struct element element = {
            kr_scan_size(scan, "the number of an element"), entity, corners, {0}};
        for (size_t c = 0; c < corners; c++)
            element.node[c] = kr_scan_size(scan, "a node of an element");
        if (dim == 0 || (dim == 1 && (!entity || !reader->entity[entity - 1].n_groups)))
            continue;
        KR_GROW(reader->element[dim], reader->n_elements[dim], reader->room[dim]);
        reader->element[dim][reader->n_elements[dim]++] = element;
    }
}

static void read_elements(struct reader *reader) {
    struct kr_scan *scan = &reader->scan;
    size_t blocks = kr_scan_count(scan, 4, "the number of blocks of elements");
    size_t left = kr_scan_count(scan, 2, "the number of elements");
    kr_scan_size(scan, "the least number of an element");
    kr_scan_size(scan, "the greatest number of an element");
    reader->has_elements = 1;
    for (size_t b = 0; b < blocks; b++)
        read_block(reader, &left);
    if (left)
        kr_scan_bad(scan, "%zu elements fewer than the section announced", left);
}

/** Pass over a section up to its end. */
static void skip_section(struct kr_scan *scan, const char *section) {
    char *end = kr_text("\n$End%s", section + 1);
    const char *found = memmem(scan->data + scan->at, scan->size - scan->at, end, strlen(end));
    if (!found)
        kr_scan_bad(scan, "section %.60s does not end: the file is cut or garbled", section);
    scan->at = (size_t)(found - scan->data);
    kr_free(end);
}

static void read_section(struct reader *reader, const char *section) {
    struct kr_scan *scan = &reader->scan;
    int again = (reader->has_entities && !strcmp(section, "$Entities")) ||
                (reader->has_nodes && !strcmp(section, "$Nodes")) ||
                (reader->has_elements && !strcmp(section, "$Elements")) ||
                (reader->name && !strcmp(section, "$PhysicalNames"));
    if (section[0] != '$' || again)
        kr_scan_bad(scan, again ? "section %s stands twice" : "expected a section, found '%.20s'",
                    section);
    if (!strcmp(section, "$PartitionedEntities"))
        kr_scan_bad(scan, "the mesh is partitioned; save it whole");
    scan->at += scan->is_binary && scan->at < scan->size; /* the end of the line */
    if (!strcmp(section, "$PhysicalNames"))
        read_names(reader);
    else if (!strcmp(section, "$Entities"))
        read_entities(reader);
    else if (!strcmp(section, "$Nodes"))
        read_nodes(reader);
    else if (!strcmp(section, "$Elements"))
        read_elements(reader);
    else
        skip_section(scan, section);
    char *end = kr_text("$End%s", section + 1);
    kr_scan_expect(scan, end);
    kr_free(end);
}

/** Place of a node: at once where the numbers have no gaps, else by halving. */
static size_t place_of(const struct reader *reader, size_t tag) {
    const struct node *node = reader->node;
    size_t low = 0, high = reader->n_nodes;
    if (high && tag >= node[0].tag && tag - node[0].tag < high &&
        node[tag - node[0].tag].tag == tag)
        return node[tag - node[0].tag].place;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (node[middle].tag == tag)
            return node[middle].place;
        if (node[middle].tag < tag)
            low = middle + 1;
        else
            high = middle;
    }
    kr_stop(KR_EXIT_INPUT, "%s: an element has node %zu, which $Nodes does not hold",
            reader->scan.path, tag);
}

static int element_by_tag(const void *a, const void *b) {
    size_t p = ((const struct element *)a)->tag, q = ((const struct element *)b)->tag;
    return (p > q) - (p < q);
}

static void sort_elements(struct reader *reader, int dim) {
    struct element *element = reader->element[dim];
    size_t n = reader->n_elements[dim], k = 1;
    while (k < n && element[k].tag > element[k - 1].tag)
        k++;
    if (k < n)
        qsort(element, n, sizeof *element, element_by_tag);
    for (k = 0; k < n; k++) {
        if (k && element[k].tag == element[k - 1].tag)
            kr_stop(KR_EXIT_INPUT, "%s: element %zu stands twice in the file", reader->scan.path,
                    element[k].tag);
        for (size_t c = 0; c < element[k].n; c++)
            element[k].node[c] = place_of(reader, element[k].node[c]);
    }
}

/** Vertices of a cell into the mesh, counter-clockwise. */
static void lay_cell(struct kr_mesh *mesh, const struct element *element, size_t *vertex) {
    double corner[8], centroid[2];
    for (size_t k = 0; k < element->n; k++)
        memcpy(corner + 2 * k, mesh->point + 3 * element->node[k], 2 * sizeof *corner);
    int is_clockwise = kr_cell_polygon(element->n, corner, centroid) < 0;
    for (size_t k = 0; k < element->n; k++)
        vertex[k] = element->node[is_clockwise ? element->n - 1 - k : k];
}

static void lay_elements(struct reader *reader, struct kr_mesh *mesh) {
    const struct element *cell = reader->element[2], *edge = reader->element[1];
    mesh->n_points = reader->n_nodes;
    mesh->point = reader->point;
    reader->point = NULL;
    mesh->n_cells = reader->n_elements[2];
    mesh->first = kr_realloc(mesh->first, mesh->n_cells + 1, sizeof *mesh->first);
    mesh->vertex = KR_NEW(size_t, 4 * mesh->n_cells);
    mesh->cell_tag = KR_NEW(int64_t, mesh->n_cells);
    for (size_t c = 0; c < mesh->n_cells; c++) {
        mesh->cell_tag[c] = (int64_t)cell[c].tag;
        mesh->first[c + 1] = mesh->first[c] + cell[c].n;
        lay_cell(mesh, &cell[c], mesh->vertex + mesh->first[c]);
    }
    mesh->n_edges = reader->n_elements[1];
    mesh->edge = KR_NEW(size_t, 2 * mesh->n_edges);
    for (size_t e = 0; e < mesh->n_edges; e++)
        memcpy(mesh->edge + 2 * e, edge[e].node, 2 * sizeof *mesh->edge);
}

static struct kr_mesh_group *group_of(struct kr_mesh *mesh, int dim, int tag, size_t *room) {
    for (size_t g = 0; g < mesh->n_groups; g++)
        if (mesh->group[g].dim == dim && mesh->group[g].tag == tag)
            return &mesh->group[g];
    KR_GROW(mesh->group, mesh->n_groups, *room);
    mesh->group[mesh->n_groups] = (struct kr_mesh_group){NULL, dim, tag, 0, NULL};
    return &mesh->group[mesh->n_groups++];
}

/** Make the groups: those with names in their order, then nameless ones, which are called after
 *  their number. */
static void lay_groups(struct reader *reader, struct kr_mesh *mesh) {
    size_t room = 0;
    for (size_t k = 0; k < reader->n_names; k++)
        if (reader->name[k].dim == 1 || reader->name[k].dim == 2) {
            struct kr_mesh_group *group =
                group_of(mesh, reader->name[k].dim, reader->name[k].tag, &room);
            if (!group->name)
                group->name = kr_text_copy(reader->name[k].text);
        }
    for (size_t k = 0; k < reader->n_entities; k++)
        for (size_t g = 0; g < reader->entity[k].n_groups; g++) {
            struct kr_mesh_group *group =
                group_of(mesh, reader->entity[k].dim, reader->entity[k].group[g], &room);
            if (!group->name)
                group->name = kr_text("group_%d", group->tag);
        }
}

/** Put cells or edges into their groups. */
static void fill_groups(struct reader *reader, struct kr_mesh *mesh, int dim) {
    size_t *room = KR_NEW(size_t, mesh->n_groups), unused = 0;
    for (size_t k = 0; k < reader->n_elements[dim]; k++) {
        size_t e = reader->element[dim][k].entity;
        for (size_t g = 0; e && g < reader->entity[e - 1].n_groups; g++) {
            struct kr_mesh_group *group =
                group_of(mesh, dim, reader->entity[e - 1].group[g], &unused);
            size_t *room_of = &room[group - mesh->group];
            if (group->count && group->member[group->count - 1] == k)
                continue; /* the entity names the group twice */
            KR_GROW(group->member, group->count, *room_of);
            group->member[group->count++] = k;
        }
    }
    kr_free(room);
}

static void free_reader(struct reader *reader) {
    for (size_t k = 0; k < reader->n_entities; k++)
        kr_free(reader->entity[k].group);
    for (size_t k = 0; k < reader->n_names; k++)
        kr_free(reader->name[k].text);
    kr_free(reader->entity);
    kr_free(reader->name);
    kr_free(reader->node);
    kr_free(reader->point);
    kr_free(reader->element[1]);
    kr_free(reader->element[2]);
    kr_scan_close(&reader->scan);
}

struct kr_mesh *kr_mesh_read_msh(const char *path) {
    struct reader reader = {.scan = kr_scan_open(path)};
    char section[64];
    read_format(&reader);
    while (kr_scan_word(&reader.scan, section, sizeof section))
        read_section(&reader, section);
    if (!reader.has_nodes || !reader.has_elements)
        kr_scan_bad(&reader.scan, "the file has no section %s: it is cut or holds no mesh",
                    reader.has_nodes ? "$Elements" : "$Nodes");
    if (!reader.n_elements[2])
        kr_stop(KR_EXIT_INPUT,
                "%s holds no triangles and no quadrilaterals; if the mesh has "
                "physical groups, its surface must be in one",
                path);
    struct kr_mesh *mesh = kr_mesh_create();
    sort_elements(&reader, 1);
    sort_elements(&reader, 2);
    lay_elements(&reader, mesh);
    lay_groups(&reader, mesh);
    fill_groups(&reader, mesh, 1);
    fill_groups(&reader, mesh, 2);
    free_reader(&reader);
    return mesh;
}
