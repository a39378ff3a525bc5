/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Whole cases for tests: nodes and a deck in a folder of their own, opened as kirsch-solve opens
 * them, and the history that a run leaves.
 */
#ifndef KR_CASES_H
#define KR_CASES_H

#include "run.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct kr_test_case {
    char folder[64];
    struct kr_case c;
    struct kr_deck *deck;
    struct kr_run *run;
};

/* The material section of a deck: PMMA with this fracture energy. */
#define KR_TEST_PMMA(g0)                                                                           \
    "material: {model: plane-stress, youngs_modulus: 3.24 GPa, density: 1190 kg/m3, "              \
    "fracture_energy: " #g0 " J/m2}\n"

/** Add the sets `plate`, `left`, `right`, `bottom`, `top` (the outermost columns and rows, with the
 *  length of their edge) of a full lattice. */
static inline void kr_test_sets(struct kr_nodes *nodes, size_t columns, size_t rows) {
    static const char *const names[] = {"plate", "left", "right", "bottom", "top"};
    for (int s = 0; s < 5; s++) {
        int64_t *node = KR_NEW(int64_t, nodes->n);
        size_t count = 0;
        for (size_t i = 0; i < nodes->n; i++) {
            size_t x = i % columns, y = i / columns;
            const int in[] = {1, x == 0, x == columns - 1, y == 0, y == rows - 1};
            if (in[s])
                node[count++] = (int64_t)i;
        }
        double length = s == 0 ? 0 : (double)(s < 3 ? rows : columns) * nodes->spacing;
        kr_nodes_add_set(nodes, names[s], count, node, length);
    }
}

/** The same of a full block: `body` and its six sides, with their areas. */
static inline void kr_test_solid_sets(struct kr_nodes *nodes, size_t columns, size_t rows,
                                      size_t layers) {
    static const char *const names[] = {"body", "left", "right", "bottom", "top", "front", "back"};
    const size_t cells[3] = {columns, rows, layers};
    for (int s = 0; s < 7; s++) {
        int64_t *node = KR_NEW(int64_t, nodes->n);
        size_t count = 0, axis = s ? (size_t)(s - 1) / 2 : 0;
        for (size_t i = 0; i < nodes->n; i++) {
            const size_t place[3] = {i % columns, i / columns % rows, i / columns / rows};
            if (!s || place[axis] == (s % 2 ? 0 : cells[axis] - 1))
                node[count++] = (int64_t)i;
        }
        double area = s ? (double)(nodes->n / cells[axis]) * nodes->spacing * nodes->spacing : 0;
        kr_nodes_add_set(nodes, names[s], count, node, area);
    }
}

static inline void kr_test_write_nodes(struct kr_nodes *nodes, double horizon, const char *folder) {
    char *path = kr_text("%s/plate.nodes.h5", folder);
    nodes->made_for =
        (struct kr_nodes_made_for){horizon, "plane-stress", "hhb", "none", "uniaxial-y"};
    kr_nodes_write(nodes, path, "");
    kr_nodes_free(nodes);
    kr_free(path);
}

/** Write nodes (freed here) and a deck in a folder of its own and open the case as kirsch-solve
 * does. `text` is the deck without geometry, mesh and nodes, which are added (no surface
 * correction). */
static inline void kr_test_case_open(struct kr_test_case *t, struct kr_nodes *nodes, double horizon,
                                     const char *text) {
    *t = (struct kr_test_case){.folder = "/tmp/kirsch-case-XXXXXX"};
    assert_non_null(mkdtemp(t->folder));
    char *path = kr_text("%s/case.yaml", t->folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    const double *last = nodes->position + (size_t)nodes->dim * (nodes->n - 1);
    double spacing = nodes->spacing, width = last[0] + spacing / 2, height = last[1] + spacing / 2;
    fprintf(file,
            "geometry: {width: %.17g m, height: %.17g m}\nmesh: {grid: uniform, spacing: %.17g m}\n"
            "nodes: {horizon: %.17g m, surface_correction: none}\n%s",
            width, height, spacing, horizon, text);
    fclose(file);
    kr_test_write_nodes(nodes, horizon, t->folder);
    struct kr_case_arguments arguments = {.deck = path, .folder = t->folder};
    t->deck = kr_case_open(&arguments, &t->c);
    t->run = kr_run_create(t->deck, &t->c);
    kr_free(path);
}

static inline void kr_test_case_close(struct kr_test_case *t) {
    char *command = kr_text("rm -rf %s", t->folder);
    kr_run_free(t->run);
    kr_deck_close(t->deck);
    assert_int_equal(system(command), 0);
    kr_free(command);
}

/** The energies of one line of history.csv [J/m]. */
struct kr_test_record {
    long step;
    double time, kinetic, strain, fracture, external, balance;
    long broken;
};

/** Read history.csv; returns the number of its records, at most `room`. */
static inline size_t kr_test_history(const struct kr_test_case *t, struct kr_test_record *record,
                                     size_t room) {
    char *path = kr_text("%s/history.csv", t->folder), line[4096];
    FILE *file = fopen(path, "r");
    size_t count = 0;
    assert_non_null(file);
    while (count < room && fgets(line, sizeof line, file)) {
        struct kr_test_record *r = &record[count];
        count += sscanf(line, "%ld,%lf,%lf,%lf,%lf,%lf,%lf,%ld", &r->step, &r->time, &r->kinetic,
                        &r->strain, &r->fracture, &r->external, &r->balance, &r->broken) == 8;
    }
    fclose(file);
    kr_free(path);
    return count;
}

#endif
