/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Pre-cracks: one plane told as polygon, disc and triangles cuts the same bonds; surfaces let nothing
 * through; STL files are read in both kinds and refused where they are broken.
 */
#include "test.h"

#include "base/error.h"
#include "base/stl.h"
#include "plates.h"
#include "precrack.h"
#include "triangles.h"

static const double SPACING = 1e-3;

/* ---- STL files ---- */

static char *path_of(const char *name) {
    return kr_text("/tmp/kirsch-precrack-%ld-%s", (long)getpid(), name);
}

static void write_ascii(const char *path, size_t n, const double *corner) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "solid made here\n");
    for (size_t k = 0; k < n; k++) {
        fprintf(file, " facet normal 0 0 0\n  outer loop\n");
        for (size_t c = 0; c < 3; c++)
            fprintf(file, "   vertex %.9e %.9g %.9g\n", corner[9 * k + 3 * c],
                    corner[9 * k + 3 * c + 1], corner[9 * k + 3 * c + 2]);
        fprintf(file, "  endloop\n endfacet\n");
    }
    fprintf(file, "endsolid\n");
    fclose(file);
}

/* Binary files begin with "solid" as often as not. */
static void write_binary(const char *path, size_t n, const double *corner) {
    FILE *file = fopen(path, "wb");
    char head[80] = "solid, but binary";
    uint32_t count = (uint32_t)n;
    assert_non_null(file);
    fwrite(head, 1, 80, file);
    fwrite(&count, 4, 1, file);
    for (size_t k = 0; k < n; k++) {
        float record[12] = {0};
        uint16_t attribute = 7;
        for (size_t c = 0; c < 9; c++)
            record[3 + c] = (float)corner[9 * k + c];
        fwrite(record, 4, 12, file);
        fwrite(&attribute, 2, 1, file);
    }
    fclose(file);
}

static void solid_stl_of_both_kinds_reads_alike(void **state) {
    (void)state;
    /* Numbers that a float holds, so that both files hold the same. */
    static const double corner[18] = {0, 0.5, -1.25, 3, 0, 0, 0, 4e6, 1, 2, 2, 2, -3, 5, 0.125, 7, 8, 9};
    char *path[2] = {path_of("ascii.stl"), path_of("binary.stl")};
    write_ascii(path[0], 2, corner);
    write_binary(path[1], 2, corner);
    for (int k = 0; k < 2; k++) {
        size_t count;
        double *got = kr_stl_read(path[k], 0.5, &count);
        assert_int_equal(count, 2);
        for (size_t c = 0; c < 18; c++)
            kr_check_near(got[c], 0.5 * corner[c], 0);
        kr_free(got);
        unlink(path[k]);
        kr_free(path[k]);
    }
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void read_stl(void *argument) {
    size_t count;
    kr_free(kr_stl_read(argument, 1, &count));
}

static void solid_broken_stl_is_refused(void **state) {
    (void)state;
    static const struct {
        const char *text, *said;
    } wrong[] = {
        {"", "neither an ASCII STL file, which begins with 'solid', nor a binary one: 0 bytes"},
        {"PK zip", "neither an ASCII STL file"},
        {"solid\nendsolid\n", ": no triangle in it"},
        {"solid\nfacet normal 0 0 1 outer loop\nvertex 1 2 3\nvertex 1 2 4\n",
         ".stl:5: the file ends, expected 'vertex'"},
        {"solid\nfacet normal 0 0 1 outer loop\nvertex 1 two 3\n",
         ".stl:3: expected a coordinate of a vertex, found 'two'"},
        {"solid\nvertex 1 2 3\n", ".stl:2: found 'vertex', expected 'facet'"},
    };
    char *path = path_of("wrong.stl");
    kr_check_stops(read_stl, path, KR_EXIT_INPUT, "cannot be read: No such file or directory");
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        FILE *file = fopen(path, "w");
        fputs(wrong[k].text, file);
        fclose(file);
        kr_check_stops(read_stl, path, KR_EXIT_INPUT, wrong[k].said);
    }
    unlink(path);
    kr_free(path);
}

/* ---- one plane in four ways ---- */

static struct kr_bonds *block(void) {
    struct kr_nodes *nodes = kr_plate_block(12, 11, 10, SPACING, 5);
    struct kr_material material = kr_pmma(KR_SOLID, 2.4 * SPACING);
    struct kr_bonds *bonds = kr_bonds_create(nodes, &material, KR_PARTIAL_VOLUME_HHB);
    kr_nodes_free(nodes);
    return bonds;
}

/* Which bonds live after a cut, owned by the caller; checks the books. */
static uint8_t *living_after(const struct kr_case_crack *from, const char *path, size_t *cut) {
    struct kr_bonds *bonds = block();
    struct kr_precrack *crack = kr_precrack_create(from, path);
    size_t before = bonds->count;
    *cut = kr_precrack_cut(crack, bonds, 1);
    uint8_t *living = KR_NEW(uint8_t, bonds->n_rows);
    size_t left = 0;
    for (size_t r = 0; r < bonds->n_rows; r++)
        left += (size_t)__builtin_popcount(living[r] = bonds->living[r]);
    assert_int_equal(left, bonds->count);
    assert_int_equal(left, before - 2 * *cut);
    kr_precrack_free(crack);
    kr_bonds_free(bonds);
    return living;
}

/* A place of the tilted plane, in two coordinates [spacings] about its middle. */
static void place(double a, double b, double to[3]) {
    static const double middle[3] = {6.03, 5.52, 5.01}, u[3] = {0.9, 0.1, 0.3}, v[3] = {-0.1, 0.95, 0.2};
    for (int d = 0; d < 3; d++)
        to[d] = SPACING * (middle[d] + a * u[d] + b * v[d]);
}

/* The square of that plane of half side `half` as 2 n^2 triangles. */
static double *triangles_of(double half, size_t n) {
    double *corner = KR_NEW(double, 18 * n * n), step = 2 * half / (double)n;
    for (size_t k = 0; k < n * n; k++) {
        double a = -half + (double)(k % n) * step, b = -half + (double)(k / n) * step;
        double *to = corner + 18 * k;
        place(a, b, to);
        place(a + step, b, to + 3);
        place(a + step, b + step, to + 6);
        place(a, b, to + 9);
        place(a + step, b + step, to + 12);
        place(a, b + step, to + 15);
    }
    return corner;
}

static struct kr_deck_list square_of(double half, double corner[12]) {
    static const double sign[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int k = 0; k < 4; k++)
        place(half * sign[k][0], half * sign[k][1], corner + 3 * k);
    return (struct kr_deck_list){12, corner, 1};
}

static void solid_one_plane_cuts_the_same_bonds_in_each_form(void **state) {
    (void)state;
    size_t rows, cut, again;
    struct kr_bonds *bonds = block();
    rows = bonds->n_rows;
    kr_bonds_free(bonds);
    /* The first square ends within the block, the second reaches out of it, as the disc does. */
    for (int whole = 0; whole < 2; whole++) {
        double corner[12], half = whole ? 20 : 3.3;
        struct kr_case_crack polygon = {.polygon = square_of(half, corner)}, disc = {0}, file = {0};
        uint8_t *wanted = living_after(&polygon, NULL, &cut);
        for (size_t n = 1; n <= 40; n += 39) {
            char *path = path_of("plane.stl");
            double *triangle = triangles_of(half, n);
            for (size_t k = 0; k < 18 * n * n; k++)
                triangle[k] *= 1e3;
            write_ascii(path, 2 * n * n, triangle);
            file.unit = 1e-3;
            uint8_t *got = living_after(&file, path, &again);
            assert_int_equal(again, cut);
            assert_memory_equal(got, wanted, rows);
            unlink(path);
            kr_free(path);
            kr_free(triangle);
            kr_free(got);
        }
        place(0, 0, disc.centre);
        kr_case_normal(4, corner, disc.normal);
        disc.radius = 20 * SPACING;
        if (whole) {
            uint8_t *got = living_after(&disc, NULL, &again);
            assert_int_equal(again, cut);
            assert_memory_equal(got, wanted, rows);
            kr_free(got);
        }
        kr_figure("a %s of the block: %zu bonds cut by polygon, 2 and 3200 triangles%s",
                  whole ? "whole section" : "part", cut, whole ? ", disc" : "");
        assert_true(cut > 1000);
        kr_free(wanted);
    }
    assert_int_equal(kr_memory_outstanding(), 0);
}

/* ---- shapes ---- */

/* A U of three rectangles, as one polygon and as six triangles; a circle by its equation. */
static void solid_hollow_polygon_and_disc_are_what_they_say(void **state) {
    (void)state;
    static const double u[24] = {0, 0, 1, 3, 0, 1, 3, 3, 1, 2, 3, 1, 2, 1, 1, 1, 1, 1, 1, 3, 1, 0, 3, 1};
    static const double part[3][4] = {{0, 0, 1, 3}, {1, 0, 2, 1}, {2, 0, 3, 3}};
    double *corner = KR_NEW(double, 54);
    for (size_t k = 0; k < 6; k++) {
        const double *r = part[k / 2];
        const double x[4] = {r[0], r[2], r[2], r[0]}, y[4] = {r[1], r[1], r[3], r[3]};
        for (size_t c = 0; c < 3; c++) {
            size_t at = c == 0 ? 0 : c + k % 2;
            const double place_of[3] = {x[at], y[at], 1};
            memcpy(corner + 9 * k + 3 * c, place_of, sizeof place_of);
        }
    }
    struct kr_triangles *triangles = kr_triangles_create(6, corner);
    struct kr_case_crack polygon = {.polygon = {24, (void *)u, 1}};
    struct kr_case_crack round = {.centre = {1, 2, 1}, .normal = {0, 0, -3}, .radius = 1.5};
    struct kr_precrack *hollow = kr_precrack_create(&polygon, NULL);
    struct kr_precrack *disc = kr_precrack_create(&round, NULL);
    uint64_t seed = 11;
    int met = 0;
    for (int k = 0; k < 20000; k++) {
        double p[3], q[3], share;
        for (int d = 0; d < 3; d++) {
            p[d] = kr_random(&seed, -1, d == 2 ? 2 : 4);
            q[d] = kr_random(&seed, -1, d == 2 ? 2 : 4);
        }
        share = (1 - p[2]) / (q[2] - p[2]);
        double x = p[0] + share * (q[0] - p[0]), y = p[1] + share * (q[1] - p[1]);
        int crosses = share >= 0 && share <= 1;
        assert_int_equal(kr_precrack_meets(hollow, p, q), kr_triangles_meet(triangles, p, q));
        assert_int_equal(kr_precrack_meets(disc, p, q),
                         crosses && hypot(x - 1, y - 2) <= 1.5);
        met += kr_precrack_meets(hollow, p, q);
    }
    assert_true(met > 1000 && met < 15000);
    /* in the plane itself: through the notch of the U, across a leg, and beside it all */
    assert_int_equal(kr_precrack_meets(hollow, (double[]){1.2, 2, 1}, (double[]){1.8, 2.5, 1}), 0);
    assert_int_equal(kr_precrack_meets(hollow, (double[]){0.5, 2, 1}, (double[]){1.5, 2, 1}), 1);
    assert_int_equal(kr_precrack_meets(hollow, (double[]){0.2, 2, 1}, (double[]){0.8, 2, 1}), 1);
    assert_int_equal(kr_precrack_meets(disc, (double[]){3, 0, 1}, (double[]){3, 4, 1}), 0);
    assert_int_equal(kr_precrack_meets(disc, (double[]){-3, 2, 1}, (double[]){3, 2, 1}), 1);
    assert_int_equal(kr_triangles_meet(triangles, (double[]){1.2, 2, 1}, (double[]){1.8, 2.5, 1}), 0);
    assert_int_equal(kr_triangles_meet(triangles, (double[]){0.2, 2, 1}, (double[]){0.8, 2, 1}), 1);
    kr_precrack_free(hollow);
    kr_precrack_free(disc);
    kr_triangles_free(triangles);
    assert_int_equal(kr_memory_outstanding(), 0);
}

/* The octahedron |x| + |y| + |z| = 1, each face in n^2 triangles of which half are turned round. */
static struct kr_triangles *octahedron(size_t n) {
    double *corner = KR_NEW(double, 72 * n * n), *to = corner;
    for (int face = 0; face < 8; face++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n - i; j++)
                for (size_t up = 0; up < 2 && i + j + up < n; up++) {
                    const size_t a[3] = {i + up, i + 1, i}, b[3] = {j + up, j, j + 1};
                    for (size_t c = 0; c < 3; c++, to += 3) {
                        double x = (double)a[c] / (double)n, y = (double)b[c] / (double)n;
                        double z = (double)(n - a[c] - b[c]) / (double)n; /* 0 at the edge, no less */
                        to[0] = face & 1 ? -x : x;
                        to[1] = face & 2 ? -y : y;
                        to[2] = face & 4 ? -z : z;
                    }
                }
    assert_ptr_equal(to, corner + 72 * n * n);
    return kr_triangles_create(8 * n * n, corner);
}

static double size_of(const double p[3]) {
    return fabs(p[0]) + fabs(p[1]) + fabs(p[2]);
}

static void solid_closed_surface_lets_nothing_through(void **state) {
    (void)state;
    enum { FINE = 12 };
    struct kr_triangles *surface = octahedron(FINE);
    uint64_t seed = 3;
    int through = 0, within = 0;
    for (int k = 0; k < 30000; k++) {
        double p[3], q[3];
        for (int d = 0; d < 3; d++) {
            p[d] = kr_random(&seed, -1, 1);
            q[d] = kr_random(&seed, -1, 1);
        }
        /* Corners are rounded: what is this near to the surface may be on either side. */
        if (fabs(size_of(p) - 1) < 1e-12 || fabs(size_of(q) - 1) < 1e-12)
            continue;
        int met = kr_triangles_meet(surface, p, q), in = size_of(p) < 1, out = size_of(q) > 1;
        if (in && out)
            assert_true(++through && met);
        if (in && !out)
            assert_true(++within && !met);
    }
    /* From within through every edge and corner of the triangles, as near as rounding lets it. */
    for (size_t i = 0; i <= 2 * FINE; i++)
        for (size_t j = 0; i + j <= 2 * FINE; j++) {
            double x = (double)i / (2 * FINE), y = (double)j / (2 * FINE);
            const double on[3] = {x, -y, (double)(2 * FINE - i - j) / (2 * FINE)};
            for (int k = 0; k < 20; k++) {
                double p[3] = {0}, q[3];
                for (int d = 0; d < 3; d++) {
                    p[d] = kr_random(&seed, -0.3, 0.3);
                    q[d] = on[d] + 1.3 * (on[d] - p[d]);
                }
                assert_true(kr_triangles_meet(surface, p, q));
            }
        }
    kr_figure("%d segments through the octahedron, %d within it", through, within);
    assert_true(through > 1000 && within > 100);
    kr_triangles_free(surface);
}

/* ---- in a plate ---- */

static void precrack_with_a_bend_is_two_straight_ones(void **state) {
    (void)state;
    const double point[6] = {0.1e-3, 7.3e-3, 8.2e-3, 5.1e-3, 9.9e-3, 17.7e-3};
    struct kr_material material = kr_pmma(KR_PLANE_STRESS, 3.1 * SPACING);
    struct kr_nodes *nodes = kr_plate_lattice(20, 20, SPACING);
    struct kr_bonds *a = kr_bonds_create(nodes, &material, KR_PARTIAL_VOLUME_HHB);
    struct kr_bonds *b = kr_bonds_create(nodes, &material, KR_PARTIAL_VOLUME_HHB);
    struct kr_case_crack bent = {.points = {6, (void *)point, 1}};
    struct kr_precrack *crack = kr_precrack_create(&bent, NULL);
    size_t cut = kr_precrack_cut(crack, a, 1);
    size_t first = kr_precrack_cut_line(b, point, point + 2, 1);
    size_t second = kr_precrack_cut_line(b, point + 2, point + 4, 1);
    assert_int_equal(cut, first + second);
    assert_true(first > 100 && second > 100);
    assert_memory_equal(a->living, b->living, a->n_rows);
    for (size_t i = 0; i < a->n; i++)
        kr_check_near(kr_bonds_damage(a, i), kr_bonds_damage(b, i), 1e-15);
    kr_precrack_free(crack);
    kr_bonds_free(a);
    kr_bonds_free(b);
    kr_nodes_free(nodes);
    assert_int_equal(kr_memory_outstanding(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solid_stl_of_both_kinds_reads_alike),
        cmocka_unit_test(solid_broken_stl_is_refused),
        cmocka_unit_test(solid_one_plane_cuts_the_same_bonds_in_each_form),
        cmocka_unit_test(solid_hollow_polygon_and_disc_are_what_they_say),
        cmocka_unit_test(solid_closed_surface_lets_nothing_through),
        cmocka_unit_test(precrack_with_a_bend_is_two_straight_ones),
    };
    kr_run_tests(tests);
}
