/* SPDX-License-Identifier: BSD-3-Clause
 *
 * kirsch-nodes: mesh -> nodes, with sets and surface factors.
 */
#include "base/error.h"
#include "base/machine.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/unit.h"
#include "boundary.h"
#include "convert.h"
#include "import.h"
#include "mesh.h"
#include "partition.h"
#include "surface.h"
#include "weight.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "kirsch-nodes [MESH [SET.txt]...] case.yaml\n"
    "kirsch-nodes --convert MESH [SET.txt]... --write FORMAT\n"
    "\n"
    "Turns the cells of a mesh into nodes. MESH, left out: plate.msh in the case's folder, is\n"
    "  .msh                             gmsh 2.2 or 4.1, ASCII or binary; Fluent\n"
    "  .inp .cdb .e .exo .med .vtu .vtk .bdf .unv .xdmf ...   others (docs/formats.md)\n"
    "  .step .iges .brep                bodies of CAD, meshed by gmsh with cells of mesh.spacing\n"
    "  .csv .txt                        points with volumes: Peridigm, PeriLab, CSV; with files of\n"
    "                                   node numbers, one a set\n"
    "  .dat                             nodes.dat of the plates paper\n"
    "Writes plate.nodes.h5 into the case's folder; --convert needs no case and writes NAME.nodes.h5\n"
    "into the folder of --output, or the present one.\n"
    "\n"
    "  --unit mm            the unit of length of MESH; m if left out\n"
    "  --thickness '1 mm'   of plane points with volumes, and for the volumes of --write\n"
    "  --repair             drop or turn cells that are faulty, and say so\n"
    "  --partition N        also divide the nodes into N parts with about as many bonds each (METIS)\n"
    "  --write FORMAT,...   also write peridigm, exodus, vtu, inp, csv, dat";

/* What the command line says beyond what every program takes. */
struct wish {
    const char *write;
    double unit, thickness; /* m */
    int repair, parts; /* parts 0: no partition */
    size_t n_files;
    const char **file; /* (n_files) the mesh, then its sets */
};

/* The value behind an option, or after its equals sign; NULL if the word is another one. */
static const char *value_of(const char *option, const char **word, size_t n, size_t *k) {
    size_t length = strlen(option);
    if (strncmp(word[*k], option, length) || (word[*k][length] && word[*k][length] != '='))
        return NULL;
    if (word[*k][length])
        return word[*k] + length + 1;
    if (*k + 1 >= n)
        kr_stop(KR_EXIT_INPUT, "%s needs a value behind it", option);
    return word[++*k];
}

static double length_of(const char *option, const char *text) {
    double value;
    char *why;
    if (!kr_unit_read(text, "m", &value, &why))
        kr_stop(KR_EXIT_INPUT, "%s: %s", option, why);
    if (!(value > 0))
        kr_stop(KR_EXIT_INPUT, "%s: found '%s'; expected a positive length", option, text);
    return value;
}

static double unit_of(const char *text) {
    double unit = kr_unit_factor(text, "m");
    if (!(unit > 0))
        kr_stop(KR_EXIT_INPUT, "--unit: found '%s'; expected a unit of length, such as mm", text);
    return unit;
}

static void check_formats(const char *formats) {
    char *copy = kr_text_copy(formats), *rest = NULL;
    for (char *word = strtok_r(copy, ",", &rest); word; word = strtok_r(NULL, ",", &rest))
        if (!kr_export_knows(word))
            kr_stop(KR_EXIT_INPUT, "--write: found '%s'; expected peridigm, exodus, vtu, inp, csv or dat",
                    word);
    kr_free(copy);
}

static int parts_of(const char *text) {
    char *end;
    long parts = strtol(text, &end, 10);
    if (!*text || *end || parts < 1 || parts > 1000000)
        kr_stop(KR_EXIT_INPUT, "found '--partition %s'; expected a number of parts, 1 or more", text);
    return (int)parts;
}

static struct wish read_wish(size_t n, const char **word) {
    struct wish wish = {.unit = 1, .file = KR_NEW(const char *, n)};
    const char *value;
    for (size_t k = 0; k < n; k++) {
        if ((value = value_of("--unit", word, n, &k)))
            wish.unit = unit_of(value);
        else if ((value = value_of("--thickness", word, n, &k)))
            wish.thickness = length_of("--thickness", value);
        else if ((value = value_of("--write", word, n, &k)))
            check_formats(wish.write = value);
        else if ((value = value_of("--partition", word, n, &k)))
            wish.parts = parts_of(value);
        else if (!strcmp(word[k], "--repair"))
            wish.repair = 1;
        else if (word[k][0] == '-')
            kr_stop(KR_EXIT_INPUT, "found the option '%s', which is not known; see --help", word[k]);
        else
            wish.file[wish.n_files++] = word[k];
    }
    return wish;
}

static struct kr_import import_of(const struct wish *wish, const char *folder, double spacing) {
    return (struct kr_import){.path = wish->n_files ? wish->file[0] : NULL,
                              .unit = wish->unit,
                              .thickness = wish->thickness,
                              .repair = wish->repair,
                              .folder = folder,
                              .spacing = spacing,
                              .n_sets = wish->n_files ? wish->n_files - 1 : 0,
                              .set = wish->file + 1};
}

/* The nodes of the mesh named on the command line, or of the case's own; settles what hangs on them. */
static struct kr_nodes *read_nodes(const struct wish *wish, struct kr_deck *deck,
                                   struct kr_case *c) {
    struct kr_import import = import_of(wish, c->folder, c->spacing);
    char *own = kr_case_file(c, "plate.msh");
    struct kr_mesh *mesh;
    import.path = wish->n_files ? import.path : own;
    struct kr_nodes *nodes = kr_import(&import, &mesh);
    if (nodes->dim != kr_case_dim(c))
        kr_deck_fault(deck, &c->model,
                      nodes->dim == 3 ? "%s is a mesh of solids, and this model is for plates; take "
                                        "solid"
                                      : "%s is a mesh of a plate, and the model is solid; take "
                                        "plane-stress or plane-strain",
                      import.path);
    c->partial_volume = kr_weights_choose(deck, c, nodes);
    kr_convert_sets(deck, c, mesh, nodes);
    kr_boundary_check(deck, c, nodes);
    kr_deck_finish(deck);
    kr_mesh_free(mesh);
    kr_free(own);
    return nodes;
}

/* The formats asked for, beside the node file. */
static void export(const struct wish *wish, const struct kr_nodes *nodes, const char *stem,
                   const char *nodes_file) {
    char *copy = kr_text_copy(wish->write ? wish->write : ""), *rest = NULL;
    for (char *word = strtok_r(copy, ",", &rest); word; word = strtok_r(NULL, ",", &rest))
        kr_export(nodes, word, stem, nodes_file, wish->thickness);
    kr_free(copy);
}

static void report_nodes(const struct kr_nodes *nodes) {
    double volume = 0;
    for (size_t i = 0; i < nodes->n; i++)
        volume += nodes->volume[i];
    kr_say("  %zu nodes, spacing %.6g mm, %s %.12g mm^%d", nodes->n, 1e3 * nodes->spacing,
           nodes->dim == 2 ? "area" : "volume", (nodes->dim == 2 ? 1e6 : 1e9) * volume, nodes->dim);
    for (size_t s = 0; s < nodes->n_sets; s++)
        kr_say("  set %-10s %8zu nodes%s", nodes->set[s].name, nodes->set[s].count,
               nodes->set[s].measure > 0 ? ", on a boundary" : "");
}

/* "(1.000, 2.000)" in mm. */
static void place_of(const struct kr_nodes *nodes, size_t i, char text[96]) {
    size_t dim = (size_t)nodes->dim, used = 0;
    for (size_t d = 0; d < dim; d++)
        used += (size_t)snprintf(text + used, 96 - used, "%s%.3f", d ? ", " : "(",
                                 1e3 * nodes->position[dim * i + d]);
    snprintf(text + used, 96 - used, ")");
}

/* Note what the factors are for, and find them if they are wanted. */
static void correct(const struct kr_case *c, struct kr_nodes *nodes) {
    struct kr_nodes_made_for *made = &nodes->made_for;
    struct kr_material material = kr_material_of(c);
    made->horizon = c->horizon;
    kr_case_word(KR_MODEL_WORDS, c->model, made->model);
    kr_case_word(KR_MICROMODULUS_WORDS, c->micromodulus, made->micromodulus);
    kr_case_word(KR_PARTIAL_VOLUME_WORDS, c->partial_volume, made->partial_volume);
    kr_case_word(KR_SURFACE_WORDS, c->surface_correction, made->surface_correction);
    kr_case_word(KR_DEFORMATION_WORDS, c->surface_deformation, made->deformation);
    if (c->surface_correction == KR_SURFACE_NONE)
        return;
    double begun = kr_progress_clock();
    struct kr_surface_report r = kr_surface_make(nodes, &material, c->surface_correction,
                                                 c->partial_volume, c->surface_deformation);
    char least[96], most[96];
    place_of(nodes, r.least_at, least);
    place_of(nodes, r.most_at, most);
    kr_say("  surface factors (%s) %.4f at %s mm to %.4f at %s mm; %d iterations to %.1e in %.2f s",
           made->surface_correction, r.least, least, r.most, most, r.iterations, r.residual,
           kr_progress_clock() - begun);
}

static void divide(const struct kr_case *c, struct kr_nodes *nodes, int parts) {
    if ((size_t)parts > nodes->n)
        kr_stop(KR_EXIT_INPUT, "found --partition %d; there are only %zu nodes", parts, nodes->n);
    struct kr_partition_report r = kr_partition_make(nodes, c->horizon, c->partial_volume, parts);
    kr_say("  %d parts of %zu to %zu nodes: %zu of %zu bonds between parts (%.2f %%), the heaviest "
           "part %.3f of the mean; %.2f s",
           parts, r.least, r.most, r.cut, r.bonds, 100 * (double)r.cut / (double)r.bonds, r.balance,
           r.seconds);
}

static int make_nodes(int argc, char **argv) {
    struct kr_case_arguments arguments;
    struct kr_case c;
    kr_case_arguments(argc, argv, usage, &arguments);
    struct wish wish = read_wish(arguments.n_left, arguments.left);
    struct kr_deck *deck = kr_case_open(&arguments, &c);
    struct kr_nodes *nodes = read_nodes(&wish, deck, &c);
    report_nodes(nodes);
    correct(&c, nodes);
    if (wish.parts)
        divide(&c, nodes, wish.parts);

    char *path = kr_case_file(&c, "plate.nodes.h5"), *stem = kr_case_file(&c, "plate");
    char *deck_text = kr_deck_resolved(deck, NULL);
    if (arguments.explain) {
        kr_say("  memory %.0f MiB at the most; nothing is written", kr_machine_peak() / 1048576);
    } else {
        kr_nodes_write(nodes, path, deck_text);
        kr_say("  wrote %s", path);
        export(&wish, nodes, stem, path);
    }
    kr_free(path);
    kr_free(stem);
    kr_free(deck_text);
    kr_nodes_free(nodes);
    kr_deck_close(deck);
    kr_free(wish.file);
    kr_free(arguments.set);
    kr_free(arguments.left);
    return KR_EXIT_OK;
}

/* FOLDER/NAME of PATH/NAME.EXTENSION. */
static char *stem_of(const char *path, const char *folder) {
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    return kr_text("%s/%.*s", folder, (int)(dot && dot != name ? dot - name : (long)strlen(name)),
                   name);
}

/* Convert without a case: `word` is what follows --convert. */
static int convert(size_t n, const char **word) {
    const char *folder = ".", *value;
    size_t left = 0;
    for (size_t k = 0; k < n; k++) {
        if ((value = value_of("--output", word, n, &k)))
            folder = value;
        else
            word[left++] = word[k];
    }
    struct wish wish = read_wish(left, word);
    if (!wish.n_files)
        kr_stop(KR_EXIT_INPUT, "--convert needs the name of a mesh behind it");
    struct kr_import import = import_of(&wish, folder, 0);
    struct kr_mesh *mesh;
    struct kr_nodes *nodes = kr_import(&import, &mesh);
    char *stem = stem_of(import.path, folder), *path = kr_text("%s.nodes.h5", stem);
    report_nodes(nodes);
    kr_nodes_write(nodes, path, "");
    kr_say("  wrote %s (without surface factors)", path);
    export(&wish, nodes, stem, path);
    kr_free(path);
    kr_free(stem);
    kr_nodes_free(nodes);
    kr_mesh_free(mesh);
    kr_free(wish.file);
    return KR_EXIT_OK;
}

int main(int argc, char **argv) {
    kr_error_program("kirsch-nodes");
    if (argc > 1 && !strcmp(argv[1], "--convert"))
        return convert((size_t)argc - 2, (const char **)argv + 2);
    return make_nodes(argc, argv);
}
