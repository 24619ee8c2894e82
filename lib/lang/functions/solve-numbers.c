/* solve-numbers.c -- finds zeros numerically, with the session's values of parameters. */
#include "lang/functions/solve-numbers.h"

#include <math.h>
#include <stdio.h>

#include "base/number-text.h"
#include "base/text.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/functions/solve-conditions.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "normal/prove/decide.h"
#include "normal/refute/enclosure.h"
#include "normal/solve/solve.h"
#include "normal/solve/zeros.h"
#include "num/lu.h"

enum { MOST = QDOT_ZEROS_MOST_UNKNOWNS, DIGITS = 17 };

/* Equations with the session's values inserted, in which the unknowns are new symbols, because x
 * may have a value. */
typedef struct {
    qdot_session *session;
    size_t n;
    qdot_expr name[MOST], x[MOST]; /* [n] unknowns as written; the symbols that replace them */
    qdot_expr f[MOST], F[MOST]; /* [n] left - right side of each equation; the same with numbers from runs as exact rationals */
    bool measured;              /* the equations contain numbers of runs */
} question;

/* --- equations, unknowns and values ------------------------------------------------------------------ */

static qdot_status
add_unknown_of_equation(question *q, qdot_expr x)
{
    char name[40];

    QDOT_TRY(qdot_value_kind_need_symbol(q->session->pool, x,
                                         "solve takes symbols as unknowns, not %s"));
    if (q->n == MOST)
        return qdot_fail(QDOT_ELIMIT, "solve takes up to %d unknowns", MOST);
    if (qdot_expr_place(q->n, q->name, x) < q->n)
        return qdot_fail(QDOT_EINVAL, "`%.200s` is named twice",
                         qdot_expr_symbol(q->session->pool, x)->name);
    snprintf(name, sizeof name, "unknown#%zu", q->n + 1);
    q->name[q->n] = x;
    q->x[q->n] = qdot_symbol_get(q->session->pool, QDOT_FORMAL, name);
    q->n++;
    return qdot_pool_check(q->session->pool);
}

/* Fail if e contains a symbol that has no value and is not one of the unknowns. */
static qdot_status
require_values(const question *q, qdot_expr e)
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

    e = qdot_value_kind_difference(pool, e);
    QDOT_TRY(qdot_pool_check(pool));
    if (!qdot_expr_is_scalar(pool, e))
        return qdot_fail(QDOT_ETYPE, "solve takes equations between numbers, not %s",
                         qdot_value_kind_words(pool, e));
    e = qdot_session_bind(q->session, qdot_subs(pool, e, q->n, q->name, q->x));
    QDOT_TRY(qdot_value_kind_check(pool, e));
    q->f[i] = e;
    q->F[i] = qdot_measured_as_rationals(q->session, e);
    QDOT_TRY(qdot_value_kind_check(pool, q->F[i]));
    if (qdot_expr_find_function(pool, e, 1, (qdot_fun_id[]){QDOT_LOOKUP}, QDOT_NIL) != QDOT_NIL)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: solve with functions given by data");
    q->measured |= q->F[i] != e;
    return require_values(q, q->F[i]);
}

/* Find the exact constant that e becomes when the session's parameter values are inserted. */
static qdot_status
evaluate_to_constant(const question *q, qdot_expr e, qdot_expr *value)
{
    qdot_expr bound = qdot_session_bind(q->session, e);

    QDOT_TRY(qdot_value_kind_check(q->session->pool, bound));
    *value = qdot_measured_as_rationals(q->session, bound);
    QDOT_TRY(qdot_value_kind_check(q->session->pool, *value));
    QDOT_TRY(require_values(q, *value));
    if (!qdot_expr_is_scalar(q->session->pool, *value))
        return qdot_fail(QDOT_ETYPE, "a number is needed, not %s",
                         qdot_value_kind_words(q->session->pool, *value));
    return QDOT_OK;
}

/* --- numbers with errors --------------------------------------------------------------------------------- */

/* Find the error of the zero z caused by errors of run results in the equations: |f'^-1| df, into error [n]. */
static qdot_status
find_propagated_errors(const question *q, const double *z, double *error)
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

/* Whether z [n] are numbers of few digits that satisfy the equations exactly; *exact: they do. */
static qdot_status
is_exact_zero(const question *q, const double *z, bool *exact)
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

/* Find the k-th zero as numbers with errors. */
static qdot_status
zero_as_numbers(const question *q, const qdot_zeros *z, size_t k, qdot_expr *numbers)
{
    double error[MOST];
    bool exact;

    QDOT_TRY(is_exact_zero(q, z->at + k * q->n, &exact));
    for (size_t j = 0; j < q->n; j++) {
        error[j] = exact ? 0 : z->radius[k * q->n + j];
        if (!exact) /* show as many digits as are certain */
            error[j] += fabs(z->at[k * q->n + j]) * 1e-17;
    }
    QDOT_TRY(find_propagated_errors(q, z->at + k * q->n, error));
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
give_notice_of_doubts(const question *q, const qdot_zeros *z)
{
    const char *name = qdot_expr_symbol(q->session->pool, q->name[0])->name;

    if (z->single && q->n == 1)
        QDOT_TRY(qdot_answer_notice(q->session,
                                    "there may be others where the base of a power with %.100s in its exponent is negative",
                                    name));
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

/* --- zeros at which the equation is defined -------------------------------------------------------------- */

/* Whether the zero z fulfils a < b or a <= b: 1 yes, 0 no, -1 not decided. What depends on what has no value is not
 * asked. */
static qdot_status
zero_satisfies(const question *q, qdot_expr relation, const double *z, const double *radius,
               int *yes)
{
    qdot_pool *pool = q->session->pool;
    bool open = qdot_expr_node(pool, relation)->op == QDOT_LT, exact = false;
    qdot_expr gap = qdot_sub(pool, qdot_expr_arg(pool, relation, 1),
                             qdot_expr_arg(pool, relation, 0)),
              at[MOST];
    qdot_interval X[MOST];
    qdot_enclosure *bounds;
    qdot_status status;

    gap = qdot_session_bind(q->session, qdot_subs(pool, gap, q->n, q->name, q->x));
    gap = qdot_measured_as_rationals(q->session, gap);
    QDOT_TRY(qdot_value_kind_check(pool, gap));
    status = qdot_enclosure_new(pool, 1, &gap, q->n, q->x, &bounds);
    *yes = 1;
    if (status == QDOT_ETYPE)
        return QDOT_OK;
    QDOT_TRY(status);
    for (size_t j = 0; j < q->n; j++)
        X[j] = (qdot_interval){z[j] - radius[j], z[j] + radius[j]};
    qdot_enclosure_eval(bounds, X, false);
    *yes = qdot_enclosure_get(bounds, 0)->state == QDOT_ENCLOSURE_NOWHERE ? 0 : -1;
    if (qdot_enclosure_get(bounds, 0)->state == QDOT_ENCLOSURE_WHOLE) {
        qdot_interval y = qdot_enclosure_get(bounds, 0)->y;

        if (y.lo > 0 || (y.lo == 0 && !open))
            *yes = 1;
        else if (y.hi < 0 || (y.hi == 0 && open))
            *yes = 0;
    }
    qdot_enclosure_free(bounds);
    if (*yes >= 0)
        return QDOT_OK;
    QDOT_TRY(is_exact_zero(q, z, &exact));
    for (size_t j = 0; j < q->n; j++)
        at[j] = qdot_expr_of_double(pool, z[j]);
    if (exact && qdot_is_zero(pool, qdot_subs(pool, gap, q->n, q->x, at), NULL))
        *yes = !open;
    return qdot_pool_check(pool);
}

/* Remove those zeros at which the equation, as it was typed, is undefined. */
static qdot_status
remove_undefined_zeros(const question *q, qdot_expr domain, qdot_zeros *zeros)
{
    uint32_t n = domain == QDOT_NIL || domain == QDOT_FALSE
                     ? 0
                     : qdot_expr_count(q->session->pool, domain);
    size_t kept = 0;

    if (domain == QDOT_FALSE)
        zeros->count = 0;
    for (size_t k = 0; k < zeros->count; k++) {
        int yes = 1, one;

        for (uint32_t i = 0; i < n && yes != 0; i++) {
            QDOT_TRY(zero_satisfies(q, qdot_expr_arg(q->session->pool, domain, i),
                                    zeros->at + k * q->n, zeros->radius + k * q->n, &one));
            yes = one < yes ? one : yes;
        }
        if (yes < 0)
            QDOT_TRY(qdot_answer_notice(
                q->session,
                "whether the equation is defined at the zero %.100s = %.17g "
                "is not decided",
                qdot_expr_symbol(q->session->pool, q->name[0])->name,
                zeros->at[k * q->n]));
        for (size_t j = 0; j < q->n && yes != 0; j++) {
            zeros->at[kept * q->n + j] = zeros->at[k * q->n + j];
            zeros->radius[kept * q->n + j] = zeros->radius[k * q->n + j];
        }
        if (yes != 0)
            zeros->simple[kept++] = zeros->simple[k];
    }
    zeros->count = kept;
    return QDOT_OK;
}

/* --- over a range ----------------------------------------------------------------------------------------- */

/* Evaluate a constant expression as a double. */
static qdot_status
evaluate_to_double(const question *q, qdot_expr e, double *x)
{
    return qdot_session_number(q->session, e, x, NULL);
}

/* Find one end of the range of x, or of the declared domain of x if that is narrower. */
static qdot_status
find_end_of_range(const question *q, qdot_expr declared, bool open, bool upper, qdot_expr *end,
                  bool *end_open)
{
    qdot_expr e;
    double x, y;

    *end_open = false;
    if (declared == QDOT_NIL)
        return QDOT_OK;
    if (evaluate_to_constant(q, declared, &e) != QDOT_OK) /* the end of the domain depends on a symbol without a value */
        return QDOT_OK;
    QDOT_TRY(evaluate_to_double(q, e, &x));
    QDOT_TRY(evaluate_to_double(q, *end, &y));
    if (upper ? x <= y : x >= y) {
        *end = e;
        *end_open = open;
    }
    return QDOT_OK;
}

static qdot_status
find_zeros(question *q, qdot_expr domain, const qdot_zeros_range *range,
           qdot_zeros *zeros)
{
    qdot_status status =
        qdot_zeros_find(q->session->pool, 1, q->F, q->x, range, 0, zeros);

    if (status == QDOT_EDOMAIN)
        return qdot_fail(QDOT_EDOMAIN, "the equation holds for every value");
    if (status == QDOT_OK)
        status = remove_undefined_zeros(q, domain, zeros);
    return status;
}

/* Evaluate an exact solution as a number with its error. */
static qdot_status
root_as_number(const question *q, qdot_expr root, qdot_expr *number)
{
    double at, radius;
    bool simple = true;
    qdot_zeros one = {.n = 1, .at = &at, .radius = &radius, .simple = &simple, .count = 1};

    QDOT_TRY(qdot_session_number(q->session, root, &at, &radius));
    return zero_as_numbers(q, &one, 0, number);
}

/* Write a range of solutions, in terms of a symbol used internally, as relations of the unknown itself. */
static qdot_status
range_as_relations(const question *q, const qdot_root *range, qdot_expr *value)
{
    qdot_root named = *range;

    named.value = q->name[0];
    if (named.condition != QDOT_NIL)
        named.condition = qdot_subs(q->session->pool, named.condition, 1, q->x, q->name);
    QDOT_TRY(qdot_pool_check(q->session->pool));
    return qdot_solve_root_value(q->session->pool, q->name[0], &named, value);
}

/* The conditions of the domain in terms of the symbol used for x, with the session's values inserted. */
static qdot_expr
domain_with_values(const question *q, qdot_expr domain)
{
    qdot_pool *pool = q->session->pool;

    if (domain == QDOT_NIL || domain == QDOT_FALSE)
        return domain;
    domain = qdot_session_bind(q->session, qdot_subs(pool, domain, q->n, q->name, q->x));
    return domain == QDOT_NIL ? QDOT_NIL : qdot_measured_as_rationals(q->session, domain);
}

/* Add to the list the ranges of x on which the equation holds, and note them in range->held. *rest: other zeros must be
 * searched for, outside these ranges; else they are in the list too. */
static qdot_status
add_ranges_of_solutions(const question *q, qdot_expr domain, qdot_zeros_range *range, qdot_expr *list, bool *rest)
{
    qdot_pool *pool = q->session->pool;
    const qdot_window window = {
        .lo = range->lo, .hi = range->hi, .lo_open = range->lo_open, .hi_open = range->hi_open};
    qdot_solutions found = {0};
    qdot_status status;
    bool points = true;

    domain = domain_with_values(q, domain);
    QDOT_TRY(qdot_pool_check(pool));
    status = qdot_solve_ranges(pool, q->F[0], q->x[0], domain, &window, &found);
    for (size_t i = 0; i < found.root.n; i++) {
        const qdot_root *root = &found.root.at[i];

        points = points && (root->value == q->x[0] ||
                            (root->condition == QDOT_NIL && qdot_expr_is_constant(pool, root->value)));
    }
    *rest = !points || !found.complete || q->measured;
    range->held = QDOT_NIL;
    for (size_t i = 0; i < found.root.n && status == QDOT_OK; i++) {
        const qdot_root *root = &found.root.at[i];
        const bool is_range = root->value == q->x[0];
        qdot_expr value;

        if (!is_range && *rest)
            continue;
        if (is_range && root->condition != QDOT_NIL)
            range->held = qdot_list_appended(pool, range->held, 1, &root->condition);
        status = is_range ? range_as_relations(q, root, &value) : root_as_number(q, root->value, &value);
        if (status == QDOT_OK)
            *list = qdot_list_appended(pool, *list, 1, &value);
    }
    qdot_solutions_clear(&found);
    return status == QDOT_OK ? qdot_value_kind_check(pool, *list) : status;
}

/* Append the zeros found numerically in the range to the list; notices tell what is not proved. */
static qdot_status
add_zeros(question *q, qdot_expr domain, const qdot_zeros_range *range, qdot_expr *list)
{
    qdot_zeros zeros = {0};
    qdot_status status = find_zeros(q, domain, range, &zeros);

    for (size_t k = 0; k < zeros.count && status == QDOT_OK; k++) {
        qdot_expr number;

        status = zero_as_numbers(q, &zeros, k, &number);
        if (status == QDOT_OK)
            *list = qdot_list_appended(q->session->pool, *list, 1, &number);
    }
    if (status == QDOT_OK)
        status = give_notice_of_doubts(q, &zeros);
    qdot_zeros_clear(&zeros);
    return status;
}

qdot_status
qdot_solve_range(qdot_session *session, qdot_expr equation, qdot_expr x, qdot_expr domain,
                 const qdot_expr *ends, qdot_expr *value)
{
    question q = {.session = session};
    const qdot_symbol *symbol;
    qdot_expr lo, hi, list = qdot_list(session->pool, 0, NULL);
    qdot_zeros_range range = {0};
    bool rest;
    double a, b;

    QDOT_TRY(add_unknown_of_equation(&q, x));
    QDOT_TRY(set_equation(&q, 0, equation));
    QDOT_TRY(evaluate_to_constant(&q, ends[0], &lo));
    QDOT_TRY(evaluate_to_constant(&q, ends[1], &hi));
    QDOT_TRY(evaluate_to_double(&q, lo, &a));
    QDOT_TRY(evaluate_to_double(&q, hi, &b));
    symbol = qdot_expr_symbol(session->pool, x);
    range.lo = a <= b ? lo : hi;
    range.hi = a <= b ? hi : lo;
    QDOT_TRY(find_end_of_range(&q, symbol->lo, symbol->lo_open, false, &range.lo, &range.lo_open));
    QDOT_TRY(find_end_of_range(&q, symbol->hi, symbol->hi_open, true, &range.hi, &range.hi_open));
    QDOT_TRY(add_ranges_of_solutions(&q, domain, &range, &list, &rest));
    if (rest)
        QDOT_TRY(add_zeros(&q, domain, &range, &list));
    return qdot_value_kind_give(session->pool, list, value);
}

/* --- over the whole domain -------------------------------------------------------------------------------- */

/* Find one end of the search window as a constant; *known: it is constant, or the window has no such end. */
static qdot_status
evaluate_window_end(const question *q, qdot_expr end, qdot_expr *constant, bool *known)
{
    *constant = QDOT_NIL;
    if (end == QDOT_NIL)
        return QDOT_OK;
    end = qdot_session_bind(q->session, end);
    QDOT_TRY(qdot_value_kind_check(q->session->pool, end));
    *constant = qdot_measured_as_rationals(q->session, end);
    QDOT_TRY(qdot_value_kind_check(q->session->pool, *constant));
    *known = *known && qdot_expr_is_constant(q->session->pool, *constant);
    return QDOT_OK;
}

qdot_status
qdot_solve_line(qdot_session *session, qdot_expr f, qdot_expr x, qdot_expr domain,
                const qdot_window *window, qdot_solve_zeros *out, bool *known, bool *all)
{
    question q = {.session = session};
    qdot_zeros_range range = {
        .lo_open = window->lo_open, .hi_open = window->hi_open, .turn = window->turn};
    qdot_zeros zeros = {0};
    qdot_status status;

    *known = true;
    QDOT_TRY(add_unknown_of_equation(&q, x));
    status = set_equation(&q, 0, f);
    *known = status != QDOT_EUNSET;
    if (!*known)
        return QDOT_OK;
    QDOT_TRY(status);
    QDOT_TRY(evaluate_window_end(&q, window->lo, &range.lo, known));
    QDOT_TRY(evaluate_window_end(&q, window->hi, &range.hi, known));
    if (!*known)
        return QDOT_OK;
    status = find_zeros(&q, domain, &range, &zeros);
    *known = !zeros.beyond && !zeros.exhausted;
    *all = zeros.complete;
    for (size_t k = 0; k < zeros.count && *known && status == QDOT_OK; k++) {
        qdot_solve_zero one = {.at = zeros.at[k], .radius = zeros.radius[k]};

        status = zero_as_numbers(&q, &zeros, k, &one.value);
        if (status == QDOT_OK)
            status = qdot_vec_push(out, one);
    }
    if (status == QDOT_OK && *known)
        status = give_notice_of_doubts(&q, &zeros);
    qdot_zeros_clear(&zeros);
    return status;
}

/* Make the zeros a LIST of LISTs u = number, and an array of numbers. */
static qdot_status
list_zeros(const question *q, const qdot_zeros *zeros, qdot_expr *list, double *at)
{
    qdot_pool *pool = q->session->pool;

    *list = qdot_list(pool, 0, NULL);
    for (size_t k = 0; k < zeros->count; k++) {
        qdot_expr number[MOST], one;

        QDOT_TRY(zero_as_numbers(q, zeros, k, number));
        for (size_t j = 0; j < q->n; j++) {
            at[k * q->n + j] = zeros->at[k * q->n + j];
            at[(zeros->count + k) * q->n + j] = zeros->radius[k * q->n + j];
            number[j] = qdot_rel(pool, QDOT_EQ, q->name[j], number[j]);
        }
        one = qdot_list(pool, (uint32_t)q->n, number);
        *list = qdot_list_appended(pool, *list, 1, &one);
    }
    return qdot_pool_check(pool);
}

qdot_status
qdot_solve_box(qdot_session *session, size_t n, const qdot_expr *f, const qdot_expr *u,
               qdot_expr domain, const qdot_window *window, qdot_expr *list, double **at,
               size_t *count, bool *known)
{
    question q = {.session = session};
    qdot_zeros_range range[MOST] = {0};
    qdot_zeros zeros = {0};
    qdot_status status = QDOT_OK;

    *known = true;
    *at = NULL;
    for (size_t j = 0; j < n; j++)
        QDOT_TRY(add_unknown_of_equation(&q, u[j]));
    for (size_t i = 0; i < n && *known; i++) {
        status = set_equation(&q, i, f[i]);
        *known = status != QDOT_EUNSET;
        if (*known)
            QDOT_TRY(status);
    }
    for (size_t j = 0; j < n && *known; j++) {
        range[j] = (qdot_zeros_range){.lo_open = window[j].lo_open,
                                      .hi_open = window[j].hi_open,
                                      .turn = window[j].turn};
        QDOT_TRY(evaluate_window_end(&q, window[j].lo, &range[j].lo, known));
        QDOT_TRY(evaluate_window_end(&q, window[j].hi, &range[j].hi, known));
    }
    if (!*known)
        return QDOT_OK;
    status = qdot_zeros_find(session->pool, n, q.F, q.x, range, 0, &zeros);
    *known = status == QDOT_OK && zeros.complete;
    if (status == QDOT_EDOMAIN) /* an equation is satisfied everywhere, so its zeros are not isolated */
        status = QDOT_OK;
    if (status == QDOT_OK && *known)
        status = remove_undefined_zeros(&q, domain, &zeros);
    *at = qdot_malloc((2 * zeros.count * n + 1) * sizeof **at);
    if (status == QDOT_OK && *at == NULL)
        status = QDOT_ENOMEM;
    *count = zeros.count;
    if (status == QDOT_OK && *known)
        status = list_zeros(&q, &zeros, list, *at);
    qdot_zeros_clear(&zeros);
    return status;
}

/* --- solutions near a guess --------------------------------------------------------------------------------- */

qdot_status
qdot_solve_near(qdot_session *session, uint32_t n, const qdot_expr *equations,
                const qdot_expr *unknowns, qdot_expr domain, bool list, qdot_expr *value)
{
    question q = {.session = session};
    qdot_expr numbers[MOST];
    double guess[MOST];
    qdot_zeros zeros;
    qdot_status status;

    for (uint32_t j = 0; j < n; j++)
        QDOT_TRY(add_unknown_of_equation(&q, qdot_expr_arg(session->pool, unknowns[j], 0)));
    for (uint32_t i = 0; i < n; i++)
        QDOT_TRY(set_equation(&q, i, equations[i]));
    for (uint32_t j = 0; j < n; j++) {
        qdot_expr e;

        QDOT_TRY(evaluate_to_constant(&q, qdot_expr_arg(session->pool, unknowns[j], 1), &e));
        QDOT_TRY(evaluate_to_double(&q, e, &guess[j]));
    }
    for (uint32_t j = 0; j < n; j++) {
        const qdot_window declared = qdot_solve_window(session->pool, q.name[j], false);

        domain = qdot_conditions_all(session->pool, domain,
                                     qdot_window_relations(session->pool, &declared, q.name[j]));
    }
    QDOT_TRY(qdot_zeros_near(session->pool, q.n, q.F, q.x, guess, &zeros));
    if (zeros.count > 0) {
        status = remove_undefined_zeros(&q, domain, &zeros);
        if (status == QDOT_OK && zeros.count == 0) {
            (void)qdot_fail(QDOT_EFAILED,
                            "the zero that is reached lies outside the declared domain, or where "
                            "the equation as it is written is not defined");
            status = qdot_hint("another guess");
        }
        if (status == QDOT_OK)
            status = zero_as_numbers(&q, &zeros, 0, numbers);
    } else {
        (void)qdot_fail(
            QDOT_EFAILED,
            zeros.doubts > 0
                ? "near %.17g the equation holds to rounding, but no zero is proved"
                : "no zero is reached from there",
            zeros.doubts > 0 ? zeros.doubt[0] : 0.0);
        status = qdot_hint(
            q.n == 1 ? "another guess, or every zero in a range: solve(A = B, x, 0..1)"
                     : "another guess");
    }
    if (status == QDOT_OK)
        status = qdot_value_kind_give(
            session->pool,
            list ? qdot_list(session->pool, (uint32_t)q.n, numbers) : numbers[0], value);
    if (status == QDOT_OK)
        status = give_notice_of_doubts(&q, &zeros);
    qdot_zeros_clear(&zeros);
    return status;
}
