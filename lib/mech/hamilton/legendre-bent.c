/* legendre-bent.c -- y = dF/dx solved for x where F is not quadratic in x. */
#include "mech/hamilton/legendre.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/linear.h"
#include "normal/solve/solve-factors.h"
#include "normal/solve/solve.h"

enum { MOST_CONDITIONS = 32 }; /* with more the condition of positive roots is not used */

typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    qdot_expr F;
    uint32_t n;
    const qdot_expr *x, *y;
    qdot_expr *solved; /* [n] */
    qdot_expr u;       /* a symbol for the value of a quadratic form */
    qdot_expr there;   /* F at the solution */
    qdot_expr positive; /* what is > 0 where F is real; nil: none is known */
} block;

/* F as f(u) + b.x, u = Q(x) with the second derivatives B. */
typedef struct {
    qdot_expr Q, f, slope; /* f with the symbol u, and df/du */
    qdot_expr *B, *b, *x0, *X; /* [n*n], [n] each: dF/dx at fixed u; the place where dQ/dx = 0; B^-1 (y - b) */
} form;

static bool
holds_any(const block *k, qdot_expr e)
{
    return qdot_expr_contains_any(k->pool, e, k->n, k->x);
}

static qdot_expr
simple(const block *k, qdot_expr e)
{
    return qdot_simplify(k->pool, e, k->facts);
}

/* Whether Q is of second degree in x: write its second derivatives to B. */
static bool
is_quadratic(const block *k, qdot_expr Q, qdot_expr *B)
{
    bool any = false;

    for (uint32_t i = 0; i < k->n; i++) {
        const qdot_expr slope = qdot_diff(k->pool, Q, k->x[i]);

        for (uint32_t j = 0; j < k->n; j++) {
            const qdot_expr e = simple(k, qdot_diff(k->pool, slope, k->x[j]));

            if (e == QDOT_NIL || holds_any(k, e))
                return false;
            any |= e != QDOT_ZERO;
            B[i * k->n + j] = e;
        }
    }
    return any;
}

/* Whether F is f(u) + b.x with the node Q as u; write f and b. */
static bool
is_function_of(const block *k, qdot_expr Q, form *m)
{
    m->Q = Q;
    m->f = qdot_subs(k->pool, k->F, 1, &Q, &k->u);
    m->slope = qdot_diff(k->pool, m->f, k->u);
    if (m->slope == QDOT_NIL || holds_any(k, m->slope))
        return false;
    for (uint32_t i = 0; i < k->n; i++) {
        m->b[i] = simple(k, qdot_diff(k->pool, m->f, k->x[i]));
        if (m->b[i] == QDOT_NIL || holds_any(k, m->b[i]) || qdot_expr_contains(k->pool, m->b[i], k->u))
            return false;
    }
    return true;
}

/* Find a node Q of F of which F is a function, beside terms linear in x. */
static qdot_status
find_quadratic_inside(const block *k, form *m, bool *found)
{
    qdot_walk w;

    *found = false;
    QDOT_TRY(qdot_walk_begin(k->pool, k->F, &w));
    /* products after sums: a root of a product of two linear sums */
    for (size_t i = 0; i < 2 * w.n && !*found && !qdot_pool_failed(k->pool); i++) {
        const qdot_expr e = w.at[i % w.n];

        *found = e != k->F && qdot_expr_kind(k->pool, e) == (i < w.n ? QDOT_SUM : QDOT_PROD) && holds_any(k, e) &&
                 is_function_of(k, e, m) && is_quadratic(k, e, m->B);
    }
    qdot_walk_end(&w);
    return qdot_pool_check(k->pool);
}

/* e with x at the values `at`. */
static qdot_expr
put(const block *k, qdot_expr e, const qdot_expr *at)
{
    return qdot_subs(k->pool, e, k->n, k->x, at);
}

/* Whether k->solved is proved to fulfil y = dF/dx, where F is real. */
static bool
is_solution_proved(const block *k)
{
    qdot_expr conditions[MOST_CONDITIONS + 1];
    qdot_facts facts = *k->facts;

    if (k->positive != QDOT_NIL && facts.n_conditions < MOST_CONDITIONS) {
        for (size_t i = 0; i < facts.n_conditions; i++)
            conditions[i] = facts.conditions[i];
        conditions[facts.n_conditions++] = qdot_rel(k->pool, QDOT_LT, QDOT_ZERO, k->positive);
        facts.conditions = conditions;
    }
    for (uint32_t i = 0; i < k->n; i++) {
        const qdot_expr slope = put(k, qdot_diff(k->pool, k->F, k->x[i]), k->solved);

        if (slope == QDOT_NIL || !qdot_is_zero(k->pool, qdot_sub(k->pool, k->y[i], slope), &facts))
            return false;
    }
    return true;
}

/* Keep the one root that is proved; from a root follow the values of x by `fill`. */
static qdot_status
choose_root(block *k, qdot_expr equation, qdot_expr unknown, void (*fill)(block *k, qdot_expr root, void *user),
            void *user, bool *found)
{
    qdot_solutions roots = {0};
    qdot_status status = qdot_solve(k->pool, equation, unknown, k->facts, &roots);
    size_t good = 0, which = 0;

    for (size_t i = 0; status == QDOT_OK && i < roots.root.n; i++) {
        if (roots.root.at[i].period != QDOT_NIL || roots.root.at[i].value == unknown)
            continue;
        fill(k, roots.root.at[i].value, user);
        if (is_solution_proved(k)) {
            which = i;
            good++;
        }
        status = qdot_pool_check(k->pool);
    }
    *found = status == QDOT_OK && good == 1;
    if (*found)
        fill(k, roots.root.at[which].value, user);
    qdot_solutions_clear(&roots);
    return status == QDOT_OK ? qdot_pool_check(k->pool) : status;
}

/* Whether f holds a root of u, so that u > 0. */
static bool
holds_root_of_u(const block *k, qdot_expr f)
{
    qdot_walk w;
    bool root = false;
    int64_t whole;

    if (f == QDOT_NIL || qdot_walk_begin(k->pool, f, &w) != QDOT_OK)
        return false;
    for (size_t i = 0; i < w.n && !root; i++)
        for (uint32_t j = 1; qdot_expr_kind(k->pool, w.at[i]) == QDOT_PROD && j < qdot_expr_count(k->pool, w.at[i]); j += 2)
            root |= qdot_expr_arg(k->pool, w.at[i], j) == k->u &&
                    !qdot_expr_to_int(k->pool, qdot_expr_arg(k->pool, w.at[i], j + 1), &whole);
    qdot_walk_end(&w);
    return root;
}

/* e at the value u of the form. Where u stands under a root it is positive, and so is w = 1/u, in which roots are written:
 * sqrt(1/(1 - v^2)) becomes 1/sqrt(1 - v^2). */
static qdot_expr
at_root(const block *k, qdot_expr e, qdot_expr root)
{
    qdot_expr w, inverse;

    if (!holds_root_of_u(k, e))
        return qdot_subs(k->pool, e, 1, &k->u, &root);
    w = qdot_symbol_get(k->pool, QDOT_FORMAL, "(inverse form)");
    qdot_symbol_domain(k->pool, w, QDOT_ZERO, true, QDOT_NIL, false);
    inverse = qdot_pow_int(k->pool, w, -1);
    e = qdot_subs(k->pool, e, 1, &k->u, &inverse);
    inverse = simple(k, qdot_pow_int(k->pool, root, -1));
    return qdot_subs(k->pool, e, 1, &w, &inverse);
}

/* x = x0 + X/f'(u), and F there. */
static void
fill_from_u(block *k, qdot_expr root, void *user)
{
    const form *m = user;
    qdot_expr slope;

    root = simple(k, root);
    slope = at_root(k, m->slope, root);
    for (uint32_t i = 0; i < k->n; i++)
        k->solved[i] = simple(k, qdot_add(k->pool, m->x0[i], qdot_div(k->pool, m->X[i], slope)));
    k->there = put(k, at_root(k, m->f, root), k->solved);
    k->positive = holds_root_of_u(k, m->f) ? qdot_pow_int(k->pool, root, -1) : QDOT_NIL;
}

static void
fill_itself(block *k, qdot_expr root, void *user)
{
    (void)user;
    k->solved[0] = simple(k, root);
    k->there = put(k, k->F, k->solved);
}

/* F = f(u) + b.x: solve for u, then for x. */
static qdot_status
solve_by_form(block *k, form *m, bool *found, qdot_expr *bound)
{
    qdot_pool *pool = k->pool;
    const uint32_t n = k->n;
    qdot_expr lowest, K = QDOT_ZERO, equation;
    uint32_t pivot;
    qdot_status status;

    *found = false;
    for (uint32_t i = 0; i < n; i++) {
        m->x0[i] = qdot_diff(pool, m->Q, k->x[i]);
        for (uint32_t j = 0; j < n; j++)
            m->x0[i] = qdot_subs(pool, m->x0[i], 1, &k->x[j], (qdot_expr[]){QDOT_ZERO});
        m->x0[i] = qdot_neg(pool, m->x0[i]);
        m->X[i] = qdot_sub(pool, k->y[i], m->b[i]);
    }
    QDOT_TRY(qdot_pool_check(pool));
    for (int both = 0; both < 2; both++) {
        qdot_expr *v = both == 0 ? m->x0 : m->X;

        status = qdot_solve_linear(pool, n, m->B, v, k->solved, &pivot, k->facts);
        if (status == QDOT_ESINGULAR || status == QDOT_ELIMIT)
            return QDOT_OK;
        QDOT_TRY(status);
        for (uint32_t i = 0; i < n; i++) {
            if (both == 1)
                K = qdot_add(pool, K, qdot_mul(pool, QDOT_HALF, qdot_mul(pool, v[i], k->solved[i])));
            v[i] = k->solved[i];
        }
    }
    lowest = simple(k, put(k, m->Q, m->x0));
    K = simple(k, qdot_div(pool, K, qdot_mul(pool, m->slope, m->slope)));
    if (lowest == QDOT_ZERO) { /* homogeneous in x: with Q of second degree f'(u)^-2 is c u, and 1 = K/u holds no u */
        const qdot_expr gap = qdot_sub(pool, QDOT_ONE, qdot_div(pool, K, k->u)), one = QDOT_ONE;

        if (qdot_is_zero(pool, qdot_diff(pool, gap, k->u), k->facts)) {
            *bound = simple(k, qdot_subs(pool, gap, 1, &k->u, &one));
            return qdot_pool_check(pool);
        }
    }
    equation = qdot_sub(pool, k->u, qdot_add(pool, lowest, K));
    QDOT_TRY(qdot_pool_check(pool));
    return choose_root(k, equation, k->u, fill_from_u, m, found);
}

qdot_expr
qdot_legendre_terms_without(qdot_pool *pool, qdot_expr e, uint32_t n, const qdot_expr *x)
{
    const bool several = e != QDOT_NIL && qdot_expr_kind(pool, e) == QDOT_SUM;
    qdot_expr sum = several ? qdot_expr_arg(pool, e, 0) : QDOT_ZERO;

    if (!several)
        return e == QDOT_NIL || qdot_expr_contains_any(pool, e, n, x) ? sum : e;
    for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2)
        if (!qdot_expr_contains_any(pool, qdot_expr_arg(pool, e, i), n, x))
            sum = qdot_add(pool, sum, qdot_mul(pool, qdot_expr_arg(pool, e, i + 1), qdot_expr_arg(pool, e, i)));
    return sum;
}

/* Whether a = b is proved; by cases of signs, too, as abs(x) = x sign(x). */
static bool
is_equal_in_cases(const block *k, qdot_expr a, qdot_expr b)
{
    qdot_decision decision;

    if (a == QDOT_NIL || b == QDOT_NIL)
        return false;
    if (qdot_decide_equal(k->pool, a, b, k->facts, &decision) != QDOT_OK)
        return qdot_pool_fail(k->pool) != QDOT_NIL;
    return decision.verdict == QDOT_PROVED;
}

qdot_expr
qdot_legendre_lower(qdot_pool *pool, qdot_expr F, uint32_t n, const qdot_expr *x, const qdot_facts *facts)
{
    const block k = {.pool = pool, .facts = facts, .n = n, .x = x};
    const qdot_expr lower = qdot_legendre_terms_without(pool, F, n, x);
    qdot_expr rest = F;

    for (uint32_t i = 0; i < n; i++)
        rest = qdot_sub(pool, rest, qdot_mul(pool, x[i], qdot_diff(pool, F, x[i])));
    rest = qdot_simplify(pool, rest, facts);
    return rest == lower || (qdot_expr_has_function_of(pool, rest, n, x) && is_equal_in_cases(&k, rest, lower)) ? lower : rest;
}

/* What F - x.dF/dx says where it does not vary with x: FIRST where it holds none; where it is such as x sign(x - a) of
 * F = abs(x - a), the second derivatives are 0, and F is not homogeneous. */
static qdot_legendre_degree
find_degree(const block *k)
{
    const qdot_expr lower = qdot_legendre_lower(k->pool, k->F, k->n, k->x, k->facts);

    for (uint32_t i = 0; i < k->n; i++)
        if (!qdot_is_zero(k->pool, qdot_diff(k->pool, lower, k->x[i]), k->facts))
            return QDOT_LEGENDRE_REGULAR;
    return qdot_expr_has_function_of(k->pool, lower, k->n, k->x) ? QDOT_LEGENDRE_SINGULAR : QDOT_LEGENDRE_FIRST;
}

/* What is 0 where e is: the product of the factors of its numerator. */
static qdot_expr
numerator(const block *k, qdot_expr e)
{
    const qdot_expr list = qdot_solve_factors(k->pool, e);
    qdot_expr all = QDOT_ONE;

    for (uint32_t i = 0; i < qdot_expr_count(k->pool, list); i++)
        all = qdot_mul(k->pool, all, qdot_expr_arg(k->pool, list, i));
    return all;
}

qdot_status
qdot_legendre_bent(qdot_pool *pool, qdot_expr F, uint32_t n, const qdot_expr *x, const qdot_expr *y,
                   const qdot_facts *facts, qdot_expr *solved, qdot_legendre_degree *degree, qdot_expr *bound, qdot_expr *there)
{
    block k = {.pool = pool,
               .facts = facts,
               .F = F,
               .n = n,
               .x = x,
               .y = y,
               .solved = solved,
               .u = qdot_symbol_get(pool, QDOT_FORMAL, "(form)")};
    form m = {.B = qdot_calloc((size_t)n * n + 3 * n, sizeof *m.B)};
    qdot_status status = m.B == NULL ? QDOT_ENOMEM : qdot_pool_check(pool);
    bool by_form = false, found = false;

    *degree = QDOT_LEGENDRE_REGULAR;
    *bound = *there = QDOT_NIL;
    if (m.B != NULL) {
        m.b = m.B + (size_t)n * n;
        m.x0 = m.b + n;
        m.X = m.x0 + n;
        *degree = find_degree(&k);
    }
    if (status == QDOT_OK)
        status = find_quadratic_inside(&k, &m, &by_form);
    if (status == QDOT_OK && by_form)
        status = solve_by_form(&k, &m, &found, bound);
    if (status == QDOT_OK && *bound != QDOT_NIL) {
        *bound = numerator(&k, *bound);
        *degree = *degree == QDOT_LEGENDRE_REGULAR ? QDOT_LEGENDRE_SINGULAR : *degree;
    }
    if (status == QDOT_OK && !found && *degree == QDOT_LEGENDRE_REGULAR && n == 1)
        status = choose_root(&k, qdot_sub(pool, y[0], qdot_diff(pool, F, x[0])), x[0], fill_itself, NULL, &found);
    *there = found ? k.there : QDOT_NIL;
    qdot_free(m.B);
    return status;
}
