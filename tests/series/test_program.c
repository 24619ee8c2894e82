/* test_program.c -- what a tape becomes, and that every executor knows every operation. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "expr/build.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "series/precise.h"
#include "series/program.h"
#include "series/two.h"
#include "tape/lone.h"

/* x + sin x a number has four steps: those of the number go first and cost nothing. */
static void
what_stands_still_goes_first(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    const qdot_expr x = qdot_symbol_get(pool, QDOT_PARAM, "x");
    const qdot_expr a = qdot_symbol_get(pool, QDOT_PARAM, "a");
    const qdot_expr in[] = {x, a};
    const qdot_expr f = qdot_mul(pool, qdot_fun1(pool, QDOT_SIN, x),
                                 qdot_mul(pool, x, qdot_fun1(pool, QDOT_EXP, a)));
    qdot_program p;
    qdot_tape *tape;

    (void)state;
    assert_int_equal(qdot_tape_new(pool, 2, in, 1, &f, &tape), QDOT_OK);
    assert_int_equal(qdot_program_init(tape, 1, false, &p), QDOT_OK);
    assert_int_equal(p.still, 1); /* e^a */
    assert_int_equal(p.steps.at[0].op, QDOT_T_EXP);
    assert_true(p.steps.at[0].still);
    assert_int_equal(p.length, 4); /* and sin x, its product with x, a multiple of that */
    assert_int_equal(p.steps.at[p.length].op, QDOT_T_END);
    assert_true(p.convolutions == 3); /* sine and cosine, the product */
    assert_false(p.rows.at[p.outputs.at[0]].still);
    qdot_program_clear(&p);
    assert_int_equal(qdot_program_init(tape, 2, false, &p), QDOT_OK);
    assert_int_equal(p.still, 0);
    assert_true(p.convolutions == 5); /* e^a and the other product */
    qdot_program_clear(&p);
    qdot_tape_free(tape);
    qdot_pool_free(pool);
}

/* Order 0 of each operation in sums of two doubles and in MPFR is what it is in doubles. */
static void
every_operation_has_its_value(void **state)
{
    qdot_pool *pool = qdot_pool_new();

    (void)state;
    srand(5);
    for (int op = 0; op < QDOT_OP_COUNT; op++) {
        qdot_tape *tape = lone(pool, (qdot_op)op, false);
        double *work = calloc(qdot_tape_work(tape) + 1, sizeof *work);
        qdot_tape_two *two;
        qdot_precise *precise;
        int compared = 0;

        assert_int_equal(qdot_tape_two_new(tape, 0, 3, &two), QDOT_OK);
        assert_int_equal(qdot_precise_new(pool, tape, 0, 128, &precise), QDOT_OK);
        for (int k = 0; k < 300; k++) {
            double in[3], out[2];

            for (int i = 0; i < 3; i++) {
                in[i] = k % 3 == 0 ? floor(6 * unit() - 3) : 6 * unit() - 3;
                qdot_tape_two_input(two, (size_t)i)[0] = (qdot_two){in[i], 0};
                mpfr_set_d(qdot_precise_input(precise, (size_t)i)[0], in[i], MPFR_RNDN);
            }
            qdot_tape_eval(tape, in, out, work);
            qdot_tape_two_order(two, 0);
            qdot_precise_order(precise, 0);
            for (size_t j = 0; j < 2; j++) {
                const double a = qdot_tape_two_output(two, j)[0].hi;
                const double b = mpfr_get_d(qdot_precise_output(precise, j)[0], MPFR_RNDN);
                const double near = 1e-14 * fmax(1, fabs(out[j]));

                if (!isfinite(out[j]) || fabs(out[j]) > 1e200)
                    continue;
                compared++;
                if (!(fabs(a - out[j]) <= near && fabs(b - out[j]) <= near))
                    fail_msg("%s of %.17g, %.17g, %.17g is %.17g, %.17g, %.17g",
                             qdot_operations[op].name, in[0], in[1], in[2], out[j], a, b);
            }
        }
        if (compared < 100)
            fail_msg("%s: %d values", qdot_operations[op].name, compared);
        qdot_tape_two_free(two);
        qdot_precise_free(precise);
        free(work);
        qdot_tape_free(tape);
    }
    qdot_pool_free(pool);
}

/* What switches has a value, and no series. */
static void
what_switches_has_values_only(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_tape *tape = lone(pool, QDOT_OP_FLOOR, false);
    qdot_program p;

    (void)state;
    assert_string_equal(qdot_program_hindrance(tape), "floor");
    assert_int_equal(qdot_program_init(tape, 3, false, &p), QDOT_ENOTBUILT);
    assert_null(p.steps.at);
    assert_int_equal(qdot_program_init(tape, 3, true, &p), QDOT_OK);
    assert_int_equal(p.steps.at[0].op, QDOT_T_VALUE);
    qdot_program_clear(&p);
    qdot_tape_free(tape);
    qdot_pool_free(pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_stands_still_goes_first),
        cmocka_unit_test(every_operation_has_its_value),
        cmocka_unit_test(what_switches_has_values_only),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
