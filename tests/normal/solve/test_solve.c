/* Solving: against roots known beforehand, by putting them back, and in numbers. */
#include <setjmp.h>
#include <math.h>
#include <string.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/rationalize.h"
#include "normal/solve/null-space.h"
#include "normal/solve/solve.h"

/* Equation, unknown, roots in order with their conditions behind "|". */
static const struct {
    const char *f, *x, *roots;
} rows[] = {
    {"3*x + 7", "x", "-7/3"},
    {"m*x - g", "x", "g/m"},
    {"x^2 - 2", "x", "-sqrt(2); sqrt(2)"},
    {"x^2 + 2", "x", ""},
    {"r^2 - 2", "r", "sqrt(2)"},
    {"x^3 - 8", "x", "2"},
    {"x^3 + 8", "x", "-2"},
    {"(x - 1)^2*(x + 3)", "x", "-3; 1"},
    {"x^2 - k", "x", "-sqrt(k) |[k > 0]; sqrt(k) |[k > 0]"},
    {"sin(phi)", "phi", "0; pi"},
    {"sin(theta)*cos(theta)", "theta", "1/2*pi"},
    {"2*cos(phi) - 1", "phi", "-1/3*pi; 1/3*pi"},
    {"cos(phi) - 2", "phi", ""},
    {"sin(2*phi) - 1", "phi", "-3/4*pi; 1/4*pi"},
    {"m*g*sin(phi) + a*cos(phi)", "phi", NULL},
    {"sin(phi) + cos(phi) - 1", "phi", NULL},
    {"cos(2*phi) + sin(phi)", "phi", NULL},
    {"a*cos(phi) + b*sin(phi) - g", "phi", NULL},
    {"x*(1 - L/sqrt(x^2 + a^2))", "x", NULL},
    {"sqrt(x + 2) - x", "x", "2"},
    {"(x^2 + k)^(-3/2) - 8", "x", "-1/2*sqrt(1 - 4*k) |[4*k < 1]; 1/2*sqrt(1 - 4*k) |[4*k < 1]"},
    {"(x + k)^(3/2) - c", "x", "c^(2/3) - k |[c >= 0]"},
    {"sqrt(x) + x", "x", "0"},
    {"exp(2*x) - 3*exp(x) + 2", "x", "0; log(2)"},
    {"cosh(x) - 2", "x", "-acosh(2); acosh(2)"},
    {"abs(x) - 3", "x", "-3; 3"},
    {"log(x) - 1", "x", "exp(1)"},
    {"(x^2 - 1)/(x - 1)", "x", "-1"},
    {"x^4 - 5*x^2 + 6", "x", NULL},
};

/* Every root put back gives zero, and as many come out as are written. */
static void
roots_satisfy_their_equation(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        qdot_expr f = text_read(pool, rows[i].f), x = text_read(pool, rows[i].x);
        qdot_text all = {0};
        qdot_solutions found;
        const qdot_root *roots;
        size_t n;

        assert_int_equal(qdot_solve_inside(pool, f, x, QDOT_NIL, NULL, &found), QDOT_OK);
        if (!found.complete)
            fail_msg("%s: not complete", rows[i].f);
        roots = found.root.at;
        n = found.root.n;
        for (size_t k = 0; k < n; k++) {
            qdot_expr at = qdot_subs(pool, f, 1, &x, &roots[k].value);
            qdot_decision d;

            assert_int_equal(qdot_pool_check(pool), QDOT_OK);
            assert_int_equal(qdot_decide_equal(pool, at, QDOT_ZERO, NULL, &d), QDOT_OK);
            if (d.verdict == QDOT_REFUTED)
                fail_msg("%s: %s", rows[i].f, shown(roots[k].value));
            qdot_text_format(&all, "%s%s", k > 0 ? "; " : "", shown(roots[k].value));
            if (roots[k].condition != QDOT_NIL)
                qdot_text_format(&all, " |%s", shown(roots[k].condition));
        }
        if (rows[i].roots != NULL && strcmp(rows[i].roots, qdot_text_str(&all)) != 0)
            fail_msg("%s: %s, not %s", rows[i].f, qdot_text_str(&all), rows[i].roots);
        if (rows[i].roots == NULL && n < 2)
            fail_msg("%s: only %s", rows[i].f, qdot_text_str(&all));
        qdot_text_clear(&all);
        qdot_solutions_clear(&found);
    }
}

static void
what_is_beyond_it_is_said(void **state)
{
    static const char *const beyond[] = {"x^5 - x + 1", "x - cos(x)", "x^3 + x + k"};

    (void)state;
    for (size_t i = 0; i < sizeof beyond / sizeof *beyond; i++) {
        qdot_solutions found;

        assert_int_equal(
            qdot_solve(pool, text_read(pool, beyond[i]), text_read(pool, "x"), NULL, &found),
            QDOT_OK);
        assert_false(found.complete);
        qdot_solutions_clear(&found);
    }
}

static void
an_identity_is_no_equation(void **state)
{
    qdot_solutions found;

    (void)state;
    assert_int_equal(qdot_solve(pool, text_read(pool, "(x + 1)^2 - x^2 - 2*x - 1"),
                                text_read(pool, "x"), NULL, &found),
                     QDOT_EDOMAIN);
    qdot_solutions_clear(&found);
}

/* --- sets of roots ---------------------------------------------------------------------- */

/* A symbol of its own with a domain: lo < it < hi, nil: no end. */
static qdot_expr
coordinate(const char *name, qdot_expr lo, qdot_expr hi)
{
    qdot_expr x = qdot_symbol_get(pool, QDOT_COORD, name);

    qdot_symbol_domain(pool, x, lo, true, hi, true);
    return x;
}

/* The roots in order, `; ` between them, each with its conditions behind `|`. */
static const char *
listed(qdot_expr f, qdot_expr x)
{
    static qdot_text all;
    qdot_solutions found;

    qdot_text_clear(&all);
    assert_int_equal(qdot_solve_inside(pool, f, x, QDOT_NIL, NULL, &found), QDOT_OK);
    for (size_t k = 0; k < found.root.n; k++) {
        qdot_text_format(&all, "%s%s", k > 0 ? "; " : "", shown(found.root.at[k].value));
        if (found.root.at[k].condition != QDOT_NIL)
            qdot_text_format(&all, " |%s", shown(found.root.at[k].condition));
    }
    if (!found.complete)
        qdot_text_add(&all, " ...");
    qdot_solutions_clear(&found);
    return qdot_text_str(&all);
}

/* An angle beyond one turn, ends that are no fractions, a period that is no turn, a root that is a parameter. */
static void
roots_lie_in_the_declared_domain(void **state)
{
    qdot_expr turn = qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI),
              five = qdot_expr_int(pool, 5), a = text_read(pool, "a"),
              u = coordinate("u", QDOT_ZERO, turn), v = coordinate("v", QDOT_ZERO, five),
              w = coordinate("w", QDOT_ZERO, QDOT_ONE),
              z = coordinate("z", qdot_expr_int(pool, 10), QDOT_NIL),
              q = qdot_symbol_get(pool, QDOT_COORD, "q");
    qdot_expr sine = qdot_fun1(pool, QDOT_SIN, u), half = QDOT_HALF;

    (void)state;
    assert_string_equal(listed(qdot_add(pool, sine, half), u), "7/6*pi; 11/6*pi");
    assert_string_equal(listed(qdot_sub(pool, u, qdot_expr_int(pool, 7)), u), "");
    assert_string_equal(listed(qdot_sub(pool, u, qdot_expr_int(pool, 6)), u), "6");
    assert_string_equal(
        listed(qdot_fun1(pool, QDOT_COS, qdot_mul(pool, QDOT_PI, v)), v),
        "1/2; 3/2; 5/2; 7/2; 9/2");
    assert_string_equal(listed(qdot_sub(pool, w, qdot_fun1(pool, QDOT_ATAN, a)), w),
                        "atan(a) |[a < tan(1)]"); /* a > 0 in text.h */
    assert_string_equal(listed(qdot_sub(pool, qdot_fun1(pool, QDOT_SIN, z), half), z),
                        "25/6*pi; 29/6*pi");
    assert_string_equal(listed(qdot_fun1(pool, QDOT_COS, qdot_mul(pool, half, q)), q),
                        "4*pi*n - pi; 4*pi*n + pi");
}

static void
roots_are_real_or_say_when(void **state)
{
    static const char *const row[][2] = {
        {"x^3 - k", "abs(k)^(1/3)*sign(k)"},
        {"x^(2/3) - k", "k^(3/2) |[k >= 0]"},
        {"exp(x) - k*exp(-x)", "1/2*log(k) |[k > 0]"},
        {"abs(x) - k", "k |[k >= 0]; -k |[k >= 0]"},
        {"abs(x) - x", "x |[x >= 0]"},
        {"abs(x - 1) + abs(x + 1) - 2", "x |[x <= 1, x >= -1]"},
        {"sign(x) - 1", "x |[x > 0]"},
        {"log(x) + log(x - k)", NULL},
        {"max(x, 1) - 1", "x |[x <= 1]"},
        {"sinh(x) + 2*cosh(x) - 2", "-log(3); 0"},
        {"sqrt(x + 1) + x", "1/2*(1 - sqrt(5))"},
        {"tanh(x) - 2", ""},
        {"atan(x) - 2", ""},
        /* a root whatever a is, and one by its half angle */
        {"a*sin(x) + cos(x) - 1", "0; 2*atan(a)"},
        {"a*sin(x) - cos(x) - 1", "pi; pi - 2*atan(a)"},
        {"k*sin(x) + c*cos(x) + k", "-1/2*pi; 2*atan2(-c, k) - 1/2*pi"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof row / sizeof *row; i++)
        if (row[i][1] != NULL)
            assert_string_equal(listed(text_read(pool, row[i][0]), text_read(pool, "x")),
                                row[i][1]);
}

/* What stood in the equation before it was simplified: it must be defined, and no divisor 0. */
static void
roots_lie_where_all_is_defined(void **state)
{
    static const struct {
        const char *f, *also, *roots;
    } row[] = {
        {"x - k", "asin(x)", "k |[k + 1 >= 0, k <= 1]"},
        {"x - k", "sqrt(x)", "k |[k >= 0]"},
        {"x - k", "log(x)", "k |[k > 0]"},
        {"x", "x^(-1/3)", ""},
        {"x*(x - 1)", "1/x", "1"},
        {"x - pi/2", "tan(x)", ""},
        {"x - k", "exp(x)", "k"},
        {"0", "1/x", "x |[abs(x) > 0]"},
        {"0", "log(x)", "x |[x > 0]"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        qdot_expr x = text_read(pool, "x"), also = text_read(pool, row[i].also), domain;
        qdot_text all = {0};
        qdot_solutions found;

        domain = qdot_conditions_all(pool, qdot_conditions_of_domain(pool, also, x),
                                     qdot_conditions_of_divisors(pool, also, x));
        if (domain == QDOT_NIL)
            domain = qdot_list(pool, 0, NULL);
        assert_int_equal(
            qdot_solve_inside(pool, text_read(pool, row[i].f), x, domain, NULL, &found), QDOT_OK);
        assert_true(found.complete);
        for (size_t k = 0; k < found.root.n; k++) {
            qdot_text_format(&all, "%s%s", k > 0 ? "; " : "", shown(found.root.at[k].value));
            if (found.root.at[k].condition != QDOT_NIL)
                qdot_text_format(&all, " |%s", shown(found.root.at[k].condition));
        }
        if (strcmp(qdot_text_str(&all), row[i].roots) != 0)
            fail_msg("%s beside %s: %s, not %s", row[i].f, row[i].also, qdot_text_str(&all),
                     row[i].roots);
        qdot_text_clear(&all);
        qdot_solutions_clear(&found);
    }
}

/* Divisors and factors of parameters alone: where one is 0 the set may be another. */
static void
special_parameters_are_listed(void **state)
{
    static const char *const row[][2] = {
        {"k*x - 1", "k"},
        {"k*x^2 + x - 1", "k"},
        {"k*(x - 1)", "k"},
        {"sin(k*x)", "k"},
        {"(k - 1)*x - 2", "k - 1"},
        {"x^2 - k", ""},
        {"m*x - k", ""}, /* m > 0 in text.h */
    };

    (void)state;
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        qdot_solutions found;

        assert_int_equal(
            qdot_solve(pool, text_read(pool, row[i][0]), text_read(pool, "x"), NULL, &found),
            QDOT_OK);
        if (found.special.n != (row[i][1][0] != '\0'))
            fail_msg("%s: %zu special values", row[i][0], found.special.n);
        if (found.special.n > 0)
            assert_string_equal(shown(found.special.at[0]), row[i][1]);
        qdot_solutions_clear(&found);
    }
}

/* Factors that no formula solves. */
static void
unsolved_factors_are_listed(void **state)
{
    static const struct {
        const char *f, *list;
        bool all;
    } row[] = {
        {"x^5 - x + 1", "[x^5 - x + 1]", true},
        {"(x^5 - x + 1)*(x - k)", "[x^5 - x + 1]", false},
        {"sin(x)*(x - 1)", "[]", false},
    };

    (void)state;
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        qdot_expr list;
        bool all;

        assert_int_equal(qdot_solve_unsolved(pool, text_read(pool, row[i].f),
                                             text_read(pool, "x"), NULL, &list, &all),
                         QDOT_OK);
        assert_string_equal(shown(list), row[i].list);
        assert_int_equal(all, row[i].all);
    }
}

/* Whole turns of an integer are left out of circular functions, and of nothing else. */
static void
whole_turns_are_left_out(void **state)
{
    qdot_expr n = qdot_solve_integer(pool, 0), n1 = qdot_solve_integer(pool, 1),
              from[2] = {text_read(pool, "x"), text_read(pool, "u")},
              turn = qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI), to[2];
    static const char *const row[][2] = {
        {"sin(x)", "sin(k)"},
        {"cos(3*x - u)", "cos(3*k)"},
        {"cos(x/2)", "cos(1/2*(k + 2*pi*n))"},
    };

    (void)state;
    assert_int_equal(qdot_solve_integers(pool, n1), 2);
    to[0] = qdot_add(pool, text_read(pool, "k"), qdot_mul(pool, turn, n));
    to[1] = qdot_mul(pool, turn, n1);
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        qdot_expr e = qdot_subs(pool, text_read(pool, row[i][0]), 2, from, to);

        assert_string_equal(shown(qdot_solve_without_turns(pool, e)), row[i][1]);
    }
    assert_int_equal(qdot_solve_one_member(pool, to[0]), text_read(pool, "k"));
}

/* A divisor that holds another unknown: where it is 0 the roots are others. */
static void
divisors_are_listed(void **state)
{
    qdot_solutions found;

    (void)state;
    assert_int_equal(qdot_solve(pool, text_read(pool, "x*y + sin(phi)"), text_read(pool, "x"),
                                NULL, &found),
                     QDOT_OK);
    assert_int_equal(found.divisor.n, 1);
    assert_string_equal(shown(found.divisor.at[0]), "y");
    qdot_solutions_clear(&found);
}

static void
products_are_irreducible(void **state)
{
    (void)state;
    assert_string_equal(shown(qdot_solve_product(pool, text_read(pool, "x^4 - 16"))),
                        "(x - 2)*(x + 2)*(x^2 + 4)");
    assert_string_equal(
        shown(qdot_solve_product(pool, text_read(pool, "(6*x^2 - 6)/(x^2 + 3*x + 2)"))),
        "6*(x - 1)/(x + 2)");
}

static void
conditions_are_short(void **state)
{
    static const struct {
        const char *e, *says;
    } row[] = {
        {"m*L*(g - L*k^2)", "L*k^2 < g"},
        {"(g - a)*(g + a)/b", "a < g"},
        {"(k - 1)^2*(a - b)", "b < a"},
        {"m + a", "true"},
        {"-m*a", "false"},
        {"2 - sqrt(2)", "true"},
        {"0", "false"},
        {"-k", "k < 0"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof row / sizeof *row; i++)
        assert_string_equal(
            shown(qdot_positive(pool, text_read(pool, row[i].e), NULL, 0, NULL)),
            row[i].says);
}

static void
what_is_known_is_left_out(void **state)
{
    qdot_expr known = text_read(pool, "a - b");

    (void)state;
    assert_int_equal(
        qdot_positive(pool, text_read(pool, "m*(a^2 - b^2)"), NULL, 1, &known),
        QDOT_TRUE);
    assert_int_equal(qdot_positive(pool, text_read(pool, "m*(b - a)"), NULL, 1, &known),
                     QDOT_FALSE);
}

static void
denominators_are_rational(void **state)
{
    static const char *const row[][2] = {
        {"2*(sqrt(2) - 1)/(2 - sqrt(2))", "sqrt(2)"},
        {"1/(sqrt(3) - sqrt(2))", "sqrt(2) + sqrt(3)"},
        {"1/(1 + x)", "1/(x + 1)"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        qdot_expr e = text_read(pool, row[i][0]), got = qdot_rationalize(pool, e, NULL);

        assert_true(qdot_is_zero(pool, qdot_sub(pool, e, got), NULL));
        assert_true(
            qdot_is_zero(pool, qdot_sub(pool, text_read(pool, row[i][1]), got), NULL));
        assert_true(qdot_expr_size(pool, got) <=
                    qdot_expr_size(pool, text_read(pool, row[i][1])));
    }
}

/* c1 sin^2 + c2 cos^2 + c3 + c4 x a + c5 x b = 0: (1, 1, -1, 0, 0) and b against a. */
static void
relations_have_parameters_in_them(void **state)
{
    static const char *const columns[] = {"x*a", "x*b", "sin(phi)^2", "cos(phi)^2", "1"};
    qdot_expr E[5], *basis;
    size_t m;

    (void)state;
    for (size_t j = 0; j < 5; j++)
        E[j] = text_read(pool, columns[j]);
    assert_int_equal(qdot_null_space(pool, 1, 5, E, &basis, &m), QDOT_OK);
    assert_int_equal(m, 2);
    assert_string_equal(shown(basis[0]), "-b/a");
    assert_string_equal(shown(basis[1]), "1");
    assert_string_equal(shown(basis[5 + 2]), "-1");
    assert_string_equal(shown(basis[5 + 3]), "-1");
    assert_string_equal(shown(basis[5 + 4]), "1");
    for (size_t k = 0; k < m; k++) { /* and the other way round */
        qdot_expr sum = QDOT_ZERO;

        for (size_t j = 0; j < 5; j++)
            sum = qdot_add(pool, sum, qdot_mul(pool, basis[5 * k + j], E[j]));
        assert_true(qdot_is_zero(pool, sum, NULL));
    }
    qdot_free(basis);
}

static void
denominators_do_not_matter(void **state)
{
    static const char *const columns[] = {"1/(x + a)", "1/(x - a)", "x/(x^2 - a^2)"};
    qdot_expr E[3], *basis;
    size_t m;

    (void)state;
    for (size_t j = 0; j < 3; j++)
        E[j] = text_read(pool, columns[j]);
    assert_int_equal(qdot_null_space(pool, 1, 3, E, &basis, &m), QDOT_OK);
    assert_int_equal(m, 1);
    assert_string_equal(shown(basis[0]), "-1/2");
    assert_string_equal(shown(basis[1]), "-1/2");
    qdot_free(basis);
}

/* f, the ends of the window, whether it is open below; the roots with their conditions behind "|", "?": not all. */
static const struct {
    const char *f, *lo, *hi;
    bool open;
    const char *roots;
} ranges[] = {
    {"max(x, 0)", "-1", "1", false, "x |[x >= -1, x <= 0]"},
    {"max(x, 0)", "0", "1", false, "0"},
    {"max(x, 0)", "0", "1", true, ""},
    {"max(x, 0)", "1", "2", false, ""},
    {"abs(x) + abs(x - 1) - 1", "0", "2", true, "x |[x > 0, x <= 1]"},
    {"floor(x) - 1", "0", "3", false, "x |[x >= 1, x < 2]"},
    {"max(x, 0)*(x - 3)", "-1", "4", false, "3; x |[x >= -1, x <= 0]"},
    {"max(sin(x), 0)", "-4", "4", false, "x |[sin(x) <= 0, x >= -4, x <= 4]"},
    {"max(x, 0)*(exp(x) - 3*x)", "-1", "4", false, "x |[x >= -1, x <= 0]?"},
    {"abs(x) - 1", "-3", "3", false, "?"},
    {"x^2 - 1", "-3", "3", false, "?"},
};

/* Ranges of x that solve an equation have the ends that they must have, and points in them are not listed. */
static void
ranges_of_roots_have_exact_ends(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        qdot_expr f = text_read(pool, ranges[i].f), x = text_read(pool, "x");
        const qdot_window window = {.lo = text_read(pool, ranges[i].lo),
                                    .hi = text_read(pool, ranges[i].hi),
                                    .lo_open = ranges[i].open};
        qdot_solutions found;
        qdot_text all = {0};

        assert_int_equal(qdot_solve_ranges(pool, f, x, QDOT_NIL, &window, &found), QDOT_OK);
        for (size_t k = 0; k < found.root.n; k++) {
            qdot_text_add(&all, k > 0 ? "; " : "");
            qdot_text_add(&all, shown(found.root.at[k].value));
            if (found.root.at[k].condition != QDOT_NIL) {
                qdot_text_add(&all, " |");
                qdot_text_add(&all, shown(found.root.at[k].condition));
            }
        }
        qdot_text_add(&all, found.complete ? "" : "?");
        if (strcmp(qdot_text_str(&all), ranges[i].roots) != 0)
            fail_msg("%s: %s, expected %s", ranges[i].f, qdot_text_str(&all), ranges[i].roots);
        qdot_text_clear(&all);
        qdot_solutions_clear(&found);
    }
}

/* Of a family whose value lies between bounds for all parameters only members that can lie inside are listed. */
static void
families_are_bounded_by_intervals(void **state)
{
    const qdot_window window = {.lo = QDOT_ZERO, .hi = text_read(pool, "8")};
    const qdot_root family = {text_read(pool, "acos(c)"), QDOT_NIL, text_read(pool, "2*pi"), QDOT_NIL},
                    free = {text_read(pool, "c"), QDOT_NIL, text_read(pool, "2*pi"), QDOT_NIL};
    qdot_solutions found = {.complete = true};
    qdot_expr x = text_read(pool, "x");

    (void)state;
    assert_int_equal(qdot_solve_members(pool, x, &family, &window, NULL, &found), QDOT_OK);
    assert_int_equal(found.root.n, 2); /* acos c, and acos c + 2 pi where it is below 8 */
    assert_true(found.complete);
    assert_ptr_equal((void *)(uintptr_t)found.root.at[0].condition, (void *)(uintptr_t)QDOT_NIL);
    assert_true(found.root.at[1].condition != QDOT_NIL);
    qdot_solutions_clear(&found);
    found.complete = true;
    assert_int_equal(qdot_solve_members(pool, x, &free, &window, NULL, &found), QDOT_OK);
    assert_int_equal(found.root.n, 1); /* c has no bounds: the family with both ends as conditions */
    assert_string_equal(shown(found.root.at[0].value), "c + 2*pi*n");
    assert_string_equal(shown(found.root.at[0].condition), "[c + 2*pi*n >= 0, c + 2*pi*n <= 8]");
    assert_true(found.complete);
    qdot_solutions_clear(&found);
}

/* A family of constants between ends that are parameters is not followed member by member. */
static void
families_with_ends_that_are_parameters(void **state)
{
    const qdot_root family = {text_read(pool, "pi/2"), QDOT_NIL, text_read(pool, "2*pi"), QDOT_NIL};
    qdot_solutions found = {.complete = true};
    qdot_expr x = text_read(pool, "x"), a = text_read(pool, "a");
    qdot_window window = {.lo = QDOT_ZERO, .hi = a};

    (void)state;
    assert_int_equal(qdot_solve_members(pool, x, &family, &window, NULL, &found), QDOT_OK);
    assert_int_equal(found.root.n, 1);
    assert_true(found.complete);
    assert_true(qdot_expr_contains(pool, found.root.at[0].value, qdot_solve_integer(pool, 0)));
    qdot_solutions_clear(&found);
    found.complete = true;
    qdot_symbol_domain(pool, x, QDOT_NIL, false, a, true);
    window = qdot_solve_window(pool, x, true);
    assert_true(window.recurs);
    assert_int_equal(qdot_solve_members(pool, x, &family, &window, NULL, &found), QDOT_OK);
    assert_int_equal(found.root.n, 1); /* below a, not of one turn below it */
    assert_int_equal(qdot_expr_count(pool, found.root.at[0].condition), 1);
    assert_false(found.recurs);
    qdot_solutions_clear(&found);
}

/* Of an angle the members of one turn are listed if they are few; else they are the family, however many. */
static void
families_of_short_periods(void **state)
{
    static const struct {
        const char *period;
        size_t n;
    } of[] = {{"pi/2", 4}, {"pi/500", 1000}, {"pi/501", 1}, {"pi/10^20", 1}, {"pi/10^400", 1}};
    qdot_expr x = text_read(pool, "phi"), c = text_read(pool, "c");
    const qdot_window turn = qdot_solve_window(pool, x, true);

    (void)state;
    assert_true(turn.turn);
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        const qdot_root family = {c, QDOT_NIL, text_read(pool, of[i].period), QDOT_NIL};
        qdot_solutions found = {.complete = true};

        assert_int_equal(qdot_solve_members(pool, x, &family, &turn, NULL, &found), QDOT_OK);
        assert_int_equal(found.root.n, of[i].n);
        assert_int_equal(qdot_solve_integers(pool, found.root.at[0].value), of[i].n == 1);
        qdot_solutions_clear(&found);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(families_of_short_periods, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(roots_satisfy_their_equation, open_pool,
                                        close_pool),
        cmocka_unit_test_setup_teardown(what_is_beyond_it_is_said, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(an_identity_is_no_equation, open_pool,
                                        close_pool),
        cmocka_unit_test_setup_teardown(roots_lie_in_the_declared_domain, open_pool,
                                        close_pool),
        cmocka_unit_test_setup_teardown(roots_are_real_or_say_when, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(divisors_are_listed, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(whole_turns_are_left_out, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(ranges_of_roots_have_exact_ends, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(families_are_bounded_by_intervals, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(families_with_ends_that_are_parameters, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(roots_lie_where_all_is_defined, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(special_parameters_are_listed, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(unsolved_factors_are_listed, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(products_are_irreducible, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(conditions_are_short, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(what_is_known_is_left_out, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(denominators_are_rational, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(relations_have_parameters_in_them, open_pool,
                                        close_pool),
        cmocka_unit_test_setup_teardown(denominators_do_not_matter, open_pool,
                                        close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
