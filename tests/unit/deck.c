/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The deck by a small table of its own: every type, defaults, overrides, positions and the text of
 * what was understood. Wrong decks are in tests/input/decks.c.
 */
#include "test.h"

#include "base/deck_private.h"
#include "base/unit.h"

struct box {
    const char *name;
    double lower[2];
    int64_t count;
};

struct plate {
    const char *title, *empty;
    double width, gap, unset;
    int64_t seed;
    int fast, grid;
    double centre[2];
    struct kr_deck_list times, names, items, map, absent;
    struct kr_deck_formula pull, push[2], number;
};

#define AT(field) offsetof(struct plate, field)
static const struct kr_deck_key box_keys[] = {
    {"lower", KR_DECK_VECTOR, offsetof(struct box, lower), "m", .count = 2, .text = "Corner."},
    {"count", KR_DECK_INTEGER, offsetof(struct box, count), .fallback = "7", .text = "How many."},
    {NULL},
};
static const struct kr_deck_key part_keys[] = {
    {"width", KR_DECK_NUMBER, AT(width), "m", .most = INFINITY, .exclusive = 1, .text = "Width."},
    {"gap", KR_DECK_NUMBER, AT(gap), "m", .fallback = "0.3 mm", .text = "Gap."},
    {"unset", KR_DECK_NUMBER, AT(unset), "s", .fallback = "", .text = "Optional."},
    {"grid", KR_DECK_CHOICE, AT(grid), .words = "square round", .fallback = "round",
     .text = "Kind."},
    {"centre", KR_DECK_VECTOR, AT(centre), "m", .count = 2, .fallback = "[1 mm, 2 mm]",
     .text = "Middle."},
    {NULL},
};
static const struct kr_deck_key keys[] = {
    {"title", KR_DECK_TEXT, AT(title), .fallback = "", .text = "Title."},
    {"empty", KR_DECK_TEXT, AT(empty), .fallback = "", .text = "Nothing."},
    {"seed", KR_DECK_INTEGER, AT(seed), .least = 0, .most = 9e15, .fallback = "1", .text = "Seed."},
    {"fast", KR_DECK_BOOLEAN, AT(fast), .fallback = "true", .text = "Fast."},
    {"part", KR_DECK_SECTION, .keys = part_keys, .text = "A part."},
    {"times", KR_DECK_NUMBERS, AT(times), "s", .fallback = "", .text = "Times."},
    {"names", KR_DECK_TEXTS, AT(names), .fallback = "", .text = "Names."},
    {"items", KR_DECK_LIST, AT(items), .keys = box_keys, .item_size = sizeof(struct box),
     .fallback = "", .text = "Items."},
    {"map", KR_DECK_MAP, AT(map), .keys = box_keys, .item_size = sizeof(struct box), .fallback = "",
     .text = "By name."},
    {"absent", KR_DECK_NUMBERS, AT(absent), "m", .fallback = "", .text = "Not there."},
    {"pull", KR_DECK_FORMULA, AT(pull), "Pa", .fallback = "", .text = "Pull."},
    {"push", KR_DECK_FORMULAS, AT(push), "m/s", .count = 2, .fallback = "", .text = "Push."},
    {"number", KR_DECK_FORMULA, AT(number), "1", .fallback = "", .text = "Number."},
    {NULL},
};

static const char full[] = "# a comment\n"
                           "title: \"two \\\"quoted\\\" words,\\ntwo lines\"\n"
                           "seed: 20230101\n"
                           "fast: false\n"
                           "part:\n"
                           "  width: 50 mm\n"
                           "  centre: [12.5 mm, -3 cm]\n"
                           "times: [1 us, 2.5us]\n"
                           "names: [top, no]\n"
                           "items:\n"
                           "  - {lower: [1 m, 2 m], count: 3}\n"
                           "  - lower: [3 m, 4 m]\n"
                           "map:\n"
                           "  left: {lower: [5 m, 6 m]}\n"
                           "  right: {lower: [7 m, 8 m], count: -9}\n"
                           "pull: 6 N / mm^2\n"
                           "push: [free, \"0.3*min(t/200e-6, 1) m/s\"]\n"
                           "number: x*y\n"
                           "variants:\n"
                           "  wide: {part.width: 7 m, items.1.count: 11}\n"
                           "  nested: {part: {gap: 9 mm}, map: {left: {count: 2}}}\n"
                           "  unused: {seed: 3}\n";

static char file_name[] = "/tmp/kirsch-deck-XXXXXX";

static struct kr_deck *open_text(const char *text, const char *variant, const char *set) {
    FILE *file = fopen(file_name, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    return kr_deck_open(file_name, variant, set ? 1 : 0, &set);
}

static void close_all(struct kr_deck *deck) {
    kr_deck_close(deck);
    kr_unit_close();
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void deck_reads_every_type(void **state) {
    (void)state;
    struct plate p = {0};
    struct kr_deck *deck = open_text(full, NULL, NULL);
    kr_deck_read(deck, keys, &p);
    kr_deck_finish(deck);
    assert_string_equal(p.title, "two \"quoted\" words,\ntwo lines");
    assert_int_equal(p.seed, 20230101);
    assert_int_equal(p.fast, 0);
    kr_check_near(p.width, 0.05, 0);
    kr_check_near(p.centre[0], 0.0125, 0);
    kr_check_near(p.centre[1], -0.03, 0);
    assert_int_equal(p.times.count, 2);
    kr_check_near(((double *)p.times.item)[1], 2.5e-6, 0);
    assert_string_equal(((const char **)p.names.item)[1], "no");
    const struct box *items = p.items.item, *map = p.map.item;
    assert_int_equal(p.items.count, 2);
    kr_check_near(items[1].lower[1], 4, 0);
    assert_int_equal(items[0].count, 3);
    assert_string_equal(map[1].name, "right");
    kr_check_near(map[1].lower[0], 7, 0);
    assert_int_equal(map[1].count, -9);
    close_all(deck);
}

static void deck_splits_formulas_from_units(void **state) {
    (void)state;
    struct plate p = {0};
    struct kr_deck *deck = open_text(full, NULL, NULL);
    kr_deck_read(deck, keys, &p);
    kr_deck_finish(deck);
    assert_string_equal(p.pull.text, "6");
    kr_check_near(p.pull.factor, 1e6, 0);
    assert_true(p.push[0].is_free);
    assert_string_equal(p.push[1].text, "0.3*min(t/200e-6, 1)");
    kr_check_near(p.push[1].factor, 1, 0);
    assert_false(p.push[1].is_free);
    assert_string_equal(p.number.text, "x*y");
    close_all(deck);
}

static void deck_finds_the_unit_of_a_formula(void **state) {
    static const struct {
        const char *deck, *text;
        double factor;
    } formulas[] = {
        {"pull: 6MPa", "6", 1e6},         {"pull: 1e-3 kPa", "1e-3", 1e3},
        {"pull: 2e3Pa", "2e3", 1},        {"pull: (x+y)GPa", "(x+y)", 1e9},
        {"pull: t N/mm2", "t", 1e6},      {"pull: 3.e MPa", "3.*e", 0},
        {"pull: 2*e kN/m^2", "2*e", 1e3}, {"pull: -x * 1e9 Pa", "-x * 1e9", 1},
    };
    (void)state;
    for (size_t i = 0; i < sizeof formulas / sizeof *formulas; i++) {
        struct plate p = {0};
        char *text = kr_text("part: {width: 1 m}\n%s\n", formulas[i].deck);
        struct kr_deck *deck = open_text(text, NULL, NULL);
        kr_deck_read(deck, keys, &p);
        kr_check_near(p.pull.factor, formulas[i].factor, 0);
        assert_int_equal(kr_deck_faults(deck), formulas[i].factor == 0);
        if (formulas[i].factor != 0)
            assert_string_equal(p.pull.text, formulas[i].text);
        kr_free(text);
        close_all(deck);
    }
}

static void deck_fills_in_defaults(void **state) {
    (void)state;
    struct plate p = {0};
    struct kr_deck *deck = open_text("part: {width: 1 m}\n", NULL, NULL);
    kr_deck_read(deck, keys, &p);
    kr_deck_finish(deck);
    kr_check_near(p.gap, 0.0003, 0);
    kr_check_near(p.centre[1], 0.002, 0);
    assert_int_equal(p.seed, 1);
    assert_int_equal(p.fast, 1);
    assert_int_equal(p.grid, 1);
    assert_null(p.title);
    assert_null(p.pull.text);
    assert_true(p.unset == 0);
    assert_false(p.absent.given);
    close_all(deck);
}

static void deck_tells_given_from_default(void **state) {
    (void)state;
    struct plate p = {0};
    struct kr_deck *deck = open_text(full, NULL, "part.unset=3 s");
    kr_deck_read(deck, keys, &p);
    kr_deck_finish(deck);
    const struct box *items = p.items.item;
    assert_true(kr_deck_given(deck, &p.width));
    assert_true(kr_deck_given(deck, &p.unset));
    assert_true(kr_deck_given(deck, p.push));
    assert_true(kr_deck_given(deck, &items[0].count));
    assert_false(kr_deck_given(deck, &items[1].count));
    assert_false(kr_deck_given(deck, &p.gap));
    assert_false(kr_deck_given(deck, &p.absent));
    assert_true(p.items.given);
    close_all(deck);
}

static void check_where(struct kr_deck *deck, const void *field, const char *rest) {
    char *wanted = kr_text("%s:%s", file_name, rest);
    assert_string_equal(kr_deck_where(deck, field), wanted);
    kr_free(wanted);
}

static void deck_knows_where_values_stand(void **state) {
    (void)state;
    struct plate p = {0};
    struct kr_deck *deck = open_text(full, "wide", "seed=4");
    kr_deck_read(deck, keys, &p);
    kr_deck_finish(deck);
    const struct box *items = p.items.item, *map = p.map.item;
    const double *times = p.times.item;
    check_where(deck, &p.title, "2:8: title");
    check_where(deck, p.centre, "7:12: part.centre");
    check_where(deck, &p.centre[1], "7:21: part.centre.1");
    check_where(deck, &times[1], "8:15: times.1");
    check_where(deck, &items[1].lower[1], "12:18: items.1.lower.1");
    check_where(deck, &map[1], "15:11: map.right");
    check_where(deck, &map[1].count, "15:37: map.right.count");
    check_where(deck, &p.gap, "6:3: part.gap");
    check_where(deck, &p.width, "20:22: part.width");
    assert_string_equal(kr_deck_where(deck, &p.seed), "command line: seed");
    assert_string_equal(kr_deck_where(deck, &deck), file_name);
    assert_string_equal(kr_deck_path(deck), file_name);
    assert_string_equal(kr_deck_folder(deck), "/tmp");
    close_all(deck);
}

static void deck_lays_variant_then_set_over_itself(void **state) {
    (void)state;
    struct plate p = {0};
    struct kr_deck *deck = open_text(full, "wide", "part.width=9 m");
    kr_deck_read(deck, keys, &p);
    kr_deck_finish(deck);
    const struct box *items = p.items.item;
    kr_check_near(p.width, 9, 0);
    assert_int_equal(items[1].count, 11);
    kr_check_near(items[1].lower[0], 3, 0);
    close_all(deck);
}

static void deck_merges_a_nested_variant(void **state) {
    (void)state;
    struct plate p = {0};
    struct kr_deck *deck = open_text(full, "nested", "push=[2 m/s, free]");
    kr_deck_read(deck, keys, &p);
    kr_deck_finish(deck);
    const struct box *map = p.map.item;
    kr_check_near(p.width, 0.05, 0);
    kr_check_near(p.gap, 0.009, 0);
    assert_int_equal(p.map.count, 2);
    assert_int_equal(map[0].count, 2);
    kr_check_near(map[0].lower[1], 6, 0);
    assert_true(p.push[1].is_free);
    close_all(deck);
}

static void deck_overrides_make_sections(void **state) {
    (void)state;
    struct plate p = {0};
    struct kr_deck *deck = open_text("title: x\n", NULL, "part.width=3 mm");
    kr_deck_read(deck, keys, &p);
    kr_deck_finish(deck);
    kr_check_near(p.width, 0.003, 0);
    close_all(deck);
}

static void deck_resolves_to_text(void **state) {
    (void)state;
    struct plate p = {0};
    struct kr_deck *deck = open_text(full, NULL, NULL);
    kr_deck_read(deck, keys, &p);
    kr_deck_finish(deck);
    char *text = kr_deck_resolved(deck, NULL);
    assert_string_equal(text, "title = \"two \\\"quoted\\\" words,\\ntwo lines\"\n"
                              "empty = none\n"
                              "seed = 20230101\n"
                              "fast = false\n"
                              "part.width = 0.05 m\n"
                              "part.gap = 0.0003 m\n"
                              "part.unset = 0 s\n"
                              "part.grid = round\n"
                              "part.centre = [0.0125, -0.03] m\n"
                              "times = [1e-06, 2.5e-06] s\n"
                              "names = [\"top\", \"no\"]\n"
                              "items: 2\n"
                              "items.0.lower = [1, 2] m\n"
                              "items.0.count = 3\n"
                              "items.1.lower = [3, 4] m\n"
                              "items.1.count = 7\n"
                              "map: 2\n"
                              "map.left.lower = [5, 6] m\n"
                              "map.left.count = 7\n"
                              "map.right.lower = [7, 8] m\n"
                              "map.right.count = -9\n"
                              "absent = [] m\n"
                              "pull = \"6\" * 1e+06 Pa\n"
                              "push = [free, \"0.3*min(t/200e-6, 1)\" * 1] m/s\n"
                              "number = \"x*y\" * 1\n");
    kr_free(text);
    text = kr_deck_resolved(deck, "times seed");
    assert_string_equal(text, "seed = 20230101\ntimes = [1e-06, 2.5e-06] s\n");
    kr_free(text);
    close_all(deck);
}

static void deck_resolves_equal_decks_equally(void **state) {
    static const char *const decks[] = {
        "part: {width: 0.16 mm, gap: 300 um}\n",
        "seed: 1\npart:\n  width: 160 um # the same\n",
        "fast: true\npart:\n  gap: 3e-4 m\n  width: \"0.00016 m\"\n",
    };
    char *first = NULL;
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        struct plate p = {0};
        struct kr_deck *deck = open_text(decks[i], NULL, NULL);
        kr_deck_read(deck, keys, &p);
        kr_deck_finish(deck);
        char *text = kr_deck_resolved(deck, NULL);
        if (first)
            assert_string_equal(text, first);
        else
            first = kr_text_copy(text);
        kr_free(text);
        kr_deck_close(deck);
    }
    kr_free(first);
    close_all(NULL);
}

static void deck_collects_later_faults(void **state) {
    (void)state;
    struct plate p = {0};
    struct kr_deck *deck = open_text(full, NULL, NULL);
    kr_deck_read(deck, keys, &p);
    assert_int_equal(kr_deck_faults(deck), 0);
    kr_deck_fault(deck, &p.width, "%g m is odd", p.width);
    kr_deck_fault(deck, NULL, "something else");
    assert_int_equal(kr_deck_faults(deck), 2);
    close_all(deck);
}

static void deck_distance_counts_letters(void **state) {
    (void)state;
    assert_int_equal(kr_deck_distance("horizon", "horizon"), 0);
    assert_int_equal(kr_deck_distance("End-Time", "end_time"), 0);
    assert_int_equal(kr_deck_distance("horizn", "horizon"), 1);
    assert_int_equal(kr_deck_distance("spaceing", "spacing"), 1);
    assert_int_equal(kr_deck_distance("kitten", "sitting"), 3);
    assert_int_equal(kr_deck_distance("", "abc"), 3);
}

static void deck_reference_names_every_key(void **state) {
    (void)state;
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    kr_deck_reference(file, keys);
    fclose(file);
    assert_non_null(strstr(text, "generated by `make docs`"));
    assert_non_null(strstr(text, "| `width` | a length | m | required | above 0 m | Width. |\n"));
    assert_non_null(strstr(text, "| `grid` | `square`, `round` |  | `round` |  | Kind. |\n"));
    assert_non_null(strstr(text, "\n## `items`, a list\n\nItems.\n"));
    assert_non_null(strstr(text, "\n## `map`, by name\n\nBy name.\n"));
    for (const struct kr_deck_key *key = keys; key->name; key++) {
        char *quoted = kr_text("`%s`", key->name);
        assert_non_null(strstr(text, quoted));
        kr_free(quoted);
    }
    free(text);
    assert_int_equal(kr_memory_outstanding(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(deck_reads_every_type),
        cmocka_unit_test(deck_splits_formulas_from_units),
        cmocka_unit_test(deck_finds_the_unit_of_a_formula),
        cmocka_unit_test(deck_fills_in_defaults),
        cmocka_unit_test(deck_tells_given_from_default),
        cmocka_unit_test(deck_knows_where_values_stand),
        cmocka_unit_test(deck_lays_variant_then_set_over_itself),
        cmocka_unit_test(deck_merges_a_nested_variant),
        cmocka_unit_test(deck_overrides_make_sections),
        cmocka_unit_test(deck_resolves_to_text),
        cmocka_unit_test(deck_resolves_equal_decks_equally),
        cmocka_unit_test(deck_collects_later_faults),
        cmocka_unit_test(deck_distance_counts_letters),
        cmocka_unit_test(deck_reference_names_every_key),
    };
    int descriptor = mkstemp(file_name);
    if (descriptor < 0)
        return 1;
    close(descriptor);
    char filter[256];
    snprintf(filter, sizeof filter, "*%s*", getenv("ONLY") ? getenv("ONLY") : "");
    cmocka_set_test_filter(filter);
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    unlink(file_name);
    return failed;
}
