/* SPDX-License-Identifier: BSD-3-Clause
 *
 * MSH 4.1: files written here, by gmsh and by hand are read; cut and garbled ones stop with a
 * sentence.
 */
#include "test.h"

#include "folder.h"

#include "builder.h"
#include "frame.h"
#include "lattice.h"
#include "mesh.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

static char *path_of(const char *name) {
    return kr_text("%s/%s", folder, name);
}

static void put(const char *path, const void *data, size_t size) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    fclose(file);
}

static char *get(const char *path, size_t *size) {
    struct stat about;
    assert_int_equal(stat(path, &about), 0);
    FILE *file = fopen(path, "rb");
    char *data = KR_NEW(char, (size_t)about.st_size + 1);
    assert_non_null(file);
    assert_int_equal(fread(data, 1, (size_t)about.st_size, file), about.st_size);
    fclose(file);
    *size = (size_t)about.st_size;
    return data;
}

/** Five squares and two triangles with overlapping groups of cells. */
static struct kr_mesh *sample(void) {
    struct kr_lattice lattice = {3, 2, 0.1};
    struct kr_builder builder = kr_builder_begin(&lattice);
    for (size_t c = 0; c < 5; c++)
        kr_builder_square(&builder, c % 3, c / 3);
    size_t a = kr_builder_lattice_point(&builder, 2, 1),
           b = kr_builder_lattice_point(&builder, 3, 1),
           c = kr_builder_lattice_point(&builder, 3, 2),
           d = kr_builder_lattice_point(&builder, 2, 2);
    kr_builder_cell(&builder, 3, (size_t[]){a, b, c});
    kr_builder_cell(&builder, 3, (size_t[]){a, c, d});
    kr_frame_edges(&builder);
    struct kr_mesh *mesh = kr_builder_end(&builder);
    static const size_t member[] = {1, 4, 5};
    for (size_t k = 0; k < mesh->n_cells; k++)
        mesh->cell_tag[k] = 3 * (int64_t)k + 2; /* numbers with gaps */
    mesh->group = kr_realloc(mesh->group, mesh->n_groups + 2, sizeof *mesh->group);
    mesh->group[mesh->n_groups++] =
        (struct kr_mesh_group){kr_text_copy("a grain"), 2, 12, 3, KR_NEW(size_t, 3)};
    memcpy(mesh->group[mesh->n_groups - 1].member, member, sizeof member);
    mesh->group[mesh->n_groups++] =
        (struct kr_mesh_group){kr_text_copy("empty"), 1, 40, 0, KR_NEW(size_t, 0)};
    return mesh;
}

/** Equal but for `rounding` [m] in the places of points: gmsh's ASCII has 16 digits. */
static void check_equal(const struct kr_mesh *a, const struct kr_mesh *b, double rounding) {
    assert_int_equal(a->n_points, b->n_points);
    assert_int_equal(a->n_cells, b->n_cells);
    assert_int_equal(a->n_edges, b->n_edges);
    assert_int_equal(a->n_groups, b->n_groups);
    for (size_t k = 0; k < 3 * a->n_points; k++)
        kr_check_near(b->point[k], a->point[k], rounding);
    assert_memory_equal(a->first, b->first, (a->n_cells + 1) * sizeof *a->first);
    assert_memory_equal(a->vertex, b->vertex, a->first[a->n_cells] * sizeof *a->vertex);
    assert_memory_equal(a->cell_tag, b->cell_tag, a->n_cells * sizeof *a->cell_tag);
    assert_memory_equal(a->edge, b->edge, 2 * a->n_edges * sizeof *a->edge);
    for (size_t g = 0; g < a->n_groups; g++) {
        const struct kr_mesh_group *p = &a->group[g];
        const struct kr_mesh_group *q = kr_mesh_group(b, p->name, p->dim);
        assert_non_null(q);
        assert_int_equal(p->tag, q->tag);
        assert_int_equal(p->count, q->count);
        if (p->count)
            assert_memory_equal(p->member, q->member, p->count * sizeof *p->member);
    }
}

static void what_is_written_is_read(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = sample();
    char *path = path_of("round.msh"), *again = path_of("again.msh");
    size_t size, size_again;
    kr_mesh_write_msh(mesh, path);
    struct kr_mesh *read = kr_mesh_read_msh(path);
    check_equal(mesh, read, 0);
    assert_null(kr_mesh_fault(read));
    kr_mesh_write_msh(read, again);
    char *first = get(path, &size), *second = get(again, &size_again);
    assert_int_equal(size, size_again);
    assert_memory_equal(first, second, size);
    kr_free(first);
    kr_free(second);
    kr_free(path);
    kr_free(again);
    kr_mesh_free(read);
    kr_mesh_free(mesh);
    assert_int_equal(kr_memory_outstanding(), 0);
}

/** Run gmsh's own program; 0 if there is none. */
static int gmsh(const char *arguments) {
    char *command = kr_text("gmsh %s > %s/gmsh.log 2>&1", arguments, folder);
    if (system("command -v gmsh > /dev/null") != 0) {
        kr_free(command);
        return 0;
    }
    assert_int_equal(system(command), 0);
    kr_free(command);
    return 1;
}

/** gmsh reads our binary file and writes it as ASCII and as binary: the mesh comes back. */
static void gmsh_reads_what_is_written(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = sample();
    char *path = path_of("ours.msh");
    size_t size;
    kr_mesh_write_msh(mesh, path);
    for (int binary = 0; binary < 2; binary++) {
        char *arguments = kr_text("%s %s -save -format msh41 -o %s/theirs.msh", path,
                                  binary ? "-bin" : "", folder);
        char *theirs = path_of("theirs.msh");
        if (!gmsh(arguments))
            skip();
        struct kr_mesh *read = kr_mesh_read_msh(theirs);
        assert_null(kr_mesh_fault(read));
        check_equal(mesh, read, binary ? 0 : 1e-15);
        kr_mesh_free(read);
        kr_free(arguments);
        kr_free(theirs);
    }
    char *check = kr_text("-check %s", path), *log_path = path_of("gmsh.log");
    gmsh(check);
    char *log = get(log_path, &size);
    assert_null(strstr(log, "Warning"));
    assert_null(strstr(log, "Error"));
    kr_free(log);
    kr_free(log_path);
    kr_free(check);
    kr_free(path);
    kr_mesh_free(mesh);
}

static const char geometry[] =
    "Point(1) = {0,0,0,.3}; Point(2) = {2,0,0,.3}; Point(3) = {2,1,0,.3};\n"
    "Point(4) = {0,1,0,.3}; Point(5) = {1,0,0,.3}; Point(6) = {1,1,0,.3};\n"
    "Line(1) = {1,5}; Line(2) = {5,2}; Line(3) = {2,3}; Line(4) = {3,6};\n"
    "Line(5) = {6,4}; Line(6) = {4,1}; Line(7) = {5,6};\n"
    "Curve Loop(1) = {1,7,5,6}; Curve Loop(2) = {2,3,4,-7};\n"
    "Plane Surface(1) = {1}; Plane Surface(2) = {2}; Recombine Surface{2};\n"
    "Physical Surface(\"all of it\") = {1,2}; Physical Surface(\"right\") = {2};\n"
    "Physical Curve(\"bottom\") = {1,2}; Physical Curve(77) = {6};\n"
    "Physical Point(\"corner\") = {1};\n";

/** A file of gmsh's own with two surfaces, groups that overlap, a nameless group and a point. */
static void files_of_gmsh_are_read(void **unused) {
    (void)unused;
    char *script = path_of("two.geo");
    put(script, geometry, strlen(geometry));
    struct kr_mesh *mesh[2];
    for (int binary = 0; binary < 2; binary++) {
        char *arguments =
            kr_text("%s -2 %s -format msh41 -o %s/two.msh", script, binary ? "-bin" : "", folder);
        char *path = path_of("two.msh");
        if (!gmsh(arguments))
            skip();
        mesh[binary] = kr_mesh_read_msh(path);
        kr_free(arguments);
        kr_free(path);
    }
    check_equal(mesh[0], mesh[1], 2e-15);
    assert_null(kr_mesh_fault(mesh[0]));
    const struct kr_mesh_group *all = kr_mesh_group(mesh[0], "all of it", 2);
    const struct kr_mesh_group *right = kr_mesh_group(mesh[0], "right", 2);
    assert_int_equal(all->count, mesh[0]->n_cells);
    assert_true(right->count > 0 && right->count < all->count);
    for (size_t k = 0; k < right->count; k++) {
        size_t c = right->member[k];
        for (size_t v = mesh[0]->first[c]; v < mesh[0]->first[c + 1]; v++)
            assert_true(mesh[0]->point[3 * mesh[0]->vertex[v]] >= 1 - 1e-12);
    }
    double length = 0;
    const struct kr_mesh_group *bottom = kr_mesh_group(mesh[0], "bottom", 1);
    for (size_t k = 0; k < bottom->count; k++) {
        const size_t *e = mesh[0]->edge + 2 * bottom->member[k];
        length += fabs(mesh[0]->point[3 * e[0]] - mesh[0]->point[3 * e[1]]);
    }
    kr_check_near(length, 2, 1e-12);
    assert_non_null(kr_mesh_group(mesh[0], "group_77", 1));
    kr_mesh_free(mesh[0]);
    kr_mesh_free(mesh[1]);
    kr_free(script);
    assert_int_equal(kr_memory_outstanding(), 0);
}

/* Numbers with gaps and out of order, a clockwise cell, a section of comments, an unused node, no
 * group for the line. */
static const char by_hand[] =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
    "$Comments\nanything\n$EndComments\n"
    "$PhysicalNames\n1\n2 5 \"body\"\n$EndPhysicalNames\n"
    "$Entities\n0 1 1 0\n4 0 0 0 1 0 0 0 0\n9 0 0 0 1 1 0 1 5 0\n$EndEntities\n"
    "$Nodes\n2 6 10 90\n"
    "1 4 0 2\n40\n10\n1 0 0\n0 0 0\n"
    "2 9 1 4\n90\n13\n55\n11\n1 1 0 .5 .5\n0 1 0 0 1\n2 0.5 0 0 0\n7 7 0 0 0\n"
    "$EndNodes\n"
    "$Elements\n3 3 3 30\n"
    "2 9 2 1\n30 40 55 90\n2 9 3 1\n3 10 13 90 40\n1 4 1 1\n7 10 40\n"
    "$EndElements\n";

static void a_file_by_hand_is_read(void **unused) {
    (void)unused;
    char *path = path_of("hand.msh");
    put(path, by_hand, strlen(by_hand));
    struct kr_mesh *mesh = kr_mesh_read_msh(path);
    assert_null(kr_mesh_fault(mesh));
    assert_int_equal(mesh->n_cells, 2);
    assert_int_equal(mesh->cell_tag[0], 3);
    assert_int_equal(mesh->cell_tag[1], 30);
    assert_int_equal(mesh->first[1], 4);
    assert_int_equal(mesh->n_edges, 0);
    assert_int_equal(mesh->n_points, 6);
    assert_int_equal(kr_mesh_group(mesh, "body", 2)->count, 2);
    kr_mesh_free(mesh);
    kr_free(path);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void read_it(void *path) {
    kr_mesh_free(kr_mesh_read_msh(path));
}

/** Replace `from` in the file by hand with `to`; reading must stop with a sentence holding `text`.
 */
static void spoil(const char *from, const char *to, const char *text) {
    char *path = path_of("spoilt.msh");
    const char *at = strstr(by_hand, from);
    assert_non_null(at);
    char *spoilt = kr_text("%.*s%s%s", (int)(at - by_hand), by_hand, to, at + strlen(from));
    put(path, spoilt, strlen(spoilt));
    kr_check_stops(read_it, path, 2, text);
    kr_free(spoilt);
    kr_free(path);
}

static void faults_are_named_with_their_line(void **unused) {
    (void)unused;
    spoil("4.1 0 8", "4.0 0 8", "spoilt.msh:2: the file is MSH version '4.0', and 2.2 or 4.1 is");
    spoil("$MeshFormat", "(0 \"Fluent\")", "spoilt.msh:1: expected $MeshFormat, found '(0'");
    spoil("\"body\"", "body", "spoilt.msh:9: expected a physical name in quotes");
    spoil("2 6 10 90", "2 7 10 90", "expected 7 nodes, found 6");
    spoil("2 6 10 90", "2 60000000000 10 90", "more than the rest of the file can hold");
    spoil("1 4 0 2\n40", "1 4 0 -2\n40", "is negative: -2");
    spoil("1 1 0 .5 .5", "1 x1 0 .5 .5", "expected a coordinate of a node, found 'x1'");
    spoil("1 1 0 .5 .5", "1 nan 0 .5 .5", "a coordinate of a node is not finite");
    spoil("90\n13\n", "90\n40\n", "node 40 stands twice");
    spoil("30 40 55 90", "30 40 56 90", "an element has node 56, which $Nodes does not hold");
    spoil("30 40 55 90", "3 40 55 90", "element 3 stands twice");
    spoil("2 9 2 1\n", "2 8 2 1\n", "elements lie on surface 8, which $Entities does not name");
    spoil("2 9 2 1\n", "1 4 2 1\n", "cannot lie on an entity of dimension 1");
    spoil("2 9 2 1\n", "2 9 21 1\n", "elements of type 21 are not read");
    spoil("2 9 2 1\n", "3 9 4 1\n", "elements lie on volume 9, which $Entities does not name");
    spoil("3 3 3 30", "3 2 3 30", "more elements than the section announced");
    spoil("3 3 3 30", "3 4 3 30", "1 elements fewer than the section announced");
    spoil("$EndComments", "$EndComment", "section $Comments does not end");
    spoil("$Comments", "$Nodes\n0 0 0 0\n$EndNodes\n$Comments", "section $Nodes stands twice");
    spoil("$EndNodes\n", "$EndNodes\nrubbish\n", "expected a section, found 'rubbish'");
    kr_check_stops(read_it, "/nowhere/at.msh", 2, "/nowhere/at.msh cannot be read: No such file");
    kr_check_stops(read_it, "/tmp", 2, "/tmp ");
}

/** A number in a binary file: the one that is wrong is named with its byte, though all are taken together. */
static void faults_in_binary_are_named_with_their_byte(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = sample();
    char *path = path_of("binary.msh");
    size_t size;
    mesh->point[3 * 4 + 1] = 0.4711;
    kr_mesh_write_msh(mesh, path);
    char *data = get(path, &size);
    const double place = 0.4711, infinite = INFINITY;
    const int64_t numbers[2] = {5, 6}, negative = -12;
    for (int k = 0; k < 2; k++) {
        char *nodes = memmem(data, size, "$Nodes", 6), kept[8];
        assert_non_null(nodes);
        char *at = memmem(nodes, size - (size_t)(nodes - data), k ? (const void *)numbers : &place,
                          k ? 16 : 8);
        assert_non_null(at);
        memcpy(kept, at, 8);
        memcpy(at, k ? (const void *)&negative : &infinite, 8);
        put(path, data, size);
        char *text = kr_text("binary.msh, byte %td: %s", at + 8 - data,
                             k ? "the number of a node is negative: -12" : "a coordinate of a node is not finite");
        kr_check_stops(read_it, path, 2, text);
        memcpy(at, kept, 8);
        kr_free(text);
    }
    kr_free(data);
    kr_free(path);
    kr_mesh_free(mesh);
}

/** Read the first `size` bytes in a child; returns its exit code, -1 for a crash. */
static int read_cut(const char *path, const char *data, size_t size) {
    int status;
    put(path, data, size);
    fflush(NULL);
    pid_t child = fork();
    if (child == 0) {
        if (!freopen("/dev/null", "w", stderr))
            _exit(99);
        struct kr_mesh *mesh = kr_mesh_read_msh(path);
        char *fault = kr_mesh_fault(mesh);
        _exit(fault ? 2 : 0);
    }
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/** A file cut at any byte stops with exit 2. */
static void check_cuts(const char *data, size_t size) {
    char *path = path_of("cut.msh");
    /* Without its last end of line a file is still whole. */
    for (size_t cut = 0; cut + 1 < size; cut++)
        if (read_cut(path, data, cut) != 2)
            fail_msg("cut at byte %zu of %zu: ended with %d", cut, size, read_cut(path, data, cut));
    assert_int_equal(read_cut(path, data, size), 0);
    kr_free(path);
}

static void cut_files_stop(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = sample();
    char *path = path_of("whole.msh");
    size_t size;
    kr_mesh_write_msh(mesh, path);
    char *data = get(path, &size);
    check_cuts(data, size);
    check_cuts(by_hand, strlen(by_hand));
    kr_free(data);
    kr_free(path);
    kr_mesh_free(mesh);
}

/** A byte changed anywhere never crashes the reader: it reads on or stops with exit 2. */
static void garbled_files_do_not_crash(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = sample();
    char *path = path_of("garbled.msh");
    size_t size;
    static const char other[] = {0, -1, 127, ' ', '9', '-'};
    kr_mesh_write_msh(mesh, path);
    char *data = get(path, &size);
    for (size_t k = 0; k < size; k++) {
        char kept = data[k];
        data[k] = other[k % sizeof other];
        int code = read_cut(path, data, size);
        if (code != 0 && code != 2)
            fail_msg("byte %zu changed to %d: ended with %d", k, data[k], code);
        data[k] = kept;
    }
    kr_free(data);
    kr_free(path);
    kr_mesh_free(mesh);
}

static void write_nowhere(void *mesh) {
    kr_mesh_write_msh(mesh, "/nowhere/plate.msh");
}

/* A limit to the size of files stands for a disk that is full. */
static void write_to_a_full_disk(void *mesh) {
    char *path = kr_text("%s/full.msh", folder);
    signal(SIGXFSZ, SIG_IGN);
    if (setrlimit(RLIMIT_FSIZE, &(struct rlimit){64, 64}))
        _exit(99);
    kr_mesh_write_msh(mesh, path);
}

static void what_cannot_be_written_stops(void **unused) {
    (void)unused;
    struct kr_mesh *mesh = sample();
    char *path = path_of("full.msh");
    kr_check_stops(write_nowhere, mesh, 3, "/nowhere/plate.msh.tmp: cannot be written");
    kr_check_stops(write_to_a_full_disk, mesh, 3, "full.msh: cannot be written: File too large");
    assert_int_not_equal(access(path, F_OK), 0);
    kr_free(path);
    kr_mesh_free(mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_written_is_read),
        cmocka_unit_test(gmsh_reads_what_is_written),
        cmocka_unit_test(files_of_gmsh_are_read),
        cmocka_unit_test(a_file_by_hand_is_read),
        cmocka_unit_test(faults_are_named_with_their_line),
        cmocka_unit_test(faults_in_binary_are_named_with_their_byte),
        cmocka_unit_test(cut_files_stop),
        cmocka_unit_test(garbled_files_do_not_crash),
        cmocka_unit_test(what_cannot_be_written_stops),
    };
    char filter[256];
    const char *only = getenv("ONLY");
    snprintf(filter, sizeof filter, "*%s*", only ? only : "");
    cmocka_set_test_filter(filter);
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
