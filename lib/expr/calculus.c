/* calculus.c -- differentiates expressions (derivations), and substitutes in them. */
#include "expr/calculus.h"

#include <stdlib.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/integral.h"
#include "expr/pool.h"
#include "expr/walk.h"

/* --- derivatives and differentials --------------------------------------------------------- */

/* A derivation (linear map with the product rule); it is 0 on nodes with none of the property bits `holds`, `touches`. */
typedef struct {
    qdot_pool *pool;
    const qdot_walk *w;
    uint32_t holds, touches;
    qdot_vec(qdot_expr) terms;
    qdot_vec(qdot_expr) factors;
} derivation;

static qdot_expr
known_derivative(const derivation *d, qdot_expr e)
{
    if (!WHERE(d->pool, e, d->holds, d->touches))
        return QDOT_ZERO;
    return (qdot_expr)qdot_walk_get(d->w, e);
}

static void
add_term_of_derivative(derivation *d, qdot_expr term)
{
    if (qdot_vec_push(&d->terms, term) != QDOT_OK)
        qdot_pool_fail(d->pool);
}

static void
derive_sum(derivation *d, qdot_expr e)
{
    qdot_pool *pool = d->pool;

    d->factors.n = 0;
    for (uint32_t k = 1; k < NODE(pool, e)->n; k += 2) {
        qdot_expr inner = known_derivative(d, ARGS(pool, e)[k]);

        if (inner == QDOT_ZERO)
            continue;
        add_term_of_derivative(d, inner);
        if (qdot_vec_push(&d->factors, ARGS(pool, e)[k + 1]) != QDOT_OK)
            qdot_pool_fail(pool);
    }
}

/* Apply the product rule: d(b^x) = x b^(x-1) db + b^x log(b) dx, times the other factors. */
static void
derive_product(derivation *d, qdot_expr e)
{
    qdot_pool *pool = d->pool;
    uint32_t n = NODE(pool, e)->n;

    for (uint32_t i = 1; i < n && !FAILED(pool); i += 2) {
        qdot_expr b = ARGS(pool, e)[i];
        qdot_expr db = known_derivative(d, b), dx = known_derivative(d, ARGS(pool, e)[i + 1]);

        if (db != QDOT_ZERO)
            add_term_of_derivative(d, qdot_product_derived(pool, e, i, db));
        if (dx != QDOT_ZERO)
            add_term_of_derivative(d, qdot_product(pool, 3,
                                                   (qdot_expr[]){e, qdot_fun1(pool, QDOT_LOG, b), dx}));
    }
}

static void
derive_undefined_function(derivation *d, qdot_expr e)
{
    qdot_pool *pool = d->pool;
    uint32_t n = NODE(pool, e)->n / 2;
    uint32_t orders[64];
    qdot_expr args[64];

    if (n > 64) {
        qdot_pool_refuse(pool, QDOT_ELIMIT,
                         "an undefined function of more than 64 arguments");
        return;
    }
    for (uint32_t i = 0; i < n; i++) {
        qdot_expr inner = known_derivative(d, ARGS(pool, e)[i]);

        if (inner == QDOT_ZERO)
            continue;
        for (uint32_t k = 0; k < n; k++) {
            int64_t order = 0;

            args[k] = ARGS(pool, e)[k];
            qdot_expr_to_int(pool, ARGS(pool, e)[n + k], &order);
            orders[k] = (uint32_t)order + (k == i);
        }
        add_term_of_derivative(d, qdot_mul(pool, qdot_ufun_apply(pool, NODE(pool, e)->op, args, orders),
                                           inner));
    }
}

/* The value if(condition, yes, no); if one of its branches is 0, as the other branch times a factor that is 1 or 0. */
static qdot_expr
make_conditional(qdot_pool *pool, qdot_expr condition, qdot_expr yes, qdot_expr no)
{
    if (yes != QDOT_ZERO && no != QDOT_ZERO)
        return qdot_fun(pool, QDOT_IF, 3, (qdot_expr[]){condition, yes, no});
    return qdot_mul(pool,
                    qdot_fun(pool, QDOT_IF, 3,
                             (qdot_expr[]){condition, yes != QDOT_ZERO ? QDOT_ONE : QDOT_ZERO,
                                           no != QDOT_ZERO ? QDOT_ONE : QDOT_ZERO}),
                    yes != QDOT_ZERO ? yes : no);
}

/* d max(a, b, ...) = a' where a > max(b, ...), else d max(b, ...): of arguments that are equal, perhaps
 * on an interval, the last one counts, as in the operations of a tape (tape/operation.def). */
static void
derive_min_or_max(derivation *d, qdot_expr e, const qdot_expr *args)
{
    qdot_pool *pool = d->pool;
    const qdot_fun_id id = NODE(pool, e)->op;
    const uint32_t n = NODE(pool, e)->n;
    qdot_expr slope = known_derivative(d, args[n - 1]), rest = args[n - 1];

    for (uint32_t k = n - 1; k-- > 0;) {
        const qdot_expr inner = known_derivative(d, args[k]);

        if (inner != QDOT_ZERO || slope != QDOT_ZERO)
            slope = make_conditional(pool,
                                     id == QDOT_MAX ? qdot_rel(pool, QDOT_LT, rest, args[k])
                                               : qdot_rel(pool, QDOT_LT, args[k], rest),
                                     inner, slope);
        rest = qdot_fun(pool, id, n - k, args + k);
    }
    if (slope != QDOT_ZERO)
        add_term_of_derivative(d, slope);
}

static void
derive_function(derivation *d, qdot_expr e)
{
    qdot_pool *pool = d->pool;
    qdot_node node = *NODE(pool, e);
    qdot_expr few[8], *args = node.n > 8 ? qdot_malloc(node.n * sizeof *args) : few;

    if (args == NULL) {
        qdot_pool_fail(pool);
        return;
    }
    for (uint32_t i = 0; i < node.n; i++)
        args[i] = ARGS(pool, e)[i];
    if (node.op == QDOT_MIN || node.op == QDOT_MAX) {
        derive_min_or_max(d, e, args);
    } else if (node.op == QDOT_IF) {
        qdot_expr yes = known_derivative(d, args[1]), no = known_derivative(d, args[2]);

        if (yes != QDOT_ZERO || no != QDOT_ZERO)
            add_term_of_derivative(d, qdot_fun(pool, QDOT_IF, 3, (qdot_expr[]){args[0], yes, no}));
    } else if (node.op == QDOT_LOG && NODE(pool, args[0])->kind == QDOT_FUN &&
               NODE(pool, args[0])->op == QDOT_ABS) { /* log|u|: u'/u */
        qdot_expr u = ARGS(pool, args[0])[0], inner = known_derivative(d, u);

        if (inner != QDOT_ZERO)
            add_term_of_derivative(d, qdot_div(pool, inner, u));
    } else {
        for (uint32_t i = 0; i < node.n; i++) {
            qdot_expr inner = known_derivative(d, args[i]);

            if (inner != QDOT_ZERO)
                add_term_of_derivative(d, qdot_mul(pool,
                                                   qdot_fun_derivative(pool, node.op, node.n, args, i),
                                                   inner));
        }
    }
    if (args != few)
        qdot_free(args);
}

/* Leibniz: the derivative of an integral of f from a to b is f(b) b' - f(a) a' plus the integral of f'. A function F
 * of x with dF/dx = f, known by that alone, gives f x' plus what has the derivative f' - df/dx x'. */
static void
derive_integral(derivation *d, qdot_expr e)
{
    qdot_pool *pool = d->pool;
    const qdot_expr f = ARGS(pool, e)[0], x = ARGS(pool, e)[1];
    qdot_expr inner = known_derivative(d, f);

    if (!qdot_integral_is_definite(pool, e)) {
        const qdot_expr dx = known_derivative(d, x);

        if (dx != QDOT_ZERO)
            inner = qdot_expand(pool, qdot_sub(pool, inner, qdot_mul(pool, qdot_diff(pool, f, x), dx)));
        add_term_of_derivative(d, qdot_mul(pool, f, dx));
        add_term_of_derivative(d, qdot_integral_unfound(pool, inner, x));
        return;
    }
    for (int end = 1; end <= 2; end++) {
        const qdot_expr at = ARGS(pool, e)[end], slope = known_derivative(d, at);

        if (slope != QDOT_ZERO)
            add_term_of_derivative(d, qdot_product(pool, 3, (qdot_expr[]){end == 1 ? QDOT_MINUS_ONE : QDOT_ONE, slope,
                                                                           qdot_integral_at(pool, f, at)}));
    }
    if (inner != QDOT_ZERO)
        add_term_of_derivative(d, qdot_rebuild(pool, e, (qdot_expr[]){inner, ARGS(pool, e)[1], ARGS(pool, e)[2]}));
}

/* Vectors, lists, equations: entry by entry. Inequalities and logic occur only inside
 * conditions, where they are not derived; alone they have no derivative. */
static qdot_expr
derive_entries(derivation *d, qdot_expr e, bool root)
{
    qdot_pool *pool = d->pool;
    qdot_node node = *NODE(pool, e);

    if (node.kind == QDOT_LOGIC || (node.kind == QDOT_REL && node.op != QDOT_EQ)) {
        if (root)
            return qdot_pool_refuse(pool, QDOT_ETYPE, "a comparison has no derivative");
        return QDOT_ZERO;
    }
    d->factors.n = 0;
    for (uint32_t i = 0; i < node.n; i++)
        if (qdot_vec_push(&d->factors, known_derivative(d, ARGS(pool, e)[i])) != QDOT_OK)
            return qdot_pool_fail(pool);
    return qdot_rebuild(pool, e, d->factors.at);
}

static qdot_expr
apply_derivation(qdot_pool *pool, qdot_expr e, uint32_t holds, uint32_t touches,
                 qdot_expr (*of)(qdot_pool *pool, qdot_expr symbol, void *user), void *user)
{
    qdot_walk w;
    derivation d = {.pool = pool, .w = &w, .holds = holds};
    qdot_expr result = QDOT_NIL;

    touches |= QDOT_TOUCHES_VALUE; /* the derivative of a constant vector is a vector of zeros */
    d.touches = touches;
    if (e == QDOT_NIL || FAILED(pool))
        return QDOT_NIL;
    if (qdot_walk_begin_where(pool, e, holds, touches, &w) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < w.n && !FAILED(pool); i++) {
        qdot_expr node = w.at[i];

        d.terms.n = 0;
        switch (NODE(pool, node)->kind) {
        case QDOT_NUM: result = QDOT_ZERO; break;
        case QDOT_SYM:
            result = pool->symbols.at[NODE(pool, node)->at].class == QDOT_CONST
                         ? QDOT_ZERO
                         : of(pool, node, user);
            break;
        case QDOT_SUM:
            derive_sum(&d, node);
            result = qdot_sum_scaled(pool, d.terms.n, d.factors.at, d.terms.at);
            break;
        case QDOT_PROD:
            derive_product(&d, node);
            result = qdot_sum(pool, d.terms.n, d.terms.at);
            break;
        case QDOT_UFUN:
            derive_undefined_function(&d, node);
            result = qdot_sum(pool, d.terms.n, d.terms.at);
            break;
        case QDOT_INTEGRAL:
            derive_integral(&d, node);
            result = qdot_sum(pool, d.terms.n, d.terms.at);
            break;
        case QDOT_FUN:
            derive_function(&d, node);
            result = qdot_sum(pool, d.terms.n, d.terms.at);
            break;
        default: result = derive_entries(&d, node, i + 1 == w.n);
        }
        w.value[i] = result;
    }
    qdot_free(d.terms.at);
    qdot_free(d.factors.at);
    qdot_walk_end(&w);
    return FAILED(pool) ? QDOT_NIL : result;
}

static qdot_expr
partial_derivative_of_symbol(qdot_pool *pool, qdot_expr symbol, void *user)
{
    (void)pool;
    return symbol == *(qdot_expr *)user ? QDOT_ONE : QDOT_ZERO;
}

qdot_expr
qdot_diff(qdot_pool *pool, qdot_expr e, qdot_expr x)
{
    if (x == QDOT_NIL || e == QDOT_NIL)
        return QDOT_NIL;
    if (NODE(pool, x)->kind != QDOT_SYM)
        return qdot_pool_refuse(
            pool, QDOT_ETYPE,
            "a derivative is taken with respect to a name: a coordinate, a "
            "velocity, a parameter or t");
    return apply_derivation(pool, e, 0, NODE(pool, x)->touches, partial_derivative_of_symbol, &x);
}

/* Flags of symbols that may change with time: all except parameters, formal arguments and constants. */
static const uint32_t in_time_holds =
    QDOT_HAS_TIME | QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION |
    QDOT_HAS_MOMENTUM | QDOT_HAS_MULTIPLIER | QDOT_HAS_DIFFERENTIAL | QDOT_HAS_DELTA;

static qdot_expr
time_derivative_of_symbol(qdot_pool *pool, qdot_expr symbol, void *user)
{
    (void)user;
    switch (pool->symbols.at[NODE(pool, symbol)->at].class) {
    case QDOT_TIME: return QDOT_ONE;
    case QDOT_COORD: return qdot_symbol_jet(pool, symbol, 1);
    case QDOT_MOMENTUM:
    case QDOT_MULTIPLIER:
    case QDOT_DIFFERENTIAL:
    case QDOT_DELTA:
        return qdot_pool_refuse(pool, QDOT_EDOMAIN, "%s has no time derivative here",
                                pool->symbols.at[NODE(pool, symbol)->at].name);
    default: return QDOT_ZERO;
    }
}

qdot_expr
qdot_ddt(qdot_pool *pool, qdot_expr e)
{
    return apply_derivation(pool, e, in_time_holds, 0, time_derivative_of_symbol, NULL);
}

static qdot_expr
differential_of_symbol(qdot_pool *pool, qdot_expr symbol, void *user)
{
    const qdot_symbol *s = &pool->symbols.at[NODE(pool, symbol)->at];

    (void)user;
    if (s->class == QDOT_TIME || (s->class == QDOT_COORD && s->order == 0))
        return qdot_symbol_of(pool, QDOT_DIFFERENTIAL, symbol);
    if (s->class == QDOT_COORD)
        return qdot_pool_refuse(pool, QDOT_EDOMAIN,
                                "a line element is of positions; %s is a velocity",
                                s->name);
    return QDOT_ZERO;
}

qdot_expr
qdot_differential(qdot_pool *pool, qdot_expr e)
{
    return apply_derivation(pool, e, in_time_holds, 0, differential_of_symbol, NULL);
}

/* --- replacing subexpressions --------------------------------------------------------------- */

struct replacements {
    size_t n;
    const qdot_expr *from, *to;
};

static qdot_expr
find_replacement(qdot_pool *pool, qdot_expr node, void *user)
{
    const struct replacements *r = user;

    (void)pool;
    for (size_t i = 0; i < r->n; i++)
        if (r->from[i] == node)
            return r->to[i];
    return QDOT_NIL;
}

/* Find the replacement of a node in a long sorted list, by bisection. */
static qdot_expr
find_replacement_by_bisection(qdot_pool *pool, qdot_expr node, void *user)
{
    const struct replacements *r = user;
    size_t lo = 0, hi = r->n;

    (void)pool;
    while (lo < hi) {
        size_t mid = (lo + hi) / 2;

        if (r->from[mid] == node)
            return r->to[mid];
        if (r->from[mid] < node)
            lo = mid + 1;
        else
            hi = mid;
    }
    return QDOT_NIL;
}

static int
compare_replaced_nodes(const void *a, const void *b)
{
    const qdot_expr *x = a, *y = b;

    return *x < *y ? -1 : *x > *y;
}

/* The branch of if(...) that the replacements select; the branch not selected may be undefined there. */
static qdot_expr
choose_branch(qdot_pool *pool, qdot_expr node, void *user)
{
    const struct replacements *r = user;
    qdot_expr c;

    if (NODE(pool, node)->op != QDOT_IF)
        return node;
    c = qdot_subs(pool, ARGS(pool, node)[0], r->n, r->from, r->to);
    return c == QDOT_NIL ? QDOT_NIL : c == QDOT_TRUE ? ARGS(pool, node)[1] : c == QDOT_FALSE ? ARGS(pool, node)[2] : node;
}

qdot_expr
qdot_subs(qdot_pool *pool, qdot_expr e, size_t n, const qdot_expr *from,
          const qdot_expr *to)
{
    struct replacements r = {n, from, to};
    qdot_expr *pairs, *split, result;
    uint32_t holds = 0, touches = 0;

    for (size_t i = 0; i < n; i++) {
        if (from[i] == QDOT_NIL || to[i] == QDOT_NIL)
            return QDOT_NIL;
        touches |= NODE(pool, from[i])->touches;
        if (NODE(pool, from[i])->touches == 0) /* from[i] contains numbers only */
            holds = UINT32_MAX;
    }
    if (pool->choices && e != QDOT_NIL && (NODE(pool, e)->holds & QDOT_HAS_FUN) != 0)
        e = qdot_walk_replace(pool, e, QDOT_FUN, choose_branch, &r);
    if (n < 8)
        return qdot_walk_map_where(pool, e, holds, touches, find_replacement, &r);
    pairs = qdot_malloc(4 * n * sizeof *pairs);
    if (pairs == NULL)
        return qdot_pool_fail(pool);
    split = pairs + 2 * n;
    for (size_t i = 0; i < n; i++) {
        pairs[2 * i] = from[i];
        pairs[2 * i + 1] = to[i];
    }
    qsort(pairs, n, 2 * sizeof *pairs, compare_replaced_nodes);
    for (size_t i = 0; i < n; i++) {
        split[i] = pairs[2 * i];
        split[n + i] = pairs[2 * i + 1];
    }
    r = (struct replacements){n, split, split + n};
    result = qdot_walk_map_where(pool, e, holds, touches, find_replacement_by_bisection, &r);
    qdot_free(pairs);
    return result;
}

qdot_status
qdot_jumps(qdot_pool *pool, qdot_expr e, uint32_t holds, bool *yes)
{
    static const qdot_fun_id those[] = {QDOT_FLOOR, QDOT_MOD, QDOT_SIGN, QDOT_IF};
    qdot_walk w;

    *yes = false;
    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    for (size_t i = 0; i < w.n; i++)
        for (size_t j = 0; j < sizeof those / sizeof *those; j++)
            *yes = *yes
                   || (qdot_expr_kind(pool, w.at[i]) == QDOT_FUN
                       && NODE(pool, w.at[i])->op == those[j]
                       && (NODE(pool, w.at[i])->holds & holds) != 0);
    qdot_walk_end(&w);
    return QDOT_OK;
}
