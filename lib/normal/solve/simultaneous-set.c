/* simultaneous-set.c -- completes the set of solutions: lists each once, sorts them, adds unknowns that remain free. */
#include <math.h>
#include <stdio.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "normal/prove/decide.h"
#include "normal/refute/ball.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/simultaneous.h"

/* The budget of operations; typical textbook systems take some hundred units. */
enum { WORK = 6000 };

/* --- each solution once ------------------------------------------------------------------------------- */

/* Whether the difference d of two angles is an integer number of full turns. */
static bool
is_full_turns(const qdot_simultaneous *s, qdot_expr d)
{
    const fmpq *c;

    d = qdot_simplify(s->pool, d, &s->facts);
    if (d == QDOT_NIL || qdot_expr_kind(s->pool, d) != QDOT_PROD ||
        qdot_expr_count(s->pool, d) != 3 || qdot_expr_arg(s->pool, d, 1) != QDOT_PI ||
        qdot_expr_arg(s->pool, d, 2) != QDOT_ONE)
        return false;
    c = qdot_expr_rational(s->pool, qdot_expr_arg(s->pool, d, 0));
    return fmpz_is_one(fmpq_denref(c)) && fmpz_is_even(fmpq_numref(c));
}

/* Whether u is an angle without declared bounds; with bounds the members of a family are listed one by one. */
static bool
is_free_angle(const qdot_simultaneous *s, qdot_expr u)
{
    const qdot_symbol *x = qdot_expr_symbol(s->pool, u);

    return x->lo == QDOT_NIL && x->hi == QDOT_NIL &&
           qdot_is_angle(s->pool, s->equations, u, &s->facts);
}

/* Whether the conditions are proved to hold at the solution `one`, wherever that exists. */
static bool
conditions_hold_at(const qdot_simultaneous *s, qdot_expr conditions, const qdot_simultaneous_solution *one)
{
    qdot_expr room[QDOT_CONDITIONS_MOST],
        there = qdot_simultaneous_put(s->pool, conditions, one->values);
    qdot_facts facts = qdot_facts_and(s->pool, &s->facts, one->conditions, room);

    if (there == QDOT_NIL && qdot_pool_check(s->pool) == QDOT_EDOMAIN)
        return false;
    return qdot_conditions_at(s->pool, there, 0, NULL, NULL, &facts) == QDOT_NIL &&
           !qdot_pool_failed(s->pool);
}

bool
qdot_simultaneous_lies_in(const qdot_simultaneous *s, const qdot_simultaneous_solution *one,
                          const qdot_simultaneous_solution *all)
{
    qdot_pool *pool = s->pool;
    uint32_t m = qdot_expr_count(pool, all->values);
    bool inside = m <= qdot_expr_count(pool, one->values);
    qdot_expr room[QDOT_CONDITIONS_MOST];
    const qdot_facts facts = qdot_facts_and(pool, &s->facts, one->conditions, room);

    for (uint32_t k = 0; k < m && inside; k++) {
        qdot_expr u = qdot_expr_arg(pool, qdot_expr_arg(pool, all->values, k), 0),
                  v = qdot_expr_arg(pool, qdot_expr_arg(pool, all->values, k), 1),
                  there = qdot_simultaneous_put(pool, u, one->values), d;

        d = qdot_sub(pool, there, qdot_simultaneous_put(pool, v, one->values));
        if (d == QDOT_NIL) { /* undefined there: the family `all` has no member at this solution */
            if (qdot_pool_check(pool) != QDOT_EDOMAIN)
                (void)qdot_pool_fail(pool);
            return false;
        }
        inside = there != u && (d == QDOT_ZERO || qdot_is_zero(pool, d, &facts) ||
                                (is_full_turns(s, d) && is_free_angle(s, u)));
    }
    if (inside && all->conditions != QDOT_NIL && all->conditions != one->conditions)
        inside = conditions_hold_at(s, all->conditions, one);
    return inside;
}

/* Join solutions that differ only in their conditions. */
static void
join_solutions(qdot_simultaneous *s)
{
    size_t kept = 0;

    for (size_t i = 0; i < s->found.n; i++) {
        bool joined = false;

        for (size_t k = 0; k < kept && !joined; k++)
            joined = s->found.at[k].values == s->found.at[i].values &&
                     qdot_conditions_join(s->pool, &s->found.at[k].conditions,
                                          s->found.at[i].conditions, &s->facts);
        if (!joined)
            s->found.at[kept++] = s->found.at[i];
    }
    s->found.n = kept;
}

/* Remove solutions that are contained in another one. */
static qdot_status
remove_contained_solutions(qdot_simultaneous *s)
{
    qdot_simultaneous_solution *at = s->found.at;
    size_t n = s->found.n, kept = 0;
    bool *out = qdot_calloc(n + 1, sizeof *out);

    if (out == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n && !out[i]; j++)
            out[i] = j != i && !out[j] &&
                     (j < i || qdot_expr_count(s->pool, at[j].values) <
                                   qdot_expr_count(s->pool, at[i].values)) &&
                     qdot_simultaneous_lies_in(s, &at[i], &at[j]);
    for (size_t i = 0; i < n; i++)
        if (!out[i])
            at[kept++] = at[i];
    s->found.n = kept;
    qdot_free(out);
    return qdot_pool_check(s->pool);
}

/* --- sorting solutions -------------------------------------------------------------------------------- */

/* Whether a is listed before b: by the first value that differs, if both are constants. */
static bool
is_listed_before(const qdot_simultaneous *s, const qdot_simultaneous_solution *a,
                 const qdot_simultaneous_solution *b)
{
    uint32_t n = qdot_expr_count(s->pool, a->values);

    if (n != qdot_expr_count(s->pool, b->values))
        return false;
    for (uint32_t i = 0; i < n; i++) {
        qdot_expr left = qdot_expr_arg(s->pool, a->values, i),
                  right = qdot_expr_arg(s->pool, b->values, i);
        double x, y;

        if (qdot_expr_arg(s->pool, left, 0) != qdot_expr_arg(s->pool, right, 0) ||
            !qdot_ball_double(s->pool, qdot_expr_arg(s->pool, left, 1), NULL, NULL, &x) ||
            !qdot_ball_double(s->pool, qdot_expr_arg(s->pool, right, 1), NULL, NULL, &y))
            return false;
        if (fabs(x - y) > 1e-12 * (1 + fabs(x)))
            return x < y;
    }
    return false;
}

static void
sort_solutions(qdot_simultaneous *s)
{
    qdot_simultaneous_solution *at = s->found.at;

    for (size_t a = 1; a < s->found.n; a++)
        for (size_t b = a; b > 0 && is_listed_before(s, &at[b], &at[b - 1]); b--) {
            qdot_simultaneous_solution keep = at[b];

            at[b] = at[b - 1];
            at[b - 1] = keep;
        }
}

/* --- unknowns that are parameters --------------------------------------------------------------------- */

/* A parameter is generic: it divides without a branch of its own. So one that is solved for is a symbol of another
 * class, with the same domain, while that lasts. */
typedef struct {
    qdot_pool *pool;
    size_t n;
    const qdot_expr *name;
    qdot_expr *symbol; /* [n] temporary symbols of the parameters */
} alias;

static qdot_expr
make_temporary_symbol(qdot_pool *pool, qdot_expr u)
{
    const qdot_symbol *x = qdot_expr_symbol(pool, u);
    qdot_expr lo, hi, symbol;
    bool lo_open, hi_open;
    char name[80];

    if (x == NULL || !qdot_is_generic(pool, u))
        return u;
    lo = x->lo;
    hi = x->hi;
    lo_open = x->lo_open;
    hi_open = x->hi_open;
    snprintf(name, sizeof name, "(unknown %.60s)", x->name);
    symbol = qdot_symbol_get(pool, QDOT_FORMAL, name);
    qdot_symbol_domain(pool, symbol, lo, lo_open, hi, hi_open);
    if (symbol != QDOT_NIL)
        qdot_symbol_hide(pool, symbol); /* cannot be found by name, so that the parameter may be declared again */
    return symbol;
}

static qdot_expr
rename_symbols(qdot_pool *pool, qdot_expr e, size_t n, const qdot_expr *from, const qdot_expr *to)
{
    return e == QDOT_NIL || e == QDOT_FALSE ? e : qdot_subs(pool, e, n, from, to);
}

static qdot_expr
restore_parameters(const alias *a, qdot_expr e)
{
    return rename_symbols(a->pool, e, a->n, a->symbol, a->name);
}

static qdot_expr
replace_parameters(const alias *a, qdot_expr e)
{
    return rename_symbols(a->pool, e, a->n, a->name, a->symbol);
}

/* Write the facts with temporary symbols in place of unknown parameters, in room [relations + conditions]. */
static qdot_facts
facts_with_symbols(const alias *a, const qdot_facts *facts, qdot_expr *room)
{
    qdot_facts all = *facts;

    for (size_t i = 0; i < facts->n_relations; i++)
        room[i] = replace_parameters(a, facts->relations[i]);
    all.relations = room;
    room += facts->n_relations;
    for (size_t i = 0; i < facts->n_conditions; i++)
        room[i] = replace_parameters(a, facts->conditions[i]);
    all.conditions = room;
    all.defined = replace_parameters(a, facts->defined);
    return all;
}

static qdot_status
solve_with_symbols(const alias *a, const qdot_expr *f, qdot_expr conditions, const qdot_facts *facts,
                   qdot_simultaneous *s)
{
    qdot_pool *pool = a->pool;
    qdot_simultaneous_branch first = {.known = qdot_list(pool, 0, NULL),
                                      .conditions = replace_parameters(a, conditions)};
    bool single;

    s->facts = *facts;
    s->equations = first.equations = replace_parameters(a, qdot_list(pool, (uint32_t)a->n, f));
    QDOT_TRY(qdot_pool_check(pool));
    for (size_t i = 0; i < a->n; i++)
        QDOT_TRY(qdot_vec_push(&s->unknowns, a->symbol[i]));
    QDOT_TRY(qdot_has_single_places(pool, 1, &s->equations, a->n, a->symbol, &s->facts, &single));
    s->complete = !single;
    if (first.conditions != QDOT_FALSE)
        QDOT_TRY(qdot_vec_push(&s->todo, first));
    QDOT_TRY(qdot_simultaneous_solve(s));
    join_solutions(s);
    QDOT_TRY(remove_contained_solutions(s));
    sort_solutions(s);
    for (size_t i = 0; i < s->found.n; i++) {
        s->found.at[i].values = restore_parameters(a, s->found.at[i].values);
        s->found.at[i].conditions = restore_parameters(a, s->found.at[i].conditions);
    }
    for (size_t i = 0; i < s->special.n; i++)
        s->special.at[i] = restore_parameters(a, s->special.at[i]);
    return qdot_pool_check(pool);
}

qdot_status
qdot_simultaneous_all(qdot_pool *pool, size_t n, const qdot_expr *f, const qdot_expr *u,
                      qdot_expr conditions, const qdot_facts *facts, qdot_simultaneous *out)
{
    const qdot_facts none = {0};
    const qdot_facts *given = facts == NULL ? &none : facts;
    size_t count = given->n_relations + given->n_conditions;
    alias a = {.pool = pool, .n = n, .name = u, .symbol = qdot_malloc((n + count + 1) * sizeof *a.symbol)};
    qdot_facts all;
    qdot_status status = a.symbol == NULL ? QDOT_ENOMEM : QDOT_OK;

    *out = (qdot_simultaneous){
        .pool = pool, .defined = QDOT_ZERO, .places = n, .work = WORK, .complete = true};
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        a.symbol[i] = make_temporary_symbol(pool, u[i]);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status == QDOT_OK) {
        all = facts_with_symbols(&a, given, a.symbol + n);
        status = solve_with_symbols(&a, f, conditions, &all, out);
    }
    out->facts = *given;
    qdot_free(a.symbol);
    return status;
}
