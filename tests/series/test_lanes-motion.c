/* test_lanes-motion.c -- stages of a motion as machine code, of eight systems and of one, against the
 * kernels: a pendulum as d'Alembert has it, with forces of every kind of sum that lags behind.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "num/kinds.h"
#include "series/taylor-motion.h"

enum { L = QDOT_LANES, MOST = 34 };
enum { THETA, OMEGA, INPUTS };

/* Forces on a pendulum of length 1: squares, pairs and sums that are read at the order of theta''. */
static qdot_expr
force(qdot_pool *pool, qdot_expr theta, qdot_expr omega)
{
    const qdot_expr w = qdot_mul(pool, QDOT_HALF, omega);
    qdot_expr e = qdot_sqrt(pool, qdot_add(pool, QDOT_ONE, qdot_pow_int(pool, omega, 2)));

    e = qdot_add(pool, e, qdot_fun1(pool, QDOT_TANH, w));
    e = qdot_add(pool, e, qdot_mul(pool, qdot_fun1(pool, QDOT_COS, w), theta));
    e = qdot_sub(pool, e, qdot_fun1(pool, QDOT_EXP, w));
    return qdot_div(pool, e,
                    qdot_add(pool, qdot_expr_int(pool, 2), qdot_pow_int(pool, w, 2)));
}

static void
lower(qdot_pool *pool, size_t n, const qdot_expr *out, const qdot_expr *in,
      qdot_tape **tape)
{
    assert_int_equal(qdot_tape_new(pool, INPUTS, in, n, out, tape), QDOT_OK);
}

/* E = x_theta x'' + y_theta (y'' + 1) - Q, x = sin theta, y = -cos theta. */
static void
make(qdot_pool *pool, qdot_motion *m)
{
    const qdot_expr theta = qdot_symbol_get(pool, QDOT_COORD, "theta");
    const qdot_expr in[INPUTS] = {theta, qdot_symbol_jet(pool, theta, 1)};
    const qdot_expr s = qdot_fun1(pool, QDOT_SIN, theta),
                    c = qdot_fun1(pool, QDOT_COS, theta);
    const qdot_expr out[] = {s, qdot_neg(pool, c), c, force(pool, theta, in[1])};
    const qdot_motion_unknown u = {.row = QDOT_NO_ROW, .once = OMEGA, .twice = THETA};
    qdot_program_row at[INPUTS] = {THETA, OMEGA}, row[4], x, y, E;
    qdot_program_builder *b;
    qdot_tape *tape;

    *m = (qdot_motion){0};
    lower(pool, 4, out, in, &tape);
    assert_int_equal(qdot_program_begin(INPUTS, INPUTS, false, &m->program, &b), QDOT_OK);
    qdot_program_append(b, tape, at, row);
    x = qdot_program_rate(b, qdot_program_rate(b, row[0]));
    y = qdot_program_rate(b, qdot_program_rate(b, row[1]));
    y = qdot_program_operation(
        b, QDOT_OP_ADD, y,
        qdot_program_number(b, (qdot_program_constant){1, 0, 0, QDOT_ONE}), 0);
    E = qdot_program_operation(b, QDOT_OP_NEG, row[3], 0, 0);
    E = qdot_program_operation(b, QDOT_OP_MADD, row[2], x, E);
    E = qdot_program_operation(b, QDOT_OP_MADD, row[0], y, E);
    assert_int_equal(qdot_motion_solve(m, u, E), QDOT_OK);
    assert_int_equal(qdot_motion_end_block(m), QDOT_OK);
    assert_int_equal(qdot_motion_complete(m, b, QDOT_OK), QDOT_OK);
    qdot_tape_free(tape);
}

static double
start(size_t l)
{
    return 0.4 + 0.1 * (double)l;
}

static double
unit_of(size_t l)
{
    return ldexp(l % 2 ? -1 : 1, -1 - (int)(l % 3));
}

/* Lane l alone, stages from ... to by the kernels. K is 1. */
static void
run_kernels(qdot_taylor *t, const qdot_motion *m, int from, int to)
{
    for (int k = from; k <= to; k++) {
        qdot_taylor_stage(t, k);
        if (k >= 0)
            qdot_taylor_change(t, k,
                               &(double){-qdot_taylor_series(t, m->equations.at[0])[k]});
    }
}

static qdot_taylor *
begin_one(const qdot_motion *m, size_t l)
{
    qdot_taylor *t;

    assert_int_equal(qdot_taylor_of_motion(m, false, MOST, 0, &t), QDOT_OK);
    qdot_taylor_set_unit(t, unit_of(l));
    qdot_taylor_input(t, THETA)[0] = start(l);
    qdot_taylor_input(t, THETA)[1] = -0.3 * unit_of(l);
    qdot_taylor_input(t, OMEGA)[0] = -0.3;
    run_kernels(t, m, qdot_motion_first(m), 0);
    return t;
}

static void
agree(const double *seen, size_t stride, const double *want, int to, size_t l,
      const char *what)
{
    double size = 0;

    for (int k = 0; k <= to + 2; k++) {
        const double x = seen[(size_t)k * stride];

        size = fmax(size, fabs(want[k]));
        if (!(fabs(x - want[k]) <= 2e-14 * size))
            fail_msg("%s, lane %zu, order %d of %d: %.17g, not %.17g", what, l, k, to, x,
                     want[k]);
    }
}

static void
one_agrees(const qdot_motion *m, int to, size_t l)
{
    qdot_taylor *kernels = begin_one(m, l), *t = begin_one(m, l);
    const qdot_lanes_rows rows = qdot_taylor_get_rows(t);
    qdot_lanes_motion *code;
    const double unit = unit_of(l);

    run_kernels(kernels, m, 1, to);
    assert_int_equal(qdot_lanes_motion_new(&rows, m, to, 3, &code), QDOT_OK);
    assert_non_null(code);
    assert_int_equal(qdot_lanes_motion_orders(code), to);
    qdot_lanes_motion_set(code, 0, &(double){1}, 1, NULL);
    qdot_taylor_set_inverses(t);
    qdot_lanes_motion_run(code, &unit);
    agree(qdot_taylor_input(t, THETA), 1, qdot_taylor_input(kernels, THETA), to, l,
          "one");
    qdot_lanes_motion_free(code);
    qdot_taylor_free(t);
    qdot_taylor_free(kernels);
}

static qdot_lanes *
begin_eight(const qdot_motion *m, double *unit)
{
    double by[L];
    qdot_lanes *t;

    assert_int_equal(qdot_lanes_of_motion(m, false, MOST, &t), QDOT_OK);
    for (size_t l = 0; l < L; l++) {
        unit[l] = unit_of(l);
        qdot_lanes_input(t, THETA)[l] = start(l);
        qdot_lanes_input(t, THETA)[L + l] = -0.3 * unit[l];
        qdot_lanes_input(t, OMEGA)[l] = -0.3;
    }
    qdot_lanes_set_unit(t, unit);
    for (int k = qdot_motion_first(m); k <= 0; k++)
        qdot_lanes_stage(t, k);
    for (size_t l = 0; l < L; l++)
        by[l] = -qdot_lanes_series(t, m->equations.at[0])[l];
    qdot_lanes_change(t, 0, by);
    return t;
}

static void
eight_agree(const qdot_motion *m, int to)
{
    double unit[L], inverse[L];
    qdot_lanes *t = begin_eight(m, unit);
    const qdot_lanes_rows rows = qdot_lanes_get_rows(t);
    qdot_lanes_motion *code;

    assert_int_equal(qdot_lanes_motion_new(&rows, m, to, 0, &code), QDOT_OK);
    assert_non_null(code);
    for (size_t l = 0; l < L; l++)
        inverse[l] = 1;
    qdot_lanes_motion_set(code, 0, inverse, 1, NULL);
    qdot_lanes_motion_run(code, unit);
    for (size_t l = 0; l < L; l++) {
        qdot_taylor *kernels = begin_one(m, l);

        run_kernels(kernels, m, 1, to);
        agree(qdot_lanes_input(t, THETA) + l, L, qdot_taylor_input(kernels, THETA), to, l,
              "eight");
        qdot_taylor_free(kernels);
    }
    qdot_lanes_motion_free(code);
    qdot_lanes_free(t);
}

static void
stages_agree_with_the_kernels(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_motion m;

    (void)state;
    make(pool, &m);
    for (size_t kind = 1; kind < 3; kind++) {
        qdot_kind_limit(kind);
        for (int to = 1; to <= 30 && qdot_lanes_may_be_code(); to++) {
            one_agrees(&m, to, (size_t)to % L);
            eight_agree(&m, to);
        }
    }
    qdot_kind_limit(2);
    qdot_motion_clear(&m);
    qdot_pool_free(pool);
}

/* Without code there is none. */
static void
a_processor_without_has_none(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_motion m;
    qdot_taylor *t;
    qdot_lanes_motion *code;
    qdot_lanes_rows rows;

    (void)state;
    make(pool, &m);
    qdot_kind_limit(0);
    t = begin_one(&m, 0);
    rows = qdot_taylor_get_rows(t);
    assert_int_equal(qdot_lanes_motion_new(&rows, &m, 9, 3, &code), QDOT_OK);
    assert_null(code);
    qdot_kind_limit(2);
    qdot_taylor_free(t);
    qdot_motion_clear(&m);
    qdot_pool_free(pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stages_agree_with_the_kernels),
        cmocka_unit_test(a_processor_without_has_none),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
