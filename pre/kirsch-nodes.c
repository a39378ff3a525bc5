/* SPDX-License-Identifier: BSD-3-Clause
 *
 * kirsch-nodes: mesh -> nodes, with sets and surface factors.
 */
#include "base/error.h"
#include "base/memory.h"
#include "base/progress.h"
#include "boundary.h"
#include "convert.h"
#include "mesh.h"
#include "pieces.h"
#include "nodes_dat.h"
#include "surface.h"

#include <stdio.h>
#include <string.h>

static const char usage[] =
    "kirsch-nodes [MESH] case.yaml\n"
    "\n"
    "Turns the cells of a mesh into nodes. MESH is a gmsh file (NAME.msh; left out: plate.msh in the\n"
    "case's folder) or the plates paper's nodes.dat (NAME.dat). Writes plate.nodes.h5 and nodes.dat\n"
    "into the case's folder.";

static int ends_with(const char *text, const char *end) {
    size_t length = strlen(text), tail = strlen(end);
    return length >= tail && !strcmp(text + length - tail, end);
}

/* The nodes of the mesh named on the command line, or of the case's own. */
static struct kr_nodes *read_nodes(const struct kr_case_arguments *arguments, struct kr_deck *deck,
                                   const struct kr_case *c) {
    if (arguments->n_left > 1)
        kr_stop(KR_EXIT_INPUT, "found the argument '%s'; expected one mesh at the most",
                arguments->left[1]);
    char *path = arguments->n_left ? kr_text_copy(arguments->left[0]) : kr_case_file(c, "plate.msh");
    struct kr_mesh *mesh = NULL;
    struct kr_nodes *nodes;
    if (ends_with(path, ".dat")) {
        nodes = kr_nodes_dat_read(path);
    } else {
        mesh = kr_mesh_read_msh(path);
        kr_pieces_join(mesh, path);
        char *fault = kr_mesh_fault(mesh);
        if (fault)
            kr_stop(KR_EXIT_INPUT, "%s: %s", path, fault);
        nodes = kr_convert(mesh);
    }
    if (!nodes->n_points && (c->partial_volume == KR_PARTIAL_VOLUME_EXACT ||
                             c->partial_volume == KR_PARTIAL_VOLUME_EXACT_CENTROID))
        kr_deck_fault(deck, &c->partial_volume,
                      "exact shares need the cells of a mesh, and %s has none; take hhb", path);
    kr_convert_sets(deck, c, mesh, nodes);
    kr_boundary_check(deck, c, nodes);
    kr_deck_finish(deck);
    if (mesh)
        kr_mesh_free(mesh);
    kr_free(path);
    return nodes;
}

static void report_nodes(const struct kr_nodes *nodes) {
    double volume = 0;
    for (size_t i = 0; i < nodes->n; i++)
        volume += nodes->volume[i];
    kr_say("  %zu nodes, spacing %.6g mm, area %.12g mm^2", nodes->n, 1e3 * nodes->spacing,
           1e6 * volume);
    for (size_t s = 0; s < nodes->n_sets; s++)
        kr_say("  set %-10s %8zu nodes%s", nodes->set[s].name, nodes->set[s].count,
               nodes->set[s].measure > 0 ? ", on a boundary" : "");
}

/* Note what the factors are for, and find them if they are wanted. */
static void correct(const struct kr_case *c, struct kr_nodes *nodes) {
    struct kr_nodes_made_for *made = &nodes->made_for;
    struct kr_material material = kr_material_of(c);
    made->horizon = c->horizon;
    kr_case_word(KR_MODEL_WORDS, c->model, made->model);
    kr_case_word(KR_PARTIAL_VOLUME_WORDS, c->partial_volume, made->partial_volume);
    kr_case_word(KR_SURFACE_WORDS, c->surface_correction, made->surface_correction);
    kr_case_word(KR_DEFORMATION_WORDS, c->surface_deformation, made->deformation);
    if (c->surface_correction == KR_SURFACE_NONE)
        return;
    double begun = kr_progress_clock();
    struct kr_surface_report r = kr_surface_make(nodes, &material, c->surface_correction,
                                                 c->partial_volume, c->surface_deformation);
    const double *least = nodes->position + 2 * r.least_at, *most = nodes->position + 2 * r.most_at;
    kr_say("  surface factors (%s) %.4f at (%.3f, %.3f) mm to %.4f at (%.3f, %.3f) mm; %d iterations "
           "to %.1e in %.2f s", made->surface_correction, r.least, 1e3 * least[0], 1e3 * least[1],
           r.most, 1e3 * most[0], 1e3 * most[1], r.iterations, r.residual,
           kr_progress_clock() - begun);
}

int main(int argc, char **argv) {
    struct kr_case_arguments arguments;
    struct kr_case c;
    kr_error_program("kirsch-nodes");
    kr_case_arguments(argc, argv, usage, &arguments);
    struct kr_deck *deck = kr_case_open(&arguments, &c);
    struct kr_nodes *nodes = read_nodes(&arguments, deck, &c);
    report_nodes(nodes);
    correct(&c, nodes);

    char *path = kr_case_file(&c, "plate.nodes.h5"), *dat = kr_case_file(&c, "nodes.dat");
    char *deck_text = kr_deck_resolved(deck, NULL);
    kr_nodes_write(nodes, path, deck_text);
    kr_nodes_dat_write(nodes, dat);
    kr_say("  wrote %s and %s", path, dat);
    kr_free(path);
    kr_free(dat);
    kr_free(deck_text);
    kr_nodes_free(nodes);
    kr_deck_close(deck);
    kr_free(arguments.set);
    kr_free(arguments.left);
    return KR_EXIT_OK;
}
