/* test_interval.c -- tapes over intervals: each operation at random places of random boxes, and where
 * discs have no bound. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "tape/interval.h"
#include "tape/lone.h"

static void
holds_values(const qdot_tape *tape, const char *name, const qdot_interval *in,
             const qdot_interval *box)
{
    double work[16], out[2], x[3];

    assert_true(qdot_tape_work(tape) <= 16);
    for (int k = 0; k < 16; k++) {
        for (int i = 0; i < 3; i++)
            x[i] = k < 8 ? ((k >> i) & 1 ? in[i].hi : in[i].lo)
                         : fmin(fmax(in[i].lo + (in[i].hi - in[i].lo) * unit(), in[i].lo),
                                in[i].hi);
        qdot_tape_eval(tape, x, out, work);
        for (int i = 0; i < 2; i++)
            if (!isnan(out[i]) && !(box[i].lo <= out[i] && out[i] <= box[i].hi))
                fail_msg("%s of %.17g %.17g %.17g: %.17g is not in %.17g ... %.17g", name, x[0],
                         x[1], x[2], out[i], box[i].lo, box[i].hi);
    }
}

static void
no_operation_leaves_its_interval(void **state)
{
    qdot_pool *pool = qdot_pool_new();

    (void)state;
    srand(11);
    for (int op = 0; op < QDOT_OP_COUNT; op++)
        for (int same = 0; same < 2; same++) {
            qdot_tape *tape = lone(pool, op, same);
            qdot_interval *work = malloc(qdot_interval_work(tape) * sizeof *work);
            int bounded = 0;

            for (int k = 0; k < 4000; k++) {
                const double scale = k % 7 == 0 ? 500 : 1;
                qdot_interval in[3], box[2];

                for (int i = 0; i < 3; i++) {
                    in[i].lo = scale * (6 * unit() - 3);
                    in[i].hi = in[i].lo + scale * 3 * pow(unit(), 4);
                    if (k % 5 == i)
                        in[i].lo = floor(in[i].lo);
                    if (k % 11 == i)
                        in[i].lo = in[i].hi = floor(in[i].hi);
                }
                qdot_interval_eval(tape, in, box, work);
                assert_false(isnan(box[0].lo) || isnan(box[0].hi));
                bounded += isfinite(box[0].lo) && isfinite(box[0].hi);
                holds_values(tape, qdot_operations[op].name, in, box);
            }
            if (bounded < 500)
                fail_msg("%s: only %d of 4000 boxes have a bound", qdot_operations[op].name,
                         bounded);
            free(work);
            qdot_tape_free(tape);
        }
    qdot_pool_free(pool);
}

static qdot_interval
box_of(qdot_op op, qdot_interval a, qdot_interval b)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_tape *tape = lone(pool, op, false);
    qdot_interval *work = malloc(qdot_interval_work(tape) * sizeof *work), out[2];
    const qdot_interval in[3] = {a, b, {0, 0}};

    qdot_interval_eval(tape, in, out, work);
    free(work);
    qdot_tape_free(tape);
    qdot_pool_free(pool);
    return out[0];
}

/* cosh(1000) is beyond all doubles, 1/cosh(1000) nearly 0. */
static void
what_is_too_large_has_bounds(void **state)
{
    const qdot_interval far = {1000, 2000}, one = {1, 1};
    const qdot_interval huge = box_of(QDOT_OP_COSH, far, one);
    const qdot_interval tiny = box_of(QDOT_OP_DIV, one, huge);

    (void)state;
    assert_true(huge.lo > 1e308 && isfinite(huge.lo) && isinf(huge.hi));
    assert_true(tiny.lo <= 0 && tiny.lo > -1e-307 && tiny.hi >= 0 && tiny.hi < 1e-307);
    assert_true(isinf(box_of(QDOT_OP_DIV, one, (qdot_interval){-1, 1}).hi));
    assert_true(box_of(QDOT_OP_DIV, one, (qdot_interval){0, 2}).lo > 0.49);
    assert_true(box_of(QDOT_OP_ABS, (qdot_interval){-1, 2}, one).lo == 0);
    assert_true(box_of(QDOT_OP_FLOOR, (qdot_interval){1.2, 1.9}, one).hi == 1);
    assert_true(box_of(QDOT_OP_LT, (qdot_interval){1, 2}, (qdot_interval){2, 3}).lo == 0);
    assert_true(box_of(QDOT_OP_SIN, (qdot_interval){1, 2}, one).hi == 1);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_operation_leaves_its_interval),
        cmocka_unit_test(what_is_too_large_has_bounds),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
