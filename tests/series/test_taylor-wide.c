/* test_taylor-wide.c -- a program by vectors against the same one by numbers. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "series/kit.h"
#include "series/taylor-wide.h"

enum { N = 11, TIME = N, INPUTS, ORDERS = 24, MOST = 40 };

typedef struct {
    qdot_pool *pool;
    qdot_expr in[INPUTS];
    qdot_vec(qdot_expr) out;
    qdot_tape *tape;
} scene;

static void
push(scene *f, qdot_expr e)
{
    assert_int_equal(qdot_vec_push(&f->out, e), QDOT_OK);
}

static void
begin(scene *f)
{
    char name[16];

    *f = (scene){.pool = qdot_pool_new()};
    for (int i = 0; i < N; i++) {
        snprintf(name, sizeof name, "q%d", i);
        f->in[i] = qdot_symbol_get(f->pool, QDOT_PARAM, name);
    }
    f->in[TIME] = QDOT_T;
}

/* Every function of s and c, the sine and cosine of a coordinate, within its domain. */
static void
fill_functions(scene *f, qdot_expr s, qdot_expr c)
{
    static const struct {
        qdot_fun_id function;
        int at; /* its argument is s/2 + at */
    } functions[] = {{QDOT_EXP, 0},   {QDOT_SINH, 0},  {QDOT_COSH, 0},  {QDOT_TANH, 0},
                     {QDOT_LOG, 1},   {QDOT_ASIN, 0},  {QDOT_ACOS, 0},  {QDOT_ATAN, 0},
                     {QDOT_ASINH, 0}, {QDOT_ACOSH, 2}, {QDOT_ATANH, 0}, {QDOT_ERF, 0},
                     {QDOT_ERFC, 0}};
    qdot_pool *pool = f->pool;
    const qdot_expr half = qdot_div(pool, s, qdot_expr_int(pool, 2));
    const qdot_expr above = qdot_add(pool, c, qdot_expr_int(pool, 2)); /* 1 or more */
    const qdot_expr third = qdot_div(pool, QDOT_ONE, qdot_expr_int(pool, 3));

    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        push(f, qdot_fun1(pool, functions[i].function,
                          qdot_add(pool, half, qdot_expr_int(pool, functions[i].at))));
    push(f, qdot_div(pool, s, above));
    push(f, qdot_pow(pool, above, third));
    push(f, qdot_pow(pool, above, s));
    push(f, qdot_pow(pool, above, qdot_div(pool, QDOT_ONE, qdot_expr_int(pool, 2))));
    push(f, qdot_fun(pool, QDOT_ATAN2, 2, (qdot_expr[]){s, above}));
}

/* Every recurrence, of neighbours and of what is far apart. */
static void
fill(scene *f)
{
    qdot_pool *pool = f->pool;

    for (int i = 0; i < N; i++) {
        const qdot_expr q = f->in[i], other = f->in[(3 * i + 1) % N];
        const qdot_expr s = qdot_fun1(pool, QDOT_SIN, q),
                        c = qdot_fun1(pool, QDOT_COS, q);
        const qdot_expr far = qdot_fun1(pool, QDOT_COS, other);
        const qdot_expr third =
            qdot_div(pool, qdot_expr_int(pool, i + 1), qdot_expr_int(pool, 3));
        const qdot_expr sf = qdot_mul(pool, s, far);

        push(f, qdot_neg(pool, c));
        push(f, sf);
        push(f, qdot_mul(pool, third, s));
        push(f, qdot_pow_int(pool, s, 2));
        push(f, qdot_add(pool, sf, other));
        push(f, qdot_sub(pool, sf, other));
        push(f, qdot_sub(pool, other, sf));
        push(f, qdot_add(pool, qdot_mul(pool, third, far), q));
        push(f, qdot_sub(pool, qdot_mul(pool, third, far), q));
        push(f, qdot_sub(pool, q, qdot_mul(pool, third, far)));
        push(f, qdot_add(pool, s, far));
        push(f, qdot_sub(pool, s, far));
        push(f, qdot_fun1(pool, QDOT_SIN,
                          qdot_add(pool, qdot_mul(pool, third, sf), QDOT_T)));
        fill_functions(f, s, far);
    }
    assert_int_equal(qdot_tape_new(pool, INPUTS, f->in, f->out.n, f->out.at, &f->tape),
                     QDOT_OK);
}

static void
end(scene *f)
{
    qdot_tape_free(f->tape);
    qdot_free(f->out.at);
    qdot_pool_free(f->pool);
}

static void
compare(const scene *f, qdot_taylor *t, const qdot_taylor_wide *w, int k)
{
    const double *now = qdot_taylor_wide_at(w, k);

    for (size_t i = 0; i < f->out.n; i++) {
        const double *row = qdot_taylor_output(t, i);
        const double x = now[qdot_taylor_wide_lane(w, row)];
        double size = 1e-3;

        for (int j = 0; j <= k; j++)
            size = fmax(size, fabs(row[j]));
        if (!(fabs(x - row[k]) <= 1e-13 * size))
            fail_msg("output %zu, order %d: %.17g, not %.17g", i, k, x, row[k]);
    }
}

static void
begin_wide(scene *f, qdot_taylor **t, qdot_taylor_wide **w)
{
    begin(f);
    fill(f);
    assert_int_equal(taylor_of_tape(f->tape, MOST, t), QDOT_OK);
    assert_int_equal(qdot_taylor_wide_new(*t, N, NULL, 0, w), QDOT_OK);
    assert_non_null(*w);
}

static void
vectors_agree(void **state)
{
    size_t lanes[N], at;
    qdot_taylor *t;
    qdot_taylor_wide *w;
    scene f;

    (void)state;
    begin_wide(&f, &t, &w);
    for (size_t i = 0; i < N; i++)
        lanes[i] =
            i == 4 ? SIZE_MAX
                   : qdot_taylor_wide_lane(w, qdot_taylor_output(t, 17 * i % f.out.n));
    assert_int_equal(qdot_taylor_wide_align(w, N, lanes, &at), QDOT_OK);
    assert_int_equal(at % QDOT_WIDE_LANES, 0);
    assert_int_equal(qdot_taylor_wide_settle(w), QDOT_OK);
    for (int turn = 0; turn < 2; turn++) /* what is left of the first does not matter */
        for (int k = 0; k <= ORDERS; k++) {
            double newest[N];

            for (size_t i = 0; i < N; i++) {
                newest[i] = cos((double)(i + 7) * (k + 1 + 3 * turn)) / (k + 1);
                qdot_taylor_input(t, i)[k] = newest[i];
            }
            qdot_taylor_input(t, TIME)[k] = k == 0 ? 0.3 : k == 1;
            qdot_taylor_order(t, k);
            if (k == 0) {
                qdot_taylor_input(t, TIME)[1] = 1;
                qdot_taylor_wide_begin(w, t);
            } else {
                qdot_taylor_wide_order(w, k);
                qdot_taylor_wide_correct(w, k, newest, 1);
            }
            compare(&f, t, w, k);
            for (size_t i = 0; i < N; i++)
                assert_true(qdot_taylor_wide_at(w, k)[at + i] ==
                            (i == 4 ? 0 : qdot_taylor_wide_at(w, k)[lanes[i]]));
        }
    qdot_taylor_wide_free(w);
    qdot_taylor_free(t);
    end(&f);
}

static void
sums_are_sums(void **state)
{
    enum { WIDTH = 16, TERMS = 5 };
    double x[3 * WIDTH * TERMS], y[3 * WIDTH * TERMS], out[8];
    const double from[8] = {0, 1, 2, 3, 5, 8, 13, 21};
    qdot_taylor *t;
    qdot_taylor_wide *w;
    scene f;

    (void)state;
    begin_wide(&f, &t, &w);
    for (size_t i = 0; i < sizeof x / sizeof *x; i++) {
        x[i] = (double)(i * 37 % 101);
        y[i] = (double)(i * 53 % 97) - 40;
    }
    for (size_t pairs = 1; pairs <= 3; pairs++)
        for (size_t n = 1; n <= TERMS; n++) {
            qdot_wide_pair pair[3];

            for (size_t p = 0; p < pairs; p++)
                pair[p] = (qdot_wide_pair){x + p * WIDTH * TERMS,
                                           y + p * WIDTH * TERMS + (n - 1) * WIDTH};
            qdot_taylor_wide_rest(w, &(qdot_wide_sum){pairs, pair, n, WIDTH, WIDTH}, 2,
                                  n % 2 ? from : NULL, out);
            for (size_t l = 0; l < 8; l++) {
                double sum = n % 2 ? -2 * from[l] : 0;

                for (size_t p = 0; p < pairs; p++)
                    for (size_t j = 0; j < n; j++)
                        sum += pair[p].x[j * WIDTH + l] * (pair[p].y - j * WIDTH)[l];
                assert_true(out[l] == -sum);
            }
        }
    qdot_taylor_wide_free(w);
    qdot_taylor_free(t);
    end(&f);
}

static void
too_few_alike_have_none(void **state)
{
    qdot_taylor *t;
    qdot_taylor_wide *w;
    scene f;

    (void)state;
    begin(&f);
    push(&f, qdot_mul(f.pool, qdot_fun1(f.pool, QDOT_SIN, f.in[0]), f.in[1]));
    assert_int_equal(qdot_tape_new(f.pool, INPUTS, f.in, f.out.n, f.out.at, &f.tape),
                     QDOT_OK);
    assert_int_equal(taylor_of_tape(f.tape, MOST, &t), QDOT_OK);
    assert_int_equal(qdot_taylor_wide_new(t, N, NULL, 0, &w), QDOT_OK);
    assert_null(w);
    qdot_taylor_free(t);
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vectors_agree),
        cmocka_unit_test(sums_are_sums),
        cmocka_unit_test(too_few_alike_have_none),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
