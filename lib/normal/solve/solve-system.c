/* solve-system.c -- elimination by resultants, one unknown after another. */
#include "normal/solve/solve-system.h"

#include <math.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/refute/ball.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solve.h"

enum { MOST = QDOT_SOLVE_UNKNOWNS, DEGREE = 6, CHOICES = 64, SIZE = 3000 };

/* Equations left, with values found so far. */
typedef struct {
    size_t n; /* equations */
    qdot_expr f[MOST];
    qdot_expr value[MOST]; /* of u [i]; nil: not known yet */
} branch;

typedef struct {
    qdot_pool *pool;
    size_t n;
    const qdot_expr *f, *u;
    const qdot_facts *facts;
    qdot_vec(branch) found;
    bool complete;
} search;

static qdot_status solve_branch(search *s, branch b);

static size_t
count_unknowns(const search *s, qdot_expr e, size_t *which)
{
    size_t count = 0;

    for (size_t i = 0; i < s->n; i++)
        if (qdot_expr_contains(s->pool, e, s->u[i])) {
            *which = i;
            count++;
        }
    return count;
}

/* Drop equations that hold; *dead: one cannot hold, for generic parameters. */
static qdot_status
tidy(search *s, branch *b, bool *dead)
{
    size_t kept = 0, which;

    *dead = false;
    for (size_t i = 0; i < b->n; i++) {
        bool zero = b->f[i] == QDOT_ZERO || qdot_is_zero(s->pool, b->f[i], s->facts);

        QDOT_TRY(qdot_pool_check(s->pool));
        if (zero)
            continue;
        if (count_unknowns(s, b->f[i], &which) == 0) {
            qdot_decision seen;

            QDOT_TRY(qdot_decide_equal(s->pool, b->f[i], QDOT_ZERO, s->facts, &seen));
            if (seen.verdict == QDOT_REFUTED)
                *dead = true;
            else if (seen.verdict == QDOT_UNDECIDED)
                s->complete = false;
            if (seen.verdict != QDOT_PROVED)
                *dead = true;
            continue;
        }
        b->f[kept++] = b->f[i];
    }
    b->n = kept;
    return QDOT_OK;
}

/* u [which] = value put into all. A value at which an equation is undefined solves nothing. */
static qdot_status
put(search *s, branch *b, size_t which, qdot_expr value, bool *defined)
{
    *defined = true;
    for (size_t i = 0; i < b->n; i++)
        b->f[i] = qdot_subs(s->pool, b->f[i], 1, &s->u[which], &value);
    b->value[which] = value;
    qdot_status status = qdot_pool_check(s->pool);

    *defined = status == QDOT_OK;
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}

/* Whether e waves with x: then its roots are given within one turn of x. */
static bool
waves(search *s, qdot_expr e, qdot_expr x)
{
    bool found = false;
    qdot_walk w;

    if (qdot_walk_begin(s->pool, e, &w) != QDOT_OK)
        return true;
    for (size_t i = 0; i < w.n && !found; i++)
        if (qdot_expr_kind(s->pool, w.at[i]) == QDOT_FUN)
            switch (qdot_expr_node(s->pool, w.at[i])->op) {
            case QDOT_SIN:
            case QDOT_COS:
            case QDOT_TAN:
            case QDOT_COT:
            case QDOT_SEC:
            case QDOT_CSC: found = qdot_expr_contains(s->pool, w.at[i], x); break;
            default: break;
            }
    qdot_walk_end(&w);
    return found;
}

/* Whether all equations stay as they are after a full turn of x. */
static bool
is_angle(search *s, qdot_expr x)
{
    qdot_expr turn = qdot_mul(s->pool, qdot_expr_int(s->pool, 2), QDOT_PI);

    return qdot_is_period(s->pool, s->n, s->f, x, turn, s->facts);
}

/* The k-th equation holds one unknown only: each of its roots. Ranges and roots with conditions are not followed. */
static qdot_status
solve_one(search *s, const branch *b, size_t k, size_t which)
{
    qdot_solutions found;
    bool defined;
    qdot_status status =
        qdot_solve_inside(s->pool, b->f[k], s->u[which], QDOT_NIL, s->facts, &found);

    if (status == QDOT_OK &&
        (!found.complete || (waves(s, b->f[k], s->u[which]) && !is_angle(s, s->u[which]))))
        s->complete = false;
    for (size_t i = 0; i < found.root.n && status == QDOT_OK; i++) {
        branch next = *b;

        if (found.root.at[i].condition != QDOT_NIL || found.root.at[i].value == s->u[which]) {
            s->complete = false;
            continue;
        }
        next.f[k] = next.f[--next.n];
        status = put(s, &next, which, found.root.at[i].value, &defined);
        if (status == QDOT_OK && defined)
            status = solve_branch(s, next);
    }
    qdot_solutions_clear(&found);
    return status;
}

/* The coefficients of e as a polynomial in x; -1: it is none. */
static int
coefficients(search *s, qdot_expr e, qdot_expr x, qdot_expr *c)
{
    qdot_expr left = qdot_expand(s->pool, e);
    int degree = -1;

    for (int k = 0; k <= DEGREE && left != QDOT_ZERO && left != QDOT_NIL; k++) {
        c[k] = qdot_subs(s->pool, left, 1, &x, &(qdot_expr){QDOT_ZERO});
        if (c[k] == QDOT_NIL || qdot_expr_contains(s->pool, c[k], x))
            break;
        left = qdot_expand(s->pool, qdot_div(s->pool, qdot_sub(s->pool, left, c[k]), x));
        degree = k;
    }
    if (qdot_pool_check(s->pool) != QDOT_OK || left != QDOT_ZERO)
        return -1;
    return degree;
}

/* det of Sylvester's matrix of a, degree m, and b, degree n. */
static qdot_expr
resultant(qdot_pool *pool, const qdot_expr *a, int m, const qdot_expr *b, int n)
{
    qdot_expr entry[4 * DEGREE * DEGREE];
    int size = m + n;

    for (int i = 0; i < size; i++)
        for (int j = 0; j < size; j++) {
            int k = i < n ? m - (j - i) : n - (j - (i - n));

            entry[i * size + j] = i < n ? (k >= 0 && k <= m ? a[k] : QDOT_ZERO)
                                        : (k >= 0 && k <= n ? b[k] : QDOT_ZERO);
        }
    if (size == 1)
        return entry[0];
    return qdot_det(pool, qdot_matrix(pool, (uint32_t)size, (uint32_t)size, entry));
}

/* Eliminate u [which] from the equations; false: it stands in one that is no polynomial, or in one only. */
static qdot_status
eliminate(search *s, const branch *b, size_t which, branch *to, bool *done)
{
    qdot_expr c[MOST][DEGREE + 1];
    int degree[MOST];
    size_t pivot = b->n, holding = 0;

    *done = false;
    *to = *b;
    to->n = 0;
    for (size_t i = 0; i < b->n; i++) {
        degree[i] = qdot_expr_contains(s->pool, b->f[i], s->u[which])
                        ? coefficients(s, b->f[i], s->u[which], c[i])
                        : 0;
        if (degree[i] < 0)
            return QDOT_OK;
        holding += degree[i] > 0;
        if (degree[i] > 0 && (pivot == b->n || degree[i] < degree[pivot]))
            pivot = i;
    }
    if (holding < 2)
        return QDOT_OK;
    for (size_t i = 0; i < b->n; i++) {
        qdot_expr r;

        if (i == pivot)
            continue;
        r = degree[i] == 0 ? b->f[i]
                           : resultant(s->pool, c[pivot], degree[pivot], c[i], degree[i]);
        QDOT_TRY(qdot_pool_check(s->pool));
        if (qdot_expr_size(s->pool, r) > SIZE || qdot_is_zero(s->pool, r, s->facts))
            return qdot_pool_check(s->pool);
        to->f[to->n++] = r;
    }
    *done = true;
    return qdot_pool_check(s->pool);
}

/* The other unknowns from the resultants, then the branch with their values. */
static qdot_status
solve_rest(search *s, const branch *b, const branch *without)
{
    search inner = *s;
    qdot_status status;

    inner.found.at = NULL;
    inner.found.n = inner.found.capacity = 0;
    status = solve_branch(&inner, *without);
    s->complete &= inner.complete;
    for (size_t k = 0; k < inner.found.n && status == QDOT_OK; k++) {
        branch next = *b;
        bool defined = true;

        for (size_t i = 0; i < s->n && status == QDOT_OK && defined; i++)
            if (b->value[i] == QDOT_NIL && inner.found.at[k].value[i] != QDOT_NIL)
                status = put(s, &next, i, inner.found.at[k].value[i], &defined);
        if (status == QDOT_OK && defined)
            status = solve_branch(s, next);
    }
    qdot_free(inner.found.at);
    return status;
}

/* Every choice of one factor of each equation; *split: there is more than one. */
static qdot_status
split(search *s, const branch *b, bool *is_split)
{
    qdot_expr lists[MOST];
    size_t all = 1;

    *is_split = false;
    for (size_t i = 0; i < b->n; i++) {
        lists[i] = qdot_solve_factors(s->pool, b->f[i]);
        QDOT_TRY(qdot_pool_check(s->pool));
        all *= qdot_expr_count(s->pool, lists[i]);
        if (all > CHOICES)
            return QDOT_OK;
    }
    *is_split = all != 1;
    for (size_t k = 0; k < all && *is_split; k++) {
        branch one = *b;
        size_t at = k;

        for (size_t i = 0; i < b->n; i++) {
            size_t m = qdot_expr_count(s->pool, lists[i]);

            one.f[i] = qdot_expr_arg(s->pool, lists[i], (uint32_t)(at % m));
            at /= m;
        }
        QDOT_TRY(solve_branch(s, one));
    }
    return QDOT_OK;
}

static qdot_status
solve_branch(search *s, branch b)
{
    bool dead, is_split, done;
    size_t which = 0;

    QDOT_TRY(qdot_interrupt_check());
    QDOT_TRY(tidy(s, &b, &dead));
    if (dead)
        return QDOT_OK;
    if (b.n == 0)
        return qdot_vec_push(&s->found, b);
    for (size_t k = 0; k < b.n; k++)
        if (count_unknowns(s, b.f[k], &which) == 1)
            return solve_one(s, &b, k, which);
    QDOT_TRY(split(s, &b, &is_split));
    if (is_split)
        return QDOT_OK;
    for (size_t i = 0; i < s->n; i++) {
        branch without;

        if (b.value[i] != QDOT_NIL)
            continue;
        QDOT_TRY(eliminate(s, &b, i, &without, &done));
        if (done)
            return solve_rest(s, &b, &without);
    }
    s->complete = false;
    return QDOT_OK;
}

/* The solution b as equations, put back into all of f; nil: it is none. */
static qdot_status
solution_of(search *s, const branch *b, qdot_expr *solution)
{
    qdot_expr equation[MOST], value[MOST];

    *solution = QDOT_NIL;
    for (size_t i = 0; i < s->n; i++) {
        if (b->value[i] == QDOT_NIL) { /* any value: a curve of solutions */
            s->complete = false;
            return QDOT_OK;
        }
        value[i] = qdot_simplify(s->pool, b->value[i], s->facts);
        equation[i] = qdot_rel(s->pool, QDOT_EQ, s->u[i], value[i]);
    }
    QDOT_TRY(qdot_pool_check(s->pool));
    for (size_t k = 0; k < s->n; k++) {
        qdot_expr at = qdot_subs(s->pool, s->f[k], s->n, s->u, value);
        qdot_status status = qdot_pool_check(s->pool);
        qdot_decision seen;

        if (status == QDOT_EDOMAIN)
            return QDOT_OK;
        QDOT_TRY(status);
        QDOT_TRY(qdot_decide_equal(s->pool, at, QDOT_ZERO, s->facts, &seen));
        if (seen.verdict == QDOT_UNDECIDED)
            s->complete = false;
        if (seen.verdict != QDOT_PROVED)
            return QDOT_OK;
    }
    *solution = qdot_list(s->pool, (uint32_t)s->n, equation);
    return qdot_pool_check(s->pool);
}

/* Whether solution a stands before b: by the first value that differs, where both are constants. */
static bool
is_before(const search *s, qdot_expr a, qdot_expr b)
{
    for (uint32_t i = 0; i < s->n; i++) {
        double x, y;

        if (!qdot_ball_double(s->pool,
                              qdot_expr_arg(s->pool, qdot_expr_arg(s->pool, a, i), 1),
                              NULL, NULL, &x) ||
            !qdot_ball_double(s->pool,
                              qdot_expr_arg(s->pool, qdot_expr_arg(s->pool, b, i), 1),
                              NULL, NULL, &y))
            return false;
        if (fabs(x - y) > 1e-12 * (1 + fabs(x)))
            return x < y;
    }
    return false;
}

static void
sort(const search *s, size_t n, qdot_expr *list)
{
    for (size_t a = 1; a < n; a++)
        for (size_t b = a; b > 0 && is_before(s, list[b], list[b - 1]); b--) {
            qdot_expr keep = list[b];

            list[b] = list[b - 1];
            list[b - 1] = keep;
        }
}

qdot_status
qdot_solve_system(qdot_pool *pool, size_t n, const qdot_expr *f, const qdot_expr *u,
                  const qdot_facts *facts, qdot_expr *list, bool *complete)
{
    search s = {.pool = pool, .n = n, .f = f, .u = u, .facts = facts, .complete = true};
    branch first = {.n = n};
    qdot_vec(qdot_expr) members = {0};
    qdot_status status;

    if (n == 0 || n > MOST)
        return qdot_fail(QDOT_ETYPE, "up to %d equations are solved together", MOST);
    for (size_t i = 0; i < n; i++)
        first.f[i] = f[i];
    status = solve_branch(&s, first);
    for (size_t k = 0; k < s.found.n && status == QDOT_OK; k++) {
        qdot_expr one;

        status = solution_of(&s, &s.found.at[k], &one);
        if (status == QDOT_OK && one != QDOT_NIL &&
            qdot_expr_place(members.n, members.at, one) == members.n)
            status = qdot_vec_push(&members, one);
    }
    if (status == QDOT_OK) {
        sort(&s, members.n, members.at);
        *list = qdot_list(pool, (uint32_t)members.n, members.at);
        *complete = s.complete;
        status = qdot_pool_check(pool);
    }
    qdot_free(members.at);
    qdot_free(s.found.at);
    return status;
}
