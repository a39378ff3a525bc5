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

#include "base/seal.h"
#include "record.h"
#include "records.h"

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

/* What is done once, before the first file is read: then FUZZ_RUN is a run to which the file belongs. */
static char *run_file;
static struct kr_case the_case;
static struct kr_run *the_run;
static char *deck_text;

/* `name` in the folder leads to the file, which the fuzzer may not have written yet. */
static void lead(const char *where, const char *name, const char *path) {
    char here[4096], *link = kr_text("%s/%s", where, name);
    char *place = *path == '/' || !getcwd(here, sizeof here) ? kr_text_copy(path) : kr_text("%s/%s", here, path);
    unlink(link);
    if (symlink(place, link))
        abort();
    kr_free(link);
    kr_free(place);
}

/* A run whose run/crack.h5 is the file: its run.h5 is that of FUZZ_RUN, and links to it. */
static void begin_result(const char *path) {
    char *whole = kr_text("%s/run.h5", getenv("FUZZ_RUN")), *sub = kr_text("%s/run", folder), part[4096];
    run_file = kr_text("%s/run.h5", folder);
    FILE *from = fopen(whole, "rb"), *to = fopen(run_file, "wb");
    size_t n;
    while (from && to && (n = fread(part, 1, sizeof part, from)))
        fwrite(part, 1, n, to);
    if (!from || !to || fclose(to) || fclose(from) || (mkdir(sub, 0777) && errno != EEXIST))
        abort();
    lead(sub, "crack.h5", path);
    kr_free(whole);
    kr_free(sub);
}

static void read_result(const char *path) {
    (void)path;
    kr_record_free(kr_record_read(run_file));
}

/* The run that was stopped in FUZZ_RUN/again (tests/fuzz/run), up to where it asks for its checkpoint. */
static void begin_checkpoint(const char *path) {
    const char *set[] = {"solver.time_step=0.1 ns"};
    char *deck_file = kr_text("%s/case.yaml", getenv("FUZZ_RUN")), *again = kr_text("%s/again", getenv("FUZZ_RUN"));
    struct kr_case_arguments arguments = {.deck = deck_file, .folder = again, .n_set = 1, .set = set};
    struct kr_deck *deck = kr_case_open(&arguments, &the_case);
    the_run = kr_run_create(deck, &the_case);
    deck_text = kr_deck_resolved(deck, NULL);
    lead(again, "checkpoint.h5", path);
}

/* Read, and go on for the forces of one step. */
static void read_checkpoint(const char *path) {
    struct kr_records r;
    (void)path;
    kr_records_open(&r, the_run, deck_text, 1);
    kr_body_force(the_run->body, 1);
    kr_records_crack(&r, r.at.step, 0);
    kr_records_close(&r);
}

/* Linked in its place (-Wl,--wrap=kr_seal_holds): a damaged checkpoint is to be read in spite of its seal. */
int __wrap_kr_seal_holds(const char *path);
int __wrap_kr_seal_holds(const char *path) {
    (void)path;
    return 1;
}

static const struct kind {
    const char *name;
    void (*read)(const char *path);
    void (*begin)(const char *path);
    int once; /* one process a file: HDF5 would give a file that a stop left open once more */
} kinds[] = {
    {"deck", read_deck},     {"pores", read_pores}, {"msh", mend_nodes}, {"csv", read_nodes},
    {"txt", read_nodes},     {"dat", read_nodes},   {"set", read_set},   {"curves", read_curves},
    {"reply", read_reply},   {"stl", read_stl},
    {"nodes", read_node_file, NULL, 1},
    {"result", read_result, begin_result, 1},
    {"checkpoint", read_checkpoint, begin_checkpoint, 1},
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
    if (kind->begin)
        kind->begin(argv[2]);
#ifdef __AFL_HAVE_MANUAL_CONTROL
    __AFL_INIT();
    while (__AFL_LOOP(kind->once ? 1 : 300))
#endif
        code = read_once(kind, argv[2]);
    rmdir(folder);
    return code;
}
