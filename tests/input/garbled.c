/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Cut and garbled files. Every file of tests/corpus is damaged in many ways, always the same ones, and
 * read as the programs read it. The reader must take it, or stop with exit 2 and one sentence or
 * more; it must not crash, hang, or ask for all memory. GARBLED=10 makes ten times as many.
 */
#include "test.h"

#include "random.h"
#include "readers.h"

#include <signal.h>
#include <sys/resource.h>

/** A file in memory. */
struct text {
    size_t n;
    char *byte;
};

static struct text read_corpus(const char *name) {
    char *path = kr_text("tests/corpus/%s", name);
    FILE *file = fopen(path, "rb");
    struct text text = {0, KR_NEW(char, 1 << 16)};
    if (!file)
        fail_msg("%s is missing", path);
    text.n = fread(text.byte, 1, 1 << 16, file);
    fclose(file);
    kr_free(path);
    assert_true(text.n > 0);
    return text;
}

static size_t below(uint64_t *state, size_t n) {
    return n ? (size_t)kr_random_between(state, 0, (int64_t)n - 1) : 0;
}

/** Put `with` in the place of `n` bytes. */
static void replace(struct text *text, size_t at, size_t n, const char *with, size_t m) {
    n = at + n > text->n ? text->n - at : n;
    text->byte = kr_realloc(text->byte, text->n + m + 1, 1);
    memmove(text->byte + at + m, text->byte + at + n, text->n - at - n);
    memcpy(text->byte + at, with, m);
    text->n += m - n;
}

/** A number in its place by another one. */
static void replace_number(struct text *text, uint64_t *state) {
    static const char *const other[] = {"0",    "-1",   "1",           "3",        "1e308", "nan",
                                        "-inf", "1e-9", "99999999999", "4294967297", "2.5",
                                        "18446744073709551615", "x", ""};
    const char *with = other[below(state, sizeof other / sizeof *other)];
    size_t at = below(state, text->n), end;
    while (at < text->n && !strchr("0123456789", text->byte[at]))
        at++;
    for (end = at; end < text->n && text->byte[end] && strchr("0123456789.eE+-", text->byte[end]);)
        end++;
    if (at < text->n)
        replace(text, at, end - at, with, strlen(with));
}

static size_t line_at(const struct text *text, size_t at, size_t *length) {
    while (at > 0 && text->byte[at - 1] != '\n')
        at--;
    const char *end = memchr(text->byte + at, '\n', text->n - at);
    *length = end ? (size_t)(end - text->byte) + 1 - at : text->n - at;
    return at;
}

static void damage_line(struct text *text, uint64_t *state) {
    size_t length, at = line_at(text, below(state, text->n), &length);
    char *copy = KR_NEW(char, length + 1);
    memcpy(copy, text->byte + at, length);
    if (kr_random(state) % 2)
        replace(text, at, length, "", 0);
    else
        replace(text, at, 0, copy, length);
    kr_free(copy);
}

/** One way of damage, chosen by the state. */
static void damage(struct text *text, uint64_t *state) {
    char noise[4];
    size_t at = below(state, text->n);
    for (int k = 0; k < 4; k++)
        noise[k] = (char)kr_random(state);
    switch (kr_random(state) % 7) {
    case 0:
        text->n = at;
        break;
    case 1:
        text->byte[at] = (char)(text->byte[at] ^ (1 << kr_random(state) % 8));
        break;
    case 2:
        damage_line(text, state);
        break;
    case 3:
        replace(text, at, below(state, 8), noise, sizeof noise);
        break;
    case 4:
        replace(text, at, 8, "\377\377\377\377\377\377\377\177", 8);
        break;
    default:
        replace_number(text, state);
    }
    if (!text->n)
        text->byte[text->n++] = '\n';
}

/** Formats that Python reads, by the program itself: it finds the script beside it. */
static void read_by_program(const char *path) {
    const char *build = getenv("BUILD");
    char *program = kr_text("%s/kirsch-nodes", build ? build : "build");
    execl(program, program, "--convert", path, "--output", folder, "--repair", (char *)NULL);
    kr_stop(KR_EXIT_LIBRARY, "%s cannot be started", program);
}

/* ---- the check ---- */

struct reading {
    void (*read)(const char *path);
    const char *path;
};

/** In a child: 60 s and 4 GiB at most. Sanitizers map more than that and are spared. */
static int run(const struct reading *reading, char *said, size_t room) {
    int ends[2], status;
    size_t got = 0;
    ssize_t more;
    fflush(NULL);
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    if (child == 0) {
        dup2(ends[1], 2);
        dup2(ends[1], 1);
        close(ends[0]);
        alarm(60);
        signal(SIGSEGV, SIG_DFL);
        signal(SIGABRT, SIG_DFL);
#ifndef __SANITIZE_ADDRESS__
        setrlimit(RLIMIT_AS, &(struct rlimit){4UL << 30, 4UL << 30});
#endif
        omp_set_num_threads(1);
        reading->read(reading->path);
        _exit(0);
    }
    close(ends[1]);
    while (got < room - 1 && (more = read(ends[0], said + got, room - 1 - got)) > 0)
        got += (size_t)more;
    said[got] = 0;
    close(ends[0]);
    waitpid(child, &status, 0);
    return status;
}

/** Keep the file that broke a reader, and say what happened. */
static void keep(const char *path, const char *name, int seed, int status, const char *said) {
    char *command = kr_text("cp %s /tmp/garbled-%d-%s", path, seed, name);
    if (system(command))
        print_error("no copy\n");
    kr_free(command);
    fail_msg("%s, damage %d (kept as /tmp/garbled-%d-%s): ended with %s %d; said: %s", name, seed,
             seed, name, WIFEXITED(status) ? "exit" : "signal",
             WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status), said);
}

static void check(const char *name, void (*reader)(const char *), int count) {
    struct text whole = read_corpus(name);
    char *path = kr_text("%s/%s", folder, name), said[8192];
    const struct reading reading = {reader, path};
    const char *more = getenv("GARBLED");
    int refused = 0, total = count * (more && atoi(more) > 0 ? atoi(more) : 1);
    for (int seed = 0; seed <= total; seed++) {
        uint64_t state = (uint64_t)seed;
        struct text text = {whole.n, KR_NEW(char, whole.n + 1)};
        memcpy(text.byte, whole.byte, whole.n);
        for (int k = 0; seed && k <= seed % 3; k++) /* damage 0 leaves the file whole */
            damage(&text, &state);
        FILE *file = fopen(path, "wb");
        fwrite(text.byte, 1, text.n, file);
        fclose(file);
        kr_free(text.byte);
        int status = run(&reading, said, sizeof said);
        int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        /* What kirsch-gmsh says wrong is no fault of the user's. */
        int is_stop = code == KR_EXIT_INPUT || (reader == read_curves && code == KR_EXIT_LIBRARY);
        int is_told = is_stop && strstr(said, ": ") && strchr(said, '\n');
        if ((seed == 0 && code != 0) || (code != 0 && !is_told) || strstr(said, "runtime error"))
            keep(path, name, seed, status, said);
        refused += code != 0;
    }
    kr_figure("%-22s %4d damages, %4d refused", name, total, refused);
    assert_true(refused > 0 || total < 50);
    kr_free(whole.byte);
    kr_free(path);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void garbled_meshes_stop_with_a_sentence(void **unused) {
    static const char *const name[] = {"plane-22.msh", "plane-22-binary.msh", "plane-41.msh",
                                       "plane-41-binary.msh", "solid-41.msh",
                                       "solid-22-binary.msh"};
    (void)unused;
    for (size_t k = 0; k < sizeof name / sizeof *name; k++) {
        check(name[k], read_nodes, 250);
        check(name[k], mend_nodes, 100);
    }
}

/** Few: a start of Python takes half a second. */
static void garbled_meshes_of_others_stop_with_a_sentence(void **unused) {
    static const char *const name[] = {"plane.inp", "plane.unv", "plane.vtu", "plane.e",
                                       "plane.cdb"};
    (void)unused;
    for (size_t k = 0; k < sizeof name / sizeof *name; k++)
        check(name[k], read_by_program, 4);
}

static void garbled_points_stop_with_a_sentence(void **unused) {
    (void)unused;
    check("points.csv", read_nodes, 250);
    check("peridigm.txt", read_nodes, 250);
    check("peridigm-set.txt", read_set, 100);
    check("nodes.dat", read_nodes, 250);
}

static void garbled_pores_stop_with_a_sentence(void **unused) {
    (void)unused;
    check("pores.txt", read_pores, 250);
    check("pores-paper.txt", read_pores, 250);
}

static void garbled_triangles_stop_with_a_sentence(void **unused) {
    (void)unused;
    check("tetrahedron.stl", read_stl, 250);
    check("tetrahedron-binary.stl", read_stl, 250);
}

static void garbled_replies_of_gmsh_are_told(void **unused) {
    (void)unused;
    check("reply.txt", read_reply, 500);
}

static void garbled_curves_are_told(void **unused) {
    (void)unused;
    check("curves.txt", read_curves, 500);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(garbled_meshes_stop_with_a_sentence),
        cmocka_unit_test(garbled_meshes_of_others_stop_with_a_sentence),
        cmocka_unit_test(garbled_points_stop_with_a_sentence),
        cmocka_unit_test(garbled_pores_stop_with_a_sentence),
        cmocka_unit_test(garbled_triangles_stop_with_a_sentence),
        cmocka_unit_test(garbled_replies_of_gmsh_are_told),
        cmocka_unit_test(garbled_curves_are_told),
    };
    char filter[256];
    const char *only = getenv("ONLY");
    snprintf(filter, sizeof filter, "*%s*", only ? only : "");
    cmocka_set_test_filter(filter);
    int failed = cmocka_run_group_tests(tests, make_folder, remove_folder);
    return failed ? failed : kr_memory_outstanding() > 0;
}
