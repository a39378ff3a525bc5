/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Reading gmsh's MSH 2.2 and 4.1, ASCII and binary: the frame of sections and what both versions
 * have in common. Sections that are not needed are passed over.
 */
#include "msh.h"

#include "base/error.h"
#include "base/memory.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

/** Returns the version, 2 or 4. */
static int read_format(struct kr_msh *msh) {
    struct kr_scan *scan = &msh->scan;
    char version[16];
    kr_scan_expect(scan, "$MeshFormat");
    kr_scan_word(scan, version, sizeof version);
    int is_2 = !strcmp(version, "2.2") || !strcmp(version, "2.1") || !strcmp(version, "2") ||
               !strcmp(version, "2.0");
    if (!is_2 && strcmp(version, "4.1"))
        kr_scan_bad(scan,
                    "the file is MSH version '%s', and 2.2 or 4.1 is needed: "
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
    return is_2 ? 2 : 4;
}

/** In ASCII also in a binary file. */
static void read_names(struct kr_msh *msh) {
    struct kr_scan *scan = &msh->scan;
    int is_binary = scan->is_binary;
    scan->is_binary = 0;
    size_t n = kr_scan_count(scan, 3, "the number of physical names");
    for (size_t k = 0; k < n; k++) {
        int dim = kr_scan_int(scan, "the dimension of a physical name");
        int tag = kr_scan_int(scan, "the number of a physical name");
        size_t from = scan->at + strspn(scan->data + scan->at, " \t");
        size_t length = scan->data[from] == '"' ? strcspn(scan->data + from + 1, "\"\n") : 0;
        if (!length || scan->data[from + 1 + length] != '"')
            kr_scan_bad(scan, "expected a physical name in quotes");
        char *text = kr_text("%.*s", (int)length, scan->data + from + 1);
        if (dim >= 0 && dim <= 3)
            kr_gather_name(&msh->gather, kr_gather_group(&msh->gather, dim, tag), text);
        kr_free(text);
        scan->at = from + length + 2;
    }
    scan->is_binary = is_binary;
}

const struct kr_element *kr_msh_element(const struct kr_scan *scan, int type) {
    const struct kr_element *kind = kr_element(type);
    if (!kind)
        kr_scan_bad(scan,
                    "elements of type %d are not read: lines, triangles, quadrilaterals, "
                    "tetrahedra, hexahedra, wedges and pyramids of order 1 and 2 are; save the "
                    "mesh with order 1",
                    type);
    return kind;
}

size_t kr_msh_group(struct kr_msh *msh, int dim, int tag) {
    if (tag == INT_MIN)
        kr_scan_bad(&msh->scan, "%d is no number of a physical group", tag);
    return kr_gather_group(&msh->gather, dim, abs(tag));
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

/** The sections that are read, by version, and where it is noted that they were. */
static int read_known(struct kr_msh *msh, int version, const char *section) {
    struct known {
        const char *name;
        int *has;
        void (*read)(struct kr_msh *msh);
    } known[] = {
        {"$PhysicalNames", &msh->has_names, read_names},
        {"$Entities", &msh->has_entities, version == 4 ? kr_msh4_entities : NULL},
        {"$Nodes", &msh->has_nodes, version == 4 ? kr_msh4_nodes : kr_msh2_nodes},
        {"$Elements", &msh->has_elements, version == 4 ? kr_msh4_elements : kr_msh2_elements},
    };
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        if (strcmp(section, known[k].name) || !known[k].read)
            continue;
        if (*known[k].has)
            kr_scan_bad(&msh->scan, "section %s stands twice", section);
        *known[k].has = 1;
        known[k].read(msh);
        return 1;
    }
    return 0;
}

static void read_section(struct kr_msh *msh, int version, const char *section) {
    struct kr_scan *scan = &msh->scan;
    if (section[0] != '$')
        kr_scan_bad(scan, "expected a section, found '%.20s'", section);
    if (!strcmp(section, "$PartitionedEntities"))
        kr_scan_bad(scan, "the mesh is partitioned; save it whole");
    scan->at += scan->is_binary && scan->at < scan->size; /* the end of the line */
    if (!read_known(msh, version, section))
        skip_section(scan, section);
    char *end = kr_text("$End%s", section + 1);
    kr_scan_expect(scan, end);
    kr_free(end);
}

struct kr_mesh *kr_mesh_read_msh(const char *path) {
    struct kr_msh msh = {.scan = kr_scan_open(path), .gather = {.path = path}};
    char section[64];
    int version = read_format(&msh);
    while (kr_scan_word(&msh.scan, section, sizeof section))
        read_section(&msh, version, section);
    if (!msh.has_nodes || !msh.has_elements)
        kr_scan_bad(&msh.scan, "the file has no section %s: it is cut or holds no mesh",
                    msh.has_nodes ? "$Elements" : "$Nodes");
    for (size_t k = 0; k < msh.n_entities; k++)
        kr_free(msh.entity[k].group);
    kr_free(msh.entity);
    kr_scan_close(&msh.scan);
    return kr_gather_finish(&msh.gather);
}
