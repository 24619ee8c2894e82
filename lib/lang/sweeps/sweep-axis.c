/* sweep-axis.c -- reads what a sweep runs over. */
#include "lang/sweeps/sweep-axis.h"

#include <math.h>
#include <string.h>

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include "lang/commands/set.h"
#include "lang/language/read.h"
#include "lang/language/token-text.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"

static const double most_members = 1e7;

/* The generator takes 32 bits of a seed, and no more. */
static const long most_seed = 0xffffffff;

/* GSL takes 4357 for 0, and of other numbers the lower 32 bits: of this one they are 0. */
static const unsigned long instead_of_0 = (unsigned long)UINT64_C(0x100000000);

void
qdot_sweep_axes_free(qdot_sweep_axes *axes)
{
    for (size_t i = 0; i < axes->at.n; i++)
        qdot_free(axes->at.at[i].label);
    qdot_free(axes->at.at);
    qdot_free(axes->drawn);
    *axes = (qdot_sweep_axes){0};
}

/* e as a constant of the session, exact. */
static qdot_status
constant(qdot_session *session, qdot_expr e, qdot_expr *value, double *number)
{
    *value = qdot_session_bind(session, qdot_measured_as_rationals(session, e));
    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(qdot_session_number(session, *value, number, NULL));
    return isfinite(*number) ? QDOT_OK
                             : qdot_fail(QDOT_EINVAL, "a sweep runs over finite numbers");
}

/* `step H` behind A..B. */
static qdot_status
read_step(qdot_cursor *c, double a, double b, qdot_sweep_axis *x)
{
    const qdot_token *start = c->at;
    double h, count;
    qdot_expr e;

    QDOT_TRY(qdot_read_scalar(c, &e));
    c->error_at = start->start;
    QDOT_TRY(constant(c->session, e, &x->step, &h));
    if (!(h * (b - a) >= 0) || h == 0)
        return qdot_fail(QDOT_EINVAL, "a step of %.6g does not lead from %.6g to %.6g", h, a, b);
    count = floor((b - a) / h * (1 + 1e-12)) + 1;
    if (!(count <= most_members))
        return qdot_fail(QDOT_ELIMIT, "%.3g values: more than %.0e", count, most_members);
    x->n = (size_t)count;
    return QDOT_OK;
}

/* `count N` behind A..B. */
static qdot_status
read_count(qdot_cursor *c, qdot_expr from, qdot_expr to, qdot_sweep_axis *x)
{
    qdot_pool *pool = c->session->pool;
    const qdot_token *start = c->at;
    long n;

    QDOT_TRY(qdot_read_integer(c, &n));
    c->error_at = start->start;
    if (n < 1)
        return qdot_fail(QDOT_EINVAL, "a sweep of %ld values has none", n);
    if ((double)n > most_members)
        return qdot_fail(QDOT_ELIMIT, "%ld values: more than %.0e", n, most_members);
    x->n = (size_t)n;
    x->step = n == 1 ? QDOT_ZERO
                     : qdot_div(pool, qdot_sub(pool, to, from), qdot_expr_int(pool, n - 1));
    return qdot_pool_check(pool);
}

static qdot_status
read_ladder(qdot_cursor *c, qdot_sweep_axis *x)
{
    const qdot_token *start = c->at;
    qdot_expr from, to;
    double a, b;

    QDOT_TRY(qdot_read_range(c, &from, &to));
    c->error_at = start->start;
    QDOT_TRY(constant(c->session, from, &x->from, &a));
    QDOT_TRY(constant(c->session, to, &to, &b));
    x->kind = QDOT_AXIS_LADDER;
    if (qdot_cursor_accept_word(c, "step"))
        return read_step(c, a, b, x);
    if (qdot_cursor_accept_word(c, "count"))
        return read_count(c, x->from, to, x);
    (void)qdot_cursor_expected(c, "`step` or `count`");
    return qdot_hint("%s = %.6g..%.6g count 11", x->label, a, b);
}

static qdot_status
read_list(qdot_cursor *c, qdot_sweep_axis *x)
{
    const qdot_token *start = c->at;

    QDOT_TRY(qdot_read_side(c, &x->list));
    c->error_at = start->start;
    x->kind = QDOT_AXIS_LIST;
    x->n = qdot_expr_kind(c->session->pool, x->list) == QDOT_LIST
               ? qdot_expr_count(c->session->pool, x->list)
               : 0;
    if (x->n == 0)
        return qdot_fail(QDOT_ETYPE, "a sweep runs over a list of numbers");
    x->list = qdot_session_bind(c->session, qdot_measured_as_rationals(c->session, x->list));
    QDOT_TRY(qdot_pool_check(c->session->pool));
    for (size_t k = 0; k < x->n; k++) {
        const qdot_expr e = qdot_expr_arg(c->session->pool, x->list, (uint32_t)k);
        qdot_expr value;
        double number;

        QDOT_TRY(constant(c->session, e, &value, &number));
    }
    return QDOT_OK;
}

/* normal(A, B) or uniform(A, B). */
static qdot_status
read_random(qdot_cursor *c, qdot_sweep_axis *x)
{
    const qdot_token *start = c->at;

    x->kind = strcmp(c->at->text, "normal") == 0 ? QDOT_AXIS_NORMAL : QDOT_AXIS_UNIFORM;
    c->at++;
    QDOT_TRY(qdot_cursor_expect_op(c, "("));
    QDOT_TRY(qdot_read_number(c, &x->a));
    QDOT_TRY(qdot_cursor_expect_op(c, ","));
    QDOT_TRY(qdot_read_number(c, &x->b));
    QDOT_TRY(qdot_cursor_expect_op(c, ")"));
    c->error_at = start->start;
    if (x->kind == QDOT_AXIS_NORMAL && !(x->b >= 0))
        return qdot_fail(QDOT_EINVAL, "a standard deviation is not negative");
    if (x->kind == QDOT_AXIS_UNIFORM && !(x->a <= x->b))
        return qdot_fail(QDOT_EINVAL, "uniform(A, B) wants A <= B");
    return QDOT_OK;
}

/* The name in front of `=`. */
static qdot_status
read_symbol(qdot_cursor *c, qdot_sweep_axis *x)
{
    qdot_cursor look = *c;
    const qdot_name *known = NULL;
    qdot_text text = {0};
    const char *name;

    if (c->at->kind != QDOT_TOKEN_NAME)
        return qdot_cursor_expected(c, "what the sweep runs over: `omega = 0..5 step 0.1`");
    if (qdot_read_name(&look, &name) == QDOT_OK)
        known = qdot_names_find(c->session->names, name);
    if (known != NULL && known->kind == QDOT_NAME_COORD)
        QDOT_TRY(qdot_set_read_jet(c, &x->symbol));
    else
        QDOT_TRY(qdot_set_read_parameter(c, &x->symbol));
    qdot_token_text(c->session, x->place, c->at, &text);
    if (qdot_text_status(&text) != QDOT_OK) {
        qdot_text_clear(&text);
        return QDOT_ENOMEM;
    }
    x->label = text.at;
    return QDOT_OK;
}

static qdot_status
read_axis(qdot_cursor *c, qdot_sweep_axis *x)
{
    *x = (qdot_sweep_axis){.place = c->at};
    QDOT_TRY(read_symbol(c, x));
    QDOT_TRY(qdot_cursor_expect_op(c, "="));
    if (qdot_cursor_is_op(c, "["))
        return read_list(c, x);
    if ((qdot_cursor_is_word(c, "normal") || qdot_cursor_is_word(c, "uniform"))
        && qdot_token_is(c->at + 1, "("))
        return read_random(c, x);
    return read_ladder(c, x);
}

static qdot_status
axes_draw_values(qdot_sweep_axes *axes)
{
    const size_t n = axes->at.n;
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);

    axes->drawn = qdot_calloc(axes->members * n + 1, sizeof *axes->drawn);
    if (random == NULL || axes->drawn == NULL) {
        if (random != NULL)
            gsl_rng_free(random);
        return qdot_fail(QDOT_ENOMEM, "no memory for %zu members", axes->members);
    }
    gsl_rng_set(random, axes->seed != 0 ? axes->seed : instead_of_0);
    for (size_t k = 0; k < axes->members; k++)
        for (size_t i = 0; i < n; i++) {
            const qdot_sweep_axis *x = &axes->at.at[i];

            axes->drawn[k * n + i] =
                x->kind == QDOT_AXIS_NORMAL ? x->a + gsl_ran_gaussian(random, x->b)
                                            : gsl_ran_flat(random, x->a, x->b);
        }
    gsl_rng_free(random);
    return QDOT_OK;
}

/* `count N` and `seed K` of random axes. */
static qdot_status
read_draws(qdot_cursor *c, qdot_sweep_axes *axes)
{
    const qdot_token *start = c->at;
    long count = 0, seed = 0;
    bool seeded = false;

    while (qdot_cursor_is_word(c, "count") || qdot_cursor_is_word(c, "seed"))
        if (qdot_cursor_accept_word(c, "count")) {
            QDOT_TRY(qdot_cursor_once(c, "count", count != 0));
            QDOT_TRY(qdot_read_integer(c, &count));
        } else {
            c->at++;
            QDOT_TRY(qdot_cursor_once(c, "seed", seeded));
            QDOT_TRY(qdot_read_integer(c, &seed));
            seeded = true;
        }
    c->error_at = start->start;
    if (count < 1)
        return qdot_cursor_expected(c, "`count` and how many are drawn");
    if ((double)count > most_members)
        return qdot_fail(QDOT_ELIMIT, "%ld members: more than %.0e", count, most_members);
    if (seed < 0 || seed > most_seed)
        return qdot_fail(QDOT_EINVAL, "a seed is a whole number from 0 to %ld", most_seed);
    axes->members = (size_t)count;
    axes->seed = (unsigned long)seed;
    return axes_draw_values(axes);
}

/* The axes are of one kind, and differ; how many members they have. */
static qdot_status
axes_check(qdot_cursor *c, qdot_sweep_axes *axes)
{
    double members = 1;

    for (size_t i = 0; i < axes->at.n; i++) {
        const qdot_sweep_axis *x = &axes->at.at[i];

        c->error_at = x->place->start;
        members *= (double)x->n;
        for (size_t k = 0; k < i; k++)
            if (axes->at.at[k].symbol == x->symbol)
                return qdot_fail(QDOT_EINVAL, "%s is swept twice", x->label);
        if ((x->n == 0) != axes->random)
            return qdot_fail(QDOT_EINVAL, "a sweep is random in all it runs over, or in nothing");
    }
    if (axes->random)
        return QDOT_OK;
    if (members > most_members)
        return qdot_fail(QDOT_ELIMIT, "a sweep of %.3g runs: more than %.0e", members,
                         most_members);
    axes->members = (size_t)members;
    return QDOT_OK;
}

qdot_status
qdot_sweep_axes_read(qdot_cursor *c, qdot_sweep_axes *axes)
{
    do {
        qdot_sweep_axis x;
        qdot_status status = read_axis(c, &x);

        if (status == QDOT_OK)
            status = qdot_vec_push(&axes->at, x);
        if (status != QDOT_OK) {
            qdot_free(x.label);
            return status;
        }
    } while (qdot_cursor_accept_op(c, ","));
    axes->random = axes->at.at[0].n == 0;
    QDOT_TRY(axes_check(c, axes));
    return axes->random ? read_draws(c, axes) : QDOT_OK;
}

qdot_expr
qdot_sweep_axes_value(qdot_session *session, const qdot_sweep_axes *axes, size_t member,
                      size_t i)
{
    qdot_pool *pool = session->pool;
    const qdot_sweep_axis *x = &axes->at.at[i];
    size_t k = member;

    if (axes->random)
        return qdot_measured_rational(pool, axes->drawn[member * axes->at.n + i]);
    for (size_t j = axes->at.n; j-- > i + 1;)
        k /= axes->at.at[j].n;
    k %= x->n;
    if (x->kind == QDOT_AXIS_LIST)
        return qdot_measured_as_rationals(session, qdot_expr_arg(pool, x->list, (uint32_t)k));
    return qdot_add(pool, x->from, qdot_mul(pool, qdot_expr_int(pool, (long)k), x->step));
}
