/* test_simplify.c -- textbook forms, and values that simplifying must not change. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

#include "expr/calculus.h"
#include "expr/walk.h"

#include "normal/field/normal-form.h"
#include "normal/form/shortest.h"
#include "normal/form/simple.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/linear.h"
#include "normal/text.h"

static const struct {
    const char *from, *to;
} forms[] = {
    /* kinetic energies */
    {"1/2*m*((r'*cos(phi) - r*sin(phi)*phi')^2 + (r'*sin(phi) + r*cos(phi)*phi')^2)",
     "1/2*m*(r'^2 + r^2*phi'^2)"},
    {"1/2*m1*((L1*cos(theta1)*theta1')^2 + (L1*sin(theta1)*theta1')^2)"
     " + 1/2*m2*((L1*cos(theta1)*theta1' + L2*cos(theta2)*theta2')^2"
     " + (L1*sin(theta1)*theta1' + L2*sin(theta2)*theta2')^2)",
     "1/2*(m1 + m2)*L1^2*theta1'^2 + 1/2*m2*L2^2*theta2'^2"
     " + m2*L1*L2*cos(theta1 - theta2)*theta1'*theta2'"},
    {"(r'*sin(theta)*cos(phi) + r*cos(theta)*cos(phi)*theta' - "
     "r*sin(theta)*sin(phi)*phi')^2"
     " + (r'*sin(theta)*sin(phi) + r*cos(theta)*sin(phi)*theta' + "
     "r*sin(theta)*cos(phi)*phi')^2"
     " + (r'*cos(theta) - r*sin(theta)*theta')^2",
     "r'^2 + r^2*theta'^2 + r^2*sin(theta)^2*phi'^2"},
    /* entries of mass matrices */
    {"m1*L1^2*cos(theta1)^2 + m1*L1^2*sin(theta1)^2 + m2*L1^2", "(m1 + m2)*L1^2"},
    {"m2*(L1*cos(theta1)*L2*cos(theta2) + L1*sin(theta1)*L2*sin(theta2))",
     "m2*L1*L2*cos(theta1 - theta2)"},
    {"m*L^2*(1 - cos(theta)^2)", "m*L^2*sin(theta)^2"},
    {"m*L^2*sin(theta)^2*cos(phi)^2 + m*L^2*sin(theta)^2*sin(phi)^2",
     "m*L^2*sin(theta)^2"},
    /* forces and equations */
    {"-m1*g*L1*sin(theta1) - m2*g*L1*sin(theta1)", "-(m1 + m2)*g*L1*sin(theta1)"},
    {"-(m1 + m2)*g*L1*cos(theta1) - m2*g*L2*cos(theta2)",
     "-g*((m1 + m2)*L1*cos(theta1) + m2*L2*cos(theta2))"},
    {"m*L^2*theta'' + m*g*L*sin(theta)", "m*L^2*theta'' + m*g*L*sin(theta)"},
    {"m*L^2*theta'' - m*L^2*sin(theta)*cos(theta)*phi'^2",
     "m*L^2*(theta'' - sin(theta)*cos(theta)*phi'^2)"},
    {"(m1 + m2)*L1^2*theta1'' + m2*L1*L2*theta2''*(cos(theta1)*cos(theta2)"
     " + sin(theta1)*sin(theta2))"
     " + m2*L1*L2*theta2'^2*(sin(theta1)*cos(theta2) - cos(theta1)*sin(theta2))",
     "(m1 + m2)*L1^2*theta1'' + m2*L1*L2*cos(theta1 - theta2)*theta2''"
     " + m2*L1*L2*sin(theta1 - theta2)*theta2'^2"},
    {"m*g*L*sin(phi)/(m*L^2)", "g*sin(phi)/L"},
    {"1/2*m*g*z - k/r", "1/2*m*g*z - k/r"},
    {"lam*2*x + lam*2*x", "4*lam*x"},
    /* line elements */
    {"(u*dv + v*du)^2 + (u*du - v*dv)^2", "(u^2 + v^2)*(du^2 + dv^2)"},
    {"(cos(phi)*dr - r*sin(phi)*dphi)^2 + (sin(phi)*dr + r*cos(phi)*dphi)^2 + dz^2",
     "dr^2 + r^2*dphi^2 + dz^2"},
    /* squares put together again */
    {"x^2 - 2*x*y + y^2 + z^2", "(x - y)^2 + z^2"},
    {"k/2*(x^2 - 2*x*y + y^2 + z^2 - 2*z*w + w^2)", "k/2*((x - y)^2 + (z - w)^2)"},
    {"a*x^2 - 2*a*x*y + a*y^2 + b*z^2 - 2*b*z*w + b*w^2", "a*(x - y)^2 + b*(z - w)^2"},
    {"x'^2 - 2*x'*y' + y'^2 + z'^2", "(x' - y')^2 + z'^2"},
    {"1/2*m*(x'^2 - 2*x'*y' + y'^2) + 1/2*k*(x^2 + 2*x*y + y^2)",
     "1/2*m*(x' - y')^2 + 1/2*k*(x + y)^2"},
    {"4*x^2 + 12*x*y + 9*y^2 + 1", "(2*x + 3*y)^2 + 1"},
    {"4*x^2 + 6*x*y + 9*y^2 + 1", "4*x^2 + 9*y^2 + 6*x*y + 1"},
    {"1/sqrt(x^2 - 2*x*y + y^2 + z^2 - 2*z*w + w^2)", "1/sqrt((x - y)^2 + (z - w)^2)"},
    /* trigonometry */
    {"1 - cos(x)^2", "sin(x)^2"},
    {"2*sin(x)*cos(x)", "sin(2*x)"},
    {"sin(x)*cos(x)", "sin(x)*cos(x)"},
    {"cos(x)^4 - sin(x)^4", "cos(2*x)"},
    {"cosh(x)^2 + sinh(x)^2", "cosh(2*x)"},
    {"sin(theta)^2*cos(phi)^2 + sin(theta)^2*sin(phi)^2 + cos(theta)^2", "1"},
    {"sin(x + y) - sin(x)*cos(y)", "cos(x)*sin(y)"},
    {"sin(x)/cos(x)", "tan(x)"},
    {"(1 - cos(x)^2)/cos(x)^2", "tan(x)^2"},
    {"sin(x)^2/(1 - cos(x))", "1 + cos(x)"},
    {"(1 - cos(x)^2)/sin(x)", "sin(x)"},
    /* the rest */
    {"x^2 + 2*x*y + y^2", "(x + y)^2"},
    {"exp(2*x) - 2*exp(x)*exp(y) + exp(2*y)", "(exp(x) - exp(y))^2"},
    {"log(sin(x)^2 + cos(x)^2 + y)", "log(1 + y)"},
    {"k/2*(sqrt(x^2 + y^2) - L)^2", "1/2*k*(sqrt(x^2 + y^2) - L)^2"},
    {"x^2/(x^2 + y^2)^(3/2) + y^2/(x^2 + y^2)^(3/2)", "1/sqrt(x^2 + y^2)"},
    {"x*x'/sqrt(x^2 + y^2) + y*y'/sqrt(x^2 + y^2)", "(x*x' + y*y')/sqrt(x^2 + y^2)"},
    {"sqrt(r^2*cos(phi)^2 + r^2*sin(phi)^2)", "r"},
    {"f(s + x - x)*f(s)", "f(s)^2"},
    {"0", "0"},
};

static void
textbook_forms_come_out(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        qdot_pool *pool = qdot_pool_new();
        qdot_expr to, e;

        /* names in the order of a scene */
        (void)text_read(pool, "m1 + m2 + m + L + L1 + L2 + r + theta1 + theta2 + u + v");
        e = qdot_simplify(pool, text_read(pool, forms[i].from), NULL);
        to = text_read(pool, forms[i].to);
        if (e != to) {
            char *text = text_write(pool, e), *wanted = text_write(pool, to);

            fail_msg("%s: got %s, not %s", forms[i].from, text, wanted);
        }
        qdot_pool_free(pool);
    }
}

static void
elliptic_and_toroidal_metrics_come_out(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr e = text_read(pool, "(a*sinh(u)*cos(v)*du - a*cosh(u)*sin(v)*dv)^2"
                                  " + (a*cosh(u)*sin(v)*du + a*sinh(u)*cos(v)*dv)^2");

    (void)state;
    assert_true(qdot_expr_size(pool, qdot_simplify(pool, e, NULL)) <=
                qdot_expr_size(
                    pool, text_read(pool, "a^2*(sinh(u)^2 + sin(v)^2)*(du^2 + dv^2)")));
    e = text_read(
        pool, "((a*cosh(v)*dv*(cosh(v) - cos(u)) - a*sinh(v)*(sinh(v)*dv + sin(u)*du))"
              "/(cosh(v) - cos(u))^2)^2"
              " + ((a*cos(u)*du*(cosh(v) - cos(u)) - a*sin(u)*(sinh(v)*dv + sin(u)*du))"
              "/(cosh(v) - cos(u))^2)^2");
    assert_true(
        qdot_expr_size(pool, qdot_simplify(pool, e, NULL)) <=
        qdot_expr_size(pool, text_read(pool, "a^2*(du^2 + dv^2)/(cosh(v) - cos(u))^2")));
    qdot_pool_free(pool);
}

static void
relations_shorten(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr relation = text_read(pool, "f'(s)^2 + h'(s)^2 - 1");
    qdot_facts facts = {.n_relations = 1, .relations = &relation};
    qdot_expr e = text_read(pool, "1/2*m*((f'(s)*s')^2 + (h'(s)*s')^2)");

    (void)state;
    assert_int_equal(qdot_simplify(pool, e, &facts), text_read(pool, "1/2*m*s'^2"));
    assert_int_equal(qdot_normal(pool, e, &facts), text_read(pool, "1/2*m*s'^2"));
    qdot_pool_free(pool);
}

/* A small budget: a form that is no longer than before, and it is said. */
static void
a_spent_budget_is_said(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr e = text_read(
        pool, "(sin(x + y)*z + cos(x - y)*w)^6 - (sin(x + y)*z - cos(x - y)*w)^6");
    qdot_expr best;
    bool spent;

    (void)state;
    best = qdot_shortest_within(pool, e, NULL, 200, &spent);
    assert_true(spent);
    assert_true(best != QDOT_NIL);
    assert_true(qdot_expr_size(pool, best) <= qdot_expr_size(pool, e));
    best = qdot_shortest_within(pool, text_read(pool, "1 - cos(x)^2"), NULL,
                                QDOT_SHORTEST_WORK, &spent);
    assert_false(spent);
    assert_int_equal(best, text_read(pool, "sin(x)^2"));
    qdot_pool_free(pool);
}

static void
sides_of_equations_stay_apart(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr left = text_read(pool, "m*L^2*theta''*(cos(phi)^2 + sin(phi)^2)");
    qdot_expr right = text_read(pool, "-m*g*L*sin(theta)"), e;

    (void)state;
    e = qdot_simplify(pool, qdot_rel(pool, QDOT_EQ, left, right), NULL);
    assert_int_equal(e, qdot_rel(pool, QDOT_EQ, text_read(pool, "m*L^2*theta''"), right));
    qdot_pool_free(pool);
}

static void
simplifying_again_changes_nothing_much(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        qdot_pool *pool = qdot_pool_new();
        qdot_expr e = qdot_simplify(pool, text_read(pool, forms[i].from), NULL);
        qdot_expr again = qdot_simplify(pool, e, NULL);

        assert_true(qdot_expr_size(pool, again) <= qdot_expr_size(pool, e));
        qdot_pool_free(pool);
    }
}

static void
normal_forms_are_equal_nodes(void **state)
{
    qdot_pool *pool = qdot_pool_new();

    (void)state;
    assert_int_equal(
        qdot_normal(pool, text_read(pool, "(x + y)*(x - y) + sin(x)^2"), NULL),
        qdot_normal(pool, text_read(pool, "x^2 - y^2 + 1 - cos(x)^2"), NULL));
    assert_int_equal(qdot_normal(pool, text_read(pool, "(x^2 - y^2)/(x - y)"), NULL),
                     text_read(pool, "x + y"));
    qdot_pool_free(pool);
}

/* --- linear systems ---------------------------------------------------------------- */

static void
the_double_pendulum_is_solved(void **state)
{
    static const char *const entries[] = {"(m1 + m2)*L1^2",
                                          "m2*L1*L2*cos(theta1 - theta2)",
                                          "m2*L1*L2*cos(theta1 - theta2)", "m2*L2^2"};
    static const char *const rights[] = {
        "-m2*L1*L2*sin(theta1 - theta2)*theta2'^2 - (m1 + m2)*g*L1*sin(theta1)",
        "m2*L1*L2*sin(theta1 - theta2)*theta1'^2 - m2*g*L2*sin(theta2)"};
    qdot_pool *pool = qdot_pool_new();
    qdot_expr a[4], b[2], x[2];
    uint32_t pivot;

    (void)state;
    for (int i = 0; i < 4; i++)
        a[i] = text_read(pool, entries[i]);
    for (int i = 0; i < 2; i++)
        b[i] = text_read(pool, rights[i]);
    assert_int_equal(qdot_solve_linear(pool, 2, a, b, x, &pivot, NULL), QDOT_OK);
    for (int i = 0; i < 2; i++) {
        qdot_expr sum = qdot_add(pool, qdot_mul(pool, a[2 * i], x[0]),
                                 qdot_mul(pool, a[2 * i + 1], x[1]));

        assert_true(qdot_is_zero(pool, qdot_sub(pool, sum, b[i]), NULL));
    }
    qdot_pool_free(pool);
}

static void
a_hidden_zero_pivot_is_singular(void **state)
{
    static const char *const entries[] = {"cos(x)^2", "sin(x)*cos(x)", "sin(2*x)/2",
                                          "sin(x)^2"};
    qdot_pool *pool = qdot_pool_new();
    qdot_expr a[4], b[2] = {QDOT_ONE, QDOT_ONE}, x[2];
    uint32_t pivot;

    (void)state;
    for (int i = 0; i < 4; i++)
        a[i] = text_read(pool, entries[i]);
    assert_int_equal(qdot_solve_linear(pool, 2, a, b, x, &pivot, NULL), QDOT_ESINGULAR);
    assert_int_equal(pivot, 1);
    qdot_pool_free(pool);
}

static void
a_zero_on_the_diagonal_is_passed(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr a[9] = {QDOT_ZERO,           text_read(pool, "m"),
                      QDOT_ZERO,           text_read(pool, "L"),
                      QDOT_ZERO,           QDOT_ONE,
                      QDOT_ZERO,           QDOT_ONE,
                      text_read(pool, "x")};
    qdot_expr b[3] = {text_read(pool, "m*y"), text_read(pool, "z"), text_read(pool, "y")},
              x[3];
    uint32_t pivot;

    (void)state;
    assert_int_equal(qdot_solve_linear(pool, 3, a, b, x, &pivot, NULL), QDOT_OK);
    assert_int_equal(x[0], text_read(pool, "z/L"));
    assert_int_equal(x[1], text_read(pool, "y"));
    assert_int_equal(x[2], QDOT_ZERO);
    qdot_pool_free(pool);
}

/* --- values are kept: an evaluation of its own ------------------------------------- */

/* The value of e in doubles, symbols by their hash; for the functions of these tests. */
static double
value(const qdot_pool *pool, qdot_expr e, unsigned salt)
{
    uint32_t n = qdot_expr_count(pool, e);
    double x, y;
    unsigned h = salt * 2654435761u;

    switch (qdot_expr_kind(pool, e)) {
    case QDOT_NUM: return fmpq_get_d(qdot_expr_rational(pool, e));
    case QDOT_SYM:
        if (e == QDOT_PI)
            return 3.14159265358979323846;
        for (const char *c = qdot_expr_symbol(pool, e)->name; *c != '\0'; c++)
            h = (h ^ (unsigned char)*c) * 16777619u;
        return 0.2 + (h >> 8) % 1000 / 700.0;
    case QDOT_UFUN: return 0.7 + 0.1 * (double)qdot_expr_node(pool, e)->op;
    case QDOT_SUM:
        x = value(pool, qdot_expr_arg(pool, e, 0), salt);
        for (uint32_t i = 1; i < n; i += 2)
            x += value(pool, qdot_expr_arg(pool, e, i), salt) *
                 value(pool, qdot_expr_arg(pool, e, i + 1), salt);
        return x;
    case QDOT_PROD:
        x = value(pool, qdot_expr_arg(pool, e, 0), salt);
        for (uint32_t i = 1; i < n; i += 2)
            x *= pow(value(pool, qdot_expr_arg(pool, e, i), salt),
                     value(pool, qdot_expr_arg(pool, e, i + 1), salt));
        return x;
    default: y = value(pool, qdot_expr_arg(pool, e, 0), salt);
    }
    switch (qdot_expr_node(pool, e)->op) {
    case QDOT_SIN: return sin(y);
    case QDOT_COS: return cos(y);
    case QDOT_TAN: return tan(y);
    case QDOT_COT: return 1 / tan(y);
    case QDOT_SEC: return 1 / cos(y);
    case QDOT_SINH: return sinh(y);
    case QDOT_COSH: return cosh(y);
    case QDOT_TANH: return tanh(y);
    case QDOT_EXP: return exp(y);
    case QDOT_LOG: return log(y);
    case QDOT_ABS: return fabs(y);
    case QDOT_ATAN: return atan(y);
    default: return NAN;
    }
}

static void
entries_too_long_to_be_multiplied_out_are_kept(void **state)
{
    static const char *const entries[] = {
        ("m*(a^2*cos(x)^2 + (sin(x + z) - x/sqrt(x^2 + 1) - 3)^2 + 1) + "
         "L*(sin(x + z)^2 + (2/3*x + 1/(x^2 + 1))^2 + (sin(x) + x*cos(x))^2)"),
        "m*atan(x)*exp(y)*(1 + sqrt(2 + y^2))", "m*atan(x)*exp(y)*(1 + sqrt(2 + y^2))",
        "L*(3 + cosh(y)^2 + (1 + sin(x)*y)^2) + m*(y^2 + (log(2 + x^2) - y)^4)"};
    static const char *const rights[] = {"m*(a + sin(x))^3*sqrt(1 + x^2) - y*cos(z)",
                                         "(x + y + z)^4 + L*sin(x - y)"};
    qdot_pool *pool = qdot_pool_new();
    qdot_expr a[4], b[2], x[2];
    uint64_t given = 0;
    uint32_t pivot;

    (void)state;
    for (int i = 0; i < 4; i++)
        given += qdot_expr_size(pool, a[i] = text_read(pool, entries[i]));
    for (int i = 0; i < 2; i++)
        given += qdot_expr_size(pool, b[i] = text_read(pool, rights[i]));
    assert_int_equal(qdot_solve_linear(pool, 2, a, b, x, &pivot, NULL), QDOT_OK);
    for (int i = 0; i < 2; i++) {
        qdot_expr sum = qdot_add(pool, qdot_mul(pool, a[2 * i], x[0]),
                                 qdot_mul(pool, a[2 * i + 1], x[1]));

        assert_true(qdot_expr_size(pool, x[i]) < 2 * given);
        for (unsigned salt = 1; salt <= 5; salt++)
            assert_true(fabs(value(pool, sum, salt) - value(pool, b[i], salt)) <
                        1e-9 * (1 + fabs(value(pool, b[i], salt))));
    }
    qdot_pool_free(pool);
}

/* x1, x3 on one side and x2 on the other; and a pivot that is counted in the whole. */
static void
blocks_are_solved_apart(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr m = text_read(pool, "m"), L = text_read(pool, "L");
    qdot_expr a[9] = {m, QDOT_ZERO, L, QDOT_ZERO, L, QDOT_ZERO, L, QDOT_ZERO, m};
    qdot_expr b[3] = {L, m, m}, x[3];
    uint32_t pivot;

    (void)state;
    assert_int_equal(qdot_solve_linear(pool, 3, a, b, x, &pivot, NULL), QDOT_OK);
    assert_int_equal(x[0], QDOT_ZERO);
    assert_int_equal(x[1], text_read(pool, "m/L"));
    assert_int_equal(x[2], QDOT_ONE);
    a[0] = a[2] = a[6] = m;
    assert_int_equal(qdot_solve_linear(pool, 3, a, b, x, &pivot, NULL), QDOT_ESINGULAR);
    assert_int_equal(pivot, 2);
    qdot_pool_free(pool);
}


static uint64_t seed = 362436069u;

static unsigned
draw(unsigned below)
{
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return (unsigned)((seed >> 33) % below);
}

static qdot_expr
random_tree(qdot_pool *pool, int depth)
{
    static const char *const leaves[] = {"x",          "y",        "m",
                                         "L",          "r",        "r'",
                                         "phi'",       "x''",      "sin(x)",
                                         "cos(x)",     "sin(y)",   "cos(y)",
                                         "cos(x - y)", "sin(2*x)", "2",
                                         "-1/3",       "sinh(u)",  "cosh(u)",
                                         "tan(x)",     "exp(u)",   "sqrt(x^2 + y^2)",
                                         "sqrt(r)",    "m1",       "m2",
                                         "log(x + y)", "dx",       "lam",
                                         "f(s)",       "sin(x)^2", "cos(x)^2",
                                         "cosh(u)^2",  "abs(x*y)"};
    qdot_expr a, b;

    if (depth == 0)
        return text_read(pool, leaves[draw(sizeof leaves / sizeof *leaves)]);
    a = random_tree(pool, depth - 1);
    b = random_tree(pool, depth - 1 - (int)draw((unsigned)depth));
    switch (draw(6)) {
    case 0:
    case 1: return qdot_add(pool, a, b);
    case 2:
    case 3: return qdot_mul(pool, a, b);
    case 4: return qdot_sub(pool, a, b);
    default: return b == QDOT_ZERO ? a : qdot_div(pool, a, b);
    }
}

static void
random_values_are_kept(void **state)
{
    int n = 3000, compared = 0;

    (void)state;
    for (int i = 0; i < n; i++) {
        qdot_pool *pool = qdot_pool_new();
        qdot_expr e = random_tree(pool, 1 + (int)draw(4)), forms_of[2];

        if (e == QDOT_NIL) {
            qdot_pool_free(pool);
            continue;
        }
        forms_of[0] = qdot_simplify(pool, e, NULL);
        forms_of[1] = qdot_normal(pool, e, NULL);
        for (int k = 0; k < 2; k++) {
            assert_int_not_equal(forms_of[k], QDOT_NIL);
            for (unsigned salt = 1; salt <= 2; salt++) {
                double was = value(pool, e, salt), is = value(pool, forms_of[k], salt);

                if (!isfinite(was) || !isfinite(is) || fabs(was) > 1e7)
                    continue;
                compared++;
                if (fabs(was - is) > 1e-5 * (1 + fabs(was))) {
                    char *left = text_write(pool, e),
                         *right = text_write(pool, forms_of[k]);

                    fail_msg("%s became %s: %.15g, %.15g", left, right, was, is);
                }
            }
        }
        assert_true(qdot_expr_size(pool, forms_of[0]) <= qdot_expr_size(pool, e));
        qdot_pool_free(pool);
    }
    assert_true(compared > 3 * n);
}

/* What is seen at a glance is what the field says: with a relation among other symbols there is
 * no glance. */
static void
sums_of_angles_are_seen(void **state)
{
    static const char *const front[] = {"1", "L1*L2", "-3/2*m*r^2/L", "x*x'^2", "theta1*u'"};
    static const char *const product[] = {
        "cos(%s)*cos(%s)", "sin(%s)*sin(%s)", "sin(%s)*cos(%s)", "cos(%s)*sin(%s)"};
    static const char *const angle[] = {"theta1", "theta2", "u"};
    int seen = 0;

    (void)state;
    for (size_t k = 0; k < 5 * 4 * 4 * 2 * 9; k++) {
        qdot_pool *pool = qdot_pool_new();
        const char *a = angle[k % 3], *b = angle[k / 3 % 3], *f = front[k / 9 % 5];
        const char *p = product[k / 45 % 4], *q = product[k / 180 % 4];
        char one[64], two[64], text[256];
        qdot_expr e, other, at_sight;
        qdot_facts facts = {.n_relations = 1, .relations = &other};

        (void)text_read(pool, "m + L + L1 + L2 + r + theta1 + theta2 + u + x + k");
        snprintf(one, sizeof one, p, a, b);
        snprintf(two, sizeof two, q, a, b);
        snprintf(text, sizeof text, "%s*%s %c %s*%s", f, one, k / 720 ? '-' : '+', f, two);
        e = text_read(pool, text);
        other = text_read(pool, "k");
        at_sight = qdot_simple_seen(pool, e);
        if (at_sight != QDOT_NIL) {
            qdot_expr full = qdot_simplify(pool, e, &facts);

            seen += at_sight != e;
            if (at_sight != full)
                fail_msg("%s: seen as %s, is %s", text, text_write(pool, at_sight),
                         text_write(pool, full));
        }
        qdot_pool_free(pool);
    }
    assert_true(seen > 250);
}

/* A distance of points is seen at a glance to be what the field leaves of it; what holds common factors, constants or
 * one symbol in two components is not. */
static void
distances_are_seen(void **state)
{
    static const char *const component[] = {"x1 - x2", "y2 - y1", "z1", "x1 + y1", "2*x1 - x2", "y1 - 1", "z1 - z2 + u"};
    const size_t n = sizeof component / sizeof *component;
    int seen = 0;

    (void)state;
    for (size_t k = 0; k < n * n * n; k++) {
        qdot_pool *pool = qdot_pool_new();
        qdot_expr e, other, at_sight;
        qdot_facts facts = {.n_relations = 1, .relations = &other};
        char text[128];

        (void)text_read(pool, "x1 + y1 + z1 + x2 + y2 + z2 + u + k");
        snprintf(text, sizeof text, "sqrt((%s)^2 + (%s)^2 + (%s)^2)", component[k % n], component[k / n % n],
                 component[k / n / n]);
        e = text_read(pool, text);
        other = text_read(pool, "k");
        at_sight = qdot_simple_seen(pool, e);
        if (at_sight != QDOT_NIL) {
            const qdot_expr full = qdot_simplify(pool, e, &facts);

            seen++;
            if (at_sight != full)
                fail_msg("%s: seen as %s, is %s", text, text_write(pool, at_sight), text_write(pool, full));
        }
        qdot_pool_free(pool);
    }
    assert_int_equal(seen, 12);
}

static void
long_sums_come_back_in_time(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr sum = QDOT_ZERO;

    (void)state;
    for (int i = 0; i < 300; i++) {
        char text[96];

        snprintf(text, sizeof text, "q%d*sin(w%d - w%d)*w%d'^2", i % 7, i % 11, i % 13,
                 i % 17);
        sum = qdot_add(pool, sum,
                       qdot_mul(pool, qdot_expr_int(pool, i + 1), text_read(pool, text)));
    }
    assert_int_not_equal(qdot_simplify(pool, sum, NULL), QDOT_NIL);
    sum = qdot_pow_int(pool, qdot_add(pool, sum, QDOT_ONE), 50); /* far past the budget */
    assert_int_not_equal(qdot_simplify(pool, sum, NULL), QDOT_NIL);
    qdot_pool_free(pool);
}

/* Constructor calls that simplifying takes. */
static uint64_t
work_of(const char *from)
{
    const uint64_t enough = UINT64_C(1) << 40;
    qdot_pool *pool = qdot_pool_new();
    qdot_expr e = text_read(pool, from);
    uint64_t left;

    (void)qdot_pool_budget(pool, enough);
    assert_true(qdot_simplify(pool, e, NULL) != QDOT_NIL);
    left = qdot_pool_budget(pool, UINT64_MAX);
    qdot_pool_free(pool);
    return enough - left;
}

/* Three roots, each in one part of a sum or in four of seven: their bases are simplified as often. */
static void
a_root_in_many_parts_is_simplified_once(void **state)
{
#define R1 "sqrt(2 + (sin(x)*cos(y) + x*y + z)^2 + x^4*cos(z)^2)"
#define R2 "sqrt(3 + (sin(y)*cos(z) + y*z + w)^2 + y^4*cos(w)^2)"
#define R3 "sqrt(5 + (sin(z)*cos(w) + z*w + x)^2 + z^4*cos(x)^2)"
    const char *once = "u*" R1 " + v*" R2 " + phi*" R3;
    const char *often = "u*" R1 " + v*" R2 " + phi*" R3 " + m*" R1 "*" R2 " + L*" R2 "*" R3
                        " + g*" R1 "*" R3 " + k*" R1 "*" R2 "*" R3;

    (void)state;
    assert_true(work_of(often) < 2 * work_of(once));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(textbook_forms_come_out),
        cmocka_unit_test(elliptic_and_toroidal_metrics_come_out),
        cmocka_unit_test(relations_shorten),
        cmocka_unit_test(a_spent_budget_is_said),
        cmocka_unit_test(sides_of_equations_stay_apart),
        cmocka_unit_test(simplifying_again_changes_nothing_much),
        cmocka_unit_test(normal_forms_are_equal_nodes),
        cmocka_unit_test(the_double_pendulum_is_solved),
        cmocka_unit_test(a_hidden_zero_pivot_is_singular),
        cmocka_unit_test(a_zero_on_the_diagonal_is_passed),
        cmocka_unit_test(entries_too_long_to_be_multiplied_out_are_kept),
        cmocka_unit_test(blocks_are_solved_apart),
        cmocka_unit_test(random_values_are_kept),
        cmocka_unit_test(sums_of_angles_are_seen),
        cmocka_unit_test(distances_are_seen),
        cmocka_unit_test(long_sums_come_back_in_time),
        cmocka_unit_test(a_root_in_many_parts_is_simplified_once),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
