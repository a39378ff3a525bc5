/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Meshes that gmsh wrote: both versions of MSH, ASCII and binary, first and second order, 2D and 3D,
 * mixed elements, groups that overlap, numbers with gaps. All must give the same nodes and sets. Cut
 * and garbled files must stop with a sentence.
 */
#include "test.h"

#include "folder.h"

#include "convert.h"
#include "mesh.h"

#include <sys/stat.h>

/* Squares beside triangles; groups of one and of both; group numbers with gaps; a set of a point. */
static const char plane[] =
    "Point(1)={0,0,0,.3}; l[]=Extrude{1,0,0}{Point{1}; Layers{4};};\n"
    "s[]=Extrude{0,1,0}{Curve{l[1]}; Layers{3}; Recombine;};\n"
    "t[]=Extrude{1,0,0}{Curve{s[2]}; Layers{2};};\n"
    "Physical Surface(\"both\",70)={s[1],t[1]}; Physical Surface(\"squares\",3)={s[1]};\n"
    "Physical Curve(\"bottom\",11)={l[1]}; Physical Point(\"corner\",5)={1};\n";

/* Hexahedra beside wedges, and a tetrahedron's block elsewhere. */
static const char solid[] =
    "Point(1)={0,0,0,.4}; l[]=Extrude{1,0,0}{Point{1}; Layers{4}; Recombine;};\n"
    "s[]=Extrude{0,1,0}{Curve{l[1]}; Layers{3}; Recombine;};\n"
    "v[]=Extrude{0,0,1}{Surface{s[1]}; Layers{2}; Recombine;};\n"
    "t[]=Extrude{1,0,0}{Curve{s[2]}; Layers{2};};\n"
    "w[]=Extrude{0,0,1}{Surface{t[1]}; Layers{2}; Recombine;};\n"
    "p=newp; Point(p)={5,0,0,.4}; a[]=Extrude{1,0,0}{Point{p};}; b[]=Extrude{0,1,0}{Curve{a[1]};};\n"
    "c[]=Extrude{0,0,1}{Surface{b[1]};};\n"
    "Physical Volume(\"hex\",100)={v[1]}; Physical Volume(\"all\",6)={v[1],w[1],c[1]};\n"
    "Physical Surface(\"floor\",1)={s[1],t[1],b[1]}; Physical Point(\"p\",2)={1};\n";

/** Write the script and mesh it by gmsh's own program; the path is owned by the caller. */
static char *mesh_by_gmsh(const char *script, int dim, int version, int order, int binary) {
    char *geo = kr_text("%s/body.geo", folder), *path = kr_text("%s/body.msh", folder);
    FILE *file = fopen(geo, "w");
    fputs(script, file);
    fclose(file);
    char *command = kr_text("gmsh %s -%d -order %d -format msh%d %s -o %s > %s/log 2>&1", geo, dim,
                            order, version, binary ? "-bin" : "", path, folder);
    assert_int_equal(system(command), 0);
    kr_free(command);
    kr_free(geo);
    return path;
}

/** Let gmsh read body.msh and save it in another way: meshing again might give other tetrahedra. */
static char *save_by_gmsh(int version, int binary) {
    char *path = kr_text("%s/saved.msh", folder);
    char *command = kr_text("gmsh %s/body.msh -save -format msh%d %s -o %s > %s/log 2>&1", folder,
                            version, binary ? "-bin" : "", path, folder);
    assert_int_equal(system(command), 0);
    kr_free(command);
    return path;
}

static struct kr_nodes *nodes_of(const char *path) {
    struct kr_mesh *mesh = kr_mesh_read_msh(path);
    char *fault = kr_mesh_fault(mesh);
    if (fault)
        fail_msg("%s: %s", path, fault);
    struct kr_nodes *nodes = kr_convert(mesh);
    assert_null(kr_nodes_fault(nodes));
    kr_mesh_free(mesh);
    return nodes;
}

static double volume_of(const struct kr_nodes *nodes) {
    double sum = 0;
    for (size_t i = 0; i < nodes->n; i++)
        sum += nodes->volume[i];
    return sum;
}

/** Volume of a set of nodes and its moments about the axes. */
static void moments_of(const struct kr_nodes *nodes, const struct kr_set *set, double sum[4]) {
    memset(sum, 0, 4 * sizeof *sum);
    for (size_t k = 0; k < set->count; k++) {
        size_t i = (size_t)set->node[k];
        sum[3] += nodes->volume[i];
        for (int d = 0; d < nodes->dim; d++)
            sum[d] += nodes->volume[i] * nodes->position[(size_t)(nodes->dim * (int)i + d)];
    }
}

/** The same nodes and sets. Their order may differ where rounding in a text file moves a centroid
 *  across the limit between two rows, so sets are held against each other by their moments. */
static void check_same(const struct kr_nodes *a, const struct kr_nodes *b) {
    assert_int_equal(a->n, b->n);
    assert_int_equal(a->n_points, b->n_points);
    assert_int_equal(a->n_sets, b->n_sets);
    kr_check_near(volume_of(a), volume_of(b), 1e-13);
    for (size_t s = 0; s < a->n_sets; s++) {
        const struct kr_set *other = kr_nodes_set(b, a->set[s].name);
        double wanted[4], got[4];
        assert_non_null(other);
        assert_int_equal(a->set[s].count, other->count);
        kr_check_near(a->set[s].measure, other->measure, 1e-14);
        moments_of(a, &a->set[s], got);
        moments_of(b, other, wanted);
        for (int d = 0; d < 4; d++)
            kr_check_near(got[d], wanted[d], 1e-13);
    }
}

static void check_versions(const char *script, int dim, int order, double volume) {
    char *path = mesh_by_gmsh(script, dim, 41, order, 1);
    struct kr_nodes *wanted = nodes_of(path);
    kr_check_near(volume_of(wanted), volume, 1e-12);
    kr_free(path);
    for (int k = 0; k < 3; k++) {
        path = save_by_gmsh(k == 0 ? 41 : 22, k == 2);
        struct kr_nodes *nodes = nodes_of(path);
        check_same(nodes, wanted);
        kr_nodes_free(nodes);
        kr_free(path);
    }
    kr_nodes_free(wanted);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void all_versions_give_the_same_plate(void **unused) {
    (void)unused;
    check_versions(plane, 2, 1, 2);
    check_versions(plane, 2, 2, 2);
}

static void all_versions_give_the_same_solid(void **unused) {
    (void)unused;
    check_versions(solid, 3, 1, 3);
    check_versions(solid, 3, 2, 3);
}

static void sets_are_complete(void **unused) {
    (void)unused;
    for (int order = 1; order <= 2; order++) {
        char *path = mesh_by_gmsh(plane, 2, 22, order, 0);
        struct kr_nodes *nodes = nodes_of(path);
        assert_int_equal(nodes->n, 12 + 12);
        assert_int_equal(kr_nodes_set(nodes, "both")->count, 24);
        assert_int_equal(kr_nodes_set(nodes, "squares")->count, 12);
        assert_int_equal(kr_nodes_set(nodes, "bottom")->count, 4);
        kr_check_near(kr_nodes_set(nodes, "bottom")->measure, 1, 1e-14);
        assert_int_equal(kr_nodes_set(nodes, "corner")->count, 1);
        assert_int_equal(nodes->n_sets, 4);
        kr_nodes_free(nodes);
        kr_free(path);
    }
}

/** The volume of a ball comes nearer with the square of the cells' size; second order is nearer. */
static void a_ball_converges(void **unused) {
    double off[3];
    (void)unused;
    for (int k = 0; k < 3; k++) {
        char *script = kr_text("SetFactory(\"OpenCASCADE\"); Sphere(1)={0,0,0,1};\n"
                               "Mesh.CharacteristicLengthMax=%g; Mesh.CharacteristicLengthMin=%g;\n"
                               "Physical Volume(\"ball\")={1};\n",
                               k == 1 ? 0.2 : 0.4, k == 1 ? 0.2 : 0.4);
        char *path = mesh_by_gmsh(script, 3, 41, k == 2 ? 2 : 1, 1);
        struct kr_nodes *nodes = nodes_of(path);
        off[k] = 1 - volume_of(nodes) / (4 * M_PI / 3);
        kr_nodes_free(nodes);
        kr_free(path);
        kr_free(script);
    }
    kr_figure("ball: volume off by %.4f, half the size %.4f, second order %.4f", off[0], off[1], off[2]);
    assert_true(off[0] > 0 && off[0] < 0.08);
    assert_true(off[1] < off[0] / 3); /* order 2: a quarter, but gmsh's sizes are not exact */
    assert_true(fabs(off[2]) < off[0] / 3);
}

/* ---- cut and garbled ---- */

static char *get(const char *path, size_t *size) {
    struct stat about;
    assert_int_equal(stat(path, &about), 0);
    FILE *file = fopen(path, "rb");
    char *data = KR_NEW(char, (size_t)about.st_size + 1);
    *size = fread(data, 1, (size_t)about.st_size, file);
    fclose(file);
    return data;
}

/** Read the first `size` bytes in a child; returns its exit code, -1 for a crash. */
static int read_part(const char *data, size_t size) {
    char *path = kr_text("%s/part.msh", folder);
    int status;
    FILE *file = fopen(path, "wb");
    assert_int_equal(fwrite(data, 1, size, file), size);
    fclose(file);
    fflush(NULL);
    pid_t child = fork();
    if (child == 0) {
        if (!freopen("/dev/null", "w", stderr))
            _exit(99);
        struct kr_mesh *mesh = kr_mesh_read_msh(path);
        _exit(kr_mesh_fault(mesh) ? 2 : 0);
    }
    waitpid(child, &status, 0);
    kr_free(path);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void check_damaged(const char *script, int dim, int version, int binary) {
    static const char other[] = {0, -1, 127, ' ', '9', '-', '1'};
    size_t size;
    char *path = mesh_by_gmsh(script, dim, version, 2, binary), *data = get(path, &size);
    assert_int_equal(read_part(data, size), 0);
    for (size_t k = 1; k <= 60; k++) {
        size_t at = k * (size - 8) / 61;
        if (read_part(data, at) != 2)
            fail_msg("MSH %d cut at byte %zu of %zu: ended with %d", version, at, size,
                     read_part(data, at));
        char kept = data[at];
        data[at] = other[k % sizeof other];
        int code = read_part(data, size);
        if (code != 0 && code != 2)
            fail_msg("MSH %d, byte %zu changed to %d: ended with %d", version, at, data[at], code);
        data[at] = kept;
    }
    kr_free(data);
    kr_free(path);
}

static void damaged_files_stop(void **unused) {
    (void)unused;
    for (int binary = 0; binary < 2; binary++) {
        check_damaged(plane, 2, 22, binary);
        check_damaged(plane, 2, 41, binary);
        check_damaged(solid, 3, 22, binary);
        check_damaged(solid, 3, 41, binary);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_versions_give_the_same_plate),
        cmocka_unit_test(all_versions_give_the_same_solid),
        cmocka_unit_test(sets_are_complete),
        cmocka_unit_test(a_ball_converges),
        cmocka_unit_test(damaged_files_stop),
    };
    char filter[256];
    const char *only = getenv("ONLY");
    snprintf(filter, sizeof filter, "*%s*", only ? only : "");
    cmocka_set_test_filter(filter);
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
