/* test_two.c -- series in sums of two doubles against those in MPFR: every operation, every
 * recurrence. */
#include "tape/reference.h"
#include "series/operations.h"

#include <math.h>
#include <stdint.h>

#include "series/precise.h"
#include "series/two.h"

enum { ORDERS = 9, BITS = 256, INPUTS = 4 };

static void
switching(fixture *f)
{
    qdot_pool *pool;
    qdot_expr x, u, t, less, same;

    smooth(f, true);
    pool = f->pool;
    x = f->in[0], u = f->in[1], t = f->in[2];
    less = qdot_rel(pool, QDOT_LT, x, t);
    same = qdot_rel(pool, QDOT_EQ, x, t);
    push(f, apply(f, QDOT_ABS, qdot_sub(pool, t, x)));
    push(f, apply(f, QDOT_SIGN, qdot_sub(pool, t, x)));
    push(f, apply(f, QDOT_FLOOR, qdot_mul(pool, u, qdot_expr_int(pool, 5))));
    push(f, qdot_fun(pool, QDOT_MOD, 2, (qdot_expr[]){u, x}));
    push(f, qdot_fun(pool, QDOT_MIN, 2, (qdot_expr[]){t, x}));
    push(f, qdot_fun(pool, QDOT_MAX, 2, (qdot_expr[]){t, x}));
    push(f, qdot_fun(pool, QDOT_IF, 3, (qdot_expr[]){less, x, u}));
    push(f, qdot_fun(pool, QDOT_IF, 3, (qdot_expr[]){same, x, u}));
    push(f, qdot_fun(pool, QDOT_IF, 3,
                     (qdot_expr[]){qdot_rel(pool, QDOT_LE, x, u), x, t}));
}

/* Coefficient k of input i, no double. */
static qdot_two
coefficient(size_t i, int k)
{
    static const double first[INPUTS] = {0.4, 1.3, 0.25, 0.7};
    const double hi = k == 0 ? first[i] : i == 2 ? (k == 1) : sin(7 * (double)i + k) / k;

    if (i == 3 && k > 0)
        return (qdot_two){0, 0};
    return qdot_two_of(hi, hi * 0x1.23456789abcdep-54);
}

static void
are_near(const qdot_two *a, const mpfr_t *x, int k, size_t output)
{
    double error, size = 1e-3;
    mpfr_t d;

    mpfr_init2(d, BITS);
    mpfr_set_d(d, a[k].hi, MPFR_RNDN);
    mpfr_add_d(d, d, a[k].lo, MPFR_RNDN);
    mpfr_sub(d, d, x[k], MPFR_RNDN);
    error = fabs(mpfr_get_d(d, MPFR_RNDN));
    for (int j = 0; j <= k; j++)
        size = fmax(size, fabs(mpfr_get_d(x[j], MPFR_RNDN)));
    mpfr_clear(d);
    if (!(error <= size * 0x1p-64))
        fail_msg("output %zu, order %d: 2^%.1f of %g", output, k, log2(error / size), size);
}

/* Of the first so many outputs. */
static void
compare(fixture *f, int most)
{
    qdot_tape *tape;
    qdot_tape_two *two;
    qdot_precise *precise;

    assert_int_equal(qdot_tape_new(f->pool, INPUTS, f->in, f->n, f->out, &tape), QDOT_OK);
    assert_int_equal(qdot_tape_two_new(tape, most, 3, &two), QDOT_OK);
    assert_int_equal(qdot_precise_new(f->pool, tape, most, BITS, &precise), QDOT_OK);
    for (int k = 0; k <= most; k++) {
        for (size_t i = 0; i < INPUTS; i++) {
            const qdot_two c = coefficient(i, k);
            mpfr_ptr x = qdot_precise_input(precise, i)[k];

            qdot_tape_two_input(two, i)[k] = c;
            mpfr_set_d(x, c.hi, MPFR_RNDN);
            mpfr_add_d(x, x, c.lo, MPFR_RNDN);
        }
        qdot_tape_two_order(two, k);
        qdot_precise_order(precise, k);
        for (size_t i = 0; i < f->n; i++)
            are_near(qdot_tape_two_output(two, i), qdot_precise_output(precise, i), k, i);
    }
    assert_int_equal(qdot_tape_two_stride(two), most + 1);
    qdot_tape_two_free(two);
    qdot_precise_free(precise);
    qdot_tape_free(tape);
}

static void
every_recurrence_is_that_of_MPFR(void **state)
{
    fixture f;

    (void)state;
    smooth(&f, true);
    compare(&f, ORDERS);
    qdot_pool_free(f.pool);
}

static void
every_value_is_that_of_MPFR(void **state)
{
    fixture f;

    (void)state;
    switching(&f);
    compare(&f, 0);
    qdot_pool_free(f.pool);
}

static void
what_switches_has_no_series(void **state)
{
    fixture f;
    qdot_tape *tape;
    qdot_tape_two *two;

    (void)state;
    switching(&f);
    assert_int_equal(qdot_tape_new(f.pool, INPUTS, f.in, f.n, f.out, &tape), QDOT_OK);
    assert_int_equal(qdot_tape_two_new(tape, 2, INPUTS, &two), QDOT_ENOTBUILT);
    qdot_tape_free(tape);
    qdot_pool_free(f.pool);
}

/* A motion whose unknowns are x and u, and its outputs. */
static void
make_motion(fixture *f, qdot_tape *tape, qdot_motion *m)
{
    qdot_program_row rows[MOST_OUT];
    qdot_program_builder *b;

    *m = (qdot_motion){0};
    assert_int_equal(qdot_program_begin(INPUTS, 3, false, &m->program, &b), QDOT_OK);
    for (qdot_program_row i = 0; i < INPUTS; i++)
        rows[i] = i;
    qdot_program_append(b, tape, rows, rows);
    for (size_t i = 0; i < f->n; i++)
        assert_int_equal(qdot_vec_push(&m->program.outputs, rows[i]), QDOT_OK);
    for (qdot_program_row i = 0; i < 2; i++)
        assert_int_equal(qdot_motion_solve(m,
                                           (qdot_motion_unknown){.row = i,
                                                                 .once = QDOT_NO_ROW,
                                                                 .twice = QDOT_NO_ROW},
                                           rows[i]),
                         QDOT_OK);
    assert_int_equal(qdot_program_end(b), QDOT_OK);
    assert_int_equal(qdot_motion_arrange(m), QDOT_OK);
}

/* Order 3 with other coefficients, changed, is order 3 with those meant, and order 4 goes on
 * from there. */
static void
changed_is_as_evaluated(void **state)
{
    enum { K = 3 };
    fixture f;
    qdot_tape *tape;
    qdot_motion motion;
    qdot_tape_two *two[2];
    const double off_by[2] = {1e-9, -3e-9};
    double by[2], guess[2];

    (void)state;
    smooth(&f, true);
    assert_int_equal(qdot_tape_new(f.pool, INPUTS, f.in, f.n, f.out, &tape), QDOT_OK);
    make_motion(&f, tape, &motion);
    for (int which = 0; which < 2; which++) {
        assert_int_equal(qdot_tape_two_of_motion(&motion, &two[which]), QDOT_OK);
        for (int k = 0; k <= K + 1; k++) {
            for (size_t i = 0; i < INPUTS; i++)
                qdot_tape_two_input(two[which], i)[k] = coefficient(i, k);
            for (size_t i = 0; i < 2; i++)
                guess[i] = coefficient(i, k).hi - (k == K && which == 0 ? off_by[i] : 0);
            qdot_tape_two_stage(two[which], k, guess);
            for (size_t i = 0; i < 2; i++)
                by[i] = coefficient(i, k).hi - guess[i];
            if (k == K && which == 0)
                qdot_tape_two_change(two[0], k, by);
        }
    }
    for (size_t i = 0; i < f.n; i++)
        for (int k = K; k <= K + 1; k++) {
            const qdot_two a = qdot_tape_two_output(two[0], i)[k];
            const qdot_two b = qdot_tape_two_output(two[1], i)[k];
            const double off = qdot_two_sub(a, b).hi;

            if (!(fabs(off) <= 1e-23 * fmax(1, fabs(b.hi))))
                fail_msg("output %zu, order %d: off by %g", i, k, off);
        }
    qdot_tape_two_free(two[0]);
    qdot_tape_two_free(two[1]);
    qdot_motion_clear(&motion);
    qdot_tape_free(tape);
    qdot_pool_free(f.pool);
}

/* The sides at the first input x, the others as they are (x = t = 1/4 in coefficient). */
static uint64_t
sides_at(qdot_tape_two *two, qdot_two x)
{
    for (size_t i = 0; i < INPUTS; i++)
        qdot_tape_two_input(two, i)[0] = i == 0 ? x : (qdot_two){coefficient(i, 0).hi, 0};
    qdot_tape_two_order(two, 0);
    return qdot_tape_two_sides(two);
}

static void
sides_are_those_of_what_switches(void **state)
{
    qdot_tape_two *two;
    qdot_tape *tape;
    fixture f;
    uint64_t above, below;

    (void)state;
    switching(&f);
    f.n = 0;
    push(&f, apply(&f, QDOT_ABS, qdot_sub(f.pool, f.in[2], f.in[0])));
    push(&f, apply(&f, QDOT_FLOOR, qdot_mul(f.pool, f.in[0], qdot_expr_int(f.pool, 3))));
    assert_int_equal(qdot_tape_new(f.pool, INPUTS, f.in, f.n, f.out, &tape), QDOT_OK);
    assert_int_equal(qdot_tape_two_new(tape, 0, 3, &two), QDOT_OK);
    above = sides_at(two, (qdot_two){0.3, 0});
    below = sides_at(two, (qdot_two){0.2, 0});
    assert_true(above != below && above != 0 && below != 0);
    assert_true(sides_at(two, (qdot_two){0.31, 0}) == above);
    assert_true(sides_at(two, (qdot_two){0.4, 0}) != above); /* another integer */
    assert_true(sides_at(two, (qdot_two){0.25, 0}) == 0);
    assert_true(sides_at(two, (qdot_two){0.25, 0x1p-60}) == above); /* a double would not tell */
    assert_true(sides_at(two, (qdot_two){0.25, -0x1p-60}) == below);
    qdot_tape_two_free(two);
    qdot_tape_free(tape);
    qdot_pool_free(f.pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_recurrence_is_that_of_MPFR),
        cmocka_unit_test(every_value_is_that_of_MPFR),
        cmocka_unit_test(what_switches_has_no_series),
        cmocka_unit_test(changed_is_as_evaluated),
        cmocka_unit_test(sides_are_those_of_what_switches),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
