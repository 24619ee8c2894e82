/* conditions.c -- sets of relations under which a solution exists. */
#include "normal/solve/conditions.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/inequality/constant-bounds.h"
#include "normal/inequality/contradiction.h"
#include "normal/inequality/less.h"
#include "normal/refute/constant.h"
#include "normal/simplify/positive.h"
#include "normal/solve/condition-forms.h"

/* The relations of a set are compared with each other if there are at most MOST_COMPARED of them, of at most
 * LARGEST_COMPARED operations each. */
enum { MOST_COMPARED = 6, LARGEST_COMPARED = 24 };

/* --- single relations ----------------------------------------------------------------- */

/* The strict relation 0 < rest with <= instead of <. */
static qdot_expr
weaken_relation(qdot_pool *pool, qdot_expr strict)
{
    return qdot_expr_kind(pool, strict) == QDOT_REL
               ? qdot_rel(pool, QDOT_LE, qdot_expr_arg(pool, strict, 0),
                          qdot_expr_arg(pool, strict, 1))
               : strict;
}

static bool
is_proved(qdot_pool *pool, qdot_expr left, qdot_expr right, bool strict, const qdot_facts *facts)
{
    qdot_decision d;

    if (qdot_decide_less(pool, left, right, strict, facts, &d) != QDOT_OK) {
        (void)qdot_pool_fail(pool);
        return false;
    }
    return d.verdict == QDOT_PROVED;
}

bool
qdot_is_generic(const qdot_pool *pool, qdot_expr e)
{
    const uint32_t generic =
        QDOT_HAS_PARAM | QDOT_HAS_MOMENTUM | QDOT_HAS_FUN | QDOT_HAS_UFUN;

    return (qdot_expr_node(pool, e)->holds & ~generic) == 0;
}

/* Move a number to the left side of a relation: -1 < x for 0 < x + 1. */
static qdot_expr
move_number_to_left(qdot_pool *pool, qdot_expr relation)
{
    qdot_expr right, c;

    if (qdot_expr_kind(pool, relation) != QDOT_REL ||
        qdot_expr_arg(pool, relation, 0) != QDOT_ZERO)
        return relation;
    right = qdot_expr_arg(pool, relation, 1);
    c = qdot_expr_kind(pool, right) == QDOT_SUM ? qdot_expr_arg(pool, right, 0) : QDOT_ZERO;
    if (c == QDOT_ZERO)
        return relation;
    return qdot_rel(pool, QDOT_LT, qdot_neg(pool, c), qdot_sub(pool, right, c));
}

bool
qdot_is_taken_generic(qdot_pool *pool, qdot_expr e, const qdot_facts *facts)
{
    return (facts == NULL || !facts->exact) && qdot_is_generic(pool, e) && !qdot_vanishes_in_regions(pool, e);
}

/* The expression u if the condition gap > 0 is 0 < |u|, which means u != 0; else nil. */
static qdot_expr
argument_of_absolute_value(const qdot_pool *pool, qdot_expr gap)
{
    return qdot_expr_is_function(pool, gap, QDOT_ABS)
               ? qdot_expr_arg(pool, gap, 0)
               : QDOT_NIL;
}

/* A gap with a power beside a constant by one without the power; nil if it has no such form, or what is raised to the power
 * is not known to be defined. */
static qdot_expr
gap_without_power(qdot_pool *pool, qdot_expr gap, const qdot_facts *facts)
{
    qdot_expr base, plain = qdot_condition_of_power(pool, gap, &base);

    return plain == QDOT_NIL || base == QDOT_NIL || is_proved(pool, QDOT_ZERO, base, false, facts) ? plain : QDOT_NIL;
}

/* Write 0 < gap or 0 <= gap in its shortest form. Expressions with coordinates are not factored. */
static qdot_expr
shorten_condition(qdot_pool *pool, qdot_expr gap, bool strict, const qdot_facts *facts)
{
    qdot_expr u = argument_of_absolute_value(pool, gap), shortest, unfolded, again;
    bool generic = qdot_is_taken_generic(pool, gap, facts);

    if (strict && u != QDOT_NIL && !generic)
        return qdot_is_generic(pool, u) ? qdot_nonzero(pool, qdot_argument_at_zero(pool, u), facts)
                                        : qdot_rel(pool, QDOT_LT, QDOT_ZERO, gap);
    /* do not drop a factor that may vanish for some values */
    shortest = generic                      ? qdot_positive(pool, gap, facts, 0, NULL)
               : qdot_is_generic(pool, gap) ? qdot_positive_exact(pool, gap, facts)
                                            : move_number_to_left(pool, qdot_positive_without_minus(pool, gap));
    if (shortest == QDOT_NIL)
        return QDOT_NIL;
    shortest = strict ? shortest : weaken_relation(pool, shortest);
    unfolded = qdot_condition_unfolded(pool, shortest);
    if (unfolded == shortest || unfolded == QDOT_NIL || qdot_expr_kind(pool, unfolded) != QDOT_REL)
        return unfolded;
    gap = qdot_positive_of(pool, unfolded);
    again = qdot_condition(pool, gap, qdot_expr_node(pool, unfolded)->op == QDOT_LT, facts);
    return again == QDOT_NIL || qdot_expr_kind(pool, again) != QDOT_REL || gap_without_power(pool, gap, facts) != QDOT_NIL
               ? again
               : unfolded; /* b < tan(4) rather than b cos(4) > sin(4) */
}

static qdot_expr
decide_condition(qdot_pool *pool, qdot_expr gap, bool strict, const qdot_facts *facts)
{
    bool generic, above;
    qdot_expr squares;
    uint8_t sign;

    if (gap == QDOT_NIL)
        return QDOT_NIL;
    sign = qdot_expr_node(pool, gap)->sign;
    if (strict ? (sign & QDOT_POS) == QDOT_POS : (sign & QDOT_GE0) != 0)
        return QDOT_TRUE;
    if (strict ? (sign & QDOT_LE0) != 0 : (sign & QDOT_NEG) == QDOT_NEG)
        return QDOT_FALSE;
    if (qdot_expr_is_constant(pool, gap)) {
        qdot_constant_sign known;

        if (qdot_constant_decide(pool, gap, &known) != QDOT_OK)
            return qdot_pool_fail(pool);
        if (known != QDOT_CONSTANT_UNKNOWN)
            return known == QDOT_CONSTANT_POSITIVE || (known == QDOT_CONSTANT_ZERO && !strict)
                       ? QDOT_TRUE
                       : QDOT_FALSE;
        if (qdot_is_zero(pool, gap, facts))
            return strict ? QDOT_FALSE : QDOT_TRUE;
    }
    generic = qdot_is_taken_generic(pool, gap, facts);
    if (is_proved(pool, QDOT_ZERO, gap, strict && !generic, facts))
        return QDOT_TRUE;
    /* generic parameters do not take the limiting value */
    if (is_proved(pool, gap, QDOT_ZERO, !strict && !(generic && !qdot_holds_root(pool, gap)), facts) ||
        qdot_pool_failed(pool))
        return qdot_pool_failed(pool) ? QDOT_NIL : QDOT_FALSE;
    squares = qdot_condition_beside_root(pool, gap, &above);
    if (squares != QDOT_NIL && is_proved(pool, QDOT_ZERO, squares, false, facts))
        return above ? QDOT_TRUE : QDOT_FALSE;
    return shorten_condition(pool, gap, strict, facts);
}

/* s > t, of a gap s - t with square roots, as the condition s^2 > t^2. Nil: the gap has another form, or s^2 > t^2 is not
 * known to imply that s and t are defined. */
static qdot_expr
condition_from_squares(qdot_pool *pool, qdot_expr gap, bool strict, const qdot_facts *facts)
{
    qdot_expr squared = qdot_condition_squared(pool, gap), relation, domain;

    if (squared == QDOT_NIL)
        return QDOT_NIL;
    relation = decide_condition(pool, squared, strict, facts);
    if (relation == QDOT_NIL || relation == QDOT_FALSE)
        return relation;
    domain = qdot_conditions_of_domain(pool, gap, QDOT_NIL);
    for (uint32_t i = 0; domain != QDOT_NIL && i < qdot_expr_count(pool, domain); i++) {
        qdot_expr one = qdot_expr_arg(pool, domain, i);

        if (!is_proved(pool, qdot_expr_arg(pool, one, 0), qdot_expr_arg(pool, one, 1),
                       qdot_expr_node(pool, one)->op == QDOT_LT, facts))
            return QDOT_NIL;
    }
    return relation;
}

qdot_expr
qdot_condition(qdot_pool *pool, qdot_expr gap, bool strict, const qdot_facts *facts)
{
    qdot_expr plain = gap_without_power(pool, gap, facts), relation, by_squares;

    if (plain == QDOT_NIL)
        plain = qdot_condition_of_logarithms(pool, gap);
    if (plain == QDOT_NIL)
        plain = qdot_condition_without_magnitude(pool, gap, strict);
    relation = decide_condition(pool, plain == QDOT_NIL ? gap : plain, strict, facts);
    if (relation == QDOT_NIL || qdot_expr_kind(pool, relation) != QDOT_REL)
        return relation;
    by_squares = condition_from_squares(pool, qdot_positive_of(pool, relation),
                                        qdot_expr_node(pool, relation)->op == QDOT_LT, facts);
    return qdot_pool_failed(pool) ? QDOT_NIL : by_squares == QDOT_NIL ? relation : by_squares;
}

/* --- sets of relations ---------------------------------------------------------------- */

qdot_expr
qdot_conditions_and(qdot_pool *pool, qdot_expr set, qdot_expr relation)
{
    uint32_t n = set == QDOT_NIL ? 0 : qdot_expr_count(pool, set);
    qdot_expr *all, result;

    if (set == QDOT_FALSE || relation == QDOT_FALSE)
        return QDOT_FALSE;
    if (relation == QDOT_TRUE || relation == QDOT_NIL)
        return set;
    all = qdot_malloc((n + 1) * sizeof *all);
    if (all == NULL)
        return qdot_pool_fail(pool);
    for (uint32_t i = 0; i < n; i++) {
        all[i] = qdot_expr_arg(pool, set, i);
        if (all[i] == relation) {
            qdot_free(all);
            return set;
        }
    }
    all[n] = relation;
    result = qdot_list(pool, n + 1, all);
    qdot_free(all);
    return result;
}

qdot_expr
qdot_conditions_all(qdot_pool *pool, qdot_expr set, qdot_expr other)
{
    if (other == QDOT_FALSE)
        return QDOT_FALSE;
    for (uint32_t i = 0; other != QDOT_NIL && i < qdot_expr_count(pool, other); i++)
        set = qdot_conditions_and(pool, set, qdot_expr_arg(pool, other, i));
    return set;
}

qdot_expr
qdot_conditions_and_nonzero(qdot_pool *pool, qdot_expr set, qdot_expr u)
{
    return qdot_conditions_and(pool, set,
                               qdot_rel(pool, QDOT_LT, QDOT_ZERO, qdot_fun1(pool, QDOT_ABS, u)));
}

/* The set of conditions with relation i replaced by `to`, or removed if `to` is TRUE. */
static qdot_expr
replace_condition(qdot_pool *pool, qdot_expr set, uint32_t i, qdot_expr to)
{
    qdot_expr all = QDOT_NIL;

    for (uint32_t k = 0; k < qdot_expr_count(pool, set); k++)
        all = qdot_conditions_and(pool, all, k == i ? to : qdot_expr_arg(pool, set, k));
    return all;
}

/* Whether all relations of `set` follow from those of `from`. */
static bool
set_follows(qdot_pool *pool, qdot_expr from, qdot_expr set, const qdot_facts *facts)
{
    qdot_expr room[QDOT_CONDITIONS_MOST];
    const qdot_facts known = qdot_facts_and(pool, facts, from, room);
    bool all = true;

    for (uint32_t i = 0; i < qdot_expr_count(pool, set) && all; i++) {
        qdot_expr one = qdot_expr_arg(pool, set, i);

        all = qdot_conditions_and(pool, from, one) == from ||
              (qdot_expr_kind(pool, one) == QDOT_REL && qdot_expr_node(pool, one)->op != QDOT_EQ &&
               is_proved(pool, qdot_expr_arg(pool, one, 0), qdot_expr_arg(pool, one, 1),
                         qdot_expr_node(pool, one)->op == QDOT_LT, &known));
    }
    return all;
}

/* The only relation of `set` that is not in the set `other`; nil if there are none or several. */
static qdot_expr
only_other_relation(qdot_pool *pool, qdot_expr set, qdot_expr other)
{
    qdot_expr only = QDOT_NIL;
    unsigned count = 0;

    for (uint32_t i = 0; i < qdot_expr_count(pool, set); i++)
        if (qdot_conditions_and(pool, other, qdot_expr_arg(pool, set, i)) != other) {
            only = qdot_expr_arg(pool, set, i);
            count++;
        }
    return count == 1 ? only : QDOT_NIL;
}

/* If the sets differ in one relation, u > 0 (or u >= 0) and its opposite: replace it in *set by u
 * != 0, or remove it. */
static bool
join_opposite_relations(qdot_pool *pool, qdot_expr *set, qdot_expr other, const qdot_facts *facts)
{
    qdot_expr a = only_other_relation(pool, *set, other), b = only_other_relation(pool, other, *set), sum, left = QDOT_NIL;

    if (a == QDOT_NIL || b == QDOT_NIL || qdot_expr_kind(pool, a) != QDOT_REL || qdot_expr_kind(pool, b) != QDOT_REL)
        return false;
    sum = qdot_add(pool, qdot_positive_of(pool, a), qdot_positive_of(pool, b));
    if (sum != QDOT_ZERO) /* the relations are not a pair a >= 0 and a <= 0 */
        return false;
    for (uint32_t i = 0; i < qdot_expr_count(pool, *set); i++)
        if (qdot_expr_arg(pool, *set, i) != a)
            left = qdot_conditions_and(pool, left, qdot_expr_arg(pool, *set, i));
    if (qdot_expr_node(pool, a)->op == QDOT_LT && qdot_expr_node(pool, b)->op == QDOT_LT &&
        !qdot_is_taken_generic(pool, a, facts))
        left = qdot_conditions_and_nonzero(pool, left, qdot_positive_of(pool, a));
    *set = left;
    return true;
}

/* The set without its i-th relation, where all of that follows from `other`, and `other` from it and the opposite of that
 * relation: that is what either set says. *set gets it. */
static bool
join_with_complement(qdot_pool *pool, qdot_expr *set, qdot_expr one, qdot_expr other, const qdot_facts *facts)
{
    for (uint32_t i = 0; i < qdot_expr_count(pool, one); i++) {
        qdot_expr relation = qdot_expr_arg(pool, one, i), rest = replace_condition(pool, one, i, QDOT_TRUE), opposite;
        bool strict;

        if (qdot_expr_kind(pool, relation) != QDOT_REL || qdot_expr_node(pool, relation)->op == QDOT_EQ)
            continue;
        strict = qdot_expr_node(pool, relation)->op == QDOT_LT;
        opposite = qdot_rel(pool, strict ? QDOT_LE : QDOT_LT, qdot_expr_arg(pool, relation, 1),
                            qdot_expr_arg(pool, relation, 0));
        if ((rest == QDOT_NIL || set_follows(pool, other, rest, facts)) &&
            set_follows(pool, qdot_conditions_and(pool, rest, opposite), other, facts)) {
            *set = rest;
            return true;
        }
    }
    return false;
}

bool
qdot_conditions_join(qdot_pool *pool, qdot_expr *set, qdot_expr other, const qdot_facts *facts)
{
    if (*set == other || *set == QDOT_NIL)
        return true;
    if (other == QDOT_NIL) {
        *set = QDOT_NIL;
        return true;
    }
    if (join_opposite_relations(pool, set, other, facts) || set_follows(pool, other, *set, facts) ||
        join_with_complement(pool, set, *set, other, facts) || join_with_complement(pool, set, other, *set, facts))
        return true;
    if (!set_follows(pool, *set, other, facts))
        return false;
    *set = other;
    return true;
}

qdot_expr
qdot_conditions_generic(qdot_pool *pool, qdot_expr set)
{
    uint32_t n = set == QDOT_NIL || set == QDOT_FALSE ? 0 : qdot_expr_count(pool, set);
    qdot_expr all = n == 0 ? set : QDOT_NIL;

    for (uint32_t i = 0; i < n; i++) {
        qdot_expr one = qdot_expr_arg(pool, set, i);

        if (qdot_expr_kind(pool, one) == QDOT_REL && qdot_expr_node(pool, one)->op == QDOT_LE &&
            /* except for an if(...), of which only a part may be 0 */
            !qdot_expr_is_function(pool, qdot_positive_of(pool, one), QDOT_IF) &&
            qdot_is_taken_generic(pool, qdot_positive_of(pool, one), NULL))
            one = qdot_rel(pool, QDOT_LT, qdot_expr_arg(pool, one, 0),
                           qdot_expr_arg(pool, one, 1));
        all = qdot_conditions_and(pool, all, one);
    }
    return all;
}

qdot_facts
qdot_facts_and(const qdot_pool *pool, const qdot_facts *facts, qdot_expr set, qdot_expr *room)
{
    qdot_facts all = facts == NULL ? (qdot_facts){0} : *facts;
    uint32_t more = set == QDOT_NIL || set == QDOT_FALSE ? 0 : qdot_expr_count(pool, set);
    size_t n = 0;

    for (size_t i = 0; i < all.n_conditions && n < QDOT_CONDITIONS_MOST; i++)
        room[n++] = all.conditions[i];
    for (uint32_t i = 0; i < more && n < QDOT_CONDITIONS_MOST; i++)
        room[n++] = qdot_expr_arg(pool, set, i);
    all.n_conditions = n;
    all.conditions = room;
    return all;
}

/* A relation with values inserted, decided by the facts if possible. */
static qdot_expr
relation_at(qdot_pool *pool, qdot_expr relation, size_t n, const qdot_expr *from,
            const qdot_expr *to, const qdot_facts *facts)
{
    qdot_expr there = qdot_subs(pool, relation, n, from, to);

    if (there == QDOT_NIL)
        return qdot_pool_check(pool) == QDOT_EDOMAIN ? QDOT_FALSE : qdot_pool_fail(pool);
    if (qdot_expr_kind(pool, there) != QDOT_REL)
        return there;
    return qdot_condition(pool,
                          qdot_sub(pool, qdot_expr_arg(pool, there, 1),
                                   qdot_expr_arg(pool, there, 0)),
                          qdot_expr_node(pool, there)->op == QDOT_LT, facts);
}

/* Add a relation to the set by factors; 0 < |u v| becomes u != 0 and v != 0, 0 < u^2 v becomes u != 0 and 0 < v. */
static qdot_expr
add_relation_by_factors(qdot_pool *pool, qdot_expr set, qdot_expr relation)
{
    qdot_expr u = relation == QDOT_NIL ? QDOT_NIL : qdot_conditions_nonzero(pool, relation), rest = QDOT_NIL;
    bool nonzero = u != QDOT_NIL;

    if (!nonzero && relation != QDOT_NIL && qdot_expr_kind(pool, relation) == QDOT_REL &&
        qdot_expr_node(pool, relation)->op == QDOT_LT && qdot_expr_arg(pool, relation, 0) == QDOT_ZERO)
        u = qdot_expr_arg(pool, relation, 1);
    if (u == QDOT_NIL || qdot_expr_kind(pool, u) != QDOT_PROD)
        return qdot_conditions_and(pool, set, relation);
    rest = qdot_expr_arg(pool, u, 0);
    for (uint32_t i = 1; i < qdot_expr_count(pool, u); i += 2) {
        qdot_expr base = qdot_expr_arg(pool, u, i), exponent = qdot_expr_arg(pool, u, i + 1);
        const fmpq *q = qdot_expr_rational(pool, exponent);

        if (q != NULL && fmpq_sgn(q) > 0 && (nonzero || (fmpz_is_even(fmpq_numref(q)) && fmpz_is_one(fmpq_denref(q)))))
            set = qdot_conditions_and_nonzero(pool, set, base);
        else
            rest = qdot_mul(pool, rest, qdot_pow(pool, base, exponent));
    }
    if (nonzero)
        return qdot_expr_rational(pool, rest) != NULL ? set : qdot_conditions_and_nonzero(pool, set, rest);
    return qdot_conditions_and(pool, set, qdot_rel(pool, QDOT_LT, QDOT_ZERO, rest));
}

qdot_expr
qdot_conditions_at(qdot_pool *pool, qdot_expr set, size_t n, const qdot_expr *from,
                   const qdot_expr *to, const qdot_facts *facts)
{
    qdot_expr left = QDOT_NIL, room[QDOT_CONDITIONS_MOST];
    uint32_t m = set == QDOT_NIL || set == QDOT_FALSE ? 0 : qdot_expr_count(pool, set);

    if (set == QDOT_FALSE)
        return QDOT_FALSE;
    for (uint32_t i = 0; i < m && left != QDOT_FALSE; i++) {
        qdot_facts known = qdot_facts_and(pool, facts, left, room);

        left = add_relation_by_factors(
            pool, left,
            relation_at(pool, qdot_expr_arg(pool, set, i), n, from, to, &known));
        if (qdot_pool_failed(pool))
            return QDOT_NIL;
    }
    if (left != QDOT_NIL && left != QDOT_FALSE && qdot_expr_count(pool, left) > 1) {
        qdot_facts all = qdot_facts_and(pool, facts, left, room);
        bool found;

        if (qdot_contradiction(pool, &all, &found) != QDOT_OK)
            return qdot_pool_fail(pool);
        if (found)
            return QDOT_FALSE;
    }
    return left;
}

/* Whether a relation follows from the relations of a set other than number i. */
static bool
follows_from_others(qdot_pool *pool, qdot_expr set, uint32_t i, qdot_expr relation, bool with_itself,
                    const qdot_facts *facts)
{
    qdot_expr others = QDOT_NIL, room[QDOT_CONDITIONS_MOST];
    qdot_facts known;

    for (uint32_t k = 0; k < qdot_expr_count(pool, set); k++)
        if (k != i || with_itself)
            others = qdot_conditions_and(pool, others, qdot_expr_arg(pool, set, k));
    known = qdot_facts_and(pool, facts, others, room);
    return is_proved(pool, qdot_expr_arg(pool, relation, 0), qdot_expr_arg(pool, relation, 1),
                     qdot_expr_node(pool, relation)->op == QDOT_LT, &known);
}

/* Whether the set has few and small enough relations to compare them with each other. */
static bool
is_small(const qdot_pool *pool, qdot_expr set)
{
    uint32_t n = set == QDOT_NIL || set == QDOT_FALSE ? 0 : qdot_expr_count(pool, set);
    bool small = n > 1 && n <= MOST_COMPARED;

    for (uint32_t i = 0; i < n && small; i++)
        small = qdot_expr_size(pool, qdot_expr_arg(pool, set, i)) <= LARGEST_COMPARED;
    return small;
}

/* Whether all relations of the set `some` are in the set `set`. */
static bool
contains_all(qdot_pool *pool, qdot_expr set, qdot_expr some)
{
    bool all = some != QDOT_NIL && some != QDOT_FALSE;

    for (uint32_t i = 0; all && i < qdot_expr_count(pool, some); i++)
        all = qdot_conditions_and(pool, set, qdot_expr_arg(pool, some, i)) == set;
    return all;
}

/* a < b for a <= b; QDOT_FALSE if b - a is seen never to be positive. */
static qdot_expr
strict_relation(qdot_pool *pool, qdot_expr relation)
{
    return (qdot_expr_sign(pool, qdot_positive_of(pool, relation)) & QDOT_LE0) != 0
               ? QDOT_FALSE
               : qdot_rel(pool, QDOT_LT, qdot_expr_arg(pool, relation, 0), qdot_expr_arg(pool, relation, 1));
}

/* Replace 0 <= g together with u != 0 for all factors u of g by 0 < g. */
static qdot_expr
join_with_nonzero(qdot_pool *pool, qdot_expr set, const qdot_facts *facts)
{
    for (uint32_t i = 0; set != QDOT_NIL && set != QDOT_FALSE && i < qdot_expr_count(pool, set); i++) {
        qdot_expr one = qdot_expr_arg(pool, set, i), factors, rest = QDOT_NIL;

        if (qdot_expr_kind(pool, one) != QDOT_REL || qdot_expr_node(pool, one)->op != QDOT_LE)
            continue;
        factors = add_relation_by_factors(
            pool, QDOT_NIL, qdot_nonzero(pool, qdot_positive_of(pool, one), facts));
        if (!contains_all(pool, set, factors))
            continue;
        for (uint32_t k = 0; k < qdot_expr_count(pool, set); k++) {
            qdot_expr other = qdot_expr_arg(pool, set, k);

            if (k == i)
                other = strict_relation(pool, one);
            else if (qdot_conditions_and(pool, factors, other) == factors)
                continue;
            rest = qdot_conditions_and(pool, rest, other);
        }
        set = rest;
        i = UINT32_MAX; /* the set has changed: start again */
    }
    return set;
}

/* Whether relation i follows from the others, and so do the conditions `domain` under which its
 * sides are defined. */
static bool
is_implied(qdot_pool *pool, qdot_expr set, uint32_t i, qdot_expr domain, const qdot_facts *facts)
{
    bool yes = follows_from_others(pool, set, i, qdot_expr_arg(pool, set, i), false, facts);

    for (uint32_t k = 0; yes && domain != QDOT_NIL && k < qdot_expr_count(pool, domain); k++)
        yes = follows_from_others(pool, set, i, qdot_expr_arg(pool, domain, k), false, facts);
    return yes;
}

/* The set without relations that follow from the others; partial_alone: only those are left out whose sides are not
 * defined everywhere. */
static qdot_expr
remove_implied_conditions(qdot_pool *pool, qdot_expr set, bool partial_alone, const qdot_facts *facts)
{
    for (uint32_t i = 0; set != QDOT_NIL && set != QDOT_FALSE && qdot_expr_count(pool, set) > 1 &&
                         i < qdot_expr_count(pool, set);) {
        qdot_expr one = qdot_expr_arg(pool, set, i), domain = qdot_conditions_of_domain(pool, one, QDOT_NIL);

        if (qdot_expr_kind(pool, one) == QDOT_REL && qdot_expr_node(pool, one)->op != QDOT_EQ &&
            (domain != QDOT_NIL || !partial_alone) && is_implied(pool, set, i, domain, facts))
            set = replace_condition(pool, set, i, QDOT_TRUE);
        else
            i++;
    }
    return set;
}

qdot_expr
qdot_conditions_reduce(qdot_pool *pool, qdot_expr set, const qdot_facts *facts)
{
    if (!is_small(pool, set))
        return set;
    set = join_with_nonzero(pool, set, facts);
    /* where a <= b and a != b follows from the others, write a < b */
    for (uint32_t i = 0; set != QDOT_NIL && set != QDOT_FALSE && i < qdot_expr_count(pool, set); i++) {
        qdot_expr one = qdot_expr_arg(pool, set, i), strict;

        if (qdot_expr_kind(pool, one) != QDOT_REL ||
            qdot_expr_node(pool, one)->op != QDOT_LE)
            continue;
        strict = strict_relation(pool, one);
        if (strict != QDOT_FALSE && follows_from_others(pool, set, i, strict, true, facts))
            set = replace_condition(pool, set, i, strict);
    }
    /* first those with roots: they imply that the roots are defined, and simpler relations might be
     * dropped because of that */
    return remove_implied_conditions(pool, remove_implied_conditions(pool, set, true, facts), false, facts);
}

qdot_expr
qdot_conditions_nonzero(const qdot_pool *pool, qdot_expr relation)
{
    return qdot_expr_kind(pool, relation) == QDOT_REL &&
                   qdot_expr_node(pool, relation)->op == QDOT_LT &&
                   qdot_expr_arg(pool, relation, 0) == QDOT_ZERO
               ? argument_of_absolute_value(pool, qdot_expr_arg(pool, relation, 1))
               : QDOT_NIL;
}

qdot_expr
qdot_conditions_unequal(qdot_pool *pool, qdot_expr u)
{
    qdot_expr sides, left, right;

    if (qdot_expr_kind(pool, u) != QDOT_SUM)
        return qdot_rel(pool, QDOT_LT, u, QDOT_ZERO);
    sides = move_number_to_left(pool, qdot_positive_without_minus(pool, u));
    left = qdot_expr_arg(pool, sides, 0);
    right = qdot_expr_arg(pool, sides, 1);
    return qdot_expr_rational(pool, right) != NULL ? sides : qdot_rel(pool, QDOT_LT, right, left);
}
