/* test_taylor-code.c -- machine code against the kernels: every recurrence, every order.
 *
 * For each kind of code that this processor runs. Where there is none the first of these tests
 * says so and the others compare the kernels with themselves.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "machine/asm.h"
#include "num/kinds.h"
#include "num/series.h"
#include "series/kit.h"
#include "series/taylor-motion.h"

/* Inputs of q'' = e(q, p, q', p', t, m): two coordinates, their velocities, the time, a
 * number. */
enum { Q, P, V, W, T, M, INPUTS, MOVING = M, MOST = QDOT_SERIES_MOST - 2 };

typedef struct {
    qdot_pool *pool;
    qdot_expr in[INPUTS], above, within; /* above 1; between -1 and 1 */
} scene;

static void
begin(scene *f)
{
    static const char *const names[] = {"q", "p", "v", "w", "t", "m"};
    qdot_pool *pool = f->pool = qdot_pool_new();
    qdot_expr squares;

    for (size_t i = 0; i < INPUTS; i++)
        f->in[i] = i == T ? QDOT_T : qdot_symbol_get(pool, QDOT_PARAM, names[i]);
    squares = qdot_add(pool, qdot_mul(pool, f->in[Q], f->in[Q]),
                       qdot_mul(pool, f->in[P], f->in[W]));
    f->above = qdot_add(pool, qdot_expr_int(pool, 3), squares);
    f->within = qdot_div(pool, f->in[V], f->above);
}

static void
start(qdot_taylor *t, double unit, double moved)
{
    static const double zero[INPUTS] = {0.7, 0.45, 0.31, -0.42, 0.25, 1.7};

    for (size_t i = 0; i < INPUTS; i++)
        qdot_taylor_input(t, i)[0] = moved * zero[i];
    qdot_taylor_input(t, Q)[1] = moved * unit * zero[V];
    qdot_taylor_input(t, P)[1] = moved * unit * zero[W];
    qdot_taylor_input(t, T)[1] = unit;
}

/* With code, shared with orders up to 3 more. */
static qdot_taylor *
linked(const qdot_tape *tape, int to, bool code)
{
    qdot_taylor *t;

    assert_int_equal(taylor_moving(tape, MOVING, QDOT_SERIES_MOST, &t), QDOT_OK);
    assert_int_equal(qdot_taylor_link(t, V, Q, qdot_taylor_output(t, 0)), QDOT_OK);
    assert_int_equal(qdot_taylor_link(t, W, SIZE_MAX, qdot_taylor_output(t, 1)), QDOT_OK);
    assert_int_equal(qdot_taylor_link(t, P, SIZE_MAX, qdot_taylor_input(t, W)), QDOT_OK);
    if (code)
        assert_int_equal(qdot_taylor_prepare(t, to, to + to % 4), QDOT_OK);
    return t;
}

static const double *
row_of(qdot_taylor *t, size_t i)
{
    return i < INPUTS ? qdot_taylor_input(t, i) : qdot_taylor_output(t, i - INPUTS);
}

/* Rows to order `to`, by the code and by the kernels, differ less than they do from those of
 * a start moved by 1e-12; beyond, what is not to be written has been marked. */
static void
compare(qdot_taylor *const of[3], int to, const char *what)
{
    const int last[INPUTS + 2] = {to + 2, to + 1, to + 1, to + 1, 1, 0, to, to};

    for (size_t i = 0; i < INPUTS + 2; i++) {
        const double *a = row_of(of[0], i), *b = row_of(of[1], i), *c = row_of(of[2], i);
        double room = 0;

        for (int k = 0; k <= QDOT_SERIES_MOST; k++) {
            room = fmax(0.5 * room, 0.1 * fabs(c[k] - b[k]) + 1e-14 * fabs(b[k]));
            if (k > last[i] ? a[k] != b[k] : !(fabs(a[k] - b[k]) <= room))
                fail_msg("%s, row %zu, order %d of %d: %.17g, not %.17g", what, i, k, to,
                         a[k], b[k]);
        }
    }
}

/* The same expansion three times: by the code, by kernels, by kernels from another start. */
static void
expand(qdot_taylor *const of[3], int to, double unit)
{
    for (int l = 0; l < 3; l++) {
        for (size_t i = 0; i < MOVING; i++)
            for (int k = to + 3; k <= QDOT_SERIES_MOST; k++)
                qdot_taylor_input(of[l], i)[k] = 1e9;
        start(of[l], unit, l < 2 ? 1 : 1 + 1e-12);
        qdot_taylor_begin(of[l], unit);
        qdot_taylor_extend(of[l], 1, to);
    }
}

static void
outputs_agree(scene *f, const qdot_expr *out, const char *what)
{
    qdot_tape *tape;

    assert_int_equal(qdot_tape_new(f->pool, INPUTS, f->in, 2, out, &tape), QDOT_OK);
    for (int to = 1; to <= MOST; to++) {
        qdot_taylor *of[] = {linked(tape, to, true), linked(tape, to, false),
                             linked(tape, to, false)};

        expand(of, to, 2);
        compare(of, to, what);
        expand(of, to, 3);
        compare(of, to, what);
        for (int l = 0; l < 3; l++)
            qdot_taylor_free(of[l]);
    }
    qdot_tape_free(tape);
}

/* By itself and beside so many products that the vectors begin with order 1. */
static void
code_agrees(scene *f, qdot_expr e, const char *what)
{
    qdot_pool *pool = f->pool;
    qdot_expr out[] = {qdot_div(pool, e, qdot_expr_int(pool, 5)),
                       qdot_sub(pool, qdot_mul(pool, f->in[M], f->in[Q]),
                                qdot_mul(pool, f->in[V], f->in[P]))};

    outputs_agree(f, out, what);
    for (int i = 0; i < 4; i++)
        out[1] = qdot_mul(pool, qdot_add(pool, out[1], f->in[i % 2 ? P : M]),
                          f->in[i % 2 ? Q : W]);
    outputs_agree(f, out, what);
}

static void
there_is_code_or_a_reason(void **state)
{
    scene f;
    qdot_expr out[2];
    qdot_tape *tape;
    qdot_taylor *t;
    const char *why;

    (void)state;
    begin(&f);
    out[0] = qdot_fun1(f.pool, QDOT_SIN, f.in[Q]);
    out[1] = f.within;
    assert_int_equal(qdot_tape_new(f.pool, INPUTS, f.in, 2, out, &tape), QDOT_OK);
    t = linked(tape, 20, false);
    assert_int_equal(qdot_taylor_code_bytes(t, &why), 0);
    assert_null(why);
    assert_int_equal(qdot_taylor_prepare(t, 0, 0), QDOT_EINVAL);
    assert_int_equal(qdot_taylor_prepare(t, 20, 20), QDOT_OK);
    if (qdot_taylor_code_bytes(t, &why) == 0)
        print_message("no machine code: %s\n", why);
    assert_true((qdot_taylor_code_bytes(t, &why) > 0) == (why == NULL));
    assert_true(qdot_asm_is_here() != (why && strstr(why, "x86-64")));
    qdot_taylor_free(t);
    qdot_tape_free(tape);
    qdot_pool_free(f.pool);
}

static void
functions_agree(void **state)
{
    static const struct {
        qdot_fun_id f;
        bool above;
        const char *name;
    } rows[] = {
        {QDOT_SIN, false, "sin"},     {QDOT_COS, true, "cos"},
        {QDOT_TAN, false, "tan"},     {QDOT_ASIN, false, "asin"},
        {QDOT_ACOS, false, "acos"},   {QDOT_ATAN, true, "atan"},
        {QDOT_SINH, false, "sinh"},   {QDOT_COSH, false, "cosh"},
        {QDOT_TANH, false, "tanh"},   {QDOT_ASINH, false, "asinh"},
        {QDOT_ACOSH, true, "acosh"},  {QDOT_ATANH, false, "atanh"},
        {QDOT_EXP, false, "exp"},     {QDOT_LOG, true, "log"},
        {QDOT_ERF, false, "erf"},     {QDOT_ERFC, true, "erfc"},
    };
    scene f;

    (void)state;
    begin(&f);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        code_agrees(&f, qdot_fun1(f.pool, rows[i].f, rows[i].above ? f.above : f.within),
                    rows[i].name);
    code_agrees(&f, qdot_fun(f.pool, QDOT_ATAN2, 2, (qdot_expr[]){f.above, f.within}),
                "atan2");
    qdot_pool_free(f.pool);
}

static void
arithmetic_agrees(void **state)
{
    scene f;
    qdot_pool *pool;
    qdot_expr s, c, m, half, third;

    (void)state;
    begin(&f);
    pool = f.pool;
    s = qdot_fun1(pool, QDOT_SIN, f.in[Q]);
    c = qdot_fun1(pool, QDOT_EXP, f.within);
    m = f.in[M];
    half = qdot_div(pool, QDOT_ONE, qdot_expr_int(pool, 2));
    third = qdot_div(pool, QDOT_ONE, qdot_expr_int(pool, 3));
    code_agrees(&f, qdot_mul(pool, s, c), "product");
    code_agrees(&f, qdot_mul(pool, m, c), "product with a number");
    code_agrees(&f, qdot_div(pool, s, f.above), "quotient");
    code_agrees(&f, qdot_div(pool, m, f.above), "quotient of a number");
    code_agrees(&f, qdot_div(pool, f.in[T], f.above), "quotient of the time");
    code_agrees(&f, qdot_pow_int(pool, s, 2), "square");
    code_agrees(&f, qdot_pow_int(pool, f.above, -3), "inverse cube");
    code_agrees(&f, qdot_pow(pool, f.above, half), "root");
    code_agrees(&f, qdot_pow(pool, f.above, third), "power");
    code_agrees(&f, qdot_pow(pool, f.above, f.within), "power to a power");
    code_agrees(&f, qdot_add(pool, qdot_mul(pool, s, c), f.in[V]), "product and sum");
    code_agrees(&f, qdot_sub(pool, qdot_mul(pool, s, c), f.in[V]), "product less");
    code_agrees(&f, qdot_sub(pool, f.in[V], qdot_mul(pool, s, c)), "less a product");
    code_agrees(&f, qdot_add(pool, qdot_mul(pool, m, c), s), "scaled and sum");
    code_agrees(&f, qdot_sub(pool, qdot_mul(pool, m, c), s), "scaled less");
    code_agrees(&f, qdot_sub(pool, s, qdot_mul(pool, m, c)), "less scaled");
    code_agrees(&f, qdot_sub(pool, m, c), "number less");
    code_agrees(&f, qdot_neg(pool, qdot_add(pool, s, c)), "negative sum");
    code_agrees(&f, qdot_neg(pool, m), "a number");
    code_agrees(&f, QDOT_T, "the time");
    qdot_pool_free(pool);
}

/* Sums and products that are read once, within each other; more than one sum takes, and deeper;
 * less what is made of one term. */
static void
folded_agrees(void **state)
{
    scene f;
    qdot_pool *pool;
    qdot_expr s, c, w, inner, deep, wide;

    (void)state;
    begin(&f);
    pool = f.pool;
    s = qdot_fun1(pool, QDOT_SIN, f.in[Q]);
    c = qdot_fun1(pool, QDOT_COS, f.in[P]);
    w = f.in[W];
    inner = qdot_add(pool, qdot_mul(pool, f.in[M], s),
                     qdot_mul(pool, qdot_expr_int(pool, -2), qdot_mul(pool, f.in[V], w)));
    code_agrees(&f, qdot_neg(pool, qdot_div(pool, inner, f.above)), "sum over a row");
    code_agrees(&f, qdot_mul(pool, f.in[M], qdot_sub(pool, c, inner)), "sum within a sum");
    code_agrees(&f, qdot_neg(pool, qdot_mul(pool, f.in[M], s)), "less one term");
    code_agrees(&f, qdot_pow(pool, qdot_add(pool, f.above, qdot_mul(pool, s, s)),
                             qdot_div(pool, QDOT_ONE, qdot_expr_int(pool, 2))),
                "root of a sum");
    deep = wide = inner;
    for (int i = 0; i < 12; i++) {
        qdot_expr more = qdot_mul(pool, f.in[i % T], i % 2 ? s : c);

        wide = qdot_add(pool, wide, qdot_mul(pool, qdot_expr_int(pool, 2 + i), more));
        deep = qdot_mul(pool, f.in[M], qdot_sub(pool, i % 2 ? s : c, deep));
    }
    code_agrees(&f, wide, "wide");
    code_agrees(&f, deep, "deep");
    qdot_pool_free(pool);
}

/* A row is there where it is an output, whoever had a program of the same steps before. */
static void
outputs_are_there(void **state)
{
    enum { TO = 20 };
    scene f;
    qdot_expr product, sum;

    (void)state;
    begin(&f);
    product = qdot_mul(f.pool, f.in[V], f.in[P]);
    sum = qdot_add(f.pool, qdot_mul(f.pool, f.in[M], product), f.in[Q]);
    for (int third = 0; third < 2; third++) {
        const qdot_expr out[] = {sum, f.above, third > 0 ? product : f.in[Q]};
        qdot_tape *tape;
        qdot_taylor *of[3];

        assert_int_equal(qdot_tape_new(f.pool, INPUTS, f.in, 3, out, &tape), QDOT_OK);
        for (int l = 0; l < 3; l++)
            of[l] = linked(tape, TO, l == 0);
        expand(of, TO, 2);
        compare(of, TO, "of three");
        for (int k = 0; k <= TO; k++)
            assert_true(fabs(qdot_taylor_output(of[0], 2)[k] - qdot_taylor_output(of[1], 2)[k])
                        <= 1e-13 * fabs(qdot_taylor_output(of[1], 2)[k]));
        for (int l = 0; l < 3; l++)
            qdot_taylor_free(of[l]);
        qdot_tape_free(tape);
    }
    qdot_pool_free(f.pool);
}

/* More vectors than registers. */
static void
long_programs_agree(void **state)
{
    scene f;
    qdot_expr e;

    (void)state;
    begin(&f);
    e = f.in[Q];
    for (int i = 0; i < 12; i++) {
        qdot_expr s = qdot_fun1(f.pool, i % 2 ? QDOT_SIN : QDOT_COS, e);

        e = qdot_add(f.pool, qdot_mul(f.pool, s, f.in[i % T]),
                     qdot_div(f.pool, e, f.above));
    }
    code_agrees(&f, e, "long program");
    qdot_pool_free(f.pool);
}

/* What was written for a program is run by the next of its shape, not by one that differs in an
 * operation or a row. */
static void
kept_code_agrees(void **state)
{
    enum { PROGRAMS = 7, TO = 20 }; /* the last two differ in what has order 0 alone */
    scene f;
    qdot_pool *pool;
    qdot_tape *tapes[PROGRAMS];

    (void)state;
    begin(&f);
    pool = f.pool;
    for (int i = 0; i < PROGRAMS; i++) {
        qdot_expr s = qdot_fun1(pool, i < 2 ? QDOT_SIN : QDOT_COS, f.in[i == 2 ? P : Q]);
        qdot_expr number = i < 5 ? qdot_expr_int(pool, 3 + i)
                                 : qdot_fun1(pool, i == 5 ? QDOT_EXP : QDOT_LOG, f.in[M]);
        qdot_expr factor = qdot_mul(pool, number, f.within);
        qdot_expr product = qdot_mul(pool, s, factor);
        qdot_expr out[] = {i == 4 ? qdot_sub(pool, product, f.in[V])
                                  : qdot_add(pool, product, f.in[V]),
                           f.within};

        assert_int_equal(qdot_tape_new(pool, INPUTS, f.in, 2, out, tapes + i), QDOT_OK);
    }
    for (int round = 0; round < 3; round++)
        for (int i = 0; i < PROGRAMS; i++) {
            qdot_taylor *beside = linked(tapes[i], TO, round == 2);
            qdot_taylor *of[] = {linked(tapes[i], TO, true), linked(tapes[i], TO, false),
                                 linked(tapes[i], TO, false)};

            expand(of, TO, 2);
            compare(of, TO, "kept code");
            if (round == 2) {
                qdot_taylor_free(of[0]);
                of[0] = beside;
                beside = NULL;
                expand(of, TO, 3);
                compare(of, TO, "kept code, another beside it");
            }
            for (int l = 0; l < 3; l++)
                qdot_taylor_free(of[l]);
            qdot_taylor_free(beside);
        }
    for (int i = 0; i < PROGRAMS; i++)
        qdot_tape_free(tapes[i]);
    qdot_pool_free(pool);
}

/* What was written for one order serves those whose loops are the same, the others not. */
static void
orders_share_code(void **state)
{
    enum { WRITTEN = 37, BESIDE = 36, FAR = 12 };
    scene f;
    qdot_expr out[2];
    qdot_tape *tape;
    qdot_taylor *of[3];

    (void)state;
    begin(&f);
    out[0] = qdot_fun1(f.pool, QDOT_SIN, qdot_mul(f.pool, f.in[Q], f.in[V]));
    out[1] = qdot_mul(f.pool, out[0], f.within);
    assert_int_equal(qdot_tape_new(f.pool, INPUTS, f.in, 2, out, &tape), QDOT_OK);
    of[0] = linked(tape, WRITTEN, true);
    for (int to = BESIDE; to > 0; to -= BESIDE - FAR) {
        qdot_taylor *other = linked(tape, to, false);

        assert_int_equal(qdot_taylor_take_kept(other, to, to),
                         to == BESIDE && qdot_taylor_may_be_code());
        qdot_taylor_free(other);
    }
    qdot_taylor_free(of[0]);
    for (int to = MOST; to > 0; to--) {
        for (int l = 0; l < 3; l++)
            of[l] = linked(tape, to, l == 0);
        expand(of, to, 2);
        compare(of, to, "from the highest order down");
        for (int l = 0; l < 3; l++)
            qdot_taylor_free(of[l]);
    }
    qdot_tape_free(tape);
    qdot_pool_free(f.pool);
}

/* Code of narrow vectors serves lower orders, if it was written for a family of orders that has them,
 * and gives the bits of the code that was written for such an order alone. */
static void
lower_orders_share_code(void **state)
{
    const bool shared = qdot_taylor_may_be_code() && qdot_asm_kind() < 2;
    scene f;
    qdot_expr out[2];
    qdot_tape *tape;

    (void)state;
    begin(&f);
    out[0] = qdot_fun1(f.pool, QDOT_COS, qdot_mul(f.pool, f.in[Q], f.in[W]));
    out[1] = qdot_mul(f.pool, out[0], f.above);
    assert_int_equal(qdot_tape_new(f.pool, INPUTS, f.in, 2, out, &tape), QDOT_OK);
    for (int to = 1; to < QDOT_TAYLOR_EXACT_FROM - 1; to++) {
        qdot_taylor *of[] = {linked(tape, to, false), linked(tape, to, false),
                             linked(tape, to, false)};

        assert_int_equal(qdot_taylor_prepare(of[0], to, to), QDOT_OK);
        assert_int_equal(qdot_taylor_prepare(of[2], QDOT_TAYLOR_EXACT_FROM - 1, 0), QDOT_OK);
        if (shared)
            assert_true(qdot_taylor_take_kept(of[1], to, QDOT_TAYLOR_EXACT_FROM - 1));
        else
            assert_int_equal(qdot_taylor_prepare(of[1], to, to), QDOT_OK);
        qdot_taylor_drop_code(of[2]);
        expand(of, to, 2);
        for (size_t i = 0; i < INPUTS + 2; i++)
            for (int k = 0; k <= to; k++)
                assert_true(row_of(of[0], i)[k] == row_of(of[1], i)[k]);
        for (int l = 0; l < 3; l++)
            qdot_taylor_free(of[l]);
    }
    qdot_tape_free(tape);
    qdot_pool_free(f.pool);
}

/* --- unknowns ----------------------------------------------------------------------- */

enum { UNKNOWNS = 5, SOLVED = 3 };

/* sum_j M_ij a_j = f_i; V is the integral of a_0, Q twice, and W that of the last one. */
typedef struct {
    qdot_taylor *t;
    size_t n;
    bool constant; /* M has numbers only */
    double M[UNKNOWNS][UNKNOWNS], L[UNKNOWNS][UNKNOWNS]; /* M_0 and its factor */
    double *matrices;
    qdot_motion motion;
    qdot_program_row f[UNKNOWNS + UNKNOWNS * (UNKNOWNS + 1) / 2]; /* outputs: f, then M by rows */
} equations;

/* Row of unknown i, order by order. */
static double *
unknown(const equations *e, size_t i)
{
    return (double *)qdot_taylor_series(e->t, e->motion.unknowns.at[i].row);
}

static size_t
entry(const equations *e, size_t i, size_t j)
{
    return e->n + (i < j ? j * (j + 1) / 2 + i : i * (i + 1) / 2 + j);
}

static void
make_motion(equations *e, const qdot_tape *tape)
{
    qdot_motion *m = &e->motion;
    qdot_program_row in[INPUTS], a[UNKNOWNS];
    qdot_program_builder *b;

    assert_int_equal(qdot_program_begin(INPUTS, MOVING, false, &m->program, &b), QDOT_OK);
    for (qdot_program_row i = 0; i < INPUTS; i++)
        in[i] = i;
    qdot_program_append(b, tape, in, e->f);
    for (size_t i = 0; i < e->n + e->n * (e->n + 1) / 2; i++)
        assert_int_equal(qdot_vec_push(&m->program.outputs, e->f[i]), QDOT_OK);
    for (size_t i = 0; i < e->n; i++)
        a[i] = qdot_program_unknown(b);
    for (uint32_t i = 0; i < e->n && !e->constant; i++)
        for (uint32_t j = 0; j <= i; j++)
            assert_int_equal(
                qdot_vec_push(&m->entries, ((qdot_motion_entry){i, j, e->f[entry(e, i, j)]})),
                QDOT_OK);
    for (size_t i = 0; i < e->n; i++) {
        const qdot_motion_unknown u = {
            .row = a[i],
            .once = i == 0 ? V : i + 1 == e->n ? W : QDOT_NO_ROW,
            .twice = i == 0 ? Q : QDOT_NO_ROW};

        /* what writes the equation is left out in any case */
        m->written++;
        assert_int_equal(qdot_vec_push(&m->right, e->f[i]), QDOT_OK);
        assert_int_equal(
            qdot_motion_solve(m, u, qdot_program_operation(b, QDOT_OP_NEG, a[i], 0, 0)), QDOT_OK);
    }
    assert_int_equal(qdot_motion_end_block(m), QDOT_OK);
    if (e->n == 1)
        assert_int_equal(qdot_motion_give(m, a[0], W, QDOT_NO_ROW), QDOT_OK);
    assert_int_equal(qdot_motion_give(m, W, P, QDOT_NO_ROW), QDOT_OK);
    assert_int_equal(qdot_motion_complete(m, b, QDOT_OK), QDOT_OK);
}

static void
make_equations(equations *e, const qdot_tape *tape, size_t n, bool constant, int to,
               bool code)
{
    *e = (equations){.n = n, .constant = constant};
    make_motion(e, tape);
    assert_int_equal(
        qdot_taylor_of_motion(&e->motion, false, QDOT_SERIES_MOST - 1, SOLVED, &e->t), QDOT_OK);
    e->matrices = qdot_taylor_matrices(e->t, 0);
    if (code)
        assert_int_equal(qdot_taylor_prepare(e->t, to, to + 2), QDOT_OK);
}

/* x becomes M_0^-1 x. */
static void
solve_zero(const equations *e, double *x)
{
    for (size_t i = 0; i < e->n; i++) {
        for (size_t j = 0; j < i; j++)
            x[i] -= e->L[i][j] * x[j];
        x[i] /= e->L[i][i];
    }
    for (size_t i = e->n; i-- > 0;) {
        for (size_t j = i + 1; j < e->n; j++)
            x[i] -= e->L[j][i] * x[j];
        x[i] /= e->L[i][i];
    }
}

static void
factor_zero(equations *e)
{
    const size_t n = e->n;

    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++) {
            double sum = e->M[i][j];

            for (size_t k = 0; k < j; k++)
                sum -= e->L[i][k] * e->L[j][k];
            e->L[i][j] = i == j ? sqrt(sum) : sum / e->L[j][j];
        }
    for (size_t i = 0; i < n; i++) {
        double unit[UNKNOWNS] = {0};

        for (size_t j = 0; j < n; j++)
            e->matrices[i * n + j] = j <= i ? e->L[i][j] : NAN;
        unit[i] = 1;
        solve_zero(e, unit);
        memcpy(e->matrices + (n + i) * n, unit, n * sizeof *unit);
    }
}

/* Order k of the unknowns, by the definition. */
static void
solve_order(const equations *e, int k)
{
    double x[UNKNOWNS];

    for (size_t i = 0; i < e->n; i++) {
        x[i] = qdot_taylor_output(e->t, i)[k];
        for (size_t j = 0; j < e->n && !e->constant; j++)
            for (int m = 1; m <= k; m++)
                x[i] -= qdot_taylor_output(e->t, entry(e, i, j))[m] * unknown(e, j)[k - m];
    }
    solve_zero(e, x);
    for (size_t i = 0; i < e->n; i++)
        unknown(e, i)[k] = x[i];
}

static void
expand_equations(equations *e, int to, double unit, double moved, bool code)
{
    for (size_t i = 0; i < MOVING; i++)
        for (int k = to + 3; k <= QDOT_SERIES_MOST; k++)
            qdot_taylor_input(e->t, i)[k] = 1e9;
    start(e->t, unit, moved);
    qdot_taylor_order(e->t, 0);
    for (size_t i = 0; i < e->n; i++)
        for (size_t j = 0; j < e->n; j++)
            e->M[i][j] = e->constant ? (i == j ? 3.5 : 0.25)
                                     : qdot_taylor_output(e->t, entry(e, i, j))[0];
    factor_zero(e);
    solve_order(e, 0);
    qdot_taylor_begin_links(e->t, unit);
    if (code) {
        qdot_taylor_extend(e->t, 1, to);
        return;
    }
    for (int k = 1; k <= to; k++) {
        double *v = qdot_taylor_input(e->t, V), *w = qdot_taylor_input(e->t, W);

        qdot_taylor_order(e->t, k);
        solve_order(e, k);
        v[k + 1] = unit / (k + 1) * unknown(e, 0)[k];
        w[k + 1] = unit / (k + 1) * unknown(e, e->n - 1)[k];
        qdot_taylor_input(e->t, Q)[k + 2] = unit / (k + 2) * v[k + 1];
        qdot_taylor_input(e->t, P)[k + 1] = unit / (k + 1) * w[k];
    }
}

/* f, then M by rows: what is on its diagonal moves or, every third, does not. */
static void
outputs_of(scene *f, size_t n, qdot_expr *out)
{
    qdot_pool *pool = f->pool;

    for (size_t i = 0; i < n; i++)
        out[i] = i % 2 ? qdot_fun1(pool, QDOT_SIN, qdot_mul(pool, qdot_expr_int(pool, (int64_t)i),
                                                            f->in[Q]))
                       : qdot_mul(pool, f->in[V], f->in[i % T]);
    out += n;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++) {
            const qdot_expr part = qdot_expr_int(pool, (int64_t)(1 + i + j));

            if (i == j)
                *out++ = i % 3 ? qdot_add(pool, part, qdot_add(pool, part, f->above))
                               : qdot_expr_int(pool, 3);
            else
                *out++ = qdot_div(pool, (i + j) % 2 ? qdot_fun1(pool, QDOT_COS, f->in[P])
                                                    : f->within,
                                  part);
        }
}

static void
unknowns_agree(void **state)
{
    qdot_expr out[UNKNOWNS + UNKNOWNS * (UNKNOWNS + 1) / 2];
    scene f;

    (void)state;
    begin(&f);
    for (size_t n = 1; n <= UNKNOWNS; n++) {
        qdot_tape *tape;

        outputs_of(&f, n, out);
        assert_int_equal(
            qdot_tape_new(f.pool, INPUTS, f.in, n + n * (n + 1) / 2, out, &tape), QDOT_OK);
        for (int to = 1; to <= MOST; to += n < 3 ? 1 : 5)
            for (int constant = 0; constant < 2; constant++) {
                equations e[3];
                qdot_taylor *of[3];
                const char *why;

                for (int l = 0; l < 3; l++) {
                    make_equations(e + l, tape, n, constant, to, l == 0);
                    of[l] = e[l].t;
                }
                for (int unit = 2; unit <= 3; unit++) {
                    for (int l = 0; l < 3; l++)
                        expand_equations(e + l, to, unit, l < 2 ? 1 : 1 + 1e-12,
                                         qdot_taylor_code_bytes(of[l], &why) > 0);
                    compare(of, to, constant ? "constant unknowns" : "unknowns");
                }
                for (int l = 0; l < 3; l++) {
                    qdot_taylor_free(of[l]);
                    qdot_motion_clear(&e[l].motion);
                }
            }
        qdot_tape_free(tape);
    }
    qdot_pool_free(f.pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(there_is_code_or_a_reason),
        cmocka_unit_test(functions_agree),
        cmocka_unit_test(arithmetic_agrees),
        cmocka_unit_test(folded_agrees),
        cmocka_unit_test(outputs_are_there),
        cmocka_unit_test(long_programs_agree),
        cmocka_unit_test(kept_code_agrees),
        cmocka_unit_test(orders_share_code),
        cmocka_unit_test(lower_orders_share_code),
        cmocka_unit_test(unknowns_agree),
    };

    int failed = cmocka_run_group_tests(tests, NULL, NULL);

    for (size_t kind = qdot_asm_kind(); kind > 0; kind--) {
        qdot_kind_limit(kind - 1);
        failed += cmocka_run_group_tests(tests, NULL, NULL);
    }
    return failed;
}
