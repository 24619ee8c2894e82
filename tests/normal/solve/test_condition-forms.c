/* Gaps of conditions with magnitudes and roots, as simpler ones. */
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "normal/solve/condition-forms.h"
#include "normal/solve/conditions.h"

static void
zero_in_whole_regions(void **state)
{
    static const struct {
        const char *e;
        bool yes;
    } rows[] = {
        {"abs(p) - p", true},      {"1 - p - abs(p - 1)", true},  {"max(p, k) - k", true},
        {"min(p, k) - p", true},   {"sign(p) + 1", true},         {"abs(abs(p) - 1) + p - 1", true},
        {"p - k", false},          {"abs(p) - k", false},         {"abs(p) - 2*p", false},
        {"max(p, k) - c", false},  {"p - p^2", false},            {"abs(p)/p", false},
    };

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (qdot_vanishes_in_regions(pool, text_read(pool, rows[i].e)) != rows[i].yes)
            fail_msg("%s", rows[i].e);
}

static void
magnitude_beside_its_argument(void **state)
{
    static const struct {
        const char *gap, *strict, *weak;
    } rows[] = {
        {"1 - p - abs(p - 1)", "-1", "1 - p"}, {"p - abs(p)", "-1", "p"}, {"p + abs(p)", "p", "1"},
        {"3*abs(p - k) - 3*p + 3*k", "k - p", "1"}, {"p - 2*abs(p)", "nil", "nil"}, {"p - k", "nil", "nil"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        qdot_expr gap = text_read(pool, rows[i].gap);

        assert_string_equal(shown(qdot_condition_without_magnitude(pool, gap, true)), rows[i].strict);
        assert_string_equal(shown(qdot_condition_without_magnitude(pool, gap, false)), rows[i].weak);
    }
}

/* p, k of any sign; p^2 + 1 and numbers are known to be positive. */
static void
logarithms_by_their_arguments(void **state)
{
    static const struct {
        const char *gap, *by;
    } rows[] = {
        {"log(p) + log(2)", "2*p - 1"},
        {"log(p) - log(k^2 + 1)", "p - k^2 - 1"},
        {"3*log(p) - 3*log(k^2 + 1) - 6", "p - (k^2 + 1)*exp(2)"},
        {"log(p) - log(k)", "nil"},      /* k < 0: neither is defined, p - k may be positive */
        {"log(p) + log(k)", "nil"},      /* both negative: p k - 1 may be positive */
        {"2*log(p) - log(k^2 + 1)", "nil"},
        {"log(p) - k", "nil"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        assert_string_equal(shown(qdot_condition_of_logarithms(pool, text_read(pool, rows[i].gap))), rows[i].by);
}

/* 0 < gap and 0 <= gap for all values of p, k. */
static void
conditions_of_such_gaps(void **state)
{
    static const struct {
        const char *gap, *strict, *weak;
    } rows[] = {
        {"1 - sqrt(p^2 + k^2)", "p^2 + k^2 < 1", "p^2 + k^2 <= 1"},
        {"2*abs(k) - abs(p)", "abs(p) < 2*abs(k)", "abs(p) <= 2*abs(k)"},
        {"2 - sqrt(p)", "sqrt(p) < 2", "sqrt(p) <= 2"}, /* p < 2 says less */
        {"-1 - sqrt(p)", "false", "false"},
        {"p*abs(p)", "p > 0", "p >= 0"},
        {"p - abs(p)", "false", "p >= 0"},
    };
    const qdot_facts exact = {.exact = true};

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        qdot_expr gap = text_read(pool, rows[i].gap);
        char strict[80];

        snprintf(strict, sizeof strict, "%s", shown(qdot_condition(pool, gap, true, &exact)));
        assert_string_equal(strict, rows[i].strict);
        assert_string_equal(shown(qdot_condition(pool, gap, false, &exact)), rows[i].weak);
    }
}

/* b^2 > a^2 and sqrt(b^2 - a^2) > |b| do not hold together. */
static void
contradiction_behind_roots(void **state)
{
    qdot_expr known = text_read(pool, "k^2 - p^2"), gap = text_read(pool, "sqrt(k^2 - p^2) - abs(k)"), set;
    const qdot_facts facts = {0};

    (void)state;
    set = qdot_conditions_and(pool, QDOT_NIL, qdot_rel(pool, QDOT_LT, QDOT_ZERO, known));
    set = qdot_conditions_and(pool, set, qdot_rel(pool, QDOT_LT, QDOT_ZERO, gap));
    assert_int_equal(qdot_conditions_at(pool, set, 0, NULL, NULL, &facts), QDOT_FALSE);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(zero_in_whole_regions, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(magnitude_beside_its_argument, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(logarithms_by_their_arguments, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(conditions_of_such_gaps, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(contradiction_behind_roots, open_pool, close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
