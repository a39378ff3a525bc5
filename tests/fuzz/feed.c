/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What the fuzzer starts: feed KIND FILE reads one file as the programs do. A stop with a sentence is as
 * good as a success; a signal, a report of a sanitizer or a failed kr_assert is a find. tests/fuzz/run
 * drives it.
 *
 * Under AFL one process reads many files, which is some thirty times as fast as one process a file: exit, which a
 * stop ends with, is linked to come back here (-Wl,--wrap=exit). What such a stop leaves behind is
 * lost; a new process begins after some hundred files.
 */
#include "readers.h"

#include "record.h"

#include <errno.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/** The whole of a deck: parsed, read into the case, checked. Exits by itself. */
static void read_deck(const char *path) {
    struct kr_case_arguments arguments = {.deck = path, .folder = folder, .check = 1};
    struct kr_case c;
    kr_case_open(&arguments, &c);
}

static void read_node_file(const char *path) {
    kr_nodes_free(kr_nodes_read(path));
}

/* A run whose run/crack.h5 is the file: its run.h5 is a copy of that of the run in FUZZ_RUN, and links to it. */
static char *make_run(const char *path) {
    char *whole = kr_text("%s/run.h5", getenv("FUZZ_RUN")), *run = kr_text("%s/run.h5", folder), part[4096];
    char *sub = kr_text("%s/run", folder), *crack = kr_text("%s/run/crack.h5", folder);
    char *place = realpath(path, NULL);
    FILE *from = fopen(whole, "rb"), *to = fopen(run, "wb");
    size_t n;
    while (from && to && (n = fread(part, 1, sizeof part, from)))
        fwrite(part, 1, n, to);
    if (!from || !to || fclose(to) || fclose(from) || !place || (mkdir(sub, 0777) && errno != EEXIST) ||
        (symlink(place, crack) && errno != EEXIST)) /* made before by a process with the same folder */
        abort();
    kr_free(whole);
    kr_free(sub);
    kr_free(crack);
    free(place);
    return run;
}

static void read_result(const char *path) {
    static char *run;
    if (!run)
        run = make_run(path);
    kr_record_free(kr_record_read(run));
}

static const struct kind {
    const char *name;
    void (*read)(const char *path);
} kinds[] = {
    {"deck", read_deck},     {"pores", read_pores}, {"msh", mend_nodes}, {"csv", read_nodes},
    {"txt", read_nodes},     {"dat", read_nodes},   {"set", read_set},   {"curves", read_curves},
    {"reply", read_reply},   {"stl", read_stl},     {"nodes", read_node_file},
    {"result", read_result},
};

static jmp_buf stopped;

_Noreturn void __wrap_exit(int code);
_Noreturn void __wrap_exit(int code) {
    longjmp(stopped, code + 1);
}

static const struct kind *kind_of(const char *name) {
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        if (!strcmp(kinds[k].name, name))
            return &kinds[k];
    return NULL;
}

/** Read the file; gives the exit code that the programs would end with. */
static int read_once(const struct kind *kind, const char *path) {
    int code = setjmp(stopped);
    if (code)
        return code - 1;
    kind->read(path);
    return 0;
}

int main(int argc, char **argv) {
    const struct kind *kind = argc == 3 ? kind_of(argv[1]) : NULL;
    if (!kind || !mkdtemp(folder)) {
        fprintf(stderr, "feed KIND FILE\n");
        return KR_EXIT_INPUT;
    }
    int code = 0;
#ifdef __AFL_HAVE_MANUAL_CONTROL
    __AFL_INIT();
    /* HDF5 would give a file that a stop left open once more. */
    while (__AFL_LOOP(kind->read == read_node_file || kind->read == read_result ? 1 : 300))
#endif
        code = read_once(kind, argv[2]);
    rmdir(folder);
    return code;
}
