/* test_lanes-code.c -- machine code in lanes, and of one lane, against the kernels: every recurrence,
 * every number of orders, every kind of processor that is here and has code.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "num/kinds.h"
#include "series/lanes-code.h"

enum { L = QDOT_LANES, INPUTS = 4, MOVING = 3, MOST_OUT = 64, MOST = 30 };

/* Functions of x, u, t, which move, and m, which does not: 0 < x < 1 < u. */
typedef struct {
    qdot_pool *pool;
    qdot_expr in[INPUTS], out[MOST_OUT];
    size_t n;
} scene;

static void
push(scene *f, qdot_expr e)
{
    assert_true(f->n < MOST_OUT);
    f->out[f->n++] = e;
}

static void
begin(scene *f)
{
    static const qdot_fun_id functions[] = {QDOT_SIN,  QDOT_COS,   QDOT_ASIN, QDOT_ACOS,
                                            QDOT_ATAN, QDOT_SINH,  QDOT_COSH, QDOT_TANH,
                                            QDOT_EXP,  QDOT_ASINH, QDOT_ATANH, QDOT_ERF,
                                            QDOT_ERFC};
    static const char *const names[] = {"x", "u", "t", "m"};
    qdot_pool *pool = f->pool = qdot_pool_new();
    qdot_expr x, u, t, m, s, e, third = qdot_expr_ratio(pool, 1, 3);

    for (size_t i = 0; i < INPUTS; i++)
        f->in[i] = i == 2 ? QDOT_T : qdot_symbol_get(pool, QDOT_PARAM, names[i]);
    x = f->in[0], u = f->in[1], t = f->in[2], m = f->in[3];
    f->n = 0;
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        push(f, qdot_fun1(pool, functions[i], x));
    s = qdot_fun1(pool, QDOT_SIN, u);
    e = qdot_fun1(pool, QDOT_EXP, x);
    push(f, qdot_fun1(pool, QDOT_LOG, u));
    push(f, qdot_fun1(pool, QDOT_ACOSH, u));
    push(f, qdot_mul(pool, s, e));
    push(f, qdot_div(pool, s, e));
    push(f, qdot_div(pool, e, m));
    push(f, qdot_pow_int(pool, s, 2));
    push(f, qdot_pow_int(pool, u, -3));
    push(f, qdot_sqrt(pool, u));
    push(f, qdot_pow(pool, u, third));
    push(f, qdot_pow(pool, u, x));
    push(f, qdot_sub(pool, qdot_mul(pool, s, e), qdot_mul(pool, e, t)));
    push(f, qdot_sub(pool, x, qdot_mul(pool, s, t)));
    push(f, qdot_sub(pool, qdot_mul(pool, s, t), x));
    push(f, qdot_add(pool, qdot_mul(pool, s, u), x));
    push(f, qdot_add(pool, t, qdot_mul(pool, m, s)));
    push(f, qdot_sub(pool, t, qdot_mul(pool, m, e)));
    push(f, qdot_sub(pool, qdot_mul(pool, m, e), u));
    push(f, qdot_mul(pool, m, qdot_fun1(pool, QDOT_COS, m)));
    push(f, qdot_neg(pool, s));
    push(f, qdot_fun(pool, QDOT_ATAN2, 2, (qdot_expr[]){s, e}));
}

/* In lane l: coefficients of x, u, t; of m that of order 0 alone. */
static double
coefficient(size_t i, size_t l, int k)
{
    const double more = 1e-3 * (double)((l * 31 + i * 17 + (size_t)k * 7) % 11);
    static const double zero[INPUTS] = {0.1, 1.2, 0.25, 1.7},
                        lanes[INPUTS] = {0.1, 0.3, 0, 0.2};

    if (k == 0)
        return zero[i] + lanes[i] * (double)l;
    if (i == 2)
        return k == 1;
    return i == 3 ? 0 : k < 4 ? 0.3 / k - 0.1 * (double)i + more : more * pow(0.5, k);
}

/* What is written: the steps; lanes, or one of them. */
typedef struct {
    const scene *scene;
    qdot_lanes *lanes;
    qdot_lanes_rows one; /* that one's rows */
    int from, late, loop, to;
} plan;

static void
order(qdot_lanes_writer *w, int k, void *user)
{
    (void)user;
    qdot_lanes_steps(w, k);
}

static void
write_orders(qdot_lanes_writer *w, void *user)
{
    plan *p = user;

    for (size_t i = 0; i < p->scene->n; i++)
        qdot_lanes_keep(w, qdot_lanes_get_rows(p->lanes).program->outputs.at[i]);
    qdot_lanes_orders(w, p->from, p->late, p->loop, p->to, order, p);
}

/* Inputs, moved by a little, and orders below `from` by the kernels. */
static void
fill(qdot_lanes *lanes, const plan *p, double moved)
{
    double t[L];

    for (size_t i = 0; i < INPUTS; i++)
        for (int k = 0; k <= (i < MOVING ? p->to + 1 : 0); k++)
            for (size_t l = 0; l < L; l++)
                qdot_lanes_input(lanes, i)[(size_t)k * L + l] =
                    coefficient(i, l, k) + (k < 4 && i < 2 ? moved : 0);
    for (size_t l = 0; l < L; l++)
        t[l] = 0.25;
    qdot_lanes_draw(lanes, t);
    for (int k = 0; k < p->from; k++)
        qdot_lanes_order(lanes, k);
}

static void
agree(double seen, double want, double *size, const char *what, size_t i, size_t l, int k,
      const plan *p)
{
    *size = fmax(*size, fabs(want));
    if (!(fabs(seen - want) <= 1e-12 * *size))
        fail_msg("%s %zu, lane %zu, order %d of %d, late %d: %.17g, not %.17g", what,
                 i, l, k, p->to, p->late, seen, want);
}

/* Coefficients up to order `from` of lane l, as rows of one double. */
static void
take_lane(const qdot_lanes_rows *from, qdot_lanes_rows *to, size_t l)
{
    const size_t doubles = from->program->rows.n * from->stride + from->program->length;

    *to = *from;
    to->group = 1;
    to->coefficients = calloc(doubles, sizeof *to->coefficients);
    assert_non_null(to->coefficients);
    for (size_t i = 0; i < doubles; i++)
        to->coefficients[i] = from->coefficients[i * L + l];
}

static void
compare(const plan *p, const qdot_lanes *kernels)
{
    for (size_t l = 0; l < L; l++)
        for (size_t i = 0; i < p->scene->n; i++) {
            double size = 1;

            for (int k = 0; k <= p->to; k++)
                agree(qdot_lanes_output(p->lanes, i)[(size_t)k * L + l],
                      qdot_lanes_output(kernels, i)[(size_t)k * L + l], &size, "output",
                      i, l, k, p);
        }
}

static void
compare_one(const plan *p, const qdot_lanes *kernels, size_t l)
{
    for (size_t i = 0; i < p->scene->n; i++) {
        const double *row =
            p->one.coefficients + p->one.program->outputs.at[i] * p->one.stride;
        double size = 1;

        for (int k = 0; k <= p->to; k++)
            agree(row[k], qdot_lanes_output(kernels, i)[(size_t)k * L + l], &size,
                  "output", i, l, k, p);
    }
}

/* Lane 3 alone. */
static void
one_agrees(plan *p, const qdot_lanes *kernels)
{
    const qdot_lanes_rows rows = qdot_lanes_get_rows(p->lanes);
    qdot_lanes_code *code;

    fill(p->lanes, p, 0.01);
    take_lane(&rows, &p->one, 3);
    assert_int_equal(qdot_lanes_code_new(&p->one, 0, write_orders, p, &code), QDOT_OK);
    assert_non_null(code);
    qdot_lanes_code_run(code);
    compare_one(p, kernels, 3);
    qdot_lanes_code_free(code);
    free(p->one.coefficients);
}

static void
code_agrees_with_kernels(const scene *f, const qdot_program *program, plan p)
{
    qdot_lanes *kernels;
    qdot_lanes_code *code;
    qdot_lanes_rows rows;

    p.scene = f;
    assert_int_equal(qdot_lanes_of_program(program, false, MOST + 2, &p.lanes), QDOT_OK);
    assert_int_equal(qdot_lanes_of_program(program, false, MOST + 2, &kernels), QDOT_OK);
    rows = qdot_lanes_get_rows(p.lanes);
    assert_int_equal(qdot_lanes_code_new(&rows, 0, write_orders, &p, &code), QDOT_OK);
    assert_true((code != NULL) == qdot_lanes_may_be_code());
    if (code) {
        for (int again = 0; again < 2; again++) { /* nothing is left of the first time */
            fill(p.lanes, &p, 0.01 * again);
            fill(kernels, &p, 0.01 * again);
            for (int k = p.from; k <= p.to; k++)
                qdot_lanes_order(kernels, k);
            qdot_lanes_code_run(code);
            compare(&p, kernels);
        }
        one_agrees(&p, kernels);
    }
    qdot_lanes_code_free(code);
    qdot_lanes_free(p.lanes);
    qdot_lanes_free(kernels);
}

static void
every_order_agrees_with_the_kernels(void **state)
{
    scene f;
    qdot_tape *tape;
    qdot_program program;

    (void)state;
    begin(&f);
    assert_int_equal(qdot_tape_new(f.pool, INPUTS, f.in, f.n, f.out, &tape), QDOT_OK);
    assert_int_equal(qdot_program_init(tape, MOVING, false, &program), QDOT_OK);
    for (size_t kind = 0; kind < 3; kind++) {
        qdot_kind_limit(kind);
        if (kind == 0)
            assert_false(qdot_lanes_may_be_code());
        for (int to = 1; to <= MOST; to += to < 9 ? 1 : 5)
            for (int late = 0; late <= 2; late++)
                code_agrees_with_kernels(&f, &program,
                                         (plan){.from = 1 + late,
                                                .late = late,
                                                .loop = 4 * late,
                                                .to = to + late});
    }
    qdot_kind_limit(2);
    qdot_program_clear(&program);
    qdot_tape_free(tape);
    qdot_pool_free(f.pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_order_agrees_with_the_kernels),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
