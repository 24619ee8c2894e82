/* definedness.c -- where an expression is defined, as a set of conditions. */
#include "expr/build.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/inequality/less.h"
#include "normal/solve/conditions.h"

/* --- where a function is defined ------------------------------------------------------ */

/* The set of conditions with lo <= u <= hi, or lo < u < hi if `open`; a nil end adds nothing. */
static qdot_expr
add_bounds(qdot_pool *pool, qdot_expr set, qdot_expr u, qdot_expr lo, qdot_expr hi, bool open)
{
    qdot_rel_op op = open ? QDOT_LT : QDOT_LE;

    if (lo != QDOT_NIL)
        set = qdot_conditions_and(pool, set, qdot_rel(pool, op, lo, u));
    if (hi != QDOT_NIL)
        set = qdot_conditions_and(pool, set, qdot_rel(pool, op, u, hi));
    return set;
}

static qdot_expr
add_conditions_of_function(qdot_pool *pool, qdot_expr set, qdot_expr node)
{
    qdot_expr u = qdot_expr_count(pool, node) == 0 ? QDOT_NIL : qdot_expr_arg(pool, node, 0);

    switch (qdot_expr_node(pool, node)->op) {
    case QDOT_LOG:
        return add_bounds(pool, set, u, QDOT_ZERO, QDOT_NIL, true);
    case QDOT_ASIN:
    case QDOT_ACOS:
        return add_bounds(pool, set, u, QDOT_MINUS_ONE, QDOT_ONE, false);
    case QDOT_ATANH:
        return add_bounds(pool, set, u, QDOT_MINUS_ONE, QDOT_ONE, true);
    case QDOT_ACOSH:
        return add_bounds(pool, set, u, QDOT_ONE, QDOT_NIL, false);
    default:
        return set;
    }
}

/* The set, and that bases of powers with exponents that are no integers are not negative, or positive where the exponent
 * may be negative. */
static qdot_expr
add_conditions_of_powers(qdot_pool *pool, qdot_expr set, qdot_expr product, qdot_expr x)
{
    for (uint32_t i = 1; i < qdot_expr_count(pool, product); i += 2) {
        qdot_expr base = qdot_expr_arg(pool, product, i),
                  exponent = qdot_expr_arg(pool, product, i + 1);
        const fmpq *q = qdot_expr_rational(pool, exponent);

        if ((x != QDOT_NIL && !qdot_expr_contains(pool, base, x)) ||
            (q != NULL && fmpz_is_one(fmpq_denref(q))))
            continue;
        set = add_bounds(pool, set, base, QDOT_ZERO, QDOT_NIL, q == NULL || fmpq_sgn(q) < 0);
    }
    return set;
}

/* A function that adds to the set the conditions of one node of f; of factors only those that
 * contain x (nil: all). */
typedef qdot_expr conditions_of_part(qdot_pool *pool, qdot_expr set, qdot_expr part, qdot_expr x);

/* --- what if(...) chooses --------------------------------------------------------------------------- */

/* The opposite of the relation c, which holds where c does not; nil: c is neither < nor <=. */
static qdot_expr
opposite_relation(qdot_pool *pool, qdot_expr c)
{
    const qdot_rel_op op = qdot_expr_kind(pool, c) == QDOT_REL ? qdot_expr_node(pool, c)->op : QDOT_EQ;

    if (op != QDOT_LT && op != QDOT_LE)
        return QDOT_NIL;
    return qdot_rel(pool, op == QDOT_LT ? QDOT_LE : QDOT_LT, qdot_expr_arg(pool, c, 1), qdot_expr_arg(pool, c, 0));
}

/* Whether the relation, a < b or a <= b, is proved to hold wherever the relation c holds. */
static bool
relation_follows_from(qdot_pool *pool, qdot_expr relation, qdot_expr c)
{
    const qdot_facts facts = {.n_conditions = 1, .conditions = &c};
    qdot_decision d;

    if (qdot_expr_kind(pool, relation) != QDOT_REL || qdot_expr_kind(pool, c) != QDOT_REL)
        return false;
    if (qdot_decide_less(pool, qdot_expr_arg(pool, relation, 0), qdot_expr_arg(pool, relation, 1),
                         qdot_expr_node(pool, relation)->op == QDOT_LT, &facts, &d) != QDOT_OK) {
        (void)qdot_pool_fail(pool);
        return false;
    }
    return d.verdict == QDOT_PROVED;
}

/* The expression if(c, gap, 1); for the value that is chosen where c fails (`chosen` false): if(c, 1, gap). */
static qdot_expr
gap_restricted_to_case(qdot_pool *pool, qdot_expr gap, qdot_expr c, bool chosen)
{
    const qdot_expr args[3] = {c, chosen ? gap : QDOT_ONE, chosen ? QDOT_ONE : gap};

    return gap == QDOT_NIL ? QDOT_NIL : qdot_fun(pool, QDOT_IF, 3, args);
}

/* A relation required only where c holds (`chosen`) or does not: a - 1 > 0 becomes if(c, a - 1, 1) > 0. */
static qdot_expr
relation_restricted_to_case(qdot_pool *pool, qdot_expr relation, qdot_expr c, bool chosen)
{
    const qdot_expr u = qdot_conditions_nonzero(pool, relation), opposite = opposite_relation(pool, c),
                    here = chosen ? c : opposite;
    qdot_expr gap = u != QDOT_NIL ? u : qdot_sub(pool, qdot_expr_arg(pool, relation, 1), qdot_expr_arg(pool, relation, 0));

    if (opposite != QDOT_NIL && relation_follows_from(pool, relation, here))
        return QDOT_TRUE;
    if (opposite != QDOT_NIL && u == QDOT_NIL && relation_follows_from(pool, opposite_relation(pool, relation), here))
        return chosen ? opposite : c;
    gap = gap_restricted_to_case(pool, gap, c, chosen);
    gap = gap == QDOT_NIL || u == QDOT_NIL ? gap : qdot_fun1(pool, QDOT_ABS, gap);
    return gap == QDOT_NIL ? QDOT_NIL : qdot_rel(pool, qdot_expr_node(pool, relation)->op, QDOT_ZERO, gap);
}

static qdot_expr conditions_of_nodes(qdot_pool *pool, qdot_expr f, qdot_expr x, conditions_of_part *of_part);

/* The set of conditions with those of both values that the function if(...), `choice`, may take. */
static qdot_expr
add_conditions_of_if(qdot_pool *pool, qdot_expr set, qdot_expr choice, qdot_expr x, conditions_of_part *of_part)
{
    const qdot_expr c = qdot_expr_arg(pool, choice, 0);

    for (uint32_t k = 1; k <= 2; k++) {
        const qdot_expr inner = conditions_of_nodes(pool, qdot_expr_arg(pool, choice, k), x, of_part);

        if (inner == QDOT_FALSE)
            set = qdot_conditions_and(
                pool, set, qdot_rel(pool, QDOT_LT, QDOT_ZERO, gap_restricted_to_case(pool, QDOT_MINUS_ONE, c, k == 1)));
        for (uint32_t i = 0; inner != QDOT_NIL && inner != QDOT_FALSE && i < qdot_expr_count(pool, inner); i++)
            set = qdot_conditions_and(pool, set, relation_restricted_to_case(pool, qdot_expr_arg(pool, inner, i), c, k == 1));
    }
    return set;
}

/* The conditions of all nodes of f that contain x (nil: all nodes); those inside an if(...) only for their case. */
static qdot_expr
conditions_of_nodes(qdot_pool *pool, qdot_expr f, qdot_expr x, conditions_of_part *of_part)
{
    qdot_expr set = QDOT_NIL;
    qdot_walk w;

    if (qdot_walk_begin(pool, f, &w) != QDOT_OK)
        return qdot_pool_fail(pool);
    if (w.n > 0)
        qdot_walk_set(&w, f, true); /* mark the nodes that must be defined where f is; first f itself */
    for (size_t i = w.n; i-- > 0;) {
        const bool choice = qdot_expr_is_function(pool, w.at[i], QDOT_IF);

        for (uint32_t k = 0; qdot_walk_get(&w, w.at[i]) && k < (choice ? 1 : qdot_expr_count(pool, w.at[i])); k++)
            qdot_walk_set(&w, qdot_expr_arg(pool, w.at[i], k), true);
    }
    for (size_t i = 0; i < w.n; i++) {
        if (!qdot_walk_get(&w, w.at[i]) || (x != QDOT_NIL && !qdot_expr_contains(pool, w.at[i], x)))
            continue;
        set = of_part(pool, set, w.at[i], x);
        if (qdot_expr_is_function(pool, w.at[i], QDOT_IF))
            set = add_conditions_of_if(pool, set, w.at[i], x, of_part);
    }
    qdot_walk_end(&w);
    return set;
}

qdot_expr
qdot_conditions_of_function(qdot_pool *pool, qdot_expr function)
{
    return add_conditions_of_function(pool, QDOT_NIL, function);
}

static qdot_expr
add_domain_of_node(qdot_pool *pool, qdot_expr set, qdot_expr part, qdot_expr x)
{
    if (qdot_expr_kind(pool, part) == QDOT_FUN)
        return add_conditions_of_function(pool, set, part);
    return qdot_expr_kind(pool, part) == QDOT_PROD ? add_conditions_of_powers(pool, set, part, x) : set;
}

qdot_expr
qdot_conditions_of_domain(qdot_pool *pool, qdot_expr f, qdot_expr x)
{
    return conditions_of_nodes(pool, f, x, add_domain_of_node);
}

/* --- where its divisors vanish -------------------------------------------------------- */

static qdot_expr
add_condition_of_pole(qdot_pool *pool, qdot_expr set, qdot_expr node)
{
    qdot_expr u = qdot_expr_count(pool, node) == 0 ? QDOT_NIL : qdot_expr_arg(pool, node, 0);

    switch (qdot_expr_node(pool, node)->op) {
    case QDOT_TAN:
    case QDOT_SEC: return qdot_conditions_and_nonzero(pool, set, qdot_fun1(pool, QDOT_COS, u));
    case QDOT_COT:
    case QDOT_CSC: return qdot_conditions_and_nonzero(pool, set, qdot_fun1(pool, QDOT_SIN, u));
    default: return set;
    }
}

static qdot_expr
add_divisors_of_node(qdot_pool *pool, qdot_expr set, qdot_expr part, qdot_expr x)
{
    if (qdot_expr_kind(pool, part) == QDOT_FUN)
        return add_condition_of_pole(pool, set, part);
    if (qdot_expr_kind(pool, part) != QDOT_PROD)
        return set;
    for (uint32_t k = 1; k < qdot_expr_count(pool, part); k += 2) {
        qdot_expr base = qdot_expr_arg(pool, part, k);
        const fmpq *q = qdot_expr_rational(pool, qdot_expr_arg(pool, part, k + 1));

        if (q != NULL && fmpq_sgn(q) < 0 && (x == QDOT_NIL || qdot_expr_contains(pool, base, x)))
            set = qdot_conditions_and_nonzero(pool, set, base);
    }
    return set;
}

qdot_expr
qdot_conditions_of_divisors(qdot_pool *pool, qdot_expr f, qdot_expr x)
{
    return conditions_of_nodes(pool, f, x, add_divisors_of_node);
}

/* --- powers of what may be negative --------------------------------------------------------------- */

qdot_status
qdot_has_single_places(qdot_pool *pool, size_t n, const qdot_expr *F, size_t m, const qdot_expr *x,
                       const qdot_facts *facts, bool *yes)
{
    const qdot_expr bases = qdot_expr_bases_of_powers(pool, n, F, m, x);

    *yes = false;
    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, bases) && !*yes; i++) {
        const qdot_expr base = qdot_expr_arg(pool, bases, i);
        qdot_decision d;

        if ((qdot_expr_sign(pool, base) & QDOT_GE0) != 0)
            continue;
        QDOT_TRY(qdot_decide_less(pool, QDOT_ZERO, base, false, facts, &d));
        *yes = d.verdict != QDOT_PROVED;
    }
    return QDOT_OK;
}
