/* test_motion.c -- how far the rows of a motion lead, which steps hold what is not known yet, and a
 * pendulum as d'Alembert has it against the same as theta'' = -sin theta. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "expr/build.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "num/kinds.h"
#include "series/lanes.h"
#include "series/precise.h"
#include "series/taylor-motion.h"
#include "series/two.h"

enum { THETA, OMEGA, INPUTS, ORDERS = 10 };

static qdot_motion_unknown
acceleration(qdot_program_row row)
{
    return (qdot_motion_unknown){.row = row, .once = OMEGA, .twice = THETA};
}

/* A tape of functions of theta. */
static qdot_tape *
lower(qdot_pool *pool, size_t n, const qdot_expr *out, qdot_expr theta)
{
    const qdot_expr in[INPUTS] = {theta, qdot_symbol_jet(pool, theta, 1)};
    qdot_tape *tape;

    assert_int_equal(qdot_tape_new(pool, INPUTS, in, n, out, &tape), QDOT_OK);
    return tape;
}

static void
finish(qdot_motion *m, qdot_program_builder *b)
{
    assert_int_equal(qdot_program_end(b), QDOT_OK);
    assert_int_equal(qdot_motion_arrange(m), QDOT_OK);
}

/* x = sin theta, y = -cos theta: E = x_theta x'' + y_theta (y'' + 1) */
static void
by_places(qdot_pool *pool, qdot_motion *m)
{
    const qdot_expr theta = qdot_symbol_get(pool, QDOT_COORD, "theta");
    const qdot_expr s = qdot_fun1(pool, QDOT_SIN, theta), c = qdot_fun1(pool, QDOT_COS, theta);
    qdot_tape *tape = lower(pool, 3, (qdot_expr[]){s, qdot_neg(pool, c), c}, theta);
    qdot_program_row in[INPUTS] = {THETA, OMEGA}, out[3], x, y, E;
    qdot_program_builder *b;

    *m = (qdot_motion){0};
    assert_int_equal(qdot_program_begin(INPUTS, INPUTS, false, &m->program, &b), QDOT_OK);
    qdot_program_append(b, tape, in, out);
    x = qdot_program_rate(b, qdot_program_rate(b, out[0]));
    y = qdot_program_rate(b, qdot_program_rate(b, out[1]));
    y = qdot_program_operation(
        b, QDOT_OP_ADD, y, qdot_program_number(b, (qdot_program_constant){1, 0, 0, QDOT_ONE}), 0);
    E = qdot_program_operation(b, QDOT_OP_MUL, out[2], x, x);
    E = qdot_program_operation(b, QDOT_OP_MADD, out[0], y, E);
    assert_int_equal(qdot_motion_solve(m, acceleration(QDOT_NO_ROW), E), QDOT_OK);
    assert_int_equal(qdot_motion_end_block(m), QDOT_OK);
    finish(m, b);
    qdot_tape_free(tape);
}

/* theta'' is a row. */
static void
by_value(qdot_pool *pool, qdot_motion *m)
{
    const qdot_expr theta = qdot_symbol_get(pool, QDOT_COORD, "theta");
    const qdot_expr f = qdot_neg(pool, qdot_fun1(pool, QDOT_SIN, theta));
    qdot_tape *tape = lower(pool, 1, &f, theta);
    qdot_program_row in[INPUTS] = {THETA, OMEGA}, out;
    qdot_program_builder *b;

    *m = (qdot_motion){0};
    assert_int_equal(qdot_program_begin(INPUTS, INPUTS, false, &m->program, &b), QDOT_OK);
    qdot_program_append(b, tape, in, &out);
    assert_int_equal(qdot_motion_give(m, out, OMEGA, THETA), QDOT_OK);
    finish(m, b);
    qdot_tape_free(tape);
}

/* Sine and cosine lead by 2, their rates by 1 and 0; all of them hold the newest coefficient of
 * theta, and E reads slopes that are known. */
static void
places_lead(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_motion m;
    int rates[2] = {0};

    (void)state;
    by_places(pool, &m);
    assert_int_equal(qdot_motion_first(&m), -2);
    assert_int_equal(m.program.rows.at[THETA].lead, 2);
    assert_int_equal(m.program.rows.at[OMEGA].lead, 1);
    for (size_t i = m.program.still; i < m.program.length; i++) {
        const qdot_program_step *s = m.program.steps.at + i;

        assert_true(s->newest);
        if (s->op == QDOT_T_SINCOS) {
            assert_int_equal(s->lead, 2);
            assert_true(s->kept);
        }
        if (s->op == QDOT_T_RATE)
            rates[s->lead]++;
        if (s->op == QDOT_T_MUL || s->op == QDOT_T_MADD) { /* one factor is newer than the other */
            assert_int_equal(s->lead, 0);
            assert_true((s->newest & 3) == 1 || (s->newest & 3) == 2);
        }
        if (s->to == m.equations.at[0])
            assert_false(s->kept);
    }
    assert_int_equal(rates[1], 2);
    assert_int_equal(rates[0], 2);
    qdot_motion_clear(&m);
    qdot_pool_free(pool);
}

/* A rate of what is given by a row is not known when it is read. */
static void
what_is_not_known_yet_is_refused(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_program_builder *b;
    qdot_motion m = {0};

    (void)state;
    assert_int_equal(qdot_program_begin(INPUTS, INPUTS, false, &m.program, &b), QDOT_OK);
    assert_int_equal(qdot_motion_give(&m, qdot_program_rate(b, OMEGA), OMEGA, THETA), QDOT_OK);
    assert_int_equal(qdot_program_end(b), QDOT_OK);
    assert_int_equal(qdot_motion_arrange(&m), QDOT_ENOTBUILT);
    qdot_motion_clear(&m);
    qdot_pool_free(pool);
}

/* From theta = 0.7, omega = -0.4, in units of 1: rows of theta, [ORDERS + 1]. */
static void
expand_precise(qdot_pool *pool, const qdot_motion *m, mpfr_t *theta)
{
    qdot_precise *p;
    mpfr_t *row, K, by[1];

    assert_int_equal(qdot_precise_of_motion(pool, m, ORDERS, 192, &p), QDOT_OK);
    mpfr_init2(K, 192);
    mpfr_init2(by[0], 192);
    row = qdot_precise_input(p, THETA);
    mpfr_set_d(row[0], 0.7, MPFR_RNDN);
    mpfr_set_d(row[1], -0.4, MPFR_RNDN);
    mpfr_set_d(qdot_precise_input(p, OMEGA)[0], -0.4, MPFR_RNDN);
    for (int k = qdot_motion_first(m); k < ORDERS - 1; k++) {
        qdot_precise_stage(p, k);
        if (k < 0 || m->solved.n == 0)
            continue;
        if (k == 0)
            qdot_precise_column(p, 0, 1, 0, &K);
        mpfr_div(by[0], qdot_precise_row(p, m->equations.at[0])[k], K, MPFR_RNDN);
        mpfr_neg(by[0], by[0], MPFR_RNDN);
        qdot_precise_change(p, k, (const mpfr_t *)by);
    }
    for (int k = 0; k <= ORDERS; k++) {
        mpfr_init2(theta[k], 192);
        mpfr_set(theta[k], row[k], MPFR_RNDN);
    }
    mpfr_clear(K);
    mpfr_clear(by[0]);
    qdot_precise_free(p);
}

/* The same in units of a half, from what doubles have of `precise`. K is 1: the length of the
 * pendulum squared. */
static void
expand_two(const qdot_motion *m, const mpfr_t *precise, qdot_two *theta)
{
    const double unit = 0.5;
    qdot_tape_two *t;
    qdot_two *row;

    assert_int_equal(qdot_tape_two_of_motion(m, &t), QDOT_OK);
    qdot_tape_two_set_unit(t, unit);
    row = qdot_tape_two_input(t, THETA);
    row[0] = (qdot_two){0.7, 0};
    row[1] = (qdot_two){-0.4 * unit, 0};
    qdot_tape_two_input(t, OMEGA)[0] = (qdot_two){-0.4, 0};
    for (int k = qdot_motion_first(m); k < ORDERS - 1; k++) {
        const double guess =
            k < 0 ? 0 : mpfr_get_d(precise[k + 2], MPFR_RNDN) * (k + 1) * (k + 2) * pow(unit, k);

        qdot_tape_two_stage(t, k, &guess);
        for (int tries = 0; tries < 3 && k >= 0 && m->solved.n > 0; tries++) {
            const double by = -qdot_tape_two_row(t, m->equations.at[0])[k].hi;

            qdot_tape_two_change(t, k, &by);
        }
    }
    for (int k = 0; k <= ORDERS; k++)
        theta[k] = qdot_two_scale(row[k], ldexp(1, k));
    qdot_tape_two_free(t);
}

/* In lanes, each by a unit of its own; theta in units of 1. */
static void
expand_lanes(const qdot_motion *m, size_t lane, double *theta)
{
    double unit[QDOT_LANES], by[QDOT_LANES], *row, *omega;
    qdot_lanes *t;

    assert_int_equal(qdot_lanes_of_motion(m, false, ORDERS - 1, &t), QDOT_OK);
    row = qdot_lanes_input(t, THETA);
    omega = qdot_lanes_input(t, OMEGA);
    for (size_t l = 0; l < QDOT_LANES; l++) {
        unit[l] = ldexp(l % 2 ? -1 : 1, 1 - (int)l);
        row[l] = l == lane ? 0.7 : 0.1 * (double)l;
        omega[l] = l == lane ? -0.4 : 0.3;
        row[QDOT_LANES + l] = unit[l] * omega[l];
    }
    qdot_lanes_set_unit(t, unit);
    for (int k = qdot_motion_first(m); k < ORDERS - 1; k++) {
        qdot_lanes_stage(t, k);
        if (k < 0 || m->solved.n == 0)
            continue;
        for (size_t l = 0; l < QDOT_LANES; l++)
            by[l] = -qdot_lanes_series(t, m->equations.at[0])[(size_t)k * QDOT_LANES + l];
        qdot_lanes_change(t, k, by);
    }
    for (int k = 0; k <= ORDERS; k++)
        theta[k] = row[(size_t)k * QDOT_LANES + lane] * pow(unit[lane], -k);
    qdot_lanes_free(t);
}

/* By every kind of vectors, in every lane. */
static void
lanes_agree(const qdot_motion *m, const mpfr_t *precise)
{
    for (size_t kind = 0; kind < 3; kind++) {
        qdot_kind_limit(kind);
        for (size_t lane = 0; lane < QDOT_LANES; lane++) {
            double theta[ORDERS + 1];

            expand_lanes(m, lane, theta);
            for (int k = 0; k <= ORDERS; k++)
                if (!(fabs(theta[k] - mpfr_get_d(precise[k], MPFR_RNDN)) <= 4e-16))
                    fail_msg("lane %zu, order %d: %.17g for %.17g", lane, k, theta[k],
                             mpfr_get_d(precise[k], MPFR_RNDN));
        }
    }
}

static double
distance(const qdot_two *a, mpfr_srcptr x)
{
    mpfr_t d;
    double off;

    mpfr_init2(d, 192);
    mpfr_sub_d(d, x, a->hi, MPFR_RNDN);
    mpfr_sub_d(d, d, a->lo, MPFR_RNDN);
    off = fabs(mpfr_get_d(d, MPFR_RNDN));
    mpfr_clear(d);
    return off;
}

static void
forms_and_executors_agree(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_motion motion[2];
    mpfr_t theta[2][ORDERS + 1];
    qdot_two two[2][ORDERS + 1];

    (void)state;
    by_places(pool, &motion[0]);
    by_value(pool, &motion[1]);
    for (int i = 0; i < 2; i++) {
        expand_precise(pool, &motion[i], theta[i]);
        expand_two(&motion[i], (const mpfr_t *)theta[i], two[i]);
        lanes_agree(&motion[i], (const mpfr_t *)theta[i]);
    }
    for (int k = 0; k <= ORDERS; k++) {
        mpfr_sub(theta[0][k], theta[0][k], theta[1][k], MPFR_RNDN);
        assert_true(fabs(mpfr_get_d(theta[0][k], MPFR_RNDN)) <= 0x1p-180);
        for (int i = 0; i < 2; i++)
            if (!(distance(&two[i][k], theta[1][k]) <= 1e-22))
                fail_msg("form %d, order %d: off by %g", i, k, distance(&two[i][k], theta[1][k]));
    }
    for (int k = 0; k <= ORDERS; k++) {
        mpfr_clear(theta[0][k]);
        mpfr_clear(theta[1][k]);
    }
    qdot_motion_clear(&motion[0]);
    qdot_motion_clear(&motion[1]);
    qdot_pool_free(pool);
}

/* --- equations of which only the first are explicit ---------------------------------- */

enum { X, Y, VX, VY, PLACES };

/* A pendulum in Cartesian coordinates: x'' + A_x mu = 0, y'' + A_y mu = -1, (x^2 + y^2)'' = 0, where
 * A_x is written as the negative of another row. */
static void
by_constraint(qdot_motion *m)
{
    qdot_program_row one, zero, right[2], A[2], u[3], f, E;
    qdot_program_builder *b;

    *m = (qdot_motion){0};
    assert_int_equal(qdot_program_begin(PLACES, PLACES, false, &m->program, &b), QDOT_OK);
    one = qdot_program_number(b, (qdot_program_constant){1, 0, 0, QDOT_ONE});
    zero = qdot_program_number(b, (qdot_program_constant){0, 0, 0, QDOT_ZERO});
    right[0] = zero;
    right[1] = qdot_program_operation(b, QDOT_OP_NEG, one, 0, 0);
    A[1] = qdot_program_operation(b, QDOT_OP_ADD, Y, Y, 0);
    A[0] = qdot_program_operation(b, QDOT_OP_ADD, X, X, 0);
    A[0] = qdot_program_operation(b, QDOT_OP_NEG, A[0], 0, 0);
    A[0] = qdot_program_operation(b, QDOT_OP_NEG, A[0], 0, 0);
    f = qdot_program_operation(b, QDOT_OP_MUL, Y, Y, 0);
    f = qdot_program_operation(b, QDOT_OP_MADD, X, X, f);
    for (int i = 0; i < 3; i++)
        u[i] = qdot_program_unknown(b);
    f = qdot_program_rate(b, qdot_program_rate(b, f));
    for (uint32_t i = 0; i < 2; i++) {
        const qdot_motion_unknown a = {.row = u[i], .once = VX + i, .twice = X + i};

        E = qdot_program_operation(b, QDOT_OP_MSUB, A[i], u[2], right[i]);
        E = qdot_program_operation(b, QDOT_OP_ADD, E, u[i], 0);
        assert_int_equal(qdot_vec_push(&m->entries, ((qdot_motion_entry){i, i, one})), QDOT_OK);
        assert_int_equal(qdot_vec_push(&m->right, right[i]), QDOT_OK);
        assert_int_equal(qdot_motion_solve(m, a, E), QDOT_OK);
        m->written += 2;
    }
    for (uint32_t i = 0; i < 2; i++)
        assert_int_equal(qdot_vec_push(&m->entries, ((qdot_motion_entry){2, i, A[i]})), QDOT_OK);
    assert_int_equal(
        qdot_motion_solve(
            m, (qdot_motion_unknown){.row = u[2], .once = QDOT_NO_ROW, .twice = QDOT_NO_ROW}, f),
        QDOT_OK);
    assert_int_equal(qdot_motion_end_block(m), QDOT_OK);
    finish(m, b);
}

/* x: what is missing, then what is to be added. */
static void
solve_for_rod(const double A[2], double x[3])
{
    const double mu = (A[0] * x[0] + A[1] * x[1] - x[2]) / (A[0] * A[0] + A[1] * A[1]);

    x[0] -= A[0] * mu;
    x[1] -= A[1] * mu;
    x[2] = mu;
}

static const double start[PLACES] = {0.6, -0.8, 0.4, 0.3};

/* All steps, and what E are then. */
static void
constraint_in_lanes(const qdot_motion *m, double unit, double x[2][ORDERS + 1])
{
    const double A[2] = {2 * start[X], 2 * start[Y]};
    double units[QDOT_LANES], by[3 * QDOT_LANES];
    qdot_lanes *t;

    assert_int_equal(qdot_lanes_of_motion(m, false, ORDERS - 1, &t), QDOT_OK);
    for (size_t l = 0; l < QDOT_LANES; l++) {
        units[l] = unit;
        for (size_t i = 0; i < PLACES; i++)
            qdot_lanes_input(t, i)[l] = start[i];
        for (size_t i = 0; i < 2; i++)
            qdot_lanes_input(t, i)[QDOT_LANES + l] = unit * start[VX + i];
    }
    qdot_lanes_set_unit(t, units);
    for (int k = qdot_motion_first(m); k < ORDERS - 1; k++) {
        qdot_lanes_stage(t, k);
        for (size_t l = 0; l < QDOT_LANES && k >= 0; l++) {
            double d[3];

            for (size_t i = 0; i < 3; i++)
                d[i] = -qdot_lanes_series(t, m->equations.at[i])[(size_t)k * QDOT_LANES + l];
            solve_for_rod(A, d);
            for (size_t i = 0; i < 3; i++)
                by[i * QDOT_LANES + l] = d[i];
        }
        if (k >= 0)
            qdot_lanes_change(t, k, by);
    }
    for (size_t i = 0; i < 2; i++)
        for (size_t k = 0; k <= ORDERS; k++)
            x[i][k] = qdot_lanes_input(t, i)[k * QDOT_LANES];
    qdot_lanes_free(t);
}

/* Into the rows of t. */
static void
constraint_in_doubles(qdot_taylor *t, const qdot_motion *m, double unit, const double *from)
{
    double A[2], by[3], sign;

    for (size_t i = 0; i < PLACES; i++)
        qdot_taylor_input(t, i)[0] = from[i];
    for (size_t i = 0; i < 2; i++)
        qdot_taylor_input(t, i)[1] = unit * from[VX + i];
    for (int k = qdot_motion_first(m); k < ORDERS - 1; k++) {
        qdot_taylor_stage(t, k);
        if (k < 0)
            continue;
        for (size_t i = 0; i < 2 && k == 0; i++) {
            A[i] = qdot_taylor_entry(t, m->entries.at[2 + i].at, &sign)[0] * sign;
            assert_true(A[i] == 2 * from[i]);
            assert_true(sign == (i == 0 ? -1 : 1));
        }
        qdot_taylor_missing(t, k, by);
        solve_for_rod(A, by);
        qdot_taylor_change(t, k, by);
    }
}

/* Doubles of one system leave out steps that are only rates of an equation, that write explicit ones or
 * that negate an entry of K; the motion is the same. */
static void
explicit_equations_beside_others(void **state)
{
    const double unit = 0.5;
    qdot_motion m;
    qdot_taylor *t;
    double lanes[2][ORDERS + 1];

    (void)state;
    by_constraint(&m);
    assert_false(qdot_motion_is_explicit(&m));
    constraint_in_lanes(&m, unit, lanes);
    assert_int_equal(qdot_taylor_of_motion(&m, false, ORDERS, 0, &t), QDOT_OK);
    assert_int_equal(qdot_taylor_length(t), 6); /* 2x, -2x, 2y, x^2, y^2, their sum */
    qdot_taylor_set_unit(t, unit);
    constraint_in_doubles(t, &m, unit, (const double[]){0.8, 0.6, -0.3, 0.4});
    constraint_in_doubles(t, &m, unit, start); /* nothing is left of that */
    for (size_t i = 0; i < 2; i++)
        for (size_t k = 0; k <= ORDERS; k++)
            if (!(fabs(qdot_taylor_input(t, i)[k] - lanes[i][k]) <= 1e-15))
                fail_msg("coordinate %zu, order %zu: %.17g for %.17g", i, k,
                         qdot_taylor_input(t, i)[k], lanes[i][k]);
    qdot_taylor_free(t);
    qdot_motion_clear(&m);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_lead),
        cmocka_unit_test(what_is_not_known_yet_is_refused),
        cmocka_unit_test(forms_and_executors_agree),
        cmocka_unit_test(explicit_equations_beside_others),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
