/* test_loop.c -- loop integrals between branch points: each against its number. */
#include <math.h>
#include <setjmp.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/exact.h"
#include "expr/integral.h"
#include "normal/integral/loop.h"
#include "num/integer.h"

typedef struct {
    const char *f, *lo, *hi;
} known_loop;

/* By residues, over x, x^2, exp, cos, sin, tan, tanh, sinh; of first and higher poles, real and complex. */
static const known_loop elementary[] = {
    {"3 - 2*x^2 + x", "-1", "3/2"},
    {"-2 + 6/x - 3/x^2", "3/2 - sqrt(3)/2", "3/2 + sqrt(3)/2"},
    {"(2 - x)*(x - 1)/x^4", "1", "2"},
    {"(2 - x)*(x - 1)/(x + 1)^2/(3 - x)^2", "1", "2"},
    {"(1 - x^2)/(1 + x^2)^2", "-1", "1"},
    {"(1 - x^2)*(x + 2)^2", "-1", "1"},
    {"5 - x^2 - 4/x^2", "1", "2"},
    {"1 - 4*(1 - exp(-x))^2", "-log(3/2)", "log(2)"},
    {"3 - 1/sin(x)^2", "asin(1/sqrt(3))", "pi - asin(1/sqrt(3))"},
    {"3 - 2*tan(x)^2", "-atan(sqrt(3/2))", "atan(sqrt(3/2))"},
    {"1 - 2*tanh(x)^2", "-atanh(1/sqrt(2))", "atanh(1/sqrt(2))"},
    {"3/cosh(x)^2 - 1", "-acosh(sqrt(3))", "acosh(sqrt(3))"},
};

static const known_loop elliptic[] = {
    {"2 - x^4", "-2^(1/4)", "2^(1/4)"},
    {"(4 - x^2)*(x^2 + 3)", "-2", "2"},
    {"(4 - x^2)*(x^2 - 1)", "1", "2"},
    {"(1 - x^2)*(4 - x^2)", "-1", "1"},
    {"1 + 3*cos(x)", "-acos(-1/3)", "acos(-1/3)"},
};

/* 2 int sqrt(f) as x runs over (a + b)/2 + (b - a)/2 sin(v): smooth at the ends, by Simpson's rule. */
static double
number_of(const known_loop *k)
{
    enum { STEPS = 2000 };
    const qdot_expr f = text_read(pool, k->f), x = text_read(pool, "x");
    double a, b, sum = 0;

    assert_int_equal(qdot_constant_double(pool, text_read(pool, k->lo), &a), QDOT_OK);
    assert_int_equal(qdot_constant_double(pool, text_read(pool, k->hi), &b), QDOT_OK);
    for (int i = 1; i < STEPS; i++) {
        const double v = M_PI*((double)i/STEPS - 0.5), at = (a + b)/2 + (b - a)/2*sin(v);
        fmpq_t q;
        double y;
        qdot_expr there;

        fmpq_init(q);
        qdot_rational_set_integers(q, llround(at*1e15), 1000000000000000);
        there = qdot_subs(pool, f, 1, &x, (qdot_expr[]){qdot_expr_fmpq(pool, q)});
        fmpq_clear(q);
        assert_int_equal(qdot_constant_double(pool, there, &y), QDOT_OK);
        sum += (i % 2 == 0 ? 2 : 4)*sqrt(fmax(y, 0))*cos(v);
    }
    return 2*sum*(b - a)/2*M_PI/STEPS/3;
}

static void
check_loops(size_t n, const known_loop *list)
{
    for (size_t i = 0; i < n; i++) {
        const qdot_expr x = text_read(pool, "x");
        const qdot_expr value = qdot_loop(pool, text_read(pool, list[i].f), x, text_read(pool, list[i].lo), text_read(pool, list[i].hi), NULL);
        double is;

        if (value == QDOT_NIL)
            fail_msg("%s: not found", list[i].f);
        assert_int_equal(qdot_constant_double(pool, value, &is), QDOT_OK);
        if (fabs(is - number_of(&list[i])) > 1e-6)
            fail_msg("%s: %s = %.12g, not %.12g", list[i].f, shown(value), is, number_of(&list[i]));
    }
}

static void
residues_are_right(void **state)
{
    (void)state;
    check_loops(sizeof elementary / sizeof *elementary, elementary);
}

static void
elliptic_integrals_are_right(void **state)
{
    (void)state;
    check_loops(sizeof elliptic / sizeof *elliptic, elliptic);
}

/* A cubic under the root needs roots that no formula here gives. */
static void
others_are_nil(void **state)
{
    (void)state;
    assert_int_equal(qdot_loop(pool, text_read(pool, "(1 - x)*(x - 2)*(x - 3)*(x - 5)*(x - 4)"), text_read(pool, "x"), text_read(pool, "2"),
                               text_read(pool, "3"), NULL),
                     QDOT_NIL);
    assert_int_equal(qdot_pool_check(pool), QDOT_OK);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(residues_are_right, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(elliptic_integrals_are_right, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(others_are_nil, open_pool, close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
