/* solve-numbers.c -- zeros in numbers, with the values of a session. */
#include "lang/functions/solve-numbers.h"

#include <math.h>
#include <stdio.h>

#include "base/text.h"
#include "expr/calculus.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/answer/number-text.h"
#include "lang/functions/algebra.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/value-kind.h"
#include "normal/prove/decide.h"
#include "normal/solve/solve-system.h"
#include "normal/solve/zeros.h"
#include "num/lu.h"
#include "tape/constant.h"

enum { MOST = QDOT_ZEROS_MOST_UNKNOWNS, DIGITS = 17 };

/* Equations with the session's values put in, their unknowns as symbols of their own: x may have a value. */
typedef struct {
    qdot_session *session;
    size_t n;
    qdot_expr name[MOST], x[MOST]; /* as it was written; the symbol instead */
    qdot_expr f[MOST], F[MOST]; /* left - right; numbers of runs in it as exact numbers */
    bool measured;              /* there are such */
} question;

/* --- the question ------------------------------------------------------------------------------------ */

static qdot_status
add_unknown(question *q, qdot_expr x)
{
    char name[40];

    if (qdot_expr_kind(q->session->pool, x) != QDOT_SYM || x <= QDOT_FALSE)
        return qdot_fail(QDOT_ETYPE, "solve takes symbols as unknowns, not %s",
                         qdot_value_kind_words(q->session->pool, x));
    if (q->n == MOST)
        return qdot_fail(QDOT_ELIMIT, "solve takes up to %d unknowns", MOST);
    if (qdot_expr_place(q->n, q->name, x) < q->n)
        return qdot_fail(QDOT_EINVAL, "`%.200s` stands twice",
                         qdot_expr_symbol(q->session->pool, x)->name);
    snprintf(name, sizeof name, "unknown#%zu", q->n + 1);
    q->name[q->n] = x;
    q->x[q->n] = qdot_symbol_get(q->session->pool, QDOT_FORMAL, name);
    q->n++;
    return qdot_pool_check(q->session->pool);
}

/* What stands in e beside the unknowns and has no value. */
static qdot_status
need_values(const question *q, qdot_expr e)
{
    qdot_pool *pool = q->session->pool;
    qdot_expr atoms = qdot_expr_atoms(pool, e, true);

    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms); i++) {
        qdot_expr a = qdot_expr_arg(pool, atoms, i);
        const char *name;

        if (qdot_expr_place(q->n, q->x, a) < q->n ||
            qdot_expr_is_class(pool, a, QDOT_CONST))
            continue;
        name = qdot_expr_kind(pool, a) == QDOT_SYM
                   ? qdot_expr_symbol(pool, a)->name
                   : qdot_ufun_get(pool, qdot_expr_node(pool, a)->op)->name;
        (void)qdot_fail(QDOT_EUNSET, "`%.200s` has no value: solve in numbers needs one",
                        name);
        return qdot_hint("set %.100s = ...", name);
    }
    return QDOT_OK;
}

static qdot_status
set_equation(question *q, size_t i, qdot_expr e)
{
    qdot_pool *pool = q->session->pool;

    if (qdot_value_kind_is_equation(pool, e))
        e = qdot_sub(pool, qdot_expr_arg(pool, e, 0), qdot_expr_arg(pool, e, 1));
    QDOT_TRY(qdot_pool_check(pool));
    if (!qdot_expr_is_scalar(pool, e))
        return qdot_fail(QDOT_ETYPE, "solve takes equations between numbers, not %s",
                         qdot_value_kind_words(pool, e));
    e = qdot_session_bind(q->session, qdot_subs(pool, e, q->n, q->name, q->x));
    QDOT_TRY(qdot_value_kind_check(pool, e));
    q->f[i] = e;
    q->F[i] = qdot_measured_as_rationals(q->session, e);
    QDOT_TRY(qdot_value_kind_check(pool, q->F[i]));
    q->measured |= q->F[i] != e;
    return need_values(q, q->F[i]);
}

/* A constant that the session gives e; exact. */
static qdot_status
constant_of(const question *q, qdot_expr e, qdot_expr *value)
{
    qdot_expr bound = qdot_session_bind(q->session, e);

    QDOT_TRY(qdot_value_kind_check(q->session->pool, bound));
    *value = qdot_measured_as_rationals(q->session, bound);
    QDOT_TRY(qdot_value_kind_check(q->session->pool, *value));
    QDOT_TRY(need_values(q, *value));
    if (!qdot_expr_is_scalar(q->session->pool, *value))
        return qdot_fail(QDOT_ETYPE, "a number is needed, not %s",
                         qdot_value_kind_words(q->session->pool, *value));
    return QDOT_OK;
}

/* --- errors ---------------------------------------------------------------------------------------------- */

/* What the errors of numbers of runs in the equations make of the zero z: |f'^-1| df, to error [n]. */
static qdot_status
add_errors(const question *q, const double *z, double *error)
{
    qdot_pool *pool = q->session->pool;
    double J[MOST * MOST], df[MOST];
    qdot_lu_row rows[MOST];
    qdot_expr at[MOST];

    if (!q->measured)
        return QDOT_OK;
    for (size_t j = 0; j < q->n; j++)
        at[j] = qdot_expr_of_double(pool, z[j]);
    for (size_t i = 0; i < q->n; i++) {
        double value;

        QDOT_TRY(qdot_session_number(q->session, qdot_subs(pool, q->f[i], q->n, q->x, at),
                                     &value, &df[i]));
        for (size_t j = 0; j < q->n; j++)
            QDOT_TRY(qdot_session_number(
                q->session,
                qdot_subs(pool, qdot_diff(pool, q->F[i], q->x[j]), q->n, q->x, at),
                &J[i * q->n + j], NULL));
    }
    if (!qdot_lu_factor(q->n, J, rows)) {
        for (size_t j = 0; j < q->n; j++)
            error[j] = NAN;
        return QDOT_OK;
    }
    for (size_t i = 0; i < q->n; i++) {
        double column[MOST] = {0};

        column[i] = 1;
        qdot_lu_solve(q->n, J, rows, column);
        for (size_t j = 0; j < q->n; j++)
            error[j] += fabs(column[j]) * df[i];
    }
    return QDOT_OK;
}

/* Whether z [n] are numbers of few digits at which the equations hold exactly. */
static qdot_status
is_exact(const question *q, const double *z, bool *exact)
{
    qdot_pool *pool = q->session->pool;
    qdot_expr at[MOST];

    *exact = true;
    for (size_t j = 0; j < q->n && *exact; j++) {
        *exact = fabs(z[j]) < 1e6 && z[j] * 1024 == floor(z[j] * 1024);
        at[j] = qdot_expr_of_double(pool, z[j]);
    }
    for (size_t i = 0; i < q->n && *exact; i++)
        *exact = qdot_is_zero(pool, qdot_subs(pool, q->F[i], q->n, q->x, at), NULL);
    return qdot_pool_check(pool);
}

/* The k-th zero as numbers with errors. */
static qdot_status
numbers_of(const question *q, const qdot_zeros *z, size_t k, qdot_expr *numbers)
{
    double error[MOST];
    bool exact;

    QDOT_TRY(is_exact(q, z->at + k * q->n, &exact));
    for (size_t j = 0; j < q->n; j++) {
        error[j] = exact ? 0 : z->radius[k * q->n + j];
        if (!exact) /* so many digits are shown */
            error[j] += fabs(z->at[k * q->n + j]) * 1e-17;
    }
    QDOT_TRY(add_errors(q, z->at + k * q->n, error));
    for (size_t j = 0; j < q->n; j++) {
        double at = z->at[k * q->n + j];
        qdot_measured m = {
            .value = at, .error = error[j], .digits = DIGITS, .plain = true};

        m.exact = qdot_measured_rational(q->session->pool, at);
        QDOT_TRY(qdot_value_kind_check(q->session->pool, m.exact));
        numbers[j] = qdot_measured_add(q->session, m);
        QDOT_TRY(qdot_value_kind_check(q->session->pool, numbers[j]));
    }
    return QDOT_OK;
}

/* --- what is not proved --------------------------------------------------------------------------------- */

static qdot_status
tell_doubts(const question *q, const qdot_zeros *z)
{
    const char *name = qdot_expr_symbol(q->session->pool, q->name[0])->name;

    for (size_t k = 0; k < z->count && q->n == 1; k++) {
        qdot_text text = {0};
        qdot_status status;

        if (z->simple[k])
            continue;
        qdot_number_text(&text, z->at[k], z->radius[k]);
        status = qdot_answer_notice(q->session,
                                    "the zero %.100s = %s is not simple, or not "
                                    "proved to be",
                                    name, qdot_text_str(&text));
        qdot_text_clear(&text);
        QDOT_TRY(status);
    }
    for (size_t k = 0; k < z->doubts && q->n == 1; k++) {
        qdot_text text = {0};
        qdot_status status;

        qdot_number_text(&text, z->doubt[k],
                         fmax(z->reach[k], 1e-15 * fabs(z->doubt[k])));
        qdot_text_add(&text, " by ");
        qdot_number_text_bound(&text, fmax(z->reach[k], 1e-300));
        status = qdot_answer_notice(q->session,
                                    "whether there is a zero near %.100s = %s could "
                                    "not be decided",
                                    name, qdot_text_str(&text));
        qdot_text_clear(&text);
        QDOT_TRY(status);
    }
    if (z->exhausted)
        return qdot_answer_notice(q->session,
                                  "there may be more zeros: the search was ended");
    return QDOT_OK;
}

/* --- over a range ----------------------------------------------------------------------------------------- */

/* The double of a constant. */
static qdot_status
double_of(const question *q, qdot_expr e, double *x)
{
    return qdot_session_number(q->session, e, x, NULL);
}

/* One end of the range, or of the declared domain of x where that is narrower. */
static qdot_status
narrow_end(const question *q, qdot_expr declared, bool open, bool upper, qdot_expr *end,
           bool *end_open)
{
    qdot_expr e;
    double x, y;

    *end_open = false;
    if (declared == QDOT_NIL)
        return QDOT_OK;
    if (constant_of(q, declared, &e) != QDOT_OK) /* it depends on what has no value */
        return QDOT_OK;
    QDOT_TRY(double_of(q, e, &x));
    QDOT_TRY(double_of(q, *end, &y));
    if (upper ? x <= y : x >= y) {
        *end = e;
        *end_open = open;
    }
    return QDOT_OK;
}

static qdot_status
solve_range(question *q, const qdot_expr *ends, qdot_expr *value)
{
    const qdot_symbol *x = qdot_expr_symbol(q->session->pool, q->name[0]);
    qdot_expr lo, hi, *numbers;
    qdot_zeros_range range = {0};
    qdot_zeros zeros;
    qdot_status status;
    double a, b;
    const qdot_expr declared[] = {x->lo, x->hi};
    const bool open[] = {x->lo_open, x->hi_open};

    QDOT_TRY(constant_of(q, ends[0], &lo));
    QDOT_TRY(constant_of(q, ends[1], &hi));
    QDOT_TRY(double_of(q, lo, &a));
    QDOT_TRY(double_of(q, hi, &b));
    range.lo = a <= b ? lo : hi;
    range.hi = a <= b ? hi : lo;
    QDOT_TRY(narrow_end(q, declared[0], open[0], false, &range.lo, &range.lo_open));
    QDOT_TRY(narrow_end(q, declared[1], open[1], true, &range.hi, &range.hi_open));
    status = qdot_zeros_find(q->session->pool, 1, q->F, q->x, &range, 0, &zeros);
    if (status == QDOT_EDOMAIN)
        return qdot_fail(QDOT_EDOMAIN, "the equation holds for every value");
    QDOT_TRY(status);
    numbers = qdot_malloc((zeros.count + 1) * sizeof *numbers);
    status = numbers == NULL ? QDOT_ENOMEM : QDOT_OK;
    for (size_t k = 0; k < zeros.count && status == QDOT_OK; k++)
        status = numbers_of(q, &zeros, k, &numbers[k]);
    if (status == QDOT_OK)
        status = qdot_value_kind_give(
            q->session->pool, qdot_list(q->session->pool, (uint32_t)zeros.count, numbers),
            value);
    if (status == QDOT_OK)
        status = tell_doubts(q, &zeros);
    qdot_free(numbers);
    qdot_zeros_clear(&zeros);
    return status;
}

/* --- from a guess ------------------------------------------------------------------------------------------ */

static qdot_status
solve_near(question *q, const qdot_expr *guesses, bool list, qdot_expr *value)
{
    qdot_expr numbers[MOST];
    double guess[MOST];
    qdot_zeros zeros;
    qdot_status status;

    for (size_t j = 0; j < q->n; j++) {
        qdot_expr e;

        QDOT_TRY(constant_of(q, guesses[j], &e));
        QDOT_TRY(double_of(q, e, &guess[j]));
    }
    QDOT_TRY(qdot_zeros_near(q->session->pool, q->n, q->F, q->x, guess, &zeros));
    if (zeros.count == 0) {
        (void)qdot_fail(
            QDOT_EFAILED,
            zeros.doubts > 0
                ? "near %.17g the equation holds to rounding, but no zero is proved"
                : "no zero is reached from there",
            zeros.doubts > 0 ? zeros.doubt[0] : 0.0);
        status = qdot_hint(
            q->n == 1 ? "another guess, or every zero in a range: solve(A = B, x, 0..1)"
                      : "another guess");
    } else {
        status = numbers_of(q, &zeros, 0, numbers);
    }
    if (status == QDOT_OK)
        status = qdot_value_kind_give(
            q->session->pool,
            list ? qdot_list(q->session->pool, (uint32_t)q->n, numbers) : numbers[0],
            value);
    if (status == QDOT_OK)
        status = tell_doubts(q, &zeros);
    qdot_zeros_clear(&zeros);
    return status;
}

/* --- the function -------------------------------------------------------------------------------------------- */

static bool
is_list_of_equations(const qdot_pool *pool, qdot_expr e)
{
    uint32_t n = qdot_expr_kind(pool, e) == QDOT_LIST ? qdot_expr_count(pool, e) : 0;

    for (uint32_t i = 0; i < n; i++)
        if (!qdot_value_kind_is_equation(pool, qdot_expr_arg(pool, e, i)))
            return false;
    return n > 0;
}

/* solve([A = B, C = D], [x = 1, y = 2]) */
static qdot_status
solve_system(question *q, qdot_expr equations, qdot_expr unknowns, qdot_expr *value)
{
    qdot_pool *pool = q->session->pool;
    uint32_t n = qdot_expr_count(pool, unknowns);
    qdot_expr guesses[MOST];

    if (qdot_expr_kind(pool, equations) != QDOT_LIST ||
        qdot_expr_count(pool, equations) != n) {
        (void)qdot_fail(QDOT_ETYPE, "solve takes as many equations as unknowns");
        return qdot_hint("as in solve([x + y = 3, x*y = 2], [x = 1, y = 1])");
    }
    for (uint32_t j = 0; j < n; j++) {
        qdot_expr one = qdot_expr_arg(pool, unknowns, j);

        QDOT_TRY(add_unknown(q, qdot_expr_arg(pool, one, 0)));
        guesses[j] = qdot_expr_arg(pool, one, 1);
    }
    for (uint32_t i = 0; i < n; i++)
        QDOT_TRY(set_equation(q, i, qdot_expr_arg(pool, equations, i)));
    return solve_near(q, guesses, true, value);
}

/* solve([A = B, C = D], [x, y]): exactly; a list of lists of equations. */
static qdot_status
solve_exactly(qdot_session *session, qdot_expr equations, qdot_expr unknowns,
              qdot_expr *value)
{
    qdot_pool *pool = session->pool;
    uint32_t n = qdot_expr_count(pool, unknowns);
    qdot_facts facts = qdot_scene_facts(session->scene);
    qdot_expr f[MOST], u[MOST];
    bool complete;

    if (n == 0 || n > MOST || qdot_expr_kind(pool, equations) != QDOT_LIST ||
        qdot_expr_count(pool, equations) != n) {
        (void)qdot_fail(QDOT_ETYPE, "solve takes as many equations as unknowns, up to %d",
                        MOST);
        return qdot_hint("as in solve([x + y = 3, x*y = 2], [x, y])");
    }
    for (uint32_t i = 0; i < n; i++) {
        qdot_expr e = qdot_expr_arg(pool, equations, i);

        u[i] = qdot_expr_arg(pool, unknowns, i);
        if (qdot_expr_kind(pool, u[i]) != QDOT_SYM || u[i] <= QDOT_FALSE)
            return qdot_fail(QDOT_ETYPE, "solve takes symbols as unknowns, not %s",
                             qdot_value_kind_words(pool, u[i]));
        f[i] = qdot_value_kind_is_equation(pool, e)
                   ? qdot_sub(pool, qdot_expr_arg(pool, e, 0), qdot_expr_arg(pool, e, 1))
                   : e;
        QDOT_TRY(qdot_value_kind_check(pool, f[i]));
        if (!qdot_expr_is_scalar(pool, f[i]))
            return qdot_fail(QDOT_ETYPE, "solve takes equations between numbers, not %s",
                             qdot_value_kind_words(pool, e));
    }
    QDOT_TRY(qdot_solve_system(pool, n, f, u, &facts, value, &complete));
    if (complete)
        return QDOT_OK;
    (void)qdot_fail(QDOT_EFAILED, "these equations cannot be solved exactly%s",
                    qdot_expr_count(pool, *value) > 0 ? " for all their solutions" : "");
    return qdot_hint("in numbers, from a guess: solve([...], [x = 1, y = 2])");
}

qdot_status
qdot_solve_call(qdot_session *session, uint32_t n, const qdot_expr *args,
                qdot_expr *value)
{
    qdot_pool *pool = session->pool;
    question q = {.session = session};
    qdot_expr guess;

    if (n != 2 && n != 4) {
        (void)qdot_fail(QDOT_ETYPE,
                        "solve takes one equation and one unknown, then a range");
        return qdot_hint("as in solve(cos(x) = x, x, 0..2)");
    }
    if (n == 2 && is_list_of_equations(pool, args[1]))
        return solve_system(&q, args[0], args[1], value);
    if (n == 2 && qdot_expr_kind(pool, args[1]) == QDOT_LIST)
        return solve_exactly(session, args[0], args[1], value);
    if (n == 2 && !qdot_value_kind_is_equation(pool, args[1]))
        return qdot_algebra_solve(session, n, args, value);
    QDOT_TRY(add_unknown(&q, n == 4 ? args[1] : qdot_expr_arg(pool, args[1], 0)));
    QDOT_TRY(set_equation(&q, 0, args[0]));
    if (n == 4)
        return solve_range(&q, args + 2, value);
    guess = qdot_expr_arg(pool, args[1], 1);
    return solve_near(&q, &guess, false, value);
}
