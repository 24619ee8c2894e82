/* definite-cases.c -- definite integrals whose value depends on the sign of an expression of parameters.
 *
 * Where the sign of s = c q + d is not known, q a parameter, q = (w - d)/c and q = (-w - d)/c with a new w > 0 give the two
 * cases.
 */
#include "normal/integral/definite.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/integral.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"

enum { MOST_INTEGRALS = 10, DEEPEST_CASE = 2 };

typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    qdot_expr x;
    int left; /* integrals that may still be tried */
} cases;

typedef struct {
    qdot_expr e, lo, hi;
} range;

static qdot_status find_cases(cases *c, range r, int depth, qdot_definite_answer *answer);

static range
range_with(qdot_pool *pool, range r, qdot_expr from, qdot_expr to)
{
    return (range){qdot_subs(pool, r.e, 1, &from, &to), qdot_infinite(pool, r.lo) != 0 ? r.lo : qdot_subs(pool, r.lo, 1, &from, &to),
                   qdot_infinite(pool, r.hi) != 0 ? r.hi : qdot_subs(pool, r.hi, 1, &from, &to)};
}

static bool
has_range(range r)
{
    return r.e != QDOT_NIL && r.lo != QDOT_NIL && r.hi != QDOT_NIL;
}

/* --- the parameter ------------------------------------------------------------------------ */

/* Whether nothing is known of the sign of the parameter q. */
static bool
is_free(const qdot_pool *pool, qdot_expr q)
{
    return qdot_expr_is_class(pool, q, QDOT_PARAM) && (qdot_expr_sign(pool, q) & (QDOT_GE0 | QDOT_LE0)) == 0;
}

/* The value q0 of a parameter q in s = slope (q - q0), slope a number; false: s is another expression. */
static bool
read_linear_in_parameter(qdot_pool *pool, qdot_expr s, qdot_expr x, qdot_expr *q, qdot_expr *q0)
{
    const qdot_expr atoms = qdot_expr_atoms(pool, s, false);

    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(pool, atoms); i++) {
        const qdot_expr at = qdot_expr_arg(pool, atoms, i), slope = qdot_diff(pool, s, at), zero = QDOT_ZERO;

        if (at == x || !is_free(pool, at) || slope == QDOT_NIL || slope == QDOT_ZERO || qdot_expr_rational(pool, slope) == NULL)
            continue;
        *q = at;
        *q0 = qdot_neg(pool, qdot_div(pool, qdot_subs(pool, s, 1, &at, &zero), slope));
        return *q0 != QDOT_NIL;
    }
    return false;
}

/* --- the two cases ------------------------------------------------------------------------ */

/* The integral for q = q0 + side w, w > 0. */
static qdot_status
find_side(cases *c, range r, qdot_expr q, qdot_expr q0, int side, int depth, qdot_definite_answer *answer)
{
    qdot_pool *pool = c->pool;
    const qdot_expr w = qdot_symbol_get(pool, QDOT_PARAM, side > 0 ? "above#" : "below#");
    const qdot_expr there = qdot_add(pool, q0, qdot_mul(pool, qdot_expr_int(pool, side), w)),
                    back = qdot_mul(pool, qdot_expr_int(pool, side), qdot_sub(pool, q, q0));

    qdot_symbol_hide(pool, w);
    if (w != QDOT_NIL)
        qdot_symbol_domain(pool, w, QDOT_ZERO, true, QDOT_NIL, false);
    r = range_with(pool, r, q, there);
    *answer = (qdot_definite_answer){.kind = QDOT_DEFINITE_NOT_FOUND};
    if (!has_range(r))
        return qdot_grave(qdot_pool_check(pool));
    QDOT_TRY(find_cases(c, r, depth + 1, answer));
    if (answer->kind == QDOT_DEFINITE_FOUND)
        answer->value = qdot_simplify(pool, qdot_subs(pool, answer->value, 1, &w, &back), c->facts);
    if (answer->value == QDOT_NIL && answer->kind == QDOT_DEFINITE_FOUND)
        answer->kind = QDOT_DEFINITE_NOT_FOUND;
    return qdot_grave(qdot_pool_check(pool));
}

/* F at q = q0; nil: F is not defined there. */
static qdot_expr
value_at_border(qdot_pool *pool, qdot_expr F, qdot_expr q, qdot_expr q0)
{
    const qdot_expr value = qdot_subs(pool, F, 1, &q, &q0);

    if (value == QDOT_NIL)
        (void)!qdot_pool_check(pool);
    return value;
}

/* Join A for q > q0 and B for q < q0, both found; at q0 the integral is that of r there. */
static qdot_status
join_cases(cases *c, range r, qdot_expr q, qdot_expr q0, qdot_expr A, qdot_expr B, qdot_expr unfound, int depth, qdot_expr *joined)
{
    qdot_pool *pool = c->pool;
    const qdot_expr above = qdot_rel(pool, QDOT_LT, q0, q), below = qdot_rel(pool, QDOT_LT, q, q0);
    const qdot_expr at_A = value_at_border(pool, A, q, q0), at_B = value_at_border(pool, B, q, q0);
    qdot_definite_answer middle = {.kind = QDOT_DEFINITE_NOT_FOUND};
    qdot_expr C = unfound;

    *joined = A == B ? A : qdot_fun(pool, QDOT_IF, 3, (qdot_expr[]){above, A, B});
    if (at_B == QDOT_NIL) /* no value is stated at q0 */
        return qdot_grave(qdot_pool_check(pool));
    r = range_with(pool, r, q, q0);
    if (has_range(r))
        QDOT_TRY(find_cases(c, r, depth + 1, &middle));
    else
        (void)!qdot_pool_check(pool);
    if (middle.kind == QDOT_DEFINITE_FOUND) {
        C = middle.value;
        if (qdot_is_zero(pool, qdot_sub(pool, at_B, C), c->facts))
            return qdot_grave(qdot_pool_check(pool));
        if (at_A != QDOT_NIL && A != B && qdot_is_zero(pool, qdot_sub(pool, at_A, C), c->facts)) {
            *joined = qdot_fun(pool, QDOT_IF, 3, (qdot_expr[]){below, B, A});
            return qdot_grave(qdot_pool_check(pool));
        }
        if (C == QDOT_ZERO && qdot_is_zero(pool, qdot_add(pool, A, B), c->facts)) {
            *joined = qdot_mul(pool, A, qdot_fun1(pool, QDOT_SIGN, qdot_sub(pool, q, q0)));
            return qdot_grave(qdot_pool_check(pool));
        }
    }
    *joined = qdot_fun(pool, QDOT_IF, 3,
                       (qdot_expr[]){above, A, qdot_fun(pool, QDOT_IF, 3, (qdot_expr[]){below, B, C})});
    return qdot_grave(qdot_pool_check(pool));
}

/* The integral by the sign of q - q0; NOT_FOUND in *answer: neither case is found. */
static qdot_status
split_by_parameter(cases *c, range r, qdot_expr q, qdot_expr q0, int depth, qdot_definite_answer *answer)
{
    qdot_pool *pool = c->pool;
    qdot_definite_answer above, below;
    qdot_expr unfound, value;

    QDOT_TRY(find_side(c, r, q, q0, 1, depth, &above));
    QDOT_TRY(find_side(c, r, q, q0, -1, depth, &below));
    if (above.kind != QDOT_DEFINITE_FOUND && below.kind != QDOT_DEFINITE_FOUND)
        return QDOT_OK;
    unfound = qdot_integral(pool, r.e, c->x, r.lo, r.hi);
    if (above.kind == QDOT_DEFINITE_FOUND && below.kind == QDOT_DEFINITE_FOUND)
        QDOT_TRY(join_cases(c, r, q, q0, above.value, below.value, unfound, depth, &value));
    else if (above.kind == QDOT_DEFINITE_FOUND)
        value = qdot_fun(pool, QDOT_IF, 3, (qdot_expr[]){qdot_rel(pool, QDOT_LT, q0, q), above.value, unfound});
    else
        value = qdot_fun(pool, QDOT_IF, 3, (qdot_expr[]){qdot_rel(pool, QDOT_LT, q, q0), below.value, unfound});
    if (value != QDOT_NIL)
        *answer = (qdot_definite_answer){.kind = QDOT_DEFINITE_FOUND, .value = value};
    return qdot_grave(qdot_pool_check(pool));
}

static qdot_status
find_cases(cases *c, range r, int depth, qdot_definite_answer *answer)
{
    qdot_pool *pool = c->pool;
    qdot_expr parameters, q, q0;

    if (c->left-- <= 0) {
        *answer = (qdot_definite_answer){.kind = QDOT_DEFINITE_NOT_FOUND};
        return QDOT_OK;
    }
    QDOT_TRY(qdot_definite(pool, r.e, c->x, r.lo, r.hi, c->facts, answer));
    if (answer->kind != QDOT_DEFINITE_NOT_FOUND || depth == DEEPEST_CASE)
        return QDOT_OK;
    if (answer->undecided != QDOT_NIL && read_linear_in_parameter(pool, answer->undecided, c->x, &q, &q0)) {
        QDOT_TRY(split_by_parameter(c, r, q, q0, depth, answer));
        if (answer->kind == QDOT_DEFINITE_FOUND)
            return QDOT_OK;
    }
    parameters = qdot_expr_atoms(pool, qdot_list(pool, 3, (qdot_expr[]){r.e, r.lo, r.hi}), false);
    for (uint32_t i = 0; parameters != QDOT_NIL && i < qdot_expr_count(pool, parameters) && c->left >= 2; i++) {
        q = qdot_expr_arg(pool, parameters, i);
        if (q == c->x || !is_free(pool, q))
            continue;
        QDOT_TRY(split_by_parameter(c, r, q, QDOT_ZERO, depth, answer));
        if (answer->kind == QDOT_DEFINITE_FOUND)
            return QDOT_OK;
    }
    return qdot_grave(qdot_pool_check(pool));
}

qdot_status
qdot_definite_by_cases(qdot_pool *pool, qdot_expr e, qdot_expr x, qdot_expr lo, qdot_expr hi, const qdot_facts *facts,
                       qdot_definite_answer *answer)
{
    cases c = {.pool = pool, .facts = facts, .x = x, .left = MOST_INTEGRALS};

    return find_cases(&c, (range){e, lo, hi}, 0, answer);
}
