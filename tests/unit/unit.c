/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Quantities with units: values, and the sentence for each way in which one can be wrong.
 */
#include "test.h"

#include "base/unit.h"

static const struct {
    const char *text, *unit;
    double value;
} good[] = {
    {"0.16 mm", "m", 0.00016},
    {"160um", "m", 0.00016},
    {"160 µm", "m", 0.00016},
    {" +1.6e-4 m\n", "m", 0.00016},
    {"-25 mm", "m", -0.025},
    {".5 cm", "m", 0.005},
    {"1190 kg/m3", "kg/m^3", 1190},
    {"1.19 g/cm^3", "kg/m^3", 1190},
    {"38.2 J/m2", "J/m^2", 38.2},
    {"38.2 N/m", "J/m^2", 38.2},
    {"3.7 us", "s", 3.7e-6},
    {"6 MPa", "Pa", 6e6},
    {"3.2 GPa", "Pa", 3.2e9},
    {"6 N / mm^2", "Pa", 6e6},
    {"0.3 m/s", "m/s", 0.3},
    {"2.5 kN/m3", "N/m^3", 2500},
    {"0.35", "1", 0.35},
    {"-1e-3", "1", -1e-3},
};

static void unit_converts_to_si_exactly(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        double value = 0;
        char *why = NULL;
        if (!kr_unit_read(good[i].text, good[i].unit, &value, &why))
            fail_msg("'%s': %s", good[i].text, why);
        kr_check_near(value, good[i].value,
                      0); /* equal lengths give equal bits: decks are hashed */
    }
    kr_unit_close();
    assert_int_equal(kr_memory_outstanding(), 0);
}

#define BEYOND(text, noun, cure) \
    "found '" text "', expected " noun " between 2.2e-308 and 1.8e308 in SI units, such as " cure

static const struct {
    const char *text, *unit, *why;
} bad[] = {
    {"0.16", "m", "found '0.16', expected a length with its unit, such as '0.16 mm'"},
    {"", "s", "found '', expected a time with its unit, such as '1 us'"},
    {"mm", "m", "found 'mm', expected a length with its unit, such as '1 mm'"},
    {"thin", "m", "found 'thin', expected a length with its unit, such as '1 mm'"},
    {"2 kg", "m",
     "found '2 kg', whose unit 'kg' is of another kind; expected a length, such as '2 mm'"},
    {"2 mmm", "m", "found '2 mmm', whose unit 'mmm' is unknown; expected a length, such as '2 mm'"},
    {"3 mm", "1", "found '3 mm', expected a pure number, without a unit"},
    {"3 %", "1", "found '3 %', expected a pure number, without a unit"},
    {"nan", "1", "found 'nan', expected a pure number, without a unit"},
    {"inf m", "m", "found 'inf m', expected a length with its unit, such as '1 mm'"},
    {"0x10 m", "m", "found '0x10 m', expected a length with its unit, such as '1 mm'"},
    {"1e999 m", "m", BEYOND("1e999 m", "a length", "'1 mm'")},
    {"-1e400 mm", "m", BEYOND("-1e400 mm", "a length", "'1 mm'")},
    {"1e-400 mm", "m", BEYOND("1e-400 mm", "a length", "'1 mm'")},
    {"3e-310 m", "m", BEYOND("3e-310 m", "a length", "'1 mm'")},
    {"1e308 km", "m", BEYOND("1e308 km", "a length", "'1 mm'")},
    {"1e-300 nm", "m", BEYOND("1e-300 nm", "a length", "'1 mm'")},
    {"0.00001e999999999999", "1", BEYOND("0.00001e999999999999", "a pure number", "'1'")},
    {"1 2 mm", "m",
     "found '1 2 mm', whose unit '2 mm' is unknown; expected a length, such as '1 mm'"},
    {"20 degC", "K",
     "found '20 degC', whose unit 'degC' is of another kind; expected a quantity, such as '20 K'"},
    {"1,5 mm", "m",
     "found '1,5 mm', whose unit ',5 mm' is unknown; expected a length, such as '1 mm'"},
    {"3 s since 2000-01-01", "s",
     "found '3 s since 2000-01-01', whose unit 's since 2000-01-01' is of another kind; expected a "
     "time, such as '3 us'"},
};

static void unit_says_what_is_wrong(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        double value = 7;
        char *why = NULL;
        assert_false(kr_unit_read(bad[i].text, bad[i].unit, &value, &why));
        assert_string_equal(why, bad[i].why);
        assert_true(value == 7); /* untouched */
        kr_free(why);
    }
    kr_unit_close();
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void unit_factor_is_zero_where_none_converts(void **state) {
    (void)state;
    kr_check_near(kr_unit_factor("MPa", "Pa"), 1e6, 0);
    kr_check_near(kr_unit_factor("kg", "Pa"), 0, 0);
    kr_check_near(kr_unit_factor("degC", "K"), 0, 0);
    kr_check_near(kr_unit_factor("m @ 5", "m"), 0, 0);
    kr_check_near(kr_unit_factor("", "m"), 0, 0);
    kr_check_near(kr_unit_factor("2 mm", "m"), 0, 0);
    kr_unit_close();
    kr_unit_close(); /* twice does no harm */
}

static void unit_names_quantities(void **state) {
    (void)state;
    assert_string_equal(kr_unit_noun("Pa"), "a stress");
    assert_string_equal(kr_unit_common("Pa"), "MPa");
    assert_string_equal(kr_unit_noun("mol"), "a quantity");
    assert_string_equal(kr_unit_common("mol"), "mol");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unit_converts_to_si_exactly),
        cmocka_unit_test(unit_says_what_is_wrong),
        cmocka_unit_test(unit_factor_is_zero_where_none_converts),
        cmocka_unit_test(unit_names_quantities),
    };
    kr_run_tests(tests);
}
