/* cases.c -- proves an equation in all cases of the orders and signs of arguments, each inserted as a substitution. */
#include "normal/prove/cases.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/prove/equal.h"
#include "normal/prove/prove.h"
#include "normal/prove/within.h"
#include "normal/refute/constant.h"

enum { LEAVES = 4, SIGNS = 3, NODES = 24, LINKS = SIGNS * LEAVES };

static bool
is_max_or_min(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_is_function(pool, e, QDOT_MAX) || qdot_expr_is_function(pool, e, QDOT_MIN);
}

static bool
is_abs_or_sign(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_is_function(pool, e, QDOT_ABS) || qdot_expr_is_function(pool, e, QDOT_SIGN);
}

static bool
needs_cases(const qdot_pool *pool, qdot_expr e)
{
    return is_max_or_min(pool, e) || is_abs_or_sign(pool, e) || qdot_expr_is_function(pool, e, QDOT_IF);
}

/* --- signs of powers and products ------------------------------------------------------- */

/* The sign of b^x: that of b for odd integers and roots; its square for even exponents. */
static qdot_expr
sign_of_power(qdot_pool *pool, qdot_expr b, qdot_expr x)
{
    const fmpq *k = qdot_expr_rational(pool, x);
    qdot_expr sign = qdot_fun1(pool, QDOT_SIGN, b);

    if (k == NULL)
        return QDOT_NIL;
    return fmpz_is_one(fmpq_denref(k)) && fmpz_is_even(fmpq_numref(k))
               ? qdot_pow_int(pool, sign, 2)
               : sign;
}

/* Replace sign(x y) by sign(x) sign(y), and |x y| by |x| |y|. */
static qdot_expr
split_signs_of_products(qdot_pool *pool, qdot_expr e, void *user)
{
    bool sign = qdot_expr_is_function(pool, e, QDOT_SIGN);
    qdot_expr x, result = QDOT_ONE;

    (void)user;
    if (!is_abs_or_sign(pool, e))
        return QDOT_NIL;
    x = qdot_expr_arg(pool, e, 0);
    if (qdot_expr_kind(pool, x) != QDOT_PROD)
        return QDOT_NIL;
    if (sign && qdot_expr_is_negative(pool, x))
        result = QDOT_MINUS_ONE;
    else if (!sign)
        result = qdot_fun1(pool, QDOT_ABS, qdot_expr_arg(pool, x, 0));
    for (uint32_t i = 1; i < qdot_expr_count(pool, x) && result != QDOT_NIL; i += 2) {
        qdot_expr b = qdot_expr_arg(pool, x, i), k = qdot_expr_arg(pool, x, i + 1), one;
        int64_t whole;

        if (sign)
            one = sign_of_power(pool, b, k);
        else if (qdot_expr_to_int(pool, k, &whole))
            one = qdot_pow(pool, qdot_fun1(pool, QDOT_ABS, b), k);
        else
            one = qdot_fun1(pool, QDOT_ABS, qdot_pow(pool, b, k));
        result = one == QDOT_NIL ? one : qdot_mul(pool, result, one);
    }
    return result;
}

/* A simpler expression that has the sign of u times *sign: without coefficient and increasing odd functions. */
static qdot_expr
sign_key(qdot_pool *pool, qdot_expr u, int *sign)
{
    *sign = 1;
    while (u != QDOT_NIL && qdot_expr_kind(pool, u) != QDOT_NUM) {
        if (qdot_expr_is_negative(pool, u)) {
            *sign = -*sign;
            u = qdot_neg(pool, u);
        } else if (qdot_expr_is_function_that(pool, u, QDOT_FUN_ODD | QDOT_FUN_RISING)) {
            u = qdot_expr_arg(pool, u, 0);
        } else if (qdot_expr_kind(pool, u) == QDOT_PROD &&
                   qdot_expr_arg(pool, u, 0) != QDOT_ONE) {
            u = qdot_div(pool, u, qdot_expr_arg(pool, u, 0));
        } else {
            break;
        }
    }
    return u;
}

/* --- signs and orders that distinguish the cases ---------------------------------------- */

struct cases {
    qdot_pool *pool;
    qdot_expr side[2];
    qdot_expr leaf[LEAVES]; /* the different arguments of max and min, whose order is a case */
    qdot_expr sign[SIGNS];  /* canonical forms u of |u|, sign(u) and of conditions of if(...) */
    size_t n_leaves, n_signs;
    bool zero[SIGNS]; /* u = 0 is a case of its own, because of sign(u) or an if(...) */
    qdot_expr node[NODES],
        to[NODES]; /* the functions max, abs ..., inner ones first, and the values of these in the present case */
    size_t n;
    /* an expression proved equal to the one at index `place` of `list` (or to its negative) */
    struct alias {
        const qdot_expr *list;
        qdot_expr e;
        size_t place;
        int turn;
    } alias[NODES];
    size_t n_aliases;
    /* the sign with index k is that of the difference leaf[i] - leaf[j] of arguments of max or min */
    struct link {
        size_t k, i, j;
    } link[LINKS];
    size_t n_links;
    bool too_much;
};

static bool
is_proved_equal(struct cases *c, qdot_expr a, qdot_expr b)
{
    bool equal = false;

    if (qdot_prove_equal(c->pool, a, b, NULL, &equal) != QDOT_OK)
        c->too_much = true;
    return equal;
}

/* The index in a list of an expression proved equal to e, or (if turn is not NULL) to -e; n if there is none. */
static size_t
find_equal_expression(struct cases *c, const qdot_expr *list, size_t n, qdot_expr e, int *turn)
{
    size_t place = qdot_expr_place(n, list, e);
    qdot_expr other = turn == NULL || e == QDOT_NIL ? e : qdot_neg(c->pool, e);

    if (turn != NULL)
        *turn = 1;
    if (place < n || e == QDOT_NIL || c->too_much)
        return place;
    for (size_t i = 0; i < c->n_aliases; i++)
        if (c->alias[i].list == list && c->alias[i].e == e) {
            if (turn != NULL)
                *turn = c->alias[i].turn;
            return c->alias[i].place;
        }
    for (size_t i = 0; i < n && place == n && c->n_aliases < NODES; i++) {
        int t = is_proved_equal(c, list[i], e)                     ? 1
                : other != e && is_proved_equal(c, list[i], other) ? -1
                                                             : 0;

        if (t == 0)
            continue;
        place = i;
        if (turn != NULL)
            *turn = t;
        c->alias[c->n_aliases++] = (struct alias){list, e, i, t};
    }
    return place;
}

static void
add_argument(struct cases *c, qdot_expr e)
{
    if (find_equal_expression(c, c->leaf, c->n_leaves, e, NULL) < c->n_leaves)
        return;
    if (c->n_leaves == LEAVES)
        c->too_much = true;
    else
        c->leaf[c->n_leaves++] = e;
}

/* The index of the sign of u, which is added if it is new; SIGNS: no room. */
static size_t
add_sign(struct cases *c, qdot_expr u, bool zero)
{
    int turned;
    qdot_expr key = sign_key(c->pool, u, &turned);
    size_t k;

    if (key != QDOT_NIL && qdot_expr_is_constant(c->pool, key))
        return SIGNS;
    k = find_equal_expression(c, c->sign, c->n_signs, key, &turned);
    if (k == SIGNS || key == QDOT_NIL) {
        c->too_much = true;
        return SIGNS;
    }
    if (k == c->n_signs) {
        c->sign[c->n_signs++] = key;
        c->zero[k] = false;
    }
    c->zero[k] |= zero;
    return k;
}

/* Add the signs on which the comparisons in the condition of an if depend. */
static qdot_status
cases_add_condition(struct cases *c, qdot_expr condition)
{
    qdot_pool *pool = c->pool;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(pool, condition, &w));
    for (size_t i = 0; i < w.n; i++)
        if (qdot_expr_kind(pool, w.at[i]) == QDOT_REL) {
            qdot_expr gap = qdot_sub(pool, qdot_expr_arg(pool, w.at[i], 1),
                                     qdot_expr_arg(pool, w.at[i], 0));

            add_sign(c, gap, true);
        }
    qdot_walk_end(&w);
    return QDOT_OK;
}

static qdot_status
add_case_function(struct cases *c, qdot_expr e)
{
    const qdot_pool *pool = c->pool;

    if (c->n == NODES) {
        c->too_much = true;
        return QDOT_OK;
    }
    c->node[c->n++] = e;
    if (qdot_expr_is_function(pool, e, QDOT_IF))
        return cases_add_condition(c, qdot_expr_arg(pool, e, 0));
    if (is_max_or_min(pool, e)) {
        for (uint32_t i = 0; i < qdot_expr_count(pool, e); i++)
            if (!is_max_or_min(pool, qdot_expr_arg(pool, e, i)))
                add_argument(c, qdot_expr_arg(pool, e, i));
    } else {
        add_sign(c, qdot_expr_arg(pool, e, 0), qdot_expr_is_function(pool, e, QDOT_SIGN));
    }
    return QDOT_OK;
}

/* Set too_much if e contains a function that needs a case distinction itself. */
static qdot_status
refuse_inner_cases(struct cases *c, qdot_expr e)
{
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(c->pool, e, &w));
    for (size_t i = 0; i < w.n; i++)
        c->too_much |= needs_cases(c->pool, w.at[i]);
    qdot_walk_end(&w);
    return QDOT_OK;
}

/* Find the signs that are differences of arguments of max or min: the order of these determines the signs. */
static void
relate_signs_to_order(struct cases *c)
{
    for (size_t k = 0; k < c->n_signs; k++)
        for (size_t i = 0; i < c->n_leaves; i++)
            for (size_t j = 0; j < c->n_leaves && !c->too_much; j++)
                if (i != j &&
                    is_proved_equal(c, c->sign[k], qdot_sub(c->pool, c->leaf[i], c->leaf[j])))
                    c->link[c->n_links++] = (struct link){k, i, j};
}

/* Whether signs contradict an order of arguments: leaf[i] <= leaf[j] although leaf[i] - leaf[j] > 0. */
static bool
contradicts(const struct cases *c, const size_t *order, const int *sign)
{
    for (size_t n = 0; n < c->n_links; n++) {
        const struct link *l = &c->link[n];
        size_t i = 0;

        while (order[i] != l->i && order[i] != l->j)
            i++;
        if (order[i] == l->i ? sign[l->k] > 0 : sign[l->k] < 0)
            return true;
    }
    return false;
}

static qdot_status
gather_cases(struct cases *c)
{
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin_n(c->pool, 2, c->side, &w));
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < w.n && status == QDOT_OK; i++)
        if (needs_cases(c->pool, w.at[i]))
            status = add_case_function(c, w.at[i]);
    qdot_walk_end(&w);
    QDOT_TRY(status);
    for (size_t i = 0; i < c->n_leaves && !c->too_much; i++)
        QDOT_TRY(refuse_inner_cases(c, c->leaf[i]));
    for (size_t i = 0; i < c->n_signs && !c->too_much; i++)
        QDOT_TRY(refuse_inner_cases(c, c->sign[i]));
    relate_signs_to_order(c);
    return QDOT_OK;
}

/* --- evaluating one case ----------------------------------------------------------------- */

static int
sign_of_constant(struct cases *c, qdot_expr e)
{
    qdot_constant_sign sign;

    if (qdot_constant_decide(c->pool, e, &sign) != QDOT_OK ||
        sign == QDOT_CONSTANT_UNKNOWN)
        c->too_much = true;
    return sign == QDOT_CONSTANT_POSITIVE ? 1 : sign == QDOT_CONSTANT_NEGATIVE ? -1 : 0;
}

/* The sign of u in the case that is given by the signs `sign`. */
static int
sign_in_case(struct cases *c, qdot_expr u, const int *sign)
{
    int turned, again;
    qdot_expr key = sign_key(c->pool, u, &turned);
    size_t k;

    if (key == QDOT_NIL)
        return 0;
    if (qdot_expr_is_constant(c->pool, key))
        return turned * sign_of_constant(c, key);
    k = find_equal_expression(c, c->sign, c->n_signs, key, &again);
    if (k == c->n_signs) {
        c->too_much = true;
        return 0;
    }
    return turned * again * sign[k];
}

/* Evaluate the condition of an if in a case, node by node; in the table 1 is false, 2 is true. */
static bool
condition_holds_in_case(struct cases *c, qdot_expr condition, const int *sign)
{
    qdot_pool *pool = c->pool;
    uint64_t value = 0;
    qdot_walk w;

    if (qdot_walk_begin(pool, condition, &w) != QDOT_OK) {
        c->too_much = true;
        return false;
    }
    for (size_t i = 0; i < w.n; i++) {
        qdot_expr e = w.at[i];
        unsigned op = qdot_expr_node(pool, e)->op;
        bool good = e == QDOT_TRUE;

        if (qdot_expr_kind(pool, e) == QDOT_REL) {
            int s = sign_in_case(
                c, qdot_sub(pool, qdot_expr_arg(pool, e, 1), qdot_expr_arg(pool, e, 0)),
                sign);

            good = op == QDOT_EQ ? s == 0 : op == QDOT_LT ? s > 0 : s >= 0;
        } else if (qdot_expr_kind(pool, e) == QDOT_LOGIC) {
            good = op != QDOT_OR;
            for (uint32_t k = 0; k < qdot_expr_count(pool, e); k++) {
                bool part = qdot_walk_get(&w, qdot_expr_arg(pool, e, k)) == 2;

                good = op == QDOT_NOT   ? !part
                       : op == QDOT_AND ? good && part
                                        : good || part;
            }
        }
        value = good ? 2 : 1;
        qdot_walk_set(&w, e, value);
    }
    value = qdot_walk_get(&w, condition);
    qdot_walk_end(&w);
    return value == 2;
}

/* The argument that max or min selects in the present case, by the ranks of the arguments. */
static qdot_expr
selected_argument(struct cases *c, qdot_expr e, size_t k, const size_t *rank)
{
    size_t best = SIZE_MAX;

    for (uint32_t i = 0; i < qdot_expr_count(c->pool, e); i++) {
        qdot_expr x = qdot_expr_arg(c->pool, e, i);
        size_t inner = qdot_expr_place(k, c->node, x), at;

        at = find_equal_expression(c, c->leaf, c->n_leaves, inner < k ? c->to[inner] : x, NULL);
        if (at == c->n_leaves) {
            c->too_much = true;
            return x;
        }
        if (best == SIZE_MAX ||
            (qdot_expr_is_function(c->pool, e, QDOT_MAX) ? rank[at] > rank[best]
                                               : rank[at] < rank[best]))
            best = at;
    }
    return c->leaf[best];
}

/* Insert the values of a case: order [] lists the arguments of max and min ascending, sign [] is 1, -1 or 0. */
static void
insert_case_values(struct cases *c, const size_t *order, const int *sign)
{
    qdot_pool *pool = c->pool;
    size_t rank[LEAVES];

    for (size_t i = 0; i < c->n_leaves; i++)
        rank[order[i]] = i;
    for (size_t k = 0; k < c->n; k++) {
        qdot_expr e = c->node[k], u = qdot_expr_arg(pool, e, 0);
        int s;

        if (is_max_or_min(pool, e)) {
            c->to[k] = selected_argument(c, e, k, rank);
        } else if (qdot_expr_is_function(pool, e, QDOT_IF)) {
            u = qdot_expr_arg(pool, e, condition_holds_in_case(c, u, sign) ? 1 : 2);
            c->to[k] = qdot_subs(pool, u, k, c->node, c->to);
        } else {
            s = sign_in_case(c, u, sign);
            c->to[k] = qdot_expr_is_function(pool, e, QDOT_SIGN) ? qdot_expr_int(pool, s)
                       : s == 0                        ? QDOT_ZERO
                       : s > 0                         ? u
                                                       : qdot_neg(pool, u);
        }
    }
}

/* Whether every part of e is always evaluated: the branch of an if that is not taken may be undefined. */
static bool
has_no_branches(const struct cases *c)
{
    bool none = true;
    qdot_walk w;

    if (qdot_walk_begin_n(c->pool, 2, c->side, &w) != QDOT_OK)
        return false;
    for (size_t i = 0; i < w.n; i++)
        none &= !qdot_expr_is_function(c->pool, w.at[i], QDOT_IF);
    qdot_walk_end(&w);
    return none;
}

/* Whether an expression is undefined because it divides by an expression that is 0 in this case; nothing is claimed then. */
static bool
divides_by_zero_of_case(const struct cases *c, qdot_status status, const int *sign)
{
    bool at_zero = false;

    for (size_t i = 0; i < c->n_signs; i++)
        at_zero |= sign[i] == 0;
    return status == QDOT_EDOMAIN && at_zero && has_no_branches(c);
}

/* Solve key = c x + rest = 0 for a symbol x, and insert the solution into e; e itself if there is no such x. */
static qdot_expr
insert_zero_of(qdot_pool *pool, qdot_expr e, qdot_expr key)
{
    uint32_t n = qdot_expr_kind(pool, key) == QDOT_SUM ? qdot_expr_count(pool, key) : 2;

    for (uint32_t i = 1; i < n; i += 2) {
        bool sum = n > 2 || qdot_expr_kind(pool, key) == QDOT_SUM;
        qdot_expr x = sum ? qdot_expr_arg(pool, key, i) : key;
        qdot_expr c = sum ? qdot_expr_arg(pool, key, i + 1) : QDOT_ONE, rest;

        if (qdot_expr_kind(pool, x) != QDOT_SYM ||
            qdot_expr_is_class(pool, x, QDOT_CONST))
            continue;
        rest = qdot_sub(pool, key, qdot_mul(pool, c, x));
        if (rest == QDOT_NIL || qdot_expr_contains(pool, rest, x))
            continue;
        rest = qdot_neg(pool, qdot_div(pool, rest, c));
        return qdot_subs(pool, e, 1, &x, &rest);
    }
    return e;
}

/* Whether an expression that must be defined is undefined where expressions are 0 in this case. */
static bool
is_undefined_in_case(struct cases *c, const int *sign, const qdot_facts *facts)
{
    qdot_expr e = facts == NULL ? QDOT_NIL : facts->defined;

    for (size_t k = 0; k < c->n_signs && e != QDOT_NIL; k++)
        if (sign[k] == 0)
            e = insert_zero_of(c->pool, e, c->sign[k]);
    if (!qdot_pool_failed(c->pool))
        return false;
    return qdot_pool_check(c->pool) == QDOT_EDOMAIN;
}

/* Collect what is known in a case: the given facts, the order of arguments, the signs and zeros. */
static void
collect_case_facts(struct cases *c, const size_t *order, const int *sign, const qdot_facts *facts,
                   qdot_facts *known, qdot_expr *relation, qdot_expr *condition)
{
    qdot_pool *pool = c->pool;
    size_t nr = 0, nc = 0;

    *known = facts == NULL ? (qdot_facts){0} : *facts;
    for (size_t i = 0; i < known->n_relations; i++)
        relation[nr++] = known->relations[i];
    for (size_t i = 0; i < known->n_conditions; i++)
        condition[nc++] = known->conditions[i];
    for (size_t i = 0; i < c->n_signs; i++)
        if (sign[i] == 0)
            relation[nr++] = c->sign[i];
        else
            condition[nc++] = sign[i] > 0
                                  ? qdot_rel(pool, QDOT_LT, QDOT_ZERO, c->sign[i])
                                  : qdot_rel(pool, QDOT_LT, c->sign[i], QDOT_ZERO);
    for (size_t i = 1; i < c->n_leaves; i++)
        condition[nc++] =
            qdot_rel(pool, QDOT_LE, c->leaf[order[i - 1]], c->leaf[order[i]]);
    known->n_relations = nr;
    known->relations = relation;
    known->n_conditions = nc;
    known->conditions = condition;
}

static qdot_status
prove_case(struct cases *c, const size_t *order, const int *sign, const qdot_facts *facts,
           bool *equal)
{
    size_t given = facts == NULL ? 0 : facts->n_conditions + facts->n_relations;
    qdot_expr *condition = qdot_malloc((given + 2 * SIGNS + LEAVES) * sizeof *condition);
    qdot_expr side[2], *relation;
    qdot_status status = condition == NULL ? QDOT_ENOMEM : QDOT_OK;
    bool empty = false;
    qdot_facts known;

    *equal = status == QDOT_OK && contradicts(c, order, sign);
    if (*equal) { /* no point satisfies both the order and the signs of this case */
        qdot_free(condition);
        return status;
    }
    QDOT_TRY(status);
    insert_case_values(c, order, sign);
    for (int i = 0; i < 2; i++) {
        side[i] = qdot_subs(c->pool, c->side[i], c->n, c->node, c->to);
        for (size_t k = 0; k < c->n_signs && side[i] != QDOT_NIL; k++)
            if (sign[k] == 0)
                side[i] = insert_zero_of(c->pool, side[i], c->sign[k]);
    }
    if (qdot_pool_failed(c->pool)) { /* undefined in this case: a division by zero */
        status = qdot_pool_check(c->pool);
        *equal = divides_by_zero_of_case(c, status, sign);
        qdot_free(condition);
        return qdot_grave(status);
    }
    relation = condition + (facts == NULL ? 0 : facts->n_conditions) + SIGNS + LEAVES;
    collect_case_facts(c, order, sign, facts, &known, relation, condition);
    *equal = is_undefined_in_case(c, sign, facts);
    if (!c->too_much && !*equal)
        status = qdot_prove_equal(c->pool, side[0], side[1], &known, equal);
    if (status == QDOT_OK && !*equal && !c->too_much)
        status = qdot_prove_defined(c->pool, side[0], side[1], &known, equal, &empty);
    qdot_free(condition);
    return status;
}

/* The next permutation in lexicographic order; false after the last. */
static bool
next_order(size_t *order, size_t n)
{
    size_t i = n, k = n, keep;

    while (i > 1 && order[i - 2] >= order[i - 1])
        i--;
    if (i <= 1)
        return false;
    while (order[k - 1] <= order[i - 2])
        k--;
    keep = order[i - 2];
    order[i - 2] = order[k - 1];
    order[k - 1] = keep;
    for (k = n; i < k; i++, k--) {
        keep = order[i - 1];
        order[i - 1] = order[k - 1];
        order[k - 1] = keep;
    }
    return true;
}

static bool
next_sign_combination(const struct cases *c, int *sign)
{
    for (size_t i = 0; i < c->n_signs; i++) {
        if (sign[i] == 1) {
            sign[i] = -1;
            return true;
        }
        if (sign[i] == -1 && c->zero[i]) {
            sign[i] = 0;
            return true;
        }
        sign[i] = 1;
    }
    return false;
}

qdot_status
qdot_prove_cases(qdot_pool *pool, qdot_expr left, qdot_expr right,
                 const qdot_facts *facts, bool *equal)
{
    struct cases c = {.pool = pool};
    size_t order[LEAVES];
    int sign[SIGNS];

    *equal = false;
    c.side[0] = qdot_within_values(pool, left);
    c.side[1] = qdot_within_values(pool, right);
    for (int i = 0; i < 2; i++)
        c.side[i] = qdot_walk_map(pool, c.side[i], split_signs_of_products, NULL);
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(gather_cases(&c));
    if (c.too_much)
        return QDOT_OK;
    if (c.n == 0)
        return c.side[0] == left && c.side[1] == right
                   ? QDOT_OK
                   : qdot_prove_equal(pool, c.side[0], c.side[1], facts, equal);
    for (size_t i = 0; i < c.n_leaves; i++)
        order[i] = i;
    do {
        for (size_t i = 0; i < c.n_signs; i++)
            sign[i] = 1;
        do
            QDOT_TRY(prove_case(&c, order, sign, facts, equal));
        while (*equal && next_sign_combination(&c, sign));
    } while (*equal && next_order(order, c.n_leaves));
    return QDOT_OK;
}
