/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A preset chooses what the deck leaves open, and nothing else.
 */
#include "test.h"

#include "case_check.h"

static const char body[] = "geometry: {width: 50 mm, height: 25 mm}\n"
                           "mesh: {spacing: 0.1 mm}\n"
                           "material: {model: plane-stress, youngs_modulus: 3.2 GPa,"
                           " density: 1190 kg/m3}\n"
                           "solver: {end_time: 50 us}\n";

/* Read a deck of these lines with some `--set`s as every program does. */
static void read_case(const char *lines, size_t n_set, const char *const *set, struct kr_case *c) {
    char path[] = "/tmp/kirsch-preset-XXXXXX";
    FILE *file = fdopen(mkstemp(path), "w");
    fprintf(file, "%s%s", body, lines);
    fclose(file);
    memset(c, 0, sizeof *c);
    struct kr_deck *deck = kr_deck_open(path, NULL, n_set, set);
    kr_deck_read(deck, kr_case_keys, c);
    kr_case_preset(deck, c);
    kr_case_check(deck, c);
    kr_deck_finish(deck);
    char *resolved = kr_deck_resolved(deck, "nodes");
    char word[32], line[64];
    kr_case_word(KR_PARTIAL_VOLUME_WORDS, c->partial_volume, word);
    snprintf(line, sizeof line, "nodes.partial_volume: %s\n", word);
    if (!strstr(resolved, word)) /* what makes a step out of date must know of it */
        fail_msg("wanted '%s' in\n%s", line, resolved);
    kr_free(resolved);
    kr_deck_close(deck);
    unlink(path);
}

static void test_preset_is_the_papers(void **state) {
    struct kr_case c;
    (void)state;
    read_case("preset: plates-paper\nnodes: {horizon: 0.4 mm}\n", 0, NULL, &c);
    assert_int_equal(c.grid, KR_GRID_NEAR_BOUNDARY);
    assert_int_equal(c.partial_volume, KR_PARTIAL_VOLUME_HHB_ONE_SIDED);
    assert_int_equal(c.surface_correction, KR_SURFACE_ENERGY);
    assert_int_equal(c.surface_deformation, KR_UNIAXIAL_Y);
}

static void test_given_keys_win(void **state) {
    struct kr_case c;
    const char *const set[] = {"nodes.surface_correction=volume"};
    (void)state;
    read_case("preset: plates-paper\nnodes: {horizon: 0.4 mm, partial_volume: hhb}\n", 1, set, &c);
    assert_int_equal(c.partial_volume, KR_PARTIAL_VOLUME_HHB);
    assert_int_equal(c.surface_correction, KR_SURFACE_VOLUME);
    assert_int_equal(c.surface_deformation, KR_UNIAXIAL_Y);
}

static void test_without_preset_defaults_stay(void **state) {
    struct kr_case c;
    (void)state;
    read_case("nodes: {horizon: 0.4 mm}\n", 0, NULL, &c);
    assert_int_equal(c.grid, KR_GRID_VORONOI); /* the best of docs/corrections.md */
    assert_int_not_equal(c.partial_volume, KR_PARTIAL_VOLUME_HHB_ONE_SIDED);
    assert_int_equal(c.surface_deformation, KR_MEAN_OVER_AXES);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_preset_is_the_papers),
        cmocka_unit_test(test_given_keys_win),
        cmocka_unit_test(test_without_preset_defaults_stay),
    };
    kr_run_tests(tests);
}
