/* SPDX-License-Identifier: BSD-3-Clause
 *
 * kirsch-mesh: geometry of a case -> plate.msh.
 */
#include "base/error.h"
#include "base/machine.h"
#include "base/memory.h"
#include "block.h"
#include "case.h"
#include "mesh.h"
#include "pieces.h"
#include "plate.h"
#include "quality.h"
#include "quality_solid.h"

#include <math.h>

static const char usage[] =
    "kirsch-mesh case.yaml\n"
    "\n"
    "Meshes the plate of a case and writes plate.msh (gmsh MSH 4.1) into the case's folder.";

/** A path of the deck, seen from the deck's folder; NULL for none. Owned by the caller. */
static char *path_of(const struct kr_deck *deck, const char *file) {
    if (!file || !*file)
        return NULL;
    return file[0] == '/' ? kr_text_copy(file) : kr_text("%s/%s", kr_deck_folder(deck), file);
}

static struct kr_mesh *mesh_plate(const struct kr_plate *plate) {
    struct kr_plate_report report;
    struct kr_mesh *mesh = kr_plate_mesh(plate, &report);
    kr_quality_print(mesh, plate, &report);
    kr_plate_report_free(&report);
    return mesh;
}

static struct kr_mesh *mesh_block(const struct kr_plate *plate, const struct kr_case *c,
                                  const struct kr_deck *deck) {
    size_t n_voids;
    struct kr_case_void *hollow = kr_case_voids(c, &n_voids);
    struct kr_case_stl body = c->body;
    struct kr_block block = {*plate, c->depth, n_voids, hollow, NULL};
    struct kr_block_report report;
    body.file = path_of(deck, c->body.file);
    block.body = body.file ? &body : NULL;
    for (size_t k = 0; k < n_voids; k++)
        hollow[k].file = path_of(deck, hollow[k].file);
    struct kr_mesh *mesh = kr_block_mesh(&block, &report);
    kr_quality_solid_print(mesh, &block, &report);
    kr_block_report_free(&report);
    for (size_t k = 0; k < n_voids; k++)
        kr_free((char *)hollow[k].file);
    kr_free((char *)body.file);
    kr_free(hollow);
    return mesh;
}

static struct kr_mesh *mesh_case(const struct kr_case_arguments *arguments, const struct kr_case *c,
                                 const struct kr_deck *deck) {
    struct kr_plate plate = {.width = c->width,
                             .height = c->height,
                             .spacing = c->spacing,
                             .padding = c->padding > 0 ? c->padding : c->horizon,
                             .grid = (enum kr_grid)c->grid,
                             .lloyd_steps = c->lloyd_steps,
                             .outline = c->outline};
    if (arguments->explain)
        kr_say("lattice of %.0f by %.0f cells of %.9g mm, boxes %.9g mm around %zu holes and %lld "
               "pores",
               plate.width / plate.spacing, plate.height / plate.spacing, 1e3 * plate.spacing,
               1e3 * plate.padding, c->holes.count, (long long)c->pores.count);
    struct kr_case_hole *hole = kr_case_holes(c, &plate.n_holes);
    plate.hole = hole;
    struct kr_mesh *mesh = c->depth > 0 ? mesh_block(&plate, c, deck) : mesh_plate(&plate);
    kr_pieces_cut(mesh);
    kr_free(hole);
    return mesh;
}

/* What the mesh took is known when it is there. gmsh's children are processes of their own. */
static void explain_memory(void) {
    kr_say("  memory %.0f MiB at the most in one process; nothing is written",
           fmax(kr_machine_peak(), kr_machine_peak_of_children()) / 1048576);
}

int main(int argc, char **argv) {
    struct kr_case_arguments arguments;
    struct kr_case c;
    kr_error_program("kirsch-mesh");
    kr_case_arguments(argc, argv, usage, &arguments);
    if (arguments.n_left)
        kr_stop(KR_EXIT_INPUT, "unknown argument %s; see --help", arguments.left[0]);
    arguments.meshes = 1;
    struct kr_deck *deck = kr_case_open(&arguments, &c);
    struct kr_mesh *mesh = mesh_case(&arguments, &c, deck);
    char *path = kr_case_file(&c, "plate.msh");
    if (arguments.explain) {
        explain_memory();
    } else {
        kr_mesh_write_msh(mesh, path);
        kr_say("  wrote %s", path);
    }
    kr_free(path);
    kr_mesh_free(mesh);
    kr_deck_close(deck);
    kr_free(arguments.set);
    kr_free(arguments.left);
    return 0;
}
