/* definite.c -- integrals from a to b by antiderivatives, split where something is not continuous. */
#include "normal/integral/definite.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/normal-form.h"
#include "normal/integral/antiderivative.h"
#include "normal/integral/ends.h"
#include "normal/integral/improper.h"
#include "normal/integral/piecewise.h"
#include "normal/integral/span.h"
#include "normal/simplify/simplify.h"

static bool
is_infinite(const qdot_pool *pool, qdot_expr e)
{
    return qdot_infinite(pool, e) != 0;
}

/* --- one piece ------------------------------------------------------------------------ */

/* A new variable with the domain lo < x < hi. */
static qdot_expr
variable_between(qdot_pool *pool, qdot_expr lo, qdot_expr hi)
{
    qdot_expr w = qdot_symbol_get(pool, QDOT_FORMAL, "between#");

    qdot_symbol_hide(pool, w);
    if (w != QDOT_NIL)
        qdot_symbol_domain(pool, w, is_infinite(pool, lo) ? QDOT_NIL : lo, true, is_infinite(pool, hi) ? QDOT_NIL : hi, true);
    return w;
}

/* F over the piece, taken from end to end; F is continuous between these. */
static qdot_status
between_ends(qdot_span *r, qdot_expr F, qdot_expr lo, qdot_expr hi, qdot_definite_answer *answer)
{
    qdot_end from, to;

    QDOT_TRY(qdot_end_value(r->pool, F, r->x, lo, 1, r->facts, &from));
    QDOT_TRY(qdot_end_value(r->pool, F, r->x, hi, -1, r->facts, &to));
    if (from.kind == QDOT_END_INFINITE || to.kind == QDOT_END_INFINITE) {
        answer->kind = QDOT_DEFINITE_DIVERGES;
        answer->at = from.kind == QDOT_END_INFINITE ? lo : hi;
    } else if (from.kind == QDOT_END_VALUE && to.kind == QDOT_END_VALUE) {
        answer->kind = QDOT_DEFINITE_FOUND;
        answer->value = qdot_sub(r->pool, to.value, from.value);
    } else {
        answer->undecided = from.undecided != QDOT_NIL ? from.undecided : to.undecided;
    }
    return QDOT_OK;
}

/* The same for if(CONDITION, F, G) of parameters, case by case. */
static qdot_status
between_ends_by_cases(qdot_span *r, qdot_expr F, qdot_definite_answer *answer)
{
    qdot_pool *pool = r->pool;
    qdot_expr sum = QDOT_ZERO, condition;
    qdot_definite_answer first;

    if (F != QDOT_NIL && qdot_expr_is_function(pool, F, QDOT_IF) && !qdot_expr_contains(pool, qdot_expr_arg(pool, F, 0), r->x)) {
        condition = qdot_expr_arg(pool, F, 0);
        QDOT_TRY(between_ends_by_cases(r, qdot_expr_arg(pool, F, 1), answer));
        if (answer->kind != QDOT_DEFINITE_FOUND)
            return QDOT_OK;
        first = *answer;
        *answer = (qdot_definite_answer){.kind = QDOT_DEFINITE_NOT_FOUND};
        QDOT_TRY(between_ends_by_cases(r, qdot_expr_arg(pool, F, 2), answer));
        if (answer->kind == QDOT_DEFINITE_FOUND && first.value != answer->value)
            answer->value = qdot_fun(pool, QDOT_IF, 3, (qdot_expr[]){condition, first.value, answer->value});
        return QDOT_OK;
    }
    r->n = 0;
    if (F == QDOT_NIL || !qdot_span_add_dangers(r, F, false))
        return r->status;
    for (size_t i = 0; i <= r->n; i++) {
        answer->kind = QDOT_DEFINITE_NOT_FOUND;
        QDOT_TRY(between_ends(r, F, i == 0 ? r->lo : r->place[i - 1], i == r->n ? r->hi : r->place[i], answer));
        if (answer->kind != QDOT_DEFINITE_FOUND)
            return QDOT_OK;
        sum = qdot_add(pool, sum, answer->value);
    }
    answer->value = sum;
    return QDOT_OK;
}

/* Integrate over a piece in which e has neither kinks nor poles. */
static qdot_status
find_smooth_piece(qdot_span *r, qdot_expr e, qdot_definite_answer *answer)
{
    int real = qdot_span_is_real(r, e);
    qdot_expr F;

    QDOT_TRY(r->status);
    if (real != 1) {
        answer->kind = real < 0 ? QDOT_DEFINITE_UNDEFINED : QDOT_DEFINITE_NOT_FOUND;
        answer->at = r->lo;
        return QDOT_OK;
    }
    e = qdot_simplify(r->pool, e, r->facts);
    F = qdot_antiderivative_by_cases(r->pool, e, r->x, r->facts);
    return between_ends_by_cases(r, F, answer);
}

static qdot_status
find_piece(qdot_pool *pool, qdot_expr e, qdot_expr x, qdot_expr lo, qdot_expr hi, const qdot_facts *facts, bool ordered,
           qdot_definite_answer *answer)
{
    qdot_span r = {.pool = pool, .facts = facts, .lo = lo, .hi = hi, .ordered = ordered, .status = QDOT_OK};

    *answer = (qdot_definite_answer){.kind = QDOT_DEFINITE_NOT_FOUND};
    r.x = ordered ? variable_between(pool, lo, hi) : x;
    e = qdot_subs(pool, e, 1, &x, &r.x);
    if (ordered)
        e = qdot_span_without_kinks(&r, e);
    QDOT_TRY(r.status);
    QDOT_TRY(find_smooth_piece(&r, e, answer));
    if (answer->value != QDOT_NIL && qdot_expr_contains(pool, answer->value, r.x))
        answer->kind = QDOT_DEFINITE_NOT_FOUND;
    return qdot_grave(qdot_pool_check(pool));
}

/* --- the whole range -------------------------------------------------------------------- */

static qdot_status
find_ordered(qdot_pool *pool, qdot_expr e, qdot_expr x, qdot_expr lo, qdot_expr hi, const qdot_facts *facts,
             qdot_definite_answer *answer)
{
    qdot_expr w = variable_between(pool, lo, hi), sum = QDOT_ZERO;
    qdot_span r = {.pool = pool, .facts = facts, .x = w, .lo = lo, .hi = hi, .ordered = true, .status = QDOT_OK};

    e = qdot_subs(pool, e, 1, &x, &w);
    if (e == QDOT_NIL)
        return qdot_grave(qdot_pool_check(pool));
    if (!qdot_span_add_dangers(&r, e, true))
        return r.status;
    for (size_t i = 0; i <= r.n; i++) {
        QDOT_TRY(find_piece(pool, e, w, i == 0 ? lo : r.place[i - 1], i == r.n ? hi : r.place[i], facts, true, answer));
        if (answer->kind != QDOT_DEFINITE_FOUND)
            return QDOT_OK;
        sum = qdot_add(pool, sum, answer->value);
    }
    answer->value = sum;
    return QDOT_OK;
}

/* What is finite for all x, with kinks or steps at places that are not known or are too many: its antiderivative does not jump. */
static qdot_status
find_whole(qdot_pool *pool, qdot_expr e, qdot_expr x, qdot_expr lo, qdot_expr hi, const qdot_facts *facts,
           qdot_definite_answer *answer)
{
    qdot_expr F;

    if (is_infinite(pool, lo) || is_infinite(pool, hi) || !qdot_piecewise_finite(pool, e, x) ||
        (!qdot_piecewise_kinks(pool, e, x) && !qdot_piecewise_steps(pool, e, x)))
        return QDOT_OK;
    F = qdot_antiderivative_by_cases(pool, e, x, facts);
    F = qdot_sub(pool, qdot_piecewise_at(pool, F, x, hi, facts), qdot_piecewise_at(pool, F, x, lo, facts));
    if (F != QDOT_NIL)
        *answer = (qdot_definite_answer){.kind = QDOT_DEFINITE_FOUND, .value = F};
    return qdot_grave(qdot_pool_check(pool));
}

qdot_status
qdot_definite(qdot_pool *pool, qdot_expr e, qdot_expr x, qdot_expr lo, qdot_expr hi, const qdot_facts *facts,
              qdot_definite_answer *answer)
{
    qdot_span r = {.pool = pool, .facts = facts, .status = QDOT_OK};
    bool backward = false, ordered = true;

    *answer = (qdot_definite_answer){.kind = QDOT_DEFINITE_NOT_FOUND};
    if (lo == hi) {
        *answer = (qdot_definite_answer){.kind = QDOT_DEFINITE_FOUND, .value = QDOT_ZERO};
        return QDOT_OK;
    }
    if (is_infinite(pool, lo) || is_infinite(pool, hi)) {
        backward = qdot_infinite(pool, lo) > 0 || qdot_infinite(pool, hi) < 0;
    } else if (!qdot_span_is_positive(&r, qdot_sub(pool, hi, lo))) {
        backward = qdot_span_is_positive(&r, qdot_sub(pool, lo, hi));
        ordered = backward;
    }
    QDOT_TRY(r.status);
    if (backward) {
        qdot_expr other = lo;

        lo = hi;
        hi = other;
    }
    if (ordered)
        QDOT_TRY(find_ordered(pool, e, x, lo, hi, facts, answer));
    if (answer->kind == QDOT_DEFINITE_NOT_FOUND && qdot_infinite(pool, hi) > 0 && (lo == QDOT_ZERO || is_infinite(pool, lo))) {
        QDOT_TRY(qdot_improper(pool, e, x, lo != QDOT_ZERO, facts, &answer->value));
        if (answer->value != QDOT_NIL)
            answer->kind = QDOT_DEFINITE_FOUND;
    }
    if (!ordered)
        QDOT_TRY(find_piece(pool, e, x, lo, hi, facts, false, answer));
    if (answer->kind == QDOT_DEFINITE_NOT_FOUND)
        QDOT_TRY(find_whole(pool, e, x, lo, hi, facts, answer));
    if (answer->kind == QDOT_DEFINITE_FOUND && answer->value != QDOT_NIL) {
        qdot_expr value = qdot_simplify(pool, backward ? qdot_neg(pool, answer->value) : answer->value, facts);

        answer->value = value;
    }
    return qdot_grave(qdot_pool_check(pool));
}
