/* solve-special.c -- roots of an equation where its parameters have special values. */
#include "normal/solve/solve-special.h"

#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/refute/constant.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solve.h"
#include "normal/solve/special-values.h"

/* The equation is solved at no more special parameter values than this; further ones stay open. */
enum { MOST_SPECIALS = 24 };

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

/* The set of conditions extended by those relations of `more` that do not contain x. */
static qdot_expr
add_conditions_without(qdot_pool *pool, qdot_expr set, qdot_expr more, qdot_expr x)
{
    uint32_t n = more == QDOT_NIL ? 0 : qdot_expr_count(pool, more);

    for (uint32_t i = 0; i < n; i++)
        if (!qdot_expr_contains(pool, qdot_expr_arg(pool, more, i), x))
            set = qdot_conditions_and(pool, set, qdot_expr_arg(pool, more, i));
    return set;
}

/* --- the search for special values ------------------------------------------------------ */

/* The solutions at certain parameter values, whose own special values are then sought. */
typedef struct {
    qdot_pool *pool;
    qdot_expr f, x;
    qdot_written written;
    const qdot_facts *facts;
    const qdot_solutions *found;
    qdot_expr where; /* parameter values already inserted; nil: none */
    qdot_specials *out;
} special_search;

/* Record that the solutions may differ where the given equation in parameters holds. */
static qdot_status
record_open_equation(special_search *s, qdot_expr equation)
{
    QDOT_TRY(qdot_pool_check(s->pool));
    return qdot_expr_place(s->out->open.n, s->out->open.at, equation) < s->out->open.n
               ? QDOT_OK
               : qdot_vec_push(&s->out->open, equation);
}

/* --- solutions that are known already -------------------------------------------------- */

/* Whether `root`, wherever it exists, is one of the roots of `set` with parameter values inserted. */
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

/* The first relation a <= b of a set that can only hold as a = b; nil if there is none. */
static qdot_expr
find_equality(qdot_pool *pool, qdot_expr set, const qdot_facts *facts)
{
    uint32_t n = set == QDOT_NIL ? 0 : qdot_expr_count(pool, set);

    for (uint32_t i = 0; i < n; i++) {
        qdot_expr one = qdot_expr_arg(pool, set, i), room[QDOT_CONDITIONS_MOST];
        qdot_facts all = qdot_facts_and(pool, facts, set, room);

        if (qdot_expr_node(pool, one)->op == QDOT_LE && qdot_expr_size(pool, one) <= QDOT_SPECIAL_LONGEST &&
            qdot_condition(pool, qdot_positive_of(pool, one), true, &all) == QDOT_FALSE)
            return one;
    }
    return QDOT_NIL;
}

/* Whether the root exists only where both sides of one of its conditions are equal, and is one of `found` at all values of
 * parameters where they are. */
static qdot_status
is_root_at_equality(qdot_pool *pool, qdot_expr x, const qdot_facts *facts, const qdot_solutions *found, const qdot_root *root,
                    bool *yes)
{
    qdot_expr equal = find_equality(pool, root->condition, facts), gap;
    qdot_special_values values = {0};
    const special_search s = {.pool = pool, .x = x, .facts = facts, .found = found};
    qdot_status status = qdot_pool_check(pool);

    *yes = equal != QDOT_NIL;
    if (*yes && status == QDOT_OK) {
        gap = qdot_positive_of(pool, equal);
        status = qdot_special_values_add(pool, 1, &gap, QDOT_NIL, facts, &values);
    }
    for (size_t k = 0; k < values.at.n && *yes && status == QDOT_OK; k++) {
        qdot_expr from[QDOT_SPECIAL_TOGETHER], to[QDOT_SPECIAL_TOGETHER];
        size_t n = qdot_special_sides(pool, values.at.at[k], from, to);
        qdot_root there = *root;

        there.value = qdot_subs(pool, root->value, n, from, to);
        there.condition = qdot_conditions_at(pool, root->condition, n, from, to, facts);
        status = qdot_pool_check(pool);
        *yes = there.condition == QDOT_FALSE || is_among(&s, found, n, from, to, &there);
    }
    *yes = *yes && values.open.n == 0;
    qdot_special_values_clear(&values);
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}

/* Leave out roots that exist only at special values of parameters and equal another root there: under a <= 0, -sqrt(a)
 * exists at a = 0 alone, where sqrt(a) is the same. */
static qdot_status
remove_repeated_points(qdot_pool *pool, qdot_expr x, const qdot_facts *facts, qdot_solutions *found)
{
    for (size_t i = 0; found->root.n > 1 && i < found->root.n;) {
        const qdot_root root = found->root.at[i];
        const size_t behind = found->root.n - i - 1;
        bool point;
        qdot_status status;

        memmove(found->root.at + i, found->root.at + i + 1, behind * sizeof root);
        found->root.n--;
        status = is_root_at_equality(pool, x, facts, found, &root, &point);
        if (status == QDOT_OK && point)
            continue;
        memmove(found->root.at + i + 1, found->root.at + i, behind * sizeof root);
        found->root.at[i++] = root;
        found->root.n++;
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

qdot_expr
qdot_solve_conditions(qdot_pool *pool, qdot_expr domain, qdot_expr f, qdot_expr x)
{
    qdot_expr set = add_conditions_without(pool, QDOT_NIL, domain, x);

    set = add_conditions_without(pool, set, qdot_conditions_of_domain(pool, f, QDOT_NIL), x);
    return add_conditions_without(pool, set, qdot_conditions_of_divisors(pool, f, QDOT_NIL), x);
}

/* Remove whole turns by integers from the root, as cot(x + 2 pi n) is cot(x). *defined: it then has a value, and its
 * conditions may hold. */
static qdot_status
remove_turns_from_root(qdot_pool *pool, const qdot_facts *facts, qdot_root *root, bool *defined)
{
    qdot_expr value = root->value, condition = root->condition;
    qdot_status status;

    *defined = true;
    if (qdot_solve_integers(pool, value) == 0)
        return QDOT_OK;
    value = qdot_solve_without_turns(pool, value);
    if (condition != QDOT_NIL && value != QDOT_NIL)
        condition = qdot_solve_without_turns(pool, condition);
    status = qdot_pool_check(pool);
    if (status == QDOT_OK && condition != root->condition)
        condition = qdot_conditions_at(pool, condition, 0, NULL, NULL, facts);
    *defined = status == QDOT_OK && condition != QDOT_FALSE;
    root->value = value;
    root->condition = condition;
    return status == QDOT_EDOMAIN ? QDOT_OK : status == QDOT_OK ? qdot_pool_check(pool) : status;
}

qdot_status
qdot_solve_parameters(qdot_pool *pool, qdot_expr f, qdot_expr x, const qdot_written *written,
                      const qdot_facts *facts, qdot_solutions *found)
{
    const qdot_expr of_equation = qdot_solve_conditions(pool, QDOT_NIL, f, x);
    size_t kept = 0;

    for (size_t i = 0; i < found->root.n; i++) {
        qdot_root root = found->root.at[i];
        qdot_expr value, set = of_equation;
        bool lifted, defined;

        QDOT_TRY(remove_turns_from_root(pool, facts, &root, &defined));
        if (!defined)
            continue;
        value = root.period == QDOT_NIL ? root.value : qdot_list(pool, 2, (qdot_expr[]){root.value, root.period});
        QDOT_TRY(qdot_written_lifts(pool, written, f, x, root.value, facts, &lifted));
        if (lifted)
            set = qdot_conditions_less(pool, set, written->apart);
        set = add_conditions_without(pool, set, qdot_conditions_of_divisors(pool, value, QDOT_NIL), x);
        set = add_conditions_without(pool, set, qdot_conditions_of_domain(pool, value, QDOT_NIL), x);
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
    return remove_repeated_points(pool, x, facts, found);
}

/* Whether the conditions `where` of a listed set hold with the values inserted: then that set
 * applies here, too. */
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

/* Whether sets of roots already listed, general or special, contain all roots at the parameter values `to`. */
static bool
is_already_listed(const special_search *s, size_t n, const qdot_expr *from, const qdot_expr *to,
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

static qdot_status search_special_values(special_search *s);

/* Solve the equation with the parameter values of `where` inserted. */
static qdot_status
solve_at_special_values(special_search *s, qdot_expr where)
{
    qdot_pool *pool = s->pool;
    qdot_expr from[QDOT_SPECIAL_TOGETHER], to[QDOT_SPECIAL_TOGETHER];
    size_t n = qdot_special_sides(pool, where, from, to);
    qdot_special one = {.where = where};
    special_search next = *s;
    qdot_status status;

    next.f = qdot_subs(pool, s->f, n, from, to);
    status = qdot_pool_check(pool);
    if (status == QDOT_EDOMAIN) /* the equation is undefined at these parameter values */
        return QDOT_OK;
    QDOT_TRY(status);
    next.written.domain = qdot_conditions_at(pool, s->written.domain, n, from, to, s->facts);
    next.written.apart = s->written.apart == QDOT_NIL ? QDOT_NIL : qdot_subs(pool, s->written.apart, n, from, to);
    QDOT_TRY(qdot_pool_check(pool));
    if (next.written.domain == QDOT_FALSE)
        return QDOT_OK;
    if (next.written.domain == QDOT_NIL && qdot_is_zero(pool, next.f, s->facts)) {
        QDOT_TRY(qdot_vec_push(&one.set.root, ((qdot_root){s->x, QDOT_NIL, QDOT_NIL, QDOT_NIL})));
        one.set.complete = true;
    } else {
        status = qdot_solve_written(pool, next.f, s->x, &next.written, s->facts, &one.set);
    }
    if (status == QDOT_OK)
        status = qdot_solve_parameters(pool, next.f, s->x, &next.written, s->facts, &one.set);
    if (status == QDOT_OK && !one.set.complete) {
        for (size_t i = 0; i < n && status == QDOT_OK; i++)
            status = record_open_equation(s, qdot_rel(pool, QDOT_EQ, qdot_sub(pool, from[i], to[i]), QDOT_ZERO));
    } else if (status == QDOT_OK) {
        next.found = &one.set;
        next.where = where;
        if (!is_already_listed(s, n, from, to, &one.set) && qdot_pool_check(pool) == QDOT_OK) {
            status = qdot_vec_push(&s->out->at, one);
            return status == QDOT_OK ? search_special_values(&next) : status; /* the new set is owned by `out` */
        }
        status = search_special_values(&next);
    }
    qdot_solutions_clear(&one.set);
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

static qdot_status
search_special_values(special_search *s)
{
    const qdot_solutions *set = s->found;
    qdot_special_values values = {0};
    qdot_status status = qdot_special_values_add(s->pool, set->special.n, set->special.at, s->where,
                                                 s->facts, &values);

    for (size_t i = 0; i < values.open.n && status == QDOT_OK; i++)
        status = record_open_equation(s, values.open.at[i]);
    for (size_t i = 0; i < values.at.n && status == QDOT_OK; i++) {
        qdot_expr where = values.at.at[i];

        status = s->out->at.n < MOST_SPECIALS
                     ? solve_at_special_values(s, where)
                     : record_open_equation(s, qdot_rel(s->pool, QDOT_EQ,
                                                        qdot_positive_of(s->pool, qdot_expr_arg(s->pool, where, 0)),
                                                        QDOT_ZERO));
    }
    qdot_special_values_clear(&values);
    return status;
}

qdot_status
qdot_solve_specials(qdot_pool *pool, qdot_expr f, qdot_expr x, const qdot_written *written,
                    const qdot_facts *facts, const qdot_solutions *found, qdot_specials *out)
{
    special_search s = {.pool = pool, .f = f, .x = x, .written = *written, .facts = facts, .found = found,
                        .where = QDOT_NIL, .out = out};

    return search_special_values(&s);
}
