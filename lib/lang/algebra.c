/* algebra.c -- replacements, solutions, factors, series, eigenvalues. */
#include "lang/algebra.h"

#include "base/memory.h"
#include "base/text.h"
#include "expr/calculus.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "lang/code.h"
#include "normal/solve.h"

static qdot_status
give(qdot_session *s, qdot_expr result, qdot_expr *value)
{
    *value = result;
    return qdot_resolve_check(s->pool, result);
}

static bool
is_equation(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_kind(pool, e) == QDOT_REL && qdot_expr_node(pool, e)->op == QDOT_EQ;
}

/* --- subs --------------------------------------------------------------------------- */

typedef struct {
    qdot_vec(qdot_expr) from, to;
} replacements;

/* Take the equation, or those in a list or vector, as replacements. */
static qdot_status
gather(qdot_session *s, const char *name, qdot_expr e, replacements *r)
{
    qdot_kind kind = qdot_expr_kind(s->pool, e);
    bool many = kind == QDOT_LIST || kind == QDOT_VEC;
    uint32_t n = many ? qdot_expr_count(s->pool, e) : 1;

    for (uint32_t i = 0; i < n; i++) {
        qdot_expr one = many ? qdot_expr_arg(s->pool, e, i) : e, left;

        if (!is_equation(s->pool, one)) {
            qdot_fail(QDOT_ETYPE, "%s takes equations, not %s", name,
                      qdot_resolve_kind(s->pool, one));
            return qdot_hint("as in %s", qdot_builtin_find(name)->usage);
        }
        left = qdot_expr_arg(s->pool, one, 0);
        if (qdot_expr_kind(s->pool, left) == QDOT_NUM)
            return qdot_fail(QDOT_ETYPE, "%s cannot replace a number", name);
        QDOT_TRY(qdot_vec_push(&r->from, left));
        QDOT_TRY(qdot_vec_push(&r->to, qdot_expr_arg(s->pool, one, 1)));
    }
    return QDOT_OK;
}

qdot_status
qdot_algebra_subs(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    replacements r = {0};
    qdot_status status = QDOT_OK;

    for (uint32_t i = 1; i < n && status == QDOT_OK; i++)
        status = gather(s, "subs", args[i], &r);
    if (status == QDOT_OK)
        status =
            give(s, qdot_subs(s->pool, args[0], r.from.n, r.from.at, r.to.at), value);
    qdot_free(r.from.at);
    qdot_free(r.to.at);
    return status;
}

/* --- factor, solve, series, eigenvalues --------------------------------------------- */

qdot_status
qdot_algebra_factor(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    (void)n;
    return give(s, qdot_solve_product(s->pool, args[0]), value);
}

/* solve(a = b, x), solve(e, x) of e = 0: the values of x, a list. */
qdot_status
qdot_algebra_solve(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    qdot_facts facts = qdot_scene_facts(s->scene);
    qdot_expr f = is_equation(s->pool, args[0])
                      ? qdot_sub(s->pool, qdot_expr_arg(s->pool, args[0], 0),
                                 qdot_expr_arg(s->pool, args[0], 1))
                      : args[0];
    qdot_root *roots = NULL;
    qdot_expr *values;
    size_t count = 0;
    bool complete;

    (void)n;
    if (qdot_expr_kind(s->pool, args[1]) != QDOT_SYM || args[1] <= QDOT_FALSE)
        return qdot_fail(QDOT_ETYPE, "solve(a = b, x) takes a symbol for x");
    if (!qdot_expr_is_scalar(s->pool, f))
        return qdot_fail(QDOT_ETYPE, "solve takes an equation between numbers, not %s",
                         qdot_resolve_kind(s->pool, args[0]));
    QDOT_TRY(qdot_solve(s->pool, f, args[1], &facts, &roots, &count, &complete));
    if (!complete) {
        qdot_free(roots);
        qdot_fail(QDOT_EFAILED, "this equation cannot be solved exactly%s",
                  count > 0 ? " for every x" : "");
        return qdot_hint("linear, quadratic, factorable and trigonometric equations can");
    }
    values = qdot_malloc((count + 1) * sizeof *values);
    for (size_t i = 0; values != NULL && i < count; i++)
        values[i] = roots[i].value;
    *value = values == NULL ? qdot_pool_fail(s->pool)
                            : qdot_list(s->pool, (uint32_t)count, values);
    qdot_free(values);
    qdot_free(roots);
    return qdot_resolve_check(s->pool, *value);
}

/* Whether the term is a product in which a sum holds one of the symbols. */
static bool
is_nested(const qdot_pool *pool, qdot_expr term, size_t n, const qdot_expr *symbols)
{
    for (uint32_t i = 1; qdot_expr_kind(pool, term) == QDOT_PROD &&
                         i < qdot_expr_count(pool, term);
         i += 2) {
        qdot_expr base = qdot_expr_arg(pool, term, i);

        for (size_t k = 0; qdot_expr_kind(pool, base) == QDOT_SUM && k < n; k++)
            if (qdot_expr_contains(pool, base, symbols[k]))
                return true;
    }
    return false;
}

typedef struct {
    replacements r; /* x by a + ray u; u by x - a */
    qdot_vec(qdot_expr) steps; /* u */
} ray;

/* Of one degree, its products of sums in u multiplied out. */
static qdot_expr
multiplied_out(qdot_pool *pool, qdot_expr scalar, void *user)
{
    const ray *x = user;
    bool nested = is_nested(pool, scalar, x->steps.n, x->steps.at);

    for (uint32_t i = 1; qdot_expr_kind(pool, scalar) == QDOT_SUM && !nested &&
                         i < qdot_expr_count(pool, scalar);
         i += 2)
        nested = is_nested(pool, qdot_expr_arg(pool, scalar, i), x->steps.n, x->steps.at);
    return nested ? qdot_expand(pool, scalar) : scalar;
}

/* The sum of D^k f / k! at ray = 0, in u. */
static qdot_expr
along(qdot_pool *pool, qdot_expr f, qdot_expr symbol, long most, ray *x)
{
    qdot_expr zero = QDOT_ZERO;
    qdot_expr sum = f == QDOT_NIL ? f : qdot_subs(pool, f, 1, &symbol, &zero);

    for (long k = 1; k <= most && sum != QDOT_NIL && f != QDOT_ZERO; k++) {
        qdot_expr term;

        f = qdot_value_div(pool, qdot_diff(pool, f, symbol), qdot_expr_int(pool, k));
        term = qdot_subs(pool, f, 1, &symbol, &zero);
        sum = qdot_value_add(pool, sum,
                             qdot_value_map(pool, term, multiplied_out, x));
    }
    return sum;
}

/* Fill x of the equations x = a. */
static qdot_status
directions(qdot_session *s, qdot_expr symbol, uint32_t n, const qdot_expr *args, ray *x)
{
    qdot_pool *pool = s->pool;

    for (uint32_t i = 0; i < n; i++)
        QDOT_TRY(gather(s, "series", args[i], &x->r));
    for (size_t i = 0; i < x->r.from.n; i++) {
        qdot_text name = {0};
        qdot_status status;

        if (qdot_expr_kind(pool, x->r.from.at[i]) != QDOT_SYM)
            return qdot_fail(QDOT_ETYPE, "a series is in symbols: series(e, x = a, n)");
        qdot_text_format(&name, "ray %zu", i);
        status = qdot_text_status(&name);
        if (status == QDOT_OK)
            status = qdot_vec_push(&x->steps, qdot_symbol_get(pool, QDOT_FORMAL, name.at));
        qdot_text_clear(&name);
        QDOT_TRY(status);
        x->r.to.at[i] =
            qdot_add(pool, x->r.to.at[i], qdot_mul(pool, symbol, x->steps.at[i]));
    }
    return qdot_pool_check(pool);
}

static qdot_status
series_of(qdot_session *s, qdot_expr e, uint32_t n, const qdot_expr *args, long most,
          qdot_expr *value)
{
    qdot_pool *pool = s->pool;
    qdot_expr symbol = qdot_symbol_get(pool, QDOT_FORMAL, "ray");
    ray x = {0};
    qdot_status status = directions(s, symbol, n, args, &x);

    if (status == QDOT_OK) {
        qdot_expr sum = along(pool, qdot_subs(pool, e, x.r.from.n, x.r.from.at, x.r.to.at),
                              symbol, most, &x);

        for (size_t i = 0; i < x.r.from.n; i++) /* a + ray u, back to u = x - a */
            x.r.to.at[i] = qdot_sub(pool, x.r.from.at[i],
                                    qdot_subs(pool, x.r.to.at[i], 1, &symbol,
                                              (qdot_expr[]){QDOT_ZERO}));
        status = give(s, qdot_subs(pool, sum, x.steps.n, x.steps.at, x.r.to.at), value);
        s->series_in = qdot_list(pool, (uint32_t)x.r.from.n, x.r.from.at);
    }
    qdot_free(x.r.from.at);
    qdot_free(x.r.to.at);
    qdot_free(x.steps.at);
    return status;
}

/* series(e, x = a, y = b, n): in s up to s^n of e at x = a + s (x - a) ..., at s = 1; of a list
 * member by member. */
qdot_status
qdot_algebra_series(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    bool list = qdot_expr_kind(s->pool, args[0]) == QDOT_LIST;
    uint32_t count = list ? qdot_expr_count(s->pool, args[0]) : 1;
    qdot_expr *members;
    qdot_status status = QDOT_OK;
    long most;

    QDOT_TRY(qdot_session_integer(s, args[n - 1], &most));
    if (most < 0 || most > 1000)
        return qdot_fail(QDOT_EDOMAIN, "a series goes up to degree 0 ... 1000, not %ld",
                         most);
    members = qdot_malloc((count + 1) * sizeof *members);
    if (members == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < count && status == QDOT_OK; i++)
        status = series_of(s, list ? qdot_expr_arg(s->pool, args[0], i) : args[0], n - 2,
                           args + 1, most, &members[i]);
    if (status == QDOT_OK)
        status = give(s, list ? qdot_list(s->pool, count, members) : members[0], value);
    if (status == QDOT_OK)
        s->series = *value;
    qdot_free(members);
    return status;
}

/* Every root of det(M - x 1), as often as it is one. */
static qdot_status
roots_of(qdot_session *s, qdot_expr det, qdot_expr x, uint32_t n, qdot_expr *value)
{
    qdot_pool *pool = s->pool;
    qdot_facts facts = qdot_scene_facts(s->scene);
    qdot_expr *values = qdot_malloc((n + 1) * sizeof *values);
    qdot_root *roots = NULL;
    uint32_t found = 0;
    size_t count = 0;
    bool complete = false;
    qdot_status status = QDOT_ENOMEM;

    if (values != NULL)
        status = qdot_solve(pool, det, x, &facts, &roots, &count, &complete);
    for (size_t i = 0; i < count && status == QDOT_OK; i++)
        for (qdot_expr p = det; found < n; p = qdot_diff(pool, p, x)) {
            if (p == QDOT_NIL ||
                !qdot_is_zero(pool, qdot_subs(pool, p, 1, &x, &roots[i].value), &facts))
                break;
            values[found++] = roots[i].value;
        }
    if (status == QDOT_OK && !complete)
        status = qdot_fail(QDOT_EFAILED, "the characteristic polynomial cannot be solved "
                                         "exactly");
    else if (status == QDOT_OK && found < n)
        status = qdot_fail(QDOT_EDOMAIN, "only %u of %u eigenvalues are real", found, n);
    if (status == QDOT_OK)
        status = give(s, qdot_list(pool, n, values), value);
    qdot_free(roots);
    qdot_free(values);
    return status;
}

qdot_status
qdot_algebra_eigenvalues(qdot_session *s, uint32_t n, const qdot_expr *args,
                         qdot_expr *value)
{
    qdot_pool *pool = s->pool;
    qdot_expr x = qdot_symbol_get(pool, QDOT_FORMAL, "eigenvalue"), *entries, det;
    uint32_t size;

    (void)n;
    if (qdot_expr_kind(pool, args[0]) != QDOT_MAT)
        return qdot_fail(QDOT_ETYPE, "eigenvalues takes a matrix, not %s",
                         qdot_resolve_kind(pool, args[0]));
    size = qdot_expr_node(pool, args[0])->op;
    if (size * size != qdot_expr_count(pool, args[0]))
        return qdot_fail(QDOT_ETYPE, "eigenvalues takes a square matrix");
    entries = qdot_malloc((size_t)size * size * sizeof *entries);
    if (entries == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < size * size; i++) {
        entries[i] = qdot_expr_arg(pool, args[0], i);
        if (i % (size + 1) == 0)
            entries[i] = qdot_sub(pool, entries[i], x);
    }
    det = qdot_det(pool, qdot_matrix(pool, size, size, entries));
    qdot_free(entries);
    QDOT_TRY(qdot_resolve_check(pool, det));
    return roots_of(s, det, x, size, value);
}
