/* test_lanes-code.c -- machine code in lanes against the kernels: every recurrence, every
 * number of orders, every kind of processor that is here and has code.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "expr/calculus.h"
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

/* What is written: the steps, at once or in two parts; two sums of products of outputs. */
typedef struct {
    const scene *scene;
    qdot_lanes *lanes;
    bool parts;
    int from, late, loop, to;
} plan;

static double
half(int k)
{
    return 0.5 * k;
}

static qdot_lanes_row
output(const qdot_lanes_writer *w, const plan *p, size_t i)
{
    return qdot_lanes_row_of(w, qdot_lanes_output(p->lanes, i));
}

/* Row 0: all of sum_{j=1..k-1} a_j b_{k-j} + b_j b_{k-j}, times k/2, less 3 and number 0. */
static void
order(qdot_lanes_writer *w, int k, void *user)
{
    const plan *p = user;
    const qdot_lanes_pair pairs[] = {{output(w, p, 0), output(w, p, 2)},
                                     {output(w, p, 2), output(w, p, 2)}};
    qdot_lanes_sum sum, other = QDOT_LANES_NOTHING;

    if (p->parts) {
        const qdot_lanes_row in[] = {qdot_lanes_row_of(w, qdot_lanes_input(p->lanes, 0)),
                                     qdot_lanes_row_of(w, qdot_lanes_input(p->lanes, 1))};
        const qdot_lanes_row wanted[] = {output(w, p, 0), output(w, p, 13)};

        qdot_lanes_steps_without(w, k, 2, in, 2, wanted);
        qdot_lanes_steps_with(w, k);
    } else {
        qdot_lanes_steps(w, k);
    }
    sum = qdot_lanes_dots(w, 2, pairs, k);
    qdot_lanes_scale(w, &sum, qdot_lanes_scalar_of(w, half, k));
    qdot_lanes_negate(w, &sum);
    qdot_lanes_add(w, &sum, false, qdot_lanes_scalar(w, 3));
    qdot_lanes_add(w, &other, true, qdot_lanes_number(w, 0));
    qdot_lanes_add_scaled(w, &sum, other, qdot_lanes_scalar(w, 1));
    qdot_lanes_store(w, sum, (qdot_lanes_at){qdot_lanes_further_row(w, 0), k});
}

static void
write_orders(qdot_lanes_writer *w, void *user)
{
    plan *p = user;

    for (size_t i = 0; i < p->scene->n; i++)
        qdot_lanes_keep(w, output(w, p, i));
    qdot_lanes_keep(w, qdot_lanes_further_row(w, 0));
    qdot_lanes_orders(w, p->from, p->late, p->loop, p->to, order, user);
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

static double
sum_of_products(const qdot_lanes *lanes, size_t l, int k)
{
    const double *a = qdot_lanes_output(lanes, 0), *b = qdot_lanes_output(lanes, 2);
    double sum = 0;

    for (size_t j = 1; j < (size_t)k; j++)
        sum += (a[j * L + l] + b[j * L + l]) * b[((size_t)k - j) * L + l];
    return 3 - 0.5 * k * sum - (double)l;
}

static void
compare(const plan *p, const qdot_lanes_code *code, const qdot_lanes *kernels)
{
    for (size_t l = 0; l < L; l++) {
        double size = 1;

        for (size_t i = 0; i < p->scene->n; i++, size = 1)
            for (int k = 0; k <= p->to; k++)
                agree(qdot_lanes_output(p->lanes, i)[(size_t)k * L + l],
                      qdot_lanes_output(kernels, i)[(size_t)k * L + l], &size, "output",
                      i, l, k, p);
        for (int k = p->from; k <= p->to; k++)
            agree(qdot_lanes_code_row(code, 0)[(size_t)k * L + l],
                  sum_of_products(kernels, l, k), &size, "sum", 0, l, k, p);
    }
}

static void
code_agrees_with_kernels(const scene *f, const qdot_tape *tape, plan p)
{
    qdot_lanes *kernels;
    qdot_lanes_code *code;

    p.scene = f;
    assert_int_equal(qdot_lanes_new_moving(tape, MOST + 2, MOVING, &p.lanes), QDOT_OK);
    assert_int_equal(qdot_lanes_new_moving(tape, MOST + 2, MOVING, &kernels), QDOT_OK);
    assert_int_equal(qdot_lanes_code_new(p.lanes, 1, 1, write_orders, &p, &code),
                     QDOT_OK);
    assert_true((code != NULL) == qdot_lanes_may_be_code());
    if (code) {
        for (size_t l = 0; l < L; l++)
            qdot_lanes_code_number(code, 0)[l] = (double)l;
        for (int again = 0; again < 2; again++) { /* nothing is left of the first time */
            fill(p.lanes, &p, 0.01 * again);
            fill(kernels, &p, 0.01 * again);
            for (int k = p.from; k <= p.to; k++)
                qdot_lanes_order(kernels, k);
            qdot_lanes_code_run(code);
            compare(&p, code, kernels);
        }
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

    (void)state;
    begin(&f);
    assert_int_equal(qdot_tape_new(f.pool, INPUTS, f.in, f.n, f.out, &tape), QDOT_OK);
    for (size_t kind = 0; kind < 3; kind++) {
        qdot_kind_limit(kind);
        if (kind == 0)
            assert_false(qdot_lanes_may_be_code());
        for (int to = 1; to <= MOST; to += to < 9 ? 1 : 5)
            for (int parts = 0; parts < 2; parts++)
                for (int late = 0; late <= 2; late++)
                    code_agrees_with_kernels(&f, tape,
                                             (plan){.parts = parts,
                                                    .from = 1 + 2 * parts,
                                                    .late = late,
                                                    .loop = 4 * late,
                                                    .to = to + 2 * parts});
    }
    qdot_kind_limit(2);
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
