/* orbit-period.c -- the drive's frequencies, and whether the equations are periodic with the given period. */
#include "sim/branches/orbit-period.h"

#include <math.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "sim/model/substitute.h"
#include "tape/tape.h"

/* How far equations may differ after a period, beside how much they change with time, and beside what they are; states,
 * and times, where it is asked. */
static const double same = 1e-7, rounding = 1e-14;
enum { ASKED = 8 };

typedef qdot_vec(qdot_expr) list;

static qdot_status
append_with_values(list *all, qdot_scene *s, const qdot_run_request *r, qdot_expr e)
{
    e = qdot_substitute(s->pool, e, r->n_values, r->symbols, r->values);
    QDOT_TRY(qdot_pool_check(s->pool));
    return qdot_vec_push(all, e);
}

/* Collect all components of the expression e, with numbers inserted for symbols. */
static qdot_status
append_components(list *all, qdot_scene *s, const qdot_run_request *r, qdot_expr e)
{
    QDOT_TRY(qdot_pool_check(s->pool));
    for (uint32_t i = 0; i < qdot_expr_count(s->pool, e); i++)
        QDOT_TRY(append_with_values(all, s, r, qdot_expr_arg(s->pool, e, i)));
    return QDOT_OK;
}

/* Collect the frequencies in M, f and events. An event without direction occurs where the square of
 * its function is 0. */
static qdot_status
collect_equations(qdot_scene *s, const qdot_run_request *r, list *all)
{
    QDOT_TRY(append_components(all, s, r, qdot_mech_numeric_mass(s)));
    QDOT_TRY(append_components(all, s, r, qdot_mech_numeric_forcing(s)));
    for (size_t k = 0; k < s->events.n; k++) {
        const qdot_event *e = &s->events.at[k];
        qdot_expr g = qdot_sub(s->pool, e->left, e->right);

        if (e->targets.n == 0)
            continue;
        QDOT_TRY(append_with_values(all, s, r, e->way == 0 ? qdot_mul(s->pool, g, g) : g));
        for (size_t i = 0; i < e->targets.n; i++)
            QDOT_TRY(append_with_values(all, s, r, e->values.at[i]));
    }
    return QDOT_OK;
}

static bool
depends_on_time(const qdot_pool *pool, qdot_expr e)
{
    return (qdot_expr_node(pool, e)->holds & QDOT_HAS_TIME) != 0;
}

qdot_status
qdot_orbit_is_driven(qdot_scene *s, const qdot_run_request *r, bool *driven)
{
    list all = {0};
    const qdot_status status = collect_equations(s, r, &all);

    *driven = false;
    for (size_t i = 0; i < all.n; i++)
        *driven = *driven || depends_on_time(s->pool, all.at[i]);
    qdot_free(all.at);
    return status;
}

/* Evaluate the expression e where the parameter p has the value `at`. */
static qdot_status
evaluate_at_parameter(qdot_pool *pool, qdot_expr e, qdot_expr p, double at, double *value)
{
    qdot_tape *tape = NULL;
    double work[64], *more;
    const qdot_status status = qdot_tape_new(pool, p == QDOT_NIL ? 0 : 1, &p, 1, &e, &tape);

    if (status != QDOT_OK)
        return status;
    more = qdot_tape_work(tape) > 64 ? qdot_malloc(qdot_tape_work(tape) * sizeof *more) : work;
    *value = NAN;
    if (more != NULL)
        qdot_tape_eval(tape, &at, value, more);
    if (more != work)
        qdot_free(more);
    qdot_tape_free(tape);
    return QDOT_OK;
}

/* The rate of a phase in e, the argument of a sine or cosine that goes evenly with time; nil: none. One that holds p
 * before any other. */
static qdot_status
find_drive_frequency(qdot_pool *pool, qdot_expr e, qdot_expr p, qdot_expr *rate)
{
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    for (size_t i = 0; i < w.n; i++) {
        const uint32_t op = qdot_expr_node(pool, w.at[i])->op;
        qdot_expr a;

        if (qdot_expr_kind(pool, w.at[i]) != QDOT_FUN || (op != QDOT_SIN && op != QDOT_COS) ||
            !depends_on_time(pool, w.at[i]))
            continue;
        a = qdot_diff(pool, qdot_expr_arg(pool, w.at[i], 0), QDOT_T);
        if (a == QDOT_NIL || a == QDOT_ZERO ||
            (qdot_expr_node(pool, a)->holds &
             (QDOT_HAS_TIME | QDOT_HAS_COORD | QDOT_HAS_VELOCITY)) != 0)
            continue;
        if (*rate == QDOT_NIL ||
            (p != QDOT_NIL && qdot_expr_contains(pool, a, p) && !qdot_expr_contains(pool, *rate, p)))
            *rate = a;
    }
    qdot_walk_end(&w);
    return qdot_pool_check(pool);
}

/* Evaluate all in one state over a period: how they are at first, how far from it they come, how far they are from what
 * they are after T. value: [5 m] and room: now, later, these three. */
static void
compare_after_period(const qdot_tape *tape, size_t n, size_t m, double T, double *in, double *value)
{
    double *const first = value + 2 * m, *const change = first + m, *const off = change + m;

    for (size_t k = 0; k < ASKED; k++) {
        in[2 * n] = T * (double)k / (ASKED + 0.385);
        qdot_tape_eval(tape, in, value, value + 6 * m);
        for (size_t i = 0; i < m; i++) {
            first[i] = k == 0 ? value[i] : first[i];
            change[i] = fmax(k == 0 ? 0 : change[i], fabs(value[i] - first[i]));
            change[i] = fmax(change[i], fabs(value[m + i] - first[i]));
            off[i] = fmax(k == 0 ? 0 : off[i], fabs(value[m + i] - value[i]));
        }
    }
}

/* Whether all are the same in the same state after T; in: 2n + 2 numbers and room, tape: now, then later. One that has no
 * value in any of these states is not. */
static bool
has_period(const qdot_tape *tape, size_t n, size_t m, double T, double *in)
{
    /* values of several sizes, so that some lie in the domains of all functions */
    static const double sizes[] = {1, -0.1, 0.01, -1e-3};
    double *const value = in + 2 * n + 2, *const known = value + 5 * m;
    const double *const first = value + 2 * m, *const change = first + m, *const off = change + m;

    for (size_t k = 0; k < ASKED; k++) {
        for (size_t i = 0; i < 2 * n; i++) /* irregular values, to avoid points of symmetry */
            in[i] = sizes[k % 4] * (0.3 + 0.17 * (double)((5 * i + 3 * k) % 7));
        compare_after_period(tape, n, m, T, in, value);
        for (size_t i = 0; i < m; i++) {
            known[i] += isfinite(first[i]) != 0;
            if (off[i] > same * change[i] + rounding * fabs(first[i]))
                return false;
        }
    }
    for (size_t i = 0; i < m; i++)
        if (known[i] == 0)
            return false;
    return true;
}

static qdot_status
fail_not_periodic(const qdot_pool *pool, qdot_expr p, double at, double T)
{
    if (p == QDOT_NIL)
        return qdot_fail(QDOT_EINVAL,
                         "the equations do not have the period %.10g: they change with time", T);
    return qdot_fail(QDOT_EINVAL,
                     "the equations do not have the period %.10g at %s = %.10g: they change with time",
                     T, qdot_expr_symbol(pool, p)->name, at);
}

/* Fail unless all time-dependent forces have the given period, at the value `at` of p. */
static qdot_status
check_period(qdot_scene *s, const list *all, qdot_expr p, double at, qdot_expr period)
{
    qdot_pool *pool = s->pool;
    const size_t n = s->coordinates.n, m = all->n, k = 2 * n + (p == QDOT_NIL ? 1 : 2);
    const qdot_expr t = QDOT_T, later = qdot_add(pool, t, period);
    qdot_expr *e = qdot_calloc(2 * m + 2 * n + 2, sizeof *e), *const inputs = e + 2 * m;
    double *in = NULL, T = NAN;
    qdot_tape *tape = NULL;
    qdot_status status = e ? evaluate_at_parameter(pool, period, p, at, &T) : QDOT_ENOMEM;

    for (size_t i = 0; i < m && status == QDOT_OK; i++) {
        e[i] = all->at[i];
        e[m + i] = qdot_subs(pool, e[i], 1, &t, &later);
    }
    for (size_t i = 0; i < 2 * n && status == QDOT_OK; i++)
        inputs[i] = qdot_symbol_jet(pool, s->coordinates.at[i % n], i >= n);
    if (status == QDOT_OK) {
        inputs[2 * n] = t;
        inputs[2 * n + 1] = p;
        status = qdot_pool_check(pool);
    }
    if (status == QDOT_OK)
        status = qdot_tape_new(pool, k, inputs, 2 * m, e, &tape);
    if (status == QDOT_OK) {
        in = qdot_calloc(2 * n + 2 + 6 * m + qdot_tape_work(tape), sizeof *in);
        status = in ? QDOT_OK : QDOT_ENOMEM;
    }
    if (status == QDOT_OK) {
        in[2 * n + 1] = at;
        if (!has_period(tape, n, m, T, in))
            status = fail_not_periodic(pool, p, at, T);
    }
    qdot_tape_free(tape);
    qdot_free(in);
    qdot_free(e);
    return status;
}

/* *period is pi k / a if this has the value T at p = at (half the period, which squares have); T
 * itself if no a fits. */
static qdot_status
make_period_expression(qdot_pool *pool, qdot_expr rate, qdot_expr p, double at, double T, qdot_expr *period)
{
    double a, turns;

    *period = qdot_expr_of_double(pool, T);
    if (rate == QDOT_NIL)
        return qdot_pool_check(pool);
    QDOT_TRY(evaluate_at_parameter(pool, rate, p, at, &a));
    turns = round(fabs(a) * T / M_PI);
    if (turns >= 1 && fabs(fabs(a) * T / M_PI - turns) < 1e-6 * turns)
        *period = qdot_div(pool,
                           qdot_mul(pool, QDOT_PI,
                                    qdot_expr_int(pool, (a < 0 ? -1 : 1) * (int64_t)turns)),
                           rate);
    return qdot_pool_check(pool);
}

qdot_status
qdot_orbit_period(qdot_scene *s, const qdot_run_request *r, qdot_expr p, double at, double T,
                  double least, double most, qdot_expr *period)
{
    list all = {0};
    qdot_expr rate = QDOT_NIL;
    qdot_status status = collect_equations(s, r, &all);

    for (size_t i = 0; i < all.n && status == QDOT_OK; i++)
        status = find_drive_frequency(s->pool, all.at[i], p, &rate);
    if (status == QDOT_OK)
        status = make_period_expression(s->pool, rate, p, at, T, period);
    if (status == QDOT_OK)
        status = check_period(s, &all, p, at, *period);
    if (status == QDOT_OK && p != QDOT_NIL && least < at)
        status = check_period(s, &all, p, least + 1e-3 * (at - least), *period);
    if (status == QDOT_OK && p != QDOT_NIL && most > at)
        status = check_period(s, &all, p, most - 1e-3 * (most - at), *period);
    qdot_free(all.at);
    return status;
}
