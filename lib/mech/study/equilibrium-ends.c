/* equilibrium-ends.c -- places that exist at the end of their condition too.
 *
 * Places are searched for generic parameters: x = sqrt(a) exists when a > 0. Where the condition's two sides are equal,
 * a = 0, the values are put in: if they are proved to solve the equations at rest there, inside the declared domains, and
 * no other place is the same one, the condition becomes a >= 0. What is judged of its stability stays what holds for
 * a > 0. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/study/equilibrium-search.h"
#include "normal/prove/decide.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/conditions.h"
#include "normal/solve/solve.h"

/* A condition with more operations or factors than this is not examined. */
enum { LONGEST = 40, MOST_FACTORS = 4 };

/* The equilibrium r->found.at[place] at p = value, where both sides of one of its conditions are equal. */
typedef struct {
    qdot_rest *r;
    size_t place;
    qdot_expr p, value;
    qdot_expr others; /* the other conditions of this equilibrium, with p = value */
    qdot_facts facts; /* facts of the search and `others`; p has a special value */
    qdot_expr room[QDOT_CONDITIONS_MOST];
} end;

/* Whether the last expression has no value (a division by zero): the caller then answers no. A failure of another
 * kind stays in the pool. */
static bool
is_undefined(qdot_pool *pool)
{
    const qdot_status status = qdot_pool_check(pool);

    if (status != QDOT_OK && status != QDOT_EDOMAIN)
        (void)qdot_pool_fail(pool);
    return status != QDOT_OK;
}

static qdot_expr
value_at_end(const end *e, qdot_expr what)
{
    return qdot_subs(e->r->pool, what, 1, &e->p, &e->value);
}

/* Whether every expression of a LIST is proved to be 0 and to have a value. */
static bool
are_proved_zero(const end *e, qdot_expr list)
{
    qdot_pool *pool = e->r->pool;
    bool all = qdot_conditions_at(pool, qdot_conditions_of_domain(pool, list, QDOT_NIL), 0, NULL, NULL,
                                  &e->facts) == QDOT_NIL;

    all = !is_undefined(pool) && all;
    for (uint32_t i = 0; i < qdot_expr_count(pool, list) && all; i++)
        all = qdot_is_zero(pool, qdot_expr_arg(pool, list, i), &e->facts);
    return all;
}

/* Whether all subexpressions of a LIST are defined at these values, also those like a*log(x) at a = 0. */
static bool
list_is_defined(const end *e, qdot_expr list, qdot_expr values)
{
    qdot_pool *pool = e->r->pool;
    qdot_expr set = qdot_conditions_all(pool, qdot_conditions_of_domain(pool, list, QDOT_NIL),
                                        qdot_conditions_of_divisors(pool, list, QDOT_NIL));
    bool all = set != QDOT_FALSE;

    if (all && set != QDOT_NIL) {
        set = qdot_simultaneous_put(pool, value_at_end(e, set), values);
        all = qdot_conditions_at(pool, set, 0, NULL, NULL, &e->facts) == QDOT_NIL;
    }
    return !is_undefined(pool) && all;
}

/* Whether the values lie in the declared domains. */
static bool
lie_in_domains(const end *e, qdot_expr values)
{
    qdot_pool *pool = e->r->pool;
    bool inside = true;

    for (uint32_t i = 0; i < qdot_expr_count(pool, values) && inside; i++) {
        qdot_expr one = qdot_expr_arg(pool, values, i), v = qdot_expr_arg(pool, one, 1);
        const qdot_symbol *u = qdot_expr_symbol(pool, qdot_expr_arg(pool, one, 0));
        qdot_expr lo = u->lo == QDOT_NIL ? QDOT_NIL : value_at_end(e, u->lo),
                  hi = u->hi == QDOT_NIL ? QDOT_NIL : value_at_end(e, u->hi);
        bool lo_open = u->lo_open, hi_open = u->hi_open;

        if (lo != QDOT_NIL)
            inside = qdot_condition(pool, qdot_sub(pool, v, lo), lo_open, &e->facts) == QDOT_TRUE;
        if (inside && hi != QDOT_NIL)
            inside = qdot_condition(pool, qdot_sub(pool, hi, v), hi_open, &e->facts) == QDOT_TRUE;
    }
    return inside;
}

/* Whether the j-th equilibrium has these values; `always`: and is proved to exist. */
static bool
has_equilibrium_values(const end *e, size_t j, qdot_expr values, bool always)
{
    const qdot_rest *r = e->r;
    const qdot_simultaneous_solution one = {values, e->others};
    qdot_simultaneous_solution all = {.conditions = QDOT_NIL};
    qdot_expr exists;

    if (j == e->place || r->found.at[j].numeric || r->found.at[j].range != QDOT_NIL)
        return false;
    all.values = value_at_end(e, r->found.at[j].equations);
    if (is_undefined(r->pool) || !qdot_simultaneous_lies_in(&r->system, &one, &all))
        return false;
    exists = qdot_conditions_at(r->pool, r->found.at[j].exists, 1, &e->p, &e->value, &e->facts);
    return !is_undefined(r->pool) && (always ? exists == QDOT_NIL : exists != QDOT_FALSE);
}

/* Whether another equilibrium that is proved to exist has these values. */
static bool
is_listed_elsewhere(const end *e, qdot_expr values)
{
    bool listed = false;

    for (size_t j = 0; j < e->r->found.n && !listed; j++)
        listed = has_equilibrium_values(e, j, values, true);
    return listed;
}

typedef enum {
    IS_NONE,   /* not proved to be an equilibrium */
    IS_LISTED, /* already listed at another place, or excluded by the other conditions */
    IS_NEW     /* an equilibrium that is not in the list */
} verdict;

/* The verdict on the k-th place, which exists where `exists` holds, at p = root->value, where both sides of the i-th
 * relation of that are equal. */
static verdict
judge_end(qdot_rest *r, size_t k, qdot_expr exists, uint32_t i, qdot_expr p, const qdot_root *root)
{
    qdot_expr value = root->value;
    qdot_pool *pool = r->pool;
    const qdot_equilibrium *place = &r->found.at[k];
    end e = {.r = r, .place = k, .p = p, .value = value};
    qdot_facts exact = r->facts;
    qdot_expr values, there, others = root->condition;

    exact.exact = true;
    for (uint32_t n = 0; n < qdot_expr_count(pool, exists); n++)
        if (n != i)
            others = qdot_conditions_and(pool, others, qdot_expr_arg(pool, exists, n));
    e.others = qdot_conditions_at(pool, others, 1, &p, &value, &exact);
    if (is_undefined(pool) || e.others == QDOT_FALSE) /* the other conditions exclude p = value */
        return IS_LISTED;
    e.facts = qdot_facts_and(pool, &exact, e.others, e.room);
    values = value_at_end(&e, place->equations);
    if (is_undefined(pool) || !lie_in_domains(&e, values))
        return IS_NONE;
    there = qdot_list_appended(pool, value_at_end(&e, r->system.equations), 0, NULL);
    there = qdot_solve_without_turns(pool, qdot_simultaneous_put(pool, there, values));
    if (is_undefined(pool))
        return IS_NONE;
    if (!are_proved_zero(&e, there)) { /* not at rest: at a kink the equations have another value than beside it */
        qdot_held held;

        if (qdot_rest_is_held(r, values, p, value, &e.facts, &held) != QDOT_OK)
            (void)qdot_pool_fail(pool);
        return held != QDOT_HELD ? IS_NONE : is_listed_elsewhere(&e, values) ? IS_LISTED : IS_NEW;
    }
    (void)qdot_simultaneous_put(pool, value_at_end(&e, r->system.defined), values);
    if (is_undefined(pool))
        return IS_NONE;
    there = qdot_list_appended(pool, r->system.equations, 1, &r->system.defined);
    if (!list_is_defined(&e, there, values))
        return IS_NONE;
    return is_listed_elsewhere(&e, values) ? IS_LISTED : IS_NEW;
}

/* The verdict where `factor`, one of those of right - left of the condition, is 0, by the first parameter of which
 * exactly one value makes it so; IS_NONE if there is no such parameter. */
static qdot_status
judge_factor(qdot_rest *r, size_t k, qdot_expr exists, uint32_t i, qdot_expr factor, verdict *out)
{
    qdot_pool *pool = r->pool;
    qdot_expr atoms = qdot_expr_atoms(pool, factor, false);

    *out = IS_NONE;
    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t n = 0; n < qdot_expr_count(pool, atoms) && *out == IS_NONE; n++) {
        qdot_expr p = qdot_expr_arg(pool, atoms, n), slope;
        qdot_solutions zero = {0};
        qdot_status status;
        bool known;

        if (!qdot_expr_is_class(pool, p, QDOT_PARAM))
            continue;
        slope = qdot_diff(pool, factor, p);
        /* the factor is monotone in p: at most one zero */
        if (slope == QDOT_NIL || (qdot_expr_node(pool, slope)->sign & QDOT_NE0) == 0)
            continue;
        status = qdot_solve(pool, factor, p, &r->facts, &zero);
        known = status == QDOT_OK && zero.complete && zero.root.n == 1 && zero.root.at[0].period == QDOT_NIL &&
                zero.root.at[0].value != p;
        if (known)
            *out = judge_end(r, k, exists, i, p, &zero.root.at[0]);
        qdot_solutions_clear(&zero);
        if (status != QDOT_EDOMAIN)
            QDOT_TRY(status);
        if (known)
            break;
    }
    return qdot_pool_check(pool);
}

/* Whether the k-th place exists wherever both sides of the i-th relation of `exists` are equal, and is listed nowhere
 * else at some of these values. *new: a LIST of the factors of right - left that are 0 at such values; nil: none. */
static qdot_status
exists_at_end(qdot_rest *r, size_t k, qdot_expr exists, uint32_t i, bool *yes, qdot_expr *new)
{
    qdot_pool *pool = r->pool;
    qdot_expr relation = qdot_expr_arg(pool, exists, i), gap, factors;
    verdict all = IS_LISTED;

    *yes = false;
    *new = QDOT_NIL;
    if (qdot_expr_kind(pool, relation) != QDOT_REL || qdot_expr_node(pool, relation)->op != QDOT_LT ||
        !qdot_is_generic(pool, relation) || qdot_expr_size(pool, relation) > LONGEST ||
        qdot_conditions_nonzero(pool, relation) != QDOT_NIL)
        return QDOT_OK;
    gap = qdot_simplify(pool, qdot_positive_of(pool, relation), &r->facts);
    QDOT_TRY(qdot_pool_check(pool));
    factors = qdot_solve_factors(pool, gap);
    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t n = 0; n < qdot_expr_count(pool, factors); n++) {
        qdot_expr factor = qdot_expr_arg(pool, factors, n);
        verdict one = IS_NONE;

        if (n < MOST_FACTORS)
            QDOT_TRY(judge_factor(r, k, exists, i, factor, &one));
        if (one == IS_NEW)
            *new = qdot_list_appended(pool, *new, 1, &factor);
        all = one == IS_LISTED || all == IS_NONE ? all : one;
    }
    *yes = all == IS_NEW;
    return qdot_pool_check(pool);
}

/* The list with relation i, a < b, replaced by a <= b. */
static qdot_expr
with_weakened_relation(qdot_pool *pool, qdot_expr list, uint32_t i)
{
    qdot_expr all = QDOT_NIL;

    for (uint32_t n = 0; n < qdot_expr_count(pool, list); n++) {
        qdot_expr one = qdot_expr_arg(pool, list, n);

        all = qdot_conditions_and(pool, all,
                                  n == i ? qdot_rel(pool, QDOT_LE, qdot_expr_arg(pool, one, 0),
                                                    qdot_expr_arg(pool, one, 1))
                                         : one);
    }
    return all;
}

/* Append those members of `more` that are not in the LIST. */
static void
append_new_members(qdot_pool *pool, qdot_expr *list, qdot_expr more)
{
    for (uint32_t i = 0; more != QDOT_NIL && i < qdot_expr_count(pool, more); i++) {
        qdot_expr one = qdot_expr_arg(pool, more, i);
        bool has = false;

        for (uint32_t k = 0; *list != QDOT_NIL && k < qdot_expr_count(pool, *list) && !has; k++)
            has = qdot_expr_arg(pool, *list, k) == one;
        if (!has)
            *list = qdot_list_appended(pool, *list, 1, &one);
    }
}

/* Weaken the relations of the k-th place, *exists, one by one, the others as they are by then: where both sides of two
 * are equal at once, it may exist by neither alone. What is 0 where a relation that stays strict is too much to ask is
 * added to the LIST *special. */
static qdot_status
weaken_existence_conditions(qdot_rest *r, size_t k, qdot_expr *exists, qdot_expr *special)
{
    qdot_pool *pool = r->pool;
    qdot_equilibrium *e = &r->found.at[k];
    const uint32_t n = qdot_expr_count(pool, e->exists);

    for (uint32_t i = 0; i < n && qdot_expr_count(pool, *exists) == n; i++) {
        qdot_expr strict = qdot_expr_arg(pool, *exists, i), new;
        bool yes, alone = false;

        QDOT_TRY(exists_at_end(r, k, *exists, i, &yes, &new));
        if (!yes && new == QDOT_NIL && *exists != e->exists)
            QDOT_TRY(exists_at_end(r, k, e->exists, i, &alone, &new));
        if (!yes)
            append_new_members(pool, special, new);
        if (yes)
            *exists = with_weakened_relation(pool, *exists, i);
        if (yes && e->stability != QDOT_STABILITY_UNDECIDED)
            e->stable_when = qdot_conditions_and(pool, e->stable_when, strict);
        QDOT_TRY(qdot_pool_check(pool));
    }
    return QDOT_OK;
}

qdot_status
qdot_rest_ends(qdot_rest *r, qdot_expr *special)
{
    qdot_pool *pool = r->pool;
    qdot_expr *exists = qdot_malloc((r->found.n + 1) * sizeof *exists);
    qdot_status status = exists == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t k = 0; k < r->found.n && status == QDOT_OK; k++) {
        const qdot_equilibrium *e = &r->found.at[k];

        exists[k] = e->exists;
        if (!e->numeric && e->range == QDOT_NIL && e->exists != QDOT_NIL && qdot_solve_integers(pool, e->equations) == 0)
            status = weaken_existence_conditions(r, k, &exists[k], special);
    }
    for (size_t k = 0; k < r->found.n && status == QDOT_OK; k++)
        r->found.at[k].exists = exists[k];
    qdot_free(exists);
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

/* Whether it is known that the point at which kinks meet, where `gap` = 0, is listed if it is an equilibrium; if it is
 * proved to be none, the places that are this point exist where gap != 0 alone. */
static qdot_status
settle_coinciding_kinks(qdot_rest *r, qdot_expr gap, qdot_expr at, bool *known)
{
    qdot_pool *pool = r->pool;
    qdot_expr atoms = qdot_expr_atoms(pool, gap, false);
    end e = {.r = r, .place = SIZE_MAX, .p = QDOT_NIL, .others = QDOT_NIL, .facts = r->facts};
    qdot_solutions zero = {0};
    qdot_status status = qdot_pool_check(pool);

    *known = false;
    for (uint32_t i = 0; status == QDOT_OK && i < qdot_expr_count(pool, atoms) && e.p == QDOT_NIL; i++)
        if (qdot_expr_is_class(pool, qdot_expr_arg(pool, atoms, i), QDOT_PARAM))
            e.p = qdot_expr_arg(pool, atoms, i);
    if (status != QDOT_OK || e.p == QDOT_NIL)
        return status;
    e.facts.exact = true;
    status = qdot_solve(pool, gap, e.p, &r->facts, &zero);
    if (status == QDOT_OK && zero.complete && zero.root.n == 1 && zero.root.at[0].period == QDOT_NIL) {
        qdot_expr equation, values;
        qdot_held held = QDOT_HELD_UNKNOWN;

        e.value = zero.root.at[0].value;
        equation = qdot_rel(pool, QDOT_EQ, r->s->coordinates.at[0], value_at_end(&e, at));
        values = qdot_list(pool, 1, &equation);
        if (!is_undefined(pool))
            status = qdot_rest_is_held(r, values, e.p, e.value, &e.facts, &held);
        *known = held != QDOT_NOT_HELD && is_listed_elsewhere(&e, values);
        for (size_t j = 0; j < r->found.n && status == QDOT_OK && held == QDOT_NOT_HELD; j++)
            if (has_equilibrium_values(&e, j, values, false))
                r->found.at[j].exists = qdot_conditions_and(
                    pool, r->found.at[j].exists,
                    qdot_condition(pool, qdot_fun1(pool, QDOT_ABS, gap), true, &e.facts));
    }
    qdot_solutions_clear(&zero);
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}

qdot_status
qdot_rest_meetings(qdot_rest *r, qdot_expr *left)
{
    qdot_pool *pool = r->pool;

    *left = QDOT_NIL;
    for (uint32_t i = 0; r->meeting != QDOT_NIL && i < qdot_expr_count(pool, r->meeting); i++) {
        qdot_expr one = qdot_expr_arg(pool, r->meeting, i), gap = qdot_expr_arg(pool, one, 0);
        bool known;

        QDOT_TRY(settle_coinciding_kinks(r, gap, qdot_expr_arg(pool, one, 1), &known));
        if (!known)
            append_new_members(pool, left, qdot_list(pool, 1, &gap));
    }
    return qdot_pool_check(pool);
}
