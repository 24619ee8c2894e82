/* test_lanes.c -- eight at once against one at a time: every operation, every recurrence,
 * every kind of processor that is here. */
#include "tape/reference.h"
#include "series/kit.h"
#include "series/operations.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num/kinds.h"
#include "num/series.h"
#include "series/lanes.h"

enum { L = QDOT_LANES, ORDERS = 14 };

static void
with_switches(fixture *f)
{
    qdot_pool *pool;
    qdot_expr x, u, less;

    smooth(f, false);
    pool = f->pool;
    x = f->in[0];
    u = f->in[1];
    less = qdot_rel(pool, QDOT_LT, x, f->in[2]);
    push(f, apply(f, QDOT_ABS, qdot_sub(pool, x, f->in[2])));
    push(f, apply(f, QDOT_SIGN, qdot_sub(pool, x, f->in[2])));
    push(f, apply(f, QDOT_FLOOR, qdot_mul(pool, u, qdot_expr_int(pool, 5))));
    push(f, qdot_fun(pool, QDOT_MOD, 2, (qdot_expr[]){u, x}));
    push(f, qdot_fun(pool, QDOT_MIN, 2, (qdot_expr[]){f->in[2], x}));
    push(f, qdot_fun(pool, QDOT_MAX, 2, (qdot_expr[]){f->in[2], x}));
    push(f, qdot_fun(pool, QDOT_IF, 3, (qdot_expr[]){less, x, u}));
}

static void
start(double *in, size_t l)
{
    in[0] = 0.1 + 0.1 * (double)l;
    in[1] = 1.2 + 0.3 * (double)l;
    in[2] = 0.25;
}

/* Bit for bit: no lane is computed otherwise than alone. */
static void
values_are_those_of_one_at_a_time(void **state)
{
    fixture f;
    qdot_tape *tape;
    double in[3 * L], out[MOST_OUT * L], one[3], alone[MOST_OUT], *work;

    (void)state;
    with_switches(&f);
    assert_int_equal(qdot_tape_new(f.pool, 3, f.in, f.n, f.out, &tape), QDOT_OK);
    work = malloc(qdot_tape_work(tape) * L * sizeof *work);
    for (size_t kind = 0; kind < 3; kind++) {
        qdot_kind_limit(kind);
        for (size_t l = 0; l < L; l++) {
            start(one, l);
            for (size_t i = 0; i < 3; i++)
                in[i * L + l] = one[i];
        }
        qdot_lanes_eval(tape, in, out, work);
        for (size_t l = 0; l < L; l++) {
            start(one, l);
            qdot_tape_eval(tape, one, alone, work);
            for (size_t i = 0; i < f.n; i++)
                if (out[i * L + l] != alone[i])
                    fail_msg("output %zu, lane %zu: %.17g, not %.17g", i, l,
                             out[i * L + l], alone[i]);
        }
    }
    qdot_kind_limit(2);
    free(work);
    qdot_tape_free(tape);
    qdot_pool_free(f.pool);
}

/* One row of inputs: x = x0 + 0.3 s, u = u0 - 0.2 s + 0.1 s^2, t = t0 + s. */
static double
coefficient(const double *one, size_t i, int k)
{
    static const double more[3][2] = {{0.3, 0}, {-0.2, 0.1}, {1, 0}};

    return k == 0 ? one[i] : k < 3 ? more[i][k - 1] : 0;
}

/* The same with the newest coefficients of the inputs brought in late. */
static void
late_coefficients_come_in(const fixture *f, const qdot_program *program,
                          const qdot_lanes *seen)
{
    qdot_lanes *late;
    double one[3], newest[3 * L];

    assert_int_equal(qdot_lanes_of_program(program, false, ORDERS, &late), QDOT_OK);
    for (int k = 0; k <= ORDERS; k++) {
        for (size_t i = 0; i < 3; i++)
            for (size_t l = 0; l < L; l++) {
                start(one, l);
                newest[i * L + l] = coefficient(one, i, k);
                qdot_lanes_input(late, i)[(size_t)k * L + l] = k ? 0 : newest[i * L + l];
            }
        qdot_lanes_order(late, k);
        if (k > 0)
            qdot_lanes_correct(late, k, 3, newest);
    }
    for (size_t i = 0; i < f->n; i++)
        for (size_t l = 0; l < L; l++) {
            double size = 1;

            for (size_t k = 0; k <= ORDERS; k++) {
                double want = qdot_lanes_output(seen, i)[k * L + l];
                double got = qdot_lanes_output(late, i)[k * L + l];

                size = fmax(size, fabs(want));
                if (!(fabs(got - want) <= 1e-11 * size))
                    fail_msg("output %zu, lane %zu, order %zu, late: %.17g, not %.17g", i,
                             l, k, got, want);
            }
        }
    qdot_lanes_free(late);
}

static void
series_are_those_of_one_at_a_time(void **state)
{
    fixture f;
    qdot_tape *tape;
    qdot_program program;

    (void)state;
    smooth(&f, false);
    assert_int_equal(qdot_tape_new(f.pool, 3, f.in, f.n, f.out, &tape), QDOT_OK);
    assert_int_equal(qdot_program_init(tape, 3, false, &program), QDOT_OK);
    for (size_t kind = 0; kind < 3; kind++) {
        qdot_taylor *single;
        qdot_lanes *lanes;
        double one[3], t[L];

        qdot_kind_limit(kind);
        assert_int_equal(taylor_of_tape(tape, ORDERS, &single), QDOT_OK);
        assert_int_equal(qdot_lanes_of_program(&program, false, ORDERS, &lanes), QDOT_OK);
        for (size_t l = 0; l < L; l++)
            t[l] = 0.25;
        qdot_lanes_draw(lanes, t);
        for (int k = 0; k <= ORDERS; k++) {
            for (size_t i = 0; i < 3; i++)
                for (size_t l = 0; l < L; l++) {
                    start(one, l);
                    qdot_lanes_input(lanes, i)[(size_t)k * L + l] = coefficient(one, i, k);
                }
            qdot_lanes_order(lanes, k);
        }
        for (size_t l = 0; l < L; l++) {
            start(one, l);
            qdot_taylor_draw(single, 0.25);
            for (int k = 0; k <= ORDERS; k++) {
                for (size_t i = 0; i < 3; i++)
                    qdot_taylor_input(single, i)[k] = coefficient(one, i, k);
                qdot_taylor_order(single, k);
            }
            for (size_t i = 0; i < f.n; i++) {
                double size = 1;

                assert_int_equal(qdot_lanes_is_constant(lanes, i),
                                 qdot_taylor_is_constant(single, i));
                for (int k = 0; k <= ORDERS; k++) {
                    double want = qdot_taylor_output(single, i)[k];
                    double seen = qdot_lanes_output(lanes, i)[(size_t)k * L + l];

                    size = fmax(size, fabs(want));
                    if (!(fabs(seen - want) <= 1e-12 * size))
                        fail_msg("output %zu, lane %zu, order %d: %.17g, not %.17g", i, l,
                                 k, seen, want);
                }
            }
        }
        late_coefficients_come_in(&f, &program, lanes);
        qdot_lanes_free(lanes);
        qdot_taylor_free(single);
    }
    qdot_kind_limit(2);
    qdot_program_clear(&program);
    qdot_tape_free(tape);
    qdot_pool_free(f.pool);
}

static void
what_switches_and_orders_out_of_range_are_refused(void **state)
{
    fixture f;
    qdot_tape *tape;
    qdot_program program;
    qdot_lanes *lanes;

    (void)state;
    with_switches(&f);
    assert_int_equal(qdot_tape_new(f.pool, 3, f.in, f.n, f.out, &tape), QDOT_OK);
    assert_int_equal(qdot_program_init(tape, 3, false, &program), QDOT_ENOTBUILT);
    assert_int_equal(qdot_lanes_of_program(&program, false, QDOT_SERIES_MOST + 1, &lanes),
                     QDOT_EINVAL);
    assert_null(lanes);
    qdot_tape_free(tape);
    qdot_pool_free(f.pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_those_of_one_at_a_time),
        cmocka_unit_test(series_are_those_of_one_at_a_time),
        cmocka_unit_test(what_switches_and_orders_out_of_range_are_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
