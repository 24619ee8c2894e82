/* domain.c -- eliminates conditions and bounds by replacing symbols, one after another. */
#include "normal/prove/domain.h"

#include <stdio.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/prove/defined.h"
#include "normal/refute/constant.h"

enum { MOST_GAPS = 40 };

typedef struct {
    qdot_pool *pool;
    size_t n;
    qdot_expr *e;
    qdot_exprs gap; /* left sides of the conditions gap > 0, or gap >= 0 if `weak` */
    qdot_vec(bool) weak;
    bool changed, empty;
} job;

/* A new symbol y that takes the place of x, with the given bounds and no others. */
static qdot_expr
new_symbol(qdot_pool *pool, qdot_expr x, qdot_expr lo, bool lo_open, qdot_expr hi,
           bool hi_open)
{
    char name[80];
    qdot_expr y;

    snprintf(name, sizeof name, "(%u: %u%d %u%d)", x, lo, lo_open, hi, hi_open);
    y = qdot_symbol_get(pool, QDOT_FORMAL, name);
    if (y != QDOT_NIL)
        qdot_symbol_domain(pool, y, lo, lo_open, hi, hi_open);
    return y;
}

/* Replace x by `to` in all expressions and conditions. */
static void
domain_replace(job *j, qdot_expr x, qdot_expr to)
{
    j->changed = true;
    for (size_t i = 0; i < j->n; i++)
        j->e[i] = qdot_subs(j->pool, j->e[i], 1, &x, &to);
    for (size_t i = 0; i < j->gap.n; i++)
        if (j->gap.at[i] != QDOT_NIL)
            j->gap.at[i] = qdot_subs(j->pool, j->gap.at[i], 1, &x, &to);
}

static qdot_status
add_domain_condition(job *j, qdot_expr gap, bool weak)
{
    if (j->gap.n >= MOST_GAPS)
        return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&j->gap, gap));
    return qdot_vec_push(&j->weak, weak);
}

/* --- bounds of a symbol -------------------------------------------------------- */

/* Whether a < b is proved, a and b constants. */
static bool
is_proved_less(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    qdot_expr d = qdot_sub(pool, b, a);
    qdot_constant_sign sign;

    return d != QDOT_NIL && qdot_constant_decide(pool, d, &sign) == QDOT_OK &&
           sign == QDOT_CONSTANT_POSITIVE;
}

static bool
occurs_in_angle(const job *j, qdot_expr x)
{
    for (size_t i = 0; i < j->n; i++) {
        bool found = false;
        qdot_walk w;

        if (qdot_walk_begin(j->pool, j->e[i], &w) != QDOT_OK)
            return true;
        for (size_t k = 0; k < w.n && !found; k++)
            found = qdot_expr_kind(j->pool, w.at[k]) == QDOT_FUN &&
                    qdot_expr_node(j->pool, w.at[k])->op <= QDOT_COT &&
                    qdot_expr_contains(j->pool, w.at[k], x);
        qdot_walk_end(&w);
        if (found)
            return true;
    }
    return false;
}

/* x with constant bounds: counted from the lower one if it alone is there or is not
 * negative, else from the upper one. Angles between two bounds stay as they are. */
static void
domain_move_bounds(job *j, qdot_expr x, qdot_symbol s)
{
    qdot_pool *pool = j->pool;
    bool two = s.lo != QDOT_NIL && s.hi != QDOT_NIL, angle = two && occurs_in_angle(j, x);
    qdot_expr y;

    if (two && (angle || (is_proved_less(pool, s.lo, QDOT_ZERO) &&
                          is_proved_less(pool, QDOT_ZERO, s.hi)))) {
        const qdot_symbol *now = qdot_expr_symbol(pool, x);

        if (now->lo != s.lo || now->hi != s.hi || now->lo_open != s.lo_open ||
            now->hi_open != s.hi_open)
            domain_replace(j, x, new_symbol(pool, x, s.lo, s.lo_open, s.hi, s.hi_open));
    } else if (s.lo != QDOT_NIL && (!two || !is_proved_less(pool, s.lo, QDOT_ZERO))) {
        qdot_expr to = two ? qdot_sub(pool, s.hi, s.lo) : QDOT_NIL;
        const qdot_symbol *now = qdot_expr_symbol(pool, x);

        if (s.lo == QDOT_ZERO && now->lo == s.lo && (now->lo_open || !s.lo_open) &&
            now->hi == s.hi && (now->hi_open || !s.hi_open))
            return;
        y = new_symbol(pool, x, QDOT_ZERO, s.lo_open, to, s.hi_open);
        domain_replace(j, x, qdot_add(pool, s.lo, y));
    } else if (s.hi != QDOT_NIL) {
        qdot_expr to = two ? qdot_sub(pool, s.hi, s.lo) : QDOT_NIL;

        y = new_symbol(pool, x, QDOT_ZERO, s.hi_open, to, s.lo_open);
        domain_replace(j, x, qdot_sub(pool, s.hi, y));
    }
}

/* --- conditions that become bounds ---------------------------------------------- */

static uint32_t
count_terms(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_kind(pool, e) == QDOT_SUM ? (qdot_expr_count(pool, e) - 1) / 2 : 1;
}

/* Whether term i of g is c x with a symbol x that occurs in no other term of g. */
static bool
find_linear_term(qdot_pool *pool, qdot_expr g, uint32_t i, qdot_expr *c, qdot_expr *x,
                 qdot_expr *rest)
{
    if (qdot_expr_kind(pool, g) == QDOT_SUM) {
        *x = qdot_expr_arg(pool, g, 1 + 2 * i);
        *c = qdot_expr_arg(pool, g, 2 + 2 * i);
    } else if (qdot_expr_kind(pool, g) == QDOT_PROD && qdot_expr_count(pool, g) == 3 &&
               qdot_expr_arg(pool, g, 2) == QDOT_ONE) {
        *c = qdot_expr_arg(pool, g, 0);
        *x = qdot_expr_arg(pool, g, 1);
    } else {
        *c = QDOT_ONE;
        *x = g;
    }
    if (qdot_expr_kind(pool, *x) != QDOT_SYM || qdot_expr_is_class(pool, *x, QDOT_CONST))
        return false;
    *rest = qdot_sub(pool, g, qdot_mul(pool, *c, *x));
    return *rest != QDOT_NIL && !qdot_expr_contains(pool, *rest, *x);
}

/* Tighten the bounds of x by the condition c x + rest > 0, if that gives a constant bound. */
static void
tighten_bounds(job *j, qdot_expr x, qdot_expr c, qdot_expr rest, bool weak)
{
    qdot_expr v = qdot_neg(j->pool, qdot_div(j->pool, rest, c));
    qdot_symbol s = *qdot_expr_symbol(j->pool, x);

    if (v == QDOT_NIL)
        return;
    if (fmpq_sgn(qdot_expr_rational(j->pool, c)) > 0) {
        if (s.lo == QDOT_NIL || !qdot_expr_is_constant(j->pool, s.lo) || s.lo == v ||
            is_proved_less(j->pool, s.lo, v)) {
            s.lo_open = !weak || (s.lo == v && s.lo_open);
            s.lo = v;
        }
    } else if (s.hi == QDOT_NIL || !qdot_expr_is_constant(j->pool, s.hi) || s.hi == v ||
               is_proved_less(j->pool, v, s.hi)) {
        s.hi_open = !weak || (s.hi == v && s.hi_open);
        s.hi = v;
    }
    if (s.lo != QDOT_NIL && !qdot_expr_is_constant(j->pool, s.lo))
        s.lo = QDOT_NIL;
    if (s.hi != QDOT_NIL && !qdot_expr_is_constant(j->pool, s.hi))
        s.hi = QDOT_NIL;
    if (s.lo != QDOT_NIL && s.hi != QDOT_NIL && !is_proved_less(j->pool, s.lo, s.hi))
        return; /* lo < hi is not certain */
    domain_move_bounds(j, x, s);
}

/* Solve a condition for a symbol in such a way that its declared sign is visible in the replacement. */
static bool
solve_condition(job *j, qdot_expr gap, bool weak)
{
    qdot_pool *pool = j->pool;
    qdot_expr g = qdot_expand(pool, gap), c, x, rest, to;

    if (g == QDOT_NIL || !qdot_expr_is_scalar(pool, g) || qdot_expr_is_constant(pool, g))
        return g != QDOT_NIL;
    for (uint32_t i = 0; i < count_terms(pool, g); i++) {
        uint8_t need, have;

        if (!find_linear_term(pool, g, i, &c, &x, &rest))
            continue;
        if (qdot_expr_is_constant(pool, rest)) {
            tighten_bounds(j, x, c, rest, weak);
            return true;
        }
        to = qdot_sub(pool, new_symbol(pool, x, QDOT_ZERO, !weak, QDOT_NIL, false), rest);
        to = qdot_div(pool, to, c);
        if (to == QDOT_NIL)
            return false;
        need = qdot_expr_node(pool, x)->sign;
        have = qdot_expr_node(pool, to)->sign;
        if ((need & ~have) == 0) {
            domain_replace(j, x, to);
            return true;
        }
    }
    return false;
}

/* --- relations solved for symbols ----------------------------------------------- */

/* Solve r = a x + b for x if a is never zero and neither a nor b contains x: *to is -b/a. */
static bool
solve_linear(qdot_pool *pool, qdot_expr r, qdot_expr x, qdot_expr *to)
{
    qdot_expr zero = QDOT_ZERO, a = qdot_diff(pool, r, x), b;

    if (a == QDOT_NIL || !(qdot_expr_node(pool, a)->sign & QDOT_NE0) ||
        qdot_expr_contains(pool, a, x))
        return false;
    b = qdot_subs(pool, r, 1, &x, &zero);
    *to = qdot_neg(pool, qdot_div(pool, b, a));
    return *to != QDOT_NIL && !qdot_expr_contains(pool, *to, x);
}

/* Keep the declared bounds of x as conditions on its replacement. */
static qdot_status
keep_bounds_as_conditions(job *j, qdot_expr x)
{
    qdot_symbol s = *qdot_expr_symbol(j->pool, x);

    if (s.lo != QDOT_NIL)
        QDOT_TRY(add_domain_condition(j, qdot_sub(j->pool, x, s.lo), !s.lo_open));
    if (s.hi != QDOT_NIL)
        QDOT_TRY(add_domain_condition(j, qdot_sub(j->pool, s.hi, x), !s.hi_open));
    return QDOT_OK;
}

static qdot_status
solve_relations(job *j, size_t nr)
{
    qdot_pool *pool = j->pool;

    for (size_t i = j->n - nr; i < j->n; i++) {
        qdot_expr atoms = qdot_expr_atoms(pool, j->e[i], false), to;

        for (uint32_t k = 0; atoms != QDOT_NIL && k < qdot_expr_count(pool, atoms); k++) {
            qdot_expr x = qdot_expr_arg(pool, atoms, k);

            if (qdot_expr_is_class(pool, x, QDOT_CONST))
                continue;
            if (solve_linear(pool, j->e[i], x, &to)) {
                QDOT_TRY(keep_bounds_as_conditions(j, x));
                domain_replace(j, x, to);
                j->e[i] = QDOT_ZERO;
                break;
            }
            if (qdot_pool_failed(pool))
                QDOT_TRY(qdot_grave(qdot_pool_check(pool)));
        }
    }
    return QDOT_OK;
}

/* --- the whole elimination ------------------------------------------------------ */

static qdot_status
add_reported_condition(void *user, qdot_expr gap, bool weak)
{
    job *j = user;

    for (size_t i = 0; i < j->gap.n; i++)
        if (j->gap.at[i] == gap && j->weak.at[i] <= weak)
            return QDOT_OK;
    return add_domain_condition(j, gap, weak);
}

/* Add the conditions under which both sides are defined, and simpler conditions into which given ones split. */
static qdot_status
gather_implied_conditions(job *j, const qdot_facts *facts)
{
    size_t given = j->gap.n;

    for (size_t i = 0; i < given; i++)
        QDOT_TRY(qdot_defined_apart(j->pool, j->gap.at[i], j->weak.at[i], add_reported_condition, j));
    if (facts != NULL && facts->defined != QDOT_NIL)
        QDOT_TRY(qdot_defined(j->pool, 1, &facts->defined, add_reported_condition, j));
    return qdot_defined(j->pool, 2, j->e, add_reported_condition, j);
}

/* Collect the conditions, and the declared bounds that contain symbols. */
static qdot_status
domain_gather(job *j, const qdot_facts *facts, qdot_expr atoms)
{
    qdot_pool *pool = j->pool;

    for (size_t i = 0; facts != NULL && i < facts->n_conditions; i++) {
        qdot_expr c = facts->conditions[i];

        if (qdot_expr_kind(pool, c) != QDOT_REL || qdot_expr_node(pool, c)->op == QDOT_EQ)
            continue;
        QDOT_TRY(add_domain_condition(
            j, qdot_sub(pool, qdot_expr_arg(pool, c, 1), qdot_expr_arg(pool, c, 0)),
            qdot_expr_node(pool, c)->op == QDOT_LE));
    }
    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms); i++) {
        qdot_expr x = qdot_expr_arg(pool, atoms, i);
        qdot_symbol s = *qdot_expr_symbol(pool, x);

        if (s.lo != QDOT_NIL && !qdot_expr_is_constant(pool, s.lo))
            QDOT_TRY(add_domain_condition(j, qdot_sub(pool, x, s.lo), !s.lo_open));
        if (s.hi != QDOT_NIL && !qdot_expr_is_constant(pool, s.hi))
            QDOT_TRY(add_domain_condition(j, qdot_sub(pool, s.hi, x), !s.hi_open));
    }
    return QDOT_OK;
}

static void
move_declared_bounds(job *j, qdot_expr atoms)
{
    for (uint32_t i = 0; i < qdot_expr_count(j->pool, atoms); i++) {
        qdot_expr x = qdot_expr_arg(j->pool, atoms, i);
        qdot_symbol s = *qdot_expr_symbol(j->pool, x);

        if ((s.lo != QDOT_NIL && !qdot_expr_is_constant(j->pool, s.lo)) ||
            (s.hi != QDOT_NIL && !qdot_expr_is_constant(j->pool, s.hi)))
            continue;
        if (s.lo != QDOT_NIL || s.hi != QDOT_NIL)
            domain_move_bounds(j, x, s);
    }
}

qdot_status
qdot_domain_unfold(qdot_pool *pool, const qdot_facts *facts, size_t n, qdot_expr *e,
                   size_t nr, bool implied, qdot_domain_rest *rest)
{
    job j = {.pool = pool, .n = n, .e = e};
    qdot_expr list = qdot_list(pool, (uint32_t)n, e);
    qdot_expr atoms = qdot_expr_atoms(pool, list, false);
    qdot_status status = atoms == QDOT_NIL ? qdot_pool_check(pool) : QDOT_OK;

    *rest = (qdot_domain_rest){0};
    if (status == QDOT_OK && atoms != QDOT_NIL)
        status = domain_gather(&j, facts, atoms);
    if (status == QDOT_OK && implied)
        status = gather_implied_conditions(&j, facts);
    if (status == QDOT_OK)
        status = solve_relations(&j, nr);
    for (size_t i = 0; i < j.gap.n && status == QDOT_OK; i++) {
        qdot_expr gap = j.gap.at[i];

        j.gap.at[i] = QDOT_NIL; /* remove the condition gap > 0 (or gap >= 0), unless it is put back */
        if (gap != QDOT_NIL && qdot_expr_is_scalar(pool, gap)) {
            uint8_t sign = qdot_expr_node(pool, gap)->sign;

            j.empty |= (sign & QDOT_LE0) && (!j.weak.at[i] || (sign & QDOT_NE0));
        }
        if (gap != QDOT_NIL && !solve_condition(&j, gap, j.weak.at[i]) && !j.weak.at[i])
            j.gap.at[i] = gap;
    }
    if (status == QDOT_OK && !qdot_pool_failed(pool)) {
        list = qdot_list(pool, (uint32_t)n, e);
        atoms = qdot_expr_atoms(pool, list, false);
        if (atoms != QDOT_NIL)
            move_declared_bounds(&j, atoms);
    }
    for (size_t i = 0; i < j.gap.n && status == QDOT_OK; i++)
        if (j.gap.at[i] != QDOT_NIL)
            status = qdot_vec_push(&rest->positive, j.gap.at[i]);
    rest->empty = j.empty;
    qdot_free(j.gap.at);
    qdot_free(j.weak.at);
    return status;
}
