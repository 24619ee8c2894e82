/* sweep-axis.c -- the parameters that a sweep varies, and their values. */
#include "lang/sweeps/sweep-axis.h"

#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "lang/commands/set.h"
#include "lang/language/token-text.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"

static const double most_members = 1e7;

/* The largest seed: the generator uses only 32 bits of it. */
static const int64_t most_seed = 0xffffffff;

/* Begin the sequence of random numbers of a seed. GSL replaces the seed 0 by 4357, but uses the lower 32 bits only: where its
 * `long` has 64, a number whose lower ones are 0 stands for it; else 0 is spread over the generator's words here, as GSL does it
 * with other seeds (Matsumoto and Nishimura, init_genrand of 2002). */
static void
seed_generator(gsl_rng *random, uint64_t seed)
{
#if ULONG_MAX > UINT32_MAX
    gsl_rng_set(random, seed != 0 ? seed : UINT64_C(1) << 32);
#else
    gsl_rng_set(random, (unsigned long)seed);
    if (seed == 0) {
        unsigned long *word = gsl_rng_state(random);

        word[0] = 0;
        for (unsigned long i = 1; i < 624; i++)
            word[i] = 1812433253 * (word[i - 1] ^ word[i - 1] >> 30) + i;
    }
#endif
}

void
qdot_sweep_axes_free(qdot_sweep_axes *axes)
{
    for (size_t i = 0; i < axes->at.n; i++)
        qdot_free(axes->at.at[i].label);
    qdot_free(axes->at.at);
    qdot_free(axes->drawn);
    *axes = (qdot_sweep_axes){0};
}

/* Evaluate e to an exact constant, with the session's values. */
static qdot_status
evaluate_to_constant(qdot_session *session, qdot_expr e, qdot_expr *value, double *number)
{
    *value = qdot_session_bind(session, qdot_measured_as_rationals(session, e));
    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(qdot_session_number(session, *value, number, NULL));
    return isfinite(*number) ? QDOT_OK
                             : qdot_fail(QDOT_EINVAL, "a sweep runs over finite numbers");
}

/* Read `step H` after a range A..B of swept values. */
static qdot_status
read_step(qdot_record *r, const qdot_filled *part, double a, double b, qdot_sweep_axis *x)
{
    double h, count;
    qdot_expr e;

    QDOT_TRY(qdot_record_scalar(r, part, &e));
    qdot_record_blame(r, part);
    QDOT_TRY(evaluate_to_constant(r->cursor.session, e, &x->step, &h));
    if (!(h * (b - a) >= 0) || h == 0)
        return qdot_fail(QDOT_EINVAL, "a step of %.6g does not lead from %.6g to %.6g", h, a, b);
    count = floor((b - a) / h * (1 + 1e-12)) + 1;
    if (!(count <= most_members))
        return qdot_fail(QDOT_ELIMIT, "%.3g values: more than %.0e", count, most_members);
    x->n = (size_t)count;
    return QDOT_OK;
}

/* Read `count N` after a range A..B of swept values. */
static qdot_status
read_count(qdot_record *r, const qdot_filled *part, qdot_expr to, qdot_sweep_axis *x)
{
    qdot_pool *pool = r->cursor.session->pool;
    int64_t n;

    QDOT_TRY(qdot_record_integer(r, part, &n));
    qdot_record_blame(r, part);
    if (n < 1)
        return qdot_fail(QDOT_EINVAL, "a sweep of %" PRId64 " values has none", n);
    if ((double)n > most_members)
        return qdot_fail(QDOT_ELIMIT, "%" PRId64 " values: more than %.0e", n, most_members);
    x->n = (size_t)n;
    x->step = n == 1 ? QDOT_ZERO
                     : qdot_div(pool, qdot_sub(pool, to, x->from), qdot_expr_int(pool, n - 1));
    return qdot_pool_check(pool);
}

/* The words of the options found among the parts of an axis, which lie between its values and `to`. */
typedef struct {
    const qdot_filled *step, *count, *seed;
} axis_options;

static axis_options
find_axis_options(const qdot_filled *values, const qdot_filled *to)
{
    axis_options o = {0};

    for (const qdot_filled *part = values + 1; part < to && part->node->kind == QDOT_USAGE_WORD; part += 2) {
        o.step = qdot_filled_is(part, "step") ? part : o.step;
        o.count = qdot_filled_is(part, "count") ? part : o.count;
        o.seed = qdot_filled_is(part, "seed") ? part : o.seed;
    }
    return o;
}

/* Fail at the word of an option that does not fit the swept values; do nothing if `word` is NULL. */
static qdot_status
refuse_option(qdot_record *r, const qdot_filled *word)
{
    if (word == NULL)
        return QDOT_OK;
    qdot_record_blame(r, word);
    return qdot_fail(QDOT_ESYNTAX, "expected `,` or `run T0..T1`, found `%s`", word->from->text);
}

/* Fail because a single value was given where a range is needed; first report errors in the value itself. */
static qdot_status
refuse_single_value(qdot_record *r, const qdot_filled *part, const qdot_sweep_axis *x)
{
    qdot_expr value;

    QDOT_TRY(qdot_record_scalar(r, part, &value));
    qdot_record_blame(r, part);
    (void)qdot_fail(QDOT_ESYNTAX, "a sweep runs over a range `a..b` or a list, not over one value");
    return qdot_hint("%s = 0..1 count 11", x->label);
}

static qdot_status
read_range_of_values(qdot_record *r, const qdot_filled *range, const axis_options *o, qdot_sweep_axis *x)
{
    qdot_expr from, to;
    double a, b;

    if (range->n < 2)
        return refuse_single_value(r, range, x);
    QDOT_TRY(qdot_record_range(r, range, &from, &to));
    QDOT_TRY(qdot_set_check_dimension(r, range, x->symbol, from));
    QDOT_TRY(qdot_set_check_dimension(r, range, x->symbol, to));
    qdot_record_blame(r, range);
    QDOT_TRY(evaluate_to_constant(r->cursor.session, from, &x->from, &a));
    QDOT_TRY(evaluate_to_constant(r->cursor.session, to, &to, &b));
    x->kind = QDOT_AXIS_LADDER;
    if (o->step == NULL && o->count == NULL) {
        (void)qdot_record_expected(r, range->to, "`step` or `count`");
        return qdot_hint("%s = %.6g..%.6g count 11", x->label, a, b);
    }
    QDOT_TRY(refuse_option(r, o->seed));
    if (o->step == NULL)
        return read_count(r, o->count + 1, to, x);
    QDOT_TRY(refuse_option(r, o->count));
    return read_step(r, o->step + 1, a, b, x);
}

static qdot_status
read_list_of_values(qdot_record *r, const qdot_filled *part, const axis_options *o, qdot_sweep_axis *x)
{
    qdot_session *session = r->cursor.session;

    QDOT_TRY(qdot_record_value(r, part, &x->list));
    qdot_record_blame(r, part);
    x->kind = QDOT_AXIS_LIST;
    x->n = qdot_expr_kind(session->pool, x->list) == QDOT_LIST ? qdot_expr_count(session->pool, x->list) : 0;
    if (x->n == 0)
        return qdot_fail(QDOT_ETYPE, "a sweep runs over a list of numbers");
    for (uint32_t k = 0; k < x->n; k++)
        QDOT_TRY(qdot_set_check_dimension(r, part, x->symbol, qdot_expr_arg(session->pool, x->list, k)));
    x->list = qdot_session_bind(session, qdot_measured_as_rationals(session, x->list));
    QDOT_TRY(qdot_pool_check(session->pool));
    for (size_t k = 0; k < x->n; k++) {
        const qdot_expr e = qdot_expr_arg(session->pool, x->list, (uint32_t)k);
        qdot_expr value;
        double number;

        QDOT_TRY(evaluate_to_constant(session, e, &value, &number));
    }
    QDOT_TRY(refuse_option(r, o->step));
    QDOT_TRY(refuse_option(r, o->count));
    return refuse_option(r, o->seed);
}

/* Read normal(A, B) or uniform(A, B), random values; *is: it is one of the two. */
static qdot_status
read_distribution(qdot_record *r, const qdot_filled *part, const axis_options *o, qdot_sweep_axis *x, bool *is)
{
    qdot_session *session = r->cursor.session;
    qdot_expr ends[2];

    x->kind = QDOT_AXIS_NORMAL;
    QDOT_TRY(qdot_record_call_of_two(r, part, "normal", ends, is));
    if (!*is) {
        x->kind = QDOT_AXIS_UNIFORM;
        QDOT_TRY(qdot_record_call_of_two(r, part, "uniform", ends, is));
    }
    if (!*is)
        return QDOT_OK;
    for (int k = 0; k < 2; k++)
        QDOT_TRY(qdot_set_check_dimension(r, part, x->symbol, ends[k]));
    qdot_record_blame(r, part);
    QDOT_TRY(qdot_session_number(session, ends[0], &x->a, NULL));
    QDOT_TRY(qdot_session_number(session, ends[1], &x->b, NULL));
    if (x->kind == QDOT_AXIS_NORMAL && !(x->b >= 0))
        return qdot_fail(QDOT_EINVAL, "a standard deviation is not negative");
    if (x->kind == QDOT_AXIS_UNIFORM && !(x->a <= x->b))
        return qdot_fail(QDOT_EINVAL, "uniform(A, B) needs A <= B");
    return refuse_option(r, o->step);
}

/* Find the parameter, coordinate or velocity to vary by the name before `=`. */
static qdot_status
find_swept_symbol(qdot_record *r, qdot_sweep_axis *x)
{
    qdot_text text = {0};

    QDOT_TRY(qdot_set_find_symbol(r, x->place, &x->symbol));
    QDOT_TRY(qdot_set_need_read(r, x->place, x->symbol));
    qdot_token_text(r->cursor.session, x->place->from, x->place->to, &text);
    if (qdot_text_status(&text) != QDOT_OK) {
        qdot_text_clear(&text);
        return QDOT_ENOMEM;
    }
    x->label = text.at;
    return QDOT_OK;
}

/* Read an axis of a sweep, NAME = VALUES [options]; this part of the statement is its name. */
static qdot_status
read_axis(qdot_record *r, const qdot_filled *name, const qdot_filled *to, qdot_sweep_axis *x)
{
    const qdot_filled *values = name + 2;
    const axis_options o = find_axis_options(values, to);
    bool random;

    *x = (qdot_sweep_axis){.place = name};
    QDOT_TRY(find_swept_symbol(r, x));
    if (qdot_compiled_is_list(&r->compiled.at[values->first]))
        return read_list_of_values(r, values, &o, x);
    QDOT_TRY(read_distribution(r, values, &o, x, &random));
    return random ? QDOT_OK : read_range_of_values(r, values, &o, x);
}

static qdot_status
draw_random_values(qdot_sweep_axes *axes)
{
    const size_t n = axes->at.n;
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);

    axes->drawn = qdot_calloc(axes->members * n + 1, sizeof *axes->drawn);
    if (random == NULL || axes->drawn == NULL) {
        if (random != NULL)
            gsl_rng_free(random);
        return qdot_fail(QDOT_ENOMEM, "no memory for %zu members", axes->members);
    }
    seed_generator(random, axes->seed);
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

/* Read `count N` and `seed K`, which stand after the last of the random axes of a sweep. */
static qdot_status
read_count_and_seed(qdot_record *r, const qdot_filled *to, qdot_sweep_axes *axes)
{
    const qdot_filled *last = axes->at.at[axes->at.n - 1].place + 2;
    const axis_options o = find_axis_options(last, to);
    const qdot_token *start = last->to;
    int64_t count = 0, seed = 0;

    if (o.count != NULL)
        QDOT_TRY(qdot_record_integer(r, o.count + 1, &count));
    if (o.seed != NULL)
        QDOT_TRY(qdot_record_integer(r, o.seed + 1, &seed));
    r->cursor.error_at = start->start;
    if (count < 1)
        return qdot_record_expected(r, to < r->parts.at + r->parts.n ? to->from : r->cursor.at,
                                    "`count` and how many are drawn");
    if ((double)count > most_members)
        return qdot_fail(QDOT_ELIMIT, "%" PRId64 " members: more than %.0e", count, most_members);
    if (seed < 0 || seed > most_seed)
        return qdot_fail(QDOT_EINVAL, "a seed is a whole number from 0 to %" PRId64, most_seed);
    axes->members = (size_t)count;
    axes->seed = (uint64_t)seed;
    return draw_random_values(axes);
}

/* Check that the options `count` and `seed` come after all random axes of the sweep. */
static qdot_status
check_count_and_seed(qdot_record *r, const qdot_sweep_axes *axes)
{
    for (size_t i = 0; i + 1 < axes->at.n; i++) {
        const qdot_filled *behind = axes->at.at[i].place + 3;

        if (!qdot_filled_is(behind, ","))
            return qdot_record_expected(r, (axes->at.at[i + 1].place - 1)->from,
                                        "`run T0..T1`, `count` or `seed`");
    }
    return QDOT_OK;
}

/* Check that all axes are random or none is, and that their names differ; compute the number of runs. */
static qdot_status
check_axes(qdot_record *r, qdot_sweep_axes *axes)
{
    double members = 1;

    for (size_t i = 0; i < axes->at.n; i++) {
        const qdot_sweep_axis *x = &axes->at.at[i];

        qdot_record_blame(r, x->place);
        members *= (double)x->n;
        for (size_t k = 0; k < i; k++)
            if (axes->at.at[k].symbol == x->symbol)
                return qdot_fail(QDOT_EINVAL, "%s is swept twice", x->label);
        if ((x->n == 0) != axes->random)
            return qdot_fail(QDOT_EINVAL, "a sweep is random in all of its parameters or in none");
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
qdot_sweep_axes_find(qdot_record *r, const qdot_filled *from, const qdot_filled *to, qdot_sweep_axes *axes)
{
    for (const qdot_filled *part = from; part < to; part++) {
        qdot_sweep_axis x;
        qdot_status status;

        if (part->node->kind != QDOT_USAGE_HOLE || !qdot_filled_is(part, "NAME"))
            continue;
        status = read_axis(r, part, to, &x);
        if (status == QDOT_OK)
            status = qdot_vec_push(&axes->at, x);
        if (status != QDOT_OK) {
            qdot_free(x.label);
            return status;
        }
    }
    axes->random = axes->at.at[0].n == 0;
    QDOT_TRY(check_axes(r, axes));
    if (!axes->random)
        return QDOT_OK;
    QDOT_TRY(check_count_and_seed(r, axes));
    return read_count_and_seed(r, to, axes);
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
    return qdot_add(pool, x->from, qdot_mul(pool, qdot_expr_int(pool, (int64_t)k), x->step));
}
