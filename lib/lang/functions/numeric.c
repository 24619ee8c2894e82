/* numeric.c -- numeric(E), numeric(E, digits): the number of an expression E, with the values of `set`.
 *
 * The result is like a number from a run: it has an error, which propagates. If symbols remain,
 * the constants beside them become decimals, of 16 digits unless given. QDOT_EDOMAIN: a part of E
 * is undefined, not real, or not told from 0.
 *
 * Tests  tests/script/solve/numeric.lag, tests/bad/solve/numeric-*.lag
 */
#include "lang/functions/builtin.h"

#include <inttypes.h>

#include "expr/constant.h"
#include "expr/elementary.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "lang/answer/answer.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "normal/calculus/decimal.h"

enum { MOST_DIGITS = 100000, DIGITS = 16 };

/* The arguments of a call of `numeric`. */
typedef struct {
    qdot_session *session;
    int digits;
    bool plain; /* the call gave no number of digits */
    qdot_status status;
} order;

/* Evaluate a constant as a number with its error. */
static qdot_status
evaluate_number(qdot_session *session, qdot_expr e, const order *o, qdot_measured *m)
{
    *m = (qdot_measured){.digits = o->digits, .plain = o->plain};
    (void)qdot_constant_estimated_taken(session->pool);
    QDOT_TRY(qdot_decimal(session->pool, e, o->digits, &m->exact, &m->error));
    if (qdot_constant_estimated_taken(session->pool))
        QDOT_TRY(qdot_answer_notice_once(session, "the error of this integral is an estimate, not a bound"));
    return qdot_session_number(session, m->exact, &m->value, NULL);
}

/* Round a value computed from numbers with errors to the requested number of digits. */
static qdot_status
round_to_digits(qdot_session *session, qdot_expr e, const order *o, qdot_measured *m)
{
    qdot_expr exact = qdot_measured_as_rationals(session, e);
    double error;

    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(qdot_session_number(session, e, &m->value, &error));
    QDOT_TRY(evaluate_number(session, exact, o, m));
    m->error += error;
    return QDOT_OK;
}

/* --- the function `numeric` ---------------------------------------------------------- */

/* Whether e is a number, or a vector or list that contains numbers only, no nested lists or equations. */
static bool
has_only_numbers(const qdot_pool *pool, qdot_expr e)
{
    qdot_kind kind = qdot_expr_kind(pool, e);
    bool flat = kind == QDOT_VEC || kind == QDOT_LIST;

    for (uint32_t i = 0; flat && i < qdot_expr_count(pool, e); i++)
        flat = qdot_expr_is_scalar(pool, qdot_expr_arg(pool, e, i));
    return flat || qdot_expr_is_scalar(pool, e);
}

static qdot_expr
number_of_scalar(qdot_pool *pool, qdot_expr e, void *user)
{
    order *o = user;
    qdot_measured m = {0};

    (void)pool;
    if (o->status != QDOT_OK || (o->plain && qdot_measured_occurs(o->session, e)))
        return e;
    o->status = qdot_measured_occurs(o->session, e) ? round_to_digits(o->session, e, o, &m)
                                                    : evaluate_number(o->session, e, o, &m);
    return o->status == QDOT_OK ? qdot_measured_add(o->session, m) : e;
}

/* An expression with the values of `set`. What holds the time or a coordinate keeps functions given by data as they are: the
 * polynomials between their points say nothing. */
static qdot_expr
bind_to_numbers(qdot_session *session, qdot_expr e)
{
    const qdot_expr bound = qdot_session_bind(session, e);

    if (bound == QDOT_NIL || qdot_expr_is_constant(session->pool, bound) ||
        qdot_expr_find_function(session->pool, bound, 1, (qdot_fun_id[]){QDOT_LOOKUP}, QDOT_NIL) == QDOT_NIL)
        return bound;
    return e;
}

qdot_status
qdot_call_numeric(qdot_session *session, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    qdot_pool *pool = session->pool;
    qdot_expr e = bind_to_numbers(session, args[0]), exact;
    order o = {.session = session, .plain = n == 1};
    int64_t digits = DIGITS;

    QDOT_TRY(qdot_value_kind_check(pool, e));
    if (n == 2) {
        QDOT_TRY(qdot_session_integer(session, args[1], &digits));
        if (digits < 1 || digits > MOST_DIGITS)
            return qdot_fail(QDOT_EDOMAIN, "%" PRId64 " digits: from 1 to %d can be asked for", digits,
                             MOST_DIGITS);
    }
    if (qdot_expr_is_class(pool, e, QDOT_WORDS))
        return qdot_fail(QDOT_ETYPE, "numeric takes numbers, not a text");
    exact = qdot_measured_as_rationals(session, e);
    QDOT_TRY(qdot_value_kind_check(pool, exact));
    if (digits > DIGITS && qdot_expr_find_function(pool, exact, 1, (qdot_fun_id[]){QDOT_LOOKUP}, QDOT_NIL) != QDOT_NIL)
        return qdot_fail(QDOT_EDOMAIN, "%" PRId64 " digits: a table of data is known to %d", digits, DIGITS);
    if (exact == e && !(qdot_expr_is_constant(pool, e) && has_only_numbers(pool, e)))
        return qdot_decimals_beside_symbols(pool, e, (int)digits, value);
    if (!qdot_expr_is_constant(pool, exact) || !(has_only_numbers(pool, e) || qdot_expr_kind(pool, e) == QDOT_MAT))
        return qdot_fail(QDOT_ETYPE, "the expression contains a result of a run and a symbol without value");
    o.digits = (int)digits;
    *value = qdot_value_map(pool, e, number_of_scalar, &o);
    QDOT_TRY(o.status);
    return qdot_value_kind_check(pool, *value);
}

qdot_status
qdot_call_N(qdot_session *session, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    return qdot_call_numeric(session, n, args, value);
}
