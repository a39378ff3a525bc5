/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Fuzzing with libFuzzer under the address and undefined-behaviour sanitizers (make fuzz). The word in
 * KIRSCH_FUZZ says which reader gets the bytes. A stop with a message (kr_stop) is a good end: the
 * linker turns exit() into __wrap_exit() here, which goes back to the loop. What a stop leaves behind
 * in memory is lost, as in the programs; open files are closed. A broken kr_assert aborts, and is a crash.
 */
#include "base/error.h"
#include "base/memory.h"
#include "base/stl.h"
#include "cad.h"
#include "case.h"
#include "import.h"
#include "mesh.h"
#include "nodes.h"
#include "record.h"

#include <setjmp.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
_Noreturn void __real_exit(int code);
_Noreturn void __wrap_exit(int code);

static jmp_buf before;
static int is_reading;
static char folder[] = "/tmp/kirsch-fuzz-XXXXXX";

_Noreturn void __wrap_exit(int code) {
    if (is_reading)
        longjmp(before, 1);
    __real_exit(code);
}

/* ---- the readers ---- */

static void read_deck(const char *path) {
    struct kr_case c;
    struct kr_case_arguments arguments = {.deck = path, .check = 1};
    kr_case_open(&arguments, &c);
}

static void read_mesh(const char *path) {
    struct kr_mesh *mesh;
    struct kr_import import = {.path = path, .unit = 1, .folder = folder, .spacing = 0.5};
    struct kr_nodes *nodes = kr_import(&import, &mesh);
    kr_nodes_free(nodes);
    kr_mesh_free(mesh);
}

static void read_pores(const char *path) {
    struct kr_case c = {.width = 50e-3, .height = 25e-3};
    size_t n;
    kr_free(kr_case_read_pores(&c, path, &n));
}

static void read_stl(const char *path) {
    size_t n;
    kr_free(kr_stl_read(path, 1, &n));
}

static void read_nodes(const char *path) {
    kr_nodes_free(kr_nodes_read(path));
}

static void read_results(const char *path) {
    kr_record_free(kr_record_read(path));
}

static const struct reader {
    const char *word, *name; /* name: of the file, for some are known by their ending */
    void (*read)(const char *path);
} readers[] = {
    {"deck", "case.yaml", read_deck},     {"msh", "a.msh", read_mesh},
    {"peridigm", "a.txt", read_mesh},     {"nodes-dat", "nodes.dat", read_mesh},
    {"csv", "a.csv", read_mesh},          {"pores", "pores.txt", read_pores},
    {"stl", "a.stl", read_stl},           {"nodes", "plate.nodes.h5", read_nodes},
    {"results", "run.h5", read_results},
};
static const struct reader *reader;
static char path[128];

int LLVMFuzzerInitialize(int *argc, char ***argv) {
    const char *word = getenv("KIRSCH_FUZZ");
    (void)argc;
    (void)argv;
    for (size_t k = 0; word && k < sizeof readers / sizeof *readers; k++)
        if (!strcmp(word, readers[k].word))
            reader = &readers[k];
    if (!reader || !mkdtemp(folder)) {
        fprintf(stderr, "KIRSCH_FUZZ must name a reader; see tests/fuzz/fuzz.c\n");
        __real_exit(KR_EXIT_INPUT);
    }
    snprintf(path, sizeof path, "%s/%s", folder, reader->name);
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    int first_free = dup(0);
    close(first_free);
    FILE *file = fopen(path, "wb");
    if (!file)
        return 0;
    fwrite(data, 1, size, file);
    fclose(file);
    is_reading = 1;
    if (!setjmp(before))
        reader->read(path);
    is_reading = 0;
    for (int k = first_free; k < first_free + 16; k++)
        close(k);
    return 0;
}
