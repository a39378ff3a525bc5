/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A torus from an STL file, ASCII and binary, as body and as void, against its volume; and files that
 * are no closed surface.
 */
#include "folder.h"
#include "solids3d.h"

#include <stdint.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

enum { AROUND = 120, ACROSS = 60, TRIANGLES = 2 * AROUND * ACROSS };
static const double LARGE = 1.4, SMALL = 0.6; /* mm */

static void corner(size_t i, size_t j, double p[3]) {
    double u = 2 * M_PI * (double)(i % AROUND) / AROUND, v = 2 * M_PI * (double)(j % ACROSS) / ACROSS;
    p[0] = (LARGE + SMALL * cos(v)) * cos(u);
    p[1] = (LARGE + SMALL * cos(v)) * sin(u);
    p[2] = SMALL * sin(v);
}

/** Triangle t of the torus, counter-clockwise from outside. */
static void triangle_of(size_t t, double p[3][3]) {
    size_t i = t / 2 / ACROSS, j = t / 2 % ACROSS;
    corner(i, j, p[0]);
    corner(i + 1, t % 2 ? j + 1 : j, p[1]);
    corner(t % 2 ? i : i + 1, j + 1, p[2]);
}

/** Volume that the triangles enclose [mm^3]. */
static double volume_of_triangles(void) {
    double six = 0;
    for (size_t t = 0; t < TRIANGLES; t++) {
        double p[3][3];
        triangle_of(t, p);
        six += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
               p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
               p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
    }
    return six / 6;
}

static char *write_ascii(const char *name, size_t from, size_t to, const char *end) {
    char *path = kr_text("%s/%s.stl", folder, name);
    FILE *file = fopen(path, "w");
    fprintf(file, "solid a torus, in mm\n");
    for (size_t t = from; t < to; t++) {
        double p[3][3];
        triangle_of(t, p);
        fprintf(file, "facet normal 0 0 0\n outer loop\n");
        for (int k = 0; k < 3; k++)
            fprintf(file, "  vertex %.9e %.9e %.9e\n", p[k][0], p[k][1], p[k][2]);
        fprintf(file, " endloop\nendfacet\n");
    }
    fprintf(file, "%s\n", end);
    fclose(file);
    return path;
}

/** `count` is what the file says, `records` what it holds; its head begins like an ASCII file's. */
static char *write_binary(const char *name, uint32_t count, size_t records) {
    char *path = kr_text("%s/%s.stl", folder, name), head[80] = "solid, but binary";
    FILE *file = fopen(path, "wb");
    fwrite(head, sizeof head, 1, file);
    fwrite(&count, sizeof count, 1, file);
    for (size_t t = 0; t < records; t++) {
        double p[3][3];
        float out[12] = {0};
        triangle_of(t, p);
        for (int k = 0; k < 9; k++)
            out[3 + k] = (float)p[k / 3][k % 3];
        fwrite(out, sizeof out, 1, file);
        fwrite("\0", 2, 1, file);
    }
    fclose(file);
    return path;
}

static struct kr_block block_of(enum kr_grid grid) {
    return (struct kr_block){.plate = {.width = 5 * MM,
                                       .height = 5 * MM,
                                       .spacing = 0.125 * MM,
                                       .padding = 0.375 * MM,
                                       .grid = grid,
                                       .gmsh = kr_test_gmsh()},
                             .depth = 2 * MM};
}

/* The torus turned by nothing: shares of its volume as in mesh3d_voids.c. */
static const double off[4] = {[KR_GRID_NEAR_BOUNDARY] = 0.006, [KR_GRID_UNIFORM] = 0.02,
                              [KR_GRID_FREE] = 0.006, [KR_GRID_VORONOI] = 0.001};

static void check(int is_body, enum kr_grid grid, const char *path) {
    struct kr_block block = block_of(grid);
    struct kr_case_stl body = {path, MM, {2.5 * MM, 2.5 * MM, 1 * MM}};
    struct kr_case_void hollow = {
        {2.5 * MM, 2.5 * MM, 1 * MM}, .shape = KR_VOID_STL, .file = path, .unit = MM};
    struct kr_block_report report;
    double exact = 2 * M_PI * M_PI * LARGE * SMALL * SMALL, given = volume_of_triangles(), flux = 0;
    block.body = is_body ? &body : NULL;
    block.hollow = &hollow;
    block.n_voids = !is_body;
    struct kr_mesh *mesh = kr_block_mesh(&block, &report);
    double volume = is_body ? kr_test_volume(mesh) : 50 - kr_test_volume(mesh);
    char word[32];
    kr_case_word(KR_GRID_WORDS, (int)grid, word);
    kr_figure("torus as %s, %-13s %6zu cells, volume off by %+.1e, from the triangles %+.1e",
              is_body ? "body" : "void", word, mesh->n_cells, volume / exact - 1, volume / given - 1);
    kr_test_solid(mesh);
    kr_check_near(given / exact, 1, 0.003); /* chords: (2 pi/60)^2/6 and (2 pi/120)^2/6 */
    kr_check_near(volume / given, 1, off[grid]);
    kr_check_near(volume / exact, 1, off[grid] + 0.003);
    kr_check_near(report.exact_volume * 1e9, is_body ? given : 50 - given, 1e-5); /* float corners */
    assert_true(kr_test_area(mesh, is_body ? "outline" : "void_1", &flux) > 30);
    kr_block_report_free(&report);
    kr_mesh_free(mesh);
}

static void a_torus(void **unused) {
    (void)unused;
    char *ascii = write_ascii("ascii", 0, TRIANGLES, "endsolid a torus");
    char *binary = write_binary("binary", TRIANGLES, TRIANGLES);
    for (int grid = KR_GRID_NEAR_BOUNDARY; grid <= KR_GRID_VORONOI; grid++)
        for (int is_body = 0; is_body < 2; is_body++)
            check(is_body, (enum kr_grid)grid, is_body ? ascii : binary);
    kr_free(ascii);
    kr_free(binary);
    assert_int_equal(kr_memory_outstanding(), 0);
}

/** Mesh in a child; it must stop with exit 2 and a sentence that holds the words. */
static void refuses(char *path, const char *words) {
    int from[2], status;
    char said[2000] = "";
    assert_int_equal(pipe(from), 0);
    pid_t child = fork();
    if (child == 0) {
        struct kr_block block = block_of(KR_GRID_VORONOI);
        struct kr_case_stl body = {path, MM, {2.5 * MM, 2.5 * MM, 1 * MM}};
        struct kr_block_report report;
        dup2(from[1], 2);
        close(from[0]);
        block.body = &body;
        kr_block_mesh(&block, &report);
        _exit(0);
    }
    close(from[1]);
    size_t n = 0;
    for (ssize_t got; n + 1 < sizeof said && (got = read(from[0], said + n, sizeof said - n - 1)) > 0;)
        n += (size_t)got;
    close(from[0]);
    waitpid(child, &status, 0);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 2 || !strstr(said, words) || !strstr(said, path))
        fail_msg("%s: wanted exit 2 and '%s', got status %d and: %s", path, words, status, said);
    unlink(path);
    kr_free(path);
}

static char *write_text(const char *name, const char *text) {
    char *path = kr_text("%s/%s.stl", folder, name);
    FILE *file = fopen(path, "w");
    fputs(text, file);
    fclose(file);
    return path;
}

static void broken_files(void **unused) {
    (void)unused;
    refuses(write_ascii("open", 1, TRIANGLES, "endsolid"), "not closed");
    refuses(write_binary("open-binary", TRIANGLES - 1, TRIANGLES - 1), "not closed");
    refuses(write_ascii("cut", 0, 50, "facet normal 0 0 0\n outer loop\n  vertex 1 2"),
            "cut.stl:355: the file ends");
    refuses(write_ascii("garbled", 0, 50, "facet normal 0 0 0 outer loop vertex 1 2 ugh"), "'ugh'");
    refuses(write_ascii("no-end", 0, TRIANGLES, ""), "endsolid");
    refuses(write_binary("short", TRIANGLES, TRIANGLES - 7), "of 14400 triangles needs 720084");
    refuses(write_text("empty", ""), "neither an ASCII STL file");
    refuses(write_text("hollow", "solid nothing\nendsolid nothing\n"), "no triangle in it");
    refuses(write_text("words", "This is no surface."), "neither an ASCII STL file");
}

/** Two tetrahedra that pass through each other, and one that is too large for its block. */
static void surfaces_that_do_not_fit(void **unused) {
    (void)unused;
    static const double at[2][4][3] = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                       {{0.1, 0.1, 0.1}, {1.1, 0.1, 0.1}, {0.1, 1.1, 0.1}, {0.1, 0.1, 1.1}}};
    static const int face[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    char text[8000] = "solid\n";
    for (int t = 0; t < 8; t++) {
        size_t n = strlen(text);
        n += (size_t)sprintf(text + n, "facet normal 0 0 0 outer loop\n");
        for (int k = 0; k < 3; k++) {
            const double *p = at[t / 4][face[t % 4][k]];
            n += (size_t)sprintf(text + n, "vertex %g %g %g\n", p[0], p[1], p[2]);
        }
        sprintf(text + n, "endloop endfacet\n");
    }
    strcat(text, "endsolid\n");
    refuses(write_text("through", text), "passes through itself");
    refuses(write_text("large", "solid\n"
                                "facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 9 0 vertex 9 0 0 endloop endfacet\n"
                                "facet normal 0 0 0 outer loop vertex 0 0 0 vertex 9 0 0 vertex 0 0 9 endloop endfacet\n"
                                "facet normal 0 0 0 outer loop vertex 9 0 0 vertex 0 9 0 vertex 0 0 9 endloop endfacet\n"
                                "facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 0 9 vertex 0 9 0 endloop endfacet\n"
                                "endsolid\n"),
            "must lie between 0 and 5 mm");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_torus),
        cmocka_unit_test(broken_files),
        cmocka_unit_test(surfaces_that_do_not_fit),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
