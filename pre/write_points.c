/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Writing nodes as text. See points.h.
 */
#include "points.h"

#include "base/file.h"
#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/** Number N of a set `block_N`; -1 for any other. */
static long block_of_name(const char *name) {
    char *end;
    if (strncmp(name, "block_", 6))
        return -1;
    long block = strtol(name + 6, &end, 10);
    return *end || end == name + 6 ? -1 : block;
}

static long *blocks_of(const struct kr_nodes *nodes) {
    long *block = KR_NEW(long, nodes->n);
    for (size_t i = 0; i < nodes->n; i++)
        block[i] = 1;
    for (size_t s = 0; s < nodes->n_sets; s++) {
        long number = block_of_name(nodes->set[s].name);
        for (size_t k = 0; number >= 0 && k < nodes->set[s].count; k++)
            block[nodes->set[s].node[k]] = number;
    }
    return block;
}

static double height_of(const struct kr_nodes *nodes, size_t i) {
    return nodes->dim == 3 ? nodes->position[3 * i + 2] : 0;
}

static double volume_of(const struct kr_nodes *nodes, size_t i, double thickness) {
    return nodes->volume[i] * (nodes->dim == 2 && thickness > 0 ? thickness : 1);
}

void kr_points_write_peridigm(const struct kr_nodes *nodes, const char *stem, double thickness) {
    struct kr_file file = kr_file_begin(kr_text("%s.txt", stem));
    long *block = blocks_of(nodes);
    size_t dim = (size_t)nodes->dim;
    fprintf(file.to, "# x y z volume block_id\n");
    for (size_t i = 0; i < nodes->n; i++)
        fprintf(file.to, "%.17g %.17g %.17g %.17g %ld\n", nodes->position[dim * i],
                nodes->position[dim * i + 1], height_of(nodes, i), volume_of(nodes, i, thickness),
                block[i]);
    kr_free(block);
    kr_file_end(&file);
    for (size_t s = 0; s < nodes->n_sets; s++) {
        if (block_of_name(nodes->set[s].name) >= 0)
            continue;
        file = kr_file_begin(kr_text("%s_ns_%s.txt", stem, nodes->set[s].name));
        for (size_t k = 0; k < nodes->set[s].count; k++)
            fprintf(file.to, "%lld\n", (long long)nodes->set[s].node[k] + 1);
        kr_file_end(&file);
    }
}

void kr_points_write_csv(const struct kr_nodes *nodes, const char *stem, double thickness) {
    struct kr_file file = kr_file_begin(kr_text("%s.csv", stem));
    long *block = blocks_of(nodes);
    size_t dim = (size_t)nodes->dim;
    unsigned char *is_in = KR_NEW(unsigned char, nodes->n_sets * nodes->n);
    fprintf(file.to, "id,x,y,z,volume,block_id");
    for (size_t s = 0; s < nodes->n_sets; s++) {
        fprintf(file.to, ",%s", nodes->set[s].name);
        for (size_t k = 0; k < nodes->set[s].count; k++)
            is_in[s * nodes->n + (size_t)nodes->set[s].node[k]] = 1;
    }
    for (size_t i = 0; i < nodes->n; i++) {
        fprintf(file.to, "\n%lld,%.17g,%.17g,%.17g,%.17g,%ld", (long long)nodes->tag[i],
                nodes->position[dim * i], nodes->position[dim * i + 1], height_of(nodes, i),
                volume_of(nodes, i, thickness), block[i]);
        for (size_t s = 0; s < nodes->n_sets; s++)
            fprintf(file.to, ",%d", is_in[s * nodes->n + i]);
    }
    fprintf(file.to, "\n");
    kr_free(is_in);
    kr_free(block);
    kr_file_end(&file);
}
