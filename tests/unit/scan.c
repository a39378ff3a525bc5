/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Numbers in text: the short way of reading them gives the bits of strtod, and what is no number stops with a
 * sentence.
 */
#include "test.h"

#include "folder.h"

#include "base/error.h"
#include "base/scan.h"

enum { NUMBERS = 20000 };

static char *write_text(const char *text) {
    char *path = kr_text("%s/numbers.txt", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    return path;
}

static uint64_t seed = 1;

static uint64_t draw(void) { /* xorshift: Marsaglia, 2003 */
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return seed;
}

/** A number as programs write them: of one to eighteen digits, of any size, with and without point and exponent. */
static void draw_number(char text[64]) {
    static const char *const form[] = {"%.*g", "%.*f", "%.*e"};
    double value = (double)draw() * pow(10, (double)(draw() % 40) - 38);
    int digits = (int)(draw() % 19);
    unsigned way = draw() % 5;
    if (draw() % 2)
        value = -value;
    if (way < 3)
        snprintf(text, 64, form[way], digits, fabs(value) < 1e9 ? value : value * 1e-20);
    else if (way == 3) /* digits at random: halfway cases, and integers above 2^53 */
        snprintf(text, 64, "%llu.%llue%d", (unsigned long long)(draw() % 100000),
                 (unsigned long long)(draw() >> (draw() % 60)), (int)(draw() % 60) - 30);
    else
        snprintf(text, 64, "%llu", (unsigned long long)(draw() >> (draw() % 64)));
}

static void test_numbers_are_those_of_strtod(void **state) {
    static const char *const by_hand[] = {
        "0", "-0", "-0.0", "5.", ".5", "-.5", "+1", "1e5", "1E5", "1e+05", "1e-7", "1e-22", "1e22", "1e23", "1e-23",
        "9007199254740991", "9007199254740992", "9007199254740993", "900719925474099.3", "0.1", "0.3", "1e-300",
        "4.9e-324", "1.7976931348623157e308", "000000000000000000000000.25", "0.00000000000000000000000025", "0x10",
        "123456789012345678901234567890"};
    char *text = KR_NEW(char, 64 * (NUMBERS + sizeof by_hand / sizeof *by_hand)), *end = text;
    char one[64];
    (void)state;
    for (size_t k = 0; k < sizeof by_hand / sizeof *by_hand; k++)
        end += sprintf(end, "%s\n", by_hand[k]);
    for (size_t k = 0; k < NUMBERS; k++) {
        draw_number(one);
        end += sprintf(end, "%s%c", one, k % 3 ? ' ' : '\n');
    }
    char *path = write_text(text), *at = text;
    struct kr_scan scan = kr_scan_open(path);
    for (size_t k = 0; k < NUMBERS + sizeof by_hand / sizeof *by_hand; k++) {
        const char *from = at;
        double wanted = strtod(at, &at), got = kr_scan_double(&scan, "a number");
        if (memcmp(&got, &wanted, sizeof got))
            fail_msg("%.40s was read as %.17g, strtod has %.17g", from, got, wanted);
    }
    kr_scan_close(&scan);
    kr_free(path);
    kr_free(text);
}

static void read_one(void *path) {
    struct kr_scan scan = kr_scan_open(path);
    kr_scan_double(&scan, "a coordinate");
}

static void test_what_is_no_number_stops(void **state) {
    static const char *const bad[] = {".",  "-",   "--1", "1e", "1e+", "1.2.3", "1,5",
                                      "1e5x", "12a", "e5", "nan", "inf", "1e999", "-1e999"};
    (void)state;
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        char *line = kr_text("\n%s\n", bad[k]), *path = write_text(line);
        kr_check_stops(read_one, path, KR_EXIT_INPUT, "numbers.txt:");
        kr_check_stops(read_one, path, KR_EXIT_INPUT, "a coordinate");
        kr_free(line);
        kr_free(path);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers_are_those_of_strtod),
        cmocka_unit_test(test_what_is_no_number_stops),
    };
    char filter[256];
    const char *only = getenv("ONLY");
    snprintf(filter, sizeof filter, "*%s*", only ? only : "");
    cmocka_set_test_filter(filter);
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
