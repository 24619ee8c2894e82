/* solve-special.c -- roots where parameters have special values. */
#include "normal/solve/solve-special.h"

#include <string.h>

#include "expr/calculus.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/refute/constant.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solve.h"

/* Divisors of more operations, more special values, and values special for those of more than so many, are not looked
 * at. */
enum { LONGEST = 60, MOST_SPECIALS = 24, MOST_TOGETHER = 3 };

void
qdot_specials_clear(qdot_specials *s)
{
    for (size_t i = 0; i < s->at.n; i++)
        qdot_solutions_clear(&s->at.at[i].set);
    qdot_free(s->at.at);
    qdot_free(s->open.at);
    *s = (qdot_specials){0};
}

/* --- where a root exists --------------------------------------------------------------- */

/* The set and those relations of `more` that do not hold x. */
static qdot_expr
conditions_without(qdot_pool *pool, qdot_expr set, qdot_expr more, qdot_expr x)
{
    uint32_t n = more == QDOT_NIL ? 0 : qdot_expr_count(pool, more);

    for (uint32_t i = 0; i < n; i++)
        if (!qdot_expr_contains(pool, qdot_expr_arg(pool, more, i), x))
            set = qdot_conditions_and(pool, set, qdot_expr_arg(pool, more, i));
    return set;
}

/* --- zeros of divisors ----------------------------------------------------------------- */

/* A set at values of parameters, special for it or not, whose special values are looked for. */
typedef struct {
    qdot_pool *pool;
    qdot_expr f, x, domain;
    const qdot_facts *facts;
    const qdot_solutions *found;
    qdot_expr where; /* nil: at all values */
    qdot_specials *out;
    qdot_vec(qdot_expr) at; /* LISTs of equations parameter = value, where a divisor is 0 */
} special_search;

static qdot_status zeros_of_all(special_search *s, uint32_t n, const qdot_expr *d, qdot_expr where);

/* The sides of the equations of a LIST (nil: none). */
static size_t
sides_of(const qdot_pool *pool, qdot_expr where, qdot_expr *from, qdot_expr *to)
{
    uint32_t n = where == QDOT_NIL ? 0 : qdot_expr_count(pool, where);

    for (uint32_t i = 0; i < n; i++) {
        from[i] = qdot_expr_arg(pool, qdot_expr_arg(pool, where, i), 0);
        to[i] = qdot_expr_arg(pool, qdot_expr_arg(pool, where, i), 1);
    }
    return n;
}

/* The set may be another one where d = 0. */
static qdot_status
leave_open(special_search *s, qdot_expr d)
{
    qdot_expr equation = qdot_rel(s->pool, QDOT_EQ, d, QDOT_ZERO);

    QDOT_TRY(qdot_pool_check(s->pool));
    return qdot_expr_place(s->out->open.n, s->out->open.at, equation) < s->out->open.n
               ? QDOT_OK
               : qdot_vec_push(&s->out->open, equation);
}

/* p = value where also the other divisors d [n] are 0. */
static qdot_status
zero_at(special_search *s, qdot_expr p, qdot_expr value, uint32_t n, const qdot_expr *d,
        qdot_expr where)
{
    qdot_pool *pool = s->pool;
    qdot_expr there[2], equation = qdot_rel(pool, QDOT_EQ, p, value);
    uint32_t had = where == QDOT_NIL ? 0 : qdot_expr_count(pool, where);
    qdot_expr all = QDOT_NIL;

    if (had + 1 > MOST_TOGETHER)
        return leave_open(s, qdot_sub(pool, p, value));
    for (uint32_t i = 0; i < had; i++) { /* what was said of others, with this value in it */
        qdot_expr one = qdot_expr_arg(pool, where, i);

        all = qdot_conditions_and(
            pool, all,
            qdot_rel(pool, QDOT_EQ, qdot_expr_arg(pool, one, 0),
                     qdot_simplify(pool, qdot_subs(pool, qdot_expr_arg(pool, one, 1), 1, &p, &value),
                                   s->facts)));
    }
    all = qdot_conditions_and(pool, all, equation);
    for (uint32_t i = 0; i < n; i++)
        there[i] = qdot_subs(pool, d[i], 1, &p, &value);
    if (qdot_pool_failed(pool)) {
        qdot_status status = qdot_pool_check(pool);

        return status == QDOT_EDOMAIN ? QDOT_OK : status;
    }
    return zeros_of_all(s, n, there, all);
}

/* d = s p + r, whose slope s may be 0: p = -r/s, or s = 0 = r. */
static qdot_status
zeros_of_linear(special_search *s, qdot_expr p, qdot_expr slope, qdot_expr rest, uint32_t n,
                const qdot_expr *d, qdot_expr where)
{
    QDOT_TRY(zero_at(s, p,
                     qdot_simplify(s->pool, qdot_neg(s->pool, qdot_div(s->pool, rest, slope)), s->facts),
                     n, d, where));
    return n > 0 ? leave_open(s, slope)
                 : zeros_of_all(s, 2, (qdot_expr[]){slope, rest}, where);
}

/* Whether the zeros of d recur after a turn of p, in a domain without two ends: one turn of them is listed. */
static bool
recurs(qdot_pool *pool, qdot_expr d, qdot_expr p, const qdot_facts *facts)
{
    const qdot_window w = qdot_solve_window(pool, p, false);

    return (w.lo == QDOT_NIL || w.hi == QDOT_NIL) &&
           qdot_is_angle(pool, d, p, facts);
}

/* One irreducible factor d is 0, and the others [n]: by a parameter that stands alone in it, or with a number as its
 * slope, or in which it is linear. */
static qdot_status
zeros_of_factor(special_search *s, qdot_expr d, uint32_t n, const qdot_expr *others, qdot_expr where)
{
    qdot_pool *pool = s->pool;
    qdot_expr atoms = qdot_expr_atoms(pool, d, false), linear = QDOT_NIL, zero = QDOT_ZERO;

    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms); i++) {
        qdot_expr p = qdot_expr_arg(pool, atoms, i), slope;
        qdot_solutions found = {0};
        qdot_status status;

        if (!qdot_expr_is_class(pool, p, QDOT_PARAM))
            continue;
        slope = qdot_diff(pool, d, p);
        QDOT_TRY(qdot_pool_check(pool));
        if (linear == QDOT_NIL && !qdot_expr_contains(pool, slope, p))
            linear = p;
        if (qdot_expr_rational(pool, slope) == NULL && qdot_expr_count(pool, atoms) > 1)
            continue;
        status = qdot_solve_inside(pool, d, p, QDOT_NIL, s->facts, &found);
        if (status == QDOT_OK && (!found.complete || (found.root.n > 0 && (found.root.at[0].value == p ||
                                                                          recurs(pool, d, p, s->facts)))))
            status = leave_open(s, d);
        for (size_t k = 0; k < found.root.n && status == QDOT_OK; k++)
            if (found.root.at[k].value != p)
                status = zero_at(s, p, found.root.at[k].value, n, others, where);
        qdot_solutions_clear(&found);
        return status;
    }
    if (linear == QDOT_NIL)
        return leave_open(s, d);
    return zeros_of_linear(s, linear, qdot_diff(pool, d, linear),
                           qdot_subs(pool, d, 1, &linear, &zero), n, others, where);
}

/* Values of parameters at which all of d [n] are 0; n = 0: those of `where`. */
static qdot_status
zeros_of_all(special_search *s, uint32_t n, const qdot_expr *d, qdot_expr where)
{
    qdot_pool *pool = s->pool;
    qdot_expr factors, first;

    if (n == 0)
        return qdot_expr_place(s->at.n, s->at.at, where) < s->at.n ? QDOT_OK
                                                                   : qdot_vec_push(&s->at, where);
    first = qdot_simplify(pool, d[0], s->facts);
    QDOT_TRY(qdot_pool_check(pool));
    if (first == QDOT_ZERO)
        return zeros_of_all(s, n - 1, d + 1, where);
    if ((qdot_expr_node(pool, first)->sign & QDOT_NE0) != 0)
        return QDOT_OK;
    if (qdot_is_constant(pool, first))
        return qdot_is_zero(pool, first, s->facts) ? zeros_of_all(s, n - 1, d + 1, where)
                                                   : qdot_pool_check(pool);
    if (!qdot_expr_is_scalar(pool, first) || qdot_expr_size(pool, first) > LONGEST)
        return leave_open(s, first);
    factors = qdot_solve_factors(pool, first);
    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t k = 0; k < qdot_expr_count(pool, factors); k++)
        QDOT_TRY(zeros_of_factor(s, qdot_expr_arg(pool, factors, k), n - 1, d + 1, where));
    return QDOT_OK;
}

/* --- sets there ------------------------------------------------------------------------ */

/* Whether one of these roots, with the values put in, is `root` wherever that exists. */
static bool
is_among(const special_search *s, const qdot_solutions *set, size_t n, const qdot_expr *from,
         const qdot_expr *to, const qdot_root *root)
{
    qdot_pool *pool = s->pool;
    qdot_expr room[QDOT_CONDITIONS_MOST];
    qdot_facts facts = qdot_facts_and(pool, s->facts, root->condition, room);
    bool found = false;

    for (size_t i = 0; i < set->root.n && !found; i++) {
        qdot_expr there = qdot_subs(pool, set->root.at[i].value, n, from, to);

        if (there == QDOT_NIL) {
            if (qdot_pool_check(pool) != QDOT_EDOMAIN)
                (void)qdot_pool_fail(pool);
            continue;
        }
        if (there != root->value && (there == s->x || root->value == s->x ||
                                     !qdot_is_zero(pool, qdot_sub(pool, there, root->value), &facts)))
            continue;
        found = qdot_conditions_at(pool, set->root.at[i].condition, n, from, to, &facts) == QDOT_NIL;
    }
    return found;
}

/* --- roots at single values of the parameters ------------------------------------------- */

/* The first relation a <= b of a set that allows a = b alone; nil: none. */
static qdot_expr
equality_in(qdot_pool *pool, qdot_expr set, const qdot_facts *facts)
{
    uint32_t n = set == QDOT_NIL ? 0 : qdot_expr_count(pool, set);

    for (uint32_t i = 0; i < n; i++) {
        qdot_expr one = qdot_expr_arg(pool, set, i), room[QDOT_CONDITIONS_MOST];
        qdot_facts all = qdot_facts_and(pool, facts, set, room);

        if (qdot_expr_node(pool, one)->op == QDOT_LE && qdot_expr_size(pool, one) <= LONGEST &&
            qdot_condition(pool, qdot_positive_of(pool, one), true, &all) == QDOT_FALSE)
            return one;
    }
    return QDOT_NIL;
}

/* Whether a root that exists only where two sides are equal, -sqrt(a) for a <= 0, is one of `found` there. */
static qdot_status
is_point_of(qdot_pool *pool, qdot_expr x, const qdot_facts *facts, const qdot_solutions *found, const qdot_root *root,
            bool *yes)
{
    qdot_expr equal = equality_in(pool, root->condition, facts), gap;
    qdot_specials out = {0};
    special_search s = {.pool = pool, .x = x, .facts = facts, .found = found, .where = QDOT_NIL, .out = &out};
    qdot_status status = qdot_pool_check(pool);

    *yes = equal != QDOT_NIL;
    if (*yes && status == QDOT_OK) {
        gap = qdot_positive_of(pool, equal);
        status = zeros_of_all(&s, 1, &gap, QDOT_NIL);
    }
    for (size_t k = 0; k < s.at.n && *yes && status == QDOT_OK; k++) {
        qdot_expr from[MOST_TOGETHER], to[MOST_TOGETHER];
        size_t n = sides_of(pool, s.at.at[k], from, to);
        qdot_root there = *root;

        there.value = qdot_subs(pool, root->value, n, from, to);
        there.condition = qdot_conditions_at(pool, root->condition, n, from, to, facts);
        status = qdot_pool_check(pool);
        *yes = there.condition == QDOT_FALSE || is_among(&s, found, n, from, to, &there);
    }
    *yes = *yes && out.open.n == 0;
    qdot_free(s.at.at);
    qdot_specials_clear(&out);
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}

/* Leave out roots that are other ones wherever they exist. */
static qdot_status
leave_out_points(qdot_pool *pool, qdot_expr x, const qdot_facts *facts, qdot_solutions *found)
{
    for (size_t i = 0; found->root.n > 1 && i < found->root.n;) {
        const qdot_root root = found->root.at[i];
        const size_t behind = found->root.n - i - 1;
        bool point;
        qdot_status status;

        memmove(found->root.at + i, found->root.at + i + 1, behind * sizeof root);
        found->root.n--;
        status = is_point_of(pool, x, facts, found, &root, &point);
        if (status == QDOT_OK && point)
            continue;
        memmove(found->root.at + i + 1, found->root.at + i, behind * sizeof root);
        found->root.at[i++] = root;
        found->root.n++;
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

qdot_status
qdot_solve_parameters(qdot_pool *pool, qdot_expr f, qdot_expr x, const qdot_facts *facts,
                      qdot_solutions *found)
{
    qdot_expr of_equation = conditions_without(pool, QDOT_NIL, qdot_conditions_of_domain(pool, f, QDOT_NIL), x);
    size_t kept = 0;

    of_equation = conditions_without(pool, of_equation, qdot_conditions_of_divisors(pool, f, QDOT_NIL), x);
    for (size_t i = 0; i < found->root.n; i++) {
        qdot_root root = found->root.at[i];
        qdot_expr value = root.period == QDOT_NIL
                              ? root.value
                              : qdot_list(pool, 2, (qdot_expr[]){root.value, root.period}),
                  set = of_equation;

        set = conditions_without(pool, set, qdot_conditions_of_divisors(pool, value, QDOT_NIL), x);
        set = conditions_without(pool, set, qdot_conditions_of_domain(pool, value, QDOT_NIL), x);
        if (set != QDOT_NIL)
            set = qdot_conditions_at(pool, qdot_conditions_all(pool, set, root.condition), 0, NULL, NULL,
                                     facts);
        else
            set = root.condition;
        root.condition = qdot_conditions_reduce(pool, set, facts);
        QDOT_TRY(qdot_pool_check(pool));
        if (root.condition != QDOT_FALSE)
            found->root.at[kept++] = root;
    }
    found->root.n = kept;
    return leave_out_points(pool, x, facts, found);
}

/* Whether all that `where` of a set that is told says holds at the values put in: then it is told there too. */
static bool
applies(const special_search *s, qdot_expr where, size_t n, const qdot_expr *from, const qdot_expr *to)
{
    bool holds = true;

    for (uint32_t i = 0; i < qdot_expr_count(s->pool, where) && holds; i++) {
        qdot_expr one = qdot_expr_arg(s->pool, where, i),
                  gap = qdot_subs(s->pool,
                                  qdot_sub(s->pool, qdot_expr_arg(s->pool, one, 0),
                                           qdot_expr_arg(s->pool, one, 1)),
                                  n, from, to);

        holds = gap != QDOT_NIL && qdot_is_zero(s->pool, gap, s->facts);
    }
    if (qdot_pool_failed(s->pool) && qdot_pool_check(s->pool) != QDOT_EDOMAIN)
        (void)qdot_pool_fail(s->pool);
    return holds;
}

/* Whether what is told, for all values and for special ones, says all of the set. */
static bool
is_told(const special_search *s, size_t n, const qdot_expr *from, const qdot_expr *to,
        const qdot_solutions *set)
{
    bool all = true;

    for (size_t i = 0; i < set->root.n && all; i++) {
        all = is_among(s, s->found, n, from, to, &set->root.at[i]);
        for (size_t k = 0; k < s->out->at.n && !all; k++)
            all = applies(s, s->out->at.at[k].where, n, from, to) &&
                  is_among(s, &s->out->at.at[k].set, n, from, to, &set->root.at[i]);
    }
    return all;
}

static qdot_status search_specials(special_search *s);

/* The set where the parameters have these values. */
static qdot_status
solve_at(special_search *s, qdot_expr where)
{
    qdot_pool *pool = s->pool;
    qdot_expr from[MOST_TOGETHER], to[MOST_TOGETHER];
    size_t n = sides_of(pool, where, from, to);
    qdot_special one = {.where = where};
    special_search next = *s;
    qdot_status status;

    next.f = qdot_subs(pool, s->f, n, from, to);
    status = qdot_pool_check(pool);
    if (status == QDOT_EDOMAIN) /* the equation is not defined there */
        return QDOT_OK;
    QDOT_TRY(status);
    next.domain = qdot_conditions_at(pool, s->domain, n, from, to, s->facts);
    QDOT_TRY(qdot_pool_check(pool));
    if (next.domain == QDOT_FALSE)
        return QDOT_OK;
    if (next.domain == QDOT_NIL && qdot_is_zero(pool, next.f, s->facts)) {
        QDOT_TRY(qdot_vec_push(&one.set.root, ((qdot_root){s->x, QDOT_NIL, QDOT_NIL, QDOT_NIL})));
        one.set.complete = true;
    } else {
        status = qdot_solve_inside(pool, next.f, s->x, next.domain, s->facts, &one.set);
    }
    if (status == QDOT_OK)
        status = qdot_solve_parameters(pool, next.f, s->x, s->facts, &one.set);
    if (status == QDOT_OK && !one.set.complete) {
        for (size_t i = 0; i < n && status == QDOT_OK; i++)
            status = leave_open(s, qdot_sub(pool, from[i], to[i]));
    } else if (status == QDOT_OK) {
        next.found = &one.set;
        next.where = where;
        memset(&next.at, 0, sizeof next.at);
        if (!is_told(s, n, from, to, &one.set) && qdot_pool_check(pool) == QDOT_OK) {
            status = qdot_vec_push(&s->out->at, one);
            return status == QDOT_OK ? search_specials(&next) : status; /* out owns the set */
        }
        status = search_specials(&next);
    }
    qdot_solutions_clear(&one.set);
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

static qdot_status
search_specials(special_search *s)
{
    const qdot_solutions *set = s->found;
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < set->special.n && status == QDOT_OK; i++) {
        qdot_expr d = set->special.at[i], list[QDOT_CONDITIONS_MOST];
        uint32_t n = qdot_expr_kind(s->pool, d) == QDOT_LIST ? qdot_expr_count(s->pool, d) : 0;

        for (uint32_t k = 0; k < n && k < 2; k++)
            list[k] = qdot_expr_arg(s->pool, d, k);
        status = n > 2 ? leave_open(s, qdot_expr_arg(s->pool, d, 0))
                       : zeros_of_all(s, n == 0 ? 1 : n, n == 0 ? &d : list, s->where);
    }
    for (size_t i = 0; i < s->at.n && status == QDOT_OK; i++)
        status = s->out->at.n < MOST_SPECIALS
                     ? solve_at(s, s->at.at[i])
                     : leave_open(s, qdot_positive_of(s->pool, qdot_expr_arg(s->pool, s->at.at[i], 0)));
    qdot_free(s->at.at);
    memset(&s->at, 0, sizeof s->at);
    return status;
}

qdot_status
qdot_solve_specials(qdot_pool *pool, qdot_expr f, qdot_expr x, qdot_expr domain,
                    const qdot_facts *facts, const qdot_solutions *found, qdot_specials *out)
{
    special_search s = {.pool = pool, .f = f, .x = x, .domain = domain, .facts = facts, .found = found,
                        .where = QDOT_NIL, .out = out};

    return search_specials(&s);
}
