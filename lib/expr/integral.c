/* integral.c -- makes integrals that stand as they are, and puts values for their variables. */
#include "expr/integral.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/scope.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/pool.h"
#include "expr/walk.h"

enum { DEEPEST = 32 }; /* integrals one within the other */

static qdot_expr
bound_symbol(qdot_pool *pool, uint32_t number)
{
    char name[24];
    qdot_expr made = QDOT_NIL;

    for (uint32_t k = 1; k <= number; k++) { /* in ascending order: their order in sums follows their making */
        snprintf(name, sizeof name, "%u#", (unsigned)k);
        made = qdot_symbol_get(pool, QDOT_BOUND, name);
    }
    return made;
}

uint32_t
qdot_bound_number(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_is_class(pool, e, QDOT_BOUND) ? (uint32_t)strtoull(qdot_expr_symbol(pool, e)->name, NULL, 10) : 0;
}

bool
qdot_integral_is_definite(const qdot_pool *pool, qdot_expr e)
{
    return NODE(pool, e)->n == 3;
}

int
qdot_infinite(const qdot_pool *pool, qdot_expr e)
{
    if (e == QDOT_INFINITY)
        return 1;
    return NODE(pool, e)->kind == QDOT_PROD && NODE(pool, e)->n == 3 && ARGS(pool, e)[0] == QDOT_MINUS_ONE &&
                   ARGS(pool, e)[1] == QDOT_INFINITY && ARGS(pool, e)[2] == QDOT_ONE
               ? -1
               : 0;
}

qdot_status
qdot_infinity_refuse(const qdot_pool *pool, qdot_expr e)
{
    if (e == QDOT_NIL || !(NODE(pool, e)->holds & QDOT_HAS_INFINITY))
        return QDOT_OK;
    (void)qdot_fail(QDOT_EDOMAIN, "infinity is no number");
    return qdot_hint("it may be an end of an integral or the place of a limit: limit(1/x, x = infinity)");
}

/* --- putting values for variables --------------------------------------------------------------- */

/* What is put for symbols: CLOSE makes x the variable of an integral around it, OPEN puts `to` for the variable, LIFT
 * counts `by` more integrals between the variables of outer integrals and these. */
typedef struct {
    enum { CLOSE, OPEN, LIFT } what;
    qdot_expr x, to;
    uint32_t by;
} rebinding;

static qdot_expr rebind(qdot_pool *pool, qdot_expr e, const rebinding *r, uint32_t depth);

static qdot_expr
rebind_symbol(qdot_pool *pool, qdot_expr e, const rebinding *r, uint32_t depth)
{
    const uint32_t number = qdot_bound_number(pool, e);

    if (r->what == CLOSE)
        return e == r->x ? bound_symbol(pool, depth + 1) : e;
    if (number <= depth)
        return e;
    if (r->what == LIFT)
        return bound_symbol(pool, number + r->by);
    return number > depth + 1 ? bound_symbol(pool, number - 1)
                              : rebind(pool, r->to, &(rebinding){.what = LIFT, .by = depth}, 0);
}

void
qdot_integral_mark_outside(const qdot_pool *pool, qdot_walk *w, qdot_expr root)
{
    qdot_walk_set(w, root, UINT64_MAX);
    for (size_t i = w->n; i-- > 0;) {
        const qdot_expr e = w->at[i];
        const uint8_t kind = NODE(pool, e)->kind;

        if (w->value[i] == 0 || kind == QDOT_NUM || kind == QDOT_SYM)
            continue;
        for (uint32_t k = kind == QDOT_INTEGRAL && qdot_integral_is_definite(pool, e); k < NODE(pool, e)->n; k++)
            qdot_walk_set(w, ARGS(pool, e)[k], UINT64_MAX);
    }
}

static qdot_expr
rebind(qdot_pool *pool, qdot_expr e, const rebinding *r, uint32_t depth)
{
    qdot_expr result = QDOT_NIL;
    qdot_walk w;

    if (e == QDOT_NIL || FAILED(pool))
        return QDOT_NIL;
    if (r->what == CLOSE ? !qdot_expr_contains(pool, e, r->x) : !(NODE(pool, e)->holds & QDOT_HAS_BOUND))
        return e;
    if (depth > DEEPEST)
        return qdot_pool_refuse(pool, QDOT_ELIMIT, "more than %d integrals one within the other", DEEPEST);
    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return qdot_pool_fail(pool);
    qdot_integral_mark_outside(pool, &w, e);
    for (size_t i = 0; i < w.n; i++) {
        const qdot_expr at = w.at[i];

        if (w.value[i] == 0)
            continue;
        if (NODE(pool, at)->kind == QDOT_SYM) {
            result = rebind_symbol(pool, at, r, depth);
        } else if (NODE(pool, at)->kind == QDOT_INTEGRAL && qdot_integral_is_definite(pool, at)) {
            const qdot_expr a = (qdot_expr)qdot_walk_get(&w, ARGS(pool, at)[1]),
                            b = (qdot_expr)qdot_walk_get(&w, ARGS(pool, at)[2]);

            result = qdot_rebuild(pool, at, (qdot_expr[]){rebind(pool, ARGS(pool, at)[0], r, depth + 1), a, b});
        } else {
            result = NODE(pool, at)->kind == QDOT_NUM ? at : qdot_walk_rebuild(pool, &w, at);
        }
        if (result == QDOT_NIL)
            break;
        w.value[i] = result;
    }
    qdot_walk_end(&w);
    return FAILED(pool) ? QDOT_NIL : result;
}

qdot_expr
qdot_integral_at(qdot_pool *pool, qdot_expr f, qdot_expr value)
{
    return rebind(pool, f, &(rebinding){.what = OPEN, .to = value}, 0);
}

qdot_expr
qdot_integral_open(qdot_pool *pool, qdot_expr e, qdot_expr x)
{
    return qdot_integral_is_definite(pool, e) ? qdot_integral_at(pool, ARGS(pool, e)[0], x) : ARGS(pool, e)[0];
}

/* Whether e holds the variable of an integral from outside e, the number-th or one further out. */
static bool
holds_bound_from(const qdot_pool *pool, qdot_expr e, uint32_t number)
{
    bool holds = false;
    qdot_walk w;

    if (!(NODE(pool, e)->holds & QDOT_HAS_BOUND) || qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return false;
    qdot_integral_mark_outside(pool, &w, e);
    for (size_t i = 0; i < w.n && !holds; i++) {
        if (w.value[i] == 0)
            continue;
        holds = qdot_bound_number(pool, w.at[i]) >= number ||
                (NODE(pool, w.at[i])->kind == QDOT_INTEGRAL && qdot_integral_is_definite(pool, w.at[i]) &&
                 holds_bound_from(pool, ARGS(pool, w.at[i])[0], number + 1));
    }
    qdot_walk_end(&w);
    return holds;
}

/* --- definite integrals ------------------------------------------------------------------------- */

const char *
qdot_integral_name(const qdot_pool *pool, qdot_expr e)
{
    size_t lo = 0, hi = pool->variables.n;

    while (lo < hi) {
        const size_t mid = (lo + hi) / 2;

        if (pool->variables.at[mid].integral == e)
            return pool->variables.at[mid].name;
        if (pool->variables.at[mid].integral < e)
            lo = mid + 1;
        else
            hi = mid;
    }
    return "u";
}

static void
keep_name(qdot_pool *pool, qdot_expr integral, const char *name)
{
    qdot_scope *scope = qdot_scope_pause(); /* not recorded in the present scope, because the pool outlives the scope */
    const char *kept = qdot_arena_strndup(pool->arena, name, strlen(name));

    if (kept == NULL || qdot_vec_push(&pool->variables, ((qdot_variable){integral, kept})) != QDOT_OK)
        qdot_pool_fail(pool);
    qdot_scope_resume(scope);
}

/* Where an end lies: 1 if b is known to be greater than a, -1 if less, 0 if that is not known. */
static int
order_of_ends(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    const int ia = qdot_infinite(pool, a), ib = qdot_infinite(pool, b);
    qdot_expr d;

    if (ia != ib)
        return ib > ia ? 1 : -1;
    if (ia != 0)
        return 0;
    d = qdot_sub(pool, b, a);
    if (d == QDOT_NIL)
        return 0;
    return (NODE(pool, d)->sign & QDOT_GE0) ? 1 : (NODE(pool, d)->sign & QDOT_LE0) ? -1 : 0;
}

static bool
are_both_known(const qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    return (NUMBER(pool, a) != NULL || qdot_infinite(pool, a) != 0) &&
           (NUMBER(pool, b) != NULL || qdot_infinite(pool, b) != 0);
}

/* The factors of the product f that hold no variable of an integral; *rest has the others. */
static qdot_expr
split_constant_factors(qdot_pool *pool, qdot_expr f, qdot_expr *rest)
{
    qdot_expr constant = QDOT_ONE;
    const uint32_t n = NODE(pool, f)->n;

    *rest = f;
    if (NODE(pool, f)->kind != QDOT_PROD)
        return constant;
    *rest = QDOT_ONE;
    constant = ARGS(pool, f)[0];
    for (uint32_t i = 1; i < n; i += 2) {
        const qdot_expr b = ARGS(pool, f)[i], x = ARGS(pool, f)[i + 1], power = qdot_pow(pool, b, x);
        const bool inside = ((NODE(pool, b)->holds | NODE(pool, x)->holds) & QDOT_HAS_BOUND) != 0;

        if (inside)
            *rest = qdot_mul(pool, *rest, power);
        else
            constant = qdot_mul(pool, constant, power);
    }
    return constant;
}

static qdot_expr
definite_node(qdot_pool *pool, qdot_expr f, qdot_expr a, qdot_expr b, const char *name)
{
    const int order = order_of_ends(pool, a, b);
    const size_t before = pool->nodes.n;
    uint8_t sign = order > 0 ? NODE(pool, f)->sign : 0;
    qdot_expr args[] = {f, a, b}, e;

    if (qdot_infinite(pool, a) == 0 && qdot_infinite(pool, b) == 0 && order > 0) {
        const qdot_expr width = qdot_sub(pool, b, a);

        if (!(NODE(pool, width)->sign & QDOT_NE0))
            sign &= (uint8_t)~QDOT_NE0;
    }
    if (!(sign & (QDOT_GE0 | QDOT_LE0)))
        sign = 0; /* a function without a zero may have an integral that is 0 */
    if (FAILED(pool))
        return QDOT_NIL;
    e = qdot_pool_intern(pool, QDOT_INTEGRAL, 0, 3, args, sign);
    if (e == QDOT_NIL || e < before)
        return e;
    if (!holds_bound_from(pool, f, 2) && !((NODE(pool, a)->holds | NODE(pool, b)->holds) & QDOT_HAS_BOUND))
        NODE(pool, e)->holds &= ~(uint32_t)QDOT_HAS_BOUND;
    keep_name(pool, e, name);
    return e;
}

static bool
may_be_end(qdot_pool *pool, qdot_expr a)
{
    if (!qdot_pool_is_scalar(pool, a)) {
        qdot_pool_refuse(pool, QDOT_ETYPE, "an end of an integral is a number");
        return false;
    }
    if (qdot_infinite(pool, a) == 0 && qdot_infinity_refuse(pool, a) != QDOT_OK) {
        qdot_pool_fail(pool);
        return false;
    }
    return true;
}

/* The integral of f, an integrand as it stands in a node, from a to b. */
static qdot_expr
definite(qdot_pool *pool, qdot_expr f, qdot_expr a, qdot_expr b, const char *name)
{
    const bool finite = a != QDOT_NIL && b != QDOT_NIL && qdot_infinite(pool, a) == 0 && qdot_infinite(pool, b) == 0;
    qdot_expr constant, rest;

    if (f == QDOT_NIL || a == QDOT_NIL || b == QDOT_NIL || FAILED(pool) || !may_be_end(pool, a) || !may_be_end(pool, b))
        return QDOT_NIL;
    if (!qdot_pool_is_scalar(pool, f) || (NODE(pool, f)->holds & QDOT_HAS_INFINITY) != 0)
        return qdot_pool_refuse(pool, QDOT_ETYPE, "an integrand is a number");
    if (f == QDOT_ZERO || a == b)
        return QDOT_ZERO;
    constant = split_constant_factors(pool, f, &rest);
    if (rest == QDOT_NIL || constant == QDOT_NIL)
        return QDOT_NIL;
    if (!(NODE(pool, rest)->holds & QDOT_HAS_BOUND)) {
        if (!finite)
            return qdot_pool_refuse(pool, QDOT_EDOMAIN, "the integral of a constant to infinity diverges");
        return qdot_product(pool, 3, (qdot_expr[]){constant, rest, qdot_sub(pool, b, a)});
    }
    if (are_both_known(pool, a, b) && order_of_ends(pool, a, b) < 0)
        return qdot_product(pool, 3, (qdot_expr[]){QDOT_MINUS_ONE, constant, definite_node(pool, rest, b, a, name)});
    return qdot_mul(pool, constant, definite_node(pool, rest, a, b, name));
}

qdot_expr
qdot_integral(qdot_pool *pool, qdot_expr f, qdot_expr x, qdot_expr a, qdot_expr b)
{
    const qdot_symbol *s = qdot_expr_symbol(pool, x);
    const char *name;

    if (f == QDOT_NIL || x == QDOT_NIL)
        return QDOT_NIL;
    if (s == NULL || s->class == QDOT_CONST || s->class == QDOT_WORDS || s->class >= QDOT_BOUND)
        return qdot_pool_refuse(pool, QDOT_ETYPE, "an integral is taken over a name: a coordinate, a parameter or t");
    name = s->name; /* a new symbol may move the symbols, not their names */
    f = rebind(pool, f, &(rebinding){.what = CLOSE, .x = x}, 0);
    return definite(pool, f, a, b, name);
}

/* --- functions with a given derivative ------------------------------------------------------------ */

qdot_expr
qdot_integral_unfound(qdot_pool *pool, qdot_expr f, qdot_expr x)
{
    const qdot_symbol *s = qdot_expr_symbol(pool, x);
    fmpq_t c;
    qdot_expr rest, e;

    if (f == QDOT_NIL || x == QDOT_NIL || FAILED(pool))
        return QDOT_NIL;
    if (s == NULL || s->class == QDOT_CONST || s->class == QDOT_WORDS || s->class == QDOT_INFINITE)
        return qdot_pool_refuse(pool, QDOT_ETYPE, "an integral is taken over a name: a coordinate, a parameter or t");
    if (!qdot_pool_is_scalar(pool, f) || (NODE(pool, f)->holds & QDOT_HAS_INFINITY) != 0)
        return qdot_pool_refuse(pool, QDOT_ETYPE, "an integrand is a number");
    if (f == QDOT_ZERO)
        return QDOT_ZERO;
    fmpq_init(c);
    rest = qdot_expr_unscale(pool, f, c);
    e = qdot_mul(pool, qdot_expr_fmpq(pool, c),
                 qdot_pool_intern(pool, QDOT_INTEGRAL, 1, 2, (qdot_expr[]){rest, x}, 0));
    fmpq_clear(c);
    return e;
}

static qdot_expr
rebuild_unfound(qdot_pool *pool, qdot_expr e, const qdot_expr *args)
{
    const qdot_expr f = ARGS(pool, e)[0], x = ARGS(pool, e)[1];

    if (args[1] != x && (qdot_expr_symbol(pool, args[1]) == NULL || args[1] == QDOT_PI ||
                         qdot_expr_contains(pool, f, args[1]))) {
        (void)qdot_fail(QDOT_EDOMAIN, "an integral without ends has no value at a place");
        (void)qdot_hint("give it ends: integral(E, x, a, b)");
        return qdot_pool_fail(pool);
    }
    return qdot_integral_unfound(pool, args[0], args[1]);
}

/* --- the same with other args ------------------------------------------------------------------- */

qdot_expr
qdot_integral_rebuild(qdot_pool *pool, qdot_expr e, const qdot_expr *args)
{
    return qdot_integral_is_definite(pool, e) ? definite(pool, args[0], args[1], args[2], qdot_integral_name(pool, e))
                                              : rebuild_unfound(pool, e, args);
}

qdot_expr
qdot_integral_copy(const qdot_pool *from, qdot_expr e, qdot_pool *to, const qdot_expr *args)
{
    return qdot_integral_is_definite(from, e) ? definite(to, args[0], args[1], args[2], qdot_integral_name(from, e))
                                              : qdot_integral_unfound(to, args[0], args[1]);
}
