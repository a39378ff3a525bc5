/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The sections of MSH 2.2: each element carries its physical group; one in two groups stands twice
 * in the file. Numbers have 4 bytes.
 */
#include "msh.h"

#include "base/memory.h"

void kr_msh2_nodes(struct kr_msh *msh) {
    struct kr_scan *scan = &msh->scan;
    int was_binary = scan->is_binary;
    scan->is_binary = 0; /* the number of nodes is text in binary files, too */
    size_t n = kr_scan_count(scan, 4, "the number of nodes");
    scan->is_binary = was_binary;
    scan->at += was_binary;
    size_t first = kr_gather_nodes(&msh->gather, n);
    for (size_t k = first; k < first + n; k++) {
        int tag = kr_scan_int(scan, "the number of a node");
        if (tag < 0)
            kr_scan_bad(scan, "the number of a node is negative: %d", tag);
        msh->gather.node_tag[k] = (size_t)tag;
        kr_scan_doubles(scan, 3, msh->gather.point + 3 * k, "a coordinate of a node");
    }
}

/** The rest of an element: number, tags and nodes, as binary files have it; ASCII files begin each
 *  element with its type and number of tags instead of each block. */
static void read_element(struct kr_msh *msh, int type, const struct kr_element *kind, int number,
                         int tags) {
    struct kr_scan *scan = &msh->scan;
    size_t row[1 + KR_MOST_NODES] = {(size_t)number};
    int group = 0;
    for (int k = 0; k < tags; k++) {
        int tag = kr_scan_int(scan, "a tag of an element");
        group = k ? group : tag;
    }
    for (size_t c = 0; c < kind->nodes; c++) {
        int tag = kr_scan_int(scan, "a node of an element");
        if (tag < 0)
            kr_scan_bad(scan, "a node of an element is negative: %d", tag);
        row[1 + c] = (size_t)tag;
    }
    size_t place = kr_gather_elements(&msh->gather, type, 1, row);
    if (group)
        kr_gather_members(&msh->gather, kr_msh_group(msh, kind->dim, group), place, 1);
}

static int read_number(struct kr_scan *scan) {
    int number = kr_scan_int(scan, "the number of an element");
    if (number < 0)
        kr_scan_bad(scan, "the number of an element is negative: %d", number);
    return number;
}

static int read_tags(struct kr_scan *scan) {
    int tags = kr_scan_int(scan, "the number of an element's tags");
    if (tags < 0)
        kr_scan_bad(scan, "the number of an element's tags is negative: %d", tags);
    return tags;
}

/** Elements of one type in a binary file; returns their number. */
static size_t read_block(struct kr_msh *msh, size_t left) {
    struct kr_scan *scan = &msh->scan;
    int type = kr_scan_int(scan, "the type of elements");
    const struct kr_element *kind = kr_msh_element(scan, type);
    int count = kr_scan_int(scan, "the number of elements of a block");
    if (count < 1 || (size_t)count > left)
        kr_scan_bad(scan, "a block of %d elements, and %zu are left of those announced", count, left);
    int tags = read_tags(scan);
    for (int k = 0; k < count; k++)
        read_element(msh, type, kind, read_number(scan), tags);
    return (size_t)count;
}

void kr_msh2_elements(struct kr_msh *msh) {
    struct kr_scan *scan = &msh->scan;
    int is_binary = scan->is_binary;
    scan->is_binary = 0;
    size_t n = kr_scan_count(scan, 4, "the number of elements");
    scan->is_binary = is_binary;
    scan->at += is_binary;
    msh->gather.merges = 1;
    for (size_t k = 0; k < n && is_binary;)
        k += read_block(msh, n - k);
    for (size_t k = 0; k < n && !is_binary; k++) {
        int number = read_number(scan), type = kr_scan_int(scan, "the type of an element");
        const struct kr_element *kind = kr_msh_element(scan, type);
        read_element(msh, type, kind, number, read_tags(scan));
    }
}
