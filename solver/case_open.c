/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From the command line to a case: arguments, deck, folder.
 */
#include "base/error.h"
#include "base/file.h"
#include "base/machine.h"
#include "base/memory.h"
#include "base/provenance.h"
#include "case_check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- arguments ---- */

/* Value of an option that takes one, `--name value` or `--name=value`; moves on by what it used.
   NULL if argument i is another one. */
static const char *option(int argc, char **argv, int *i, const char *name) {
    size_t length = strlen(name);
    if (strncmp(argv[*i], name, length) || (argv[*i][length] && argv[*i][length] != '='))
        return NULL;
    if (argv[*i][length])
        return argv[*i] + length + 1;
    if (*i + 1 >= argc)
        kr_stop(KR_EXIT_INPUT, "%s needs a value behind it", name);
    return argv[++*i];
}

static int ends_with(const char *text, const char *end) {
    size_t n = strlen(text), m = strlen(end);
    return n >= m && !strcmp(text + n - m, end);
}

/* The deck is the first argument named like one; else the first that is no option. It is taken out
   of those left: whether another is wrong only the program can tell. */
static void pick_deck(struct kr_case_arguments *out) {
    size_t place = out->n_left;
    for (size_t i = out->n_left; i-- > 0;)
        if (ends_with(out->left[i], ".yaml") || ends_with(out->left[i], ".yml"))
            place = i;
    for (size_t i = 0; place == out->n_left && i < out->n_left; i++)
        if (*out->left[i] != '-')
            place = i;
    if (place == out->n_left)
        return;
    out->deck = out->left[place];
    memmove(out->left + place, out->left + place + 1,
            (out->n_left - place - 1) * sizeof *out->left);
    out->n_left--;
}

static void take_argument(int argc, char **argv, int *i, struct kr_case_arguments *out) {
    const char *value;
    if ((value = option(argc, argv, i, "--variant")))
        out->variant = value;
    else if ((value = option(argc, argv, i, "--output")))
        out->folder = value;
    else if ((value = option(argc, argv, i, "--set")))
        out->set[out->n_set++] = value;
    else if (!strcmp(argv[*i], "--check"))
        out->check = 1;
    else if (!strcmp(argv[*i], "--explain"))
        out->explain = 1;
    else
        out->left[out->n_left++] = argv[*i];
}

/* What a program says of itself, then what all have in common. */
static void print_usage(FILE *file, const char *usage) {
    fprintf(file,
            "%s\n\n"
            "  --variant NAME     a variant of the deck\n"
            "  --set KEY=VALUE    a value over the deck's, any number of times\n"
            "  --output FOLDER    the case's folder\n"
            "  --check            check the deck, do nothing else\n"
            "  --explain          say what it leads to, do nothing else\n"
            "  --help, --version\n",
            usage);
}

void kr_case_arguments(int argc, char **argv, const char *usage, struct kr_case_arguments *out) {
    const char *slash = strrchr(argv[0], '/'), *program = slash ? slash + 1 : argv[0];
    kr_error_program(program);
    memset(out, 0, sizeof *out);
    for (int i = 1; i < argc; i++) {
        int help = !strcmp(argv[i], "--help") || !strcmp(argv[i], "-h");
        if (help)
            print_usage(stdout, usage);
        else if (!strcmp(argv[i], "--version"))
            printf("%s %s\n", program, kr_version());
        else
            continue;
        exit(KR_EXIT_OK);
    }
    out->set = KR_NEW(const char *, (size_t)argc);
    out->left = KR_NEW(const char *, (size_t)argc);
    for (int i = 1; i < argc; i++)
        take_argument(argc, argv, &i, out);
    pick_deck(out);
    if (!out->deck) {
        fprintf(stderr, "%s: the deck is missing\n", program);
        print_usage(stderr, usage);
        exit(KR_EXIT_INPUT);
    }
}

/* ---- the case ---- */

/* Last part of a path, owned by the caller. */
static char *last_part(const char *path) {
    size_t end = strlen(path), begin;
    while (end > 1 && path[end - 1] == '/')
        end--;
    for (begin = end; begin > 0 && path[begin - 1] != '/';)
        begin--;
    return kr_text("%.*s", (int)(end - begin), path + begin);
}

/* "out/" and the name of the folder of the deck, or of the deck where that folder has no name of
   its own ("." and ".."). */
static char *default_folder(const struct kr_deck *deck) {
    char *name = last_part(kr_deck_folder(deck));
    if (!strcmp(name, ".") || !strcmp(name, "..") || !*name) {
        kr_free(name);
        name = last_part(kr_deck_path(deck));
        char *dot = strrchr(name, '.');
        if (dot && dot != name)
            *dot = 0;
    }
    char *folder = kr_text("out/%s", name);
    kr_free(name);
    return folder;
}

/* Stop before anything is allocated that cannot fit. A cell takes this much in a mesh alone (mesh.h: a point, a quad and
 * its tag); half of the rectangle may be holes. Bodies of their own mesh or of coarse cells tell no number. */
static void check_memory(const struct kr_case *c) {
    const double a_cell = 2 * sizeof(double) + 5 * sizeof(size_t) + sizeof(int64_t);
    double cells = 0.5 * (c->width / c->spacing) * (c->height / c->spacing);
    char what[64];
    if ((c->mesh_file && *c->mesh_file) || !(c->spacing > 0) || c->body.file)
        return;
    if (c->depth > 0)
        cells *= c->depth / c->spacing;
    snprintf(what, sizeof what, "%.3g cells, half of what `mesh.spacing` gives,", cells);
    kr_machine_need(cells * a_cell, what);
}

/* Holds the parent of the process that it is for: so it silences no other, wherever it may come to be known. */
static const char warned[] = "KIRSCH_WARNED";

void kr_case_note_warned(void) {
    char parent[32];
    snprintf(parent, sizeof parent, "%ld", (long)getppid());
    setenv(warned, parent, 1);
}

static int was_warned(void) {
    const char *parent = getenv(warned);
    return parent && strtol(parent, NULL, 10) == (long)getppid();
}

/* What would show only when the mesh has been made. Of a mesh from elsewhere nothing is known yet. */
static void look_ahead(struct kr_deck *deck, const struct kr_case *c) {
    if (c->mesh_file && *c->mesh_file)
        return;
    if (kr_case_dim(c) == 3 && !(c->depth > 0))
        kr_deck_fault(deck, &c->depth,
                      "missing; material.model is solid: expected depth: 10 mm, or mesh.file");
    kr_case_check_fit(deck, c);
    kr_case_check_names(deck, c);
}

struct kr_deck *kr_case_open(const struct kr_case_arguments *arguments, struct kr_case *out) {
    memset(out, 0, sizeof *out);
    struct kr_deck *deck =
        kr_deck_open(arguments->deck, arguments->variant, arguments->n_set, arguments->set);
    kr_deck_read(deck, kr_case_keys, out);
    kr_case_preset(deck, out);
    kr_case_complete_geometry(deck, out);
    kr_case_check(deck, out);
    if (arguments->meshes)
        look_ahead(deck, out);
    if (arguments->check)
        kr_case_check_files(deck, out);
    kr_deck_finish(deck);
    if (!was_warned())
        kr_case_warn(deck, out);
    if (arguments->check) {
        kr_say("%s: no faults", arguments->deck);
        exit(KR_EXIT_OK);
    }
    check_memory(out);
    if (arguments->folder)
        out->folder = arguments->folder;
    else if (!out->folder || !*out->folder)
        out->folder = kr_deck_keep(deck, default_folder(deck));
    if (!arguments->explain)
        kr_folder_make(out->folder);
    return deck;
}

char *kr_case_file(const struct kr_case *c, const char *name) {
    size_t length = strlen(c->folder);
    int slashed = length && c->folder[length - 1] == '/';
    return kr_text("%s%s%s", c->folder, slashed ? "" : "/", name);
}
