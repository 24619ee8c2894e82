/* Roots where parameters have special values: conditions that hold there too, sets that are others. */
#include <setjmp.h>
#include <stdlib.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "base/text.h"
#include "normal/solve/solve-special.h"
#include "normal/solve/solve.h"

static const qdot_facts exact = {.exact = true};
static const qdot_written as_it_is = {QDOT_NIL, QDOT_NIL};

/* Equation in x with its parameters p, k, c of any sign; all that is told: roots with conditions behind "|", then sets at
 * special values. `u != 0` is a condition 0 < |u|. */
static const struct {
    const char *f, *told;
} rows[] = {
    {"k*x - p", "p/k |[abs(k) > 0]; [k = 0, p = 0]: x"},
    {"k*x^2 - p", "-sqrt(p/k) |[abs(k) > 0, k*p >= 0]; sqrt(p/k) |[abs(k) > 0, k*p >= 0]; [k = 0, p = 0]: x"},
    {"x^2 - k", "-sqrt(k) |[k >= 0]; sqrt(k) |[k >= 0]"},
    {"x^(2/3) - k", "k^(3/2) |[k >= 0]"},
    {"(k^2 - 4)*x^2 - 1", "-sqrt(1/(k^2 - 4)) |[k^2 > 4]; sqrt(1/(k^2 - 4)) |[k^2 > 4]"},
    {"x*log(k) - 1", "1/log(k) |[k > 0, abs(k - 1) > 0]"},
    {"k*x^2 + p*x", "0; -p/k |[abs(k) > 0]; [k = 0, p = 0]: x"},
};

static void
text_add_expr(qdot_text *text, const char *before, qdot_expr e)
{
    qdot_text_add(text, before);
    qdot_text_add(text, shown(e));
}

static void
roots_and_sets_at_special_values(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        qdot_expr f = text_read(pool, rows[i].f), x = text_read(pool, "x");
        qdot_solutions found;
        qdot_specials specials = {0};
        qdot_text told = {0};

        assert_int_equal(qdot_solve_inside(pool, f, x, QDOT_NIL, &exact, &found), QDOT_OK);
        assert_int_equal(qdot_solve_parameters(pool, f, x, &as_it_is, &exact, &found), QDOT_OK);
        assert_int_equal(qdot_solve_specials(pool, f, x, &as_it_is, &exact, &found, &specials), QDOT_OK);
        for (size_t k = 0; k < found.root.n; k++) {
            text_add_expr(&told, k == 0 ? "" : "; ", found.root.at[k].value);
            if (found.root.at[k].condition != QDOT_NIL)
                text_add_expr(&told, " |", found.root.at[k].condition);
        }
        for (size_t k = 0; k < specials.at.n; k++) {
            text_add_expr(&told, "; ", specials.at.at[k].where);
            for (size_t m = 0; m < specials.at.at[k].set.root.n; m++)
                text_add_expr(&told, ": ", specials.at.at[k].set.root.at[m].value);
        }
        assert_string_equal(qdot_text_str(&told), rows[i].told);
        assert_int_equal(specials.open.n, 0);
        qdot_text_clear(&told);
        qdot_specials_clear(&specials);
        qdot_solutions_clear(&found);
    }
}

/* Roots of products as they were written: what they ask for, and where the parts need not. */
static void
roots_are_asked_as_written(void **state)
{
    static const struct {
        const char *base, *f, *domain, *apart, *lifted, *not_lifted;
    } cases[] = {
        {"k*x^2", "sqrt(k)*abs(x)", "[k*x^2 >= 0]", "[k >= 0]", "0", "1"},
        {"k*(x - 1)^2", "sqrt(k)*abs(x - 1) - p*(x - 1)", "[k*(x - 1)^2 >= 0]", "[k >= 0]", "1", "p"},
        {"-x*(x - 1)^2", "sqrt(-x)*abs(x - 1)", "[-x*(x - 1)^2 >= 0]", "[-x >= 0]", "1", "2"},
        {"k*x", "sqrt(k*x)", NULL, NULL, NULL, "0"}, /* not taken apart */
        {"4*k", "2*sqrt(k)", NULL, NULL, NULL, "0"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        qdot_written w = {QDOT_NIL, QDOT_NIL};
        qdot_expr asked = QDOT_NIL, f = text_read(pool, cases[i].f), x = text_read(pool, "x");
        bool yes;

        assert_int_equal(qdot_written_add(pool, text_read(pool, cases[i].base), QDOT_HALF, &w, &asked), QDOT_OK);
        assert_int_equal(w.domain == QDOT_NIL, cases[i].domain == NULL);
        assert_int_equal(asked == QDOT_NIL, cases[i].domain != NULL);
        if (cases[i].domain != NULL) {
            assert_string_equal(shown(w.domain), cases[i].domain);
            assert_string_equal(shown(w.apart), cases[i].apart);
            assert_int_equal(qdot_written_lifts(pool, &w, f, x, text_read(pool, cases[i].lifted), &exact, &yes), QDOT_OK);
            assert_true(yes);
        }
        assert_int_equal(qdot_written_lifts(pool, &w, f, x, text_read(pool, cases[i].not_lifted), &exact, &yes), QDOT_OK);
        assert_false(yes);
    }
}

/* Roots of sums are taken apart where a factor with the unknown stands in them twice, and ask for what was not asked. */
static void
roots_of_sums_are_taken_apart(void **state)
{
    static const struct {
        const char *f, *domain, *taken, *apart;
    } cases[] = {
        {"sqrt(p*x^2 - x^4)", NULL, "abs(x)*sqrt(p - x^2)", "[p - x^2 >= 0]"},
        {"sqrt(p*x^2 + k*x^2)", NULL, "sqrt(p + k)*abs(x)", "[p + k >= 0]"},
        {"sqrt(p*x^2 + k*x^2)", "p + k", "sqrt(p + k)*abs(x)", NULL}, /* asked for anyway */
        {"sqrt(p*x^2 + k)", NULL, "sqrt(p*x^2 + k)", NULL},
        {"sqrt(p^2*k + p^2*x)", NULL, "sqrt(p^2*k + p^2*x)", NULL}, /* no factor with x stands twice */
    };

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        qdot_written w = {QDOT_NIL, QDOT_NIL};
        qdot_expr f = text_read(pool, cases[i].f);

        if (cases[i].domain != NULL)
            w.domain = qdot_conditions_and(
                pool, QDOT_NIL, qdot_condition(pool, text_read(pool, cases[i].domain), false, &exact));
        assert_int_equal(qdot_written_take_apart(pool, &f, text_read(pool, "x"), &w), QDOT_OK);
        assert_int_equal(f, text_read(pool, cases[i].taken));
        assert_int_equal(w.apart == QDOT_NIL, cases[i].apart == NULL);
        if (cases[i].apart != NULL)
            assert_string_equal(shown(w.apart), cases[i].apart);
    }
}

/* A divisor whose zeros no formula gives is told. */
static void
open_values_are_told(void **state)
{
    qdot_expr f = text_read(pool, "(p^5 - p - k^3 - k^2 - 1)*x - 1"), x = text_read(pool, "x");
    qdot_solutions found;
    qdot_specials specials = {0};

    (void)state;
    assert_int_equal(qdot_solve_inside(pool, f, x, QDOT_NIL, &exact, &found), QDOT_OK);
    assert_int_equal(qdot_solve_specials(pool, f, x, &as_it_is, &exact, &found, &specials), QDOT_OK);
    assert_int_equal(specials.at.n, 0);
    assert_int_equal(specials.open.n, 1);
    qdot_specials_clear(&specials);
    qdot_solutions_clear(&found);
}

/* What follows from the others is left out; a <= b beside a != b is a < b. */
static void
sets_are_reduced(void **state)
{
    static const struct {
        const char *set[3], *reduced;
    } sets[] = {
        {{"p - 1", "p - 2", "p + 5"}, "[p > 2]"},
        {{"p", "p - k", "k - 3"}, "[k < p, k > 3]"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        qdot_text text = {0};
        qdot_expr set = QDOT_NIL;

        for (size_t k = 0; k < 3; k++)
            set = qdot_conditions_and(
                pool, set, qdot_condition(pool, text_read(pool, sets[i].set[k]), true, &exact));
        text_add_expr(&text, "", qdot_conditions_reduce(pool, set, &exact));
        assert_string_equal(qdot_text_str(&text), sets[i].reduced);
        qdot_text_clear(&text);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(roots_and_sets_at_special_values, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(roots_are_asked_as_written, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(roots_of_sums_are_taken_apart, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(open_values_are_told, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(sets_are_reduced, open_pool, close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
