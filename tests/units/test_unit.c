/* test_unit.c -- units against two other programs, prefixes, powers, what is refused. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
#include <inttypes.h>

#include <math.h>
#include <string.h>

#include "units/unit.h"

static double
number_of(const qdot_unit *unit)
{
    const double up = fmpz_get_d(fmpq_numref(unit->factor)), down = fmpz_get_d(fmpq_denref(unit->factor));

    return up / down * pow(M_PI, (double)unit->pi);
}

static void
read_good(const char *text, qdot_unit *unit)
{
    size_t at;

    qdot_unit_init(unit);
    if (qdot_unit_read(text, unit, &at) != QDOT_OK)
        fail_msg("%s: %s", text, qdot_last_error()->message);
}

static bool
close_to(double x, double y, double within)
{
    return isnan(y) || fabs(x - y) <= within * fabs(y);
}

/* Da and u are measured: they differ by the year of their CODATA values; GNU units takes Oe from a measured mu_0. */
static bool
is_measured(const char *text)
{
    return strstr(text, "Da") != NULL || strstr(text, "Oe") != NULL || strcmp(text, "u") == 0;
}

static void
agrees_with_gnu_units_and_udunits(void **state)
{
    static const struct {
        const char *text;
        double gnu, udunits;
        int exponent[QDOT_BASES];
    } rows[] = {
#define ORACLE(text, gnu, udunits, ...) {text, gnu, udunits, {__VA_ARGS__}},
#include "oracle.def"
#undef ORACLE
    };
    const size_t n = sizeof rows / sizeof *rows;

    (void)state;
    assert_true(n > 200);
    for (size_t i = 0; i < n; i++) {
        qdot_unit unit;

        read_good(rows[i].text, &unit);
        if (!close_to(number_of(&unit), rows[i].gnu, is_measured(rows[i].text) ? 1e-8 : 1e-12) ||
            !close_to(number_of(&unit), rows[i].udunits, 1e-5))
            fail_msg("%s is %.17g, not %.17g or %.17g", rows[i].text, number_of(&unit), rows[i].gnu, rows[i].udunits);
        if (!qdot_dimension_equal(unit.dimension, qdot_dimension_make(rows[i].exponent)))
            fail_msg("%s has another dimension", rows[i].text);
        qdot_unit_clear(&unit);
    }
}

static void
factors_are_exact(void **state)
{
    static const struct {
        const char *text, *factor;
        int64_t pi;
    } rows[] = {
        {"km/h", "5/18", 0},       {"deg", "1/180", 1},      {"rpm", "1/30", 1},      {"deg^2", "1/32400", 2},
        {"rev/min", "1/30", 1},    {"1/deg", "180", -1},     {"cm^3", "1/1000000", 0}, {"kWh", "3600000", 0},
        {"J/(kg*K)", "1", 0},      {"m/s/s", "1", 0},        {"mum", "1/1000000", 0},  {"um", "1/1000000", 0},
        {"ha^(1/2)", "100", 0},    {"min", "60", 0},         {"cd", "1", 0},           {"Pa", "1", 0},
        {"dam", "10", 0},          {"(m/s)^2*t", "1000", 0}, {"mmin", NULL, 0},        {"kkg", NULL, 0},
        {"m^(-1/2)", "1", 0},      {"cm^(1/2)", "1/10", 0},  {"ft^(1/2)", NULL, 0},    {"mi/h", "1397/3125", 0},
    };

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        qdot_unit unit;
        size_t at;
        char *factor;

        qdot_unit_init(&unit);
        if (rows[i].factor == NULL) {
            if (qdot_unit_read(rows[i].text, &unit, &at) == QDOT_OK)
                fail_msg("%s is read", rows[i].text);
        } else {
            qdot_unit_clear(&unit);
            read_good(rows[i].text, &unit);
            factor = fmpq_get_str(NULL, 10, unit.factor);
            if (strcmp(factor, rows[i].factor) != 0 || unit.pi != rows[i].pi)
                fail_msg("%s is %s*pi^%" PRId64, rows[i].text, factor, unit.pi);
            flint_free(factor);
        }
        qdot_unit_clear(&unit);
    }
}

static void
errors_have_their_places(void **state)
{
    static const struct {
        const char *text;
        qdot_status status;
        size_t at;
        const char *message;
    } rows[] = {
        {"m/sec2", QDOT_ENAME, 2, "there is no unit `sec2`"},
        {"J/kg*K", QDOT_ESYNTAX, 4, "a `*` after a `/` in a unit: is it above or below?"},
        {"N m", QDOT_ESYNTAX, 1, "a unit is a product of powers, as in [kg*m/s^2]"},
        {"degC", QDOT_EDOMAIN, 0, "degC is a scale with an offset, by which no number can be multiplied"},
        {"2*m", QDOT_ESYNTAX, 0, "the only number in a unit is 1, as in [1/s]"},
        {"m^x", QDOT_ESYNTAX, 2, "the power of a unit is a short number, as in m^2 or m^(1/2)"},
        {"(m/s", QDOT_ESYNTAX, 4, "expected `)` in a unit"},
        {"", QDOT_ESYNTAX, 0, "expected the name of a unit, as in [m/s^2]"},
        {"m^(1/0)", QDOT_ESYNTAX, 5, "division by zero"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        qdot_unit unit;
        size_t at = 99;

        qdot_unit_init(&unit);
        assert_int_equal(qdot_unit_read(rows[i].text, &unit, &at), rows[i].status);
        assert_string_equal(qdot_last_error()->message, rows[i].message);
        assert_int_equal(at, rows[i].at);
        qdot_unit_clear(&unit);
    }
}

static void
words_and_units_of_dimensions(void **state)
{
    static const struct {
        const char *unit, *words, *si;
    } rows[] = {
        {"lbf", "a force", "N"},
        {"kg*m^3/s", "a quantity in kg*m^3/s", "kg*m^3/s"},
        {"1/(m*s)", "a quantity in 1/(m*s)", "1/(m*s)"},
        {"deg", "a number", ""},
        {"kg^(1/2)*m", "a quantity in kg^(1/2)*m", "kg^(1/2)*m"},
        {"eV*s", "an angular momentum", "kg*m^2/s"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        qdot_text words = {0}, si = {0};
        qdot_unit unit;

        read_good(rows[i].unit, &unit);
        qdot_dimension_words(unit.dimension, &words);
        qdot_dimension_unit(unit.dimension, &si);
        assert_string_equal(qdot_text_str(&words), rows[i].words);
        assert_string_equal(qdot_text_str(&si), rows[i].si);
        qdot_text_clear(&words);
        qdot_text_clear(&si);
        qdot_unit_clear(&unit);
    }
}

/* A SI unit that dimension.def gives is of that dimension, and is 1. */
static void
units_of_the_table_are_coherent(void **state)
{
    static const struct {
        const char *unit;
        int exponent[QDOT_BASES];
    } rows[] = {
#define DIMENSION(words, unit, ...) {unit, {__VA_ARGS__}},
#include "units/dimension.def"
#undef DIMENSION
    };

    (void)state;
    for (size_t i = 1; i < sizeof rows / sizeof *rows; i++) {
        qdot_unit unit;

        read_good(rows[i].unit, &unit);
        assert_true(fmpq_is_one(unit.factor));
        assert_true(qdot_dimension_equal(unit.dimension, qdot_dimension_make(rows[i].exponent)));
        qdot_unit_clear(&unit);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agrees_with_gnu_units_and_udunits), cmocka_unit_test(factors_are_exact),
        cmocka_unit_test(errors_have_their_places),          cmocka_unit_test(words_and_units_of_dimensions),
        cmocka_unit_test(units_of_the_table_are_coherent),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
